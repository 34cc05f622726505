"""The DH tables of Robotics 1 exams of 2009 to 2013 have the forward kinematics of their published answers.

Closed forms hold at any q, to rounding; printed numbers to the digits that are printed.
"""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from hypothesis import given, strategies as st

from robotics1 import forward_kinematics, frame_jacobian, robot_from_dh

up = pi / 2
four_q = st.lists(st.floats(-3, 3), min_size=4, max_size=4)
SAMPLE = 1e-5  # six decimals are printed, of q and of what it gives


def position(robot, q):
    return forward_kinematics(robot, q).translation


def trig(q):
    """s1, c1, s2, c2, ..."""
    return [f(q_i) for q_i in q for f in (sin, cos)]


def turn_and_shift(R, p=(0, 0, 0)):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


CAMERA = [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
SPATIAL_3R = [("R", 0, up, "L1", 0), ("R", "L2", 0, 0, 0), ("R", "L3", 0, 0, 0)]
SHOULDER_3R = [("R", "L1", up, "D", 0), ("R", "L2", 0, 0, 0), ("R", "L3", 0, 0, 0)]
CABLE_ARM = [("R", 0, -up, 0, 0), ("R", 0, up, 0, 0), ("R", 0.045, -up, 0.55, 0), ("R", -0.045, up, 0, 0)]
SIX_AXES = [
    ("R", 0.35, up, 0.815, 0),
    ("R", 0.85, 0, 0, 0),
    ("R", 0.145, up, 0, 0),
    ("R", 0, -up, 0.82, 0),
    ("R", 0, up, 0, 0),
    ("R", 0, 0, 0.17, 0),
]


@pytest.fixture(scope="module")
def cable_arm():
    base, tool = turn_and_shift(np.eye(3), [0.22, 0.14, 0.346]), turn_and_shift(np.eye(3), [0, 0, 0.35])
    return robot_from_dh(CABLE_ARM, base_placement=base, tool_placement=tool)


@pytest.fixture(scope="module")
def camera_head():
    base = turn_and_shift([[0, 0, 1], [1, 0, 0], [0, 1, 0]], [0, 0, 0.2])
    rows = [("R", 0, -up, 0, 0), ("R", 0, up, 0.25, 0), ("R", 0, up, 0, 0)]
    return robot_from_dh(rows, base_placement=base, tool_placement=turn_and_shift(np.eye(3), [0, 0, 0.1]))


def test_2013_01_09_anthropomorphic_arm_first_column_is_a2_c2_plus_a3_c23_long():
    rows = [("R", 0, up, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
    robot = robot_from_dh(rows, parameters={"d1": 0.4, "a2": 0.5, "a3": 0.3})
    for q in ([0.3, 0.5, -0.7], [2, -1, 2.5]):
        J = frame_jacobian(robot, q)
        assert np.linalg.norm(J[:3, 0]) == pytest.approx(abs(0.5 * cos(q[1]) + 0.3 * cos(q[1] + q[2])), abs=1e-15)
    assert 0.01 * np.linalg.norm(frame_jacobian(robot, [1, 0, 0])[:3, 0]) == pytest.approx(0.008)


def test_2012_09_10_arm_with_shoulder_offset_has_the_printed_position_and_jacobian():
    robot = robot_from_dh([("R", 0.2, up, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    q = [0, pi / 4, -pi / 4]
    assert position(robot, q) == pytest.approx([1.053553, 0, 0.353553], abs=1e-6)
    printed = [[0, -0.3536, 0], [1.0536, 0, 0], [0, 0.8536, 0.5], [0, 0, 0], [0, -1, -1], [1, 0, 0]]
    assert frame_jacobian(robot, q) == pytest.approx(np.array(printed), abs=1e-4)
    assert frame_jacobian(robot, q) @ [0.9492, -2.8284, 5.8284] == pytest.approx([1, 1, 0.5, 0, -3, 0.9492], abs=1e-3)


@given(four_q)
def test_2012_06_11_planar_rpr_position_is_q2_along_the_slide_and_l_beyond(q):
    q1, q2, q3, _ = q
    rows = [("R", 0, up, 0, up), ("P", 0, -up, 0, 0), ("R", "L", 0, 0, -up)]
    robot = robot_from_dh(rows, parameters={"L": 0.5})
    assert position(robot, q[:3]) == pytest.approx(
        [q2 * cos(q1) + 0.5 * cos(q1 + q3), q2 * sin(q1) + 0.5 * sin(q1 + q3), 0], abs=1e-14
    )


CAMERA_POSE = [
    [-0.29552, 0.189796, 0.936293, 0.616243],
    [0.955336, 0.058711, 0.289629, 0.190626],
    [0, 0.980067, -0.198669, 0.632169],
]


def test_2012_04_26_camera_pose_and_jacobian_in_camera_axes():
    lengths, q = {"L1": 0.5, "L2": 0.4, "L3": 0.3}, [0.3, 0.5, -0.7]
    robot = robot_from_dh(SPATIAL_3R, parameters=lengths, tool_placement=turn_and_shift(CAMERA))
    assert forward_kinematics(robot, q).homogeneous[:3] == pytest.approx(np.array(CAMERA_POSE), abs=1e-6)
    J = frame_jacobian(robot, q, reference="tool")[:3]
    across, side, ahead = 0.4 * cos(0.5) + 0.3 * cos(-0.2), 0.3 + 0.4 * cos(-0.7), 0.4 * sin(-0.7)
    assert pytest.approx(np.array([[across, 0, 0], [0, side, 0.3], [0, ahead, 0]]), abs=1e-15) == J


@given(four_q, st.floats(-3, 3))
def test_2012_02_09_wrist_with_twists_alpha_and_minus_alpha_has_its_angular_jacobian(q, alpha):
    rows = [("R", 0, "alpha", "d4", 0), ("R", 0, "-alpha", "d5", 0), ("R", 0, 0, 0, 0)]
    robot = robot_from_dh(rows, parameters={"alpha": alpha, "d4": 0.3, "d5": 0.2})
    s1, c1, s2, c2 = trig(q[:2])
    sa, ca = sin(alpha), cos(alpha)
    J = [
        [0, s1 * sa, (1 - c2) * s1 * sa * ca - c1 * s2 * sa],
        [0, -c1 * sa, (c2 - 1) * c1 * sa * ca - s1 * s2 * sa],
        [1, ca, c2 * sa**2 + ca**2],
    ]
    assert frame_jacobian(robot, q[:3])[3:] == pytest.approx(np.array(J), abs=1e-14)


@given(four_q)
def test_2012_02_09_polar_arm_position_is_c1_s2_q3_s1_s2_q3_1_minus_c2_q3(q):
    q1, q2, q3, _ = q
    robot = robot_from_dh([("R", 0, up, 1, 0), ("R", 0, up, 0, 0), ("P", 0, 0, 0, 0)])
    p = [cos(q1) * sin(q2) * q3, sin(q1) * sin(q2) * q3, 1 - cos(q2) * q3]
    assert position(robot, q[:3]) == pytest.approx(p, abs=1e-14)


def test_2011_09_12_scara_realises_the_twist_with_the_printed_joint_velocities():
    robot = robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
    v = [1, -1, 1, 0, 0, -1]
    J = frame_jacobian(robot, [0, pi / 2, 1, -pi / 2])
    assert J @ [-1, 0, 1, 0] == pytest.approx(v, abs=1e-15)
    assert np.linalg.det(J.T @ J) == pytest.approx(1)
    J = frame_jacobian(robot, [pi / 4, 0, 1, 0])
    assert np.linalg.pinv(J) @ v == pytest.approx([-0.5404, -0.3333, 1, -0.1262], abs=1e-4)
    assert J @ [0.4082, -0.8165, 0, 0.4082] == pytest.approx(np.zeros(6), abs=2e-4)


@given(four_q)
def test_2011_07_04_cable_arm_position_is_the_corrected_closed_form(cable_arm, q):
    s1, c1, s2, c2, s3, c3, s4, c4 = trig(q)
    a3, d3, L = 0.045, 0.55, 0.35
    side, along = a3 + L * s4 - a3 * c4, d3 + a3 * s4 + L * c4
    p = [
        0.22 + (c1 * c2 * c3 - s1 * s3) * side + c1 * s2 * along,
        0.14 + (s1 * c2 * c3 + c1 * s3) * side + s1 * s2 * along,
        0.346 - s2 * c3 * side + c2 * along,
    ]
    assert position(cable_arm, q) == pytest.approx(p, abs=1e-14)


CABLE_POSE = [
    [0.158165, 0.314077, 0.93613, 0.829858],
    [-0.370247, 0.897755, -0.238646, 0.13229],
    [-0.915369, -0.308854, 0.25828, 0.943759],
]
CABLE_JACOBIAN = [
    [0.164627, 0.802813, 0.187591, 0.193362],
    [0.580341, 0, 0.222716, -0.162867],
    [0.089936, -0.222716, 0, -0.246192],
]


def test_2011_07_04_cable_arm_pose_and_jacobian_in_frame_2_are_the_printed_ones(cable_arm):
    q = [0.3, 0.5, -0.7, 0.9]
    assert forward_kinematics(cable_arm, q).homogeneous[:3] == pytest.approx(np.array(CABLE_POSE), abs=1e-6)
    assert position(cable_arm, [0, 0, 0, 0]) == pytest.approx([0.22, 0.14, 1.246], abs=1e-15)
    J = frame_jacobian(cable_arm, q, reference="link2")[:3]
    assert pytest.approx(np.array(CABLE_JACOBIAN), abs=1e-6) == J


@pytest.mark.parametrize(
    ("q", "p"),
    [
        ([pi / 2, pi / 4, pi / 4], [0, 1.0607, 2.5607]),
        ([-1.570796, 1.736157, 0.785281], [0, 1.0607, 2.5607]),
        ([pi / 4, -pi / 6, pi / 3], [1.5309, 1.5309, 0.25]),
        ([pi / 4, 0.2937, -pi / 3], [1.5309, 1.5309, 0.25]),
        ([-2.356194, 2.847891, 1.047271], [1.5309, 1.5309, 0.25]),
    ],
)
def test_2011_02_25_arm_is_at_the_target_for_the_printed_solutions(q, p):
    robot = robot_from_dh([("R", 0, up, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1.0, 0, 0, 0)])
    assert position(robot, q) == pytest.approx(p, abs=1e-4)


@given(four_q)
def test_2011_02_03_arm_with_named_shoulder_has_its_jacobian(q):
    robot = robot_from_dh(SHOULDER_3R, parameters={"D": 0.5, "L1": 0.1, "L2": 0.4, "L3": 0.3})
    s1, c1, s2, c2, s23, c23 = trig([q[0], q[1], q[1] + q[2]])
    r, z, out = 0.1 + 0.4 * c2 + 0.3 * c23, 0.4 * s2 + 0.3 * s23, 0.4 * c2 + 0.3 * c23
    linear = [[-s1 * r, -c1 * z, -0.3 * c1 * s23], [c1 * r, -s1 * z, -0.3 * s1 * s23], [0, out, 0.3 * c23]]
    angular = [[0, s1, s1], [0, -c1, -c1], [1, 0, 0]]
    assert frame_jacobian(robot, q[:3]) == pytest.approx(np.array(linear + angular), abs=1e-14)


SIX_AXES_POSE = [
    [0.552696, -0.672943, -0.491605, 0.943554],
    [-0.698468, -0.695827, 0.167231, 0.346156],
    [-0.454609, 0.250942, -0.85461, 0.244766],
]


def test_2010_07_07_six_axis_arm_has_the_printed_pose_and_wrist_centre():
    robot = robot_from_dh(SIX_AXES)
    T = forward_kinematics(robot, [0.3, 0.5, -0.7, 0.9, -0.4, 0.2])
    assert T.homogeneous[:3] == pytest.approx(np.array(SIX_AXES_POSE), abs=1e-6)
    for wrist in ([0, 0, 0], [1, -2, 0.5]):
        q = [0, pi / 2, 0, *wrist]
        for frame in ("link4", "link5"):
            assert forward_kinematics(robot, q, frame=frame).translation == pytest.approx([1.17, 0, 1.81], abs=1e-14)


@given(four_q)
def test_2010_01_12_cylindrical_arm_position_is_q3_c1_q3_s1_q2(q):
    q1, q2, q3, _ = q
    robot = robot_from_dh([("R", 0, 0, 0, 0), ("P", 0, up, 0, up), ("P", 0, 0, 0, 0)])
    assert position(robot, q[:3]) == pytest.approx([q3 * cos(q1), q3 * sin(q1), q2], abs=1e-14)
    J = [[-q3 * sin(q1), 0, cos(q1)], [q3 * cos(q1), 0, sin(q1)], [0, 1, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]]
    assert frame_jacobian(robot, q[:3]) == pytest.approx(np.array(J), abs=1e-14)


def test_2009_12_17_four_joint_arm_has_the_printed_position_and_jacobian():
    robot = robot_from_dh([("R", 0, up, 0, 0), ("R", 0, up, 0, 0), ("R", 0, up, "L", 0), ("R", "L", 0, 0, 0)],
                          parameters={"L": 1})  # fmt: skip
    q, h = [0, 3 * pi / 4, pi, pi], 1 / sqrt(2)
    assert position(robot, q) == pytest.approx([0, 0, 1.414214], abs=1e-6)
    J = [[0, -sqrt(2), 0, -h], [0, 0, -1, 0], [0, 0, 0, -h], [0, 0, h, 0], [0, -1, 0, -1], [1, 0, h, 0]]
    assert frame_jacobian(robot, q) == pytest.approx(np.array(J), abs=1e-14)


@given(four_q)
def test_2009_12_17_four_joint_arm_position_is_the_closed_form(q):
    robot = robot_from_dh([("R", 0, up, 0, 0), ("R", 0, up, 0, 0), ("R", 0, up, 0.7, 0), ("R", 0.7, 0, 0, 0)])
    s1, c1, s2, c2, s3, c3, s4, c4 = trig(q)
    p = [
        c1 * s2 + c1 * s2 * s4 + (s1 * s3 + c1 * c2 * c3) * c4,
        s1 * s2 + s1 * s2 * s4 - (c1 * s3 - s1 * c2 * c3) * c4,
        -c2 - c2 * s4 + s2 * c3 * c4,
    ]
    assert position(robot, q) == pytest.approx(0.7 * np.array(p), abs=1e-14)


@given(four_q)
def test_2009_11_10_camera_head_orientation_is_the_closed_form(camera_head, q):
    s1, c1, s2, c2, s3, c3 = trig(q[:3])
    R = [
        [-s2 * c3, c2, -s2 * s3],
        [c1 * c2 * c3 - s1 * s3, c1 * s2, c1 * c2 * s3 + s1 * c3],
        [s1 * c2 * c3 + c1 * s3, s1 * s2, s1 * c2 * s3 - c1 * c3],
    ]
    assert forward_kinematics(camera_head, q[:3]).rotation == pytest.approx(np.array(R), abs=1e-14)


def test_2009_11_10_camera_head_pose_is_the_printed_one(camera_head):
    printed = [
        [0.199511, 0.877583, -0.43594, -0.043594],
        [-0.617608, 0.458012, 0.639363, -0.009944],
        [0.76076, 0.14168, 0.633381, 0.502172],
    ]
    T = forward_kinematics(camera_head, [0.3, 0.5, 2.0])
    assert T.homogeneous[:3] == pytest.approx(np.array(printed), abs=1e-6)


@given(four_q)
def test_2009_07_10_rp_arm_position_is_l_c1_minus_q2_s1_l_s1_plus_q2_c1(q):
    q1, q2 = q[:2]
    robot = robot_from_dh([("R", "l", -up, 0, 0), ("P", 0, 0, 0, 0)], parameters={"l": 0.5})
    p = [0.5 * cos(q1) - q2 * sin(q1), 0.5 * sin(q1) + q2 * cos(q1), 0]
    assert position(robot, [q1, q2]) == pytest.approx(p, abs=1e-14)


@pytest.mark.parametrize("q", [[-0.135423, 0.774597], [1.859763, -0.774597]])
def test_2009_07_10_rp_arm_is_at_the_point_for_both_solutions(q):
    robot = robot_from_dh([("R", "l", -up, 0, 0), ("P", 0, 0, 0, 0)], parameters={"l": 0.5})
    assert position(robot, q) == pytest.approx([0.6, 0.7, 0], abs=SAMPLE)


@given(four_q)
def test_2009_06_10_planar_prp_pose_is_q3_s2_q1_minus_q3_c2_turned_by_q2_minus_half_pi(q):
    q1, q2, q3, _ = q
    robot = robot_from_dh(
        [("P", 0, up, 0, 0), ("R", 0, up, 0, 0), ("P", 0, 0, 0, 0)],
        base_placement=turn_and_shift([[1, 0, 0], [0, 0, 1], [0, -1, 0]]),
        tool_placement=turn_and_shift([[0, 1, 0], [0, 0, 1], [1, 0, 0]]),
    )
    T = forward_kinematics(robot, q[:3])
    assert T.translation == pytest.approx([q3 * sin(q2), q1 - q3 * cos(q2), 0], abs=1e-14)
    R = [[sin(q2), cos(q2), 0], [-cos(q2), sin(q2), 0], [0, 0, 1]]
    assert T.rotation == pytest.approx(np.array(R), abs=1e-14)
