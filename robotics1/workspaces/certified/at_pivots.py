"""A bound by the triangle inequality at a point o of an axis: |p − c| ≤ max |o − c| + max |p − o|.

The joint itself, and those after it whose axes go through o too, do not change |p − o|; so fewer joints count in each
of the two. Where the arm can be stretched through o, the bound is attained: so it is at a spherical shoulder or wrist.
Along a direction it is n · (p − c) ≤ max n · (o − c) + max |p − o|, and a smallest distance is at least the difference.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import takewhile
from time import monotonic
from typing import NamedTuple

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.axes import ALIKE, nearest_on, without_joints_at
from robotics1.workspaces.certified.extremes import Measure, ends_of, starts_of
from robotics1.workspaces.certified.objective import Objective
from robotics1.workspaces.chain import Chain

STARTS = 8
TRIED = 3  # pivots whose bound is proven

Bound = Callable[[Objective, float, Array], float]  # of an objective, with a good value and its configuration


class _Part(NamedTuple):
    """An objective over some of the joints, its best value found, and where; of no joints, its value alone.

    From the starts a climb finds better values.
    """

    objective: Objective | None
    value: float
    q: Array
    starts: Array

    def climbed(self) -> "_Part":
        """Return the part with the best value that climbs find."""
        if self.objective is None:
            return self
        largest = self.objective.sign > 0
        values, q = ends_of(self.objective.chain, self.objective.measure, self.starts, largest=largest)
        best = int(np.argmax(values) if largest else np.argmin(values))
        return self._replace(value=float(values[best]), q=q[best])

    def bound(self, prove: Bound) -> float:
        """Return what is proven of it."""
        return self.value if self.objective is None else prove(self.objective, self.value, self.q)


@dataclass(frozen=True)
class Pivot:
    """Two parts of an arm, before and after a point of an axis, whose extremes make a bound.

    Attributes:
        parts: what is before, and what is after.
        signs: how they are added: (1, 1), or with a minus for what is taken off.
    """

    parts: tuple[_Part, _Part]
    signs: tuple[float, float]

    @property
    def hoped(self) -> float:
        """What the bound is if the values found are the extremes."""
        return sum(sign * part.value for sign, part in zip(self.signs, self.parts, strict=True))

    def climbed(self) -> "Pivot":
        """Return the pivot with the extremes that climbs find."""
        return replace(self, parts=(self.parts[0].climbed(), self.parts[1].climbed()))

    def bound(self, prove: Bound) -> float:
        """Return the bound."""
        return sum(sign * part.bound(prove) for sign, part in zip(self.signs, self.parts, strict=True))


def best_pivots(objective: Objective, enough: float, end: float) -> list[Pivot]:
    """Return some pivots, the one with the best bound first, of those found before `end` of the monotonic clock.

    What the parts of a pivot have at random configurations is no more than their extremes: with these the pivot cannot
    be better. So those that promise most are climbed first, until the others cannot be better, or all kept are good
    enough: what one promises may be hard to prove, and easy of another.

    Args:
        objective: what is bounded.
        enough: the bound that is good enough [m].
        end: when the search ends.
    """

    def order(pivot: Pivot) -> float:
        return objective.sign * pivot.hoped

    in_time = takewhile(lambda _: monotonic() < end, _points(objective))
    promising = sorted((pivot for k, o in in_time for pivot in _pivots_at(objective, k, o)), key=order)
    found: list[Pivot] = []
    for pivot in promising:
        worst = order(found[-1]) if len(found) == TRIED else np.inf
        if monotonic() > end or worst <= max(order(pivot), objective.sign * enough):
            break
        found = sorted([*found, pivot.climbed()], key=order)[:TRIED]
    return found


def _points(objective: Objective) -> Iterator[tuple[int, Array]]:
    """Yield joints that turn, by number, and points of their axes that are next to other axes, to c or to the tip."""
    chain = objective.chain
    near = _rounding(chain)
    for k, axis in enumerate(chain.axes):
        if not axis.revolute:
            continue
        beside = [other for other in chain.axes[max(k - 1, 0) : k + 2] if other is not axis and other.revolute]
        points = [nearest_on(axis, other) for other in beside]
        points += [
            axis.point + axis.direction * (axis.direction @ (p - axis.point))
            for p in (objective.measure.centre, chain.tip)
        ]
        kept: list[Array] = []
        for o in points:
            if all(np.linalg.norm(o - other) > near for other in kept):
                kept.append(o)
                yield k, o


def _rounding(chain: Chain) -> float:
    """Return a distance that is none, by the arm's size."""
    return ALIKE * max(float(np.linalg.norm(axis.point - chain.tip)) for axis in chain.axes)


def _pivots_at(objective: Objective, k: int, o: Array) -> Iterator[Pivot]:
    """Yield the bounds that a point of the axis of joint k gives."""
    measure, largest = objective.measure, objective.sign > 0
    before = _some_joints(objective.chain, slice(0, k), o)
    after = _some_joints(objective.chain, slice(k + 1, None), objective.chain.tip)
    length = Measure(np.eye(3), o)
    if largest or measure.direction is not None:
        yield Pivot((_part(before, measure, objective.sign), _part(after, length, 1.0)), (1.0, objective.sign))
        return
    yield Pivot((_part(before, measure, -1.0), _part(after, length, 1.0)), (1.0, -1.0))
    if np.allclose(measure.P, np.eye(3), rtol=0, atol=ALIKE):
        yield Pivot((_part(before, measure, 1.0), _part(after, length, -1.0)), (-1.0, 1.0))


def _some_joints(chain: Chain, some: slice, tip: Array) -> Chain:
    """Return some of the joints, as if no others drove their coordinates; without the last ones that turn about o."""
    axes = without_joints_at(tip, chain.axes[some], _rounding(chain))
    A = chain.A[some][: len(axes)]
    kept = np.flatnonzero(A.any(axis=0))
    return replace(
        chain,
        axes=tuple(axes),
        tip=tip,
        A=A[:, kept],
        numbers=chain.numbers[kept],
        lower=chain.lower[kept],
        upper=chain.upper[kept],
        circular=chain.circular[kept],
    )


def _part(chain: Chain, measure: Measure, sign: float) -> _Part:
    if not chain.axes:
        return _Part(None, float(measure.value(chain.tip[None])[0]), np.zeros(0), np.zeros((0, 0)))
    starts = starts_of(chain, measure, STARTS, largest=sign > 0)
    value = float(measure.value(chain.point(starts[:1]))[0])
    return _Part(Objective(chain, measure, sign), value, starts[0], starts)
