"""A task read as formulas: r = g(p, R, q) and ṙ = S V + D q̇, in symbols for the entries of p and R.

S and D depend on p, R and q; V = (v, ω) is the velocity of the frame. The built-in tasks have g and S,
and D = 0. Of a function f of the user's own, with Ṙ = [ω]× R,

    S = [∂f/∂p   Σᵢⱼ ∂f/∂Rᵢⱼ ([e_k]× R)ᵢⱼ],  D = ∂f/∂q.

To read f it is called with tracers. NumPy calls `x.sin()` where it meets an object, and SymPy asks it for `_sympy_`: a
function written with arithmetic and with the functions of either is read as it stands. What needs a number (`math`,
`float`) or a truth (`if x > 0`) cannot be.
"""

import operator
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy
from sympy.core.function import AppliedUndef

from robotics1.errors import FormulaError
from robotics1.orientation.elementary import cross_matrix
from robotics1.symbolic.kinematics.exact import exact_length
from robotics1.tasks.task import FrameMap

Expressions = np.ndarray[Any, Any]  # of sympy.Expr
UNREADABLE = "its truth depends on q"


@dataclass(frozen=True, eq=False)
class TaskMap:
    """A task in symbols.

    Attributes:
        p, R: (3,) and (3, 3) symbols of the frame's position and axes.
        value: r = g(p, R, q), in the task's own shape.
        S: (m, 6).
        D: (m, n).
        wraps: whether an angle of r counts up to whole turns.
    """

    p: Expressions
    R: Expressions
    value: Expressions
    S: Expressions
    D: Expressions
    wraps: bool

    def chosen(self, rows: list[int]) -> "TaskMap":
        """Return the map with some of the rows; a value that is no column is kept whole."""
        value = self.value[rows] if self.value.shape == (len(self.S),) else self.value
        return TaskMap(self.p, self.R, value, self.S[rows], self.D[rows], self.wraps)


def task_map(form: FrameMap, m: int, q: tuple[sympy.Symbol, ...]) -> TaskMap:
    """Return a task of m rows in symbols.

    Raises:
        FormulaError: its function of p, R and q cannot be read.
    """
    p = np.array([sympy.Dummy(f"p{axis}", real=True) for axis in "xyz"])
    R = np.array([[sympy.Dummy(f"R{i}{j}", real=True) for j in (1, 2, 3)] for i in (1, 2, 3)])
    if form.S is None:
        r = _read(form, m, p, R, q)
        return TaskMap(p, R, r, *_derivatives(r, p, R, q), wraps=False)
    S = _exact(form.S(p, R))
    return TaskMap(p, R, _exact(form.g(p, R, np.array(q))), S, np.full((len(S), len(q)), sympy.S.Zero), wraps=True)


def _read(form: FrameMap, m: int, p: Expressions, R: Expressions, q: tuple[sympy.Symbol, ...]) -> Expressions:
    """Return f(p, R, q), (m,)."""
    entries = [each(Tracer, np.array(a, dtype=object)) for a in (p, R, q)]
    named = {name: sympy.Symbol(name, real=True) for name in form.parameters}
    try:
        r = _exact(form.g(*entries, **{name: Tracer(symbol) for name, symbol in named.items()}))
    except Exception as error:
        raise FormulaError(
            f"the task's function cannot be read as a formula: {error!r}; write it with arithmetic and with the "
            f"functions of NumPy or SymPy, such as np.sin, np.arctan2 or np.linalg.norm, without conditions, math.* "
            f"or float()"
        ) from error
    if r.shape != (m,):
        raise FormulaError(f"the task's function must return shape ({m},); it returned shape {r.shape}")
    for entry in r:
        unknown = entry.free_symbols.difference(p, R.flat, q, named.values())
        if unknown or entry.atoms(AppliedUndef) or entry.has(sympy.I, sympy.nan, sympy.zoo, sympy.oo):
            raise FormulaError(f"the task's function must be a real function of p, R and q alone; it returned {entry}")
    return r


def _derivatives(
    r: Expressions, p: Expressions, R: Expressions, q: tuple[sympy.Symbol, ...]
) -> tuple[Expressions, Expressions]:
    """Return S (m, 6) and D (m, n)."""
    moved = [cross_matrix(e) @ R for e in np.eye(3, dtype=int)]  # ∂R along the rotation about each axis
    S = [[*(f.diff(x) for x in p), *(_along(f, R, dR) for dR in moved)] for f in r]
    return np.array(S, dtype=object), np.array([[f.diff(x) for x in q] for f in r], dtype=object)


def _along(f: sympy.Expr, R: Expressions, dR: Expressions) -> sympy.Expr:
    return sympy.Add(*(f.diff(x) * dx for x, dx in zip(R.flat, dR.flat, strict=True)))


def _exact(values: Any) -> Expressions:
    """Return numbers and expressions as expressions with exact numbers."""
    return each(_exact_entry, np.array(values, dtype=object))


def _exact_entry(value: Any) -> sympy.Expr:
    e = sympy.sympify(value, strict=True)  # a text would be run as code
    return e.xreplace({x: sympy.Rational(exact_length(float(x))) for x in e.atoms(sympy.Float)})


def each(function: Callable[[Any], Any], values: Expressions) -> Expressions:
    """Return the function of each entry."""
    return np.asarray(np.frompyfunc(function, 1, 1)(values))


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
