"""Formulas as text: for the terminal, for LaTeX, for a page (MathML), and as a function in Python."""

import keyword
import re
from collections.abc import Mapping, Sequence
from typing import Any

import sympy
from sympy.printing.numpy import NumPyPrinter

INDENT = "    "
LONGEST_NUMBER = 8  # characters of a number that is read as it is

Formula = Any  # a sympy.Expr, a sympy.Matrix, or a list of expressions that is a vector


def unicode_text(formula: Any) -> str:
    """Return a formula drawn with characters, on one or several lines."""
    return str(sympy.pretty(formula, use_unicode=True, wrap_line=False))


def latex_text(formula: Any) -> str:
    """Return a formula in LaTeX."""
    return str(sympy.latex(formula))


def mathml_text(formula: Any) -> str:
    """Return a formula as a MathML element of an HTML page: q̇ with its dot above, and − for a hyphen."""
    text = sympy.mathml(formula, printer="presentation")
    text = re.sub(r"<mi>(\w)dot</mi>", r"<mover><mi>\1</mi><mo>˙</mo></mover>", text)
    text = re.sub("<(mo|mn|mi)>-", r"<\1>−", text)
    return f'<math display="block">{text}</math>'


def python_function(
    name: str,
    formula: Formula,
    vectors: Mapping[str, Sequence[sympy.Symbol]],
    parameters: Mapping[str, float | None],
    summary: str,
) -> str:
    """Return the source of a function that evaluates a formula, with NumPy.

    Args:
        name: what the function is called.
        formula: an expression, a matrix, or a list that is a vector.
        vectors: the arguments that are arrays: name → the symbols of its entries.
        parameters: the arguments that are named lengths: name → value, or None if it must be given.
        summary: the line that says what is returned.
    """
    used = {symbol.name for symbols in vectors.values() for symbol in symbols}
    spelled = {parameter: _spelled(parameter, {*used, *vectors}) for parameter in parameters}
    written = {sympy.Symbol(old, real=True): sympy.Symbol(new, real=True) for old, new in spelled.items()}
    entries = [entry.xreplace(written) for entry in _entries(formula)]
    free = (s for s in sympy.numbered_symbols("t", real=True) if s.name not in {*used, *spelled.values()})
    shared, entries = sympy.cse(entries, symbols=free)
    given = [spelled[p] if value is None else f"{spelled[p]}={value!r}" for p, value in parameters.items()]
    lines = [f"def {name}({', '.join([*vectors, *(['*', *given] if given else [])])}):", f'{INDENT}"""{summary}"""']
    for vector, symbols in vectors.items():
        names = [symbol.name for symbol in symbols]
        lines.append(f"{INDENT}{', '.join(names) if len(names) > 1 else f'({names[0]},)'} = {vector}")
    lines += [f"{INDENT}{symbol.name} = {_python(e)}" for symbol, e in shared]
    texts = [_python(entry) for entry in entries]
    return "\n".join(["import numpy as np", "", "", *lines, *_returned(formula, texts)]) + "\n"


def _entries(formula: Formula) -> list[sympy.Expr]:
    return [formula] if isinstance(formula, sympy.Expr) else list(formula)


def _returned(formula: Formula, texts: list[str]) -> list[str]:
    """Return the lines of the return statement: of a number, a vector or a matrix."""
    if isinstance(formula, sympy.Expr):
        return [f"{INDENT}return {texts[0]}"]
    if isinstance(formula, sympy.MatrixBase):
        n = formula.cols
        texts = [f"[{', '.join(texts[i : i + n])}]" for i in range(0, len(texts), n)]
    rows = [f"{3 * INDENT}{text}," for text in texts]
    return [
        f"{INDENT}return np.array(",
        f"{2 * INDENT}[",
        *rows,
        f"{2 * INDENT}],",
        f"{2 * INDENT}dtype=float,",
        f"{INDENT})",
    ]


def _python(e: sympy.Expr) -> str:
    return re.sub(r"\bnumpy\.", "np.", NumPyPrinter().doprint(e))


def _spelled(name: str, taken: set[str]) -> str:
    """Return a name as Python takes it."""
    word = re.sub(r"\W", "_", name)
    return f"{word}_" if keyword.iskeyword(word) or word == "np" or word in taken else word


def line_text(formula: Any) -> str:
    """Return a formula on one line, as in l2·cos(q2) + l3·cos(q2 + q3) = 0; a column as (a, b, c)."""
    if isinstance(formula, sympy.MatrixBase):
        return f"({', '.join(line_text(entry) for entry in formula)})"
    if isinstance(formula, sympy.Equality):
        return f"{line_text(formula.lhs)} = {line_text(formula.rhs)}"
    formula = _with_short_numbers(formula)
    text = re.sub(r"\*\*([2-9])\b", lambda power: "²³⁴⁵⁶⁷⁸⁹"[int(power[1]) - 2], str(formula))
    return re.sub(r"\bpi\b", "π", text.replace("*", "·").replace("-", "−"))


def _with_short_numbers(formula: Any) -> Any:
    """Return an expression whose long fractions are decimals with six digits."""
    long = {x for x in sympy.sympify(formula).atoms(sympy.Rational, sympy.Float) if len(str(x)) > LONGEST_NUMBER}
    return formula.xreplace({x: sympy.Float(x, 6) for x in long}) if long else formula
