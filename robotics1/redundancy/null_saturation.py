"""Saturation in the null space: the algorithm on matrices."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.least_squares import generalized_inverse, rank_of
from robotics1.redundancy.within_bounds import within
from robotics1.results import tuple_with_arrays


@tuple_with_arrays
class SaturationStep(NamedTuple):
    """One step of the algorithm.

    Attributes:
        x: (n,) what the joints would do, unscaled.
        saturated: the joints that are held at a limit in it.
        scale: the largest s ≤ 1 with which the free joints stay within their limits.
        critical: the joint that decides this, and is held next; −1 where none is.
    """

    x: Array
    saturated: tuple[int, ...]
    scale: float
    critical: int


@dataclass(frozen=True, eq=False)
class Saturated:
    """x within its limits with A x = s b.

    Attributes:
        x: (n,).
        scale: s; nan where no s does.
        steps: of the algorithm.
    """

    x: Array
    scale: float
    steps: tuple[SaturationStep, ...] = ()


def saturate_step_by_step(A: Array, b: Array, low: Array, high: Array, scale: Array) -> Saturated:
    """Return x with A x = s b and low ≤ x ≤ high, holding one joint after the other at its limit.

    x = x_N + (A W)⁺ (b − A x_N), where W is the identity without the held joints, which have their limits in x_N.
    While a joint is beyond a limit, the most critical one is held. Where the rank of A W falls below that of A, the
    others can no longer realise A x = b: of all steps the one with the largest scale s is taken, with s b in the place
    of b.

    Args:
        A: (m, n).
        b: (m,) in the range of A.
        low, high: (n,) limits, with low ≤ 0 ≤ high.
        scale: (m, n) factors that take the units out of A.

    Source: Flacco, De Luca, Khatib, Motion control of redundant robots under joint constraints: saturation in the null
    space, ICRA 2012, algorithms 1 and 2.
    """
    n, rank = A.shape[1], rank_of(A, scale)
    held = np.zeros(n, dtype=bool)
    x_held: Array = np.zeros(n)
    best: tuple[float, Array, Array] = (0.0, np.zeros(n), np.zeros(n))  # s, and x = (s-part) + (constant part)
    steps: list[SaturationStep] = []
    while True:
        free = np.where(held, 0.0, A)
        inverse = generalized_inverse(free, rank=rank)
        per_scale, constant = inverse.solve(b), x_held - inverse.solve(A @ x_held)
        x = np.asarray(per_scale + constant, dtype=float)
        inside = np.abs(A @ x - b).max(initial=0.0) <= 1e-8 * np.abs(b).max(initial=0.0)
        s, critical = _scale(per_scale, constant, low, high, ~held)
        done = inside and within(x, low, high)
        steps.append(
            SaturationStep(x, tuple(np.flatnonzero(held).tolist()), 1.0 if done else s, -1 if done else critical)
        )
        if done:
            return Saturated(np.clip(x, low, high), 1.0, tuple(steps))
        if inside and s > best[0]:
            best = s, per_scale, constant
        if critical < 0:
            break
        held[critical] = True
        x_held[critical] = high[critical] if x[critical] > high[critical] else low[critical]
        if rank_of(np.where(held, 0.0, A), scale) < rank:
            break
    s, slope, start = best
    return Saturated(np.clip(s * slope + start, low, high), s, tuple(steps))


def _scale(a: Array, c: Array, low: Array, high: Array, free: npt.NDArray[np.bool_]) -> tuple[float, int]:
    """Return the largest s ≤ 1 with low ≤ s a + c ≤ high, 0 where there is none, and the joint that decides it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.sort(np.vstack([(low - c) / a, (high - c) / a]), axis=0)
    still = a == 0
    ends[:, still] = np.where((c >= low) & (c <= high), [[-np.inf], [np.inf]], [[np.inf], [-np.inf]])[:, still]
    ends[:, ~free] = [[-np.inf], [np.inf]]
    beyond = free & ((a + c < low) | (a + c > high))
    if not beyond.any():
        return 1.0, -1
    critical = int(np.argmin(np.where(beyond, ends[1], np.inf)))
    s_max, s_min = float(ends[1].min()), float(ends[0].max())
    return (0.0 if s_min > s_max or s_max < 0 else min(s_max, 1.0)), critical
