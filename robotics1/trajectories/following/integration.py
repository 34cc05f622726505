"""A differential equation along a trajectory, integrated from one of its switching times to the next."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from robotics1.angles import angles_of_an_iteration
from robotics1.curves.named_derivatives import Side
from robotics1.inputs import Array
from robotics1.robot.model import Robot

Rate = Callable[[float, Array, Side], Array]


RUNAWAY = 1e4  # rad, or reaches, in the duration: joints that move so fast have met a singularity


@dataclass(frozen=True, eq=False)
class Solution:
    """x(t) from the first switching time on, as far as it goes.

    Attributes:
        start: (n,) x at the first of the times.
        segments: from one switching time to the next t → x, each a `scipy.integrate.OdeSolution`.
    """

    start: Array
    segments: tuple[Any, ...]

    @property
    def end(self) -> float:
        """Where it ends; 0 where there is no segment."""
        return float(self.segments[-1].t_max) if self.segments else 0.0

    def __call__(self, t: float) -> Array:
        """Return x(t), (n,); at a switching time that of the segment before it."""
        return np.asarray(next((state(t) for state in self.segments if t <= state.t_max), self.start))

    def sampled(self, times: Array) -> tuple[Array, Array]:
        """Return the times (k,) that are not after the end, and x (k, n) there."""
        times = times[times <= self.end]
        return times, np.array([self(float(t)) for t in times])


def runaway(robot: Robot, duration: float) -> Array:
    """Return the rates (nv,) of joints that run away, as near a singularity."""
    return np.asarray(RUNAWAY * robot.units / duration)


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
    fastest: npt.ArrayLike = np.inf,
    most_steps: float = np.inf,
) -> Solution:
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
        fastest: (k,) "DOP853" ends where |dx/dt| of the first k components is beyond it.
        most_steps: in a segment.
    """
    import scipy.integrate

    start, segments = state, []
    fastest = np.atleast_1d(fastest)
    for a, b in pairwise(ends):

        def inside(t: float, x: Array, a: float = a, b: float = b) -> Array:
            t = min(max(t, a), b)
            return rate(t, x, "right" if t < b else "left")

        step = {} if first_step is None else {"first_step": first_step * (b - a)}
        solver = getattr(scipy.integrate, method)(inside, a, state, b, rtol=rtol, atol=atol, max_step=max_step, **step)
        times: list[float] = [a]
        pieces: list[Any] = []
        while solver.status == "running" and len(pieces) < most_steps:
            if method == "DOP853" and (np.abs(solver.f[: len(fastest)]) > fastest).any():
                break
            solver.step()
            if solver.status == "failed":
                break
            times.append(float(solver.t))
            pieces.append(solver.dense_output())
        if pieces:
            segments.append(scipy.integrate.OdeSolution(times, pieces))
        state = np.asarray(solver.y)
        if times[-1] < b:
            break
    return Solution(start, tuple(segments))
