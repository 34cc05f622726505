"""Formulas as functions of C and MATLAB (which GNU Octave reads too): common parts are computed once."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

import sympy
from sympy.printing.c import C99CodePrinter
from sympy.printing.octave import OctaveCodePrinter

from robotics1.names import printable

WORD = re.compile(r"\w+")
C_WORDS = set(
    WORD.findall(
        "auto break case char const continue default do double else enum extern float for goto if inline int long "
        "register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while "
        "sin cos tan asin acos atan atan2 sqrt exp log pow fabs main"
    )
)
MATLAB_WORDS = set(
    WORD.findall(
        "break case catch classdef continue else elseif end for function global if otherwise parfor persistent return "
        "spmd switch try while sin cos tan asin acos atan atan2 sqrt exp log abs pi i j nargin"
    )
)
Vectors = Mapping[str, Sequence[sympy.Symbol]]
Lengths = Mapping[str, float | None]


def c_printer() -> C99CodePrinter:
    """Return SymPy's printer of C99 with a number for π: M_PI belongs to POSIX, not to the language."""
    return C99CodePrinter({"math_macros": {sympy.pi: repr(math.pi)}})


def c_function(name: str, formula: Any, vectors: Vectors, parameters: Lengths, summary: str) -> str:
    """Return the source of a C function `void name(const double *q, double l2, ..., double *out)`.

    A matrix is written to `out` row by row. Arguments as those of `python_function`; a length has no default in C, and
    its value stands in the comment.
    """
    entries, shape = _entries(formula)
    shared, entries, words = _prepared(entries, vectors, parameters, C_WORDS | {name, "out"})
    printer = c_printer()
    arguments = [f"const double *{vector}" for vector in vectors] + [f"double {words[p]}" for p in parameters]
    values = "".join(f"\n * {words[p]} = {value!r}" for p, value in parameters.items() if value is not None)
    lines = ["#include <math.h>", "", f"/* {_comment(summary)}; out: {' x '.join(map(str, shape))}, row by row{values}"]
    lines[-1] += "\n */"
    lines.append(f"void {name}({', '.join([*arguments, 'double *out'])})")
    lines.append("{")
    used = _symbols_of([*(e for _, e in shared), *entries])
    for vector, symbols in vectors.items():
        read = [(i, symbol) for i, symbol in enumerate(symbols) if symbol.name in used]
        lines += [f"    const double {symbol.name} = {vector}[{i}];" for i, symbol in read] or [f"    (void){vector};"]
    lines += [f"    (void){word};" for word in words.values() if word not in used]
    lines += [f"    const double {symbol.name} = {printer.doprint(e)};" for symbol, e in shared]
    lines += [f"    out[{i}] = {printer.doprint(entry)};" for i, entry in enumerate(entries)]
    return "\n".join([*lines, "}", ""])


def matlab_function(name: str, formula: Any, vectors: Vectors, parameters: Lengths, summary: str) -> str:
    """Return the source of a MATLAB function `function out = name(q, l2, ...)`; a length left out has its value.

    Arguments as those of `python_function`.
    """
    entries, shape = _entries(formula)
    shared, entries, words = _prepared(entries, vectors, parameters, MATLAB_WORDS | {name, "out"})
    printer = OctaveCodePrinter()
    arguments = [*vectors, *(words[p] for p in parameters)]
    lines = [f"function out = {name}({', '.join(arguments)})", f"% {_comment(summary)}"]
    used = _symbols_of([*(e for _, e in shared), *entries])
    for i, (p, value) in enumerate(parameters.items(), len(vectors) + 1):
        if value is not None:
            lines.append(f"    if nargin < {i}, {words[p]} = {value!r}; end")
    for vector, symbols in vectors.items():
        lines += [f"    {symbol.name} = {vector}({i});" for i, symbol in enumerate(symbols, 1) if symbol.name in used]
    lines += [f"    {symbol.name} = {printer.doprint(e)};" for symbol, e in shared]
    rows, cols = shape
    texts = [", ".join(printer.doprint(e) for e in entries[cols * i : cols * (i + 1)]) for i in range(rows)]
    lines.append("    out = [" + "; ...\n        ".join(texts) + "];")
    return "\n".join([*lines, "end", ""])


def _entries(formula: Any) -> tuple[list[sympy.Expr], tuple[int, int]]:
    """Return the entries row by row, and how many rows and columns there are."""
    if isinstance(formula, sympy.MatrixBase):
        return list(formula), (formula.rows, formula.cols)
    return ([formula], (1, 1)) if isinstance(formula, sympy.Expr) else (list(formula), (len(formula), 1))


def _prepared(
    entries: Sequence[sympy.Expr], vectors: Vectors, parameters: Lengths, taken: set[str]
) -> tuple[list[tuple[sympy.Symbol, sympy.Expr]], list[sympy.Expr], dict[str, str]]:
    """Return common parts, entries in them, and the identifiers of the parameters."""
    used = {symbol.name for symbols in vectors.values() for symbol in symbols} | set(vectors) | taken
    words: dict[str, str] = {}
    for parameter in parameters:
        word = identifier(parameter)
        while word in used or word in words.values():
            word += "_"
        words[parameter] = word
    written = {sympy.Symbol(old, real=True): sympy.Symbol(new, real=True) for old, new in words.items()}
    names = {*used, *words.values()}
    free = (s for s in sympy.numbered_symbols("t", real=True) if s.name not in names)
    shared, reduced = sympy.cse([entry.xreplace(written) for entry in entries], symbols=free)
    return shared, list(reduced), words


def _symbols_of(expressions: Sequence[sympy.Expr]) -> set[str]:
    return {symbol.name for e in expressions for symbol in e.free_symbols}


def identifier(name: str) -> str:
    """Return a name of ASCII letters, digits and underscores that begins with a letter: λ2 becomes u3bb2."""
    ascii_name = "".join(c if c.isascii() else f"u{ord(c):x}" for c in name)
    word = re.sub(r"\W", "_", ascii_name)
    return word if word[:1].isalpha() else f"p{word}"


def _comment(text: str) -> str:
    """Return a text as it stands in a comment of one line, which nothing in it ends."""
    return re.sub(r"\*/|/\*", "* /", printable(text)).encode("ascii", "backslashreplace").decode("ascii")
