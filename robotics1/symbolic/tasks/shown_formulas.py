"""The formulas of a task as they are read: at a prompt, in a notebook, in the terminal."""

from collections.abc import Mapping
from itertools import product
from typing import Any

import sympy

from robotics1.symbolic.writing.printing import aligned, latex_text, line_text, mathml_text, unicode_text

WIDEST = 120  # characters of a drawn formula
LONGEST = 60  # characters of a factor that needs no name
MANY = 150  # operations of a formula that a notebook folds


def in_characters(name: str, formula: Any) -> str:
    """Return "name =" and the formula below it; a wide one entry by entry, its long factors with names."""
    drawn = unicode_text(formula)
    if max(map(len, drawn.splitlines())) <= WIDEST:
        return f"{name} =\n{drawn}"
    if not isinstance(formula, sympy.MatrixBase):
        return _in_factors(name, formula)
    column, places = formula.cols == 1, list(product(range(formula.rows), range(formula.cols)))
    lines = [
        f"{name}[{i + 1 if column else f'{i + 1},{j + 1}'}] = {line_text(formula[i, j])}"
        for i, j in places
        if formula[i, j] != 0
    ]
    zero = ["its other entries are 0"] if len(lines) < len(places) else []
    return "\n".join([f"{name}, {formula.rows} × {formula.cols}:", *(f"  {line}" for line in [*lines, *zero])])


def _in_factors(name: str, formula: sympy.Expr) -> str:
    """Return an expression on one line, with names f1, f2, ... for its long factors, which follow."""
    named: dict[sympy.Symbol, sympy.Expr] = {}
    factors = []
    for factor in sympy.Mul.make_args(formula):
        base, power = factor.as_base_exp()
        if not base.is_Add or len(line_text(base)) <= LONGEST:
            factors.append(factor)
            continue
        symbol = sympy.Symbol(f"f{len(named) + 1}", real=True)
        named[symbol] = base
        factors.append(symbol**power)
    if len(named) < 2 and len(factors) < 2:
        return f"{name} = {line_text(formula)}"
    where = [f"  where {symbol} = {line_text(factor)}" for symbol, factor in named.items()]
    return "\n".join([f"{name} = {line_text(sympy.Mul(*factors))}", *where])


def in_html(formulas: Mapping[str, Any]) -> str:
    """Return formulas as MathML, with c₂₃ for cos(q2 + q3) and folded where they are long."""
    return "\n".join(_element(name, formula) for name, formula in formulas.items())


def _element(name: str, formula: Any) -> str:
    entries = formula if isinstance(formula, sympy.MatrixBase) else [formula]
    operations = sum(int(sympy.count_ops(entry)) for entry in entries)
    long = operations > MANY
    shown = (
        '<div style="display: flex; align-items: center; overflow: auto hidden">'
        f"{name} = {mathml_text(formula, short=long)}</div>"
    )
    return f"<details><summary>{name}, {operations} operations</summary>{shown}</details>" if long else shown


def in_latex(formulas: Mapping[str, Any]) -> str:
    """Return formulas in LaTeX, one below the other."""
    named = {name.replace("det", r"\det"): formula for name, formula in formulas.items()}
    return aligned(f"{name} &= {latex_text(formula)}" for name, formula in named.items())
