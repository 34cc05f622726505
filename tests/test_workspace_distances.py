"""Distances from the boundary of an arm whose first joint turns its plane between limits."""

from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import assume, given, settings, strategies as st
from planar_chains import XYZ
from scipy.optimize import minimize
from spatial_arms import drawn_arm
from sweeps import fewer_examples

import robotics1 as r1
from robotics1.workspaces import crossings, workspace

SEEDS = st.integers(0, 300)
SHELL = [("R", 0, pi / 2, 0, 0), ("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)]


def drawn(seed):
    """An anthropomorphic or polar arm with limits; of some the shoulder is beside the axis."""
    rng = np.random.default_rng(seed)
    beside = float(rng.choice([0.0, 0.2]))
    turn = float(rng.choice([0.5, 2.0, pi, 4.0, 6.0]))
    first = [-0.4, rng.uniform(-1, 0.5)]
    last = [first[0] + turn, first[1] + rng.uniform(0.5, 2.5)]
    rows = [("R", beside, pi / 2, 0.5, 0), ("R", 1.0, 0, 0, 0), ("R", 0.7, 0, 0, 0)]
    third = sorted(rng.uniform(-2.8, 2.8, 2))
    if seed % 3 == 2:
        rows[1:] = [("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
        third = [0.3, 1.1]
    return r1.robot_from_dh(rows, lower=[*first, third[0]], upper=[*last, third[1]])


def nearest_of_all(arm, p, rng):
    """min |f(q) − p| inside the limits, by descents from the nearest ones of many configurations and from others."""

    def squared(q):
        away = XYZ.value(arm, q) - p
        return away @ away, 2 * XYZ.jacobian(arm, q).T @ away

    many = rng.uniform(arm.lower, arm.upper, (1000, 3))
    order = np.argsort([np.linalg.norm(XYZ.value(arm, q) - p) for q in many])
    nearest = [*order[:5], *order[5::50]]  # descents from near by may all end in one local minimum
    bounds, exact = list(zip(arm.lower, arm.upper, strict=True)), {"ftol": 1e-15}
    return min(minimize(squared, q, jac=True, bounds=bounds, options=exact).fun for q in many[nearest]) ** 0.5


@fewer_examples()
@given(SEEDS)
def test_outside_it_is_the_distance_of_the_nearest_configuration(seed):
    arm, rng = drawn(seed), np.random.default_rng(seed)
    ws = workspace(arm, XYZ)
    for p in rng.uniform([-2, -2, -1.5], [2, 2, 2.5], (3, 3)):
        if not ws.contains(p):
            assert ws.distance(p) == pytest.approx(nearest_of_all(arm, p, rng), abs=1e-6)


@given(SEEDS)
def test_inside_a_ball_of_this_radius_is_reached_and_no_larger_one(seed):
    arm, rng = drawn(seed), np.random.default_rng(seed)
    ws = workspace(arm, XYZ)
    for q in rng.uniform(arm.lower, arm.upper, (4, 3)):
        p = XYZ.value(arm, q)
        d = ws.distance(p)
        around = rng.normal(size=(60, 3))
        around /= np.linalg.norm(around, axis=1)[:, None]
        assert all(ws.contains(p + 0.999 * d * n) for n in around)
        if d > 1e-3:
            assert not all(ws.contains(p + (1.3 * d + 0.02) * n) for n in _towards(ws, p, d, around))


def _towards(ws, p, d, around):
    """Directions, and those that lead closer to the boundary from where they end."""
    ends = p + d * around
    near = around[np.argsort([ws.distance(e) for e in ends])[:6]]
    more = (near[:, None] + 0.3 * around[None, :12]).reshape(-1, 3)
    return np.vstack([around, more / np.linalg.norm(more, axis=1)[:, None]])


def test_a_wedge_of_a_ball_has_the_distances_of_its_sphere_and_walls():
    """A polar arm with q1 from −1 to 1 rad, a shoulder from below to above, and |p| ≤ 2: a wedge of a ball."""
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
    arm = r1.robot_from_dh(rows, lower=[-1, 0, 0], upper=[1, pi, 2])
    ws = workspace(arm, XYZ)
    assert ws.distance([1, 0, 1]) == pytest.approx(2 - 2**0.5, abs=1e-12)  # to the ball
    assert ws.distance([1, 1, 0.5]) == pytest.approx(cos(1 - pi / 4 + pi / 2) * -(2**0.5), abs=1e-12)  # to the wall
    assert ws.distance([3 * cos(2), 3 * sin(2), 0]) == pytest.approx(
        hypot(3 * sin(1), max(3 * cos(1) - 2, 0)), abs=1e-12
    )


def test_crossings_of_a_turn_with_limits_are_found_by_steps_as_long_as_the_distance():
    ws = workspace(r1.robot_from_dh(SHELL, lower=[-1, -3, 0], upper=[1, 3, 3]), XYZ)
    found = crossings(ws, [[1, -3, 0.1], [1, 3, 0.1]])
    width = min((4 - 1 - 0.1**2) ** 0.5, np.tan(1))
    assert found.times == pytest.approx([0.5 - width / 6, 0.5 + width / 6], abs=1e-8)
    assert found.resolution < 1e-4


@settings(max_examples=3)
@given(st.integers(0, 300))
def test_with_offsets_too_it_is_the_distance_of_the_nearest_configuration(seed):
    arm, rng = drawn_arm(seed), np.random.default_rng(seed)
    ws = _workspace(arm)
    p = _where(ws, rng, reached=False)
    assert ws.distance(p) == pytest.approx(nearest_of_all(arm, p, rng), abs=1e-6)


@settings(max_examples=3)
@given(st.integers(0, 300))
def test_with_offsets_too_a_ball_of_this_radius_is_reached_and_touches_what_is_not(seed):
    """The nearest point of the boundary is p − d ∇d: some points around it are not reached."""
    arm, rng = drawn_arm(seed), np.random.default_rng(seed)
    ws = _workspace(arm)
    around = rng.normal(size=(300, 3))
    around /= np.linalg.norm(around, axis=1)[:, None]
    p = _where(ws, rng, reached=True)
    d, step = ws.distance(p), 1e-6
    assert ws.section.contains_each(p + 0.999 * d * around).all()
    slope = np.array([ws.distance(p + step * e) - ws.distance(p - step * e) for e in np.eye(3)]) / (2 * step)
    assert np.linalg.norm(slope) == pytest.approx(1.0, abs=1e-3)
    assert not ws.section.contains_each(p - d * slope + 1e-2 * d * around).all()


def _workspace(arm):
    try:
        return workspace(arm, XYZ)
    except r1.TaskError:
        assume(False)


def _where(ws, rng, *, reached):
    for p in rng.uniform(-1.0, 1.0, (200, 3)) * max(1.0, ws.r_max):
        if ws.contains(p) == reached:
            return p
    assume(False)


def test_a_slide_before_a_curved_section_has_walls_at_both_ends():
    """A point on the torus of two turns, moved along z from 0 to 2: near the ends the nearest point is of an end."""
    rows = [("P", 0, 0, 0, 0), ("R", 1, pi / 2, 0, 0), ("R", 0.3, 0, 0, 0)]
    arm = r1.robot_from_dh(rows, lower=[0, -pi, -pi], upper=[2, pi, pi])
    ws = workspace(arm, XYZ)
    assert ws.distance([1, 0, 1]) == pytest.approx(0.3, abs=1e-9)  # the cylinder around the ring
    assert ws.distance([1, 0, 2.2]) == pytest.approx(0.1, abs=1e-9)  # the torus at the upper end
    assert ws.distance([0, 0, 1]) == pytest.approx(0.7, abs=1e-9)
    assert ws.distance([1.6, 0, 2.4]) == pytest.approx(hypot(0.6, 0.4) - 0.3, abs=1e-9)
