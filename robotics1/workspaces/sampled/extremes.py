"""The extremes of a distance over the configurations of a chain."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array

SAMPLES = 4000  # random configurations; the best of them are starts


class Chain(Protocol):
    """Coordinates that move a point: `ChainMap`, `DrivenChain`."""

    @property
    def lower(self) -> Array:
        """The lower limits (n,)."""

    @property
    def upper(self) -> Array:
        """The upper limits (n,)."""

    @property
    def circular(self) -> npt.NDArray[np.bool_]:
        """Where both are the same place (n,)."""

    def point(self, q: Array) -> Array:
        """Return the point (k, 3) at q (k, n)."""

    def jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return the point (k, 3) and its Jacobian (k, 3, n)."""

    def drawn(self, rng: np.random.Generator, count: int) -> Array:
        """Return configurations (count, n)."""


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


def extremes_of(chain: Chain, measure: Measure, starts: int, *, largest: bool, seed: int = 0) -> tuple[Array, Array]:
    """Return the values (k,) and configurations (k, n) at which the search ends from k starts."""
    rng = np.random.default_rng(seed)
    drawn = chain.drawn(rng, SAMPLES)
    order = np.argsort(measure.value(chain.point(drawn)))
    best = drawn[order[::-1] if largest else order][: starts // 2]
    return ends_of(chain, measure, np.vstack([best, drawn[: starts - len(best)]]), largest=largest)


def ends_of(chain: Chain, measure: Measure, starts: Array, *, largest: bool) -> tuple[Array, Array]:
    """Return the values (k,) and configurations (k, n) to which L-BFGS-B climbs, or descends, from starts (k, n)."""
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
    ends = np.array([minimize(cost, q, jac=True, method="L-BFGS-B", bounds=bounds, options=options).x for q in starts])
    ends = np.where(circular, lower + (ends - lower) % np.where(circular, upper - lower, 1.0), ends)
    return measure.value(chain.point(ends)), ends
