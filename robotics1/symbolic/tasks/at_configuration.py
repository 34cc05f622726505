"""The formulas of a task at one configuration: value, Jacobian, rank, subspaces and pseudoinverse, all exact.

What is not given stays a symbol. Whether an expression is zero is decided at random values of these symbols, with 40
digits; so the rank is that of almost all of their values.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy
from sympy.polys.matrices import DomainMatrix

from robotics1.angles import printed_twelfths_of_pi, twelfths_of_pi, warn_of_degrees
from robotics1.caching import cached_property
from robotics1.errors import FormulaError, InputError, TaskError, UnknownNameError
from robotics1.inputs import real_number
from robotics1.notation import enumeration
from robotics1.results import Frozen
from robotics1.symbolic.kinematics.exact import exact_length

DIGITS = 40  # of the numbers that decide whether an expression is zero
ZERO = sympy.Float("1e-25")  # relative to the largest entry: below, an expression is zero
LARGE, FEW = 3, 4  # the rank above which J⁺ has long entries, and the symbols up to which it has not


@dataclass(frozen=True, eq=False)
class ConfigurationFormulas(Frozen):
    """r and J at one configuration, in SymPy, and what follows from J by exact algebra.

    Attributes:
        row_names: of r.
        given: (symbol, its exact value), of what is given.
        value: the value r: a column; of an orientation (3, 3), of a pose the homogeneous (4, 4).
        jacobian: (m, n) J.
        read: sentences about numbers that are read as the exact ones they round, as 1.5708 as π/2.
    """

    row_names: tuple[str, ...]
    given: tuple[tuple[sympy.Symbol, sympy.Expr], ...]
    value: sympy.Matrix
    jacobian: sympy.Matrix
    read: tuple[str, ...] = field(default=())

    @property
    def rank(self) -> int:
        """The rank r of J, at almost all values of what is left as symbols."""
        return len(self._pivots[0])

    @cached_property
    def range(self) -> sympy.Matrix:
        """(m, r) a basis of R(J), the task velocities that can be realised: columns of J."""
        return self.jacobian[:, list(self._pivots[1])]

    @cached_property
    def row(self) -> sympy.Matrix:
        """(n, r) a basis of R(Jᵀ), the joint velocities without a part in the null space: rows of J."""
        return self.jacobian[list(self._pivots[0]), :].T

    @cached_property
    def null(self) -> sympy.Matrix:
        """(n, n − r) a basis of N(J), the joint velocities that do not move the task."""
        return _null(self.jacobian, self._pivots)

    @cached_property
    def left_null(self) -> sympy.Matrix:
        """(m, m − r) a basis of N(Jᵀ), the forces that need no torque."""
        return _null(self.jacobian.T, self._pivots[::-1])

    @cached_property
    def pseudoinverse(self) -> sympy.Matrix:
        """J⁺ = Gᵀ (Fᵀ J Gᵀ)⁻¹ Fᵀ, (n, m), with r independent columns F and rows G of J; exact at any rank.

        1 rad/s and 1 m/s count alike.

        Raises:
            FormulaError: the entries would be too long, or do not meet the four conditions of Penrose to 20 digits.

        Source: MacDuffee's form, Ben-Israel, Greville, Generalized Inverses, 2003, section 1.6.
        """
        J, (m, n) = self.jacobian, self.jacobian.shape
        if not self.rank:
            return sympy.zeros(n, m)
        F, G = self.range, self.row.T
        if self.rank > LARGE and len(getattr(_polynomial_matrix(J)[0].domain, "symbols", ())) > FEW:
            raise FormulaError(
                f"J has the rank {self.rank} and many symbols, cosines and sines: the entries of J⁺ would be too long; "
                "give more lengths, and angles that are multiples of pi/4"
            )
        found = (G.T * _inverse(F.T * J * G.T) * F.T).applyfunc(_tidy)
        _check_penrose(J, found)
        return found

    @cached_property
    def determinant(self) -> sympy.Expr:
        """Det J; zero where the rank is not full.

        Raises:
            TaskError: J is not square.
        """
        m, n = self.jacobian.shape
        if m != n:
            raise TaskError(f"J is {m} × {n}: it has minors, but no determinant")
        return _tidy(_determinant(self.jacobian)) if self.rank == n else sympy.S.Zero

    @cached_property
    def _pivots(self) -> tuple[tuple[int, ...], tuple[int, ...]]:
        """Independent rows and columns of J."""
        numbers = _at_random(self.jacobian)
        return _pivot_columns(numbers.T), _pivot_columns(numbers)

    def explain(self) -> str:
        """Return where, the rank, and what is read as something else, in sentences."""
        m, n = self.jacobian.shape
        where = enumeration([f"{symbol} = {value}" for symbol, value in self.given]) if self.given else "any q"
        left = sorted(map(str, self.jacobian.free_symbols))
        almost = f" for almost all {', '.join(left)}" if left else ""
        full = "full" if self.rank == min(m, n) else "not full"
        return " ".join([f"At {where}, J has the rank {self.rank} of {min(m, n)}{almost}: it is {full}.", *self.read])


def exact_values(
    names: Mapping[str, bool], q: Sequence[Any] | None, values: Mapping[str, Any], joints: Sequence[str]
) -> tuple[dict[str, sympy.Expr], tuple[str, ...]]:
    """Return name → exact value, and sentences about those that are read as a multiple of π/12.

    Args:
        names: what may be given → whether it is an angle.
        q: (n,) all joints, or None.
        values: by name.
        joints: the names of the joints in formulas, q1, q2, ...

    Raises:
        UnknownNameError: there is no joint or length of a name.
        InputError: a value is no number and no expression, or a joint is given twice.
    """
    given = dict(values)
    if q is not None:
        listed = list(q) if isinstance(q, Sequence | np.ndarray | sympy.MatrixBase) and not isinstance(q, str) else []
        if len(listed) != len(joints):
            raise InputError(f"q must hold one value for each of {len(joints)} joints; it is {q!r}")
        twice = sorted(set(joints) & set(given))
        if twice:
            raise InputError(f"{twice[0]} is given twice: in q and by name")
        given = {**dict(zip(joints, listed, strict=True)), **given}
    found, read = {}, []
    for name, value in given.items():
        if name not in names:
            raise UnknownNameError("joint or length in the formulas named", name, names)
        found[name], sentence = _exact(name, value, angle=names[name])
        read += [sentence] if sentence else []
    return found, tuple(read)


def _exact(name: str, value: Any, *, angle: bool) -> tuple[sympy.Expr, str]:
    """Return a value as an exact expression, and a sentence if it is read as another number."""
    if isinstance(value, sympy.Expr) and not value.is_Float:
        if value.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo) or value.is_extended_real is False:
            raise InputError(f"{name} must be real and finite; it is {value}")
        return value.replace(lambda e: e.is_Float, lambda e: sympy.Rational(exact_length(float(e)))), ""
    number = real_number(name, value)
    if angle:
        warn_of_degrees(name, np.array([number]))
        k = twelfths_of_pi(number, 1e-14 * max(1.0, abs(number)))
        if k is not None:
            return sympy.pi * k / 12, ""
        k = printed_twelfths_of_pi(number)
        if k is not None:
            return sympy.pi * k / 12, f"{name} = {number!r} is read as {sympy.pi * k / 12}, which it rounds."
    return sympy.Rational(exact_length(number)), ""


def at_values(expression: sympy.Matrix, values: Mapping[sympy.Symbol, sympy.Expr], what: str) -> sympy.Matrix:
    """Return a matrix with exact values in the place of symbols.

    Raises:
        TaskError: it has no finite value there.
    """
    found = expression.subs(list(values.items()), simultaneous=True).applyfunc(_tidy)
    if found.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
        raise TaskError(f"{what} has no value there: a denominator of its formula is zero")
    return found


def _at_random(M: sympy.Matrix) -> sympy.Matrix:
    """Return a matrix of numbers of 40 digits, at random values of its symbols."""
    symbols = sorted(M.free_symbols, key=str)
    rng = np.random.default_rng(0)
    values = {s: sympy.Rational(int(rng.integers(2**40, 2**41)), 2**41) for s in symbols}
    return M.applyfunc(lambda entry: entry.xreplace(values).evalf(DIGITS))


def _pivot_columns(numbers: sympy.Matrix) -> tuple[int, ...]:
    """Return the first columns that are independent."""
    size = max((abs(x) for x in numbers), default=0)
    pivots: tuple[int, ...] = numbers.rref(iszerofunc=lambda x: abs(x) <= ZERO * size)[1]
    return pivots


def _null(J: sympy.Matrix, pivots: tuple[tuple[int, ...], tuple[int, ...]]) -> sympy.Matrix:
    """Return a basis of N(J): B x = −c of each column c that is no pivot, with the pivot block B."""
    rows, columns = map(list, pivots)
    free = [j for j in range(J.cols) if j not in columns]
    basis = sympy.zeros(J.cols, len(free))
    if free and rows:
        solved = (-_inverse(J[rows, columns]) * J[rows, free]).applyfunc(_tidy)
        for i, j in enumerate(columns):
            basis[j, :] = solved[i, :]
    for k, j in enumerate(free):
        basis[j, k] = 1
    return basis


def _inverse(B: sympy.Matrix) -> sympy.Matrix:
    """Return B⁻¹ as adj B/det B, without a division by what may be zero."""
    M, meant = _polynomial_matrix(B)
    adjugate, det = M.adj_det()
    det = adjugate.domain.to_sympy(det)
    return adjugate.to_Matrix().applyfunc(lambda entry: (entry / det).xreplace(meant))


def _determinant(B: sympy.Matrix) -> sympy.Expr:
    M, meant = _polynomial_matrix(B)
    return (M.domain.to_sympy(M.charpoly()[-1]) * (-1) ** B.rows).xreplace(meant)


def _polynomial_matrix(M: sympy.Matrix) -> tuple[Any, dict[sympy.Expr, sympy.Expr]]:
    """Return a matrix over a ring of polynomials, and what its symbols stand for: cosines, sines, roots, ..."""
    atoms = M.atoms(sympy.Function, sympy.NumberSymbol)
    atoms |= {power for power in M.atoms(sympy.Pow) if not power.exp.is_integer}
    outermost = {a for a in atoms if not any(a != b and b.has(a) for b in atoms)}
    symbols = {atom: sympy.Dummy() for atom in outermost}
    return DomainMatrix.from_Matrix(M.xreplace(symbols)), {symbol: atom for atom, symbol in symbols.items()}


def _tidy(entry: sympy.Expr) -> sympy.Expr:
    """Return an entry reduced: without common factors, with roots above, and cos² + sin² as 1."""
    if entry.is_number:
        return entry if entry.has(sympy.Function) else sympy.radsimp(sympy.simplify(entry))
    reduced = sympy.cancel(entry)
    if reduced.has(sympy.sin, sympy.cos):
        reduced = sympy.trigsimp(reduced)
    return sympy.factor_terms(reduced)


def _check_penrose(J: sympy.Matrix, P: sympy.Matrix) -> None:
    """Compare J⁺ with the conditions of Penrose, at random values of the symbols."""
    together = _at_random(J.row_join(P.T))
    A, B = together[:, : J.cols], together[:, J.cols :].T
    gaps = [A * B * A - A, B * A * B - B, (A * B).T - A * B, (B * A).T - B * A]
    size = max([1, *map(abs, A), *map(abs, B)]) ** 3
    if any(abs(x) > 1e-20 * size for gap in gaps for x in gap):
        raise FormulaError("the pseudoinverse that was found does not meet the conditions of Penrose")
