"""The singular configurations of a task, as branches."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from robotics1.analysis.singular_points import SingularPoints
from robotics1.analysis.spaces import Subspaces, subspaces
from robotics1.inputs import Array
from robotics1.notation import pi_fraction
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

if TYPE_CHECKING:
    import sympy


@dataclass(frozen=True, eq=False)
class SingularBranch:
    """A connected smooth piece of the singular set; pieces that cross each other are told apart.

    Attributes:
        dimension: of the piece in joint space: 0 for an isolated configuration, n − 1 for a hypersurface.
        values: joint name → the value it has everywhere on the branch [rad or m].
        free_joints: the joints that never matter: whatever their value, the configuration stays on the branch.
        samples: (k, nq) configurations on the branch, σ_min ≤ 1e-10 σ₁; at least 50 unless it is one point.
        q: (nq,) a configuration of the branch at which the bases below are taken.
        rank: the rank of J on the branch (almost everywhere on it).
    """

    points: SingularPoints = field(repr=False)
    dimension: int
    values: Mapping[str, float]
    free_joints: tuple[str, ...]
    samples: Array = field(repr=False)
    q: Array
    rank: int

    @property
    def conditions(self) -> "tuple[sympy.Eq, ...]":
        """The equations of the branch in q1, q2, ...: a value for each constant joint, and for the joints that
        are tied to each other, σ_min = 0.
        """
        import sympy

        names = self.points.robot.joint_names
        symbols = dict(zip(names, sympy.symbols(f"q1:{len(names) + 1}", real=True), strict=True))
        equations = [sympy.Eq(symbols[name], _recognised(value)) for name, value in self.values.items()]
        tied = [symbols[name] for name in self.tied_joints]
        if tied:
            equations.append(sympy.Eq(sympy.Function("sigma_min")(*tied), 0))
        return tuple(equations)

    @property
    def tied_joints(self) -> tuple[str, ...]:
        """The joints that are neither constant nor free: they move together on the branch."""
        names = self.points.robot.joint_names
        return tuple(name for name in names if name not in self.values and name not in self.free_joints)

    @cached_property
    def spaces(self) -> Subspaces:
        """The subspaces of J at `q`, where entries that are rounding count as zero."""
        J = self.jacobian(self.q)
        return subspaces(np.where(np.abs(J) > 1e-14 * self.points.scale * self.points.robot.reach, J, 0.0))

    @property
    def null(self) -> Array:
        """(n, n − r) joint velocities that do not move the task, at `q`."""
        return self.spaces.null

    @property
    def range(self) -> Array:
        """(m, r) task velocities that can be realised, at `q`."""
        return self.spaces.range

    @property
    def left_null(self) -> Array:
        """(m, m − r) task velocities that are lost, and forces that need no torque, at `q`."""
        return self.spaces.left_null

    def jacobian(self, q: Array) -> Array:
        """Return the task's J(q), (m, n)."""
        return self.points.task.jacobian(self.points.robot, q)

    def sample(self, rng: np.random.Generator) -> Array:
        """Return a random configuration of the branch, (nq,): one of `samples` with the free joints drawn anew."""
        q: Array = self.samples[rng.integers(len(self.samples))].copy()
        free = [self.points.robot.joint_names.index(name) for name in self.free_joints]
        q[free] = self.points.box.random(rng, 1)[0, free]
        return q

    def explain(self) -> str:
        """Return what the branch means for the robot, in sentences."""
        from robotics1.analysis.singularity_words import branch_sentences

        return branch_sentences(self)


@dataclass(frozen=True, eq=False)
class SingularSet:
    """All singular configurations of a robot in a task.

    Attributes:
        generic_rank: ρ, the rank of J almost everywhere; on the singular set the rank is lower.
        branches: its pieces, the larger first.
        method: how they were found.
        complete: whether the method proves that there are no others.
    """

    robot: Robot
    task: Task
    generic_rank: int
    branches: tuple[SingularBranch, ...]
    method: str
    complete: bool

    @property
    def free_joints(self) -> tuple[str, ...]:
        """The joints that matter on no branch."""
        names = self.robot.joint_names
        return tuple(name for name in names if all(name in branch.free_joints for branch in self.branches))

    def explain(self) -> str:
        """Return the singularities in sentences."""
        from robotics1.analysis.singularity_words import set_sentences

        return set_sentences(self)


def _recognised(value: float) -> "sympy.Expr":
    import sympy

    fraction = pi_fraction(value)
    if fraction is None:
        return sympy.Float(value)
    return sympy.Rational(fraction.numerator, fraction.denominator) * sympy.pi
