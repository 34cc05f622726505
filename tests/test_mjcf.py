"""MJCF is read as MuJoCo reads it: places, units, classes, frames, included files, and joints that share a body."""

from math import pi, radians

import numpy as np
import pytest
from command import run
from hypothesis import given, settings, strategies as st
from scipy.spatial.transform import Rotation

from robotics1 import InputError, RobotFileError, RobotWarning, check_robot, forward_kinematics, load_robot

SIZES = st.floats(-2, 2).map(lambda value: round(value, 3))
TRIPLES = st.tuples(SIZES, SIZES, SIZES)
AXES = st.tuples(SIZES, SIZES, st.floats(0.1, 1).map(lambda value: round(value, 3)))


def words(values):
    return " ".join(map(repr, map(float, values)))


def unit(v):
    return np.array(v) / np.linalg.norm(v)


def matrix(rotation, place):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = rotation, place
    return T


@st.composite
def orientations(draw, in_degrees):
    """An orientation as the text of an attribute and as a matrix."""
    kind = draw(st.sampled_from(["quat", "axisangle", "euler", "xyaxes", "zaxis", "none"]))
    scale = pi / 180 if in_degrees else 1.0
    if kind == "quat":
        w, x, y, z = values = (1.0, *draw(TRIPLES))
        return f'quat="{words(values)}"', Rotation.from_quat([x, y, z, w]).as_matrix()
    if kind == "axisangle":
        axis, angle = draw(AXES), draw(SIZES)
        return f'axisangle="{words((*axis, angle / scale))}"', Rotation.from_rotvec(angle * unit(axis)).as_matrix()
    if kind == "euler":
        angles = np.array(draw(TRIPLES))
        return f'euler="{words(angles / scale)}"', Rotation.from_euler("XYZ", angles).as_matrix()
    if kind == "xyaxes":
        x, y = np.array(draw(AXES)), np.array([1.0, 5.0, 0.0]) + 0.1 * np.array(draw(TRIPLES))
        x, z = unit(x), unit(np.cross(x, y))
        return f'xyaxes="{words((*x, *y))}"', np.column_stack([x, np.cross(z, x), z])
    if kind == "zaxis":
        z = unit(draw(AXES))
        turn = np.cross([0, 0, 1], z)
        angle = np.arctan2(np.linalg.norm(turn), z[2])
        vector = angle * unit(turn) if np.linalg.norm(turn) > 0 else turn
        return f'zaxis="{words(z)}"', Rotation.from_rotvec(vector).as_matrix()
    return "", np.eye(3)


@st.composite
def joints(draw, number, in_degrees):
    """A joint as an element, and the motion of q that it gives its body (4, 4)."""
    kind, axis, at, ref = draw(st.sampled_from(["hinge", "slide"])), draw(AXES), draw(TRIPLES), draw(SIZES)
    scale = pi / 180 if in_degrees and kind == "hinge" else 1.0
    text = f'<joint name="q{number}" type="{kind}" axis="{words(axis)}" pos="{words(at)}" ref="{ref / scale!r}"/>'

    def motion(q):
        if kind == "slide":
            return matrix(np.eye(3), (q - ref) * unit(axis))
        R = Rotation.from_rotvec((q - ref) * unit(axis)).as_matrix()
        return matrix(R, at - R @ at)

    return text, motion


@settings(deadline=None, max_examples=40)
@given(st.data(), st.booleans())
def test_a_body_is_at_the_product_of_its_places_and_motions(data, in_degrees):
    """T = ∏ place · ∏ Trans(pos) Rot(axis, q − ref) Trans(pos)⁻¹, with a placed base and a <frame> around it."""
    text, end, parts, number = "", "", [], 0
    for body in range(data.draw(st.integers(2, 4))):
        turned, R = data.draw(orientations(in_degrees))
        place = data.draw(TRIPLES)
        around, framed = data.draw(orientations(in_degrees))
        text += f'<frame pos="0.1 0 0.2" {around}><body name="b{body}" pos="{words(place)}" {turned}>'
        end = "</body></frame>" + end
        parts += [lambda q, F=framed: matrix(F, [0.1, 0, 0.2]), lambda q, R=R, p=place: matrix(R, p)]
        for _ in range(0 if body == 0 else data.draw(st.integers(1, 2))):
            joint, motion = data.draw(joints(number, in_degrees))
            text += joint
            parts.append(lambda q, i=number, motion=motion: motion(q[i]))
            number += 1
    unit_of_angles = "" if in_degrees else '<compiler angle="radian"/>'
    robot = load_robot(f"<mujoco>{unit_of_angles}<worldbody>{text}{end}</worldbody></mujoco>", trusted=True)
    assert robot.joint_names == tuple(f"q{i}" for i in range(number))
    q = np.linspace(-1.2, 1.5, number)
    T = np.eye(4)
    for part in parts:
        T = T @ part(q)
    assert forward_kinematics(robot, q).homogeneous == pytest.approx(T, abs=1e-9)


