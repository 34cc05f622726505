"""The formulas of a piece of the singular set: its equations, and bases that are valid on all of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import numpy as np
import sympy

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.inputs import Array, one_of
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.mid_chain import MidChainJacobian
from robotics1.symbolic.polynomials.factoring import factors
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial
from robotics1.symbolic.singular_sets.bases import (
    BasisVector,
    SpecialPoints,
    independent_vectors,
    scaled,
    special_points,
    sums_of,
    vanishing_minors,
)
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros
from robotics1.symbolic.singular_sets.conditions import conditions, relations_of_lengths
from robotics1.symbolic.singular_sets.elimination import Echelon, echelon_form, in_whole_angles, primitive_row
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.locus_sampler import LocusSampler
from robotics1.symbolic.singular_sets.pieces import largest_pieces
from robotics1.symbolic.writing.sums_of_angles import Groups, written_product

SECONDS = 20.0  # for one basis
SHORT = 18  # entries of a Jacobian whose bases are short enough to be read
SHORT_NULL = 36  # for the null space, which does not depend on the axes
BASES = ("null", "range", "left_null")


@dataclass(frozen=True, eq=False)
class SymbolicJacobian:
    """The Jacobian of a task in exact form.

    Attributes:
        robot: whose angles are exact.
        rows: J = X M.
        groups: the angles that are added up in writing.
        parameters: the robot's lengths.
        box: of all configurations, also outside the joint limits.
    """

    robot: Robot
    rows: MidChainJacobian
    groups: Groups
    parameters: Mapping[sympy.Symbol, float]
    box: JointBox

    @property
    def everywhere(self) -> Locus:
        """All configurations."""
        return Locus(self.rows.M[0, 0].trig_ring)


@dataclass(frozen=True, eq=False)
class BranchFormulas:
    """A piece of the singular set in q1, q2, ... and the robot's named parameters.

    Attributes:
        jacobian: the task's, in exact form.
        piece: where it holds.
        rank: of J on it, in numbers.
    """

    jacobian: SymbolicJacobian
    piece: Piece
    rank: int

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: not the bases before they are written, which hold polynomials of FLINT."""
        return {name: value for name, value in vars(self).items() if name not in ("_null", "_range", "_left_null")}

    @property
    def q(self) -> tuple[sympy.Symbol, ...]:
        """The symbols of the joints."""
        return self.piece.locus.trig_ring.q

    @cached_property
    def conditions(self) -> tuple[sympy.Eq, ...]:
        """The equations: joints that have a value, then polynomials that vanish."""
        return conditions(self.piece, self.jacobian.groups)

    @property
    def lengths(self) -> tuple[sympy.Eq, ...]:
        """What the branch owes to the robot's lengths, such as a3 = a2; other lengths have other branches."""
        return relations_of_lengths(self.piece.locus, self.jacobian.groups)

    def contains(self, q: Array) -> bool:
        """Return whether q (n,) is on the piece."""
        return self.piece.contains(q)

    def draw(self, box: JointBox, rng: np.random.Generator) -> Array | None:
        """Return a random configuration of the piece inside a box, (n,), or None when there seems to be none."""
        return LocusSampler(self.piece, box).draw(rng)

    def is_short(self, name: str) -> bool:
        """Whether a basis, "null", "range" or "left_null", is found at once and can be read."""
        return bool(self.jacobian.rows.M.size <= (SHORT_NULL if name == "null" else SHORT))

    @cached_property
    def null(self) -> sympy.Matrix:
        """(n, n − r) a basis of N(J): joint velocities that do not move the task. `except_where` gives exceptions.

        Raises:
            FormulaError: there was no time for it.
        """
        return self._written(self._null, self.jacobian.rows.M.shape[1])

    @cached_property
    def range(self) -> sympy.Matrix:
        """(m, r) a basis of R(J): task velocities that can be realised. Raises as `null`."""
        return self._written(self._range, len(self.jacobian.rows.M))

    @cached_property
    def left_null(self) -> sympy.Matrix:
        """(m, m − r) a basis of N(Jᵀ): the velocities that are lost, and forces without torque. Raises as `null`."""
        return self._written(self._left_null, len(self.jacobian.rows.M))

    def except_where(self, name: str) -> tuple[tuple[sympy.Eq, ...], ...]:
        """Return where a basis, "null", "range" or "left_null", loses its rank though J has that of the branch: each
        piece as equations. Without any, the basis holds on all of the branch.

        Raises:
            InputError: there is no such basis.
            FormulaError: there is no such basis in symbols, or no time for the answer.
        """
        vectors: list[BasisVector] = getattr(self, f"_{one_of('name', name, BASES)}")
        if name not in self._exceptions:
            try:
                with TimeLimit(SECONDS).kept():
                    self._exceptions[name] = self._pieces_without_rank(vectors)
            except OutOfTime as error:
                raise FormulaError(f"where the basis holds was not found in {SECONDS:g} s") from error
        return self._exceptions[name]

    @cached_property
    def _exceptions(self) -> dict[str, tuple[tuple[sympy.Eq, ...], ...]]:
        return {}

    def _pieces_without_rank(self, vectors: list[BasisVector]) -> tuple[tuple[sympy.Eq, ...], ...]:
        if not vectors:
            return ()
        at = self.piece
        cases = CommonZeros(at.parameters)
        loci = cases.common_zeros(vanishing_minors(vectors), at.locus)
        pieces, complete = largest_pieces(loci, cases, self.jacobian.box, np.random.default_rng(0))
        if not complete:
            raise OutOfTime
        drawn = [(sampler.piece, sampler.draw(np.random.default_rng(0))) for sampler in pieces]
        within = [piece for piece, q in drawn if q is not None and at.contains(q)]  # equations may allow other values
        kept = [piece for piece in within if len(special_points(self.jacobian.rows.M, piece, self.rank).q)]
        return tuple(replace(self, piece=piece).conditions for piece in kept)

    @cached_property
    def _null(self) -> list[BasisVector]:
        return self._basis(self.jacobian.rows.M, list)

    @cached_property
    def _left_null(self) -> list[BasisVector]:
        self._check_that_rows_lead_back()
        return self._basis(self.jacobian.rows.M.T, self.jacobian.rows.force)

    @cached_property
    def _range(self) -> list[BasisVector]:
        self._check_that_rows_lead_back()
        locus = self.piece.locus

        def found(points: SpecialPoints) -> list[BasisVector]:
            first = self._vectors(self._echelon(self.jacobian.rows.M.T).row_space, self.jacobian.rows.velocity)
            columns = [list(self.jacobian.rows.velocity(column)) for column in self.jacobian.rows.M.T]
            return independent_vectors(first, sums_of(columns, locus), points)

        return self._in_time(found)

    def _basis(self, M: Matrix, lead_back: Callable[[Matrix], Iterable[TrigPolynomial]]) -> list[BasisVector]:
        """Return a basis of N(M), each vector led back to the task's own axes."""

        def found(points: SpecialPoints) -> list[BasisVector]:
            first = self._vectors(self._echelon(M).null, lead_back)
            others = (vector for circuit in self._circuits(M) for vector in self._vectors([circuit], lead_back))
            return independent_vectors(first, others, points) if len(first) > 1 else first

        return self._in_time(found)

    def _circuits(self, M: Matrix) -> Iterator[Matrix]:
        """Yield vectors of N(M) with as many zeros as can be: of r + 1 columns at a time."""
        n = M.shape[1]
        for columns in combinations(range(n), self.rank + 1):
            for vector in self._eliminated(M[:, list(columns)]).null:
                whole = np.array([self.piece.locus.trig_ring.constant(0)] * n, dtype=object)
                whole[list(columns)] = vector
                yield whole

    def _in_time(self, basis: "Callable[[SpecialPoints], list[BasisVector]]") -> list[BasisVector]:
        try:
            with TimeLimit(SECONDS).kept():
                return basis(special_points(self.jacobian.rows.M, self.piece, self.rank))
        except OutOfTime as error:
            raise FormulaError(f"there is no basis in symbols after {SECONDS:g} s; take the one in numbers") from error

    def _check_that_rows_lead_back(self) -> None:
        if not self.jacobian.rows.leads_back:
            raise FormulaError("the rows of the task are quotients; take the bases in numbers")

    def _echelon(self, M: Matrix) -> Echelon:
        form = self._eliminated(M)
        if len(form.pivots) != self.rank:
            raise FormulaError("the basis in symbols has not the dimension of that in numbers; take the one in numbers")
        return form

    def _eliminated(self, M: Matrix) -> Echelon:
        at = self.piece
        return echelon_form(M, at.locus, at.parameters)

    def _vectors(
        self, vectors: Iterable[Matrix], lead_back: Callable[[Matrix], Iterable[TrigPolynomial]]
    ) -> list[BasisVector]:
        """Return vectors in the task's own axes, each without common divisor."""
        at = self.piece.locus
        led = [[at.reduced(f) for f in lead_back(vector)] for vector in vectors]
        return [BasisVector(at.trig_ring, primitive_row(vector, at)) for vector in led]

    def _written(self, vectors: list[BasisVector], m: int) -> sympy.Matrix:
        """Return vectors as the columns of a matrix, each without common number and with a positive first entry."""
        columns = [scaled(self._entries(vector)) for vector in vectors]
        return sympy.Matrix(m, len(columns), lambda i, j: columns[j][i])

    def _entries(self, vector: BasisVector) -> list[sympy.Expr]:
        if vector.has_half_angles:
            return vector.written_in_halves(self.jacobian.groups)
        whole = in_whole_angles(vector.trig_ring, vector.row)
        return [written_product(factors(f), self.jacobian.groups) if f else sympy.S.Zero for f in whole]
