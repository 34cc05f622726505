from math import cos, sin

import numpy as np
import pinocchio as pin
import pytest
from arms import arm

from robotics1 import IKSolver, PoseTask, PositionTask
from robotics1.ik import IKStatus


@pytest.mark.parametrize("beyond", [2e-6, 5e-6, 2e-5, 1e-4])
@pytest.mark.parametrize("q1", [0.0, 0.7, -2.5])
def test_a_target_beyond_the_stretched_arm_by_little_more_than_the_tolerance_is_no_success(beyond, q1):
    """|e| = d − l1 − l2 > 1e-6: as a pose in a call of its own, as a matrix, as a position, and in a batch."""
    robot = arm("planar_2r")
    d = robot.parameters["l1"] + robot.parameters["l2"] + beyond
    p, pose = np.array([d * cos(q1), d * sin(q1)]), pin.SE3(pin.exp3(np.array([0, 0, q1])), np.zeros(3))
    pose.translation = np.array([*p, 0.0])
    solver = IKSolver(robot, PoseTask(), time_limit=1e-3)
    answers = [solver(pose), solver(pose, np.array([q1, 0.0])), solver(pose.homogeneous), solver.solve_batch([pose])[0]]
    answers.append(IKSolver(robot, PositionTask("xy"), time_limit=1e-3)(p))
    for answer in answers:
        assert answer.status is IKStatus.UNREACHABLE
        assert answer.error_norm == pytest.approx(beyond, rel=1e-3)


def test_an_error_that_is_no_number_is_no_success(monkeypatch):
    """A goal that the kernel refuses although the task has taken it: |e| is NaN, which no tolerance admits."""
    solver = IKSolver(arm("planar_2r"), PoseTask(), time_limit=1e-3)
    refused = np.diag([1.1, 1.1, 1.1, 1.0])
    monkeypatch.setattr(solver._search, "goals", lambda *_: np.array([refused, refused]))
    monkeypatch.setattr(solver._search, "goal", lambda _: refused)
    batch = solver.solve_batch([pin.SE3.Identity(), pin.SE3.Identity()])
    assert np.isnan(batch.error_norm).all()
    assert not batch.converged.any()
