"""Motions of one sine: cosine and cycloidal."""

from math import pi

import numpy as np
import numpy.typing as npt

from robotics1.curves.harmonic import HarmonicCurve
from robotics1.inputs import Array, joint_numbers, positive_number


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
    T = positive_number("duration", duration)
    start, delta = _ends(q0, q1)
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
    T = positive_number("duration", duration)
    start, delta = _ends(q0, q1)
    radius = delta / (2 * pi)
    return HarmonicCurve(start, np.zeros_like(start), -radius, radius, 2 * pi / T, T)


def _ends(q0: npt.ArrayLike, q1: npt.ArrayLike) -> tuple[Array, Array]:
    """Return q0 and Δ = q1 − q0, (n,) each."""
    start = joint_numbers("q0", q0)
    return start, joint_numbers("q1", q1, len(start)) - start