def test_the_capital_letters_of_eulerseq_are_fixed_axes():
    text = """<mujoco><compiler eulerseq="ZYX"/><worldbody><body name="a" euler="20 30 40"><joint/></body></worldbody>
    </mujoco>"""
    R = forward_kinematics(load_robot(text, trusted=True), [0.0]).rotation
    assert pytest.approx(Rotation.from_euler("zyx", [20, 30, 40], degrees=True).as_matrix()) == R


def test_the_range_of_a_slide_is_a_length_and_that_of_a_hinge_an_angle():
    text = """<mujoco><worldbody><body name="a"><joint name="s" type="slide" range="-1.8 1.5"/><body name="b">
    <joint name="h" range="-90 45"/><body name="c"><joint name="free" range="-90 45" limited="false"/></body></body>
    </body></worldbody></mujoco>"""
    robot = load_robot(text, trusted=True)
    assert robot.lower.tolist() == pytest.approx([-1.8, -pi / 2, -np.inf])
    assert robot.upper.tolist() == pytest.approx([1.5, pi / 4, np.inf])


def test_a_class_has_what_the_class_around_it_has():
    """Axis and range of "arm" hold in "wrist", which has a range of its own; childclass names the class of a body."""
    text = """<mujoco><compiler angle="radian"/><default><joint axis="0 1 0"/><default class="arm"><joint range="-1 2"/>
    <default class="wrist"><joint range="-3 3"/></default></default></default><worldbody>
    <body name="a" childclass="arm"><joint name="q1"/><body name="b" pos="1 0 0"><joint name="q2" class="wrist"/>
    <body name="c" pos="1 0 0">
    <joint name="q3" class="main" axis="1 0 0"/></body></body></body></worldbody></mujoco>"""
    robot = load_robot(text, trusted=True)
    assert (robot.lower.tolist(), robot.upper.tolist()) == ([-1, -3, -np.inf], [2, 3, np.inf])
    assert forward_kinematics(robot, [pi / 2, -pi / 2, 0.3]).translation == pytest.approx([1, 0, -1])


def test_every_tree_of_a_file_is_read():
    """Two arms that stand beside each other on the ground."""
    arm = '<body name="{0}" pos="0 {1} 0"><joint name="q_{0}"/><site name="tip_{0}" pos="1 0 0"/></body>'
    text = f"<mujoco><worldbody>{arm.format('left', 1)}{arm.format('right', -1)}</worldbody></mujoco>"
    robot = load_robot(text, trusted=True)
    assert robot.joint_names == ("q_left", "q_right")
    assert forward_kinematics(robot, [0, radians(30)], frame="tip_right").translation == pytest.approx(
        [3**0.5 / 2, -0.5, 0]
    )


def test_an_included_file_stands_where_it_is_named(tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "hand.xml").write_text('<mujocoinclude><body name="hand" pos="0 0 1"/></mujocoinclude>')
    (tmp_path / "arm.xml").write_text(
        '<mujoco><worldbody><body name="arm"><joint name="q" axis="0 1 0"/><include file="parts/hand.xml"/></body>'
        "</worldbody></mujoco>"
    )
    scene = tmp_path / "scene.xml"
    scene.write_text('<mujoco model="scene"><include file="arm.xml"/><worldbody><light/></worldbody></mujoco>')
    robot = load_robot(scene, trusted=True)
    assert forward_kinematics(robot, [pi / 2], frame="hand").translation == pytest.approx([1, 0, 0])
    (tmp_path / "arm.xml").write_text('<mujoco><include file="scene.xml"/></mujoco>')
    with pytest.raises(RobotFileError, match=r"includes 'arm\.xml' twice"):
        load_robot(scene, trusted=True)
    (tmp_path / "arm.xml").unlink()
    with pytest.raises(RobotFileError, match=r"includes 'arm\.xml', and there is no such file"):
        load_robot(scene, trusted=True)


