"""The extremes of a distance over the configurations of a chain."""

from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.sampled.chain_map import ChainMap

SAMPLES = 4000  # random configurations; the best of them are starts
SMALL = 1e-14  # a distance at which the gradient is left out


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


def extremes_of(chain: ChainMap, measure: Measure, starts: int, *, largest: bool, seed: int = 0) -> tuple[Array, Array]:
    """Return the values (k,) and configurations (k, n) at which the search ends from k starts."""
    from scipy.optimize import minimize

    rng = np.random.default_rng(seed)
    drawn = chain.drawn(rng, SAMPLES)
    order = np.argsort(measure.value(chain.point(drawn)))
    best = drawn[order[::-1] if largest else order][: starts // 2]
    sign = -1.0 if largest else 1.0
    bounds = [(None, None) if axis.circular else (axis.lower, axis.upper) for axis in chain.axes]

    def cost(q: Array) -> tuple[float, Array]:
        p, J = chain.jacobian(q[None])
        offset = measure.value(p)[0]
        value = offset if measure.direction is not None else offset**2 / 2
        return sign * float(value), sign * (J[0].T @ measure.gradient(p[0]))

    found = []
    for q in np.vstack([best, drawn[: starts - len(best)]]):
        end = minimize(cost, q, jac=True, method="L-BFGS-B", bounds=bounds, options={"ftol": 1e-15, "gtol": 1e-10})
        found.append(end.x)
    ends = np.array(found)
    circular = np.array([axis.circular for axis in chain.axes])
    ends = np.where(circular, chain.lower + (ends - chain.lower) % (2 * np.pi), ends)
    return measure.value(chain.point(ends)), ends
