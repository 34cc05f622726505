"""Curves of solutions at singular targets of six joints: whole, where they cross too, with tangents, cut by limits."""

from collections import Counter
from functools import cache
from math import pi

import numpy as np
import pytest
from brute_force import all_solutions, apart, curves_of_equal
from sweeps import core_first
from test_all_solutions import ANTHROPOMORPHIC, CYLINDRICAL, POSE, PUMA, STANFORD, UR5, XYZ, H, R, robot_of

from robotics1 import forward_kinematics, ik_solutions, robot_from_dh
from robotics1.ik import IKStatus, SolutionSolver
from robotics1.ik.families import Families
from robotics1.ik.prepared import prepare
from robotics1.ik.solution_search import SolutionSearch

UPPER, FOREARM = 0.5, 0.4
TURN = np.linspace(0, 2 * pi, 720, endpoint=False)
ELBOW = [R(0, H, 0.3), R(UPPER, 0, 0), R(0, H, 0), R(0, -H, FOREARM), R(0, H, 0), R(0, 0, 0.1)]


def over_the_shoulder(q3, q4, q5):
    """q of ELBOW with the centre of its wrist on the first axis: a₂ c₂ + d₄ s₂₃ = 0."""
    q2 = np.arctan2(-(UPPER + FOREARM * np.sin(q3)), FOREARM * np.cos(q3))
    return np.array([0.3, q2, q3, q4, q5, 0.2])


CASES = {
    "wrist": (PUMA, np.array([0.3, 0.7, -0.4, 0.5, 0, 0.2]), 4),
    "wrist behind a slide": (STANFORD, np.array([0.3, 0.7, 0.9, 0.5, 0, 0.2]), None),
    "shoulder": (ELBOW, over_the_shoulder(0.9, 0.5, 0.7), 4),
    "shoulder and wrist": (ELBOW, over_the_shoulder(0.9, 0.5, 0), 4),
    "shoulder and elbow": (ELBOW, over_the_shoulder(H, 0.5, 0.4), 2),
    "wrist and elbow": (ELBOW, np.array([0.3, 0.7, H, 0.5, 0, 0.2]), 2),
    "three parallel axes": (UR5, np.array([0.3, -0.7, 0.9, 0.5, 0, 0.2]), 2),
    "three parallel axes, stretched": (UR5, np.array([0.3, -0.7, 0, 0.5, 0, 0.2]), 1),
}


@cache
def solved(case):
    rows, q, _ = CASES[case]
    robot = robot_of(rows)
    target = POSE.value(robot, q)
    found = ik_solutions(robot, POSE, target, starts=5)
    assert (found.status, found.dimension) == (IKStatus.INFINITE, 1)
    return robot, target, found


@pytest.mark.parametrize("case", CASES)
def test_every_solution_that_brute_force_finds_is_beside_one_of_a_curve(case):
    rows, q, _ = CASES[case]
    _, target, found = solved(case)
    kinds = [row[0] for row in rows]
    for p in [q, *all_solutions(rows, target.homogeneous, range(6), starts=120)]:
        assert apart(kinds, p, found.q).min() < 0.2


@pytest.mark.parametrize("case", CASES)
def test_tangents_are_unit_vectors_that_the_jacobian_takes_to_zero(case):
    robot, target, found = solved(case)
    alone = np.linalg.norm(found.tangents, axis=1) == 0
    assert np.array_equal(alone, ~found.singular)
    assert np.linalg.norm(found.tangents[~alone], axis=1) == pytest.approx(1.0)
    for p, t in zip(found.q[~alone], found.tangents[~alone], strict=True):
        assert np.abs(POSE.jacobian(robot, p) @ t).max() < 1e-6
        ahead = p + 1e-4 * t
        assert np.abs(POSE.error(robot, ahead, target)).max() < 1e-7  # of the second order


def test_where_two_families_cross_both_are_followed():
    _, _, found = solved("shoulder and wrist")
    equations = [" ".join(family) for family in found.families]
    assert len(equations) == 4
    assert sum("q5 = 0" in text and "q4 + q6" in text for text in equations) == 2
    assert sum("q1" not in text for text in equations) == 2


def test_both_curves_that_cross_where_a_four_bar_is_flat_have_the_tangents_of_the_second_order():
    """With four parallel axes in one plane the rates φ of the links between them are Σ l φ = 0 and Σ l φ² = 0."""
    for l1, l2, l3 in np.random.default_rng(1).uniform([0.3, 0.3, 0.1], [0.6, 0.6, 0.25], (8, 3)):
        robot = robot_of([R(0, H, 0.3), R(l1, 0, 0), R(l2, 0, 0), R(0, H, 0.1), R(0, -H, l3), R(0, 0, 0.1)])
        q = np.array([0.3, -0.7, 0, -H, 0, 0.2])  # the third link points back
        problem = prepare(robot, POSE).problem
        families = Families(problem, SolutionSearch(problem, POSE.value(robot, q)), lambda p: p, lambda p: p)
        Vt = np.linalg.svd(problem.jacobian(q))[2]
        angles = np.array(families._tangents(q))[:, None]
        phi = np.cumsum((np.cos(angles) * Vt[-1] + np.sin(angles) * Vt[-2])[:, 1:4], axis=1)
        found = phi[:, 1] / phi[:, 0]
        expected = np.roots([l2 - l2**2 / l3, -2 * l1 * l2 / l3, l1 - l1**2 / l3])
        assert np.isreal(expected).all()
        assert all(np.abs(found - ratio).min() < 1e-5 for ratio in expected)


