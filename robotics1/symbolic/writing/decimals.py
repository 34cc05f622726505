"""By what a sum with whole coefficients is multiplied, so that these are lengths of the arm in metres.

A factor of a determinant is known up to a constant: 8 cos q2 + 7 cos(q2 + q3). The lengths of the file say which
constant makes it 0.8 cos q2 + 0.7 cos(q2 + q3). Where several do, as many coefficients as possible are lengths that
the joints of their terms carry: link 3 turns with q2 + q3.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations
from typing import NamedTuple

import sympy

from robotics1.robot.model import Robot
from robotics1.symbolic.writing.printing import JOINT
from robotics1.tasks.task import Task

LEAST = 100  # of the largest coefficient: a sum of smaller ones is read as it is where they are no lengths
MOST_TERMS = 12  # of a sum whose coefficients are compared with lengths
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


def scale_to_lengths(entries: Iterable[sympy.Expr], lengths: Lengths) -> sympy.Rational | None:
    """Return by what sums are multiplied so that the coefficients are lengths of the arm; else so that the largest is
    one. None where they are small and no lengths.

    Where a slide's coordinate or a named length is in a term, its coefficient becomes 1, if the others are lengths
    then.
    """
    split = [terms_of(entry) for entry in entries]
    terms = [term for sums in split for term in sums]
    if not terms:
        return None
    plain = all(term.coefficient.is_Rational and not term.rest.is_Add for term in terms)
    factor = _scale_to_lengths(terms, lengths) if plain and max(map(len, split)) <= MOST_TERMS else None
    if factor is None:
        largest = max(abs(float(term.coefficient)) for term in terms)
        factor = None if largest < LEAST else sympy.Rational(str(1 / largest))
    return factor


def _scale_to_lengths(terms: Sequence[Term], lengths: Lengths) -> sympy.Rational | None:
    with_bare = [bool(_bare_symbols(term.rest)) for term in terms]
    bare = {abs(term.coefficient) for term, is_bare in zip(terms, with_bare, strict=True) if is_bare}
    others = [term for term, is_bare in zip(terms, with_bare, strict=True) if not is_bare]
    sizes = [float(abs(term.coefficient)) for term in others]
    if bare:
        k = 1 / bare.pop()
        return k if sizes and not bare and _are_lengths([k * x for x in sizes], _with_sums(lengths)) else None
    factor = _factor_to_lengths(others, sizes, lengths)
    return None if factor is None else sympy.Rational(str(factor))


def terms_of(entry: sympy.Expr) -> list[Term]:
    """Return the coefficients of a sum and what each multiplies."""
    summands = [summand for summand in sympy.Add.make_args(entry) if summand != 0]
    return [Term(*summand.as_independent(*summand.free_symbols, as_Add=False)) for summand in summands]


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
