"""Orientations and poses along a parameter: fixed axis, Euler angles, Frenet frame; twists and their derivatives."""

from math import cos, pi, sin

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation, Slerp

import robotics1 as r1
from robotics1 import InputError

HELIX = r1.curves.helix_path([0, 0, 0], [0.3, 0, 0], 0.2 * pi, 1.5)
LINE = r1.line_path([1, 0, 0], [0, 2, 1])
angles = st.floats(-3.1, 3.1)


def random_rotation(seed):
    return Rotation.random(random_state=seed).as_matrix()


CURVED = r1.trajectories.spline_path([[0.1, 0.5, -0.3], [0.6, 0.9, 0.4], [1.0, 0.4, 0.8]])
ORIENTATIONS = {
    "fixed axis": r1.curves.slerp_path(random_rotation(1), random_rotation(2)),
    "long way": r1.curves.slerp_path(random_rotation(1), random_rotation(2), long_way=True),
    "turn": r1.curves.turn_path(random_rotation(3), [1, 2, 3], -7.0),
    "ZYZ": r1.curves.euler_path("ZYZ", [[0.1, 0.5, -0.3], [1.0, 1.4, 0.8]]),
    "curved XYZ": r1.curves.euler_path("XYZ", CURVED),
    "fixed Z-YX": r1.curves.euler_path("Z-YX", CURVED, fixed=True),
    "Frenet": r1.curves.frenet_path(
        r1.trajectories.spline_path([[0, 0, 0], [1, 1, 0], [2, 0, 1], [1, -1, 2]], bc_type="not-a-knot")
    ),
    "Frenet of a helix": r1.curves.frenet_path(HELIX),
}


def clear_of_breaks(course, count=7):
    places = np.linspace(0, course.end, count + 2)[1:-1] + 0.00123 * course.end
    ends = np.array([0, *course.breakpoints, course.end])
    return [float(x) for x in places if np.abs(ends - x).min() > 0.02 * course.end]


def turning(R, x, h):
    """ω of dR/dx = [ω]× R, by central differences of fourth order."""
    dR = (8 * (R(x + h) - R(x - h)) - (R(x + 2 * h) - R(x - 2 * h))) / (12 * h)
    W = dR @ R(x).T
    assert pytest.approx(-W.T, abs=1e-7) == W
    return np.array([W[2, 1], W[0, 2], W[1, 0]])


@pytest.mark.parametrize("name", ORIENTATIONS)
def test_the_rate_of_an_orientation_is_the_angular_velocity_and_its_rates_are_derivatives(name):
    course = ORIENTATIONS[name]
    h = 3e-4 * course.end
    for x in clear_of_breaks(course):
        assert course(x) @ course(x).T == pytest.approx(np.eye(3), abs=1e-12)
        assert course.derivative(x) == pytest.approx(turning(course, x, h), abs=1e-7)
        for order in (2, 3):
            f = lambda y, order=order: course.derivative(y, order - 1)  # noqa: E731
            found = (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h)
            assert course.derivative(x, order) == pytest.approx(found, abs=1e-6 * (1 + np.abs(found).max()))
    several = course(np.array([0.0, course.end]))
    assert several.shape == (2, 3, 3)
    assert course.derivative(np.array([0.0, course.end])).shape == (2, 3)


@given(st.integers(0, 200), st.floats(0, 1))
def test_fixed_axis_is_the_spherical_interpolation_of_quaternions(seed, part):
    R0, R1 = random_rotation(seed), random_rotation(seed + 1000)
    path = r1.curves.slerp_path(R0, R1)
    slerp = Slerp([0, 1], Rotation.from_matrix([R0, R1]))
    assert path(part * path.end) == pytest.approx(slerp(part).as_matrix(), abs=1e-10)
    other = r1.curves.slerp_path(R0, R1, long_way=True)
    assert other.end == pytest.approx(2 * pi - path.end)
    assert other(other.end) == pytest.approx(R1, abs=1e-10)


@pytest.mark.parametrize("axis", [[0, 0, 1], [1, 0, 0], [0.6, 0, 0.8], [-2 / 3, 2 / 3, 1 / 3]])
def test_a_half_turn_arrives_both_ways_about_opposite_axes(axis):
    axis = np.array(axis)
    R1 = 2 * np.outer(axis, axis) - np.eye(3)
    one, other = (r1.curves.slerp_path(np.eye(3), R1, long_way=way) for way in (False, True))
    assert one.angle == pytest.approx(pi)
    assert other.angle == pytest.approx(pi)
    assert abs(one.axis @ axis) == pytest.approx(1)
    assert one.axis == pytest.approx(-other.axis)
    assert one(one.end) == pytest.approx(R1, abs=1e-12)
    assert other(other.end) == pytest.approx(R1, abs=1e-12)


