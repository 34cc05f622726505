"""Passing over points without stopping: constant velocities, and constant accelerations between them."""

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, per_joint
from robotics1.paths.points import LARGEST, moderate, point, steps_between
from robotics1.paths.polyline import refuse_overlap
from robotics1.trajectories.polynomials.piecewise import PiecewiseTrajectory
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory


def overfly(points: npt.ArrayLike, speeds: npt.ArrayLike, blend_times: npt.ArrayLike) -> PiecewiseTrajectory:
    """Return the motion that passes near the inner points: v₁ on the first segment, v₂ on the second, and so on, with a
    constant acceleration (v₂ − v₁)/T_b during the blend time T_b in between.

    The blend is a parabola: p = p_a + v₁ t + (v₂ − v₁) t²/2T_b, which leaves the first segment at the distance
    |v₁| T_b/2 before the point, and reaches the second at |v₂| T_b/2 behind it. The motion begins with v₁ and ends
    with the last velocity: it is not at rest there.

    Args:
        points: (m, n) in order [m or rad], m ≥ 3.
        speeds: (m − 1,) on the segments [m/s or rad/s], or one for all.
        blend_times: (m − 2,) T_b at the inner points [s], or one for all.

    Raises:
        InputError: consecutive points are the same, a speed or a time is not positive, or a blend is longer than a
            segment.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, chapter 8.
    """
    points = point("points", points, (None, None), "one point a row")
    steps = steps_between(points)
    if len(points) < 3:
        raise InputError("overfly takes three points at least: there is none to pass over between two")
    speed = _positive("speeds", speeds, len(steps))
    blend = _positive("blend_times", blend_times, len(steps) - 1)
    before, after = speed[:-1] * blend / 2, speed[1:] * blend / 2
    refuse_overlap(steps, before, after)
    v = np.diff(points, axis=0) * (speed / steps)[:, None]
    starts = points[:-1] + v * np.concatenate([[0.0], blend / 2])[:, None]
    straight = steps / speed - np.concatenate([blend, [0.0]]) / 2 - np.concatenate([[0.0], blend]) / 2
    pieces = []
    for i, (v1, v2) in enumerate(pairwise([*v, v[-1]])):
        if straight[i] > 1e-9 * steps[i] / speed[i]:
            pieces.append(PolynomialTrajectory(np.array([starts[i], v1 * straight[i]]), float(straight[i])))
        if i < len(blend):
            Tb = float(blend[i])
            corner = points[i + 1] - v1 * Tb / 2
            pieces.append(PolynomialTrajectory(np.array([corner, v1 * Tb, (v2 - v1) * Tb / 2]), Tb))
    return PiecewiseTrajectory(tuple(pieces))


def _positive(name: str, value: npt.ArrayLike, n: int) -> Array:
    array = moderate(name, per_joint(name, value, n))
    if (array < 1 / LARGEST).any():
        raise InputError(f"{name} must be positive; it is {array.tolist()}")
    return array
