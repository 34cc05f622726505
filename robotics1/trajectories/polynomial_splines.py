"""Polynomials of any degree through points: one through given derivatives, or a spline of mixed degrees.

All are the solution of linear conditions: values of derivatives at instants, and continuity where two pieces join.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from math import perm
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.later import LaterMotion
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, joint_numbers, joint_rates, positive_number, real_number
from robotics1.trajectories.splines import on_the_clock, timed_points

AT_REST = ((0, 1, 0.0), (0, 2, 0.0), (-1, 1, 0.0), (-1, 2, 0.0))  # no velocity and acceleration at both ends
SINGULAR = 1e13  # of the condition number: conditions that do not determine the polynomials


@dataclass(frozen=True)
class Place:
    """The derivative of this order, of this piece, at τ = (t − tᵢ)/Tᵢ."""

    piece: int
    tau: float
    order: int


@dataclass(frozen=True, eq=False)
class Condition:
    """The derivative at a place has a value; or, with another place, the same value as there.

    Attributes:
        place: where.
        value: (n,) of the derivative with respect to t.
        other: the other place.
    """

    place: Place
    value: Array
    other: Place | None = None


def polynomial_through(conditions: Iterable[tuple[float, int, npt.ArrayLike]]) -> PiecewisePolynomial:
    """Return the polynomial of the least degree with given derivatives at given instants, by Hermite's interpolation.

    m conditions dʳq/dtʳ(tᵢ) = value give the degree m − 1; its duration is the last instant. As in
    `polynomial_through([(0, 0, q0), (0, 1, 0), (1, 0, via), (2, 0, q1), (2, 1, 0)])`, of degree 4.

    Args:
        conditions: (t [s], order r, value (n,)); the order 0 is the position, 1 the velocity, 2 the acceleration.

    Raises:
        InputError: the conditions contradict, repeat or do not determine one another, or t is negative.
    """
    rows = _triples(conditions, "(t, order, value)")
    times = [real_number("t", t, non_negative=True) for t, _, _ in rows]
    orders = [counting_number("order", order) for _, order, _ in rows]
    values = [joint_numbers("value", value) for _, _, value in rows]
    n = max(map(len, values))
    values = [joint_rates("value", value[0] if len(value) == 1 else value, n) for value in values]
    if len(set(zip(times, orders, strict=True))) < len(rows):
        raise InputError(
            "the conditions contradict or repeat one another: one derivative at one instant is given twice"
        )
    T = max(times)
    if T == 0:
        raise InputError("the conditions must be at more than one instant: the last is the duration")
    positive_number("the last instant", T)
    wanted = [Condition(Place(0, t / T, r), value) for t, r, value in zip(times, orders, values, strict=True)]
    return _solve([len(rows) - 1], [T], wanted)


def polynomial_spline(
    times: npt.ArrayLike,
    points: npt.ArrayLike,
    degrees: Sequence[int],
    conditions: Iterable[tuple[int, int, npt.ArrayLike]] = AT_REST,
    *,
    continuity: int = 2,
) -> PiecewisePolynomial | LaterMotion:
    """Return polynomials of given degrees through the points, with the derivatives continuous up to an order.

    4-3-4 and 3-5-3 through four points, and 4-3-...-3-4 through any number, are at rest at both ends in velocity and
    acceleration; five cubics are `virtual_point_spline`. Given velocities v and accelerations a at the ends are
    `conditions=[(0, 1, v0), (0, 2, a0), (-1, 1, v1), (-1, 2, a1)]`. For each joint there are Σ (dᵢ + 1) coefficients,
    2m positions of the m pieces, and (m − 1) · continuity conditions of continuity: the rest is `conditions`.

    Args:
        times: (m + 1,) of the points, ascending [s]; from t₀ ≠ 0 the motion is a `LaterMotion`.
        points: (m + 1, n), or (m + 1,) of one joint [rad or m].
        degrees: (m,) of the pieces.
        conditions: (point, order, value (n,)): a derivative at a point, numbered from 0, or from −1 backwards.
        continuity: 1 for continuous velocities, 2 for accelerations too, and so on.

    Raises:
        InputError: the conditions are too many or too few, contradict one another, or times do not ascend.

    Source: Fu, Gonzalez, Lee, Robotics: Control, Sensing, Vision, and Intelligence, 1987, section 4.3.
    """
    times, points, start = timed_points(times, points)
    if not isinstance(degrees, Sequence) or isinstance(degrees, str):
        raise InputError(f"degrees must be whole numbers, such as (4, 3, 4); it is {degrees!r}")
    if len(degrees) != len(points) - 1:
        raise InputError(f"between {len(points)} points there are {len(points) - 1} pieces; degrees has {len(degrees)}")
    chain = _chain(list(points), times, degrees, _triples(conditions, "(point, order, value)"), continuity)
    return on_the_clock(chain, start)


def virtual_point_spline(
    times: npt.ArrayLike,
    points: npt.ArrayLike,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    a0: npt.ArrayLike = 0.0,
    a1: npt.ArrayLike = 0.0,
) -> PiecewisePolynomial | LaterMotion:
    """Return the cubic spline with given velocities and accelerations at the ends, by two virtual points.

    A cubic spline through m points can meet two conditions at its ends. Two more knots, in the middles of the first and
    the last interval (at thirds, if there is one interval), through which it passes anywhere, give it the other two.
    Through four points it is the trajectory of five cubics.

    Args:
        times: (m,) of the points, ascending [s]; from t₀ ≠ 0 the motion is a `LaterMotion`.
        points: (m, n), or (m,) of one joint [rad or m].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        a0, a1: (n,) accelerations there [rad/s² or m/s²], or one number for all.

    Raises:
        InputError: shapes do not agree, or times do not ascend.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.2.
    """
    times, points, start = timed_points(times, points)
    first, last = (1 / 3, 2 / 3) if len(points) == 2 else (1 / 2, 1 / 2)
    virtual = times[0] + first * (times[1] - times[0]), times[-2] + last * (times[-1] - times[-2])
    rows = [points[0], None, *points[1:-1], None, points[-1]]
    knots = np.array([times[0], virtual[0], *times[1:-1], virtual[1], times[-1]])
    ends = [(0, 1, v0), (0, 2, a0), (-1, 1, v1), (-1, 2, a1)]
    return on_the_clock(_chain(rows, knots, [3] * (len(rows) - 1), ends, 2), start)


def _chain(
    points: list[Array | None], times: Array, degrees: Sequence[int], given: list[tuple[Any, Any, Any]], continuity: int
) -> PiecewisePolynomial:
    """Return polynomials through points, None being anywhere, with continuous derivatives and those that are given."""
    m, n = len(points) - 1, len(points[0] if points[0] is not None else ())
    degrees = [counting_number("a degree", degree, least=1) for degree in degrees]
    order = counting_number("continuity", continuity)
    wanted = []
    for i, point in enumerate(points):
        before, after = Place(i - 1, 1.0, 0), Place(i, 0.0, 0)
        if point is None:
            wanted.append(Condition(before, np.zeros(n), after))
        else:
            wanted += [Condition(place, point) for place in (before, after) if 0 <= place.piece < m]
        if 0 < i < m:
            wanted += [Condition(Place(i - 1, 1.0, r), np.zeros(n), Place(i, 0.0, r)) for r in range(1, order + 1)]
    made = len(wanted)
    for point, r, value in given:
        place = _place(point, counting_number("order", r, least=1), m)
        wanted.append(Condition(place, joint_rates("value", value, n)))
    free = sum(degrees) + m - made
    if len(given) != free:
        raise InputError(
            f"beside the points and {order} continuous derivatives the degrees {tuple(degrees)} leave {free} "
            f"conditions to be given; there are {len(given)}"
        )
    return _solve(degrees, np.diff(times).tolist(), wanted)


def _place(point: Any, order: int, m: int) -> Place:
    """Return where a point's derivative is: at the start of its piece, or at the end of the last."""
    if isinstance(point, bool) or not isinstance(point, int | np.integer) or not -m - 1 <= point <= m:
        raise InputError(f"point must be the number of one of the {m + 1} points, from 0; it is {point!r}")
    i = int(point) % (m + 1)
    return Place(i, 0.0, order) if i < m else Place(m - 1, 1.0, order)


