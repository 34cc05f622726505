"""What an iteration of inverse kinematics makes small: the error of the task or the body twist, and how small."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, by_name, one_of, real_number
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

ErrorKind = Literal["task", "body"]
KINDS = ("task", "body")


def error_and_jacobian(robot: Robot, task: Task, target: Any, kind: str) -> Callable[[Array], tuple[Array, Array]]:
    """Return q → (e, J): e = r_d − f(q) with J of the task, or e = log(T⁻¹ T_d) with the body Jacobian.

    Raises:
        InputError: the kind is neither.
        TaskError: the body twist is asked of a task whose value is no pose.
    """
    if one_of("error", kind, KINDS) == "task":
        return lambda q: (task.error(robot, q, target), task.jacobian(robot, q))
    if not isinstance(target, pin.SE3):
        raise TaskError("error='body' is the twist log(T⁻¹ T_d) of a whole pose: use PoseTask(), without angles")

    def body(q: Array) -> tuple[Array, Array]:
        T = task.value(robot, q)
        turned = np.kron(np.eye(2), T.rotation.T)  # V_b = (Rᵀ v, Rᵀ ω)
        return np.asarray(pin.log6(T.actInv(target)).vector), turned @ task.jacobian(robot, q)

    return body


@dataclass(frozen=True)
class Bounds:
    """When an error is small enough: unit → rows of e, and the bound of their norm; "" stands for all rows."""

    rows: dict[str, tuple[int, ...]]
    most: dict[str, float]

    def hold(self, e: Array) -> bool:
        """Return whether the norm of e is within each bound."""
        return all(np.hypot.reduce(e[list(rows)]) <= self.most[unit] for unit, rows in self.rows.items())


def tolerances(task: Task, tolerance: Any) -> Bounds:
    """Return the bound of |e| in all rows, or those of the norms in the rows of each unit.

    Raises:
        InputError: a bound is no positive number, or the units are not those of the task.
    """
    units = task.row_units
    if not isinstance(tolerance, Mapping):
        return Bounds({"": tuple(range(len(units)))}, {"": real_number("tolerance", tolerance, positive=True)})
    given = by_name("tolerance", tolerance, "{'rad': 1e-3, 'm': 1e-4}")
    if given.keys() != set(units):
        wanted, got = (", ".join(map(repr, names)) for names in (dict.fromkeys(units), given))
        raise InputError(f"tolerance must have one number for each unit of the task, {wanted}; it has {got or 'none'}")
    rows = {unit: tuple(i for i, other in enumerate(units) if other == unit) for unit in given}
    return Bounds(
        rows, {unit: real_number(f"tolerance[{unit!r}]", most, positive=True) for unit, most in given.items()}
    )
