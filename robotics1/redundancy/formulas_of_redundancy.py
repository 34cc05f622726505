"""The formulas of redundancy resolution: pseudoinverse, null space and projector of a task's Jacobian."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy

from robotics1.caching import cached_property
from robotics1.errors import FormulaError, TaskError
from robotics1.inputs import Array
from robotics1.notation import count
from robotics1.redundancy.weighted import (
    null_vectors,
    pivot_columns,
    short,
    weighted_pseudoinverse,
    weighted_pseudoinverse_formula,
)
from robotics1.robot.given import RobotLike
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.tasks.given import TaskLike, robot_and_task

AGREES = 1e-8  # largest difference of a formula from NumPy, relative
TRIALS = 3


@dataclass(frozen=True, eq=False)
class RedundancyFormulas:
    """The formulas of q̇ = J# ṙ + (1 − J⁺J) q̇₀, in q1, q2, ... and the robot's named lengths.

    Each is compared with NumPy at random configurations when it is first asked for.

    Attributes:
        task_formulas: of r, J and the minors.
        weights: of the norm, (n,) or (n, n), of numbers, names or expressions; None for 1.
    """

    task_formulas: Formulas
    weights: Any = field(default=None)

    @property
    def jacobian(self) -> sympy.Matrix:
        """J(q), (m, n)."""
        return self.task_formulas.jacobian

    @cached_property
    def manipulability(self) -> sympy.Expr:
        """√det(J Jᵀ), the root of the sum of the squares of the minors (Cauchy and Binet)."""
        found = sympy.sqrt(short(sympy.Add(*(minor**2 for minor in self.task_formulas.minors.values()))))
        self._verify(sympy.Matrix([found]), lambda J: np.sqrt([[np.linalg.det(J @ J.T)]]), "√det(J Jᵀ)")
        return found

    @cached_property
    def pseudoinverse(self) -> sympy.Matrix:
        """J#, (n, m), of the weighted norm: W⁻¹Jᵀ(J W⁻¹Jᵀ)⁻¹.

        Raises:
            FormulaError: J has nowhere full row rank, or the formula does not agree with NumPy.
        """
        found = weighted_pseudoinverse_formula(self.jacobian, self.weights, self.task_formulas.minors)
        self._verify(found, lambda J: weighted_pseudoinverse(J, self._numeric_weights), "J#")
        return found

    @cached_property
    def null_basis(self) -> sympy.Matrix:
        """A basis of N(J), (n, n − m), of the minors of J."""
        J = self.jacobian
        vectors = null_vectors(J, pivot_columns(self._J_at(self._points[0])), self.task_formulas.minors)
        found = sympy.Matrix(vectors).T if vectors else sympy.zeros(J.cols, 0)
        self._verify(J * found, lambda J: np.zeros((J.shape[0], J.shape[1] - J.shape[0])), "J N")
        return found

    @cached_property
    def projector(self) -> sympy.Matrix:
        """1 − J⁺J, (n, n), the orthogonal projector into N(J); v vᵀ/vᵀv where N(J) is one vector v."""
        J = self.jacobian
        minors = self.task_formulas.minors
        if J.cols - J.rows == 1:
            v, square = self.null_basis, short(sympy.Add(*(minor**2 for minor in minors.values())))
            found = (v * v.T / square).applyfunc(short)
        else:
            found = (sympy.eye(J.cols) - weighted_pseudoinverse_formula(J, None, minors) * J).applyfunc(short)
        self._verify(found, lambda J: np.eye(J.shape[1]) - np.linalg.pinv(J) @ J, "1 − J⁺J")
        return found

    @cached_property
    def _points(self) -> list[Array]:
        rng = np.random.default_rng(0)
        return [rng.uniform(-2, 2, len(self.task_formulas.q)) for _ in range(TRIALS)]

    @cached_property
    def _numbers(self) -> dict[sympy.Symbol, float]:
        """The values of the named lengths; others that the weights have count 2, 3, ..."""
        robot = self.task_formulas.robot
        known = {sympy.Symbol(name, real=True): value for name, value in robot.parameters.items()}
        W = sympy.Matrix([] if self.weights is None else np.ravel(self.weights).tolist())
        free = sorted(W.free_symbols - known.keys() - {*self.task_formulas.q}, key=str)
        return {**known, **{symbol: float(i) for i, symbol in enumerate(free, 2)}}

    @cached_property
    def _numeric_weights(self) -> Array | None:
        if self.weights is None:
            return None
        values = np.asarray(self.weights, dtype=object)
        flat = [float(sympy.sympify(x).xreplace(self._numbers)) for x in values.ravel()]
        return np.array(flat).reshape(values.shape)

    def _J_at(self, q: Array) -> Array:
        return self._at(self.jacobian, q)

    def _at(self, formula: sympy.Matrix, q: Array) -> Array:
        values = {**self._numbers, **dict(zip(self.task_formulas.q, q.tolist(), strict=True))}
        return np.array(formula.xreplace(values).evalf(), dtype=float).reshape(formula.shape)

    def _verify(self, formula: sympy.Matrix, numbers: Any, name: str) -> None:
        """Compare a formula with what NumPy makes of J.

        Raises:
            FormulaError: they differ.
        """
        for q in self._points:
            ours, theirs = self._at(formula, q), numbers(self._J_at(q))
            apart = float(np.abs(ours - theirs).max(initial=0.0))
            if not apart <= AGREES * max(1.0, float(np.abs(theirs).max(initial=0.0))):
                raise FormulaError(f"the formula of {name} differs from NumPy by {apart:.1e}")


def redundancy_formulas(robot: RobotLike, task: TaskLike, *, weights: Any = None) -> RedundancyFormulas:
    """Return the closed formulas of a redundant task: J#, a basis of N(J), 1 − J⁺J, √det(J Jᵀ).

    They are short for small arms, as the PPR or the planar 3R arm; for others the numbers are the answer.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: m rows, not more than the arm has joints.
        weights: of the norm, (n,) or (n, n), of numbers or expressions; None for 1.

    Raises:
        TaskError: the task has more rows than the arm joints, or does not fit.
        FormulaError: the task cannot be read as a formula.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.5.1.
    """
    robot, task = robot_and_task(robot, task)
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint: nothing is redundant")
    found = formulas(robot, task)
    if len(found.row_names) > len(found.q):
        raise TaskError(
            f"the task has {count(len(found.row_names), 'row')} and the arm {count(len(found.q), 'joint')}: "
            "nothing is redundant"
        )
    return RedundancyFormulas(found, weights)