@pytest.mark.parametrize(
    "case", ["wrist", "wrist behind a slide", "shoulder", "three parallel axes", "three parallel axes, stretched"]
)
def test_families_that_do_not_cross_are_complete(case):
    assert solved(case)[2].complete


@pytest.mark.parametrize("case", ["shoulder and wrist", "wrist and elbow"])
def test_families_that_cross_or_are_double_are_not_said_to_be_all(case):
    assert not solved(case)[2].complete


@pytest.mark.parametrize("seed", core_first(range(10), [0, 3]))
def test_a_wrist_follows_the_shoulder_along_as_many_curves_as_a_spherical_four_bar_has(seed):
    """Axes 1, 4, 5 and 6 go through one point; cos d = cos a cos b + sin a sin b cos θ for each pair of arcs."""
    rng = np.random.default_rng(seed)
    twists = rng.uniform(0.3, 2.8, 2)
    robot = robot_of([*ELBOW[:3], R(0, -twists[0], FOREARM), R(0, twists[1], 0), R(0, 0, 0.1)])
    q = over_the_shoulder(rng.uniform(-3, 3), *rng.uniform(-3, 3, 2))
    z = axes_of(robot, q)[0][[0, 3, 4, 5]]
    a, b, c, d = np.arccos((z * np.roll(z, -1, axis=0)).sum(axis=1))
    turns = np.cos(TURN)
    first, second = (np.cos(s) * np.cos(t) + np.sin(s) * np.sin(t) * turns for s, t in ((b, c), (d, a)))
    assert_as_many_curves(robot, q, curves_of_equal(first, second), ("q2", "q3"))


@pytest.mark.parametrize("seed", core_first(range(10), [0, 1]))
def test_four_parallel_axes_move_along_as_many_curves_as_a_planar_four_bar_has(seed):
    """Axes 2, 3, 4 and 6 are parallel; d² = a² + b² + 2 a b cos θ for each pair of links."""
    rng = np.random.default_rng(seed)
    l1, l2, l3 = rng.uniform([0.2, 0.2, 0.05], [0.6, 0.6, 0.5])
    robot = robot_of([R(0, H, 0.1), R(l1, 0, 0), R(l2, 0, 0), R(0, H, 0.1), R(0, -H, l3), R(0, 0, 0.08)])
    q = np.array([*rng.uniform(-3, 3, 4), rng.choice([0, pi]), rng.uniform(-3, 3)])
    z, o = axes_of(robot, q)
    ground = np.linalg.norm(np.cross(o[5] - o[1], z[1]))
    first, second = (s**2 + t**2 + 2 * s * t * np.cos(TURN) for s, t in ((l1, l2), (l3, ground)))
    assert_as_many_curves(robot, q, curves_of_equal(first, second), ("q1", "q5"))


def axes_of(robot, q):
    """Directions and points, (n, 3) each, of the joint axes."""
    frames = [forward_kinematics(robot, q, frame=name) for name in robot.joint_names]
    return np.array([T.rotation[:, 2] for T in frames]), np.array([T.translation for T in frames])


def assert_as_many_curves(robot, q, count, standing):
    found = ik_solutions(robot, POSE, POSE.value(robot, q))
    equations = [tuple(text for text in family if text.split(" = ")[0] in standing) for family in found.families]
    assert (found.status, found.complete) == (IKStatus.INFINITE, True)
    assert set(Counter(equations).values()) == {count}


def test_a_curve_is_cut_where_a_joint_is_at_its_limit():
    robot = robot_from_dh(PUMA, lower=[-3] * 5 + [0.5], upper=[3] * 5 + [1.0])
    target = POSE.value(robot, [0.3, 0.7, -0.4, -0.5, 0, 0.7])  # the solution with q4 = 0 is outside
    for found in (ik_solutions(robot, POSE, target), SolutionSolver(robot, POSE)(target)):
        assert (found.status, found.complete) == (IKStatus.INFINITE, True)
        on_the_curve = found.q[found.singular]
        assert (on_the_curve[:, 5].min(), on_the_curve[:, 5].max()) == pytest.approx((0.5, 1.0), abs=1e-9)
        assert on_the_curve[:, 3] + on_the_curve[:, 5] == pytest.approx(0.2, abs=1e-6)


@pytest.mark.parametrize(
    ("rows", "q", "lower", "upper"),
    [(CYLINDRICAL, [1.5, 0.4, 0], [1, -2, -2], [2, 2, 2]), (ANTHROPOMORPHIC, [1.05, H, 0], [1, -3, -3], [1.1, 3, 3])],
)
def test_narrow_limits_hide_no_curve(rows, q, lower, upper):
    robot = robot_from_dh(rows, lower=lower, upper=upper)
    found = ik_solutions(robot, XYZ, XYZ.value(robot, q))
    assert (found.status, found.method) == (IKStatus.INFINITE, "elimination to a polynomial")
    assert (found.q[:, 0].min(), found.q[:, 0].max()) == pytest.approx((lower[0], upper[0]), abs=1e-9)


def test_no_curve_is_told_where_the_limits_leave_nothing_of_it():
    robot = robot_from_dh(PUMA, lower=[-3, -3, -3, -0.1, -3, 1.0], upper=[3, 3, 3, 0.1, 3, 1.2])
    free = robot_of(PUMA)
    found = ik_solutions(robot, POSE, POSE.value(free, [0.3, 0.7, -0.4, 0.5, 0, 0.2]))
    assert (found.status, found.complete) == (IKStatus.UNREACHABLE, True)
    assert pi > np.abs(found.closest).max()
