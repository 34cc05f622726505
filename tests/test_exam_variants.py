"""Exam questions asked of another robot, in other units or of another task, against an independent computation."""

from functools import cache
from itertools import product
from math import pi

import numpy as np
import pytest
from dh_forms import dh_pose
from hypothesis import given, strategies as st
from scipy.integrate import quad
from scipy.spatial import ConvexHull

import robotics1 as r1
from robotics1 import control, curves, singularities, trajectories, workspaces
from robotics1.tasks import CylindricalTask

H = pi / 2
XY, XYZ, POSE = r1.PositionTask("xy"), r1.PositionTask(), r1.PoseTask()
ELBOW = [("R", 0.1, H, 0.4, 0), ("R", 0.5, 0, 0.1, 0), ("R", 0.4, 0, 0, 0)]
SIX = [*ELBOW[:2], ("R", 0.05, H, 0, 0), ("R", 0, -H, 0.45, 0), ("R", 0, H, 0, 0), ("R", 0, 0, 0.1, 0)]
PUMA = [("R", 0, H, 0, 0), ("R", 0.4318, 0, 0, 0), ("R", 0.0203, -H, 0.15005, 0)]
PUMA += [("R", 0, H, 0.4318, 0), ("R", 0, -H, 0, 0), ("R", 0, 0, 0.1, 0)]
POLAR = [("R", 0.1, H, 1, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)]  # with a shoulder offset
seeds = st.integers(0, 999)


def position(rows, q):
    return dh_pose(rows, q, "standard")[:3, 3]


def differences(f, q, h=1e-6):
    return np.array([(f(q + h * e) - f(q - h * e)) / (2 * h) for e in np.eye(len(q))]).T


@pytest.mark.parametrize("rows", [ELBOW, SIX], ids=["3R", "6R"])
def test_the_polytope_of_a_spatial_arm_is_the_hull_of_the_images_of_all_corners(rows):
    """11 June 2011, a: in space, and with more joints than rows."""
    q, most = np.linspace(0.3, 0.9, len(rows)), np.linspace(0.5, 2, len(rows))
    found = singularities.velocity_polytope(r1.robot_from_dh(rows), XYZ, q, velocity=most)
    J = differences(lambda x: position(rows, x), q)
    corners = np.array(list(product(*[(-v, v) for v in most]))) @ J.T
    assert len(found.vertices) == len(ConvexHull(corners).vertices)
    assert found.largest == pytest.approx(np.linalg.norm(corners, axis=1).max(), rel=1e-8)


@pytest.mark.parametrize("unit", [1, 1000])
def test_sixteen_or_eight_solutions_do_not_depend_on_the_unit_of_length(unit):
    """Manseur and Doty, and the IRB 120: a Puma in metres and in millimetres."""
    rows = [(kind, a * unit, alpha, d * unit, theta) for kind, a, alpha, d, theta in PUMA]
    robot, q = r1.robot_from_dh(rows), [0.3, 0.5, -0.4, 0.6, 0.7, 0.2]
    T = dh_pose(rows, q, "standard")
    found = r1.ik_solutions(robot, POSE, T)
    assert len(found) == 8
    assert all(dh_pose(rows, x, "standard") == pytest.approx(T, abs=1e-11 * unit) for x in found.q)
    run = r1.iterate_ik(robot, POSE, T, np.add(q, 0.1), error="body", tolerance={"rad": 1e-9, "m": 1e-9 * unit})
    assert run.require().q == pytest.approx(q, abs=1e-8)


