"""How long a motion must take so that its bounds hold: scaled as a whole, or of a known shape with given ends."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import polynomial

from robotics1.curves.composition import stretched
from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial, stationary_points
from robotics1.errors import InputError
from robotics1.inputs import LARGEST, answer_of, real_number
from robotics1.results import Frozen
from robotics1.trajectories.limits import ORDERS, Limits, LimitUse, MotionLimits

SHORT, LONG = 1e-12, 1e12  # of what the motion of one second needs if it is stretched: where the search begins and ends
REACHED = 1e-11  # relative excess over a bound that is rounding
SAME_BOUND = 1e-12  # relative: a value so near to its bound is at it
HIGHEST = 7  # the order of a polynomial's derivatives that are looked at where a bound is touched
SHORTEST = 1 / LARGEST  # [s], of any duration that is not zero
NARROW = 1e-13  # relative: durations that serve only so exactly are not found; rounding decides about them
NOISE = 1e-11  # of the distance: what rounding is in the third derivative by τ of degree 7
LONGER = 8.0  # what a step may multiply the duration by: its cubic is fitted within that range
STEPS = 100
EXACT = {"xtol": 1e-15, "rtol": 1e-15}
Motion = Callable[[float], Any]


@dataclass(frozen=True, eq=False)
class TimeScaling(Frozen):
    """A motion in the shortest time to which its bounds let it be scaled.

    Attributes:
        factor: k = T_new/T; above 1 the motion had to be slowed down.
        trajectory: q(t/k).
        active: the bounds that it touches; they decide k.
        uses: what the motion used of each bound before.
    """

    factor: float
    trajectory: Curve
    active: tuple[LimitUse, ...]
    uses: tuple[LimitUse, ...]

    @property
    def duration(self) -> float:
        """The new duration [s]."""
        return self.trajectory.duration


def scale_to_limits(trajectory: Any, limits: Limits, *, speed_up: bool = True) -> TimeScaling:
    """Return q(t/k) with the least k for which the bounds hold: q̇ is divided by k, q̈ by k².

    k = max over the bounds of max|q̇|/V, √(max|q̈|/A), ∛(max|d³q/dt³|/J), from the exact extremes. All velocities scale,
    those at the ends too; `minimum_duration` keeps those.

    Args:
        trajectory: any, in joint space or Cartesian.
        limits: MotionLimits of the joints, or NormLimits of a point's velocity and acceleration.
        speed_up: whether a motion that has time to spare is sped up to the bounds; else k ≥ 1.

    Raises:
        InputError: nothing moves, or no bound is given, so that every k will do.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 7.7.
    """
    if isinstance(limits, type) or not callable(getattr(limits, "uses", None)):
        raise InputError(f"limits must be MotionLimits(...) or NormLimits(...); it is {limits!r}")
    motion = as_curve("trajectory", trajectory)
    uses = limits.uses(motion)
    k = max((use.stretch for use in uses), default=0.0)
    if not speed_up:
        k = max(k, 1.0)
    if k == 0:
        raise InputError("every duration keeps the bounds: there is none, or nothing moves")
    scaled = stretched(motion, k)
    return TimeScaling(k, scaled, tuple(use for use in limits.uses(scaled) if use.active), uses)


# --- of a known shape, with any states at its ends


def minimum_duration(motion: Motion, limits: MotionLimits, *, at_least: float = 0.0) -> float:
    """Return the least T for which the motion of duration T keeps the bounds, from its exact extremes.

    `motion(T)` must be q(τ; T) = Σᵢ Tⁱ φᵢ(τ), i ≤ 3, as every polynomial and spline with given positions,
    velocities, accelerations and jerks is, τ = t/T. At a T where the bound B on the k-th derivative is passed, let it
    be most so at τ*. There h(T') = |∂ᵏq/∂τᵏ (τ*; T')| − B T'ᵏ is a cubic in T': until its next zero the bound is passed
    at τ*, so that no duration before that zero will do. The steps from zero to zero, upwards from a T that is too
    short, converge quadratically to the least T and jump over nothing. A T below 1e-30 s is given as 1e-30 s.

    As in `minimum_duration(lambda T: quintic(q0, q1, T, v0=v0), MotionLimits(velocity=2, acceleration=5))`.

    Args:
        motion: T [s] → the motion of that duration.
        limits: at least one bound.
        at_least: a duration that T must not fall below [s].

    Raises:
        InputError: no duration keeps the bounds, or arbitrarily short ones do, or the motion is not of that form.
    """
    _check_function_of_duration(motion)
    if not isinstance(limits, MotionLimits):
        raise InputError(f"limits must be MotionLimits(velocity=..., acceleration=...); it is {limits!r}")
    if limits.deceleration is not None:
        raise InputError("a bound of its own on the deceleration is for trapezoidal velocities")
    unit = _of_joints(answer_of("motion", motion, 1.0))
    uses = limits.uses(unit)
    if not uses:
        raise InputError("there is no bound, so that any duration will do: give one")
    at_least = real_number("at_least", at_least, non_negative=True)
    natural = max(use.stretch for use in uses)
    T = max(_too_short(unit, limits), SHORT * natural, at_least)
    if T == 0:
        return 0.0
    T = max(T, SHORTEST)
    longest = LONG * max(T, natural)
    for step in range(STEPS):
        passed = _passed(motion, limits, T)
        if not passed and (step or T in (at_least, SHORTEST)):
            return T
        if not passed:
            raise InputError("arbitrarily short durations keep these bounds; give one on the acceleration or jerk")
        if longest < T:
            break
        T = max(T * (1 + NARROW), *(_next_zero(motion, T, excess) for excess in passed))
    worst = max(limits.uses(answer_of("motion", motion, T)), key=lambda use: use.stretch)
    raise InputError(
        f"no duration keeps these bounds: joint {worst.joint}'s {worst.quantity} passes {worst.limit:g} in any; are "
        "the velocities and accelerations at the ends inside them?"
    )


class Excess(NamedTuple):
    """A derivative of this order, of this joint, that is beyond its limit at this time."""

    order: int
    joint: int
    time: float
    value: float
    limit: float


def _passed(motion: Motion, limits: MotionLimits, T: float) -> list[Excess]:
    """Return where the motion of duration T passes a bound.

    A derivative that is at its bound B at an end for every T, as q̇ where v0 = V, passes it by the square, or a higher
    power, of the next one that is not zero there: so small an excess is rounding. That next one must lead back inside.
    """
    curve, slower = (as_curve("motion(T)", answer_of("motion", motion, duration)) for duration in (T, 2 * T))
    bounds = limits.of_joints(curve.dimension)
    found = [
        Excess(ORDERS[use.quantity], int(use.joint or 0), use.time, use.value, use.limit)
        for use in limits.uses(curve)
        if abs(use.value) > (1 + REACHED) * use.limit
    ]
    highest = HIGHEST if isinstance(curve, PiecewisePolynomial) else 3
    for k, bound in ((ORDERS[name], getattr(bounds, name)) for name in ("velocity", "acceleration", "jerk")):
        ends: tuple[tuple[float, int, Side], ...] = ((0.0, 1, "right"), (T, -1, "left"))
        for time, inwards, side in ends:
            values = np.array([curve.derivative(time, r, side=side) for r in range(k, highest + 1)])
            pair = np.abs([values[0], slower.derivative(2 * time, k, side=side)])
            for j in np.flatnonzero((np.abs(pair / bound - 1) <= SAME_BOUND).all(axis=0)):
                sizes = values[1:, j] * (inwards * T) ** np.arange(1.0, len(values)) / values[0, j]
                beyond = np.flatnonzero(np.abs(sizes) > REACHED)
                if beyond.size and sizes[beyond[0]] > 0:
                    r = int(beyond[0]) + 1
                    found.append(Excess(k + r, int(j), time, float(values[r, j]), 0.0))
    return found


def _check_function_of_duration(motion: Any) -> None:
    if not callable(motion):
        raise InputError("motion must be a function of the duration, such as lambda T: cubic(q0, q1, T)")
    if isinstance(motion, Curve):
        raise InputError(
            "motion must be a function of the duration, such as lambda T: cubic(q0, q1, T), and it is a motion; one "
            "that is only to be slower or faster is stretched by scale_to_limits(motion, limits)"
        )


def _of_joints(unit: Any) -> Curve:
    """Return the motion of one second, if it is one of joints."""
    found = as_curve("motion(T)", unit)
    if not found.of_points or len(found.shape) != 1:
        raise InputError("motion(T) must be of joints, (n,) numbers at a time, such as cubic(q0, q1, T)")
    return found


def _too_short(unit: Curve, limits: MotionLimits) -> float:
    """Return a duration not above the least one: no motion has a mean velocity or acceleration beyond the bound."""
    bounds = limits.of_joints(unit.dimension)
    means = [
        np.abs(unit(1.0) - unit(0.0)) / bounds.velocity,
        np.abs(unit.velocity(1.0) - unit.velocity(0.0)) / bounds.acceleration,
    ]
    return float(np.max(means)) * (1 - 1e-6)


def _next_zero(motion: Motion, T: float, passed: Excess) -> float:
    """Return the next zero T' > T of h(T'), or 8 T if there is none before; T itself if h is rounding."""
    from scipy.optimize import brentq

    k, j, tau = passed.order, passed.joint, passed.time / T

    def h(u: float, side: Side) -> float:
        """h(T')/Tᵏ at T' = T (1 + 7u)."""
        x = 1 + (LONGER - 1) * u
        value = as_curve("motion(T)", motion(x * T)).derivative(tau * x * T, k, side=side)[j]
        return float(np.sign(passed.value) * value - passed.limit) * x**k

    side: Side = "right" if h(0.0, "right") >= h(0.0, "left") else "left"
    u = np.linspace(0.0, 1.0, 5)
    y = np.array([h(value, side) for value in u])
    cubic = polynomial.polyfit(u[:-1], y[:-1], 3)
    if abs(polynomial.polyval(1.0, cubic) - y[-1]) > 1e-6 * np.abs(y).max():
        if 0 < y[0] <= NOISE * _span(motion(T), j) / T**k:
            return T
        raise InputError("motion(T) must be a polynomial or spline in t/T whose coefficients are powers of T up to T³")
    for before, after in pairwise(stationary_points(cubic)):  # h is monotonic between them
        if h(after, side) <= 0:
            return T * (1 + (LONGER - 1) * float(brentq(h, before, after, args=(side,), **EXACT)))
    return T * LONGER


def _span(unit: Curve, j: int) -> float:
    """Return what the coefficients of a joint in powers of τ are made of: its distance, and its velocities times T."""
    T = unit.duration
    distance = abs(unit(T)[j] - unit(0.0)[j])
    return float(distance + T * max(abs(unit.velocity(t)[j]) for t in (0.0, T)))
