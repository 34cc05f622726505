"""Singular sets where the equations touch zero: single configurations and curves at which squares vanish together.

The reference is a search that knows task.jacobian alone: from random starts, and from a grid of special values, to
where σ_ρ is zero.
"""

from math import pi

import numpy as np
import pytest
import sympy
from dh_arms import EIGHTH, P, R, dh
from singular_arms import POINT, XY, Z
from singular_checks import Equations, corners, rank, singular_near, starts, unitless, usual_sigma
from sweeps import some_of

from robotics1 import FunctionTask, find_singularities, robot_from_dh

H, Q = pi / 2, pi / 4
q1, q2, q3 = sympy.symbols("q1:4", real=True)
PAIRS = {(x, y) for x in (-H, H) for y in (-H, H)}
DRAWN = {"a": 0.3, "b": 0.6, "c": -0.3}
TWISTS = (0, Q, -Q, H, -H, pi / 3, pi, pi / 6)


def eighth():
    return dh(*EIGHTH, a1=0.3, a3=0.3, d3=0.3)


def cubic_z():
    """Both slopes of the height vanish at four pairs of angles only, where their curves touch."""
    return dh(R(0.6, -Q, 0, Q), R(0, -H, -0.6), R(0.3, Q, 0.3, Q))


def slide_z():
    return dh(R("a1", -Q, 0), R("a2", -Q, "d2", Q), P(0), a1=0.3, a2=-0.3, d2=0.3, tool=0.3)


ARMS = {
    "3R with 45° and equal lengths xy": (eighth, XY),
    "3R, curves that touch, z": (cubic_z, Z),
    "RRP with 45°, z": (slide_z, Z),
    "3R, a1 = a2 = a3 = d2 = d3, z": (
        lambda: dh(R("a", H, 0), R("a2", -H, "d2"), R("a3", 0, "d3", H), a=0.3, a2=0.3, d2=0.3, a3=0.3, d3=0.3),
        Z,
    ),
}


@pytest.mark.parametrize("name", ARMS)
def test_every_singular_configuration_of_a_search_is_on_a_branch_and_every_branch_is_singular(name):
    make, task = ARMS[name]
    check(make(), task, 12)


@pytest.mark.parametrize("seed", some_of(range(150), 15))
def test_arms_of_few_lengths_and_twists_have_the_singular_set_of_a_search(seed):
    robot, task = drawn(seed)
    if usual_sigma(robot, task) < 1e-12:
        pytest.skip("no joint moves the task")
    check(robot, task, 14)


def drawn(seed):
    """An arm of three joints whose lengths are 0, a, 2a or −a and whose twists are special."""
    rng = np.random.default_rng(seed)
    rows = []
    for _ in range(3):
        a, d = ((0, "a", "a", "b", "c")[k] for k in rng.integers(5, size=2))
        alpha, theta = TWISTS[rng.integers(len(TWISTS))], (0, 0, H, Q)[rng.integers(4)]
        rows.append(R(a, alpha, d, theta) if rng.random() < 0.8 else P(alpha, theta))
    used = {x for row in rows for x in row if isinstance(x, str) and x in DRAWN}
    return dh(*rows, **{name: DRAWN[name] for name in used}, tool=0.3), (XY, Z, POINT)[seed % 3]


def check(robot, task, count):
    found = find_singularities(robot, task, method="symbolic", time_limit=200)
    assert found.complete
    usual, generic = usual_sigma(robot, task), found.generic_rank
    equations = [Equations(robot, branch) for branch in found.branches]
    rng = np.random.default_rng(3)
    for branch, equation in zip(found.branches, equations, strict=True):
        for q in (branch.sample(rng) for _ in range(4)):
            assert branch.contains(q)
            assert equation(q) <= 1e-8
            assert np.linalg.svd(unitless(robot, task, q), compute_uv=False)[generic - 1] <= 1e-9 * usual
            assert rank(robot, task, q, usual) == branch.rank
    ends = (singular_near(robot, task, q, generic, usual) for q in starts(robot, count, rng))
    for q in (q for q in ends if q is not None):
        assert min((equation(q) for equation in equations), default=9.0) <= 1e-3  # σ = 1e-13 at 5e-5 of a triple zero
    for q in corners(robot, 60, rng):
        on = [equation for equation in equations if equation(q) <= 1e-9]
        assert (rank(robot, task, q, usual) < generic) == bool(on), q


