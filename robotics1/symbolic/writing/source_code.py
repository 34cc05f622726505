"""Formulas as functions in Python, C and MATLAB (which GNU Octave reads too): common parts are computed once."""

import keyword
import math
import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import sympy
from sympy.printing.c import C99CodePrinter
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.octave import OctaveCodePrinter

from robotics1.names import printable

INDENT = "    "
USED = {"np", "float", "__debug__"}  # a written function needs the first two; Python assigns the last to nothing
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
Formula = Any  # a sympy.Expr, a sympy.Matrix, or a list of expressions that is a vector
Vectors = Mapping[str, Sequence[sympy.Symbol]]
Lengths = Mapping[str, float | None]


def python_function(name: str, formula: Formula, vectors: Vectors, parameters: Lengths, summary: str) -> str:
    """Return the source of a function that evaluates a formula, with NumPy.

    Args:
        name: what the function is called.
        formula: an expression, a matrix, or a list that is a vector.
        vectors: the arguments that are arrays: name → the symbols of its entries.
        parameters: the arguments that are named lengths: name → value, or None if it must be given.
        summary: what is returned; it may hold names from a file, for it is written as text.
    """
    shared, entries, words, _ = _prepared(formula, vectors, parameters, USED, python_word)
    given = [words[p] if value is None else f"{words[p]}={value!r}" for p, value in parameters.items()]
    taking = ", ".join([*vectors, *(["*", *given] if given else [])])
    lines = [f"def {name}({taking}):", f'{INDENT}"""{_inside_quotes(summary)}"""']
    for vector, symbols in vectors.items():
        names = [symbol.name for symbol in symbols]
        if names:
            lines.append(f"{INDENT}{', '.join(names) if len(names) > 1 else f'({names[0]},)'} = {vector}")
    lines += [f"{INDENT}{symbol.name} = {_python(e)}" for symbol, e in shared]
    return "\n".join(["import numpy as np", "", "", *lines, *_returned(formula, list(map(_python, entries)))]) + "\n"


def c_printer() -> C99CodePrinter:
    """Return SymPy's printer of C99 with a number for π: M_PI belongs to POSIX, not to the language."""
    return C99CodePrinter({"math_macros": {sympy.pi: repr(math.pi)}})


def c_function(name: str, formula: Any, vectors: Vectors, parameters: Lengths, summary: str) -> str:
    """Return the source of a C function `void name(const double *q, double l2, ..., double *out)`.

    A matrix is written to `out` row by row. Arguments as those of `python_function`; a length has no default in C, and
    its value stands in the comment.
    """
    shared, entries, words, used = _prepared(formula, vectors, parameters, C_WORDS | {name, "out"}, identifier)
    printer = c_printer()
    arguments = [f"const double *{vector}" for vector in vectors] + [f"double {words[p]}" for p in parameters]
    values = "".join(f"\n * {words[p]} = {value!r}" for p, value in parameters.items() if value is not None)
    lines = [
        "#include <math.h>",
        "",
        f"/* {_comment(summary)}; out: {' x '.join(map(str, _shape(formula)))}, row by row{values}",
    ]
    lines[-1] += "\n */"
    lines.append(f"void {name}({', '.join([*arguments, 'double *out'])})")
    lines.append("{")
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
    shared, entries, words, used = _prepared(formula, vectors, parameters, MATLAB_WORDS | {name, "out"}, identifier)
    printer = OctaveCodePrinter()
    arguments = [*vectors, *(words[p] for p in parameters)]
    lines = [f"function out = {name}({', '.join(arguments)})", f"% {_comment(summary)}"]
    for i, (p, value) in enumerate(parameters.items(), len(vectors) + 1):
        if value is not None:
            lines.append(f"    if nargin < {i}, {words[p]} = {value!r}; end")
    for vector, symbols in vectors.items():
        lines += [f"    {symbol.name} = {vector}({i});" for i, symbol in enumerate(symbols, 1) if symbol.name in used]
    lines += [f"    {symbol.name} = {printer.doprint(e)};" for symbol, e in shared]
    rows, cols = _shape(formula)
    texts = [", ".join(printer.doprint(e) for e in entries[cols * i : cols * (i + 1)]) for i in range(rows)]
    lines.append("    out = [" + "; ...\n        ".join(texts) + "];")
    return "\n".join([*lines, "end", ""])


