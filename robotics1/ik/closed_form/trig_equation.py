"""The equation a sin θ + b cos θ = c, from which most joint angles come.

With r = √(a² + b²) it is cos(θ − atan2(a, b)) = c/r, so that

    θ = atan2(a, b) ± acos(c/r),   where c² ≤ a² + b².

The two solutions are one where c² = a² + b². Where a = b = 0 every θ is a solution if c = 0, and none is otherwise.
"""

import math
from dataclasses import dataclass
from typing import Any

import sympy

from robotics1.orientation.expressions import both_angles, expressions, wrapped
from robotics1.results import Frozen

ROUNDING = 1e-12  # of c² beside a² + b², below which a number is at the boundary


@dataclass(frozen=True, eq=False)
class TrigSolutions(Frozen):
    """The solutions of a sin θ + b cos θ = c.

    Attributes:
        coefficients: a, b and c: numbers, or expressions.
        solutions: the angles [rad]: numbers in (−π, π], each once; or expressions, which count modulo 2π.
        exists_if: whether there are solutions, c² ≤ a² + b²: a condition, or true or false of numbers.
        double_if: where the two solutions are one, c² = a² + b² ≠ 0.
        any_angle_if: where every θ is a solution, a = b = c = 0.
    """

    coefficients: tuple[Any, Any, Any]
    solutions: tuple[Any, ...]
    exists_if: Any
    double_if: Any
    any_angle_if: Any

    def __len__(self) -> int:
        return len(self.solutions)

    def explain(self) -> str:
        """Return how many solutions there are, and when, in sentences."""
        if self.any_angle_if == sympy.true:
            return "a = b = c = 0: every angle is a solution"
        if self.exists_if == sympy.false:
            return "there is no solution, for c² > a² + b²"
        shown = ", ".join(str(angle) for angle in self.solutions)
        if self.exists_if == sympy.true and self.double_if in (sympy.true, sympy.false):
            return f"{len(self)} solution{'' if len(self) == 1 else 's'}: θ = {shown}"
        return f"θ = {shown}, which exist where {self.exists_if}; one where {self.double_if}, any θ where a = b = c = 0"


def solve_trig(a: Any, b: Any, c: Any) -> TrigSolutions:
    """Return the solutions of a sin θ + b cos θ = c: θ = atan2(a, b) ± acos(c/√(a² + b²)).

    Args:
        a, b, c: numbers, SymPy expressions, or names such as "l1", which stand for real symbols.

    Raises:
        InputError: one of them is none of these.

    Source: Craig, Introduction to Robotics, 2005, appendix C; Siciliano and others, Robotics, 2009, section 2.12.
    """
    entries = expressions("(a, b, c)", [a, b, c], (3,))
    if entries.dtype != object:
        return _of_numbers(*map(float, entries))
    a, b, c = entries
    square = a**2 + b**2
    return TrigSolutions(
        (a, b, c),
        tuple(both_angles(a, b, c)),
        existence(a, b, c),
        sympy.And(sympy.Eq(c**2, square), sympy.Ne(square, 0)),
        sympy.And(*(sympy.Eq(entry, 0) for entry in (a, b, c))),
    )


def existence(a: sympy.Expr, b: sympy.Expr, c: sympy.Expr) -> Any:
    """Return the condition c² ≤ a² + b², as |c/a| ≤ 1 where b = 0."""
    if c == 0:
        return sympy.true
    for one, other in ((a, b), (b, a)):
        if other == 0 and one != 0:
            return sympy.Le(sympy.Abs(c / one), 1)
    return sympy.Le(c**2, a**2 + b**2)


def _of_numbers(a: float, b: float, c: float) -> TrigSolutions:
    scale = max(abs(a), abs(b), abs(c), 1e-300)
    r, c_part = math.hypot(a / scale, b / scale), c / scale
    if r == 0:
        free = sympy.true if c == 0 else sympy.false
        return TrigSolutions((a, b, c), (), free, sympy.false, free)
    cosine = c_part / r
    double = abs(abs(cosine) - 1) <= ROUNDING
    if abs(cosine) > 1 and not double:
        return TrigSolutions((a, b, c), (), sympy.false, sympy.false, sympy.false)
    middle, turn = math.atan2(a, b), math.acos(max(-1.0, min(1.0, cosine)))
    angles = (
        (wrapped(middle + round(turn / math.pi) * math.pi),)
        if double
        else tuple(wrapped(middle + sign * turn) for sign in (1, -1))
    )
    return TrigSolutions((a, b, c), angles, sympy.true, sympy.true if double else sympy.false, sympy.false)
