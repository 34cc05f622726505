"""The mixed, the space and the body Jacobian: three textbooks' J of one robot."""

import numpy as np
import pinocchio as pin
import pytest
from arms import ARMS, arm, random_q
from differences import along
from product_of_exponentials import Ad, body_jacobian, bracket, pose, space_jacobian

from robotics1 import InputError, UnknownNameError, forward_kinematics, frame_jacobian, load_robot, robot_from_dh

L1, L2, D = 0.4, 0.3, 0.5
SCARA = robot_from_dh([("R", L1, 0, D, 0), ("R", L2, 0, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
SCREWS = np.array([[0, 0, 0, 0, 0, 1], [0, -L1, 0, 0, 0, 1], [0, 0, 1, 0, 0, 0], [0, -(L1 + L2), 0, 0, 0, 1.0]])
HOME = np.array([[1, 0, 0, L1 + L2], [0, 1, 0, 0], [0, 0, 1, D], [0, 0, 0, 1.0]])
FOLLOWER = """<robot name="follower"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<origin xyz="0.1 0 0.2"/></joint>
<joint name="k" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/><origin xyz="0.3 0.1 0"/>
<mimic joint="j" multiplier="-0.5"/></joint></robot>"""


@pytest.fixture(scope="module")
def follower(tmp_path_factory):
    path = tmp_path_factory.mktemp("follower") / "follower.urdf"
    path.write_text(FOLLOWER)
    return load_robot(path)


def frame_of(robot):
    return robot.tool or robot.frame_names[-1]


def twists_by_differences(robot, q, frame):
    """The columns (v, ω) of Ṫ T⁻¹ and of T⁻¹ Ṫ while one joint moves at the rate 1."""
    T = forward_kinematics(robot, q, frame=frame).homogeneous
    for d in np.eye(robot.nv):
        T_dot = along(lambda x: forward_kinematics(robot, x, frame=frame).homogeneous, q, d)
        yield [[*W[:3, 3], W[2, 1], W[0, 2], W[1, 0]] for W in (T_dot @ np.linalg.inv(T), np.linalg.inv(T) @ T_dot)]


@pytest.mark.parametrize("seed", range(4))
def test_space_and_body_jacobian_are_those_of_a_product_of_exponentials(seed):
    q = random_q(SCARA, seed)
    assert forward_kinematics(SCARA, q).homogeneous == pytest.approx(pose(HOME, SCREWS, q), abs=1e-14)
    assert frame_jacobian(SCARA, q, kind="space") == pytest.approx(space_jacobian(SCREWS, q), abs=1e-14)
    assert frame_jacobian(SCARA, q, kind="body") == pytest.approx(body_jacobian(HOME, SCREWS, q), abs=1e-14)


@pytest.mark.parametrize("name", ARMS)
def test_space_is_ad_t_times_body_and_body_is_the_mixed_one_in_the_axes_of_the_frame(name):
    robot = arm(name)
    q, frame = random_q(robot, 7), frame_of(arm(name))
    T = forward_kinematics(robot, q, frame=frame)
    J_s, J_b = (frame_jacobian(robot, q, frame=frame, kind=kind) for kind in ("space", "body"))
    assert J_s == pytest.approx(Ad(T.homogeneous) @ J_b, abs=1e-13)
    assert frame_jacobian(robot, q, frame=frame, reference=frame) == pytest.approx(J_b, abs=1e-13)
    number = robot.frame_id(frame)
    for J, reference in ((J_s, pin.ReferenceFrame.WORLD), (J_b, pin.ReferenceFrame.LOCAL)):
        data = robot.model.createData()
        wanted = pin.computeFrameJacobian(robot.model, data, q, number, reference).reshape(6, -1)
        assert wanted == pytest.approx(J, abs=1e-15)


@pytest.mark.parametrize("name", [*ARMS, "follower"])
def test_space_and_body_jacobian_are_the_twists_of_the_moving_frame(name, follower):
    robot = follower if name == "follower" else arm(name)
    q, frame = random_q(robot, 3), frame_of(robot)
    differences = np.array(list(twists_by_differences(robot, q, frame))).reshape(robot.nv, 2, 6)
    for kind, columns in zip(("space", "body"), differences.transpose(1, 2, 0), strict=True):
        assert frame_jacobian(robot, q, frame=frame, kind=kind) == pytest.approx(columns, abs=1e-9)


def test_angular_first_puts_the_rows_of_omega_over_those_of_v():
    q = random_q(SCARA, 1)
    for kind in ("mixed", "space", "body"):
        J = frame_jacobian(SCARA, q, kind=kind)
        other = frame_jacobian(SCARA, q, kind=kind, angular_first=True)
        assert np.array_equal(other, np.vstack([J[3:], J[:3]]))


def test_the_bracket_of_the_tests_is_a_cross_product():
    assert bracket([1, 2, 3, 0, 0, 2]) @ [1, 0, 0, 1] == pytest.approx([1, 4, 3, 0])


@pytest.mark.parametrize("kind", ["space", "body"])
def test_axes_other_than_those_of_the_kind_are_refused(kind):
    with pytest.raises(InputError, match=f"a {kind} Jacobian has axes of its own.*'tool'"):
        frame_jacobian(SCARA, np.zeros(4), kind=kind, reference="tool")
    with pytest.raises(UnknownNameError, match="no frame of robot 'dh' named 'tol'"):
        frame_jacobian(SCARA, np.zeros(4), kind=kind, reference="tol")


@pytest.mark.parametrize("kind", ["Space", None, 3, "world"])
def test_a_kind_that_is_none_is_named(kind):
    with pytest.raises(InputError, match="kind must be one of 'mixed', 'space', 'body'"):
        frame_jacobian(SCARA, np.zeros(4), kind=kind)
