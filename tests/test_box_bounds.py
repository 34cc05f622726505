"""In a box of configurations no sample has more than its bound, and the bounds close in as the box shrinks."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from mimic_arms import text_of, trees

import robotics1 as r1
from robotics1.workspaces.certified.extremes import Measure
from robotics1.workspaces.certified.objective import Objective, largest_on_cube
from robotics1.workspaces.chain import driven_chain

MEASURES = [
    Measure(np.eye(3), np.array([0.3, -0.2, 0.5])),
    Measure(np.diag([1.0, 1.0, 0.0]), np.array([0.1, 0.4, 0.0])),
    Measure(np.eye(3), np.zeros(3), np.array([0.6, 0.0, 0.8])),
]


def objectives(arm, frame=None):
    chain = driven_chain(arm, frame, dict.fromkeys(arm.joint_names, (-2.0, 2.0)))
    return [Objective(chain, measure, sign) for measure in MEASURES for sign in (1.0, -1.0)]


def drawn_boxes(rng, n, count=40):
    """Long and short ones, and such as have no side along a coordinate."""
    middle = rng.uniform(-2, 2, (count, n))
    half = rng.choice([0.0, 0.01, 0.1, 0.5, 2.0], (count, n)) * rng.uniform(0.5, 1, (count, n))
    return middle, half


def assert_bounded(objective, seed):
    rng = np.random.default_rng(seed)
    n = len(objective.chain.lower)
    middle, half = drawn_boxes(rng, n)
    found = objective.bounds(middle, half)
    for k in range(len(middle)):
        x = rng.choice([-1.0, 1.0, 0.3, -0.6], (200, n))
        values = objective.value(middle[k] + half[k] * x)
        assert values.max() <= found.bound[k] + 1e-9
        for i in np.flatnonzero(found.slope[k]):
            low, high = (np.where(np.arange(n) == i, end, x) for end in (-1.0, 1.0))
            rise = objective.value(middle[k] + half[k] * high) - objective.value(middle[k] + half[k] * low)
            assert (rise * np.sign(found.slope[k, i]) >= -1e-9).all()


@settings(max_examples=6)
@given(trees(least=2, most=5, chain=True), st.integers(0, 99))
def test_no_sample_of_a_box_is_beyond_its_bound(tree, seed):
    arm = r1.load_robot(text_of(tree), tool="tool")
    for objective in objectives(arm):
        assert_bounded(objective, seed)


@pytest.mark.parametrize("seed", range(3))
def test_no_point_of_a_grid_in_a_box_is_beyond_its_bound(seed):
    rng = np.random.default_rng(seed)
    arm = r1.robot_from_dh([("R", rng.uniform(0, 0.6), rng.uniform(-2, 2), rng.uniform(0, 0.3), 0) for _ in range(3)])
    x = np.array(list(product([-1.0, -0.5, 0.0, 0.5, 1.0], repeat=3)))
    middle, half = rng.uniform(-2, 2, (150, 3)), rng.choice([0.02, 0.1, 0.3, 0.6], (150, 3))
    for objective in objectives(arm):
        most = [objective.value(m + w * x).max() for m, w in zip(middle, half, strict=True)]
        assert (most <= objective.bounds(middle, half).bound + 1e-12).all()


@pytest.mark.parametrize("number", range(len(MEASURES) * 2))
def test_the_bound_of_a_box_half_as_long_is_at_least_three_times_as_near(number):
    """Its error is of the order of the side's square, or better."""
    arm = r1.robot_from_dh([("R", a, t, 0.1, 0) for a, t in ((0.5, 1.2), (0.4, -0.7), (0.3, 0.4), (0.2, 0.0))])
    objective = objectives(arm)[number]
    rng = np.random.default_rng(number)
    middle = rng.uniform(-1, 1, (5, 4))
    x = np.array(list(product([-1.0, -0.5, 0.0, 0.5, 1.0], repeat=4)))
    gaps = []
    for side in (0.02, 0.01):
        half = np.full((5, 4), side)
        most = np.array([objective.value(m + side * x).max() for m in middle])
        gaps.append(objective.bounds(middle, half).bound - most)
    assert (gaps[1] >= -1e-12).all()
    assert gaps[1].max() < gaps[0].max() / 3


@settings(max_examples=20)
@given(st.integers(0, 10_000), st.integers(1, 5))
def test_a_quadratic_function_on_a_cube_is_below_its_bound(seed, n):
    rng = np.random.default_rng(seed)
    H = rng.normal(size=(1, n, n))
    H = H + np.swapaxes(H, 1, 2) - rng.choice([0.0, 4.0, 10.0]) * np.eye(n)
    g = rng.normal(size=(1, n)) * rng.choice([0.1, 3.0])
    bound = largest_on_cube(g, H, np.ones((1, n), dtype=bool))[0]
    x = np.vstack([rng.uniform(-1, 1, (2000, n)), rng.choice([-1.0, 1.0], (200, n))])
    values = x @ g[0] + 0.5 * np.einsum("ki,ij,kj->k", x, H[0], x)
    assert values.max() <= bound + 1e-12
    if np.linalg.eigvalsh(H[0])[-1] < 0:  # concave: the bound is nearly attained, by a point that SciPy finds
        from scipy.optimize import minimize

        end = minimize(lambda y: -(y @ g[0] + 0.5 * y @ H[0] @ y), np.zeros(n), bounds=[(-1, 1)] * n)
        assert bound == pytest.approx(-end.fun, abs=0.02 * (1 + abs(end.fun)))