@pytest.mark.parametrize("task", [XYZ, CylindricalTask()], ids=["xyz", "cylindrical"])
@given(seed=seeds)
def test_an_acceleration_law_with_full_gain_matrices_is_its_formula(task, seed):
    """15 June 2010, 1b: a spatial arm, also in cylindrical coordinates."""
    rng, robot = np.random.default_rng(seed), r1.robot_from_dh(ELBOW)
    q, qdot = np.array([0.3, 0.7, -0.4]), rng.uniform(-1, 1, 3)
    r, v, a = np.asarray(task.value(robot, q)) + 0.1, rng.uniform(-1, 1, 3), rng.uniform(-1, 1, 3)
    K, D = np.diag([4.0, 5, 6]) + 0.5, np.diag([3.0, 4, 5])
    wanted = r1.quintic(r, r, 1.0, v0=v, v1=[0] * 3, a0=a, a1=[0] * 3)
    found = control.cartesian_law(robot, task, wanted, K, D).command(q, qdot).joints

    def value(x):
        p = position(ELBOW, x)
        return p if task is XYZ else np.array([np.hypot(p[0], p[1]), np.arctan2(p[1], p[0]), p[2]])

    J, h = differences(value, q), 1e-4
    bend = (value(q + h * qdot) - 2 * value(q) + value(q - h * qdot)) / h**2
    expected = np.linalg.solve(J, a + D @ (v - J @ qdot) + K @ (r - value(q)) - bend)
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-4)


@given(seed=seeds)
def test_largest_gains_of_a_polar_arm_and_of_a_redundant_one_reach_a_rate_limit(seed):
    """10 June 2009, c-b: no single gain can grow while the rates stay within their limits."""
    rng = np.random.default_rng(seed)
    robot, q0, limits = r1.robot_from_dh(POLAR), np.array([0.3, 2.0, 1.1]), np.array([1.5, 1.2, 0.9])
    e, v = rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.2, 0.2, 3)
    p = position(POLAR, q0)
    K = control.largest_gains(robot, XYZ, r1.cubic(p + e, p + e + v, 1.0, v0=v, v1=v), q0, limits=limits)
    J = differences(lambda x: position(POLAR, x), q0)
    rates = np.abs(np.linalg.solve(J, v + K * e)) / limits
    assert rates.max() == pytest.approx(1, abs=1e-6)


@given(seed=seeds)
def test_a_load_at_a_point_of_an_inner_link_is_balanced_by_virtual_work(seed):
    """17 December 2009, 4: a force and a moment on link 4 of a 6R arm, beside its origin."""
    rng = np.random.default_rng(seed)
    q, force, moment, point = rng.uniform(-1, 1, 6), *rng.uniform(-1, 1, (3, 3))
    load = singularities.Load(force, moment, frame="link4", point=point)
    tau = singularities.static_torques(r1.robot_from_dh(SIX), q, load).torque
    inner = SIX[:4]
    J = differences(lambda x: (dh_pose(inner, x[:4], "standard") @ [*point, 1])[:3], q)
    R = dh_pose(inner, q[:4], "standard")[:3, :3]
    spins = [differences(lambda x, i=i: dh_pose(inner, x[:4], "standard")[:3, i], q) for i in range(3)]
    omega = sum(np.cross(R[:, i], spins[i], axis=0) for i in range(3)) / 2
    assert tau == pytest.approx(-(J.T @ force + omega.T @ moment), abs=1e-7)


@pytest.mark.parametrize("quantity", ["velocity", "acceleration"])
def test_timing_bounds_of_a_curve_that_is_no_helix_are_reached_and_not_passed(quantity):
    """12 January 2010, 1a: p = (a cos s, b sin s, c s²)."""
    path = curves.formula_path(["a*cos(s)", "b*sin(s)", "c*s**2"], "s", 5.0, values={"a": 0.4, "b": 0.2, "c": 0.03})
    bounds, s = trajectories.timing_bounds(path, 1.0, 5.0), np.linspace(0, 5, 200_001)
    first = np.array([-0.4 * np.sin(s), 0.2 * np.cos(s), 0.06 * s])
    second = np.array([-0.4 * np.cos(s), -0.2 * np.sin(s), 0.06 + 0 * s])
    if quantity == "velocity":
        assert np.linalg.norm(first, axis=0).max() * bounds.velocity == pytest.approx(1.0)
    else:
        v, a = bounds.velocity, bounds.acceleration
        worst = max(np.linalg.norm(way * a * first + v**2 * second, axis=0).max() for way in (1, -1))
        assert worst == pytest.approx(5.0, abs=1e-6)


