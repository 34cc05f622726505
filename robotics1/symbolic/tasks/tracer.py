"""Entries that a user's own function can be called with, to read it as a formula.

NumPy calls `x.sin()` where it meets an object, and SymPy asks it for `_sympy_`: a function written with arithmetic and
with the functions of either is read as it stands. What needs a number (`math`, `float`) or a truth (`if x > 0`)
cannot be.
"""

import operator
from collections.abc import Callable
from typing import Any

import numpy as np
import sympy

UNREADABLE = "its truth depends on q"


class Tracer:
    """An expression as an entry of a NumPy array."""

    def __init__(self, expression: sympy.Expr) -> None:
        self.expression = expression

    def _sympy_(self) -> sympy.Expr:
        return self.expression

    def __bool__(self) -> bool:
        raise TypeError(UNREADABLE)


def _method(function: Callable[..., sympy.Expr], *, swapped: bool = False) -> Callable[..., Any]:
    """Return the method of an operator or a function of expressions."""

    def method(*entries: Any) -> Any:
        if any(isinstance(entry, np.ndarray) for entry in entries):
            return NotImplemented  # the array goes through its entries itself
        values = [sympy.sympify(entry, strict=True) for entry in (reversed(entries) if swapped else entries)]
        return Tracer(function(*values))

    return method


def _comparison(*entries: Any) -> bool:
    raise TypeError(UNREADABLE)


BINARY = ("add", "sub", "mul", "truediv", "pow")
UNARY = {"__neg__": operator.neg, "__pos__": operator.pos, "__abs__": sympy.Abs, "conjugate": operator.pos}
FUNCTIONS = {name: getattr(sympy, name) for name in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "sqrt")}
FUNCTIONS |= {f"arc{name}": getattr(sympy, f"a{name}") for name in ("sin", "cos", "tan")}
FUNCTIONS |= {"arctan2": sympy.atan2, "hypot": lambda a, b: sympy.sqrt(a**2 + b**2), "sign": sympy.sign}
FUNCTIONS |= dict.fromkeys(("deg2rad", "radians"), lambda a: a * sympy.pi / 180)
FUNCTIONS |= dict.fromkeys(("rad2deg", "degrees"), lambda a: a * 180 / sympy.pi)

for _name in BINARY:
    setattr(Tracer, f"__{_name}__", _method(getattr(operator, _name)))
    setattr(Tracer, f"__r{_name}__", _method(getattr(operator, _name), swapped=True))
for _name, _function in {**UNARY, **FUNCTIONS}.items():
    setattr(Tracer, _name, _method(_function))
for _name in ("eq", "ne", "lt", "le", "gt", "ge"):
    setattr(Tracer, f"__{_name}__", _comparison)
