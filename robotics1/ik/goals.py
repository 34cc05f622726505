"""The poses at which a task has its targets: what the kernels are given."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.task import PoseError

LAST_ROW = [0.0, 0.0, 0.0, 1.0]  # of [R p; 0 1]


def goal_of(robot: Robot, pose_error: PoseError, target: Any) -> Array:
    """Return the pose (4, 4) of a target; one that is a pose itself is left for the kernel to check.

    Raises:
        InputError: the target has the wrong form.
    """
    if pose_error.takes_poses:
        if type(target) is pin.SE3:
            return np.asarray(target.homogeneous)
        if _is_a_matrix(target) and target[3].tolist() == LAST_ROW:
            return np.array(target, order="C")
    return pose_error.goal(robot, target)


def goals_of(robot: Robot, pose_error: PoseError, targets: Sequence[Any] | Array, first: int = 0) -> Array:
    """Return the poses (k, 4, 4) of targets first, first + 1, ... of a batch, as `goal_of` does.

    Raises:
        InputError: a target has the wrong form, and the message says which.
    """
    if pose_error.takes_poses:
        if all(type(target) is pin.SE3 for target in targets):
            return np.concatenate([target.homogeneous for target in targets]).reshape(-1, 4, 4)
        if isinstance(targets, np.ndarray) or all(map(_is_a_matrix, targets)):
            goals = np.array(targets)
            if goals.shape[1:] == (4, 4) and goals.dtype == np.float64 and (goals[:, 3] == LAST_ROW).all():
                return goals
    goals = np.empty((len(targets), 4, 4))
    for i, target in enumerate(targets):
        with numbered(first + i):
            goals[i] = goal_of(robot, pose_error, target)
    return goals


def _is_a_matrix(target: Any) -> bool:
    return type(target) is np.ndarray and target.shape == (4, 4) and target.dtype == np.float64


@contextmanager
def numbered(i: int) -> Iterator[None]:
    """Name the target, of a batch, that an error is about."""
    try:
        yield
    except (InputError, TaskError) as error:
        raise type(error)(f"target {i} of the batch: {error}") from error
