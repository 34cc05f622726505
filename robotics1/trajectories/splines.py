"""Cubic splines through points, with times or as paths; and the times of points."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from robotics1.curves.later import LaterMotion
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.curves.polyline import points_apart
from robotics1.errors import InputError
from robotics1.inputs import (
    LARGEST,
    Array,
    dimensions,
    joint_rates,
    moderate,
    moderate_array,
    one_of,
    positive_number,
    real_array,
)

EndCondition = Literal["clamped", "natural", "periodic", "not-a-knot"]
KnotRule = Literal["uniform", "centripetal", "chord"]
EXPONENTS = {"uniform": 0.0, "centripetal": 0.5, "chord": 1.0}
CONDITIONS = ("clamped", "natural", "periodic", "not-a-knot")


def cubic_spline(
    times: npt.ArrayLike,
    points: npt.ArrayLike,
    *,
    bc_type: EndCondition = "clamped",
    v0: npt.ArrayLike | None = None,
    v1: npt.ArrayLike | None = None,
    a0: npt.ArrayLike | None = None,
    a1: npt.ArrayLike | None = None,
) -> PiecewisePolynomial | LaterMotion:
    """Return the cubic spline through the points: cubics with continuous velocities and accelerations.

    Of all motions through the points with the same velocities at the ends, it has the least ∫|q̈|² dt. The velocities
    at the points are `spline.velocity(times)`, the polynomials `spline.pieces`, each with its `coefficients` in
    τ = (t − tᵢ)/Tᵢ and `coefficients_t` in t − tᵢ.

    Args:
        times: (m,) of the points, ascending [s]; from t₀ ≠ 0 the motion is a `LaterMotion`.
        points: (m, n), or (m,) of one joint [rad or m].
        bc_type: what holds at an end where nothing else is given: "clamped" (at rest), "natural" (q̈ = 0), "not-a-knot"
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
    times, points, start = timed_points(times, points)
    given = [_end("v0", v0, "a0", a0, points.shape[1]), _end("v1", v1, "a1", a1, points.shape[1])]
    return on_the_clock(_cubic_spline(times, points, bc_type, given), start)


def _cubic_spline(
    times: Array, points: Array, bc_type: str, given: list[tuple[int, Array] | None]
) -> PiecewisePolynomial:
    """Return the spline with a derivative given at an end, or else the condition of SciPy's `bc_type` there."""
    from scipy.interpolate import CubicSpline

    one_of("bc_type", bc_type, CONDITIONS)
    conditions: Any = "periodic"
    if bc_type == "periodic":
        _refuse_open(points, given)
        points[-1] = points[0]
    else:
        conditions = tuple(bc_type if condition is None else condition for condition in given)
    return PiecewisePolynomial.from_ppoly(CubicSpline(times, points, bc_type=conditions))


def cubic_hermite_spline(
    times: npt.ArrayLike, points: npt.ArrayLike, velocities: npt.ArrayLike | None = None
) -> PiecewisePolynomial | LaterMotion:
    """Return cubics through the points with given velocities there; the accelerations jump.

    Without velocities they are zero at the ends, and at an inner point the mean of the slopes before and after it, or
    zero where these have different signs: no joint passes a point and comes back.

    Args:
        times: (m,) of the points, ascending [s]; from t₀ ≠ 0 the motion is a `LaterMotion`.
        points: (m, n), or (m,) of one joint [rad or m].
        velocities: (m, n), or (m,) of one joint [rad/s or m/s].

    Raises:
        InputError: shapes do not agree, or times do not ascend.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.2.
    """
    times, points, start = timed_points(times, points)
    if velocities is None:
        slopes = np.diff(points, axis=0) / np.diff(times)[:, None]
        inner = np.where(slopes[:-1] * slopes[1:] > 0, (slopes[:-1] + slopes[1:]) / 2, 0.0)
        v = np.concatenate([0 * points[:1], inner, 0 * points[:1]])
    else:
        listed = points_in_rows(velocities)
        v = moderate("velocities", real_array("velocities", listed, points.shape, "one velocity for each point"))
    from scipy.interpolate import CubicHermiteSpline

    return on_the_clock(PiecewisePolynomial.from_ppoly(CubicHermiteSpline(times, points, v)), start)


def spline_path(
    points: npt.ArrayLike,
    *,
    knots: str | npt.ArrayLike = "chord",
    bc_type: EndCondition = "natural",
    v0: npt.ArrayLike | None = None,
    v1: npt.ArrayLike | None = None,
    a0: npt.ArrayLike | None = None,
    a1: npt.ArrayLike | None = None,
) -> PiecewisePolynomial:
    """Return the cubic spline p(s) through the points: `cubic_spline` with knots that the points themselves give.

    s is near the arc length when the knots are those of the chords; `by_arc_length` makes it the arc length.

    Args:
        points: (m, n) in order, Cartesian [m] or joint values; no two consecutive ones are the same.
        knots: "chord" (sᵢ₊₁ − sᵢ = |pᵢ₊₁ − pᵢ|), "centripetal" (its root), "uniform" (1), or (m,) numbers from 0.
        bc_type: as in `cubic_spline`, but "natural" (p'' = 0) by default: where p' = 0 a path has no tangent.
        v0, v1: (n,) p' at the start and at the end instead.
        a0, a1: (n,) p'' there instead.

    Raises:
        InputError: p' and p'' are both given at one end, consecutive points are the same, knots do not ascend, or a
            periodic spline is not closed.

    Source: de Boor, A Practical Guide to Splines, 1978, chapter IV.
    """
    rows, steps = points_apart(points)
    given = [_end("v0", v0, "a0", a0, rows.shape[1]), _end("v1", v1, "a1", a1, rows.shape[1])]
    return _cubic_spline(_knots(knots, steps), rows, bc_type, given)


