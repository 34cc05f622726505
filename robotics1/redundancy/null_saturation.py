"""Saturation in the null space: the algorithm on matrices, and the exact answer that it seeks."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE, numeric_rank
from robotics1.results import tuple_with_arrays

SHRINK = 1e-9  # of a scale that the linear program has found: its rounding
ROUNDING = 1e-10  # of the largest limit or rate: joints above their limit by less are at it


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


def saturate_step_by_step(A: Array, b: Array, low: Array, high: Array) -> Saturated:
    """Return x with A x = s b and low ≤ x ≤ high, holding one joint after the other at its limit.

    x = x_N + (A W)⁺ (b − A x_N), where W is the identity without the held joints, which have their limits in x_N.
    While a joint is beyond a limit, the most critical one is held. Where the rank of A W falls below that of A, the
    others can no longer realise A x = b: of all steps the one with the largest scale s is taken, with s b in the place
    of b.

    Args:
        A: (m, n).
        b: (m,) in the range of A.
        low, high: (n,) limits, with low ≤ 0 ≤ high.

    Source: Flacco, De Luca, Khatib, Motion control of redundant robots under joint constraints: saturation in the null
    space, ICRA 2012, algorithms 1 and 2.
    """
    n, rank = A.shape[1], numeric_rank(np.linalg.svd(A, compute_uv=False))
    held = np.zeros(n, dtype=bool)
    x_held: Array = np.zeros(n)
    best: tuple[float, Array, Array] = (0.0, np.zeros(n), np.zeros(n))  # s, and x = (s-part) + (constant part)
    steps: list[SaturationStep] = []
    while True:
        free = np.where(held, 0.0, A)
        inverse = np.linalg.pinv(free, rcond=RANK_TOLERANCE)
        per_scale, constant = inverse @ b, x_held - inverse @ (A @ x_held)
        x = np.asarray(per_scale + constant, dtype=float)
        inside = np.abs(A @ x - b).max(initial=0.0) <= 1e-8 * np.abs(b).max(initial=0.0)
        scale, critical = _scale(per_scale, constant, low, high, ~held)
        done = inside and _within(x, low, high)
        steps.append(
            SaturationStep(x, tuple(np.flatnonzero(held).tolist()), 1.0 if done else scale, -1 if done else critical)
        )
        if done:
            return Saturated(np.clip(x, low, high), 1.0, tuple(steps))
        if inside and scale > best[0]:
            best = scale, per_scale, constant
        if critical < 0:
            break
        held[critical] = True
        x_held[critical] = high[critical] if x[critical] > high[critical] else low[critical]
        if numeric_rank(np.linalg.svd(np.where(held, 0.0, A), compute_uv=False)) < rank:
            break
    s, slope, start = best
    return Saturated(np.clip(s * slope + start, low, high), s, tuple(steps))


def _within(x: Array, low: Array, high: Array) -> bool:
    room = ROUNDING * max(_size(low, high), float(np.abs(x).max(initial=0.0)))
    return bool((x >= low - room).all() and (x <= high + room).all())


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


def largest_scale(A: Array, b: Array, low: Array, high: Array, above: tuple[Array, Array] | None = None) -> float:
    """Return the largest s in [0, 1] for which some x has A x = s b and low ≤ x ≤ high; nan if none has.

    It is a linear program. `above` is (A₀, b₀) with A₀ x = b₀ besides.
    """
    from scipy.optimize import linprog

    size = _size(low, high)  # the solver's tolerances are absolute
    low, high, b = low / size, high / size, b / size
    above = None if above is None else (above[0], above[1] / size)
    rows: Array = np.column_stack([A, -b])
    right: Array = np.zeros(len(b))
    if above is not None:
        rows = np.vstack([np.column_stack([above[0], np.zeros(len(above[0]))]), rows])
        right = np.concatenate([above[1], right])
    rows, right = _independent(rows, right)
    cost = np.append(np.zeros(A.shape[1]), -1.0)
    bounds = [*zip(_open(low), _open(high), strict=True), (0.0, 1.0)]
    found = linprog(cost, A_eq=rows, b_eq=right, bounds=bounds, method="highs-ds")
    return max(0.0, float(found.x[-1])) if found.status == 0 else float("nan")


def shortest_within(A: Array, b: Array, low: Array, high: Array) -> Array | None:
    """Return the shortest x with A x = b and low ≤ x ≤ high; None where there is none.

    With x = A⁺b + N z it is a least distance problem, min |z| with G z ≥ h, which one non-negative least squares
    solves: of u ≥ 0 with the least |E u − e| for E = [Gᵀ; hᵀ] and e = (0, ..., 0, 1), r = e − E u gives z = −r/r_last.

    Source: Lawson, Hanson, Solving Least Squares Problems, 1974, chapter 23 (LDP).
    """
    from scipy.optimize import nnls

    U, sigma, Vt = np.linalg.svd(A)
    r = numeric_rank(sigma)
    start, N = Vt[:r].T @ (U[:, :r].T @ b / sigma[:r]), Vt[r:].T
    G, h = np.vstack([N, -N]), np.concatenate([low - start, start - high])
    kept = np.isfinite(h)
    G, h = G[kept], h[kept]
    if (h <= 0).all():
        return np.asarray(np.clip(start, low, high))
    size = float(np.abs(h).max())
    E = np.vstack([G.T, h / size])
    e = np.append(np.zeros(N.shape[1]), 1.0)
    u, left = nnls(E, e)
    if left <= 1e-9:
        return None
    residual = E @ u - e
    z = -size * residual[:-1] / residual[-1]
    x = start + N @ z
    return np.asarray(np.clip(x, low, high)) if _within(x, low, high) else None


def _independent(A: Array, b: Array) -> tuple[Array, Array]:
    """Return as many combinations of the equations A x = b as are independent: they have the same solutions."""
    _, sigma, Vt = np.linalg.svd(np.column_stack([A, b]), full_matrices=False)
    r = numeric_rank(sigma)
    return Vt[:r, :-1], Vt[:r, -1]


def _size(low: Array, high: Array) -> float:
    """Return the largest finite limit; 1 if there is none but zero."""
    limits = np.abs(np.concatenate([low, high]))
    return float(limits[np.isfinite(limits)].max(initial=0.0)) or 1.0


def _open(limits: Array) -> list[float | None]:
    return [float(x) if np.isfinite(x) else None for x in limits]


def saturated_levels(levels: Sequence[tuple[Array, Array]], low: Array, high: Array) -> tuple[Array, tuple[float, ...]]:
    """Return the shortest x within its limits with Aᵢ x = sᵢ bᵢ, level by level the largest sᵢ, and the sᵢ.

    Of bᵢ the part in the range of Aᵢ counts. A level that no scale from 0 to 1 realises has nan, and is left out.
    """
    n = len(low)
    A: Array = np.zeros((0, n))
    b: Array = np.zeros(0)
    x: Array = np.zeros(n)
    scales: list[float] = []
    for J, asked in levels:
        U, sigma, _ = np.linalg.svd(J, full_matrices=False)
        U = U[:, : numeric_rank(sigma)]
        rate = U @ (U.T @ asked)
        s, found = _scaled_level(J, rate, low, high, (A, b))
        if found is not None:
            A, b, x = np.vstack([A, J]), np.concatenate([b, s * rate]), found
        scales.append(s)
    return x, tuple(scales)


def _scaled_level(
    J: Array, rate: Array, low: Array, high: Array, above: tuple[Array, Array]
) -> tuple[float, Array | None]:
    """Return the largest s, and the shortest x with J x = s ṙ and A x = b of the levels above; nan and None if none."""
    rows = np.vstack([above[0], J])

    def shortest(s: float) -> Array | None:
        right = np.concatenate([above[1], s * rate])
        found = shortest_within(rows, right, low, high)
        room = 1e-8 * max(1.0, float(np.abs(right).max(initial=0.0)))
        met = found is not None and np.abs(rows @ found - right).max(initial=0.0) <= room
        return found if met else None

    found = shortest(1.0)
    if found is not None:
        return 1.0, found
    s = largest_scale(J, rate, low, high, above)
    for less in () if np.isnan(s) else (0.0, SHRINK, 1e-7):
        found = shortest(s * (1 - less))
        if found is not None:
            return s * (1 - less), found
    return float("nan"), None