class Prepared(NamedTuple):
    """A formula with its parameters spelled as a language has them.

    Attributes:
        shared: the common parts, each with its name.
        entries: row by row, in names of common parts.
        words: parameter → its identifier.
        used: the names in both.
    """

    shared: list[tuple[sympy.Symbol, sympy.Expr]]
    entries: list[sympy.Expr]
    words: dict[str, str]
    used: set[str]


def _prepared(
    formula: Formula, vectors: Vectors, parameters: Lengths, taken: set[str], spell: Callable[[str], str]
) -> Prepared:
    own = {symbol.name for symbols in vectors.values() for symbol in symbols} | set(vectors) | taken
    words = spelled(parameters, own, spell)
    written = {sympy.Symbol(old, real=True): sympy.Symbol(new, real=True) for old, new in words.items()}
    free = (s for s in sympy.numbered_symbols("t", real=True) if s.name not in {*own, *words.values()})
    entries = [formula] if isinstance(formula, sympy.Expr) else list(formula)
    shared, entries = sympy.cse([entry.xreplace(written) for entry in entries], symbols=free)
    used = {symbol.name for e in [*(e for _, e in shared), *entries] for symbol in e.free_symbols}
    return Prepared(shared, entries, words, used)


def _shape(formula: Formula) -> tuple[int, int]:
    """Return how many rows and columns there are."""
    if isinstance(formula, sympy.MatrixBase):
        return formula.rows, formula.cols
    return (1 if isinstance(formula, sympy.Expr) else len(formula)), 1


def _returned(formula: Formula, texts: list[str]) -> list[str]:
    """Return the lines of the return statement: of a number, a vector or a matrix."""
    if isinstance(formula, sympy.Expr):
        return [f"{INDENT}return {texts[0]}"]
    if isinstance(formula, sympy.MatrixBase):
        n = formula.cols
        texts = [f"[{', '.join(texts[n * i : n * (i + 1)])}]" for i in range(formula.rows)]
    rows = [f"{3 * INDENT}{text}," for text in texts]
    opening, closing = [f"{INDENT}return np.array(", f"{2 * INDENT}["], [f"{2 * INDENT}],", f"{2 * INDENT}dtype=float,"]
    return [*opening, *rows, *closing, f"{INDENT})"]


def _python(e: sympy.Expr) -> str:
    return re.sub(r"\bnumpy\.", "np.", NumPyPrinter().doprint(e))


def python_word(name: str) -> str:
    """Return a name as an identifier of Python."""
    word = re.sub(r"\W", "_", unicodedata.normalize("NFKC", name))  # Python takes "ﬁ" and "fi" for one name
    word = word if word.isidentifier() else f"_{word}"
    return f"{word}_" if keyword.iskeyword(word) else word


def spelled(names: Iterable[str], taken: set[str], spell: Callable[[str], str] = python_word) -> dict[str, str]:
    """Return each name as an identifier, no two alike and none of those that are taken."""
    words: dict[str, str] = {}
    for name in names:
        word = spell(name)
        while word in taken or word in words.values():
            word += "_"
        words[name] = word
    return words


def _inside_quotes(text: str) -> str:
    """Return a text as it is written between three quotes, which nothing in it ends or continues."""
    return printable(text.replace("\\", r"\\").replace('"', r"\""))


def identifier(name: str) -> str:
    """Return a name of ASCII letters, digits and underscores that begins with a letter: λ2 becomes u3bb2."""
    ascii_name = "".join(c if c.isascii() else f"u{ord(c):x}" for c in name)
    word = re.sub(r"\W", "_", ascii_name)
    return word if word[:1].isalpha() else f"p{word}"


def _comment(text: str) -> str:
    """Return a text as it stands in a comment of one line, which nothing in it ends."""
    return re.sub(r"\*/|/\*", "* /", printable(text)).encode("ascii", "backslashreplace").decode("ascii")
