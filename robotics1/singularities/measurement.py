"""How near to singular a task is at many configurations: by the kernels, or one configuration at a time."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays, Indices, chain_arrays
from robotics1.kernels.compilation import is_ready
from robotics1.kernels.singularity_measures import (
    SingularityMeasures,
    measure_blocks,
    measures_of,
    singularity_measures,
    task_jacobians,
)
from robotics1.kinematics import reference_axes
from robotics1.robot.model import Robot
from robotics1.singularities.jacobian_slopes import standing_rows
from robotics1.tasks.task import FrameMap, Task

MOST_UNCOMPILED = 16_000_000  # entries of Jacobians: NumPy takes four seconds for them, as the compiler does


@dataclass(frozen=True, eq=False)
class KernelMeasurement:
    """Of a task whose rows are the same everywhere, ṙ = S V. It holds arrays only, so that it can be sent.

    Attributes:
        chain: of the frame, in units of length; its coordinates are numbered as in `moving`.
        S: (m, 6).
        moving: which entries of q move the frame.
        units: (nq,) what counts as one of each entry of q [rad or m].
        rank: ρ, how many singular values count.
        compiled: whether by the compiled kernel, else by NumPy and LAPACK: the values agree to rounding.
    """

    chain: ChainArrays
    S: Array
    moving: Indices
    units: Array
    rank: int
    compiled: bool = True
    sendable: ClassVar[bool] = True

    def measures(self, q: Array, names: tuple[str, ...]) -> dict[str, Array]:
        """Return measure → values (N,) at the configurations q (nq, N)."""
        moved = q[self.moving] / self.units[self.moving, None]
        if not self.compiled or self.rank < min(len(self.S), len(self.moving)):
            return named(measures_of(task_jacobians(self.chain, self.S, moved), self.rank), names)
        return named(singularity_measures(self.chain, self.S, moved, largest="condition" in names), names)

    def worth_compiling(self, count: int) -> "KernelMeasurement":
        """Return the measurement for this many configurations: by NumPy, where to compile the kernel takes longer."""
        small = count * len(self.S) * len(self.moving) <= MOST_UNCOMPILED
        return replace(self, compiled=not small or is_ready(measure_blocks))


@dataclass(frozen=True, eq=False)
class TaskMeasurement:
    """Of any task, from its Jacobian at one configuration after another.

    Attributes:
        robot, task: whose Jacobian.
        rows: (m,) factors of the rows of J.
        units: (nv,) factors of its columns.
        rank: ρ, how many singular values count.
    """

    robot: Robot
    task: Task
    rows: Array
    units: Array
    rank: int
    sendable: ClassVar[bool] = False

    def measures(self, q: Array, names: tuple[str, ...]) -> dict[str, Array]:
        """Return measure → values (N,) at the configurations q (nq, N); NaN where the task has no Jacobian."""
        J = np.array([self._jacobian(configuration) for configuration in q.T])
        defined = ~np.isnan(J).any(axis=(1, 2))
        found = named(measures_of(np.moveaxis(J[defined], 0, 2), self.rank), names)
        answer = {name: np.full(len(J), np.nan) for name in names}
        for name, values in found.items():
            answer[name][defined] = values
        return answer

    def _jacobian(self, q: Array) -> Array:
        try:
            return np.asarray(self.rows[:, None] * self.task.jacobian(self.robot, q) * self.units)
        except TaskError:
            return np.full((len(self.rows), len(self.units)), np.nan)


@dataclass(frozen=True, eq=False)
class WithoutJoints:
    """Of a J without columns: no singular value can vanish, and the product of none is 1."""

    sendable: ClassVar[bool] = True

    def measures(self, q: Array, names: tuple[str, ...]) -> dict[str, Array]:
        """Return measure → values (N,) at the configurations q (0, N)."""
        values = {"sigma_min": np.inf, "condition": 1.0, "manipulability": 1.0}
        return {name: np.full(q.shape[1], values[name]) for name in names}


Measurement = KernelMeasurement | TaskMeasurement | WithoutJoints  # of a chunk; `sendable`: to another process


def measurement_of(robot: Robot, task: Task, rank: int, length: float, count: int | None = None) -> Measurement:
    """Return the measurement of a task's J, with lengths in units of `length` [m]: by the kernels if they serve it.

    Args:
        count: of configurations, all measured in this process: of a few, no kernel is compiled.
    """
    if robot.nv == 0:
        return WithoutJoints()
    form = task.frame_map()
    S = standing_rows(robot, task)
    if form is not None and S is not None:
        by_kernel = _kernel_measurement(robot, form, S, rank, length)
        return by_kernel if count is None else by_kernel.worth_compiling(count)
    rows = np.array([1 / length if unit == "m" else 1.0 for unit in task.row_units])
    return TaskMeasurement(robot, task, rows, np.where(robot.revolute, 1.0, length), rank)


def _kernel_measurement(robot: Robot, form: FrameMap, S: Array, rank: int, length: float) -> KernelMeasurement:
    axes = reference_axes(robot, np.zeros(robot.nq), form.reference)
    chain = chain_arrays(robot, form.frame, unit=length, axes=axes)
    moving = np.unique(chain.coordinate)
    units = np.where(robot.revolute, 1.0, length)
    chain = chain._replace(coordinate=np.searchsorted(moving, chain.coordinate))
    return KernelMeasurement(chain, S, moving, units, rank)


def named(found: SingularityMeasures, names: tuple[str, ...]) -> dict[str, Array]:
    """Return the measures that are asked for."""
    answer = {"sigma_min": found.smallest, "manipulability": found.product}
    if "condition" in names:
        with np.errstate(divide="ignore", invalid="ignore"):
            answer["condition"] = np.where(found.smallest > 0, found.largest / found.smallest, np.inf)
    return {name: answer[name] for name in names}
