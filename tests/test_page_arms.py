"""The robots of the course in the page: what their files say is drawn, inside the window, and where FK says."""

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from dh_arms import H, P, R
from pages import OpenPage, data_behind

import robotics1 as r1

STANFORD = [R(0, -H, "d1"), R(0, H, "d2"), P(0), R(0, -H, 0), R(0, H, 0), R(0, 0, "d6")]
LENGTHS = {"d1": 0.4, "d2": 0.15, "d6": 0.25}
Q = {
    "prr": [0.2, 0.5, 0.9],
    "cylindrical": [0.4, 0.6, 0.5],
    "planar_2r": [0.4, 1.0],
    "six_r": [0.3, -0.8, 0.9, 0.2, 0.5, 0.1],  # without shapes
    "Stanford arm": [0.4, -0.7, 0.5, 0.3, 0.9, -0.2],
    "missing meshes": [0.5, -0.4],
}


def missing_meshes(folder):
    """A 2R arm whose second link has a mesh that is not there."""
    visual = "<visual><geometry>{}</geometry></visual>"
    text = '<robot name="missing meshes"><link name="base"/>'
    for link, shape in (
        ("a", '<box size="0.1 0.1 0.1"/>'),
        ("b", '<mesh filename="package://p/b.stl"/>'),
        ("tool", ""),
    ):
        text += f'<link name="{link}">{visual.format(shape) if shape else ""}</link>'
    for joint, parent, child, kind in (
        ("q1", "base", "a", "revolute"),
        ("q2", "a", "b", "revolute"),
        ("t", "b", "tool", "fixed"),
    ):
        text += (
            f'<joint name="{joint}" type="{kind}"><origin xyz="{0.0 if joint == "q1" else 0.5} 0 0"/>'
            f'<parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>'
            '<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>'
        )
    (folder / "arm.urdf").write_text(text + "</robot>")
    return r1.load_robot(folder / "arm.urdf")


def stanford():
    """The Stanford arm by its DH table; its slide has limits."""
    lower, upper = ([None, None, slide, None, None, None] for slide in (0.1, 0.7))
    return r1.robot_from_dh(STANFORD, parameters=LENGTHS, lower=lower, upper=upper)


def stanford_tool(q):
    """T_0_6 of the Stanford arm as the product of its DH matrices, (4, 4)."""
    d1, d2, d6 = LENGTHS.values()
    rows = [(q[0], d1, -H), (q[1], d2, H), (0, q[2], 0), (q[3], 0, -H), (q[4], 0, H), (q[5], d6, 0)]
    T = np.eye(4)
    for theta, d, alpha in rows:
        (ct, st), (ca, sa) = ((np.cos(x), np.sin(x)) for x in (theta, alpha))
        T = T @ np.array([[ct, -st * ca, st * sa, 0], [st, ct * ca, -ct * sa, 0], [0, sa, ca, d], [0, 0, 0, 1]])
    return T


@pytest.mark.parametrize("name", Q)
def test_an_arm_is_whole_inside_the_window_and_its_tool_is_where_fk_says(browser, name, tmp_path):
    if name == "missing meshes":
        robot = missing_meshes(tmp_path)
        with pytest.warns(r1.RobotWarning, match="was not found"):
            file = r1.view(robot, Q[name], tmp_path / "a.html").file
    else:
        robot = stanford() if name == "Stanford arm" else arm(name)
        file = r1.view(robot, Q[name], tmp_path / "a.html", title=name).file
    page = OpenPage(browser, file, 1280, 800)
    assert page.tab.inner_text("#caption h1") == name
    drawn = page.ask("app.drawing.links.concat([app.drawing.base]).flatMap(g => g.children)"
                     ".filter(m => m.userData.drawn).map(m => m.geometry.attributes.position.count)")  # fmt: skip
    assert len(drawn) == page.ask("app.arm.shapes.length") >= robot.nq
    assert min(drawn) >= 8  # a box has as many corners
    for low, high in page.inside_windows():
        assert low > -1.001
        assert high < 1.001
    tool = r1.forward_kinematics(robot, Q[name]).translation
    assert page.place("tool frame") == pytest.approx(tool, abs=1e-5)
    if name == "Stanford arm":
        assert page.place("tool frame") == pytest.approx(stanford_tool(Q[name])[:3, 3], abs=1e-5)
    page.picture(name.replace(" ", "_"))
    assert page.faults == []
    page.tab.close()


# --- a leader that stands nearer the tip than the joint that mimics it


def posed(joint, q):
    """Return the motion of a joint of the page, (4, 4)."""
    value = joint["multiplier"] * q[joint["coordinate"]] + joint["offset"]
    turn, slide = (value, 0) if joint["kind"] == "revolute" else (0, value)
    axis = np.array(joint["axis"])
    place = np.vstack([np.reshape(joint["placement"], (3, 4)), [0, 0, 0, 1]])
    return place @ pin.SE3(pin.exp3(turn * axis), slide * axis).homogeneous


@pytest.mark.parametrize("multiplier", [1, -0.5])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_late_leader_moves_in_the_page_as_in_forward_kinematics(kind, multiplier):
    limit = '<limit lower="-1" upper="1" velocity="1" effort="1"/>'
    robot = r1.load_robot(
        '<robot name="late"><link name="base"/><link name="first"/><link name="last"/>'
        f'<joint name="follower" type="{kind}"><parent link="base"/><child link="first"/><origin xyz="0 0 0.2"/>'
        f'<axis xyz="0 0 1"/>{limit}<mimic joint="leader" multiplier="{multiplier}" offset="0.1"/></joint>'
        f'<joint name="leader" type="{kind}"><parent link="first"/><child link="last"/><origin xyz="0.3 0 0"/>'
        f'<axis xyz="0 1 0"/>{limit}</joint></robot>'
    )
    arm = data_behind(r1.view(robot, [0.4]).html)["arms"][0]
    poses = [np.eye(4)]
    for joint in arm["joints"]:
        poses.append(poses[joint["parent"] + 1] @ posed(joint, [0.4]))
    tool = np.vstack([np.reshape(arm["tool"]["placement"], (3, 4)), [0, 0, 0, 1]])
    expected = r1.forward_kinematics(robot, [0.4]).homogeneous
    assert poses[arm["tool"]["joint"] + 1] @ tool == pytest.approx(expected, abs=1e-15)
    assert [shape["link"] for shape in arm["shapes"]].count("last") == 2  # its drum, and the ball at its tip
