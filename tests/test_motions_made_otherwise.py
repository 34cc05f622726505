"""Motions of constant accelerations or jerks, in a basis, at a later time; instants of values; speeds along paths."""

from math import sqrt

import numpy as np
import pytest
import sympy
from arms import arm

import robotics1 as r1

q0, q1 = sympy.symbols("q0 q1", real=True)


def test_constant_accelerations_make_parabolas():
    motion = r1.trajectories.motion_of_accelerations(0.5, [1, 2, 1], [2, 0, -2], v0=0.1)
    assert motion.duration == 4
    assert motion.velocity([0, 1, 3, 4])[:, 0] == pytest.approx([0.1, 2.1, 2.1, 0.1])
    assert motion(4.0) == pytest.approx([0.5 + 0.1 * 4 + 1 + 4 + 1])
    two = r1.trajectories.motion_of_accelerations([0, 1], [1, 1], [[1, 2], [-1, 0]])
    assert two(2.0) == pytest.approx([1, 1 + 1 + 2])


def test_constant_jerks_are_the_phases_of_a_double_s():
    law = r1.minimum_time(0, 3, r1.MotionLimits(2, 4, 10), "double_s").laws[0]
    phases = [p for p in law.phases if p.duration > 0]
    motion = r1.trajectories.motion_of_jerks(0, [p.duration for p in phases], [p.jerk for p in phases])
    t = np.linspace(0, law.duration, 50)
    for order in (0, 1, 2):
        assert motion.derivative(t, order)[:, 0] == pytest.approx(law.derivative(t, order), abs=1e-9)


def test_a_motion_in_a_basis_meets_its_conditions_exactly():
    basis, conditions = ["1", "t", "sin(pi*t/T)"], [(0, 0, "q0"), ("T", 0, "q1"), (0, 1, 0)]
    found = r1.trajectories.motion_in_basis(basis, conditions, "T")
    t, Tr = sympy.symbols("t T", real=True)
    expected = q0 + (q1 - q0) * (t / Tr - sympy.sin(sympy.pi * t / Tr) / sympy.pi)
    assert sympy.simplify(found.formula[0] - expected) == 0
    with pytest.raises(r1.InputError, match="duration has no number"):
        _ = found.curve
    numbers = r1.trajectories.motion_in_basis(basis, conditions, "T", values={"T": 2, "q0": 1, "q1": 3}).curve
    assert numbers(2.0) == pytest.approx([3])
    assert numbers.velocity(0.0) == pytest.approx([0], abs=1e-15)
    joints = r1.trajectories.motion_in_basis(["1", "cos(2*pi*t/2)"], [(0, 0, [1, 2]), (1, 0, [3, 2])], 2).curve
    assert joints([0.0, 1.0]) == pytest.approx(np.array([[1, 2], [3, 2]]))
    with pytest.raises(r1.InputError, match="do not determine"):
        r1.trajectories.motion_in_basis(["1", "2"], [(0, 0, 1), (1, 0, 2)], 2)
    with pytest.raises(r1.InputError, match="as many conditions"):
        r1.trajectories.motion_in_basis(["1", "t"], [(0, 0, 1)], 2)


# --- instants


def test_the_instant_of_a_value_is_the_inverse_of_the_law():
    law = r1.minimum_time(0, 3, r1.MotionLimits(1, 1)).laws[0]
    assert r1.trajectories.time_of(law, 0.5) == pytest.approx(1)
    assert r1.trajectories.time_of(law, 1.5) == pytest.approx(2)
    assert r1.trajectories.time_of(law, 3) == pytest.approx(4)
    assert r1.trajectories.time_of(law, 0) == 0
    for t in np.linspace(0.1, 3.9, 7):
        assert r1.trajectories.time_of(law, law(t)) == pytest.approx(t, abs=1e-9)
    assert r1.trajectories.time_of(r1.trajectories.cycloidal(0, 2, 3), 1) == pytest.approx(1.5)
    with pytest.raises(r1.InputError, match="between 0 and 3"):
        r1.trajectories.time_of(law, 3.1)