def test_the_numeric_method_finds_the_four_points_of_the_arm_with_45_degrees_and_no_curve():
    """σ grows as the third power of the distance along one direction there: 1e-12 still at 1e-4."""
    found = find_singularities(eighth(), XY, method="numeric", samples=30)
    values = [(branch.values["q2"], branch.values["q3"]) for branch in found.branches]
    assert {branch.dimension for branch in found.branches} == {1}
    assert {branch.free_joints for branch in found.branches} == {("q1",)}
    assert len(values) == len(PAIRS)
    for pair in PAIRS:
        assert min(np.abs(np.subtract(pair, value)).max() for value in values) <= 1e-6


def test_curves_that_touch_at_four_pairs_of_angles_are_these_pairs():
    found = find_singularities(cubic_z(), Z, method="symbolic")
    conditions = {frozenset(branch.conditions) for branch in found.branches}
    assert conditions == {
        frozenset({sympy.Eq(q2, x), sympy.Eq(q3, y)}) for x in (0, sympy.pi) for y in (sympy.pi / 4, -3 * sympy.pi / 4)
    }
    assert [(branch.dimension, branch.rank) for branch in found.branches] == [(1, 0)] * 4
    assert all(branch.formulas.null == sympy.eye(3) for branch in found.branches)


# --- sums of squares, by functions of the joints


def slides(count):
    rows = [("P", 0, H, 0, 0)] * (count - 1) + [("P", 0, 0, 0, 0)]
    return robot_from_dh(rows, lower=[-1] * count, upper=[1] * count)


def turn_and_slide():
    return robot_from_dh([("R", 0, 0, 0, 0), ("P", 0, 0, 0, 0)], lower=[None, -1], upper=[None, 1])


def cos(x):
    return sympy.cos(x) if isinstance(x, sympy.Expr) else np.cos(x)


def sin(x):
    return sympy.sin(x) if isinstance(x, sympy.Expr) else np.sin(x)


EQ = sympy.Eq
SQUARES = {  # robot, r(q), branches: conditions and dimension; det J is a sum of squares
    "q1² + q2²": (lambda: slides(2), lambda q: [q[0], q[1] * q[0] ** 2 + q[1] ** 3 / 3], [({EQ(q1, 0), EQ(q2, 0)}, 0)]),
    "(q1 − 1/2)² + (q2 − 1/4)²": (
        lambda: slides(2),
        lambda q: [q[0], q[1] * (q[0] - 0.5) ** 2 + (q[1] - 0.25) ** 3 / 3],
        [({EQ(q1, sympy.Rational(1, 2)), EQ(q2, sympy.Rational(1, 4))}, 0)],
    ),
    "cos q1 (1 − cos q1 + q2²)": (
        turn_and_slide,
        lambda q: [sin(q[0]), q[1] * (1 - cos(q[0])) + q[1] ** 3 / 3],
        [({EQ(q1, -sympy.pi / 2)}, 1), ({EQ(q1, sympy.pi / 2)}, 1), ({EQ(q1, 0), EQ(q2, 0)}, 0)],
    ),
    "(q1 − q2²)² + q3², a curve": (
        lambda: slides(3),
        lambda q: [q[0], q[1], q[2] * (q[0] - q[1] ** 2) ** 2 + q[2] ** 3 / 3],
        [({EQ(q1, q2**2), EQ(q3, 0)}, 1)],
    ),
    "(q1 − q2²)² + 2 (q2 − q1/3)² + q3²": (
        lambda: slides(3),
        lambda q: [q[0], q[1], q[2] * ((q[0] - q[1] ** 2) ** 2 + 2 * (q[1] - q[0] / 3) ** 2) + q[2] ** 3 / 3],
        [({EQ(q1, 0), EQ(q2, 0), EQ(q3, 0)}, 0)],
    ),
    "q1² (1 − q2)² + q2², a line": (
        lambda: slides(3),
        lambda q: [q[0], q[1], q[2] * ((q[0] - q[1] * q[0]) ** 2 + q[1] ** 2)],
        [({EQ(q1, 0), EQ(q2, 0)}, 1)],
    ),
}


@pytest.mark.parametrize("name", SQUARES)
def test_where_a_sum_of_squares_vanishes_all_of_them_do(name):
    make, function, wanted = SQUARES[name]
    task = FunctionTask(lambda p, R, q: function(q), make().nq)
    found = find_singularities(make(), task, method="symbolic", time_limit=120)
    assert [(set(branch.conditions), branch.dimension) for branch in found.branches] == wanted
    assert found.complete


@pytest.mark.parametrize("shift", [0.0, 0.3])
def test_a_double_zero_of_a_search_by_numbers_is_one_point(shift):
    task = FunctionTask(lambda p, R, q: [q[0], q[1] * (q[0] - shift) ** 2 + q[1] ** 3 / 3], 2)
    (branch,) = find_singularities(slides(2), task, method="numeric", samples=12).branches
    assert branch.dimension == 0
    assert branch.q == pytest.approx([shift, 0], abs=1e-6)
