"""Elementary motions between two states: cubic, quintic and septic polynomials, and the sines, cosine and cycloidal."""

from __future__ import annotations

from math import pi

import numpy as np
import numpy.typing as npt

from robotics1.curves.harmonic import HarmonicCurve
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.inputs import Array, joint_numbers, joint_rates, positive_number


def cubic(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
) -> PiecewisePolynomial:
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
    T, (q0, delta, v0, v1) = boundary(q0, q1, duration, v0=v0, v1=v1)
    v0, v1 = v0 * T, v1 * T
    return PiecewisePolynomial.from_pieces([([q0, v0, 3 * delta - (2 * v0 + v1), -2 * delta + (v0 + v1)], T)])


def quintic(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    a0: npt.ArrayLike = 0.0,
    a1: npt.ArrayLike = 0.0,
) -> PiecewisePolynomial:
    """Return the polynomial of degree 5 from (q0, v0, a0) to (q1, v1, a1) in the duration T: with Δ = q1 − q0,

    q(τ) = q0 + v0 T τ + a0 T²/2 τ² + (10Δ − (6 v0 + 4 v1) T − (3 a0 − a1) T²/2) τ³
    + (−15Δ + (8 v0 + 7 v1) T + (3 a0 − 2 a1) T²/2) τ⁴ + (6Δ − 3 (v0 + v1) T − (a0 − a1) T²/2) τ⁵.

    From rest to rest |q̇| is at most 15/8 Δ/T, in the middle, and |q̈| at most 10/√3 Δ/T², at τ = ½ ∓ √3/6.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        a0, a1: (n,) accelerations there [rad/s² or m/s²], or one number for all.

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.1.
    """
    T, (q0, delta, v0, v1, a0, a1) = boundary(q0, q1, duration, v0=v0, v1=v1, a0=a0, a1=a1)
    v0, v1, a0, a1 = v0 * T, v1 * T, a0 * T * T / 2, a1 * T * T / 2
    c3 = 10 * delta - (6 * v0 + 4 * v1) - (3 * a0 - a1)
    c4 = -15 * delta + (8 * v0 + 7 * v1) + (3 * a0 - 2 * a1)
    c5 = 6 * delta - 3 * (v0 + v1) - (a0 - a1)
    return PiecewisePolynomial.from_pieces([([q0, v0, a0, c3, c4, c5], T)])


def septic(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    a0: npt.ArrayLike = 0.0,
    a1: npt.ArrayLike = 0.0,
) -> PiecewisePolynomial:
    """Return the polynomial of degree 7 from (q0, v0, a0) to (q1, v1, a1) in the duration T, without jerk at the ends.

    From rest to rest, with Δ = q1 − q0: q(τ) = q0 + Δ (35 τ⁴ − 84 τ⁵ + 70 τ⁶ − 20 τ⁷), and |q̇| ≤ 35/16 Δ/T.
    With jerk at the ends: `polynomial_through`.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        a0, a1: (n,) accelerations there [rad/s² or m/s²], or one number for all.

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.1.
    """
    T, (q0, delta, v0, v1, a0, a1) = boundary(q0, q1, duration, v0=v0, v1=v1, a0=a0, a1=a1)
    v0, v1, a0, a1 = v0 * T, v1 * T, a0 * T * T / 2, a1 * T * T / 2
    c4 = 35 * delta - (20 * v0 + 15 * v1) - (10 * a0 - 5 * a1)
    c5 = -84 * delta + (45 * v0 + 39 * v1) + (20 * a0 - 14 * a1)
    c6 = 70 * delta - (36 * v0 + 34 * v1) - (15 * a0 - 13 * a1)
    c7 = -20 * delta + 10 * (v0 + v1) + 4 * (a0 - a1)
    return PiecewisePolynomial.from_pieces([([q0, v0, a0, 0 * delta, c4, c5, c6, c7], T)])


def cosine(q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float) -> HarmonicCurve:
    """Return the rest-to-rest motion q(t) = q0 + Δ (1 − cos πτ)/2, with Δ = q1 − q0 and τ = t/T.

    |q̇| ≤ π/2 Δ/T, in the middle; |q̈| ≤ π²/2 Δ/T², at both ends, where it jumps from and to zero.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.2.
    """
    T, (start, delta) = boundary(q0, q1, duration)
    none = np.zeros_like(start)
    return HarmonicCurve(start + delta / 2, -delta / 2, none, none, pi / T, T)


def cycloidal(q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float) -> HarmonicCurve:
    """Return the rest-to-rest motion q(t) = q0 + Δ (τ − sin(2πτ)/2π), with Δ = q1 − q0 and τ = t/T.

    |q̇| ≤ 2 Δ/T, in the middle; |q̈| ≤ 2π Δ/T², at a quarter and at three; it is zero at both ends.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 2.2.
    """
    T, (start, delta) = boundary(q0, q1, duration)
    radius = delta / (2 * pi)
    return HarmonicCurve(start, np.zeros_like(start), -radius, radius, 2 * pi / T, T)


def boundary(
    q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float, **rates: npt.ArrayLike
) -> tuple[float, list[Array]]:
    """Return the duration T, and q0, Δ = q1 − q0 and the rates at the ends, each (n,).

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.
    """
    T = positive_number("duration", duration)
    start = joint_numbers("q0", q0)
    end = joint_numbers("q1", q1, len(start))
    return T, [start, end - start, *(joint_rates(name, value, len(start)) for name, value in rates.items())]