def _triples(conditions: Any, form: str) -> list[tuple[Any, Any, Any]]:
    try:
        rows = [(a, b, c) for a, b, c in conditions]
    except (TypeError, ValueError) as error:
        raise InputError(f"conditions must be a list of {form}; it is {conditions!r}") from error
    if not rows and form.startswith("(t"):
        raise InputError(f"conditions must be a list of {form}; it is empty")
    return rows


def _solve(degrees: Sequence[int], durations: Sequence[float], conditions: Sequence[Condition]) -> PiecewisePolynomial:
    """Return the polynomials of these degrees and durations that meet as many conditions as they have coefficients.

    The conditions are linear in the coefficients: Σₖ k!/(k − r)! τᵏ⁻ʳ cₖ/Tʳ is the derivative of order r.

    Raises:
        InputError: the conditions are too many, too few, or contradict or repeat one another.
    """
    starts = [0, *accumulate(degree + 1 for degree in degrees)]
    if len(conditions) != starts[-1]:
        raise InputError(
            f"polynomials of the degrees {', '.join(map(str, degrees))} have {starts[-1]} coefficients for each joint; "
            f"they need as many conditions, not {len(conditions)}"
        )
    unit = float(np.mean(durations))
    A = np.zeros((len(conditions), starts[-1]))
    for row, condition in zip(A, conditions, strict=True):
        for place, sign in ((condition.place, 1), (condition.other, -1)):
            if place is not None:
                i, r = place.piece, place.order
                terms = [perm(k, r) * place.tau ** max(k - r, 0) for k in range(degrees[i] + 1)]
                row[starts[i] : starts[i + 1]] += sign * np.array(terms) * (unit / durations[i]) ** r
    b = np.array([condition.value * unit**condition.place.order for condition in conditions])
    if np.linalg.cond(A) > SINGULAR:
        raise InputError("the conditions contradict or repeat one another: they do not determine the polynomials")
    c = np.linalg.solve(A, b)
    return PiecewisePolynomial.from_pieces([(c[starts[i] : starts[i + 1]], T) for i, T in enumerate(durations)])
