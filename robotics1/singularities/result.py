"""The singular configurations of a task, as branches."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.notation import pi_fraction
from robotics1.results import Frozen, Listed, require
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.singularities.spaces import Subspaces, subspaces_of_rank
from robotics1.tasks.task import Task

if TYPE_CHECKING:
    import sympy

    from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas, SymbolicJacobian
    from robotics1.symbolic.singular_sets.zeros import Zero


@dataclass(frozen=True, eq=False)
class SingularBranch(Frozen):
    """A smooth piece of the singular set; pieces that cross each other are two branches.

    In exact form it is all that its equations describe, which may be several loops. By numbers it is what walks on the
    set have connected.

    Attributes:
        robot, task: whose Jacobian loses rank; a branch in exact form has the robot with exact angles.
        box: where the samples lie: inside the joint limits, or anywhere.
        generic_rank: ρ, the rank of J almost everywhere.
        dimension: of the piece in joint space: 0 for an isolated configuration, n − 1 for a hypersurface.
        values: joint name → the value it has everywhere on the branch [rad or m].
        free_joints: the joints that never matter: whatever their value, the configuration stays on the branch.
        samples: (k, nq) configurations on the branch, σ_min ≤ 1e-10 σ₁; at least 50 unless it is one point.
        q: (nq,) a configuration of the branch at which the bases below are taken.
        rank: the rank of J on the branch (almost everywhere on it).
        formulas: its equations and bases in symbols, of a branch that was found in exact form.
        note: whether it lies at a joint limit, or outside of one by less than 1e-6 rad or reaches; and whether the time
            was over before more than one configuration of it was found.
    """

    robot: Robot = field(repr=False)
    task: Task = field(repr=False)
    box: JointBox = field(repr=False)
    generic_rank: int
    dimension: int
    values: Mapping[str, float]
    free_joints: tuple[str, ...]
    samples: Array = field(repr=False)
    q: Array
    rank: int
    formulas: BranchFormulas | None = field(default=None, repr=False)
    note: str = ""

    @property
    def conditions(self) -> tuple[sympy.Eq, ...]:
        """The equations of the branch in q1, q2, ... and the named lengths: values of joints, and polynomials that
        vanish. Of a branch that was found by numbers, the joints that are tied to each other have σ_min = 0.
        """
        if self.formulas is not None:
            return self.formulas.conditions
        import sympy

        names = self.robot.joint_names
        symbols = dict(zip(names, sympy.symbols(f"q1:{len(names) + 1}", real=True), strict=True))
        equations = [sympy.Eq(symbols[name], _recognised(value)) for name, value in self.values.items()]
        tied = [symbols[name] for name in self.tied_joints]
        if tied:
            equations.append(sympy.Eq(sympy.Function("sigma_min")(*tied), 0))
        return tuple(equations)

    def require_formulas(self) -> BranchFormulas:
        """Return the formulas.

        Raises:
            FormulaError: the branch was found by numbers.
        """
        if self.formulas is None:
            raise FormulaError("a branch was found by numbers, so there are no formulas of it")
        return self.formulas

    @property
    def tied_joints(self) -> tuple[str, ...]:
        """The joints that are neither constant nor free: they move together on the branch."""
        names = self.robot.joint_names
        return tuple(name for name in names if name not in self.values and name not in self.free_joints)

    @cached_property
    def spaces(self) -> Subspaces:
        """The subspaces of J at `q`, of the branch's rank."""
        return subspaces_of_rank(self.jacobian(self.q), self.rank)

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
        return self.task.jacobian(self.robot, q)

    def sample(self, rng: np.random.Generator) -> Array:
        """Return a random configuration of the branch, (nq,): of a branch that was found by numbers, one of
        `samples` with the free joints drawn anew.
        """
        if self.formulas is not None:
            drawn = self.formulas.draw(self.box, rng)
            if drawn is not None:
                return drawn
        q: Array = self.samples[rng.integers(len(self.samples))].copy()
        free = [self.robot.joint_names.index(name) for name in self.free_joints]
        q[free] = self.box.random(rng, 1)[0, free]
        return q

    def contains(self, q: Array) -> bool:
        """Return whether q (nq,) is on the branch; False of a branch that was found by numbers."""
        return self.formulas is not None and self.formulas.contains(self.robot.configuration(q))

    def explain(self) -> str:
        """Return what the branch means for the robot, in sentences."""
        from robotics1.singularities.explain import branch_sentences

        return printable(branch_sentences(self), keep="\n")


class SingularSetStatus(Enum):
    """Which of the singular configurations inside the joint limits are known."""

    COMPLETE = "these are all singular configurations"
    NOWHERE_SINGULAR = "there is no singular configuration"
    INCOMPLETE = "this was a search: it does not prove that there are no others"
    NOT_FOUND = "no singular configuration was found"