def test_the_axis_of_a_turn_is_told_in_world_axes():
    R0 = random_rotation(5)
    path = r1.curves.slerp_path(R0, R0 @ pin.exp3(np.array([0, 0.4, 0])))  # about its own y
    assert path.axis == pytest.approx(R0[:, 1])
    assert path.end == pytest.approx(0.4)
    many = r1.curves.turn_path(np.eye(3), [0, 0, 2], -5 * pi)
    assert many(2.5) == pytest.approx(pin.exp3(np.array([0, 0, -2.5])))
    assert many.end == pytest.approx(5 * pi)


@given(angles, angles, angles)
def test_euler_angles_go_straight_in_their_space(a, b, c):
    if np.linalg.norm([a - 0.2, b, c + 1]) < 1e-3:
        return
    path = r1.curves.euler_path("ZYX", [[a, b, c], [0.2, 0, -1]])
    middle = np.array([a + 0.2, b, c - 1]) / 2
    assert path(path.end / 2) == pytest.approx(r1.orientation.euler_to_rotation("ZYX", middle), abs=1e-12)


def test_frenet_orientation_of_a_helix_turns_with_tau_t_plus_kappa_b():
    r, h = 0.3, 0.1
    path, x = r1.curves.frenet_path(HELIX), 0.4
    u, n = x / np.hypot(r, h), np.hypot(r, h)
    t, b = np.array([-r * sin(u), r * cos(u), h]) / n, np.array([h * sin(u), -h * cos(u), r]) / n
    assert path(x)[:, 0] == pytest.approx(t)
    assert path(x)[:, 2] == pytest.approx(b)
    assert path.derivative(x) == pytest.approx((h * t + r * b) / n**2)
    assert path.derivative(x) == pytest.approx([0, 0, 1 / n])  # the helix turns about its axis
    assert path.derivative(x, 2) == pytest.approx(np.zeros(3), abs=1e-9)


# --- poses


def test_a_pose_line_goes_straight_and_turns_about_one_axis_in_the_same_time():
    T0 = pin.SE3(random_rotation(1), np.array([1, 0, 0.0]))
    T1 = pin.SE3(random_rotation(2), np.array([1, 3, 4.0]))
    path = r1.curves.pose_line(T0, T1.homogeneous)
    turn = r1.curves.slerp_path(T0.rotation, T1.rotation)
    assert path.end == 5
    assert path(0.0).isApprox(T0, 1e-12)
    assert path(5.0).isApprox(T1, 1e-12)
    half = path(2.5)
    assert half.translation == pytest.approx([1, 1.5, 2])
    assert half.rotation == pytest.approx(turn(turn.end / 2))
    assert path.derivative(1.0) == pytest.approx([0, 0.6, 0.8, *(turn.axis * turn.end / 5)])
    assert path.derivative(1.0, 2) == pytest.approx(np.zeros(6))


def test_a_pose_that_only_turns_or_only_moves():
    T0, T1 = pin.SE3.Identity(), pin.SE3(pin.exp3(np.array([0, 0, 1.2])), np.zeros(3))
    turning_only = r1.curves.pose_line(T0, T1)
    assert turning_only.end == pytest.approx(1.2)
    assert turning_only.derivative(0.3) == pytest.approx([0, 0, 0, 0, 0, 1])
    moving_only = r1.curves.pose_line(T0, pin.SE3(np.eye(3), np.array([0, 2.0, 0])))
    assert moving_only.derivative(0.3) == pytest.approx([0, 1, 0, 0, 0, 0])
    assert moving_only.derivative(0.3, 2) == pytest.approx(np.zeros(6))


@pytest.mark.parametrize("name", ["curved XYZ", "Frenet of a helix", "fixed axis"])
def test_the_twist_of_a_pose_in_time_is_its_derivative(name):
    path = r1.curves.PosePath(
        r1.curves.by_arc_length(r1.curves.ellipse_path([0, 0, 1], [2, 0, 0], [0, 0, 1])), ORIENTATIONS[name]
    )
    motion = r1.curves.PathTrajectory(path, r1.cubic([0], [path.end], 2.0).joint(0))
    h = 2e-4
    for t in (0.3, 0.9, 1.37):
        p = lambda x: motion(x).translation  # noqa: E731
        v = (8 * (p(t + h) - p(t - h)) - (p(t + 2 * h) - p(t - 2 * h))) / (12 * h)
        twist = motion.velocity(t)
        assert twist[:3] == pytest.approx(v, abs=1e-7)
        assert twist[3:] == pytest.approx(turning(lambda x: motion(x).rotation, t, h), abs=1e-7)
        f, g = motion.velocity, motion.acceleration
        a = (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)
        assert g(t) == pytest.approx(a, abs=1e-6)
        j = (8 * (g(t + h) - g(t - h)) - (g(t + 2 * h) - g(t - 2 * h))) / (12 * h)
        assert motion.jerk(t) == pytest.approx(j, abs=1e-5)


