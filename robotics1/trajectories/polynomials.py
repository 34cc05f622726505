"""The polynomial between two states: cubic, quintic, septic."""

import numpy as np
import numpy.typing as npt

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
    T = positive_number("duration", duration)
    q0, delta, v0, v1 = _boundary(q0, q1, v0=v0, v1=v1)
    return PiecewisePolynomial.from_pieces(
        [(np.array([q0, v0 * T, 3 * delta - (2 * v0 + v1) * T, -2 * delta + (v0 + v1) * T]), T)]
    )


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
    T = positive_number("duration", duration)
    q0, delta, v0, v1, a0, a1 = _boundary(q0, q1, v0=v0, v1=v1, a0=a0, a1=a1)
    v0, v1, a0, a1 = v0 * T, v1 * T, a0 * T * T / 2, a1 * T * T / 2
    c3 = 10 * delta - (6 * v0 + 4 * v1) - (3 * a0 - a1)
    c4 = -15 * delta + (8 * v0 + 7 * v1) + (3 * a0 - 2 * a1)
    c5 = 6 * delta - 3 * (v0 + v1) - (a0 - a1)
    return PiecewisePolynomial.from_pieces([(np.array([q0, v0, a0, c3, c4, c5]), T)])


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
    T = positive_number("duration", duration)
    q0, delta, v0, v1, a0, a1 = _boundary(q0, q1, v0=v0, v1=v1, a0=a0, a1=a1)
    v0, v1, a0, a1 = v0 * T, v1 * T, a0 * T * T / 2, a1 * T * T / 2
    c4 = 35 * delta - (20 * v0 + 15 * v1) - (10 * a0 - 5 * a1)
    c5 = -84 * delta + (45 * v0 + 39 * v1) + (20 * a0 - 14 * a1)
    c6 = 70 * delta - (36 * v0 + 34 * v1) - (15 * a0 - 13 * a1)
    c7 = -20 * delta + 10 * (v0 + v1) + 4 * (a0 - a1)
    return PiecewisePolynomial.from_pieces([(np.array([q0, v0, a0, 0 * delta, c4, c5, c6, c7]), T)])


def _boundary(q0: npt.ArrayLike, q1: npt.ArrayLike, **rates: npt.ArrayLike) -> list[Array]:
    """Return q0, q1 − q0 and the rates, each (n,)."""
    start = joint_numbers("q0", q0)
    end = joint_numbers("q1", q1, len(start))
    return [start, end - start, *(joint_rates(name, value, len(start)) for name, value in rates.items())]