def test_a_loop_and_a_tie_that_are_not_kept_are_a_warning():
    arm = '<body name="a"><joint name="q1"/><body name="b" pos="1 0 0"><joint name="q2"/></body></body>'
    for part, sentence in (
        ('<joint joint1="q2" joint2="q1" polycoef="0 -1 0 0 0"/>', "joints are tied to each other, 'q2' and 'q1'"),
        ('<connect body1="b" body2="world" anchor="1 0 0"/>', "a loop of bodies is closed, 'b' and 'world'"),
    ):
        text = f"<mujoco><worldbody>{arm}</worldbody><equality>{part}</equality></mujoco>"
        with pytest.warns(RobotWarning, match=sentence):
            robot = load_robot(text, trusted=True)
        assert robot.nq == 2
        assert sentence in str(robot)


@pytest.mark.parametrize(
    ("part", "sentence"),
    [
        ('<body name="a"><joint axis="0 0 0"/></body>', "'axis' of length 0"),
        ('<body name="a" pos="0 1"><joint/></body>', "3 finite numbers as 'pos', not '0 1'"),
        ('<body name="a" quat="nan 0 0 1"><joint/></body>', "4 finite numbers as 'quat'"),
        ('<body name="a"><joint name="q"/><joint name="q"/></body>', "joint 'q' is there twice"),
        ('<body name="a"><joint/></body><body name="a"/>', "body 'a' is there twice"),
        ('<body name="a"><joint class="none"/></body>', "no default class 'none'"),
        ('<body name="a"><joint type="ball"/></body>', "of the type 'ball'"),
        ('<replicate count="2"><body name="a"><joint/></body></replicate>', "<replicate> makes bodies"),
        ('<body name="a"/>', "has no joints"),
    ],
)
def test_what_cannot_be_read_is_an_error_with_its_line(part, sentence):
    with pytest.raises(RobotFileError, match=sentence):
        load_robot(f"<mujoco><worldbody>{part}</worldbody></mujoco>", trusted=True)


def test_two_joints_of_a_body_move_it_one_after_the_other():
    """A planar base: x, y, then the turn; the body is at (x, y) and turned by θ."""
    text = """<mujoco><worldbody><body name="base"><joint name="x" type="slide" axis="1 0 0"/>
    <joint name="y" type="slide" axis="0 1 0"/><joint name="turn"/><site name="tip" pos="1 0 0"/></body>
    </worldbody></mujoco>"""
    robot = load_robot(text, trusted=True)
    assert robot.joint_names == ("x", "y", "turn")
    assert forward_kinematics(robot, [3, 4, pi / 2], frame="tip").translation == pytest.approx([3, 5, 0])


def test_a_floating_base_at_zero_is_where_the_file_draws_it():
    text = """<mujoco><worldbody><body name="pelvis" pos="0 0 0.8"><freejoint name="root"/></body></worldbody>
    </mujoco>"""
    robot = load_robot(text, trusted=True)
    assert forward_kinematics(robot, [0, 0, 0, 0, 0, 0, 1], frame="pelvis").translation == pytest.approx([0, 0, 0.8])


ARM = '<mujoco><worldbody><body name="a"><joint name="q"/><site name="tip" pos="1 0 0"/></body></worldbody></mujoco>'


@pytest.mark.parametrize("choice", [{"locked": {"q": 0}}, {"base": "a"}, {"parameters": {"l": 1}}])
@pytest.mark.parametrize("ask", [load_robot, check_robot])
def test_what_mjcf_cannot_choose_is_not_passed_over(ask, choice):
    with pytest.raises(InputError, match="MJCF has no parameters, base or locked joints"):
        ask(ARM, trusted=True, **choice)


def test_the_report_on_mjcf_has_the_robot_and_what_is_odd():
    tied = ARM.replace("</mujoco>", '<equality><weld body1="a"/></equality></mujoco>')
    for text, number in ((ARM, 0), (tied, 1)):
        report = check_robot(text, trusted=True)
        assert report.require().joint_names == ("q",)
        assert len(report.warnings) == number
    (error,) = check_robot(ARM.replace('"q"', '"q" type="ball"'), trusted=True).errors
    assert "joint 'q' is of the type 'ball'" in error.message


def test_the_command_reads_mjcf_that_is_trusted(tmp_path):
    file = tmp_path / "arm.xml"
    file.write_text(ARM)
    refused = run("fk", file, "--q", "pi/2")
    assert (refused.code, "--trusted" in refused.stderr) == (2, True)
    read = run("fk", file, "--q", "pi/2", "--trusted")
    assert (read.code, "p = (0, 1, 0) m" in read.stdout) == (0, True)
    assert run("check", file, "--trusted").code == 0
