"""The formulas of a task, each compared with Pinocchio when it is asked for."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy

from robotics1.angles import without_turns
from robotics1.caching import cached_property
from robotics1.differentiation import Estimate
from robotics1.errors import FormulaError, TaskError
from robotics1.inputs import Array, one_of
from robotics1.other_words import made_by
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.chain import Chain
from robotics1.symbolic.tasks.at_configuration import ConfigurationFormulas, at_values, exact_values
from robotics1.symbolic.tasks.rates import rate_of, velocity_product_of
from robotics1.symbolic.tasks.shown_formulas import in_characters, in_html, in_latex
from robotics1.symbolic.tasks.symbolic_task import SymbolicTask
from robotics1.symbolic.tasks.verification import (
    Point,
    TaskNumbers,
    Trials,
    numeric_determinant,
    numeric_product,
    rounded,
)
from robotics1.symbolic.writing.decimals import lengths_in
from robotics1.symbolic.writing.printing import latex_text
from robotics1.symbolic.writing.readable import readable
from robotics1.symbolic.writing.source_code import c_function, matlab_function, python_function
from robotics1.tasks.task import Task

PRINTED = {
    "value": "r = f(q)",
    "jacobian": "J(q)",
    "determinant": "det J(q)",
    "jacobian_rate": "dJ/dt",
    "velocity_product": "dJ/dt qdot",
}


@made_by("formulas('prr', 'planar-pose')")
@dataclass(frozen=True, eq=False)
class Formulas(Frozen):
    """The formulas of a task, in q1, q2, ... and the robot's named parameters.

    Each is compared with Pinocchio at random q and parameters when it is first asked for, and a FormulaError is
    raised where they differ by more than 1e-9, or 30 times the estimated error of the numbers.

    Attributes:
        robot, task: of what; with a chosen point, the robot has one more frame, and the task is on it.
        row_names: the rows of J.
        q: the symbols q1, q2, ...
        cleaned: the largest correction that made an angle of the file exact, as 1.5708 to π/2 [rad].
        unvalued: the names of a chosen point that no number is known for.
    """

    robot: Robot
    task: Task
    row_names: tuple[str, ...]
    q: tuple[sympy.Symbol, ...]
    cleaned: float
    unvalued: tuple[str, ...]
    symbolic_task: SymbolicTask = field(repr=False)

    def _sentences(self) -> str:
        """Return r, J and det J, each below its name."""
        return "\n".join(in_characters(name, formula) for name, formula in self._readable().items())

    def _repr_latex_(self) -> str:
        return in_latex(self._readable())

    def _repr_html_(self) -> str:
        return in_html(self._readable())

    def _readable(self) -> dict[str, Any]:
        """Return r, J and det J by their names, in decimals and lengths."""
        named = {"r": self.value, "J": self.jacobian, **self._determinant()}
        return {name: self.readable(formula) for name, formula in named.items()}

    def readable(self, formula: Any) -> Any:
        """Return a formula of this arm with five digits, and with lengths of its file for coefficients.

        −26673 (8500 cos q2 + 7845 cos(q2 + q3)) sin q3 / 3200000000 is read as
        −0.16671 (0.425 cos q2 + 0.39225 cos(q2 + q3)) sin q3. To compute, take the formula itself.

        Args:
            formula: an expression, a matrix, or an equation; one with 0 on the right loses its constant factor.
        """
        return readable(formula, lengths_in(self.robot, self.task))

    def _determinant(self) -> dict[str, sympy.Expr]:
        """Return the determinant by its name, where J is square and it is found."""
        if len(self.row_names) != len(self.q):
            return {}
        with suppress(FormulaError):
            return {"det J": self.determinant}
        return {}

    @cached_property
    def value(self) -> sympy.Matrix:
        """The value r = f(q): a column; of an orientation (3, 3), of a pose the homogeneous (4, 4)."""
        r = self.symbolic_task.value
        self._trials.verify(r, self._numbers.value, "the value", difference=self._difference)
        return r

    @cached_property
    def jacobian(self) -> sympy.Matrix:
        """J(q), (m, n)."""
        J = self.symbolic_task.jacobian
        self._trials.verify(J, self._numbers.jacobian, "J")
        return J

    @cached_property
    def qdot(self) -> tuple[sympy.Symbol, ...]:
        """The velocities q̇1, q̇2, ..., in the formulas of J̇; qdot_1, ... if a parameter is called qdot1."""
        word = "qdot"
        while any(name.startswith(word) for name in self.robot.parameters):
            word += "_"
        return tuple(sympy.Symbol(f"{word}{i}", real=True) for i in range(1, len(self.q) + 1))

    @cached_property
    def jacobian_rate(self) -> sympy.Matrix:
        """J̇(q, q̇) = dJ/dt, (m, n)."""
        rates = rate_of(self.jacobian, self.q, self.qdot)
        self._trials.verify(rates, self._numbers.jacobian_rate, "J̇")
        return rates

    @cached_property
    def velocity_product(self) -> sympy.Matrix:
        """J̇ q̇, (m, 1), of r̈ = J q̈ + J̇ q̇."""
        product = velocity_product_of(self.jacobian, self.q, self.qdot)

        def numeric(point: Point) -> Estimate:
            return numeric_product(self._numbers.jacobian_rate(point), rounded(point.qdot))

        self._trials.verify(product, numeric, "J̇ q̇")
        return product

    @cached_property
    def determinant(self) -> sympy.Expr:
        """Det J(q), reduced and factored.

        Raises:
            TaskError: J is not square.
            FormulaError: it cannot be reduced, or does not agree with Pinocchio.
        """
        m, n = len(self.row_names), len(self.q)
        if m != n:
            raise TaskError(f"J is {m} × {n}: it has minors, but no determinant")
        return self.minors[()]

    @cached_property
    def minors(self) -> dict[tuple[int, ...], sympy.Expr]:
        """The largest minors: the columns (or, of a tall J, rows) that are left out, from 0 → the minor, factored.

        Without joints it is one, of order 0: 1.

        Raises:
            FormulaError: they cannot be reduced, or do not agree with Pinocchio.
        """
        if not self.q:
            return {tuple(range(len(self.row_names))): sympy.S.One}
        found = {out: self.symbolic_task.written_minor(minor) for out, minor in self.symbolic_task.minors.items()}

        def numeric(point: Point) -> Estimate:
            J = self._numbers.jacobian(point)
            axis = int(J.value.shape[1] > J.value.shape[0])
            minors = [numeric_determinant(Estimate(*(np.delete(part, out, axis) for part in J))) for out in found]
            return Estimate(*map(np.array, zip(*minors, strict=True)))

        self._trials.verify(sympy.Matrix(list(found.values())), numeric, "a minor of J")
        return found

    @cached_property
    def gram_determinant(self) -> sympy.Expr:
        """Det(J Jᵀ) of a square or wide J, det(Jᵀ J) of a tall one: zero where J loses rank; reduced and factored.

        Raises:
            FormulaError: it cannot be reduced, or does not agree with Pinocchio.
        """
        found = self.symbolic_task.gram_determinant if self.q else sympy.S.One

        def numeric(point: Point) -> Estimate:
            J = self._numbers.jacobian(point)
            transposed = Estimate(J.value.T, J.error.T)
            wide = J.value.shape[0] <= J.value.shape[1]
            return numeric_determinant(numeric_product(*((J, transposed) if wide else (transposed, J))))

        self._trials.verify(sympy.Matrix([found]), numeric, "det(J Jᵀ)")
        return found

    @property
    def chain(self) -> Chain:
        """The joints from the world to the frame."""
        return self.symbolic_task.chain

    def at(self, q: Sequence[Any] | None = None, /, **values: Any) -> ConfigurationFormulas:
        """Return value and Jacobian at a configuration, exact, with rank, bases and pseudoinverse: f.at(q1=0, q2=pi/2).

        What is not given stays a symbol. Decimals are read as fractions, and angles as multiples of π/12 where they
        are these to rounding; so is one printed with three decimals or more, as 1.5708, and the result says so.

        Args:
            q: (n,) all joints in order, numbers or SymPy expressions; or none, and joints by name.
            values: by the names in the formulas: q1, q2, ... [rad or m], and lengths.

        Raises:
            UnknownNameError: the formulas have no such name.
            InputError: a value is neither a real number nor a SymPy expression, or q has another length.
            TaskError: the task has no value or no Jacobian there.
        """
        names = dict(zip((symbol.name for symbol in self.q), self.robot.revolute.tolist(), strict=True))
        angles = {symbol.name for symbol in self.chain.trig_ring.angles}
        joints = tuple(names)
        names |= {name: name in angles for name in self.robot.parameters}
        exact, read = exact_values(names, q, values, joints)
        known = {sympy.Symbol(name, real=True): value for name, value in exact.items()}
        value = at_values(self.value, known, "the task")
        return ConfigurationFormulas(
            self.row_names, tuple(known.items()), value, at_values(self.jacobian, known, "J"), read
        )

    @cached_property
    def _trials(self) -> Trials:
        return Trials(self.robot, self.q, self.qdot)

    @cached_property
    def _numbers(self) -> TaskNumbers:
        return TaskNumbers(self.task, [self.task.row_names.index(name) for name in self.row_names])

    def _difference(self, ours: Array, theirs: Array) -> Array:
        """Return ours − theirs; angles of a task on a frame count up to whole turns."""
        difference = ours - theirs
        if self.symbolic_task.task.wraps and difference.shape == (len(self.row_names), 1):
            angles = [self.task.row_units[i] == "rad" for i in self._numbers.places]
            difference[angles] = without_turns(difference[angles])
        return difference

    def python(self, name: str = "jacobian") -> str:
        """Return the source of a function f(q) of NumPy: f(q, qdot) for J̇ and J̇ q̇, parameters by keyword.

        Args:
            name: "value", "jacobian", "determinant", "jacobian_rate" or "velocity_product".

        Raises:
            InputError: there is no such formula.
        """
        return python_function(name, *self._as_function(name))

    def c(self, name: str = "jacobian") -> str:
        """Return the source of a function of C99: `void name(const double *q, double l2, ..., double *out)`.

        Raises:
            InputError: there is no such formula.
        """
        return c_function(name, *self._as_function(name))

    def matlab(self, name: str = "jacobian") -> str:
        """Return the source of a function of MATLAB, and of GNU Octave: `function out = name(q, l2, ...)`.

        Raises:
            InputError: there is no such formula.
        """
        return matlab_function(name, *self._as_function(name))

    def latex(self, name: str = "jacobian") -> str:
        """Return a formula in LaTeX.

        Raises:
            InputError: there is no such formula.
        """
        return latex_text(getattr(self, one_of("name", name, tuple(PRINTED))))

    def _as_function(self, name: str) -> tuple[Any, dict[str, Any], dict[str, float | None], str]:
        """Return a formula, its arguments that are vectors, its parameters with their values, and what it is."""
        one_of("name", name, tuple(PRINTED))
        formula = getattr(self, name)
        column = name == "velocity_product" or (name == "value" and formula.cols == 1)
        vectors: dict[str, Any] = {"q": self.q}
        if name in ("jacobian_rate", "velocity_product"):
            vectors["qdot"] = self.qdot
        values = {key: None if key in self.unvalued else value for key, value in self.robot.parameters.items()}
        rows = f"; rows {', '.join(self.row_names)}" if name in ("jacobian", "jacobian_rate") else ""
        summary = f"{PRINTED[name]} of {self.robot.name}, joints {', '.join(self.robot.joint_names)}{rows}"
        return list(formula) if column else formula, vectors, values, summary