def test_the_area_of_a_planar_arm_with_one_elbow_in_millimetres_is_that_of_the_integral_of_det_j():
    robot = r1.robot_from_dh([("R", 400, 0, 0, 0), ("R", 300, 0, 0, 0)], lower=[-1, 0.3], upper=[2, 2.5])
    expected = 3 * quad(lambda q2: 400 * 300 * np.sin(q2), 0.3, 2.5)[0]
    assert workspaces.workspace(robot, XY).area == pytest.approx(expected)


@given(seed=seeds)
def test_least_times_to_each_solution_of_a_spatial_arm_are_those_of_each_joint(seed):
    """11 January 2012, 2a: an elbow arm with four solutions, two or none."""
    rng, robot = np.random.default_rng(seed), r1.robot_from_dh(ELBOW)
    q0, V, A = np.array([0.2, 0.4, 0.6]), np.array([1, 2, 1.5]), np.array([3.0, 2, 4])
    for q in r1.ik_solutions(robot, XYZ, position(ELBOW, rng.uniform(-3, 3, 3))).q:
        d = np.abs(q - q0)
        times = np.where(d >= V**2 / A, d / V + V / A, 2 * np.sqrt(d / A))
        found = r1.minimum_time(q0, q, r1.MotionLimits(V, A), coordination="independent")
        assert found.joint_durations == pytest.approx(times)


def test_a_spline_that_begins_later_in_metres_and_millimetres_is_scipys():
    """Biagiotti and Melchiorri, 4.4, of two joints, with a velocity at one end and an acceleration at the other."""
    from scipy.interpolate import CubicSpline

    t, points = [2, 5, 7, 8], [[0, 1000], [1, 1100], [2, 900], [1, 950]]
    found = trajectories.cubic_spline(t, points, v0=[0.1, 5], a1=[0, 2])
    peer, at = CubicSpline(t, points, bc_type=((1, [0.1, 5]), (2, [0, 2]))), np.linspace(2, 8, 50)
    assert all(found.derivative(at, k) == pytest.approx(peer(at, k)) for k in range(3))


@pytest.mark.parametrize("lengths", [(0.6, 0.5, 0.2), (0.3, 0.9, 0.1), (1, 0.2, 0.3)])
def test_every_orientation_is_possible_where_the_circle_of_the_last_joint_is_reached(lengths):
    """11 January 2012, 1b."""
    l1, l2, l3 = lengths
    radii = workspaces.dexterous_workspace(r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths]), XY).radii
    angles = np.linspace(0, 2 * pi, 721)
    for r in np.linspace(0.0005, 2, 400):
        distance = np.hypot(r - l3 * np.cos(angles), l3 * np.sin(angles))
        possible = ((distance <= l1 + l2) & (distance >= abs(l1 - l2))).all()
        assert possible == any(low <= r <= high for low, high in radii)


@cache
def limited_elbow():
    robot = r1.robot_from_dh(ELBOW, lower=[-2, -1, -2], upper=[2, 1.5, 2.0])
    return robot, workspaces.workspace(robot, XYZ)


@given(seed=seeds)
def test_a_point_is_reached_where_an_inverse_solution_is_within_the_limits(seed):
    """25 February 2011, b: an elbow arm with offsets and limits."""
    robot, ws = limited_elbow()
    p = np.random.default_rng(seed).uniform(-1.2, 1.2, 3)
    inside = any(robot.within_limits(q) for q in r1.ik_solutions(robot, XYZ, p).q)
    assert workspaces.is_reached(ws, p).inside == inside
