"""A distance of the point that a chain moves: where it is extreme, and the coordinates that it depends on."""

from dataclasses import dataclass
from math import inf
from time import monotonic

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.axes import ALIKE, Axis, distance_to
from robotics1.workspaces.chain import Chain

SAMPLES = 4000  # random configurations; the best of them are starts


@dataclass(frozen=True, eq=False)
class Measure:
    """|P (p − c)|, or n · (p − c).

    Attributes:
        P: (3, 3) a projection.
        centre: (3,) c.
        direction: (3,) n, or None.
    """

    P: Array
    centre: Array
    direction: Array | None = None

    def value(self, p: Array) -> Array:
        """Return the values (k,) at points (k, 3)."""
        offset = p - self.centre
        return offset @ self.direction if self.direction is not None else np.linalg.norm(offset @ self.P, axis=1)

    def gradient(self, p: Array) -> Array:
        """Return the gradient of what is optimized, n or half the square's: (3,) at a point (3,)."""
        return self.direction if self.direction is not None else self.P @ (p - self.centre)


def extremes_of(
    chain: Chain, measure: Measure, starts: int, *, largest: bool, seed: int = 0, end: float = inf
) -> tuple[Array, Array]:
    """Return the values (k,) and configurations (k, n) at which the search ends from k starts; see `ends_of`."""
    return ends_of(
        chain, measure, starts_of(chain, measure, starts, largest=largest, seed=seed), largest=largest, end=end
    )


def starts_of(chain: Chain, measure: Measure, count: int, *, largest: bool, seed: int = 0) -> Array:
    """Return starts (count, n) of a search: the best of many random configurations, the very best first, and others."""
    drawn = chain.drawn(np.random.default_rng(seed), SAMPLES)
    order = np.argsort(measure.value(chain.point(drawn)))
    best = drawn[order[::-1] if largest else order][: count // 2]
    return np.vstack([best, drawn[: count - len(best)]])


def ends_of(chain: Chain, measure: Measure, starts: Array, *, largest: bool, end: float = inf) -> tuple[Array, Array]:
    """Return the values (k,) and configurations (k, n) to which L-BFGS-B climbs, or descends, from starts (k, n).

    After `end` of the monotonic clock no more starts are followed than the first.
    """
    from scipy.optimize import minimize

    sign = -1.0 if largest else 1.0
    lower, upper, circular = chain.lower, chain.upper, chain.circular
    bounds = list(zip(np.where(circular, -np.inf, lower), np.where(circular, np.inf, upper), strict=True))

    def cost(q: Array) -> tuple[float, Array]:
        p, J = chain.jacobian(q[None])
        offset = measure.value(p)[0]
        value = offset if measure.direction is not None else offset**2 / 2
        return sign * float(value), sign * (J[0].T @ measure.gradient(p[0]))

    options = {"ftol": 1e-15, "gtol": 1e-10}
    found: list[Array] = []
    for q in starts:
        if found and monotonic() > end:
            break
        found.append(minimize(cost, q, jac=True, method="L-BFGS-B", bounds=bounds, options=options).x)
    ends = np.array(found)
    ends = np.where(circular, lower + (ends - lower) % np.where(circular, upper - lower, 1.0), ends)
    return measure.value(chain.point(ends)), ends


def free_coordinates(chain: Chain, measure: Measure) -> npt.NDArray[np.bool_]:
    """Return the coordinates (n,) on which a measure of the point depends.

    The first joint does not change a distance from a point of its axis, nor a coordinate along its axis; and so the
    next ones, until one does. A joint that mimics another one, or is mimicked on the way, is not left out.
    """
    free = np.ones(len(chain.lower), dtype=bool)
    size = float(np.abs(chain.joint_columns(np.zeros((1, len(chain.A))))[1]).max()) + 1e-300
    for row, axis in zip(chain.A, chain.axes, strict=True):
        own = np.flatnonzero(row)
        alone = np.count_nonzero(chain.A[:, own[0]]) == 1
        if not (alone and _changes_nothing(axis, measure, size)):
            break
        free[own[0]] = False
    return free


def _changes_nothing(axis: Axis, measure: Measure, size: float) -> bool:
    n, a = measure.direction, axis.direction
    if n is not None:
        return bool(np.linalg.norm(np.cross(a, n)) < ALIKE if axis.revolute else abs(a @ n) < ALIKE)
    across = bool(np.linalg.norm(measure.P @ a) < ALIKE)
    if not axis.revolute:
        return across
    whole = np.allclose(measure.P, np.eye(3), rtol=0, atol=ALIKE)
    return (across or whole) and distance_to(axis, measure.centre) < ALIKE * size
