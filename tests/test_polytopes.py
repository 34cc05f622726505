"""Velocities and forces under bounds of the joints: vertices, largest norms, radii."""

from itertools import product
from math import inf, pi, sqrt

import numpy as np
import pytest
from arms import arm, random_q
from hypothesis import given, settings, strategies as st
from scipy.optimize import linprog

import robotics1 as r1

velocity_polytope, force_polytope = r1.singularities.velocity_polytope, r1.singularities.force_polytope
XY = r1.PositionTask("xy")
ARM = r1.textbook_robots.planar_arm("RR", [3, 2])
RATES = [1, 1.5]


def rows(a):
    return np.array(sorted((np.round(np.asarray(a, dtype=float), 9) + 0.0).tolist()))


def test_the_velocities_of_a_2r_are_a_parallelogram_with_a_corner_where_both_joints_are_fastest():
    found = velocity_polytope(ARM, XY, [pi / 6, pi / 3], velocity=RATES)  # J = [[−3.5, −2], [3√3/2, 0]]
    a = 3 * sqrt(3) / 2
    assert rows(found.vertices) == pytest.approx(rows([(-6.5, a), (-0.5, a), (6.5, -a), (0.5, -a)]), abs=1e-8)
    assert found.largest == pytest.approx(7)
    assert rows(found.joints_at_largest) == pytest.approx(rows([(1, 1.5), (-1, -1.5)]), abs=1e-8)
    assert found.measure == pytest.approx(4 * 1 * 1.5 * 2 * a)
    assert "7 at" in found.explain()
    turns = found.vertices[[1, 2, 3, 0]]
    assert (np.linalg.det(np.stack([found.vertices, turns], axis=1)) > 0).all()  # counterclockwise


def test_the_velocities_of_a_stretched_2r_are_a_segment():
    found = velocity_polytope(ARM, XY, [pi / 6, 0], velocity=RATES)
    assert (found.dimension, len(found.vertices)) == (1, 2)
    assert rows(found.vertices) == pytest.approx(rows([(-4, 4 * sqrt(3)), (4, -4 * sqrt(3))]))
    assert (found.largest, found.measure) == pytest.approx((8, 16))
    assert found.status is r1.singularities.RankStatus.RANK_DEFICIENT
    assert found.radius([1, 0]) == 0
    assert found.radius([-1, sqrt(3)]) == pytest.approx(8)


def test_the_forces_of_a_stretched_2r_have_no_end_along_the_arm():
    found = force_polytope(ARM, XY, [0, 0], torque=[10, 2])
    assert np.abs(found.unbounded[:, 0]) == pytest.approx([1, 0])
    assert rows(found.vertices) == pytest.approx(rows([(0, 1), (0, -1)]))  # τ₂ = 2 f_y is met before τ₁ = 5 f_y
    assert rows(found.joints) == pytest.approx(rows([(5, 2), (-5, -2)]))
    assert (found.largest, found.measure, found.radius([1, 0])) == (inf, inf, inf)
    assert found.radius([0, 1]) == pytest.approx(1)


def test_at_printed_digits_the_segment_is_at_the_singularity():
    found = velocity_polytope(ARM, XY, [0.5, 3.1416], velocity=RATES)
    assert found.status is r1.singularities.RankStatus.NEARLY_SINGULAR
    assert "q2 = 3.1416 is within" in found.explain()
    assert (found.dimension, found.at_singularity.dimension) == (2, 1)
    assert found.at_singularity.largest == pytest.approx(1 * 1 + 1.5 * 2)
    assert force_polytope(ARM, XY, [0.5, 3.1416], torque=1).at_singularity.largest == inf


def brute_images(J, V):
    return np.array(list(product((-1, 1), repeat=len(V)))) * V @ J.T


@given(st.integers(0, 10**6), st.sampled_from([("planar_3r", "xy"), ("redundant", "xyz"), ("prr", "xy")]))
@settings(max_examples=15)
def test_the_largest_multiple_along_a_direction_is_that_of_a_linear_program(seed, kind):
    rng = np.random.default_rng(seed)
    robot, task = arm(kind[0]), r1.PositionTask(kind[1])
    q, V, u = random_q(robot, rng), rng.uniform(0.5, 2, robot.nv), rng.normal(size=task.rows)
    u /= np.linalg.norm(u)
    J = task.jacobian(robot, q)
    found = velocity_polytope(robot, task, q, velocity=V)
    program = linprog(
        [*np.zeros(robot.nv), -1],
        A_eq=np.column_stack([J, -u]),
        b_eq=np.zeros(len(u)),
        bounds=[*((-v, v) for v in V), (0, None)],
    )
    assert found.radius(u) == pytest.approx(-program.fun, rel=1e-7)
    assert found.largest == pytest.approx(np.linalg.norm(brute_images(J, V), axis=1).max())
    assert found.joints @ J.T == pytest.approx(found.vertices)
    assert (np.abs(found.joints) <= V + 1e-12).all()
    pushed = force_polytope(robot, task, q, torque=V)
    assert pushed.radius(u) == pytest.approx((V / np.abs(J.T @ u)).min(), rel=1e-8)
    assert pushed.joints == pytest.approx(pushed.vertices @ J)
    met = np.isclose(np.abs(pushed.joints), V, rtol=1e-7).sum(axis=1)
    assert (met >= task.rows).all()
    assert (np.abs(pushed.joints) <= V * (1 + 1e-7)).all()


def test_every_vertex_is_farthest_in_some_direction_and_no_corner_is_outside():
    robot, task = arm("redundant"), r1.PositionTask()
    q, V = random_q(robot, np.random.default_rng(3)), np.linspace(0.5, 2, robot.nv)
    found = velocity_polytope(robot, task, q, velocity=V)
    images = brute_images(task.jacobian(robot, q), V)
    for u in np.random.default_rng(0).normal(size=(200, 3)):
        assert (found.vertices @ u).max() == pytest.approx((images @ u).max())


def test_parallel_columns_and_columns_of_zeros_make_no_more_vertices():
    gantry = r1.textbook_robots.planar_arm("PR", [0], lower=[-1, None])  # the turn moves nothing
    found = velocity_polytope(gantry, XY, [0.3, 0.4], velocity=[2, 3])
    assert rows(found.vertices) == pytest.approx(rows([(2, 0), (-2, 0)]), abs=1e-8)
    assert found.joints[:, 1].tolist() == [0, 0]
    both = r1.robot_from_dh([("P", 0, 0, 0, 0), ("P", 0, 0, 0, 0)])
    assert rows(velocity_polytope(both, r1.PositionTask("z"), [0, 0], velocity=[1, 2]).vertices).tolist() == [[-3], [3]]


def test_without_bounds_there_is_no_polytope():
    with pytest.raises(r1.InputError, match="q1 has no bound on its velocity: give velocity="):
        velocity_polytope(ARM, XY, [0, 1])
    with pytest.raises(r1.InputError, match="q2 has no bound on its torque"):
        force_polytope(ARM, XY, [0, 1], torque=[1, inf])
    with pytest.raises(r1.InputError, match="direction"):
        velocity_polytope(ARM, XY, [0, 1], velocity=1).radius([0, 0])
    with pytest.raises(r1.InputError, match="positive"):
        velocity_polytope(ARM, XY, [0, 1], velocity=-1)
