"""Sums with large whole coefficients, written in decimals: in metres where these are lengths of the arm."""

from collections.abc import Iterable, Sequence
from itertools import combinations

import sympy

from robotics1.symbolic.writing.printing import line_text

LEAST = 100  # of the largest coefficient: a sum of smaller ones is read as it is
MOST_TERMS = 12
MOST_LENGTHS = 16  # whose sums and differences are formed
SAME = 1e-6  # relative difference of a coefficient and a length that it is


def in_decimals(formula: sympy.Expr | sympy.Matrix, lengths: Iterable[float]) -> str | None:
    """Return a sum, or a column of sums, up to a factor: 0.425·cos(q2) + 0.39225·cos(q2 + q3).

    The coefficients have five digits, the largest first. They are lengths of the arm where one factor makes lengths of
    all, or sums or differences of two; else the largest is 1.

    Args:
        formula: sums with whole or rational coefficients, without named lengths.
        lengths: those of the arm [m].

    Returns:
        The text, or None where the formula is no such sum, or its coefficients are small.
    """
    column = isinstance(formula, sympy.MatrixBase)
    entries = [sympy.expand(entry) for entry in (formula if column else [formula])]
    scale = scale_to_lengths(entries, lengths)
    if scale is None:
        return None
    factor, split = float(scale), [_terms(entry) for entry in entries]
    if not column:  # an equation may change its sign, a vector keeps its own
        factor = factor if max(split[0], key=lambda term: abs(term[0]))[0] > 0 else -factor
    texts = [_sum([(float(c), "" if rest == 1 else line_text(rest)) for c, rest in terms], factor) for terms in split]
    return f"({', '.join(texts)})" if column else texts[0]


def scale_to_lengths(entries: Iterable[sympy.Expr], lengths: Iterable[float]) -> sympy.Rational | None:
    """Return by what expanded sums with large whole coefficients are multiplied to have lengths for them.

    Where a slide's coordinate or a named length is in a term, its coefficient becomes 1, if the others are lengths
    then. None where coefficients are small, no numbers, or too many.
    """
    split = [_terms(entry) for entry in entries]
    terms = [term for sums in split for term in sums]
    if not terms or max(map(len, split)) > MOST_TERMS or any(not coefficient.is_Rational for coefficient, _ in terms):
        return None
    bare = {abs(coefficient) for coefficient, rest in terms if not rest.is_number and _bare_symbols(rest)}
    sizes = [abs(float(coefficient)) for coefficient, rest in terms if rest.is_number or not _bare_symbols(rest)]
    if len(bare) > 1 or max([*sizes, *map(float, bare)]) < LEAST or any(rest.is_Add for _, rest in terms):
        return None
    if bare:
        k = 1 / bare.pop()
        return k if sizes and _are_lengths([float(k) * size for size in sizes], _sums(lengths)) else None
    return sympy.Rational(str(factor_to_lengths(sizes, lengths)))


def _terms(entry: sympy.Expr) -> list[tuple[sympy.Expr, sympy.Expr]]:
    """Return the coefficients of a sum and what each multiplies."""
    return [summand.as_coeff_Mul() for summand in sympy.Add.make_args(entry) if summand != 0]


def _bare_symbols(e: sympy.Expr) -> set[sympy.Symbol]:
    """Return the symbols outside of sines and cosines: named lengths, and coordinates of slides."""
    return set(
        e.replace(lambda part: isinstance(part, sympy.sin | sympy.cos), lambda part: sympy.Integer(1)).free_symbols
    )


def factor_to_lengths(sizes: Sequence[float], lengths: Iterable[float]) -> float:
    """Return by what coefficients are multiplied so that each is a length; else so that the largest is 1."""
    largest, known = max(sizes), _sums(lengths)
    for length in known:
        if length > 0 and _are_lengths([length / largest * size for size in sizes], known):
            return length / largest
    return 1 / largest


def _sums(lengths: Iterable[float]) -> list[float]:
    """Return the lengths, and the sums and differences of two."""
    known = sorted({abs(length) for length in lengths if length})[-MOST_LENGTHS:]
    return known + [a + sign * b for b, a in combinations(known, 2) for sign in (1, -1)]


def _are_lengths(values: Iterable[float], known: Sequence[float]) -> bool:
    return all(any(abs(value - other) <= SAME * value for other in known) for value in values)


def _sum(terms: list[tuple[float, str]], factor: float) -> str:
    """Return a sum, the largest coefficient first; 0 of none."""
    written = ""
    for coefficient, rest in sorted(terms, key=lambda term: -abs(term[0])):
        value = factor * coefficient
        size = f"{abs(value):.5g}"
        term = size if not rest else rest if size == "1" else f"{size}·{rest}"
        sign = "−" if value < 0 else "+"
        written += f" {sign} {term}" if written else f"{'−' if value < 0 else ''}{term}"
    return written or "0"
