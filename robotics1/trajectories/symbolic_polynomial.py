"""The polynomial between two states as a formula, coefficient by coefficient."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import factorial, perm
from typing import Any

from robotics1.caching import cached_property
from robotics1.errors import InputError, shown

TIMES = ("tau", "t")  # the variables of the formulas
MOST = 12  # conditions at one end


@dataclass(frozen=True)
class PolynomialFormula:
    """q(τ) = Σₖ cₖ τᵏ with τ = t/T ∈ [0, 1], in symbols.

    Attributes:
        coefficients: the SymPy expressions cₖ, ascending.
        duration: T.
    """

    coefficients: tuple[Any, ...]
    duration: Any

    @property
    def formula(self) -> Any:
        """Σₖ cₖ τᵏ, with τ the real symbol `tau`."""
        return _sum(self.coefficients, "tau")

    @property
    def formula_t(self) -> Any:
        """Σₖ cₖ/Tᵏ tᵏ, with t the real symbol `t`."""
        return _sum(self.coefficients_t, "t")

    @property
    def coefficients_t(self) -> tuple[Any, ...]:
        """The coefficients cₖ / Tᵏ of powers of t instead of τ."""
        return tuple(c / self.duration**k for k, c in enumerate(self.coefficients))

    @cached_property
    def rate(self) -> "PolynomialFormula":
        """dq/dt as a polynomial of τ: its coefficients are (k + 1) cₖ₊₁ / T."""
        rates = tuple(k * (c / self.duration) for k, c in enumerate(self.coefficients))
        return PolynomialFormula(rates[1:] or rates, self.duration)


def polynomial_formula(start: Sequence[Any], end: Sequence[Any], duration: Any) -> PolynomialFormula:
    """Return the polynomial of lowest degree with given values and derivatives at both ends, as a formula.

    The start gives the first coefficients, cₖ = q⁽ᵏ⁾(0) Tᵏ/k!; the others solve Σₖ k!/(k − r)! cₖ = q⁽ʳ⁾(T) Tʳ for
    each r of the end. From rest at 0 to (q1, v1): q(τ) = (3 q1 − T v1) τ² + (−2 q1 + T v1) τ³.

    Args:
        start: (q0, v0, a0, ...) at t = 0, as many as are given: SymPy expressions, numbers, or names of real symbols,
            such as "v0" [rad or m, ...].
        end: (q1, v1, a1, ...) at t = T.
        duration: T, an expression, a positive number, or the name of a positive symbol [s].

    Raises:
        InputError: an end has no value, something is no real expression or number, or contains τ or t, or a duration
            is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.1.
    """
    import sympy

    T = _expression("duration", duration, positive=True)
    if T.is_extended_positive is False:
        raise InputError(f"duration must be positive; it is {duration}")
    first, last = _state("start", start), _state("end", end)
    known = [value * T**k / factorial(k) for k, value in enumerate(first)]
    orders, powers = range(len(last)), range(len(first), len(first) + len(last))
    A = sympy.Matrix([[perm(k, r) for k in powers] for r in orders])
    b = sympy.Matrix([last[r] * T**r - sum(perm(k, r) * c for k, c in enumerate(known)) for r in orders])
    coefficients = [sympy.expand_mul(c) for c in (*known, *A.LUsolve(b))]
    while len(coefficients) > 1 and coefficients[-1] == 0:
        coefficients.pop()
    return PolynomialFormula(tuple(coefficients), T)


def _sum(coefficients: Sequence[Any], variable: str) -> Any:
    import sympy

    x = sympy.Symbol(variable, real=True)
    return sympy.Add(*(c * x**k for k, c in enumerate(coefficients)))


def _state(name: str, values: Sequence[Any]) -> list[Any]:
    """Return the values and derivatives at an end as expressions."""
    if isinstance(values, str) or not isinstance(values, Sequence) or not 1 <= len(values) <= MOST:
        raise InputError(f"{name} must be a value and derivatives such as (q0, v0), at most {MOST}; it is {values!r}")
    return [_expression(f"{name}[{i}]", value) for i, value in enumerate(values)]


def _expression(name: str, value: Any, *, positive: bool = False) -> Any:
    """Return a SymPy expression, a number or a name as a real expression without τ and t."""
    import sympy

    try:
        is_name = isinstance(value, str) and value.isidentifier()
        found = (
            sympy.Symbol(value, real=True, positive=positive or None) if is_name else sympy.sympify(value, strict=True)
        )
    except sympy.SympifyError:
        found = None
    if not isinstance(found, sympy.Expr) or not found.is_commutative:
        raise InputError(f"{name} must be a SymPy expression, a number or a name, not {shown(value)}")
    if found.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo, sympy.I) or found.is_extended_real is False:
        raise InputError(f"{name} must be real and finite; it is {value}")
    taken = sorted({symbol.name for symbol in found.free_symbols} & set(TIMES))
    if taken:
        raise InputError(f"{name} must not depend on {taken[0]}, the time of the polynomial; it is {value}")
    return found
