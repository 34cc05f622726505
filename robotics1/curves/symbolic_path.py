"""A path given by formulas of its parameter."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve
from robotics1.curves.formula_text import expression_of
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, by_name, positive_number, real_array, real_number, text


@dataclass(frozen=True, eq=False)
class FormulaPath(Curve):
    """p(s), 0 ≤ s ≤ end, as SymPy expressions; its derivatives are exact, of any order.

    Attributes:
        formula: `sympy.Matrix` (n, 1), p(s).
        parameter: the symbol s.
        end: the last s.
        values: of the other symbols.
    """

    formula: Any
    parameter: Any
    end: float = 1.0
    values: Mapping[Any, float] | None = None

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: not the functions that were made of the formula."""
        return {name: value for name, value in vars(self).items() if name != "_functions"}

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,)."""
        return (int(self.formula.rows),)

    def derivative_formula(self, order: int = 1) -> Any:
        """Return the derivative of an order as a `sympy.Matrix` (n, 1)."""
        return self.formula.diff(self.parameter, order) if order else self.formula

    @cached_property
    def _functions(self) -> dict[int, list[Callable[[Array], Any]]]:
        return {}

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        from robotics1.symbolic.writing.printing import numpy_function

        try:
            if order not in self._functions:
                numbers = self.derivative_formula(order).subs(self.values or {})
                self._functions[order] = [numpy_function([self.parameter], entry) for entry in numbers]
            with np.errstate(all="ignore"):
                columns = [np.broadcast_to(np.asarray(f(t)), t.shape) for f in self._functions[order]]
        except (KeyError, NameError, TypeError, AttributeError) as error:
            raise InputError(f"the formula {self.formula} has no numbers: {error!r}") from error
        values = np.column_stack(columns)
        if np.iscomplexobj(values) or not np.isfinite(values).all():
            bad = t[~np.isfinite(values).all(axis=1) | (np.imag(values) != 0).any(axis=1)]
            where = f" at s = {bad[0]:.6g}" if bad.size else ""
            raise InputError(f"the formula, or its derivative of order {order}, is no finite real number{where}")
        return np.asarray(values, dtype=float)


def formula_path(
    formulas: Sequence[Any], parameter: Any, end: float, *, values: Mapping[str, float] | None = None
) -> FormulaPath:
    """Return the path p(s), 0 ≤ s ≤ end, of formulas of s.

    Args:
        formulas: (n,) the coordinates: SymPy expressions, texts such as "R*cos(s)", or numbers.
        parameter: the symbol s, or its name.
        end: the last s, positive.
        values: of the other symbols, by name, as {"R": 0.3}.

    Raises:
        InputError: a formula is none, has symbols without a value, or the end is not positive.
    """
    import sympy

    if isinstance(formulas, str) or not np.iterable(formulas):
        raise InputError(f"formulas must be one for each coordinate, as [R*cos(s), R*sin(s)]; they are {formulas!r}")
    entries = [formula_of(formula) for formula in formulas]
    if not entries:
        raise InputError("formulas must be one for each coordinate; there is none")
    column = sympy.Matrix(entries)
    symbol = parameter if isinstance(parameter, sympy.Symbol) else sympy.Symbol(text("parameter", parameter))
    column = column.subs({x: symbol for x in column.free_symbols if x.name == symbol.name})
    given = {name: real_number(name, value) for name, value in by_name("values", values, "{'R': 0.3}").items()}
    numbers = {x: given[str(x)] for x in column.free_symbols - {symbol} if str(x) in given}
    missing = sorted(str(x) for x in column.free_symbols - {symbol} - set(numbers))
    if missing:
        raise InputError(f"give the values of {', '.join(missing)}, as values={{{missing[0]!r}: 1.0}}")
    path = FormulaPath(column, symbol, positive_number("end", end), numbers)
    real_array("the start of the path", path(0.0), (path.dimension,))
    return path


def formula_of(formula: Any) -> Any:
    """Return a coordinate as an expression without infinities and imaginary numbers.

    Raises:
        InputError: it is none.
    """
    import sympy

    if isinstance(formula, str):
        found = expression_of(formula)
    elif isinstance(formula, sympy.Expr):
        found = formula
    else:
        found = sympy.Float(real_number("a formula that is no SymPy expression", formula))
    if found.has(sympy.nan, sympy.zoo, sympy.oo, sympy.I):
        raise InputError(f"a formula must be real and finite; {formula!r} is not")
    return found


@dataclass(frozen=True, eq=False)
class FrenetFormulas:
    """The Frenet frame as formulas of s.

    Attributes:
        speed: |p'|.
        tangent, normal, binormal: `sympy.Matrix` (3, 1).
        curvature: κ.
        torsion: τ.
    """

    speed: Any
    tangent: Any
    normal: Any
    binormal: Any
    curvature: Any
    torsion: Any


def frenet_formulas(path: FormulaPath) -> FrenetFormulas:
    """Return the tangent, normal, binormal, curvature and torsion as SymPy formulas of s and the named lengths.

    κ = |p' × p''|/|p'|³, τ = (p' × p'')·p'''/|p' × p''|², t = p'/|p'|, b = p' × p''/|p' × p''|, n = b × t.

    Raises:
        InputError: the path is not one of formulas in the plane or in space, or it is a line.

    Source: do Carmo, Differential Geometry of Curves and Surfaces, 1976, section 1.5.
    """
    import sympy

    if not isinstance(path, FormulaPath) or path.dimension not in (2, 3):
        raise InputError("frenet_formulas takes a path of two or three formulas, from formula_path(...)")
    symbols = path.formula.free_symbols | {path.parameter}
    as_real = {x: x if x.is_real else sympy.Symbol(x.name, real=True) for x in symbols}
    p = sympy.Matrix([*path.formula, *[0] * (3 - path.dimension)]).subs(as_real)
    s = as_real[path.parameter]
    d1, d2, d3 = (p.diff(s, order) for order in (1, 2, 3))
    cross = sympy.simplify(d1.cross(d2))
    if cross == sympy.zeros(3, 1):
        raise InputError("the path is a line: it has no normal, and its curvature is zero")
    speed, bend = (sympy.simplify(sympy.sqrt(v.dot(v))) for v in (d1, cross))
    t, b = sympy.simplify(d1 / speed), sympy.simplify(cross / bend)
    kappa, tau = sympy.simplify(bend / speed**3), sympy.simplify(cross.dot(d3) / bend**2)
    return FrenetFormulas(speed, t, sympy.simplify(b.cross(t)), b, kappa, tau)
