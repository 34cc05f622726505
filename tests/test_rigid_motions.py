"""Twists, wrenches, screws and exponentials of poses, against matrices, long arithmetic, Pinocchio and laws."""

from math import cos, pi, sin

import mpmath
import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st
from product_of_exponentials import Ad, bracket
from scipy.linalg import expm

from robotics1 import InputError, frame_jacobian, load_robot
from robotics1.curves import pose_line, screw_path
from robotics1.rigid_motions import adjoint, displacement_screw, pose_exp, pose_log, transform_wrench, twist_screw

T = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.8, 2.0), np.array([0.4, -1.2, 0.7]))
V = np.array([0.3, -0.2, 0.5, 0.7, 0.1, -0.4])
directions = (
    st.tuples(*[st.floats(-1, 1)] * 3).filter(lambda r: np.linalg.norm(r) > 0.1).map(lambda r: r / np.linalg.norm(r))
)
TURNS = [0, 1e-14, 1e-9, 1e-6, 1e-3, 0.1, 1, pi / 2, 3, pi - 1e-3, pi - 1e-6, pi - 1e-9, pi - 1e-12, pi]


def long_pose(V):
    """e^[V] with forty digits, rounded."""
    with mpmath.workdps(40):
        exponential = mpmath.expm(mpmath.matrix(bracket(V).tolist()), method="taylor")
        return np.array(exponential.tolist(), dtype=float)


# --- changes of frame


def test_the_adjoint_moves_twists_as_pinocchio_and_as_conjugation_do():
    assert adjoint(T) == pytest.approx(Ad(T.homogeneous), abs=1e-15)
    assert adjoint(T.homogeneous) @ V == pytest.approx(T.act(pin.Motion(V)).vector, abs=1e-15)
    moved = T.homogeneous @ bracket(V) @ np.linalg.inv(T.homogeneous)
    assert bracket(adjoint(T) @ V) == pytest.approx(moved, abs=1e-15)
    other = pin.SE3(pin.exp3(np.array([1.0, 2, -1])), np.array([1.0, 0, 2]))
    assert adjoint(T * other) == pytest.approx(adjoint(T) @ adjoint(other), abs=1e-14)


def test_with_the_angular_rows_first_the_adjoint_is_lynch_and_parks_r_0_pr_r():
    R, p = T.rotation, T.translation
    P = np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]])
    assert adjoint(T, angular_first=True) == pytest.approx(np.block([[R, np.zeros((3, 3))], [P @ R, R]]), abs=1e-15)


def test_a_wrench_moves_as_force_and_moment_and_keeps_its_power():
    F = np.array([1.0, -2, 0.5, 0.3, 0.2, -0.7])
    moved = transform_wrench(T, F)
    f = T.rotation @ F[:3]
    assert moved == pytest.approx([*f, *(T.rotation @ F[3:] + np.cross(T.translation, f))], abs=1e-15)
    assert moved == pytest.approx(T.act(pin.Force(F)).vector, abs=1e-15)
    assert moved @ (adjoint(T) @ V) == pytest.approx(F @ V, abs=1e-14)
    assert transform_wrench(T, np.roll(F, 3), angular_first=True) == pytest.approx(np.roll(moved, 3), abs=1e-15)


def test_the_apple_in_the_hand_is_lynch_and_parks_example_3_28():
    T_hf = [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]  # the sensor, 10 cm behind the hand
    T_af = [[1, 0, 0, -0.25], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]  # and 25 cm before the apple, turned
    hand, apple = [0, 0, 0, 0, -5, 0], [0, 0, 0, 0, 0, 1.0]
    at_sensor = transform_wrench(np.linalg.inv(T_hf), hand, angular_first=True)
    at_sensor += transform_wrench(np.linalg.inv(T_af), apple, angular_first=True)
    assert at_sensor == pytest.approx([0, 0, -0.5 - 0.25, 0, -5 - 1, 0], abs=1e-15)


# --- exponential and logarithm


@pytest.mark.parametrize("angle", [*TURNS, 4.0, 2 * pi, 50.0])
def test_pose_exp_is_the_exponential_of_the_matrix_of_the_twist_at_every_angle(angle):
    twist = np.concatenate([V[:3], angle * V[3:] / np.linalg.norm(V[3:])])
    assert pose_exp(twist).homogeneous == pytest.approx(long_pose(twist), abs=1e-14)
    assert np.array_equal(pose_exp(np.roll(twist, 3), angular_first=True), pose_exp(twist))


