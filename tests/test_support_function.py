"""No configuration is farther in a direction than the support function says, and stretched arms are nearly as far."""

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from mimic_arms import text_of, trees

import robotics1 as r1
from robotics1.workspaces.certified.support_function import farthest_of, support_function
from robotics1.workspaces.chain import driven_chain

CELLS = 10  # a coarse grid, whose bounds hold all the same


def directions(seed, count):
    n = np.random.default_rng(seed).normal(size=(count, 3))
    return n / np.linalg.norm(n, axis=1, keepdims=True)


@settings(max_examples=4)
@given(trees(least=2, most=5, chain=True), st.integers(0, 99))
def test_no_sample_is_farther_in_a_direction_or_from_a_point(tree, seed):
    arm = r1.load_robot(text_of(tree), tool="tool")
    chain = driven_chain(arm, None, dict.fromkeys(arm.joint_names, (-2.0, 2.0)))
    h = support_function(chain, 0, CELLS, 99)
    n = directions(seed, 20)
    p = chain.point(chain.drawn(np.random.default_rng(seed), 3000))
    assert (h(n) >= (p @ n.T).max(axis=0) - 1e-9).all()
    centre = np.array([0.3, -0.2, 0.4])
    assert farthest_of(h, centre, np.eye(3), CELLS) >= np.linalg.norm(p - centre, axis=1).max() - 1e-9
    assert farthest_of(h, centre, np.eye(3)[:2], CELLS) >= np.linalg.norm((p - centre)[:, :2], axis=1).max() - 1e-9


def test_two_links_in_a_plane_reach_their_length_times_the_sine_from_its_normal():
    """max n · p = (l₁ + l₂) |n_xy| without limits."""
    chain = driven_chain(r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.3, 0, 0, 0)]), None, None)
    h, n = support_function(chain, 0, CELLS, 99), directions(1, 40)
    exact = 0.8 * np.linalg.norm(n[:, :2], axis=1)
    assert (h(n) >= exact - 1e-12).all()
    assert h(n) == pytest.approx(exact, abs=0.03)  # cells of a fifth of a unit
    assert farthest_of(h, np.array([0.6, 0.8, 0.0]), np.eye(3)[:2], CELLS) == pytest.approx(1.8, abs=0.01)
    assert farthest_of(h, np.array([0.0, 0.0, 0.6]), np.eye(3), CELLS) == pytest.approx(1.0, abs=0.02)


def test_a_finer_grid_is_nearer_by_the_square_of_its_cells():
    rows = [("R", 0.0, pi / 2, 0.2, 0), ("R", 0.5, 0, 0, 0), ("R", 0.1, pi / 2, 0, 0), ("R", 0.3, 0, 0.1, 0)]
    chain = driven_chain(r1.robot_from_dh(rows, lower=[-2, -1, -2, -1], upper=[1, 2, 1, 2]), None, None)
    n = directions(3, 20)
    found = [support_function(chain, 0, cells, 99)(n) for cells in (6, 12, 36)]
    coarse, fine = (values - found[-1] for values in found[:2])
    assert (fine >= -1e-9).all()
    assert np.mean(fine) < 0.4 * np.mean(coarse)


def test_what_would_take_too_long_is_left_out():
    chain = driven_chain(r1.load_robot("ur5"), None, None)
    assert support_function(chain, 0, 64, -1.0) is None