@dataclass(frozen=True, eq=False)
class SingularSet(Listed[SingularBranch]):
    """All singular configurations of a robot in a task.

    Attributes:
        robot, task: whose.
        box: where the branches lie: inside the joint limits.
        generic_rank: ρ, the rank of J almost everywhere; on the singular set the rank is lower.
        branches: its pieces, the larger first.
        method: "symbolic" or "numeric", how they were found; "both" when exact and numeric ones stand together.
        complete: whether the method proves that there are no others inside the joint limits.
        note: why the answer is not the exact one, if it is not.
        outside: the branches that lie outside the joint limits; found in exact form only.
        time_limit: in which it was found; `find_intersections` and `parameter_conditions` have as much [s].
        jacobian: the task's Jacobian in exact form, if it was found.
        without_solution: the equations of the lengths, or of one joint, that were met and have no solution.
    """

    entries_in = "branches"

    robot: Robot
    task: Task
    box: JointBox = field(repr=False)
    generic_rank: int
    branches: tuple[SingularBranch, ...]
    method: str
    complete: bool
    note: str = ""
    outside: tuple[SingularBranch, ...] = ()
    time_limit: float = field(default=30.0, repr=False)
    jacobian: SymbolicJacobian | None = field(default=None, repr=False)
    without_solution: tuple[Zero, ...] = field(default=(), repr=False)

    @property
    def status(self) -> SingularSetStatus:
        """COMPLETE, or NOWHERE_SINGULAR where there is no branch; of a search INCOMPLETE or NOT_FOUND."""
        if self.complete:
            return SingularSetStatus.COMPLETE if self.branches else SingularSetStatus.NOWHERE_SINGULAR
        return SingularSetStatus.INCOMPLETE if self.branches else SingularSetStatus.NOT_FOUND

    @cached_property
    def generic_bases(self) -> BranchFormulas | None:
        """The bases of N(J), R(J) and N(Jᵀ) in symbols where J has rank ρ; they hold almost everywhere, as all entries
        of a vector may vanish together. None of a set that was found by numbers.
        """
        if self.jacobian is None:
            return None
        from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas
        from robotics1.symbolic.singular_sets.locus import Piece

        everywhere = Piece(self.jacobian.everywhere, self.jacobian.parameters, {})
        return BranchFormulas(self.jacobian, everywhere, self.generic_rank)

    @property
    def free_joints(self) -> tuple[str, ...]:
        """The joints that matter on no branch."""
        names = self.robot.joint_names
        return tuple(name for name in names if all(name in branch.free_joints for branch in self.branches))

    def _repr_latex_(self) -> str | None:
        """Return the conditions of the branches, and the rank on each; None of a set that was found by numbers."""
        if not self.branches or any(branch.formulas is None for branch in self.branches):
            return None
        from robotics1.symbolic.writing.decimals import lengths_in
        from robotics1.symbolic.writing.printing import aligned, latex_text
        from robotics1.symbolic.writing.readable import readable

        lengths = lengths_in(self.robot, self.task)
        rows = [
            ", ".join(latex_text(readable(condition, lengths)) for condition in branch.conditions)
            + rf" &\Rightarrow \mathrm{{rank}}\,J = {branch.rank}"
            for branch in self.branches
        ]
        return aligned(rows)

    def explain(self) -> str:
        """Return the singularities in sentences, with the conditions on lengths of `parameter_conditions`."""
        return self._explanation

    def require(self) -> SingularSet:
        """Return self if it is proven that there are no other singular configurations inside the joint limits.

        Raises:
            NotConverged: the answer is that of a search.
        """
        return require(self, self.complete)

    @cached_property
    def _explanation(self) -> str:
        """The sentences, which are found once: to find the conditions on lengths takes as long as to find the set."""
        from robotics1.singularities.explain import set_sentences

        return printable(set_sentences(self), keep="\n")


@dataclass(frozen=True, eq=False)
class Intersections(Frozen):
    """Where branches of a singular set meet, and where the rank falls further inside one.

    Attributes:
        branches: the pieces, the larger first.
        complete: whether these are all: of branches in exact form, and found within the time limit.
    """

    branches: tuple[SingularBranch, ...]
    complete: bool

    def explain(self) -> str:
        """Return the rank on each piece, a line for each."""
        from robotics1.singularities.explain import intersection_sentences

        return printable(intersection_sentences(self), keep="\n")


def _recognised(value: float) -> sympy.Expr:
    import sympy

    fraction = pi_fraction(value)
    if fraction is None:
        return sympy.Float(value)
    return sympy.Rational(fraction.numerator, fraction.denominator) * sympy.pi
