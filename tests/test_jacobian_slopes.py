"""∂J/∂q, and what follows from it: a fold stands alone, and a curve of solutions does not."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from robotics1 import OrientationTask, PoseTask, PositionTask, robot_from_dh
from robotics1.differentiation import configuration_derivative
from robotics1.ik import IKStatus, SolutionSolver
from robotics1.singularities.jacobian_slopes import jacobian_slopes
from tests.drawn_arms import drawn_arm

TASKS = (
    PoseTask(),
    PositionTask("zx"),
    OrientationTask(),
    PoseTask(frame="jaw", reference="base"),
    PositionTask(reference="tool"),
    PositionTask(point=(0.1, -0.2, 0.3)),
    PoseTask(angles="ZYX"),
)


@given(st.integers(0, 100_000), st.sampled_from(TASKS))
def test_slopes_of_drawn_arms_are_the_differences_of_their_jacobians(seed, task):
    robot = drawn_arm(seed)
    q = np.random.default_rng(seed).uniform(-1, 1, robot.nq) * robot.units
    exact = configuration_derivative(lambda p: task.jacobian(robot, p), robot, q)
    size = np.abs(exact).max() + np.abs(task.jacobian(robot, q)).max()
    assert jacobian_slopes(robot, task, q) == pytest.approx(exact, abs=1e-8 * size)


def test_of_two_links_the_slopes_are_those_of_the_book():
    robot = robot_from_dh([("R", 2.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)])
    a, b = 0.3, 0.8
    c1, s1, c12, s12 = np.cos(a), np.sin(a), np.cos(a + b), np.sin(a + b)
    by_first = [[-2 * c1 - c12, -c12], [-2 * s1 - s12, -s12]]
    by_second = [[-c12, -c12], [-s12, -s12]]
    found = jacobian_slopes(robot, PositionTask("xy"), np.array([a, b]))
    assert np.moveaxis(found, 2, 0) == pytest.approx(np.array([by_first, by_second]), abs=1e-14)


@pytest.mark.parametrize(("q", "status"), [([0.3, 0.0], IKStatus.BOUNDARY), ([0.3, np.pi], IKStatus.INFINITE)])
def test_equal_links_fold_where_they_are_stretched_and_turn_where_they_are_folded(q, status):
    robot = robot_from_dh([("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)])
    solver = SolutionSolver(robot, PositionTask("xy"))
    assert solver(PositionTask("xy").value(robot, np.array(q))).status is status
