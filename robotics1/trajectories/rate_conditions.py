"""The extremes of a polynomial's rate in symbols, and the conditions under which a bound holds."""

from dataclasses import dataclass
from typing import Any

from robotics1.errors import FormulaError, InputError
from robotics1.inputs import counting_number
from robotics1.orientation.expressions import expression
from robotics1.trajectories.symbolic_polynomial import MOST, PolynomialFormula


@dataclass(frozen=True)
class RateExtreme:
    """Where a derivative of q(τ) may be largest in magnitude, in SymPy.

    Attributes:
        tau: τ = t/T: 0, 1, or where the next derivative vanishes.
        value: the derivative there [per s, per s², ...].
        exists_if: the condition that τ is real and between 0 and 1; true at the ends.
    """

    tau: Any
    value: Any
    exists_if: Any

    def explain(self) -> str:
        """Return the extreme in a sentence."""
        when = "" if self.exists_if == True else f", if {self.exists_if}"  # noqa: E712 (a SymPy expression)
        return f"{self.value} at τ = {self.tau}{when}"


def rate_extremes(formula: PolynomialFormula, order: int = 1) -> tuple[RateExtreme, ...]:
    """Return where |q⁽ʳ⁾(t)| may be largest: at the ends, and where q⁽ʳ⁺¹⁾ = 0, each with its condition.

    Of the cubic from (q0, v0) to (q1, v1), the velocity is largest at an end or at τ = −c₂/(3c₃).

    Args:
        formula: of `polynomial_formula`.
        order: r: 1 of the velocity, 2 of the acceleration, 3 of the jerk.

    Raises:
        InputError: the formula is none, or the order is 0.
        FormulaError: q⁽ʳ⁺¹⁾ has a factor of a degree above two in τ.
    """
    import sympy

    if not isinstance(formula, PolynomialFormula):
        raise InputError(f"formula must be one of polynomial_formula(...); it is {formula!r}")
    rate = formula
    for _ in range(counting_number("order", order, least=1, most=MOST)):
        rate = rate.rate
    tau = sympy.Symbol("tau", real=True)
    ends = [RateExtreme(x, sympy.factor(rate.formula.subs(tau, x)), sympy.true) for x in (sympy.S.Zero, sympy.S.One)]
    slope = sympy.expand(rate.formula.diff(tau))
    if slope == 0:
        return (ends[0],)
    found = []
    for factor, _ in sympy.factor_list(slope, tau)[1]:
        polynomial = sympy.Poly(factor, tau)
        if polynomial.degree() > 2:
            raise FormulaError(
                f"the derivative of order {order + 1} is of degree {polynomial.degree()} in τ: its zeros have no short "
                "formula; give numbers, and ask minimum_duration or a motion's extremes"
            )
        for root in _roots(polynomial):
            value = sympy.simplify(rate.formula.subs(tau, root))
            found.append(RateExtreme(root, value, _inside(root, polynomial)))
    return (*ends, *(extreme for extreme in found if extreme.exists_if != sympy.false))


def bounded_if(formula: PolynomialFormula, bound: Any, order: int = 1) -> Any:
    """Return the condition on the data under which |q⁽ʳ⁾(t)| ≤ bound all along, as a SymPy expression.

    Args:
        formula: of `polynomial_formula`.
        bound: V, A or J: an expression, a name or a number.
        order: r: 1 of the velocity, 2 of the acceleration, 3 of the jerk.

    Raises:
        InputError, FormulaError: as `rate_extremes`.
    """
    import sympy

    if isinstance(bound, str) and not bound.isidentifier():
        raise InputError(f"bound must be a name such as 'V', an expression or a number; it is {bound!r}")
    limit = sympy.Symbol(bound, positive=True) if isinstance(bound, str) else expression("bound", bound)
    return sympy.And(
        *(
            sympy.Or(sympy.Not(extreme.exists_if), sympy.Abs(extreme.value) <= limit)
            for extreme in rate_extremes(formula, order)
        )
    )


def _roots(polynomial: Any) -> list[Any]:
    """Return the zeros of a polynomial of degree one or two in τ."""
    import sympy

    if polynomial.degree() == 1:
        a, b = polynomial.all_coeffs()
        return [sympy.factor(-b / a)]
    a, b, c = polynomial.all_coeffs()
    root = sympy.sqrt(sympy.factor(b**2 - 4 * a * c))
    return [sympy.simplify((-b + sign * root) / (2 * a)) for sign in (1, -1)]


def _inside(root: Any, polynomial: Any) -> Any:
    """Return the condition that a zero is real and between 0 and 1."""
    import sympy

    conditions = [sympy.Gt(root, 0), sympy.Lt(root, 1)]
    if polynomial.degree() == 2:
        a, b, c = polynomial.all_coeffs()
        conditions.insert(0, sympy.Ge(sympy.factor(b**2 - 4 * a * c), 0))
    if not polynomial.LC().is_number:
        conditions.insert(0, sympy.Ne(polynomial.LC(), 0))
    return sympy.And(*conditions)