@pytest.mark.parametrize("name", ["cubic", "quintic", "septic", "cosine", "cycloidal"])
@pytest.mark.parametrize("T", [1e-4, 2.0, 1e5])
def test_a_law_takes_its_last_value_at_its_end_however_flat_it_is_there(name, T):
    law = getattr(r1.trajectories, name)(1, -3, T)
    assert r1.trajectories.time_of(law, -3) == T
    assert r1.trajectories.time_of(law, 1) == 0
    assert r1.trajectories.time_of(law, -1) == pytest.approx(T / 2, rel=1e-9)
    assert r1.trajectories.time_of(law, float(law(0.9 * T)[0])) == pytest.approx(0.9 * T, rel=1e-7)


def test_a_value_that_is_taken_twice_has_a_first_and_a_later_instant():
    there_and_back = r1.trajectories.motion_of_accelerations(0, [1, 2, 1], [2, -2, 2]).joint()
    assert r1.trajectories.time_of(there_and_back, 1) == pytest.approx(1)
    assert r1.trajectories.time_of(there_and_back, 1, after=1.5) == pytest.approx(3)
    assert r1.trajectories.time_of(there_and_back, 2) == pytest.approx(2, abs=1e-6)  # where it only touches


def test_a_spline_may_begin_at_any_time():
    times, points = np.array([2.0, 3, 5]), [[0, 1], [1, -1], [0, 2]]
    later, from_0 = r1.cubic_spline(times, points), r1.cubic_spline(times - 2, points)
    assert (later.start, later.end, later.duration) == (2, 5, 3)
    t = np.linspace(2, 5, 9)
    for order in range(4):
        assert later.derivative(t, order) == pytest.approx(from_0.derivative(t - 2, order))
    assert later(times) == pytest.approx(np.array(points, dtype=float))
    assert later.peak(1).time == pytest.approx(2 + from_0.peak(1).time)
    assert later.breakpoints == pytest.approx([3])
    with pytest.raises(r1.InputError, match=r"\[2, 5\]"):
        later(1.0)
    scaled, expected = (r1.trajectories.scale_to_limits(x, r1.MotionLimits(velocity=0.5)) for x in (later, from_0))
    assert scaled.factor == expected.factor
    others = [
        r1.trajectories.cubic_hermite_spline(times, points),
        r1.trajectories.polynomial_spline(times, points, (4, 4)),
        r1.trajectories.virtual_point_spline(times, points),
    ]
    for other in others:
        assert other(times) == pytest.approx(np.array(points, dtype=float))
    assert r1.cubic_spline(times - 5, points).start == -3


# --- along paths


def test_tangential_and_normal_bounds_of_a_circle():
    circle = r1.curves.circle_path([0, 0], 0.5)
    found = r1.trajectories.timing_bounds(circle, tangential=1.5, normal=2)
    v = sqrt(2 * 0.5)
    speed = 1.0 if circle.is_unit_speed else np.linalg.norm(circle.derivative(0.0))
    assert found.velocity * speed == pytest.approx(v)
    assert found.acceleration * speed == pytest.approx(1.5)
    slower = r1.trajectories.timing_bounds(circle, 0.4, tangential=1.5, normal=2)
    assert slower.velocity * speed == pytest.approx(0.4)


def test_tangential_and_normal_bounds_of_an_ellipse_hold_at_every_point():
    path = r1.curves.ellipse_path([0, 0], [2, 0], [0, 1])
    found = r1.trajectories.timing_bounds(path, tangential=9, normal=2)
    s = np.linspace(0, path.end, 400)
    d1, d2 = path.derivative(s, 1), path.derivative(s, 2)
    speed = np.linalg.norm(d1, axis=1)
    across = np.abs(np.cross(np.c_[d1, 0 * s], np.c_[d2, 0 * s])[:, 2]) / speed * found.velocity**2
    assert across.max() == pytest.approx(2, rel=1e-4)
    along = np.abs(np.sum(d1 * d2, axis=1)) / speed * found.velocity**2 + speed * found.acceleration
    assert along.max() == pytest.approx(9, rel=1e-4)


