"""Numbers and formulas through the same code: floats stay floats, SymPy's expressions stay expressions."""

import math
import sys
from typing import Any

import numpy as np

from robotics1.angles import warn_of_degrees
from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.names import refuse_no_number

Matrix = Any  # a float array, or a sympy.Matrix
ROUNDING = 1e-12  # a coefficient below this is the difference of two that should cancel


def expressions(name: str, values: Any, shape: tuple[int, ...], meaning: str = "") -> Array:
    """Return `values` as floats; if one of them is a SymPy expression or a name, all as expressions (dtype object).

    A name stands for a real symbol.

    Raises:
        InputError: the shape is wrong, or an entry is neither a finite real number, an expression, nor a name.
    """
    try:
        raw = np.array(values, dtype=object)
    except ValueError:
        return real_array(name, values, shape, meaning)
    if len(shape) == 1 and raw.shape == (*shape, 1) and hasattr(values, "free_symbols"):
        raw = raw[:, 0]  # a sympy.Matrix that is a column
    if raw.shape != shape or not any(_is_formula(entry) for entry in raw.flat):
        return real_array(name, values, shape, meaning)
    return np.array([expression(name, entry) for entry in raw.flat], dtype=object).reshape(shape)


def angles_in_radians(name: str, values: Any, shape: tuple[int, ...]) -> Array:
    """Return angles [rad] as `expressions` does; of numbers that look like degrees there is a warning."""
    angles = expressions(name, values, shape, "[rad]")
    if angles.dtype != object:
        warn_of_degrees("the rotation", angles)
    return angles


def expression(name: str, entry: Any) -> Any:
    """Return an entry as a SymPy expression: of a name a real symbol, of a whole number an integer.

    Raises:
        InputError: it is neither a finite real number, an expression, nor a name.
    """
    import sympy

    if isinstance(entry, str):
        if not entry.isidentifier():
            raise InputError(f"a name in {name} must be a word such as 'alpha'; it is {entry!r}")
        refuse_no_number(name, entry)
        return sympy.pi if entry == "pi" else sympy.Symbol(entry, real=True)
    if not isinstance(entry, sympy.Expr):
        number = float(real_array(f"an entry of {name}", entry, ()))
        return sympy.Integer(int(number)) if number.is_integer() else sympy.Float(number)
    if entry is sympy.nan or entry.is_finite is False or entry.is_real is False:
        raise InputError(f"{name} must be real and finite; it has the entry {entry}")
    return entry


def as_matrix(array: Array) -> Matrix:
    """Return a float array as it is, and an array of expressions as a `sympy.Matrix`."""
    if array.dtype != object:
        return array
    import sympy

    return sympy.Matrix(array)


def simplified(formula: Any) -> Any:
    """Return an expression simplified, without coefficients that are only rounding: numbers below 1e-12."""
    import sympy

    return _without_rounding(sympy.simplify(formula))


def vanishes(formula: Any) -> bool:
    """Whether an expression is zero for all values of its symbols; trigonometric ones are seen in exponentials."""
    import sympy

    in_exponentials = sympy.expand(formula.rewrite(sympy.exp))
    return bool(_without_rounding(in_exponentials) == 0 or simplified(formula) == 0)


def cosine_and_sine(angle: Any) -> tuple[Any, Any]:
    """Return cos φ and sin φ: numbers of a number, formulas of a formula."""
    if isinstance(angle, float):
        return math.cos(angle), math.sin(angle)
    import sympy

    return sympy.cos(angle), sympy.sin(angle)


def root(square: Any) -> Any:
    """Return √x: a number of a number, a formula of a formula."""
    if isinstance(square, float):
        return math.sqrt(square)
    import sympy

    return sympy.sqrt(square)


def complement(cosine: Any) -> Any:
    """Return 1 − cos²: sin² x of the formula cos x, and the other way round."""
    import sympy

    if getattr(cosine, "func", None) in (sympy.cos, sympy.sin):
        return (sympy.sin if cosine.func is sympy.cos else sympy.cos)(*cosine.args) ** 2
    return 1 - cosine**2


def angle_of(sine: Any, cosine: Any) -> Any:
    """Return the angle of a sine and a cosine, in (−π, π]: a number of numbers, a formula of formulas.

    Of half a turn, but for rounding, it is π from both sides.
    """
    if isinstance(sine, float):
        angle = math.atan2(sine, cosine)
        return math.pi if angle == -math.pi else angle
    import sympy

    theta = cosine.args[0] if getattr(cosine, "func", None) is sympy.cos else None
    signs = {sympy.sin(theta): theta, -sympy.sin(theta): -theta} if theta is not None else {}
    return signs.get(sine, sympy.atan2(sine, cosine))


def both_angles(a: Any, b: Any, c: Any) -> list[Any]:
    """Return the two solutions of a sin θ + b cos θ = c, formulas of formulas, in the form that a person writes."""
    import sympy

    if c == 0:
        if b == 0:
            return [sympy.S.Zero, sympy.pi]
        return sorted((sympy.atan2(-b, a), sympy.atan2(b, -a)), key=lambda angle: str(angle).count("-"))
    if a == 0:
        return [sympy.acos(c / b), -sympy.acos(c / b)]
    if b == 0:
        return [sympy.asin(c / a), sympy.pi - sympy.asin(c / a)]
    turn = sympy.acos(c / sympy.sqrt(a**2 + b**2))
    return [sympy.atan2(a, b) + turn, sympy.atan2(a, b) - turn]


def wrapped(angle: float) -> float:
    """Return the angle in (−π, π]."""
    return float(np.pi - (np.pi - angle) % (2 * np.pi))


def _without_rounding(formula: Any) -> Any:
    import sympy

    return formula.xreplace({number: 0 for number in formula.atoms(sympy.Float) if abs(number) < ROUNDING})


def _is_formula(entry: Any) -> bool:
    sympy = sys.modules.get("sympy")
    return isinstance(entry, str) or (sympy is not None and isinstance(entry, sympy.Basic))
