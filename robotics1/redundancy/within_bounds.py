"""Linear equations within bounds, A x = s b − d and low ≤ x ≤ high: the largest s, the shortest x, level by level."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import generalized_inverse, rank_of

ROUNDING = 1e-10  # of the largest limit or rate: joints above their limit by less are at it
CONSISTENT = 1e-8  # a residual of the equations that is rounding, relative
SHRINKS = (1e-9, 1e-7)  # of a scale at the edge of what is possible, whose rounding may be beyond it
MOST_CUTS = 100  # a few are needed
SOFT = 1e-3  # of the largest singular value: what makes least squares unique, relative
PROXIMAL = 4  # repetitions, each of which makes the error 1e-6 times as large, or less
SOFT_ROUNDING = 1e-8  # as ROUNDING, of the ill-conditioned problem that softness makes


class BoundedLevel(NamedTuple):
    """A x = s b − d, with factors that take the units out of A (m, n)."""

    A: Array
    b: Array
    d: Array
    scale: Array


@dataclass(frozen=True, eq=False)
class Line:
    """The shortest solutions of C x = c + s g for every s: x = start + s slope, and C N = 0.

    Attributes:
        start, slope: (n,).
        null: (n, k) N.
        least, most: the s in [0, 1] for which there is a solution; most < least where there is none.
    """

    start: Array
    slope: Array
    null: Array
    least: float
    most: float


def largest_scale_within(
    C: Array, c: Array, g: Array, low: Array, high: Array, scale: Array
) -> tuple[float, Array | None]:
    """Return the largest s in [0, 1] with C x = c + s g and low ≤ x ≤ high for some x, and the shortest such x.

    From s = 1 down: where no x is within the bounds, the multipliers of the bounds prove it (Farkas), for every s above
    the one at which their proof fails; that s is the next. nan and None where no s is left.
    """
    line = solution_line(C, c, g, scale)
    s = line.most
    if s < line.least:
        return float("nan"), None
    cuts = 0
    while cuts < MOST_CUTS:
        x, bound = nearest_within(line.start + s * line.slope, line.slope, line.null, low, high)
        if x is not None:
            return s, x
        below = s if bound is None else s + bound
        if below < line.least - ROUNDING:
            return float("nan"), None
        below, cuts = max(below, line.least), cuts + 1
        if s - below <= SHRINKS[0] * s:
            break
        s = below
    for less in SHRINKS if s > 0 else ():
        x, _ = nearest_within(line.start + s * (1 - less) * line.slope, line.slope, line.null, low, high)
        if x is not None:
            return s * (1 - less), x
    return float("nan"), None


def solution_line(C: Array, c: Array, g: Array, scale: Array) -> Line:
    """Return the solutions of C x = c + s g for s from 0 to 1; the rank is that of `scale` * C."""
    inverse = generalized_inverse(C, rank=rank_of(C, scale))
    room = CONSISTENT * max(1e-300, float(np.abs(c).max(initial=0.0)), float(np.abs(g).max(initial=0.0)))
    a, b = inverse.left_null.T @ c, inverse.left_null.T @ g  # a + s b = 0 is left
    least, most = 0.0, 1.0
    if np.abs(b).max(initial=0.0) > room:
        least = most = min(max(float(-(a @ b) / (b @ b)), 0.0), 1.0)
        if np.abs(a + b).max() <= room:  # 1, but for rounding
            least = most = 1.0
    if np.abs(a + most * b).max(initial=0.0) > room:
        least, most = 1.0, 0.0
    return Line(inverse.solve(c), inverse.solve(g), inverse.null, least, most)


def nearest_within(
    start: Array, slope: Array, N: Array, low: Array, high: Array, rounding: float = ROUNDING
) -> tuple[Array | None, float | None]:
    """Return x = start + N z of the least |z| with low ≤ x ≤ high; else None, and a step of s that the proof allows.

    It is a least distance problem, min |z| with G z ≥ h, which one non-negative least squares solves: of u ≥ 0 with the
    least |E u − e| for E = [Gᵀ; hᵀ] and e = (0, ..., 0, 1), r = e − E u gives z = −r/r_last. If r = 0, then Gᵀu = 0 and
    uᵀh > 0: there is no z, nor is there with h + t h' until uᵀ(h + t h') = 0.

    Source: Lawson, Hanson, Solving Least Squares Problems, 1974, chapter 23 (LDP).
    """
    from scipy.optimize import nnls

    room = 0.01 * ROUNDING * _size(start, low, high)  # bounds that touch leave a room of rounding only
    h = np.concatenate([low - start, start - high]) - room
    kept = np.isfinite(h)
    if (h[kept] <= 0).all():
        return np.clip(start, low, high), None
    G, h = np.vstack([N, -N])[kept], h[kept]
    norms = np.linalg.norm(G, axis=1)
    norms = np.where(norms > ROUNDING, norms, 1.0)
    G, h = G / norms[:, None], h / norms
    size = float(np.abs(h).max())
    E = np.vstack([G.T, h / size])
    e = np.zeros(len(E))
    e[-1] = 1.0
    try:
        u, left = nnls(E, e, maxiter=100 * E.shape[1])
    except RuntimeError:  # it turned in a circle: neither proven nor solved
        return None, None
    if left <= 1e-9:
        per_s = float(u @ (np.concatenate([-slope, slope])[kept] / norms))
        return None, (-float(u @ (h + room / norms)) / per_s if per_s > 0 else -np.inf)
    residual = E @ u - e
    x = start - size * (N @ (residual[:-1] / residual[-1]))
    return (np.clip(x, low, high), None) if within(x, low, high, rounding) else (None, None)


def least_squares_within(
    A: Array, b: Array, above: Array, right: Array, low: Array, high: Array, scale: Array
) -> Array | None:
    """Return the shortest x with the least |A x − b| of all with C x = c within bounds; C is `above` and c is `right`.
    `scale` takes the units out of [C; A].

    With x = x₀ + N z it is min |A N z − f|. The change of variables that makes it a least distance problem needs full
    rank: a small |z − z_k|² gives it, from a z_k that comes nearer at each repetition (proximal point).

    Source: Lawson, Hanson, Solving Least Squares Problems, 1974, chapter 23 (LSI); Rockafellar, SIAM J. Control and
    Optimization 14, 1976 (proximal points).
    """
    line = solution_line(above, right, np.zeros(len(right)), scale[: len(above)])
    x, N = line.start, line.null
    if not N.shape[1]:
        return x
    F, still = A @ N, np.zeros(len(x))
    soft = SOFT * max(1e-300, float(np.linalg.norm(F, 2)))
    Q, R = np.linalg.qr(np.vstack([F, soft * np.eye(N.shape[1])]))
    turned = N @ np.linalg.inv(R)
    for _ in range(PROXIMAL):
        step = turned @ (Q.T @ np.concatenate([b - A @ x, np.zeros(N.shape[1])]))
        nearer, _ = nearest_within(x + step, still, turned, low, high, SOFT_ROUNDING)
        if nearer is None:
            return None
        x = nearer
    beside = line.start + N @ (N.T @ (x - line.start))  # C x = c again, to rounding
    nearest, _ = nearest_within(beside, still, N, low, high)
    x = x if nearest is None else nearest
    rows, value = np.vstack([above, A]), np.concatenate([right, A @ x])
    _, shortest = largest_scale_within(rows, value, 0 * value, low, high, scale)
    return x if shortest is None else shortest


def levels_within(
    levels: Sequence[BoundedLevel], low: Array, high: Array, *, least_squares: bool = False
) -> tuple[Array, tuple[float, ...]]:
    """Return the shortest x within its bounds with Aᵢ x = sᵢ bᵢ − dᵢ, level by level the largest sᵢ, and the sᵢ.

    Of bᵢ and dᵢ the parts in the range of Aᵢ count. A level that no scale from 0 to 1 realises has nan, and is left
    out; with `least_squares` it is brought as near as the levels before it allow, the least |Aᵢ x + dᵢ − bᵢ|.
    """
    C: Array = np.zeros((0, len(low)))
    c: Array = np.zeros(0)
    units = C
    x: Array = np.clip(np.zeros(len(low)), low, high)
    scales: list[float] = []
    for A, b, d, scale in levels:
        beyond = generalized_inverse(A, rank=rank_of(A, scale)).left_null
        rate, drift = b - beyond @ (beyond.T @ b), d - beyond @ (beyond.T @ d)
        rows, both = np.vstack([C, A]), np.vstack([units, scale])
        right = np.concatenate([c, -drift])
        s, found = largest_scale_within(rows, right, np.concatenate([0 * c, rate]), low, high, both)
        now = s * rate - drift
        if found is None and least_squares:
            near = least_squares_within(A, rate - drift, C, c, low, high, both)
            if near is not None:
                found, now = near, A @ near
        if found is not None:
            C, c, units, x = rows, np.concatenate([c, now]), both, found
        scales.append(s)
    return x, tuple(scales)


def within(x: Array, low: Array, high: Array, rounding: float = ROUNDING) -> bool:
    """Whether x is within its limits, but for rounding."""
    room = rounding * _size(x, low, high)
    return bool((x >= low - room).all() and (x <= high + room).all())


def _size(x: Array, low: Array, high: Array) -> float:
    """Return the largest finite limit or entry of x; rounding is a part of it."""
    limits = np.abs(np.concatenate([low, high]))
    size = float(limits[np.isfinite(limits)].max(initial=0.0)) or 1.0
    return max(size, float(np.abs(x).max(initial=0.0)))
