"""Several tasks at once, of one frame or of several, with their rows one below the other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, moderate, real_array
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.given import TaskLike, task_from
from robotics1.tasks.task import FrameMap, Task


@dataclass(frozen=True)
class StackedTask:
    """r = (r₁, r₂, ...) with J = [J₁; J₂; ...]: all tasks at once, none before another.

    A value, and a target, has one part for each task. Where each part is of numbers, (mᵢ,), the value is (m,), and so
    may a target be. Tasks on one frame with the same axes are one function of its pose; others are taken as they are:
    analyses and inverse kinematics then go by numbers, and each task has its own formulas.

    With weights the rows of e and J of task i are multiplied by √wᵢ, so that least squares minimize Σ wᵢ |eᵢ|² where
    not all tasks can be met. They change no solution where all can. Priorities: `redundancy.ik_by_priority`.

    Attributes:
        tasks: one or more tasks.
        weights: wᵢ > 0, one a task; None if all count alike.
    """

    tasks: tuple[Task, ...]
    weights: tuple[float, ...] | None

    def __init__(self, tasks: Sequence[TaskLike], weights: npt.ArrayLike | None = None) -> None:
        if not isinstance(tasks, Sequence) or not tasks or isinstance(tasks, str):
            raise InputError(f"tasks must be a list of tasks, such as [PositionTask('xy'), ...]; it is {tasks!r}")
        object.__setattr__(self, "tasks", tuple(map(task_from, tasks)))
        object.__setattr__(self, "weights", None if weights is None else _positive(weights, len(tasks)))

    @property
    def row_names(self) -> tuple[str, ...]:
        """Those of the tasks; a name that several tasks have gets the number of its task, as "x_1" and "x_2"."""
        every = [name for task in self.tasks for name in task.row_names]
        return tuple(
            name if every.count(name) == 1 else f"{name}_{i}"
            for i, task in enumerate(self.tasks, 1)
            for name in task.row_names
        )

    @property
    def row_units(self) -> tuple[str, ...]:
        """Those of the tasks."""
        return tuple(unit for task in self.tasks for unit in task.row_units)

    @property
    def rows(self) -> int:
        """The sum of the rows, m = m₁ + m₂ + ..."""
        return sum(task.rows for task in self.tasks)

    def value(self, robot: RobotLike, q: ConfigurationLike) -> Any:
        """Return r, (m,), or a tuple with the value of each task where one is no (mᵢ,)."""
        robot = robot_from(robot)
        q = robot.configuration(q)
        return _joined(self.tasks, tuple(task.value(robot, q) for task in self.tasks))

    def target(self, target: Any) -> Any:
        """Return a target in the form of `value`, from one target for each task, or (m,).

        Raises:
            InputError: it has another form.
        """
        return _joined(self.tasks, self._parts(target))

    def error(self, robot: RobotLike, q: ConfigurationLike, target: Any) -> Array:
        """Return (e₁, e₂, ...), (m,), weighted, each as its task has it: angles wrapped, rotations as vectors."""
        robot = robot_from(robot)
        parts = self._parts(target)
        errors = [task.error(robot, q, part) for task, part in zip(self.tasks, parts, strict=True)]
        return np.asarray(self._factors() * np.concatenate(errors))

    def jacobian(self, robot: RobotLike, q: ConfigurationLike) -> Array:
        """Return [J₁; J₂; ...], (m, nv), weighted; of several configurations (k, nq), (k, m, nv)."""
        robot = robot_from(robot)
        J = np.concatenate([task.jacobian(robot, q) for task in self.tasks], axis=-2)
        return np.asarray(self._factors()[:, None] * J)

    def check(self, robot: Robot) -> None:
        """Raise TaskError if one of the tasks does not fit the robot."""
        for task in self.tasks:
            task.check(robot)

    def check_integrable(self, robot: Robot) -> None:
        """Raise TaskError if J of one of the tasks is not the derivative of its value."""
        for task in self.tasks:
            task.check_integrable(robot)

    def with_parameters(self, values: Mapping[str, float]) -> StackedTask:
        """Return the tasks with other values of their named lengths."""
        return StackedTask(
            [task.with_parameters(values) if hasattr(task, "with_parameters") else task for task in self.tasks],
            self.weights,
        )

    def frame_map(self) -> FrameMap | None:
        """Return the tasks as one function of a pose, if they are on one frame, with the same axes, and of numbers."""
        forms = [task.frame_map() for task in self.tasks]
        if self.weights is not None:
            return None
        if len(self.tasks) == 1:
            return forms[0]
        known = [form for form in forms if form is not None and form.S is not None]
        nowhere = np.zeros(3), np.eye(3), np.zeros(0)  # where a value is looked at: it may be a matrix
        alike = {(form.frame, form.reference) for form in known}
        if len(known) < len(forms) or len(alike) > 1 or any(np.ndim(form.g(*nowhere)) != 1 for form in known):
            return None
        (frame, reference) = alike.pop()
        return FrameMap(
            frame,
            reference,
            lambda p, R, q: np.concatenate([form.g(p, R, q) for form in known]),
            lambda p, R: np.vstack([form.S(p, R) for form in known if form.S]),
            constant_rows=all(form.constant_rows for form in known),
        )

    def _factors(self) -> Array:
        """Return √w of each row, (m,)."""
        weights = (1.0,) * len(self.tasks) if self.weights is None else self.weights
        return np.repeat(np.sqrt(weights), [task.rows for task in self.tasks])

    def _parts(self, target: Any) -> tuple[Any, ...]:
        """Return the target of each task, checked.

        Raises:
            InputError: there is not one for each task, or one has the wrong form.
        """
        ends = np.cumsum([task.rows for task in self.tasks])[:-1]
        flat = isinstance(target, np.ndarray) and target.ndim == 1 and target.dtype != object
        flat = flat or (isinstance(target, Sequence) and len(target) == self.rows and all(map(np.isscalar, target)))
        parts = np.split(real_array("the target", target, (self.rows,), "one number a row"), ends) if flat else target
        if not isinstance(parts, Sequence) or isinstance(parts, str) or len(parts) != len(self.tasks):
            raise InputError(
                f"the target must hold one target for each of the {len(self.tasks)} tasks, or {self.rows} numbers; "
                f"it is {target!r}"
            )
        return tuple(task.target(part) for task, part in zip(self.tasks, parts, strict=True))


def _positive(weights: npt.ArrayLike, n: int) -> tuple[float, ...]:
    given = moderate("weights", real_array("weights", weights, (n,), "one number a task"))
    if (given <= 0).any():
        raise InputError(f"weights must be positive; they are {given.tolist()}")
    return tuple(given.tolist())


def _joined(tasks: Sequence[Task], values: tuple[Any, ...]) -> Any:
    """Return values (mᵢ,) as one, (m,); others as they are."""
    if all(isinstance(r, np.ndarray) and r.shape == (task.rows,) for task, r in zip(tasks, values, strict=True)):
        return np.concatenate(values)
    return values
