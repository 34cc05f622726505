"""The formulas of a piece of the singular set: its equations, and bases that are valid on all of it."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from typing import Any

import sympy

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.symbolic.kinematics.convenient_axes import Convenient
from robotics1.symbolic.polynomials.factoring import Part, factors
from robotics1.symbolic.polynomials.laurent import Laurent, Matrix
from robotics1.symbolic.polynomials.substitution import Substitution
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.closed_forms import angle_of_turn, root_of
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.elimination import Echelon, echelon_form, without_divisor
from robotics1.symbolic.writing.recognition import recognised
from robotics1.symbolic.writing.sums_of_angles import Groups, written, written_product

SECONDS = 20.0  # for one basis
SHORT = 18  # entries of a Jacobian whose bases are short enough to be read
SHORT_NULL = 36  # for the null space, which does not depend on the axes


@dataclass(frozen=True, eq=False)
class BranchFormulas:
    """A piece of the singular set in q1, q2, ... and the robot's named parameters.

    Attributes:
        rows: the task's Jacobian in exact form.
        groups: the angles that are added up in writing.
        configurations: the piece.
        rank: of J on it, in numbers.
    """

    rows: Convenient
    groups: Groups
    configurations: Configurations
    rank: int

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: not the echelon form, whose entries are polynomials of FLINT."""
        return {name: value for name, value in vars(self).items() if name != "_columns_of_rows"}

    @cached_property
    def conditions(self) -> tuple[sympy.Eq, ...]:
        """The equations: joints that have a value, then polynomials that vanish."""
        q = self.configurations.locus.frequencies.q
        values = [self._value(s) for s in self.configurations.locus.substitutions if s.symbol in q]
        return (*sorted(values, key=lambda equation: str(equation.lhs)), *self._implicit)

    @property
    def lengths(self) -> tuple[sympy.Eq, ...]:
        """What the branch owes to the robot's lengths, such as a3 = a2; other lengths have other branches."""
        locus = self.configurations.locus
        return tuple(self._value(s) for s in locus.substitutions if s.symbol not in locus.frequencies.q)

    @property
    def _implicit(self) -> tuple[sympy.Eq, ...]:
        return tuple(equation for part in self.configurations.locus.implicit for equation in self._equations(part))

    def _equations(self, part: Part) -> tuple[sympy.Eq, ...]:
        """Return part = 0; or the value of its only joint, in closed form where it has a short one."""
        (expression,) = recognised([self._expression(part).as_content_primitive()[1]])
        plain = sympy.Eq(-expression if expression.could_extract_minus_sign() else expression, 0)
        joints = [i for i, symbol in enumerate(part.frequencies.q) if symbol in part.symbols]
        pinned = self.configurations.pinned.get(joints[0]) if len(joints) == 1 else None
        if pinned is None:
            return (plain,)
        symbol = part.frequencies.q[joints[0]]
        root = root_of(part, symbol, pinned, self.configurations.parameters)
        return (plain, sympy.Eq(symbol, sympy.Float(pinned))) if root is None else (sympy.Eq(symbol, root),)

    def _expression(self, part: Part) -> sympy.Expr:
        """Return the part in SymPy, in half angles where it has some."""
        if not any(part.parity):
            return written_product(factors(part.in_angles), self.groups)
        halves = {angle: angle / 2 for angle in part.frequencies.angles}
        return written(part.in_half_angles, self.groups).subs(halves, simultaneous=True)

    def _value(self, substitution: Substitution) -> sympy.Eq:
        """Return joint = value; of angles with what is added on either side: q3 = q1, 2 q2 + q3 = π."""
        symbol, value = substitution.symbol, substitution.value
        if not substitution.is_angle:
            return sympy.Eq(symbol, written(value, self.groups))
        ((k, _),) = value.terms.items()
        others = [n * phi for n, phi in zip(k, value.frequencies.angles, strict=True)]
        added = [angle for n, angle in zip(k, others, strict=True) if n > 0]
        taken = [angle for n, angle in zip(k, others, strict=True) if n < 0]
        return sympy.Eq(symbol - sympy.Add(*taken), sympy.Add(*added) + angle_of_turn(value))

    def is_short(self, name: str) -> bool:
        """Whether a basis, "null", "range" or "left_null", is found at once and can be read."""
        return bool(self.rows.M.size <= (SHORT_NULL if name == "null" else SHORT))

    @cached_property
    def null(self) -> sympy.Matrix:
        """(n, n − r) a basis of N(J): joint velocities that do not move the task.

        Raises:
            FormulaError: there was no time for it.
        """
        return self._columns(self._echelon(self.rows.M).null, self.rows.M.shape[1])

    @cached_property
    def range(self) -> sympy.Matrix:
        """(m, r) a basis of R(J): task velocities that can be realised. Raises as `null`."""
        vectors = self._columns_of_rows.row_space
        return self._columns([self.rows.velocity(vector) for vector in vectors], len(self.rows.M))

    @cached_property
    def left_null(self) -> sympy.Matrix:
        """(m, m − r) a basis of N(Jᵀ): the velocities that are lost, and forces without torque. Raises as `null`."""
        vectors = self._columns_of_rows.null
        return self._columns([self.rows.force(vector) for vector in vectors], len(self.rows.M))

    @cached_property
    def _columns_of_rows(self) -> Echelon:
        if not self.rows.leads_back:
            raise FormulaError("the rows of the task are quotients; take the bases in numbers")
        return self._echelon(self.rows.M.T)

    def _echelon(self, M: Matrix) -> Echelon:
        at = self.configurations
        limit = TimeLimit(SECONDS)
        try:
            with limit.kept():
                form = echelon_form(M, at.locus, at.parameters, limit)
        except OutOfTime as error:
            raise FormulaError(f"there is no basis in symbols after {SECONDS:g} s; take the one in numbers") from error
        if len(form.pivots) != self.rank:
            raise FormulaError("the basis in symbols has not the dimension of that in numbers; take the one in numbers")
        return form

    def _columns(self, vectors: Iterable[Iterable[Laurent]], m: int) -> sympy.Matrix:
        """Return vectors as the columns of a matrix, each without common number and with a positive first entry."""
        columns = [_scaled([self._entry(f) for f in without_divisor(self._reduced(vector))]) for vector in vectors]
        return sympy.Matrix(m, len(columns), lambda i, j: columns[j][i])

    def _reduced(self, vector: Iterable[Laurent]) -> list[Laurent]:
        return [self.configurations.locus.reduced(f) for f in vector]

    def _entry(self, f: Laurent) -> sympy.Expr:
        return written_product(factors(f), self.groups) if f else sympy.S.Zero


def _scaled(vector: list[sympy.Expr]) -> list[sympy.Expr]:
    """Return the vector without the number that its entries share."""
    parts = [entry.as_content_primitive() for entry in recognised(vector)]
    common = reduce(sympy.gcd, [number for number, part in parts if part != 0])
    first = next(entry for entry in vector if entry != 0)
    sign = -1 if first.could_extract_minus_sign() else 1
    return [sign * number / common * part for number, part in parts]
