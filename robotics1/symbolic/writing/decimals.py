"""Sums with large whole coefficients, written in decimals: in metres where these are lengths of the arm."""

from collections.abc import Iterable, Sequence
from itertools import combinations

import sympy

from robotics1.symbolic.writing.printing import line_text

LEAST = 100  # of the largest coefficient: a sum of smaller ones is read as it is
MOST_TERMS = 12
MOST_LENGTHS = 16  # whose sums and differences are formed
SAME = 1e-6  # relative difference of a coefficient and a length that it is

Terms = list[tuple[float, str]]


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
    sums = [_terms(entry) for entry in (formula if column else [formula])]
    read = [terms for terms in sums if terms is not None]
    sizes = [abs(coefficient) for terms in read for coefficient, _ in terms]
    if len(read) < len(sums) or not sizes or max(sizes) < LEAST:
        return None
    factor = _factor(sizes, sorted({abs(length) for length in lengths if length}))
    if not column:  # an equation may change its sign, a vector keeps its own
        first = max(read[0], key=lambda term: abs(term[0]))
        factor = factor if first[0] > 0 else -factor
    texts = [_sum(terms, factor) for terms in read]
    return f"({', '.join(texts)})" if column else texts[0]


def with_sums_in_metres(product: sympy.Expr, lengths: Iterable[float]) -> sympy.Expr:
    """Return a product whose sums with large coefficients have lengths of the arm for them, or 1 for the largest.

    −8.3353e−6 (8500 c2 + 7845 c23) s3 becomes −0.16671 (0.425 c2 + 0.39225 c23) s3: the same but for rounding.
    """
    known = sorted({abs(length) for length in lengths if length})
    parts, outside = [], 1.0
    for part in sympy.Mul.make_args(product):
        sum_, power = part.as_base_exp()
        terms = _terms(sum_) if sum_.is_Add and power.is_Integer else None
        sizes = [abs(coefficient) for coefficient, _ in terms or []]
        if not sizes or max(sizes) < LEAST:
            parts.append(part)
            continue
        factor = _factor(sizes, known)
        split = [summand.as_coeff_Mul() for summand in sympy.Add.make_args(sympy.expand(sum_))]
        parts.append(sympy.Add(*(sympy.Float(factor * float(c), 5) * rest for c, rest in split)) ** power)
        outside /= factor ** int(power)
    if outside == 1.0:
        return product
    numbers = [part for part in parts if part.is_number]
    others = [part for part in parts if not part.is_number]
    return sympy.Mul(sympy.Float(outside * float(sympy.Mul(*numbers)), 5), *others)


def _terms(entry: sympy.Expr) -> Terms | None:
    """Return the coefficients of a sum and what each multiplies; None where one is no number."""
    summands = sympy.Add.make_args(sympy.expand(entry))
    split = [summand.as_coeff_Mul() for summand in summands if summand != 0]
    if len(split) > MOST_TERMS or any(not coefficient.is_Rational or rest.is_Add for coefficient, rest in split):
        return None
    if any(not rest.is_number and _bare_symbols(rest) for _, rest in split):
        return None
    return [(float(coefficient), "" if rest == 1 else line_text(rest)) for coefficient, rest in split]


def _bare_symbols(e: sympy.Expr) -> set[sympy.Symbol]:
    """Return the symbols outside of sines and cosines: named lengths, and coordinates of slides."""
    return set(
        e.replace(lambda part: isinstance(part, sympy.sin | sympy.cos), lambda part: sympy.Integer(1)).free_symbols
    )


def _factor(sizes: Sequence[float], lengths: Sequence[float]) -> float:
    """Return by what coefficients are multiplied so that each is a length; else so that the largest is 1."""
    largest = max(sizes)
    known = list(lengths[-MOST_LENGTHS:])
    known += [a + sign * b for b, a in combinations(known, 2) for sign in (1, -1)]
    for length in known:
        scaled = [length / largest * size for size in sizes]
        if length > 0 and all(any(abs(value - other) <= SAME * value for other in known) for value in scaled):
            return length / largest
    return 1 / largest


def _sum(terms: Terms, factor: float) -> str:
    """Return a sum, the largest coefficient first; 0 of none."""
    written = ""
    for coefficient, rest in sorted(terms, key=lambda term: -abs(term[0])):
        value = factor * coefficient
        size = f"{abs(value):.5g}"
        term = size if not rest else rest if size == "1" else f"{size}·{rest}"
        sign = "−" if value < 0 else "+"
        written += f" {sign} {term}" if written else f"{'−' if value < 0 else ''}{term}"
    return written or "0"
