"""Points and the times at which they are passed."""

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, one_of, real_array
from robotics1.trajectories.quantities import LARGEST, moderate, positive_duration

EXPONENTS = {"uniform": 0.0, "centripetal": 0.5, "chord": 1.0}


def times_of_points(points: npt.ArrayLike, duration: float, rule: str = "chord") -> Array:
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
    T = positive_duration("duration", duration)
    exponent = EXPONENTS[one_of("rule", rule, tuple(EXPONENTS))]
    steps = np.linalg.norm(np.diff(rows, axis=0), axis=1)
    if exponent and not steps.all():
        i = int(np.argmin(steps))
        raise InputError(f"points {i} and {i + 1} are the same: by the rule {rule!r} no time passes between them")
    times = np.concatenate([[0.0], np.cumsum(steps**exponent)])
    return np.asarray(T * times / times[-1])


def timed_points(points: npt.ArrayLike, times: npt.ArrayLike) -> tuple[Array, Array]:
    """Return points as (m, n) and their times (m,), if these ascend from 0.

    Raises:
        InputError: they do not, or there are not as many of both.
    """
    rows = points_in_rows(points)
    knots = real_array("times", times, (len(rows),), "one for each point, in seconds")
    if knots[0] != 0:
        raise InputError(
            f"times must begin at 0, when the motion does; the first is {knots[0]:g}: subtract it from all"
        )
    if (np.diff(knots) <= 0).any():
        i = int(np.argmax(np.diff(knots) <= 0))
        raise InputError(f"times must ascend; {knots[i + 1]:g} follows {knots[i]:g}")
    moderate("the intervals of times", np.diff(knots), smallest=1 / LARGEST)
    return rows, knots


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