@pytest.mark.parametrize("angle", TURNS)
@given(r=directions)
def test_pose_log_has_all_digits_near_no_turn_and_near_half_a_turn(angle, r):
    twist = np.array([*V[:3], *(angle * r)])
    found = pose_log(long_pose(twist))
    if angle == pi and found[3:] @ r < 0:  # of half a turn both axes are right
        twist = pose_log_with_the_other_axis(twist)
    assert found[3:] == pytest.approx(twist[3:], abs=3e-15, rel=3e-15)
    assert found[:3] == pytest.approx(twist[:3], abs=1e-14)
    assert long_pose(found) == pytest.approx(long_pose(twist), abs=1e-14)


def pose_log_with_the_other_axis(twist):
    """Of half a turn about −r: the slide is the same, and so is the point of the axis."""
    v, w = twist[:3], twist[3:]
    slide = (v @ w) * w / (w @ w)
    return np.array([*(slide - (v - slide)), *-w])


@given(r=directions, angle=st.floats(1e-3, 3.1), p=st.tuples(*[st.floats(-5, 5)] * 3))
def test_pose_log_is_pinocchios_log6_and_the_inverse_of_pose_exp(r, angle, p):
    pose = pin.SE3(pin.exp3(angle * r), np.array(p))
    found = pose_log(pose)
    assert found == pytest.approx(pin.log6(pose).vector, abs=1e-11)
    assert np.array_equal(pose_log(pose, angular_first=True), np.roll(found, 3))
    assert pose_exp(found).homogeneous == pytest.approx(pose.homogeneous, abs=1e-13)
    assert expm(bracket(found)) == pytest.approx(pose.homogeneous, abs=1e-13)


# --- screws


def test_a_turn_about_an_axis_with_a_slide_is_found_again_as_axis_pitch_and_point():
    point, h, angle = np.array([0.5, -0.3, 0.0]), 0.2, 1.3
    R = np.array([[cos(angle), -sin(angle), 0], [sin(angle), cos(angle), 0], [0, 0, 1]])
    screw = displacement_screw(pin.SE3(R, point - R @ point + [0, 0, h * angle]))
    assert screw.axis == pytest.approx([0, 0, 1], abs=1e-15)
    assert screw.point == pytest.approx(point, abs=1e-15)
    assert (screw.angle, screw.pitch, screw.distance) == pytest.approx((angle, h, h * angle), abs=1e-15)
    assert screw.twist == pytest.approx([-0.3, -0.5, h, 0, 0, 1], abs=1e-15)
    assert screw.explain() == (
        "a turn by 1.3000 about the axis through (0.5000, -0.3000, 0) along (0, 0, 1), with a slide by 0.2600: "
        "the pitch is 0.2 m/rad"
    )


@given(r=directions, angle=st.floats(0.01, pi), p=st.tuples(*[st.floats(-5, 5)] * 3))
def test_every_displacement_keeps_the_points_of_its_axis_on_it_and_is_the_exponential_of_its_screw(r, angle, p):
    pose = pin.SE3(pin.exp3(angle * r), np.array(p))
    screw = displacement_screw(pose)
    assert pose.act(screw.point) == pytest.approx(screw.point + screw.distance * screw.axis, abs=1e-11)
    assert screw.point @ screw.axis == pytest.approx(0, abs=1e-11)
    assert pose_exp(screw.twist * screw.angle).homogeneous == pytest.approx(pose.homogeneous, abs=1e-11)


def test_a_slide_alone_has_infinite_pitch_and_no_motion_has_no_axis():
    slide = displacement_screw(pin.SE3(np.eye(3), np.array([0, 3.0, 4.0])))
    assert slide.axis == pytest.approx([0, 0.6, 0.8])
    assert (slide.angle, slide.distance, slide.pitch) == (0, 5, np.inf)
    assert slide.twist == pytest.approx([0, 0.6, 0.8, 0, 0, 0])
    assert "infinite" in slide.explain()
    still = displacement_screw(pin.SE3.Identity())
    assert still.axis is None
    assert np.array_equal(still.twist, np.zeros(6))
    assert "no motion" in still.explain()


