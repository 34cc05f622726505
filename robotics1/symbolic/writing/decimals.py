"""Sums with whole coefficients, written in metres where these are lengths of the arm; large ones always in decimals.

A factor of a determinant is known up to a constant: 8 cos q2 + 7 cos(q2 + q3). The lengths of the file say which
constant makes it 0.8 cos q2 + 0.7 cos(q2 + q3). Where several do, as many coefficients as possible are lengths that
the joints of their terms carry: link 3 turns with q2 + q3.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import sympy

from robotics1.robot.model import Robot
from robotics1.symbolic.writing.printing import JOINT, line_text
from robotics1.tasks.task import Task

LEAST = 100  # of the largest coefficient: a sum of smaller ones is read as it is where they are no lengths
MOST_TERMS = 12
MOST_LENGTHS = 16  # whose sums and differences are formed
SAME = 1e-6  # relative difference of a coefficient and a length that it is

Lengths = Mapping[float, set[int]]  # length [m] → the numbers of the joints that carry it, from 1; 0 is the base


class Term(NamedTuple):
    """A coefficient of a sum, and what it multiplies."""

    coefficient: sympy.Expr
    rest: sympy.Expr

    @property
    def last_joint(self) -> int:
        """The number of the last joint in it; 0 without joints."""
        found = (JOINT.fullmatch(symbol.name) for symbol in self.rest.free_symbols)
        return max((int(joint[1]) for joint in found if joint), default=0)


def lengths_in(robot: Robot, task: Task) -> Lengths:
    """Return the lengths of a robot's file, which formulas of a task with positions hold; none of angles alone."""
    if "m" not in task.row_units:
        return {}
    numbers = {name: i for i, name in enumerate(robot.joint_names, start=1)}
    above = {joint.child: joint for joint in robot.joints}
    lengths: dict[float, set[int]] = {}
    for joint in robot.joints:
        carrier = above.get(joint.parent)
        while carrier is not None and carrier.leader not in numbers:
            carrier = above.get(carrier.parent)
        for x in joint.xyz:
            lengths.setdefault(abs(x), set()).add(numbers[carrier.leader] if carrier else 0)
    return lengths


def in_decimals(formula: sympy.Expr | sympy.Matrix, lengths: Lengths) -> str | None:
    """Return a sum, or a column of sums, up to a factor: 0.425·cos(q2) + 0.39225·cos(q2 + q3).

    The coefficients have five digits, the largest first. They are lengths of the arm where one factor makes lengths of
    all, or sums or differences of two; else the largest is 1.

    Args:
        formula: sums with whole or rational coefficients, without named lengths.
        lengths: those of the arm.

    Returns:
        The text, or None where the formula is no such sum, or its coefficients are small and no lengths.
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


def scale_to_lengths(entries: Iterable[sympy.Expr], lengths: Lengths) -> sympy.Rational | None:
    """Return by what expanded sums with whole coefficients are multiplied to have lengths for them.

    Where a slide's coordinate or a named length is in a term, its coefficient becomes 1, if the others are lengths
    then. None where coefficients are no numbers, or too many, or small and no lengths.
    """
    split = [_terms(entry) for entry in entries]
    terms = [term for sums in split for term in sums]
    if not terms or max(map(len, split)) > MOST_TERMS or any(not term.coefficient.is_Rational for term in terms):
        return None
    if any(rest.is_Add or (rest.is_number and rest != 1) for _, rest in terms):
        return None
    with_bare = [bool(_bare_symbols(term.rest)) for term in terms]
    bare = {abs(term.coefficient) for term, is_bare in zip(terms, with_bare, strict=True) if is_bare}
    others = [term for term, is_bare in zip(terms, with_bare, strict=True) if not is_bare]
    if len(bare) > 1:
        return None
    if bare:
        k = 1 / bare.pop()
        sizes = [float(k * abs(term.coefficient)) for term in others]
        return k if sizes and _are_lengths(sizes, _with_sums(lengths)) else None
    sizes = [float(abs(term.coefficient)) for term in others]
    factor = _factor_to_lengths(others, sizes, lengths)
    if factor is None:
        factor = None if max(sizes) < LEAST else 1 / max(sizes)
    return None if factor is None else sympy.Rational(str(factor))


def _terms(entry: sympy.Expr) -> list[Term]:
    """Return the coefficients of a sum and what each multiplies."""
    return [Term(*summand.as_coeff_Mul()) for summand in sympy.Add.make_args(entry) if summand != 0]


def _bare_symbols(e: sympy.Expr) -> set[sympy.Symbol]:
    """Return the symbols outside of sines and cosines: named lengths, and coordinates of slides."""
    return set(
        e.replace(lambda part: isinstance(part, sympy.sin | sympy.cos), lambda part: sympy.Integer(1)).free_symbols
    )


def _factor_to_lengths(terms: Sequence[Term], sizes: Sequence[float], lengths: Lengths) -> float | None:
    """Return by what coefficients are multiplied so that each is a length, or a sum or difference of two; else None.

    Small ones must be two lengths at least, and sums of these: 2 cos q2 + 1 may come from angles alone.
    """
    large = max(sizes) >= LEAST
    best: tuple[tuple[int, int], float] | None = None
    for factor in sorted({length / size for length in lengths for size in sizes if length}, reverse=True):
        values = [factor * size for size in sizes]
        found = [_length(value, lengths) for value in values]
        plain = {length for length in found if length is not None}
        if not (large or len(plain) > 1):
            continue
        if not _are_lengths(values, _with_sums(lengths if large else plain)):
            continue
        carried = sum(
            length is not None and term.last_joint in lengths[length] for term, length in zip(terms, found, strict=True)
        )
        rank = (carried, sum(length is not None for length in found))
        if best is None or rank > best[0]:
            best = (rank, factor)
    return None if best is None else best[1]


def _length(value: float, lengths: Iterable[float]) -> float | None:
    """Return the length that a value is, or None."""
    return next((length for length in lengths if abs(value - length) <= SAME * value), None)


def _with_sums(lengths: Iterable[float]) -> list[float]:
    """Return the lengths, and the sums and differences of two."""
    known = sorted(length for length in lengths if length)[-MOST_LENGTHS:]
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
