"""Whether drawn 3R arms are cuspidal, beside a flood fill of det J over (q2, q3) that uses nothing of the package."""

from math import pi

import numpy as np
from brute_force import all_solutions, pose_and_jacobian
from hypothesis import given, settings, strategies as st
from scipy.ndimage import label, maximum_filter
from test_all_solutions import XYZ, H, R, robot_of

from robotics1.ik import CuspidalityStatus as Is, is_cuspidal

CELLS, TURNS = 180, 3  # of a grid, over three turns, so that no seam is in the way


def determinant(rows, q):
    return np.linalg.det(pose_and_jacobian(rows, q, np.zeros(3))[1][:, :3])


def safe_parts(rows):
    """The parts of the torus on which |det J| is larger than it changes from one point of the grid to the next."""
    ticks = -pi + 2 * pi / CELLS * np.arange(CELLS)
    q2, q3 = (axis.ravel() for axis in np.meshgrid(ticks, ticks, indexing="ij"))
    det = np.tile(determinant(rows, np.column_stack([0 * q2, q2, q3])).reshape(CELLS, CELLS), (TURNS, TURNS))
    change = 1.2 * maximum_filter(np.hypot(*np.gradient(det)), 3)
    positive, count = label(det > change)
    negative, _ = label(det < -change)
    return np.where(det > change, positive, np.where(det < -change, negative + count, 0))


def places(parts, q):
    i, j = np.round((q[1:] + pi) / (2 * pi / CELLS)).astype(int) % CELLS
    return {int(part) for part in parts[i::CELLS, j::CELLS].ravel()} - {0}


def joined_solutions(rows, targets, rng):
    """How many pairs of solutions of one target, found by brute force, are in one part."""
    parts, joined = safe_parts(rows), 0
    for q in rng.uniform(-pi, pi, (targets, 3)):
        T = pose_and_jacobian(rows, q[None], np.zeros(3))[0][0]
        found = [places(parts, p) for p in all_solutions(rows, T, range(3), starts=40, steps=30)]
        joined += sum(bool(a & b) for i, a in enumerate(found) for b in found[:i])
    return joined


@given(st.integers(0, 10_000), st.sampled_from(["skew", "orthogonal", "first two axes meet", "last two axes meet"]))
@settings(max_examples=4)
def test_solutions_in_one_part_make_an_arm_cuspidal(seed, kind):
    rng = np.random.default_rng(seed)
    rows = [R(*rng.uniform([0.1, -pi, -0.6], [1, pi, 0.6]).round(2)) for _ in range(3)]
    if kind == "orthogonal":
        rows = [R(a, rng.choice([H, -H]), d) for _, a, _, d, _ in rows]
    if "meet" in kind:
        i = 0 if "first" in kind else 1
        rows[i] = R(0.0, *rows[i][2:4])
    found = is_cuspidal(robot_of(rows), XYZ)
    if found.status is Is.NOT_CUSPIDAL:
        assert joined_solutions(rows, 8, rng) == 0
    elif len(found.q_a):
        corners = zip(found.path[:-1], found.path[1:], strict=True)
        path = np.concatenate([np.linspace(a, b, 100) for a, b in corners])
        assert len(set(np.sign(determinant(rows, path)))) == 1
        ends = pose_and_jacobian(rows, path[[0, -1]], np.zeros(3))[0][:, :3, 3]
        assert np.abs(ends[0] - ends[1]).max() < 1e-9
        assert np.abs(np.exp(1j * path[0]) - np.exp(1j * path[-1])).max() > 0.01


def test_the_flood_fill_sees_the_classical_cuspidal_arm_and_not_an_elbow_arm():
    rng = np.random.default_rng(0)
    assert joined_solutions([R(1, -H, 0), R(2, H, 1), R(1.5, 0, 0)], 12, rng) > 0
    assert joined_solutions([R(0, H, 0.4), R(0.5, 0, 0), R(0.35, 0, 0)], 12, rng) == 0
