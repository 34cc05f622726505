"""A curve of solutions, and the part of it that is inside the joint limits."""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array

PARTS, HALVINGS = 8, 40  # of a step in which a joint may come within its limits and leave them, or cross one
Inside = Callable[[Array], Array | None]
Sample = tuple[Array, Array]  # q (nq,) and the tangent there


class FamilyCurve(NamedTuple):
    """Solutions along a curve.

    Attributes:
        q, tangents: (k, nq) those inside the limits, and the unit tangents there.
        line: (l, nq) all of the curve, with no regard to limits.
        closed: whether the line comes home.
        regularity: the least σ, beside σ₁, of the directions across it.
    """

    q: Array
    tangents: Array
    line: Array
    closed: bool
    regularity: float


def samples_inside(samples: Sequence[Sample], problem: ScaledTask, within: Inside, solution: Inside) -> list[Sample]:
    """Return the samples of a curve inside the limits, and those where it leaves them or comes within.

    Args:
        samples: one after the other.
        problem: the task in its box.
        within: a configuration → the same turned into the limits; None if it is outside.
        solution: a configuration → the solution next to it, turned into the limits; None if there is none.
    """
    found: list[Sample] = []
    for (p, tangent), (after, next_tangent) in zip(samples, [*samples[1:], samples[-1]], strict=True):
        way = problem.shortest_difference(after, p) * problem.box.unit
        here, ends_inside = within(p), within(after) is not None
        found += [] if here is None else [(here, tangent)]
        if after is not p and not (here is not None and ends_inside):
            crossed = _crossings_of_limits(p, way, (here is not None, ends_inside), solution)
            found += [(q, tangent if t < 0.5 else next_tangent) for t, q in crossed]
    return found


def _crossings_of_limits(p: Array, way: Array, ends: tuple[bool, bool], solution: Inside) -> list[tuple[float, Array]]:
    """Return where a step crosses the limits: shares of the step, and the last solutions inside.

    Args:
        p: where the step begins.
        way: to its end.
        ends: whether both are inside.
        solution: as above.
    """
    shares = np.linspace(0, 1, PARTS + 1)
    inside = [ends[0], *(solution(p + t * way) is not None for t in shares[1:-1]), ends[1]]
    found = []
    for k in range(PARTS):
        if inside[k] == inside[k + 1]:
            continue
        low, high = (shares[k], shares[k + 1]) if inside[k] else (shares[k + 1], shares[k])
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if solution(p + middle * way) is not None else (low, middle)
        last = solution(p + low * way)
        found += [] if last is None else [(float(low), last)]
    return found