def test_the_screw_of_a_column_of_the_space_jacobian_is_the_axis_of_its_joint():
    robot = load_robot("planar_2r")
    q = np.array([0.7, -1.1])
    column = frame_jacobian(robot, q, kind="space", angular_first=True)[:, 1]
    screw = twist_screw(column, angular_first=True)
    elbow = robot.parameters["l1"] * np.array([cos(0.7), sin(0.7), 0])
    assert screw.axis == pytest.approx([0, 0, 1], abs=1e-15)
    assert screw.point == pytest.approx(elbow, abs=1e-15)
    assert (screw.angle, screw.pitch) == pytest.approx((1, 0), abs=1e-15)


# --- screw motion between poses

ENDS = {
    "any": (T, pin.SE3(pin.exp3(np.array([0.5, -1.0, 2.0])), np.array([1.0, 2.0, -0.5]))),
    "half a turn": (T, pin.SE3(T.rotation @ pin.exp3(np.array([0, pi, 0])), np.array([1.0, 2.0, -0.5]))),
    "origin on the axis": (T, pin.SE3(T.rotation @ pin.exp3(np.array([0, 0.6, 0])), T.act(np.array([0, 2.0, 0])))),
    "turn on the spot": (T, pin.SE3(T.rotation @ pin.exp3(np.array([0.4, 0.6, 0])), np.array(T.translation))),
    "slide": (T, pin.SE3(np.array(T.rotation), np.array([1.0, 2.0, -0.5]))),
}


@pytest.mark.parametrize("name", ENDS)
def test_a_screw_path_is_the_exponential_of_a_constant_twist_between_its_ends(name):
    T0, T1 = ENDS[name]
    path = screw_path(T0, T1)
    assert path(0.0).homogeneous == pytest.approx(T0.homogeneous, abs=1e-14)
    assert path(path.end).homogeneous == pytest.approx(T1.homogeneous, abs=1e-14)
    log = pin.log6(T1 * T0.inverse()).vector
    for share in (0.2, 0.5, 0.9):
        if name != "half a turn":
            wanted = expm(bracket(share * log)) @ T0.homogeneous
            assert path(share * path.end).homogeneous == pytest.approx(wanted, abs=1e-13)
        pose, twist = path(share * path.end), path.derivative(share * path.end)
        at_origin = np.array([*(twist[:3] - np.cross(twist[3:], pose.translation)), *twist[3:]])
        start = path.derivative(0.0)
        first = np.array([*(start[:3] - np.cross(start[3:], T0.translation)), *start[3:]])
        assert at_origin == pytest.approx(first, abs=1e-13)
    speed = np.linalg.norm(path.derivative(0.3 * path.end)[: 3 if name != "turn on the spot" else 6])
    assert speed == pytest.approx(1, abs=1e-13)


def test_a_screw_path_is_longer_than_the_line_and_turns_about_the_same_axis():
    T0, T1 = ENDS["any"]
    screw, line = screw_path(T0, T1), pose_line(T0, T1)
    assert screw.end > line.end == pytest.approx(np.linalg.norm(T1.translation - T0.translation))
    assert screw(screw.end / 2).rotation == pytest.approx(line(line.end / 2).rotation, abs=1e-14)


# --- bad input


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: adjoint(np.eye(3)), r"T must have shape \(4, 4\)"),
        (lambda: adjoint(2 * np.eye(4)), "T must have the last row"),
        (lambda: pose_log(np.diag([1, 1, -1, 1])), "T's rotation is no rotation"),
        (lambda: pose_log(pin.SE3(np.eye(3), np.array([1e40, 0, 0]))), "must not be larger than 1e"),
        (lambda: pose_exp([1, 2, 3]), r"V must have shape \(6,\)"),
        (lambda: pose_exp([1e300] * 6), "V must not be larger than 1e"),
        (lambda: transform_wrench(T, [1, 2, 3, 4, 5, np.nan]), "F must be finite"),
        (lambda: twist_screw("V"), r"V must be an array of real numbers of shape \(6,"),
        (lambda: screw_path(T, T), "the pose must change|must be different poses"),
        (lambda: screw_path(T, 3), "T1 must have shape"),
    ],
)
def test_bad_input_says_what_would_be_right(call, words):
    with pytest.raises(InputError, match=words):
        call()


@pytest.mark.parametrize("omega", [1e-320, 1e-200, 1e-30])
def test_the_smallest_turns_make_no_number_that_is_none(omega):
    screw = twist_screw([1.0, 2, 3, omega, 0, 0])
    assert np.isfinite(screw.point).all()
    assert np.isfinite(pose_exp([1.0, 2, 3, omega, 0, 0]).homogeneous).all()
