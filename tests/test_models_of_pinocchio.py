"""A model of Pinocchio, or what it reads of MJCF, is checked as a file is, and its followers follow."""

import numpy as np
import pinocchio as pin
import pytest
from drawn_arms import drawn_arm

from robotics1 import InputError, RobotFileError, forward_kinematics, frame_jacobian, load_robot


def model(*, axis=(0, 0, 1), shift=(1, 0, 0), rotation=((1, 0, 0), (0, 1, 0), (0, 0, 1)), name="turn", **limits):
    """A joint that turns, and one behind it; each of `limits` is a vector of the model."""
    made = pin.Model()
    first = made.addJoint(0, pin.JointModelRevoluteUnaligned(np.array(axis, dtype=float)), pin.SE3.Identity(), name)
    second = made.addJoint(
        first, pin.JointModelPX(), pin.SE3(np.array(rotation, dtype=float), np.array(shift, dtype=float)), "slide"
    )
    made.addBodyFrame("upper", first, pin.SE3.Identity(), 0)
    made.addBodyFrame("tool", second, pin.SE3(np.eye(3), np.array([0.5, 0, 0])), 0)
    for key, value in limits.items():
        setattr(made, key, np.array(value, dtype=float))
    return made


WRONG = {
    "swapped limits": ({"lowerPositionLimit": [1, 0], "upperPositionLimit": [-1, 1]}, "must have lower ≤ upper"),
    "a limit that is no number": ({"upperPositionLimit": [np.nan, 1]}, "must have lower ≤ upper; they are"),
    "a negative velocity": ({"upperVelocityLimit": [-1, 1]}, "velocity and effort of joint 'turn'"),
    "an effort that is no number": ({"upperEffortLimit": [1, np.nan]}, "velocity and effort of joint 'slide'"),
    "a place that is no number": ({"shift": [np.nan, 0, 0]}, "joint 'slide' of the model is placed at"),
    "a place beyond all size": ({"shift": [1e300, 0, 0]}, r"at most 1e\+18 can be computed with"),
    "a scaled rotation": ({"rotation": 2 * np.eye(3)}, "the placement of joint 'slide' of the model has no rotation"),
    "a reflection": ({"rotation": -np.eye(3)}, "the placement of joint 'slide' of the model has no rotation"),
    "a long axis": ({"axis": [0, 0, 2]}, "which is no unit vector"),
    "a zero axis": ({"axis": [0, 0, 0]}, "which is no unit vector"),
    "an axis that is no number": ({"axis": [np.nan, 0, 1]}, "which is no unit vector"),
    "no name": ({"name": " "}, "can be no name in a file"),
    "a control character": ({"name": "a\x1b[31m"}, "can be no name in a file"),
}


@pytest.mark.parametrize(("numbers", "sentence"), WRONG.values(), ids=WRONG)
def test_wrong_numbers_of_a_model_are_refused(numbers, sentence):
    with pytest.raises(InputError, match=sentence):
        load_robot(model(**numbers))


def test_a_limit_beyond_all_size_is_none():
    robot = load_robot(model(lowerPositionLimit=[-1e300, -1], upperPositionLimit=[np.inf, 1]))
    assert robot.lower.tolist() == [-np.inf, -1]
    assert robot.upper.tolist() == [np.inf, 1]


def test_what_is_no_geometry_model_is_refused():
    with pytest.raises(InputError, match=r"the shapes of a pin.Model are a pin.GeometryModel, not int"):
        load_robot((model(), 5))


@pytest.mark.parametrize("seed", range(40))
def test_the_robot_of_a_robots_own_model_moves_as_it_does(seed):
    robot = drawn_arm(seed)
    again = load_robot(robot.model, tool="tool")
    rng = np.random.default_rng(seed)
    for _ in range(3):
        q = rng.uniform(np.maximum(robot.lower, -3), np.minimum(robot.upper, 3))
        a, b = (forward_kinematics(one, q).homogeneous for one in (robot, again))
        assert np.abs(a - b).max() < 1e-12 * max(1, robot.reach)
        a, b = (frame_jacobian(one, q) for one in (robot, again))
        assert np.abs(a - b).max() < 1e-12 * max(1, robot.reach)
    followers = [joint.name for joint in robot.joints if joint.follows]
    assert [joint.name for joint in again.joints if joint.follows] == followers


@pytest.mark.parametrize(
    ("axis", "kind", "a", "b"),
    [
        ((0.6, 0, 0.8), "revolute", -2.0, 0.3),
        ((0, -1, 0), "prismatic", 0.5, -0.1),
        ((0, 0, 1), "revolute", 1e-6, 0.0),
        ((1, 0, 0), "revolute", 1000.0, 0.0),
        ((0, 1, 0), "prismatic", 0.0, 0.2),
    ],
)
def test_a_follower_has_the_axis_factor_and_offset_of_its_file(axis, kind, a, b):
    text = f"""<robot name="r"><link name="base"/><link name="l1"/><link name="tool"/>
        <joint name="q1" type="continuous"><parent link="base"/><child link="l1"/><axis xyz="0 1 0"/></joint>
        <joint name="q2" type="{kind}"><parent link="l1"/><child link="tool"/>
        <origin xyz="1 0 0.5" rpy="0.3 0 1"/><axis xyz="{axis[0]} {axis[1]} {axis[2]}"/>
        <limit lower="-9e3" upper="9e3" effort="1" velocity="1"/>
        <mimic joint="q1" multiplier="{a}" offset="{b}"/></joint></robot>"""
    robot = load_robot(text)
    again = load_robot(robot.model)
    if a:
        (joint,) = (joint for joint in again.joints if joint.follows)
        assert (joint.kind, joint.multiplier, joint.offset, joint.leader) == (kind, a, b, "q1")
        assert np.array(joint.axis) == pytest.approx(np.array(axis), abs=1e-9)
    for q in (0.0, 0.4, -1.3):
        one, other = (forward_kinematics(r, [q]).homogeneous for r in (robot, again))
        assert one == pytest.approx(other, abs=1e-9)


MJCF = """<mujoco model="m"><worldbody><body name="a"><joint name="j1" type="hinge" axis="0 0 1" {range}/>
    <geom size="0.1"/><body name="b" pos="1 0 0"><joint name="j2" type="{kind}" axis="1 0 0"/><geom size="0.1"/>
    </body></body></worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("limits", "kind", "sentence"),
    [
        ('range="90 -90" limited="true"', "hinge", "must have lower ≤ upper"),
        ("", "ball", "joint 'j2' is of the type 'ball'"),
    ],
)
def test_a_wrong_mjcf_text_is_a_wrong_file(limits, kind, sentence):
    with pytest.raises(RobotFileError, match=sentence):
        load_robot(MJCF.format(range=limits, kind=kind), trusted=True)