def test_bounds_that_cannot_be_are_refused():
    bounds = r1.trajectories.timing_bounds
    line, circle = r1.line_path([0, 0], [1, 1]), r1.curves.circle_path([0, 0], 0.5)
    with pytest.raises(r1.InputError, match="straight"):
        bounds(line, tangential=1, normal=1)
    assert bounds(line, 2, tangential=1, normal=1).velocity * line.speed(np.zeros(1))[0] == pytest.approx(2)
    with pytest.raises(r1.InputError, match="give acceleration="):
        bounds(circle, 1, tangential=1)
    with pytest.raises(r1.InputError, match="whole acceleration"):
        bounds(circle, 1, 2, tangential=1, normal=1)
    with pytest.raises(r1.InputError, match="lower the velocity"):
        bounds(r1.curves.ellipse_path([0, 0], [2, 0], [0, 1]), tangential=0.01, normal=2)
    with pytest.raises(r1.InputError, match="velocity"):
        bounds(circle, None, 2)


XY = r1.PositionTask("xy")
TWO_R = r1.textbook_robots.planar_arm("RR", [1, 1])


def test_the_largest_speed_along_a_line_is_decided_by_one_joint_at_one_place():
    line = r1.line_path([1.5, -0.6], [1.5, 0.6])
    found = r1.trajectories.speed_along_path(TWO_R, XY, line, [-1, 1.3], velocity=[1, 2])
    s = np.linspace(0, line.end, 4001)
    limits = []
    for x in s:  # by the cosine rule
        p = line(x)
        c2 = (p @ p - 2) / 2
        q2 = np.arccos(c2)
        q1 = np.arctan2(p[1], p[0]) - np.arctan2(np.sin(q2), 1 + c2)
        rho = np.linalg.solve(XY.jacobian(TWO_R, [q1, q2]), line.derivative(x))
        limits.append(1 / (np.abs(rho) / [1, 2]).max())  # a joint may stand still
    assert found.speed == pytest.approx(min(limits), rel=1e-6)
    assert found.speed_at == pytest.approx(s[int(np.argmin(limits))], abs=1e-3)
    assert found.least_time == pytest.approx(np.trapezoid(1 / np.array(limits), s), rel=1e-4)
    assert found.uniform_time == pytest.approx(line.end / found.speed)
    assert found.joint_path(found.s) == pytest.approx(found.q)
    assert found.speed_joint in found.explain()


def test_with_accelerations_the_joint_path_goes_to_the_fastest_law():
    pytest.importorskip("toppra")
    line = r1.line_path([1.5, -0.6], [1.5, 0.6])
    found = r1.trajectories.speed_along_path(TWO_R, XY, line, [-1, 1.3], velocity=[1, 2], samples=60)
    timed = r1.trajectories.time_optimal(found.joint_path, r1.MotionLimits([1, 2], [5, 5]), grid=60)
    assert timed.duration > found.least_time
    q = timed.trajectory(timed.duration / 3)
    assert XY.value(TWO_R, q)[0] == pytest.approx(1.5, abs=1e-5)


def test_a_pose_path_of_a_six_axis_arm_has_its_largest_speed():
    robot = arm("six_r")
    q0 = np.array([0.3, 0.4, 0.5, 0.6, 0.7, 0.8])
    start = r1.forward_kinematics(robot, q0)
    end = r1.forward_kinematics(robot, q0 + 0.2)
    found = r1.trajectories.speed_along_path(
        robot, r1.PoseTask(), r1.curves.pose_line(start, end), q0, velocity=1.0, samples=40
    )
    rates = np.abs(np.gradient(found.q, found.s, axis=0, edge_order=2)).max(axis=1)
    assert 1 / rates == pytest.approx(found.limit, rel=1e-2)
    assert r1.forward_kinematics(robot, found.q[-1]).homogeneous == pytest.approx(end.homogeneous, abs=1e-8)


def test_a_path_that_leaves_the_workspace_says_where():
    with pytest.raises(r1.TaskError, match=r"cannot be followed|singular"):
        r1.trajectories.speed_along_path(TWO_R, XY, r1.line_path([1, 0], [3, 0]), [-1, 2], velocity=1)
    with pytest.raises(r1.InputError, match="no joint has a bound"):
        r1.trajectories.speed_along_path(TWO_R, XY, r1.line_path([1, 0], [1, 1]), [-1, 2])
    with pytest.raises(r1.InputError, match="with 2 rows"):
        r1.trajectories.speed_along_path(TWO_R, XY, r1.line_path([1, 0, 0], [1, 1, 0]), [-1, 2], velocity=1)
