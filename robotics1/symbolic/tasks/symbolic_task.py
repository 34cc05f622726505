"""A task of a robot, read as formulas that have not yet been compared with anything."""

from dataclasses import dataclass, replace
from functools import reduce

import sympy

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.orientation.expressions import angle_of
from robotics1.symbolic.kinematics.chain import Chain
from robotics1.symbolic.kinematics.mid_chain import (
    WHOLE,
    FrameMotion,
    Joints,
    MidChainJacobian,
    frame_motion,
    mid_chain_jacobian,
)
from robotics1.symbolic.polynomials.determinants import minors
from robotics1.symbolic.polynomials.factoring import factors
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial
from robotics1.symbolic.tasks.normal_form import NormalForm
from robotics1.symbolic.tasks.task_map import TaskMap, each
from robotics1.symbolic.tasks.task_rows import TaskRows, fractions, task_rows
from robotics1.symbolic.writing.sums_of_angles import without_long_fractions, written_product
from robotics1.symbolic.writing.term_budget import TermBudget

MOST_PRODUCTS = 20_000  # of terms, for an entry of the rows from which minors are made
PATIENCE = 60.0  # for the minors [s]

Minor = tuple[tuple[sympy.Expr, tuple[TrigPolynomial, ...]], ...]  # Σ l f₁ f₂ ..., l of the quotients of the task


