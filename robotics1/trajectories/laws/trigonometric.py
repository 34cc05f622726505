"""Timing laws of one sine: cosine and cycloidal."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import polynomial

from robotics1.inputs import Array, counting_number, one_of, real_number
from robotics1.trajectories.composition.joint_laws import JointLaws
from robotics1.trajectories.instants import times_inside
from robotics1.trajectories.peaks.extremes import LawWithExtremes
from robotics1.trajectories.protocols import Side
from robotics1.trajectories.quantities import joint_numbers, moderate, positive_duration

WAVES = (np.cos, lambda x: -np.sin(x), lambda x: -np.cos(x), np.sin)  # cosine and its derivatives, in turn
SHAPES = {  # of f: the straight part, which of the waves, ω, amplitude
    "cosine": ([0.5], 2, np.pi, 0.5),
    "cycloidal": ([0.0, 1.0], 1, 2 * np.pi, 0.5 / np.pi),
}
QUARTERS = np.array([0, 0.25, 0.5, 0.75, 1])  # where the derivatives of both laws have their extremes


@dataclass(frozen=True)
class TrigonometricLaw(LawWithExtremes):
    """s(t) = s0 + Δ f(τ) with τ = t/T: f = (1 − cos πτ)/2, "cosine", or f = τ − sin(2πτ)/2π, "cycloidal".

    Attributes:
        start: s0.
        end: s1 = s0 + Δ.
        duration: T [s].
        kind: "cosine" or "cycloidal".
    """

    start: float
    end: float
    duration: float
    kind: str

    def __post_init__(self) -> None:
        """Refuse a duration that is not positive."""
        for name in ("start", "end"):
            object.__setattr__(self, name, float(moderate(name, np.array(real_number(name, getattr(self, name))))))
        object.__setattr__(self, "duration", positive_duration("duration", self.duration))
        one_of("kind", self.kind, tuple(SHAPES))

    @property
    def switching_times(self) -> Array:
        """There are none: it is smooth."""
        return np.empty(0)

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return s(t): a number for a number, (k,) for (k,) times.

        Raises:
            InputError: a time is outside the law.
        """
        return self._value(t, 0)

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return ṡ(t)."""
        return self._value(t, 1, side)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return s̈(t)."""
        return self._value(t, 2, side)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return d³s/dt³."""
        return self._value(t, 3, side)

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the times (2,) [s] and values (2,) of the minimum and maximum of the derivative of this order."""
        times = QUARTERS * self.duration
        values = self._value(times, counting_number("order", order))
        rows = [int(np.argmax(y >= y.max() - 1e-12 * np.abs(values).max())) for y in (-values, values)]
        return times[rows], values[rows]

    def stretched(self, factor: float) -> "TrigonometricLaw":
        """Return s(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        return replace(self, duration=self.duration * real_number("factor", factor, positive=True))

    def _value(self, t: npt.ArrayLike, order: int, side: str = "right") -> Any:
        tau = times_inside(t, self.duration, side) / self.duration
        values = (self.end - self.start) / self.duration**order * self._shape(tau, order)
        values = values if order else values + self.start
        return values if values.ndim else float(values)

    def _shape(self, tau: Array, order: int) -> Array:
        """Return the derivative of f of this order with respect to τ."""
        straight, wave, omega, amplitude = SHAPES[self.kind]
        line = polynomial.polyval(tau, polynomial.polyder(straight, order))
        return np.asarray(line + amplitude * omega**order * WAVES[(wave + order) % 4](omega * tau))


def cosine(q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float) -> JointLaws:
    """Return the rest-to-rest motion q(t) = q0 + Δ (1 − cos πτ)/2, with Δ = q1 − q0 and τ = t/T.

    |q̇| ≤ π/2 Δ/T, in the middle; |q̈| ≤ π²/2 Δ/T², at both ends, where it jumps from and to zero.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.2.
    """
    return _of_joints(q0, q1, duration, "cosine")


def cycloidal(q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float) -> JointLaws:
    """Return the rest-to-rest motion q(t) = q0 + Δ (τ − sin(2πτ)/2π), with Δ = q1 − q0 and τ = t/T.

    |q̇| ≤ 2 Δ/T, in the middle; |q̈| ≤ 2π Δ/T², at a quarter and at three; it is zero at both ends.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.2.
    """
    return _of_joints(q0, q1, duration, "cycloidal")


def _of_joints(q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float, kind: str) -> JointLaws:
    start = joint_numbers("q0", q0)
    end = joint_numbers("q1", q1, len(start))
    return JointLaws(tuple(TrigonometricLaw(a, b, duration, kind) for a, b in zip(start, end, strict=True)))