def test_breaks_of_a_pose_are_those_of_its_position_and_its_orientation():
    orientation = r1.curves.euler_path("XYZ", CURVED)
    corner = r1.curves.polyline_path([[0, 0, 0], [1, 0, 0], [1, 1, 0]])
    path = r1.curves.PosePath(corner, orientation)
    expected = sorted([1.0, orientation.breakpoints[0] * 2 / orientation.end])
    assert path.breakpoints == pytest.approx(expected)
    assert path.derivative(1.0, side="left")[:3] == pytest.approx([1, 0, 0])
    still = r1.curves.PosePath([1, 2, 3], orientation)
    assert still.end == orientation.end
    assert still(0.1).translation == pytest.approx([1, 2, 3])
    assert still.derivative(0.1)[:3] == pytest.approx([0, 0, 0])


def test_an_orientation_alone_moves_in_time():
    course = ORIENTATIONS["ZYZ"]
    motion = r1.curves.PathTrajectory(course, r1.cubic([0], [course.end], 2.0).joint(0))
    assert motion(0.7).shape == (3, 3)
    assert motion.velocity(0.7) == pytest.approx(turning(motion, 0.7, 2e-4), abs=1e-7)


IDENTITY = np.eye(3)
MISUSE = [
    (lambda: r1.curves.pose_line(np.eye(4), np.eye(4)), "different poses"),
    (lambda: r1.curves.pose_line(np.eye(3), np.eye(4)), r"T0 must have shape \(4, 4\)"),
    (lambda: r1.curves.pose_line(np.eye(4), 2 * np.eye(4)), "T1"),
    (lambda: r1.curves.PosePath([0, 0, 0], r1.curves.slerp_path(IDENTITY, IDENTITY)), "the pose must change"),
    (lambda: r1.curves.PosePath(LINE, LINE), "orientation must be such as slerp_path"),
    (
        lambda: r1.curves.PosePath(r1.line_path([0, 0], [1, 1]), r1.curves.turn_path(IDENTITY, [0, 0, 1], 1)),
        "path of 3 coordinates",
    ),
    (
        lambda: r1.curves.PosePath([0, 0], r1.curves.turn_path(IDENTITY, [0, 0, 1], 1)),
        r"position must have shape \(3,\)",
    ),
    (lambda: r1.curves.slerp_path(IDENTITY, IDENTITY, long_way=True), "has no axis"),
    (lambda: r1.curves.slerp_path(2 * IDENTITY, IDENTITY), "R0 is no rotation"),
    (lambda: r1.curves.slerp_path(IDENTITY, -IDENTITY), "R1 is a reflection"),
    (lambda: r1.curves.turn_path(IDENTITY, [0, 0, 0], 1.0), "axis must have a direction"),
    (lambda: r1.curves.euler_path("ZZX", [[0, 0, 0], [1, 1, 1]]), "consecutive axes"),
    (lambda: r1.curves.euler_path("ZYX", [[0, 0, 0]]), "the first and the last angles"),
    (lambda: r1.curves.euler_path("ZYX", r1.line_path([0, 0], [1, 1])), "path of 3 coordinates; it has 2"),
    (lambda: r1.curves.euler_path("ZYX", [[0, 0, 0], [0, 0, 0]]), "different points"),
    (lambda: ORIENTATIONS["ZYZ"].derivative(0.1, 4), "up to the third"),
    (lambda: r1.curves.frenet_path(LINE), "straight"),
    (lambda: r1.curves.frenet_path("helix"), "path of points"),
    (lambda: ORIENTATIONS["turn"](7.1), r"the parameter must be in \[0, 7\]"),
]


@pytest.mark.parametrize(("call", "message"), MISUSE, ids=range(len(MISUSE)))
def test_misuse_of_poses_along_paths_is_an_input_error(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_the_position_may_close_while_the_orientation_makes_a_quarter():
    circle = r1.curves.circle_path([0, 0, 1], 0.5)
    path = r1.curves.PosePath(circle, r1.curves.turn_path(IDENTITY, [0, 0, 1], pi / 2))
    assert path(path.end).translation == pytest.approx([0.5, 0, 1])
    assert path(path.end).rotation[:, 0] == pytest.approx([0, 1, 0], abs=1e-12)
    assert path.derivative(0.0) == pytest.approx([0, 1, 0, 0, 0, pi / 2 / circle.end])
    assert path(circle.end / 2).rotation[0, 0] == pytest.approx(cos(pi / 4))
