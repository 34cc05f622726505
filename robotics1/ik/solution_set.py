"""Every solution of one target, and how much is known about them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.notation import count, joint_value, number
from robotics1.results import Listed, require
from robotics1.robot.model import Robot
from robotics1.tables import Table, table_of
from robotics1.tasks.task import Task

Rows = Sequence[Array] | Array
SHOWN = 32  # solutions in a table; of infinitely many there are more


@dataclass(frozen=True, eq=False)
class IKSolutions(Listed[Array]):
    """The solutions of f(q) = r_d inside the joint limits, each listed once: whole turns of a joint apart are one.

    Attributes:
        q: (k, nq) the solutions [rad or m].
        singular: (k,) True where J loses rank.
        status: how many there are: FINITE, BOUNDARY, INFINITE, UNREACHABLE or NOT_FOUND.
        complete: whether the method proves that there are no others.
        method: how they were found.
        closest: (nq,) the configuration with the least error, when there is no solution as well.
        error_norm: |r_d − f(closest)|, in the task's units [m, rad].
        free_joints: the joints that do not move the task, such as fingers beside the tool; in `q` they stand in the
            middle of their range, and their freedom does not count as infinitely many solutions.
        dimension: of the family, when there are infinitely many: 1 for a curve; 0 for finitely many.
        within_limits: (k,) True where a solution is inside the robot's limits, as all in `q` are.
        outside_limits: (j, nq) the solutions outside the limits, where the method finds these too.
        robot, task: whose solutions they are.
        boundary_distance: how far the target is from the nearest one with a double solution that was seen [m, rad],
            where that is less than 1e-6; else ∞. Of the two that meet one may be outside the limits.
        families: of each curve or set of solutions, equations that hold along it, such as ("q5 = 0", "q4 + q6 = 0.7").
            Sets of a search with the same equations, or none, are one.
        tangents: (k, nq) the unit tangent of the curve at each solution, zero of one that stands alone, or where J of
            a redundant arm loses rank; empty where there are no curves.
        hits: (k,) how many starts of a search have led to each solution; empty where no search has found single ones.
        unseen: the estimated share of starts that lead to solutions not seen yet; 0 by formula.
    """

    entries_in = "q"

    q: Array
    singular: npt.NDArray[np.bool_]
    status: IKStatus
    complete: bool
    method: str
    closest: Array
    error_norm: float
    free_joints: tuple[str, ...]
    dimension: int
    within_limits: npt.NDArray[np.bool_]
    outside_limits: Array
    robot: Robot = field(repr=False)
    task: Task = field(repr=False)
    boundary_distance: float = np.inf
    families: tuple[tuple[str, ...], ...] = ()
    tangents: Array = field(default_factory=lambda: np.zeros((0, 0)))
    hits: npt.NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    unseen: float = 0.0

    @cached_property
    def labels(self) -> tuple[tuple[str, ...], ...]:
        """The names of each solution's posture, such as ("shoulder right", "elbow up", "wrist not flipped").

        Each name is the sign of a factor of det J, so that it changes at a singularity only:

        - shoulder: (z₁ × n) · (c − o₁), with n the axis of joint 2 and c the tool's point, or the centre of the wrist.
          Right is where a positive turn of joint 2 raises c along z₁ (Lee and Ziegler, 1984: their ARM).
        - elbow: n · ((c − o₂) × (c − o₃)), times the shoulder's sign. Up is where axis 3 lies above the line from joint
          2 to c, along z₁. Of arms in a plane: where it lies left of the line, with the plane's axes right and up.
          Of SCARA arms the elbow is left or right of that line, seen from above.
        - reach: (c − o) · z of a prismatic joint, from the turning joint beside it: forward if it is positive.
        - wrist: (z₄ × z₆) · z₅ = sin q₅ if q₅ = 0 is where axes 4 and 6 point the same way. Flipped if it is negative.

        An arm of another structure is given the sign of det J if J is square, else no names. A name ends with
        "singular" where its factor is zero.

        Source: Lee and Ziegler, IEEE Trans. Aerospace and Electronic Systems, 1984; Siciliano, Sciavicco, Villani,
        Oriolo, Robotics, 2009, section 2.12.
        """
        return self.labels_of(self.q)

    def labels_of(self, q: Array) -> tuple[tuple[str, ...], ...]:
        """Return the names of the postures of other configurations (k, nq), such as `outside_limits`."""
        from robotics1.ik.postures.labels import postures

        return postures(self.robot, self.task).labels(q)

    def _tables(self) -> tuple[Table, ...]:
        if not len(self):
            return ()
        writers = [joint_value if turns else number for turns in self.robot.revolute]
        rows = []
        for i, (q, labels, flag) in enumerate(zip(self.q[:SHOWN], self.labels, self.singular, strict=False)):
            values = [write(float(x)) for write, x in zip(writers, q, strict=True)]
            rows.append((str(i), *values, ", ".join((*labels, *(["singular"] * bool(flag))))))
        return (table_of(("", *map(printable, self.robot.joint_names), "posture"), rows),)

    def explain(self) -> str:
        """Return how many solutions there are, and the nearest miss if there is none, in sentences."""
        if not len(self):
            return f"{self.status.value}; the nearest miss is |e| = {self.error_norm:.3g}"
        rest = (
            ("no other curve exists" if self.dimension else "these are all") if self.complete else "there may be others"
        )
        if len(self.hits):
            led = f"{count(int(self.hits.sum()), 'start')} led to these, at least {self.hits.min()} to each"
            rest += f": {led}; the next leads to another with an estimated chance of {self.unseen:.2g}"
        found = f"{len(self)}{' samples' * bool(self.dimension)} found by {self.method}, {rest}"
        free = f"; free joints: {', '.join(self.free_joints)}" if self.free_joints else ""
        along, noun = ("along", "curve") if self.dimension == 1 else ("on", "set")
        alike = Counter(filter(None, self.families)).items()
        curves = "".join(f"; {along} {count(n, noun)} with {', '.join(equations)}" for equations, n in alike)
        kind = {0: "", 1: ", on curves"}.get(self.dimension, f", a set of dimension {self.dimension}")
        edge = f"; a boundary is {self.boundary_distance:.3g} away" if self.boundary_distance < np.inf else ""
        edge = "; J loses rank there" if self.boundary_distance == 0 else edge
        return f"{self.status.value}{kind}: {found}{free}{curves}{edge}"

    def require(self) -> IKSolutions:
        """Return self if there is a solution.

        Raises:
            NotConverged: there is none.
        """
        return require(self, len(self) > 0)


def solutions_of(
    problem: ScaledTask, q: Rows, singular: npt.ArrayLike, outside: Rows = (), **facts: Any
) -> IKSolutions:
    """Return solutions inside the limits, those outside, and the other facts that `IKSolutions` has of them."""
    nq = problem.robot.nq
    return IKSolutions(
        q=np.reshape(q, (len(q), nq)),
        singular=np.array(singular, dtype=bool),
        within_limits=np.ones(len(q), dtype=bool),
        outside_limits=np.reshape(outside, (len(outside), nq)),
        free_joints=problem.free_joints,
        robot=problem.robot,
        task=problem.task,
        **facts,
    )
