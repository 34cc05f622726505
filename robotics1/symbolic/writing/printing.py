"""Formulas as text, for the terminal, for LaTeX and for a page (MathML); and as functions of numbers."""

import html
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import sympy
from sympy.printing.latex import LatexPrinter
from sympy.printing.mathml import MathMLPresentationPrinter
from sympy.printing.pretty.pretty import PrettyPrinter
from sympy.printing.pretty.pretty_symbology import pretty_use_unicode
from sympy.printing.str import StrPrinter

from robotics1.names import printable

LONGEST_NUMBER = 8  # characters of a number that is read as it is
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
