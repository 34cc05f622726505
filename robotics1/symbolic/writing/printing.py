"""Formulas as text, for the terminal, for LaTeX and for a page (MathML); as functions of numbers, and their source."""

import html
import keyword
import re
import unicodedata
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import sympy
from sympy.printing.latex import LatexPrinter
from sympy.printing.mathml import MathMLPresentationPrinter
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.pretty.pretty import PrettyPrinter
from sympy.printing.pretty.pretty_symbology import pretty_use_unicode
from sympy.printing.str import StrPrinter

from robotics1.names import printable

INDENT = "    "
LONGEST_NUMBER = 8  # characters of a number that is read as it is
USED = {"np", "float", "__debug__"}  # a written function needs the first two; Python assigns the last to nothing
LATEX = {"\\": r"\textbackslash{}", "^": r"\textasciicircum{}", "~": r"\textasciitilde{}", "<": r"\textless{}"}
LATEX |= {">": r"\textgreater{}"} | {c: rf"\{c}" for c in "{}$&#%_"}
JOINT = re.compile(r"q(\d+)")  # the symbol of a joint
DIGITS = 5  # of a number that is read
LARGEST_DENOMINATOR = 9  # of a fraction that is read as one
WORD = re.compile(r"[^\W_]+(_[^\W_]+)*")  # a name such as l2 or l_2

Formula = Any  # a sympy.Expr, a sympy.Matrix, or a list of expressions that is a vector


def unicode_text(formula: Any) -> str:
    """Return a formula drawn with characters, on one or several lines."""
    unicode = pretty_use_unicode(True)
    try:
        return str(_Pretty({"use_unicode": True, "wrap_line": False}).doprint(formula))
    finally:
        pretty_use_unicode(unicode)


def latex_text(formula: Any) -> str:
    """Return a formula in LaTeX."""
    return str(_Latex().doprint(formula))


def aligned(rows: Iterable[str]) -> str:
    """Return equations in LaTeX as a notebook shows them, one below the other."""
    return "$$\\begin{aligned} " + r" \\ ".join(rows) + r" \end{aligned}$$"


def mathml_text(formula: Any, *, short: bool = False) -> str:
    """Return a formula as a MathML element of an HTML page: q̇ with its dot above, and − for a hyphen.

    Args:
        formula: an expression, a matrix or a relation.
        short: whether to write c₂₃ for cos(q2 + q3), s₂₃ for its sine, and decimals for fractions that no one reads.
    """
    text = _ShortMathML().doprint(with_decimals(formula)) if short else _MathML().doprint(formula)
    text = re.sub(r"<mi>(\w)dot</mi>", r"<mover><mi>\1</mi><mo>˙</mo></mover>", text)
    text = re.sub("<(mo|mn|mi)>-", r"<\1>−", text)
    return f'<math display="block">{text}</math>'


class _LargestFirst:
    """A printer's order of terms: where coefficients are decimals the largest first, else SymPy's."""

    def _as_ordered_terms(self, expr: sympy.Expr, order: Any = None) -> list[sympy.Expr]:
        terms: list[sympy.Expr] = super()._as_ordered_terms(expr, order=order)  # type: ignore[misc]
        coefficients = [term.as_coeff_Mul()[0] for term in terms]
        if not any(coefficient.is_Float for coefficient in coefficients):
            return terms
        return sorted(terms, key=lambda term: -abs(term.as_coeff_Mul()[0]))


class _Pretty(_LargestFirst, PrettyPrinter):  # type: ignore[misc]
    """SymPy's printer of several lines."""


class _Latex(_LargestFirst, LatexPrinter):  # type: ignore[misc]
    """SymPy's printer, with names from a file as text: SymPy writes a name such as </math> or a macro as it is."""

    def _print_Symbol(self, symbol: sympy.Symbol, style: str = "plain") -> str:
        if WORD.fullmatch(symbol.name):
            return str(super()._print_Symbol(symbol, style=style))
        return rf"\text{{{''.join(LATEX.get(c, c) for c in printable(symbol.name))}}}"


class _MathML(_LargestFirst, MathMLPresentationPrinter):  # type: ignore[misc]
    """SymPy's printer, with names from a file as text: SymPy writes a name such as <img> as it is."""

    def _print_Symbol(self, symbol: sympy.Symbol, style: str = "plain") -> Any:
        return super()._print_Symbol(sympy.Symbol(html.escape(printable(symbol.name))), style=style)


