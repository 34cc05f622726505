"""det J of a task that as many joints move as it has rows: its values, and a bound of its slope."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.ik.joint_chain import FixedChain, chain_and_rows
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.inputs import Array
from robotics1.notation import count
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SAMPLES = 200  # configurations at which the largest |det J| is taken
ZERO = 1e-12  # the largest |det J| of a J that is singular everywhere
DEPENDS = 1e-9  # change of det J, beside its largest value, with a joint that it depends on


@dataclass(frozen=True, eq=False)
class Determinant:
    """det J(q), relative to its largest absolute value at random configurations.

    Attributes:
        problem: the task, in the box in which configurations are drawn.
        chain: of the joints that move the task; None where there is no such chain of numbers (followers, functions).
        rows: which of (x, y, z, and the turns about them) the task has.
    """

    problem: ScaledTask
    chain: FixedChain | None
    rows: tuple[int, ...]

    def __call__(self, q: Array) -> Array:
        """Return det J(q)/max |det J| at configurations (k, nq): (k,)."""
        return np.asarray(self._values(q) / self.largest)

    @cached_property
    def largest(self) -> float:
        """The largest |det J|, without units, at random configurations.

        Raises:
            TaskError: J is singular everywhere.
        """
        value = float(np.abs(self._values(self.problem.random(np.random.default_rng(0), SAMPLES))).max())
        if value < ZERO:
            raise TaskError("J is singular everywhere, so that no configuration is apart from a singularity")
        return value

    @cached_property
    def active(self) -> npt.NDArray[np.bool_]:
        """(nq,) True for the joints that det J depends on."""
        q = self.problem.random(np.random.default_rng(1), 12)
        depends = np.zeros(q.shape[1], dtype=np.bool_)
        for j in np.flatnonzero(self.problem.moving):
            other = q.copy()
            other[:, j] += 0.7 * self.problem.box.unit[j]
            depends[j] = np.abs(self(other) - self(q)).max() > DEPENDS
        return depends

    @property
    def has_bound(self) -> bool:
        """Whether `change` is proven to bound the change of det J."""
        return self.chain is not None

    def change(self, q: Array, step: Array) -> Array:
        """Return a bound of |d det J/dt| on the segments q + t step, 0 ≤ t ≤ 1, both (k, nq): (k,), relative.

        |d/dt det [c₁ ... c_n]| ≤ Σ_i |ċ_i| Π_{j≠i} |c_j|. Joints before i turn the column c_i as it is; joints from i
        on move the point p. A joint k moves p at most by |q̇_k| r_k, where r_k bounds its distance from the axis.
        Where there is no chain of numbers, slopes are measured along the segment, and doubled.
        """
        if self.chain is None:
            t = np.linspace(0, 1, 9)[:, None]
            at = np.array([self(a + t * d) for a, d in zip(q, step, strict=True)])
            return np.asarray(2 * 8 * np.abs(np.diff(at, axis=1)).max(axis=1))
        chain, unit = self.chain, self.problem.length
        columns = list(chain.coordinate)
        x, d = np.abs(q[:, columns]), np.abs(step[:, columns])
        slides = np.array(chain.prismatic)
        links = np.array([np.linalg.norm(P[:3, 3]) for P in chain.P[1:]])
        travel = np.where(slides, np.maximum(x, np.abs((q + step)[:, columns])), 0.0)
        after = np.cumsum((links + np.hstack([travel[:, 1:], np.zeros((len(q), 1))]))[:, ::-1], axis=1)[:, ::-1] / unit
        moved = d * np.where(slides, 1.0 / unit, after)  # of the point, by each joint
        turned = np.cumsum(np.where(slides, 0.0, d), axis=1) - np.where(slides, 0.0, d)  # by the joints before
        size = np.where(slides, 1.0, np.hypot(after, 1.0) if max(self.rows) > 2 else after)
        of_point = np.cumsum(moved[:, ::-1], axis=1)[:, ::-1]
        rate = turned * size + np.where(slides, 0.0, of_point)
        rest = [np.prod(np.delete(size, i, axis=1), axis=1) for i in range(size.shape[1])]
        return np.asarray((rate * np.stack(rest, axis=1)).sum(axis=1) / self.largest)

    def _values(self, q: Array) -> Array:
        problem = self.problem
        if self.chain is None:
            return np.array([np.linalg.det(problem.jacobian(p)[:, problem.moving]) for p in q])
        _, J = self.chain.poses_and_jacobians(q[:, list(self.chain.coordinate)])
        rows = np.where(np.array(self.rows) < 3, 1 / problem.length, 1.0)
        columns = np.where(self.chain.prismatic, problem.length, 1.0)
        return np.asarray(np.linalg.det(rows[:, None] * J[:, self.rows] * columns))


def determinant(robot: Robot, task: Task) -> Determinant:
    """Return det J of a task.

    Raises:
        TaskError: as many joints as the task has rows do not move it, its axes move, or J is singular everywhere.
    """
    task.check_integrable(robot)
    problem = scaled_task(robot, task, open_ranges=True)
    n = int(np.count_nonzero(problem.moving))
    if n == 0:
        raise TaskError("no joint moves the task, so that it has no postures")
    if n != task.rows:
        raise TaskError(
            f"{count(n, 'joint')} and {count(task.rows, 'row')} of the task: postures differ by the sign "
            f"of det J, which is of a square J"
        )
    chain, rows = chain_and_rows(problem)
    found = Determinant(problem, chain if len(rows) == n else None, rows)
    _ = found.largest  # raises where J is singular everywhere
    return found