def _knots(knots: str | npt.ArrayLike, steps: Array) -> Array:
    if isinstance(knots, str):
        if knots not in EXPONENTS:
            raise InputError(f"knots must be 'chord', 'centripetal', 'uniform' or numbers; it is {knots!r}")
        return _knots_by_rule(knots, steps)
    given = moderate_array("knots", knots, (len(steps) + 1,), "one for each point")
    if given[0] != 0 or (np.diff(given) <= 1e-12 * given[-1]).any():
        raise InputError(f"knots must ascend from 0; they are {given.tolist()}")
    return given


def _end(first: str, v: npt.ArrayLike | None, second: str, a: npt.ArrayLike | None, n: int) -> tuple[int, Array] | None:
    """Return which derivative is given at an end, and its value."""
    if v is not None and a is not None:
        raise InputError(
            f"{first} and {second} are one condition too many for a cubic; polynomial_spline(...) with the degree 4 at "
            "the ends takes both"
        )
    if v is not None:
        return 1, joint_rates(first, v, n)
    return None if a is None else (2, joint_rates(second, a, n))


def _refuse_open(points: Array, given: list[tuple[int, Array] | None]) -> None:
    if any(condition is not None for condition in given):
        raise InputError("a periodic motion has no ends at which a velocity or an acceleration could be given")
    if (np.abs(points[-1] - points[0]) > 1e-9 * np.abs(points).max(axis=0)).any() or len(points) < 3:
        raise InputError("a periodic motion needs three points, and ends where it begins: repeat the first as the last")


def knot_times(points: npt.ArrayLike, duration: float, rule: KnotRule = "chord") -> Array:
    """Return times for points, from 0 to the duration T, with intervals in proportion to |qᵢ₊₁ − qᵢ|ᵖ.

    "uniform", p = 0: equal intervals; "centripetal", p = ½: less overshoot at sharp turns; "chord", p = 1: the mean
    speed is the same in all.

    Args:
        points: (m, n), or (m,) of one joint [rad or m].
        duration: T [s].
        rule: "uniform", "centripetal" or "chord".

    Raises:
        InputError: two consecutive points are the same, which only "uniform" can tell apart, or T is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 8.3.
    """
    rows = points_in_rows(points)
    T = positive_number("duration", duration)
    steps = np.linalg.norm(np.diff(rows, axis=0), axis=1)
    if EXPONENTS[one_of("rule", rule, tuple(EXPONENTS))] and not steps.all():
        i = int(np.argmin(steps))
        raise InputError(f"points {i} and {i + 1} are the same: by the rule {rule!r} no time passes between them")
    knots = _knots_by_rule(rule, steps)
    return np.asarray(T * knots / knots[-1])


def _knots_by_rule(rule: str, steps: Array) -> Array:
    """Return knots from 0 with intervals |qᵢ₊₁ − qᵢ|ᵖ, the power that of the rule."""
    return np.concatenate([[0.0], np.cumsum(steps ** EXPONENTS[rule])])


def timed_points(times: npt.ArrayLike, points: npt.ArrayLike) -> tuple[Array, Array, float]:
    """Return times (m,) less the first, if they ascend, their points as (m, n), and the first of the times.

    Raises:
        InputError: they do not, or there are not as many of both.
    """
    rows = points_in_rows(points)
    knots = real_array("times", times, (len(rows),), "one for each point, in seconds")
    if (np.diff(knots) <= 0).any():
        i = int(np.argmax(np.diff(knots) <= 0))
        raise InputError(f"times must ascend; {knots[i + 1]:g} follows {knots[i]:g}")
    moderate("the intervals of times", np.diff(knots), smallest=1 / LARGEST)
    return knots - knots[0], rows, float(knots[0])


def on_the_clock(spline: PiecewisePolynomial, start: float) -> PiecewisePolynomial | LaterMotion:
    """Return a spline that begins at 0, or as a motion that begins at another instant."""
    return LaterMotion(spline, start) if start else spline


def points_in_rows(points: npt.ArrayLike) -> Array:
    """Return points as (m, n), m ≥ 2; numbers are the points of one joint.

    Raises:
        InputError: they are none.
    """
    if dimensions("points", points) == 1:
        rows = real_array("points", points, (None,), "the points of one joint")[:, None]
    else:
        rows = real_array("points", points, (None, None), "one point a row")
    moderate("points", rows)
    if len(rows) < 2 or rows.shape[1] == 0:
        raise InputError(f"points must be two at least; they have the shape {rows.shape}")
    return rows
