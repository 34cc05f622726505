"""Conditions in the target alone: joints, their sines and cosines by their formulas.

Where a sin q + b cos q = c gave q, w = √(a² + b² − c²) is all that is left of its two solutions:

    cos q = (b c ∓ a w)/(a² + b²),   sin q = (a c ± b w)/(a² + b²),

so that x cos q1 + y sin q1 of an arm with an offset d at its shoulder becomes ±√(x² + y² − d²).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import sympy

LONG = 300  # operations of a sum that is not reduced


@dataclass(frozen=True, eq=False)
class InTheTarget:
    """What joints are by the target.

    Attributes:
        steps: joint → its formula, in the target's symbols and in joints before it.
    """

    steps: Mapping[sympy.Symbol, sympy.Expr]
    _known: dict[Any, Any] = field(default_factory=dict, repr=False)

    def __call__(self, e: Any) -> Any:
        """Return an expression or a condition without joints, its sums of quotients cancelled."""
        if not e.free_symbols & self.steps.keys():
            return e
        if e not in self._known:
            self._known[e] = self._without_joints(e)
        return self._known[e]

    def _without_joints(self, e: Any) -> Any:
        if e in self.steps:
            return self(self.steps[e])
        if isinstance(e, sympy.cos | sympy.sin):
            [angle] = e.args
            if angle in self.steps:
                return _reduced(sympy.expand_trig(e.func(self.steps[angle])), self)
            expanded = sympy.expand_trig(e)
            return _reduced(e, self) if expanded == e else self(expanded)
        return _reduced(e, self)


def _reduced(e: Any, of: InTheTarget) -> Any:
    """Return an expression whose parts are without joints, sums of quotients cancelled and roots of them split."""
    if not e.args:
        return of(e)
    args = [of(arg) if arg.free_symbols & of.steps.keys() else _reduced(arg, of) for arg in e.args]
    if e.is_Pow and e.exp.is_Rational and e.exp.q == 2:
        return _root(args[0]) ** (2 * e.exp)
    e = e.func(*args)
    return sympy.cancel(e) if e.is_Add and _is_quotient(e) and e.count_ops() < LONG else e


def _root(square: sympy.Expr) -> sympy.Expr:
    """Return √square as the quotient of two roots where the denominator cannot be negative."""
    above, below = sympy.fraction(sympy.cancel(sympy.together(square)))
    if not below.is_nonnegative:
        above, below = square, sympy.S.One
    return sympy.sqrt(sympy.factor_terms(above)) / sympy.sqrt(below)


def _is_quotient(e: sympy.Expr) -> bool:
    return any(power.exp.is_negative and power.base.free_symbols for power in e.atoms(sympy.Pow))
