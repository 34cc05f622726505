"""Manipulability at one configuration: hand formulas, laws, and exact answers where the rank is lost."""

from math import inf, pi, sin, sqrt

import numpy as np
import pytest
from arms import arm, random_q
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.singularities import RankStatus, manipulability

PLANE = r1.PositionTask("xy")
TWO_R = arm("planar_2r")
L1, L2 = TWO_R.parameters["l1"], TWO_R.parameters["l2"]
angles = st.floats(-3, 3)


@given(q1=angles, q2=angles)
def test_measure_of_a_planar_2r_is_l1_l2_times_the_absolute_sine_of_q2(q1, q2):
    found = manipulability(TWO_R, PLANE, [q1, q2])
    assert found.measure == pytest.approx(L1 * L2 * abs(sin(q2)), abs=1e-9)  # a smaller σ₂ counts as zero


def test_a_planar_2r_with_lengths_in_the_ratio_of_the_square_root_of_two_is_isotropic_at_three_quarters_of_pi():
    robot = arm("planar_2r", l1=sqrt(2), l2=1.0)
    found = manipulability(robot, PLANE, [0.4, 3 * pi / 4])
    assert found.condition == pytest.approx(1, abs=1e-14)
    assert found.velocity_ellipsoid.lengths == pytest.approx([1, 1])
    assert found.transmission([0.3, -2]) == pytest.approx((1, 1))


CASES = [
    ("planar_2r", "xy"),
    ("planar_3r", "xy"),
    ("spatial", "xyz"),
    ("redundant", "xyz"),
    ("six_r", "xyz"),
    ("prr", "xy"),
]


@pytest.mark.parametrize(("name", "axes"), CASES)
def test_measure_condition_and_ellipsoids_follow_from_the_eigenvalues_of_j_jt(name, axes):
    robot, task = arm(name), r1.PositionTask(axes)
    q = random_q(robot, 5)
    J, found = task.jacobian(robot, q), manipulability(robot, task, q)
    eigenvalues = np.linalg.eigvalsh(J @ J.T)[::-1]
    assert found.measure == pytest.approx(sqrt(np.linalg.det(J @ J.T)), rel=1e-10)
    assert found.condition == pytest.approx(sqrt(eigenvalues[0] / eigenvalues[-1]), rel=1e-9)
    assert found.velocity_ellipsoid.lengths**2 == pytest.approx(eigenvalues, rel=1e-9)
    assert found.velocity_ellipsoid.lengths * found.force_ellipsoid.lengths == pytest.approx(np.ones(len(axes)))
    assert np.array_equal(found.velocity_ellipsoid.axes, found.force_ellipsoid.axes)
    axis = found.velocity_ellipsoid.axes[:, 0]
    assert J @ J.T @ axis == pytest.approx(eigenvalues[0] * axis, abs=1e-12)


@pytest.mark.parametrize(("name", "axes"), CASES)
@pytest.mark.parametrize("seed", range(3))
def test_transmission_is_that_of_chiu_and_is_reached_by_unit_rates_and_unit_torques(name, axes, seed):
    robot, task = arm(name), r1.PositionTask(axes)
    q, u = random_q(robot, seed), np.random.default_rng(seed).normal(size=len(axes))
    J, n = task.jacobian(robot, q), u / np.linalg.norm(u)
    alpha, beta = manipulability(robot, task, q).transmission(u)
    assert alpha == pytest.approx(1 / sqrt(n @ np.linalg.inv(J @ J.T) @ n), rel=1e-9)
    assert beta == pytest.approx(1 / sqrt(n @ J @ J.T @ n), rel=1e-9)
    assert np.linalg.norm(np.linalg.pinv(J) @ (alpha * n)) == pytest.approx(1, rel=1e-9)
    assert np.linalg.norm(J.T @ (beta * n)) == pytest.approx(1, rel=1e-9)
    assert alpha * beta <= 1 + 1e-12


def test_a_stretched_planar_2r_has_a_flat_velocity_ellipsoid_and_pushes_along_itself_without_torque():
    found = manipulability(TWO_R, PLANE, [pi / 2, 0.0])
    assert (found.measure, found.condition) == (0, inf)
    sigma = sqrt((L1 + L2) ** 2 + L2**2)
    assert found.velocity_ellipsoid.lengths == pytest.approx([sigma, 0])
    assert found.force_ellipsoid.lengths == pytest.approx([1 / sigma, inf])
    assert np.abs(found.force_ellipsoid.axes) == pytest.approx(np.eye(2), abs=1e-15)  # across the arm, along it
    assert found.transmission([0, 3]) == (0, inf)
    assert found.transmission([-2, 0]) == pytest.approx((sigma, 1 / sigma))
    assert found.transmission([1, 1]) == pytest.approx((0, sqrt(2) / sigma))
    assert found.status is RankStatus.RANK_DEFICIENT
    assert found.explain() == "w = 0, condition inf; the rank is not full (rank 1 of 2)"


def test_where_nothing_moves_the_ellipsoid_is_a_point_and_every_force_is_held():
    robot = r1.robot_from_dh([("R", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
    found = manipulability(robot, PLANE, [0.1, 0.2])
    assert (found.measure, found.condition) == (0, inf)
    assert found.transmission([1, 2]) == (0, inf)


def test_a_task_with_more_rows_than_joints_has_measure_zero():
    found = manipulability(TWO_R, r1.PlanarPoseTask(), [0.3, 1.0])
    assert (found.measure, found.condition) == (0, inf)
    assert np.isinf(found.force_ellipsoid.lengths).sum() == 1


def test_a_configuration_rounded_to_four_digits_is_called_nearly_singular():
    found = manipulability(TWO_R, PLANE, [0.3, 3.1416])
    assert found.status is RankStatus.NEARLY_SINGULAR


@pytest.mark.parametrize(
    ("u", "words"),
    [([0, 0], "u must have a direction"), ([1, 2, 3], r"u must have shape \(2,"), ("x", "u must be an array")],
)
def test_a_direction_that_is_none_is_refused(u, words):
    with pytest.raises(r1.InputError, match=words):
        manipulability(TWO_R, PLANE, [0.3, 1.0]).transmission(u)


def test_robot_and_task_in_the_wrong_order_are_refused():
    with pytest.raises(r1.InputError, match="the robot comes first"):
        manipulability(PLANE, TWO_R, [0, 0])