@dataclass(frozen=True, eq=False)
class SymbolicTask:
    """The formulas of a task.

    Attributes:
        chain: the joints to the frame.
        reference: the joints to the link whose axes are meant; none for the world's.
        task: g, S and D in symbols.
    """

    chain: Chain
    reference: Joints
    task: TaskMap

    @cached_property
    def budget(self) -> TermBudget:
        """How entries are added and multiplied."""
        return TermBudget(self.chain.trig_ring, self.chain.groups)

    @cached_property
    def motion(self) -> FrameMotion:
        """The frame, with entries that are expressions where polynomials would be long."""
        return frame_motion(self.chain, self.reference, self.budget)

    @cached_property
    def value(self) -> sympy.Matrix:
        """The value r = g(p, R, q)."""
        return sympy.Matrix(each(self._normal.written, self.task.value)).applyfunc(without_long_fractions)

    @cached_property
    def jacobian(self) -> sympy.Matrix:
        """J = diag(1/d) (N_S J_frame + N_D), (m, n)."""
        N, d = fractions(self.task)
        J = _weighted(each(self._normal.entry, N), self.motion.J, self.budget)
        rows = [[self._normal.times(f, _parts(1 / x)) for f in row] for row, x in zip(J, d, strict=True)]
        return sympy.Matrix(rows).applyfunc(without_long_fractions)

    @cached_property
    def factored(self) -> TaskRows:
        """J as L · M.

        Raises:
            FormulaError: the task is no quotient of polynomials in p, R and q, or they are too long.
        """
        found = task_rows(self.task, self._normal) or task_rows(self.task, self._expanded_normal)
        if found is None:
            raise FormulaError(
                "the rows of the task are no quotients of short polynomials in p, R and q, so that its minors cannot "
                "be reduced; its value and its Jacobian can be had"
            )
        return found

    @cached_property
    def rows(self) -> Matrix:
        """M, (m, n).

        Raises:
            FormulaError: an entry is too long.
        """
        M = _weighted(self.factored.weights, self._expanded.J, self._long)
        if not all(isinstance(entry, TrigPolynomial) for entry in M.flat):
            raise FormulaError(f"an entry of the task's rows needs more than {MOST_PRODUCTS} products of terms")
        return M

    @cached_property
    def mid_chain(self) -> MidChainJacobian:
        """M in the axes and at the point in which it is shortest. Raises as `rows`."""
        names = self.factored.names
        if names in WHOLE:
            return mid_chain_jacobian(self.chain, names, self.motion.J, self.budget)
        return MidChainJacobian(self.rows)

    @cached_property
    def minors(self) -> dict[tuple[int, ...], Minor]:
        """The largest minors of J: the columns (or, of a tall J, rows) that are left out → Σ l f₁ f₂ ...

        Without columns there is one, that of no rows and no columns, which is 1.
        """
        L = self.factored
        m, n = len(L.weights), len(self.chain.q)
        every = tuple(range(m))
        if n == 0:
            return {every: ((sympy.S.One, ()),)}
        try:
            with TimeLimit(PATIENCE).kept():
                if m > n:
                    return self._tall_minors({out: factors(f) for out, f in minors(self.rows).items()})
                left = self._normal.written(L.left_minor(every, every))
                return {out: ((left, factors(f)),) for out, f in minors(self.mid_chain.M).items()}
        except OutOfTime as error:
            raise FormulaError(f"the minors of J were not found within {PATIENCE:g} s") from error

    def _tall_minors(self, found: dict[tuple[int, ...], tuple[TrigPolynomial, ...]]) -> dict[tuple[int, ...], Minor]:
        """Return the minors of L M, by Cauchy and Binet."""
        every = range(len(self.factored.weights))
        kept = {out: tuple(i for i in every if i not in out) for out in found}
        left = {
            (out, other): self._normal.written(self.factored.left_minor(kept[out], kept[other]))
            for out in found
            for other in found
        }
        return {
            out: tuple((left[out, other], f) for other, f in found.items() if left[out, other] != 0) for out in found
        }

    @cached_property
    def gram_determinant(self) -> sympy.Expr:
        """Det(J Jᵀ), or det(Jᵀ J) of a tall J: the sum of the squares of the minors (Cauchy and Binet).

        Raises:
            FormulaError: the rows of a tall J are quotients, or the minors cannot be had.
        """
        zero = self.chain.trig_ring.constant(0)
        if not self.chain.q:
            return sympy.S.One
        if not self.factored.is_plain and len(self.factored.weights) > len(self.chain.q):
            raise FormulaError("the rows of a tall J are quotients, so that det(JᵀJ) cannot be reduced")
        products = [(left, reduce(lambda a, b: a * b, found)) for ((left, found),) in self.minors.values()]
        total = sum((minor * minor for _, minor in products), start=zero)
        left = products[0][0]  # det L, of all of them
        return left**2 * written_product(factors(total), self.chain.groups) if total else sympy.S.Zero

    def written_minor(self, minor: Minor) -> sympy.Expr:
        """Return Σ l f₁ f₂ ... in SymPy."""
        return without_long_fractions(sympy.Add(*(left * written_product(f, self.chain.groups) for left, f in minor)))

    @cached_property
    def _normal(self) -> NormalForm:
        """How expressions in p, R and q are read."""
        return self._normal_form(self.motion, self.budget)

    @cached_property
    def _long(self) -> TermBudget:
        return replace(self.budget, most_products=MOST_PRODUCTS, most_terms=MOST_PRODUCTS)

    @cached_property
    def _expanded(self) -> FrameMotion:
        """The frame, with polynomials wherever they can be had."""
        return self.motion if self.motion.is_polynomial else frame_motion(self.chain, self.reference, self._long)

    @cached_property
    def _expanded_normal(self) -> NormalForm:
        return self._normal_form(self._expanded, self._long)

    def _normal_form(self, motion: FrameMotion, budget: TermBudget) -> NormalForm:
        known = dict(zip([*self.task.p, *self.task.R.flat], [*motion.p, *motion.R.flat], strict=True))
        return NormalForm(budget, known, angle_of if self.task.wraps else sympy.atan2)


def _weighted(weights: Matrix, J: Matrix, budget: TermBudget) -> Matrix:
    """Return W_S J + W_D."""
    return budget.sum(budget.product(weights[:, :6], J), weights[:, 6:])


def _parts(e: sympy.Expr) -> tuple[sympy.Expr, ...]:
    """Return the factors of a product; none of 1."""
    return tuple(part for part in sympy.Mul.make_args(e) if part != 1)
