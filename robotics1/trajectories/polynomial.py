"""Joint trajectories that are polynomials of normalised time."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import polynomial

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, per_joint, real_array, real_number


@dataclass(frozen=True, eq=False)
class PolynomialTrajectory:
    """q(t) = Σₖ cₖ τᵏ with τ = t/T ∈ [0, 1].

    Attributes:
        coefficients: (degree + 1, n) the cₖ, ascending [rad or m].
        duration: T [s].
    """

    coefficients: Array
    duration: float

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return q at the time t [s], 0 ≤ t ≤ T: (n,) for a number, (k, n) for (k,) times.

        Raises:
            InputError: a time is outside the trajectory.
        """
        times = real_array("t", t, (None,) * dimensions("t", t), "seconds")
        if times.size and (times.min() < -1e-9 * self.duration or times.max() > (1 + 1e-9) * self.duration):
            raise InputError(f"t must be in [0, {self.duration:g}] s; it is {times.tolist()}")
        return np.moveaxis(polynomial.polyval(times / self.duration, self.coefficients), 0, -1)

    def velocity(self, t: npt.ArrayLike) -> Array:
        """Return q̇(t) [rad/s or m/s], in the shape of q(t)."""
        return self.rate(t)

    def acceleration(self, t: npt.ArrayLike) -> Array:
        """Return q̈(t) [rad/s² or m/s²], in the shape of q(t)."""
        return self.rate.rate(t)

    @cached_property
    def rate(self) -> "PolynomialTrajectory":
        """q̇ as a polynomial of τ: its coefficients are (k + 1) cₖ₊₁ / T."""
        return PolynomialTrajectory(polynomial.polyder(self.coefficients) / self.duration, self.duration)

    @property
    def coefficients_t(self) -> Array:
        """(degree + 1, n) the coefficients cₖ / Tᵏ of powers of t instead of τ."""
        powers = np.arange(len(self.coefficients))
        return np.asarray(self.coefficients / self.duration ** powers[:, None])

    def extremes(self) -> tuple[Array, Array]:
        """Return the times (2, n) [s] and values (2, n) of each joint's minimum and maximum.

        Exact: they are at the ends or where the derivative vanishes.
        """
        times = np.empty((2, self.coefficients.shape[1]))
        values = np.empty_like(times)
        for i, c in enumerate(self.coefficients.T):
            roots = polynomial.polyroots(polynomial.polyder(c)) if len(c) > 2 else np.empty(0)
            inside = [float(z.real) for z in np.atleast_1d(roots) if abs(z.imag) < 1e-9 and 0 < z.real < 1]
            tau = np.array([0.0, 1.0, *inside])
            x = polynomial.polyval(tau, c)
            for row, k in enumerate((x.argmin(), x.argmax())):
                times[row, i], values[row, i] = tau[k] * self.duration, x[k]
        return times, values


def cubic(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
) -> PolynomialTrajectory:
    """Return the cubic from (q0, v0) to (q1, v1) in the duration T: with Δ = q1 − q0,

    q(τ) = q0 + v0 T τ + (3Δ − (2 v0 + v1) T) τ² + (−2Δ + (v0 + v1) T) τ³.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.1.
    """
    q0 = _numbers("q0", q0, None)
    q1 = _numbers("q1", q1, len(q0))
    T = real_number("duration", duration, positive=True)
    v0, v1 = per_joint("v0", v0, len(q0)), per_joint("v1", v1, len(q0))
    delta = q1 - q0
    return PolynomialTrajectory(np.array([q0, v0 * T, 3 * delta - (2 * v0 + v1) * T, -2 * delta + (v0 + v1) * T]), T)


def _numbers(name: str, value: npt.ArrayLike, n: int | None) -> Array:
    """Return one number for each joint, (n,); a single number is one joint's."""
    listed: Any = [value] if dimensions(name, value) == 0 else value
    return real_array(name, listed, (n,), "one number for each joint")
