"""The Jacobian of a task as L · M: M of trigonometric polynomials, L small, so that minors come from M.

The rows of [S D] are brought over a common denominator, [S D] = diag(1/d) N. Then

- polynomial rows, d = 1:      L = 1,          M = N_S J + N_D;
- a square S of k columns:     L = those of S, M = the same k rows of J, as with Euler angles, S = T⁻¹;
- any other quotient:          L = diag(1/d),  M = N_S J + N_D,

and a minor of L M is Σ det(L of some columns) det(M of the same rows): the formula of Cauchy and Binet.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import sympy

from robotics1.symbolic.kinematics.mid_chain import TWIST
from robotics1.symbolic.polynomials.trig_polynomial import Matrix
from robotics1.symbolic.tasks.normal_form import NormalForm
from robotics1.symbolic.tasks.task_map import Expressions, TaskMap

SINGULAR = 1e-9


@dataclass(frozen=True, eq=False)
class TaskRows:
    """J = L · M, with M = W [J_frame; 1] and L = diag(1/d) N.

    Attributes:
        weights: W (m, 6 + n) of polynomials.
        numerators: N (m, m) in the symbols of the task map; None for the unit matrix.
        denominators: d (m,) in the same symbols.
        R: (3, 3) those of the frame's axes.
    """

    weights: Matrix
    numerators: Expressions | None
    denominators: Expressions
    R: Expressions

    @property
    def is_plain(self) -> bool:
        """Whether L is the unit matrix."""
        return self.numerators is None and all(x == 1 for x in self.denominators)

    @property
    def names(self) -> tuple[str, ...] | None:
        """The rows of the frame's velocity that are the rows of M, if M has no others."""
        one = self.weights[0, 0].trig_ring.constant(1)
        places = [[j for j, weight in enumerate(row) if weight] for row in self.weights]
        if any(len(js) != 1 or js[0] >= len(TWIST) for js in places):
            return None
        (columns,) = zip(*places, strict=True)
        if any(row[j] - one for j, row in zip(columns, self.weights, strict=True)):
            return None
        return tuple(TWIST[j] for j in columns)

    def left_minor(self, rows: tuple[int, ...], columns: tuple[int, ...]) -> sympy.Expr:
        """Return the minor of L of these rows and columns, in the symbols of the task map."""
        d = sympy.Mul(*self.denominators[list(rows)])
        if self.numerators is None:
            return sympy.Integer(rows == columns) / d
        return _quotient(sympy.Matrix(self.numerators[np.ix_(rows, columns)]).det(method="berkowitz"), d, self.R)


def task_rows(task: TaskMap, normal: NormalForm) -> TaskRows | None:
    """Return J = L · M, or None when no such form is found."""
    N, d = fractions(task)
    weights = np.array([[normal.polynomial(entry) for entry in row] for row in N], dtype=object)
    readable = all(weight is not None for weight in weights.flat)
    if readable and all(x == 1 for x in d):
        return TaskRows(weights, None, d, task.R)
    columns = [k for k in range(N.shape[1]) if any(N[:, k])]
    if len(columns) == len(N) and max(columns) < len(TWIST) and _invertible(task, columns):
        F = normal.budget.trig_ring
        selected = [[F.constant(int(j == k)) for j in range(N.shape[1])] for k in columns]
        return TaskRows(np.array(selected, dtype=object), N[:, columns], d, task.R)
    return TaskRows(weights, None, d, task.R) if readable else None


def _invertible(task: TaskMap, columns: list[int]) -> bool:
    """Whether these columns of S are, at random p, R and q."""
    rng = np.random.default_rng(0)
    Q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    at = dict(zip([*task.p, *task.R.flat], [*rng.normal(size=3), *(Q * np.linalg.det(Q)).flat], strict=True))
    S = sympy.Matrix(task.S[:, columns]).xreplace(at)
    at = {symbol: rng.uniform(0, 1) for symbol in S.free_symbols}
    return bool(abs(np.linalg.det(np.array(S.xreplace(at).evalf(), dtype=float))) > SINGULAR)


def _quotient(numerator: sympy.Expr, denominator: sympy.Expr, R: Expressions) -> sympy.Expr:
    """Return a quotient of polynomials with what they share cancelled; the columns of R are unit vectors."""
    powers = denominator.as_powers_dict()
    symbols = sorted(numerator.free_symbols.union(denominator.free_symbols, R.flat), key=str)
    if numerator == 0 or not all(e.is_polynomial(*symbols) for e in (numerator, *powers)):
        return numerator / denominator
    units = [sum(column**2) - 1 for column in R.T]
    candidates = []
    for first in R:  # the entries that the unit columns eliminate
        order = [*first, *(x for x in symbols if x not in first)]
        _, left = sympy.reduced(numerator, units, *order)
        shared = sympy.S.One
        for base in powers:
            quotient, rest = sympy.div(left, base, *order)
            while rest == 0 and not base.is_number:
                left, shared = quotient, shared * base
                quotient, rest = sympy.div(left, base, *order)
        candidates.append(sympy.factor(left) * shared / denominator)
    return min(candidates, key=sympy.count_ops)


def fractions(task: TaskMap) -> tuple[Expressions, Expressions]:
    """Return N (m, 6 + n) and d (m,) with [S D] = diag(1/d) N."""
    rows = [[_terms(entry) for entry in row] for row in np.hstack([task.S, task.D])]
    d = [_common_denominator(term for terms in row for term in terms) for row in rows]
    N = [[sympy.Add(*(term * x for term in terms)) for terms in row] for row, x in zip(rows, d, strict=True)]
    return np.array(N, dtype=object), np.array(d, dtype=object)


def _terms(e: sympy.Expr) -> list[sympy.Expr]:
    """Return the terms of a sum, with the sums that are among their factors multiplied out."""
    return [term for part in sympy.Add.make_args(e) for term in sympy.Add.make_args(sympy.expand_mul(part, deep=False))]


def _common_denominator(terms: Iterable[sympy.Expr]) -> sympy.Expr:
    powers: dict[sympy.Expr, sympy.Expr] = {}
    for term in terms:
        for factor in sympy.Mul.make_args(term):
            base, exponent = factor.as_base_exp()
            if not base.is_number and exponent.is_number and exponent < 0:
                powers[base] = max(powers.get(base, 0), -exponent)
    return sympy.Mul(*(base**exponent for base, exponent in powers.items()))
