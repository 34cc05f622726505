"""Cubic splines through points in time."""

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of, real_array
from robotics1.trajectories.polynomials.piecewise import PiecewiseTrajectory
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory, cubic
from robotics1.trajectories.quantities import joint_rates, moderate
from robotics1.trajectories.splines.knot_times import points_in_rows, timed_points

ENDS = ("clamped", "natural", "periodic", "not-a-knot")


def cubic_spline(
    points: npt.ArrayLike,
    times: npt.ArrayLike,
    *,
    ends: str = "clamped",
    v0: npt.ArrayLike | None = None,
    v1: npt.ArrayLike | None = None,
    a0: npt.ArrayLike | None = None,
    a1: npt.ArrayLike | None = None,
) -> PiecewiseTrajectory:
    """Return the cubic spline through the points: cubics with continuous velocities and accelerations.

    Of all motions through the points with the same velocities at the ends, it has the least ∫|q̈|² dt. The velocities
    at the points are `spline.velocity(times)`, the polynomials `spline.pieces`, each with its `coefficients` in
    τ = (t − tᵢ)/Tᵢ and `coefficients_t` in t − tᵢ.

    Args:
        points: (m, n), or (m,) of one joint [rad or m].
        times: (m,) of the points, ascending from 0 [s].
        ends: what holds at an end where nothing else is given: "clamped" (at rest), "natural" (q̈ = 0), "not-a-knot"
            (the first two and the last two pieces are one cubic); "periodic": the end goes on at the start, with the
            same point, velocity and acceleration.
        v0, v1: (n,) the velocity at the start and at the end [rad/s or m/s], or one number for all.
        a0, a1: (n,) the acceleration there instead [rad/s² or m/s²].

    Raises:
        InputError: velocity and acceleration are both given at one end, times do not ascend, a periodic motion does
            not end where it begins.

    Source: de Boor, A Practical Guide to Splines, 1978, chapter IV; Siciliano, Sciavicco, Villani, Oriolo, Robotics,
    2009, section 4.2.2.
    """
    from scipy.interpolate import CubicSpline

    points, times = timed_points(points, times)
    one_of("ends", ends, ENDS)
    given = [_end(number, v, a, points.shape[1]) for number, v, a in ((0, v0, a0), (1, v1, a1))]
    if ends == "periodic":
        _refuse_open(points, given)
        points[-1] = points[0]
        conditions: Any = "periodic"
    else:
        conditions = tuple(ends if condition is None else condition for condition in given)
    spline = CubicSpline(times, points, bc_type=conditions)
    durations = np.diff(times)
    powers = durations[:, None] ** np.arange(4)
    pieces = zip(np.moveaxis(spline.c[::-1], 1, 0), powers, durations, strict=True)
    return PiecewiseTrajectory(tuple(PolynomialTrajectory(c * p[:, None], float(T)) for c, p, T in pieces))


def cubics_through(
    points: npt.ArrayLike, times: npt.ArrayLike, velocities: npt.ArrayLike | None = None
) -> PiecewiseTrajectory:
    """Return cubics through the points with given velocities there; the accelerations jump.

    Without velocities they are zero at the ends, and at an inner point the mean of the slopes before and after it, or
    zero where these have different signs: no joint passes a point and comes back.

    Args:
        points: (m, n), or (m,) of one joint [rad or m].
        times: (m,) of the points, ascending from 0 [s].
        velocities: (m, n), or (m,) of one joint [rad/s or m/s].

    Raises:
        InputError: shapes do not agree, or times do not ascend.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.2.
    """
    points, times = timed_points(points, times)
    if velocities is None:
        slopes = np.diff(points, axis=0) / np.diff(times)[:, None]
        inner = np.where(slopes[:-1] * slopes[1:] > 0, (slopes[:-1] + slopes[1:]) / 2, 0.0)
        v = np.concatenate([0 * points[:1], inner, 0 * points[:1]])
    else:
        listed = points_in_rows(velocities)
        v = moderate("velocities", real_array("velocities", listed, points.shape, "one velocity for each point"))
    states = zip(points, v, times, strict=True)
    return PiecewiseTrajectory(tuple(cubic(p, q, t1 - t0, v, w) for (p, v, t0), (q, w, t1) in pairwise(states)))


def _end(number: int, v: npt.ArrayLike | None, a: npt.ArrayLike | None, n: int) -> tuple[int, Array] | None:
    """Return the derivative that is given at an end, and its value."""
    if v is not None and a is not None:
        raise InputError(
            f"v{number} and a{number} are one condition too many for a cubic; mixed_spline(...) with the degree 4 at "
            "the ends takes both"
        )
    if v is not None:
        return 1, joint_rates(f"v{number}", v, n)
    return None if a is None else (2, joint_rates(f"a{number}", a, n))


def _refuse_open(points: Array, given: list[tuple[int, Array] | None]) -> None:
    if any(condition is not None for condition in given):
        raise InputError("a periodic motion has no ends at which a velocity or an acceleration could be given")
    if (np.abs(points[-1] - points[0]) > 1e-9 * np.abs(points).max(axis=0)).any() or len(points) < 3:
        raise InputError("a periodic motion needs three points, and ends where it begins: repeat the first as the last")