class _ShortMathML(_MathML):
    """The printer with textbooks' short names of cosines and sines of joint angles and of their sums."""

    def _print_cos(self, formula: sympy.cos) -> Any:
        return self._short("c", formula)

    def _print_sin(self, formula: sympy.sin) -> Any:
        return self._short("s", formula)

    def _print_atan2(self, formula: sympy.atan2) -> Any:
        """Write atan2, which has two arguments, where SymPy writes arctan."""
        row = self._print_Function(formula)
        row.getElementsByTagName("mi")[0].firstChild.data = "atan2"
        return row

    def _short(self, letter: str, formula: sympy.Function) -> Any:
        joints = [JOINT.fullmatch(str(angle)) for angle in sympy.Add.make_args(formula.args[0])]
        numbers = sorted(int(joint[1]) for joint in joints if joint)
        if len(numbers) < len(joints):
            return self._print_Function(formula)
        name = self.dom.createElement("msub")
        for tag, text in (("mi", letter), ("mn", ("," if numbers[-1] > 9 else "").join(map(str, numbers)))):
            part = self.dom.createElement(tag)
            part.appendChild(self.dom.createTextNode(text))
            name.appendChild(part)
        return name


def numpy_function(symbols: Sequence[sympy.Symbol], formula: Any) -> Callable[..., Any]:
    """Return a function of the symbols' values that evaluates an expression or a matrix with NumPy.

    The symbols get other names first: SymPy's `lambdify` takes a symbol named sin for the function.
    """
    plain = [sympy.Dummy(f"x{i}", real=symbol.is_real) for i, symbol in enumerate(symbols)]
    return sympy.lambdify(plain, formula.xreplace(dict(zip(symbols, plain, strict=True))), modules="numpy")  # type: ignore[no-any-return]


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
        summary: what is returned; it may hold names from a file, for it is written as text.
    """
    used = {symbol.name for symbols in vectors.values() for symbol in symbols}
    words = spelled(parameters, {*used, *vectors, *USED})
    written = {sympy.Symbol(old, real=True): sympy.Symbol(new, real=True) for old, new in words.items()}
    entries = [entry.xreplace(written) for entry in _entries(formula)]
    free = (s for s in sympy.numbered_symbols("t", real=True) if s.name not in {*used, *words.values()})
    shared, entries = sympy.cse(entries, symbols=free)
    given = [words[p] if value is None else f"{words[p]}={value!r}" for p, value in parameters.items()]
    taking = ", ".join([*vectors, *(["*", *given] if given else [])])
    lines = [f"def {name}({taking}):", f'{INDENT}"""{_inside_quotes(summary)}"""']
    for vector, symbols in vectors.items():
        names = [symbol.name for symbol in symbols]
        if names:
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
        texts = [f"[{', '.join(texts[n * i : n * (i + 1)])}]" for i in range(formula.rows)]
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


def spelled(names: Iterable[str], taken: set[str]) -> dict[str, str]:
    """Return each name as an identifier of Python, no two alike and none of those that are taken."""
    words: dict[str, str] = {}
    for name in names:
        word = re.sub(r"\W", "_", unicodedata.normalize("NFKC", name))  # Python takes "ﬁ" and "fi" for one name
        word = word if word.isidentifier() else f"_{word}"
        while keyword.iskeyword(word) or word in taken or word in words.values():
            word += "_"
        words[name] = word
    return words


def _inside_quotes(text: str) -> str:
    """Return a text as it is written between three quotes, which nothing in it ends or continues."""
    return printable(text.replace("\\", r"\\").replace('"', r"\""))


class _Line(_LargestFirst, StrPrinter):  # type: ignore[misc]
    """SymPy's text, with |x| for its Abs(x)."""

    def _print_Abs(self, formula: sympy.Abs) -> str:
        return f"|{self._print(formula.args[0])}|"


def line_text(formula: Any) -> str:
    """Return a formula on one line, as in l2·cos(q2) + l3·cos(q2 + q3) = 0; a column as (a, b, c)."""
    if isinstance(formula, sympy.MatrixBase):
        return f"({', '.join(line_text(entry) for entry in formula)})"
    if isinstance(formula, sympy.Equality):
        return f"{line_text(formula.lhs)} = {line_text(formula.rhs)}"
    formula = _with_short_numbers(formula)
    text = _Line({"full_prec": False}).doprint(formula)
    text = re.sub(r"\*\*([2-9])\b", lambda power: "²³⁴⁵⁶⁷⁸⁹"[int(power[1]) - 2], text)
    return re.sub(r"\bpi\b", "π", text.replace("*", "·").replace("-", "−"))


def _with_short_numbers(formula: Any) -> Any:
    """Return an expression whose long fractions are decimals with five digits."""
    long = {x for x in sympy.sympify(formula).atoms(sympy.Rational, sympy.Float) if len(str(x)) > LONGEST_NUMBER}
    return formula.xreplace({x: sympy.Float(x, DIGITS) for x in long}) if long else formula


def with_decimals(formula: Any) -> Any:
    """Return a formula with 0.425 for 17/40: only fractions such as 1/2 and 2/3 stay."""
    numbers = formula.atoms(sympy.Rational, sympy.Float)
    long = {x for x in numbers if not x.is_Rational or x.q > LARGEST_DENOMINATOR or x.p > 999 * x.q}
    return formula.xreplace({x: sympy.Float(x, DIGITS) for x in long if not x.is_Integer}) if long else formula
