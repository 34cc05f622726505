"""A differential equation along a trajectory, integrated from one of its switching times to the next."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np

from robotics1.angles import angles_of_an_iteration
from robotics1.curves.named_derivatives import Side
from robotics1.inputs import Array

Rate = Callable[[float, Array, Side], Array]


@dataclass(frozen=True, eq=False)
class Segment:
    """The solution from one switching time to the next.

    Attributes:
        start, end: [s].
        state: t → the state, (n,), or (n, k) for (k,) times.
    """

    start: float
    end: float
    state: Any


@angles_of_an_iteration()
def integrated(
    rate: Rate,
    ends: Sequence[float],
    state: Array,
    *,
    method: Literal["DOP853", "LSODA"],
    rtol: float,
    atol: Array,
    first_step: float | None = None,
    max_step: float = np.inf,
    stop: Callable[[Array], bool] | None = None,
    most_steps: float = np.inf,
) -> tuple[Segment, ...]:
    """Return the solution of dx/dt = rate(t, x, side) from x = state at ends[0]; less than asked where it cannot go on.

    At an end, where the rate jumps, the side is that inside the segment.

    Args:
        rate: (t, x, side) → dx/dt.
        ends: the times between which the rate is smooth [s].
        state: (n,) x at the first of them.
        method: "DOP853", of eighth order, or "LSODA", for equations that may be stiff.
        rtol, atol: precision, relative and of each component.
        first_step: the part of a segment that is tried first.
        max_step: the longest step [s].
        stop: whether "DOP853" ends where dx/dt has this value.
        most_steps: in a segment.
    """
    import scipy.integrate

    segments: list[Segment] = []
    for a, b in pairwise(ends):

        def inside(t: float, x: Array, a: float = a, b: float = b) -> Array:
            t = min(max(t, a), b)
            return rate(t, x, "right" if t < b else "left")

        step = {} if first_step is None else {"first_step": first_step * (b - a)}
        solver = getattr(scipy.integrate, method)(inside, a, state, b, rtol=rtol, atol=atol, max_step=max_step, **step)
        times: list[float] = [a]
        pieces: list[Any] = []
        while solver.status == "running" and len(pieces) < most_steps:
            solver.step()
            if solver.status == "failed":
                break
            times.append(float(solver.t))
            pieces.append(solver.dense_output())
            if stop is not None and stop(solver.f):
                break
        if pieces:
            segments.append(Segment(a, times[-1], scipy.integrate.OdeSolution(times, pieces)))
        state = np.asarray(solver.y)
        if times[-1] < b:
            break
    return tuple(segments)
