"""Joints that move at constant velocities between via points, with a constant acceleration near each point."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robotics1.curves.later import LaterMotion
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.curves.stack import JointTrajectory
from robotics1.errors import InputError
from robotics1.inputs import Array, positive_numbers
from robotics1.trajectories.splines import timed_points

ROUNDING = 1e-12  # of a segment's duration: blends that overlap by less meet


def linear_segments_with_blends(
    times: npt.ArrayLike,
    points: npt.ArrayLike,
    *,
    acceleration: npt.ArrayLike | None = None,
    blend_times: npt.ArrayLike | None = None,
) -> JointTrajectory | LaterMotion:
    """Return the motion at rest at both ends that passes near the points in between: lines with parabolic blends.

    At an inner point the velocity changes from v_{k−1} = (q_k − q_{k−1})/(t_k − t_{k−1}) to v_k during the blend time
    T_k = |v_k − v_{k−1}|/A, half of it before t_k: the joint passes q_k at the distance |v_k − v_{k−1}| T_k/8. The
    first blend begins, and the last ends, at rest at its point, so that v₀ = (q₁ − q₀)/(t₁ − t₀ − T₀/2). Between two
    points it is the trapezoidal law.

    Give the accelerations, or the blend times.

    Args:
        times: (m,) of the points, ascending [s]; from t₀ ≠ 0 the motion is a `LaterMotion`.
        points: (m, n), or (m,) of one joint [rad or m].
        acceleration: A > 0 of each joint in every blend, (n,) or one number [rad/s² or m/s²].
        blend_times: T₀, ..., T_{m−1} of all joints, (m,) or one number [s].

    Raises:
        InputError: shapes do not agree, times do not ascend, an acceleration is too small for the first or the last
            segment, or two blends overlap.

    Source: Craig, Introduction to Robotics, 2005, section 7.3 (linear function with parabolic blends for a path with
    via points); Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.2.
    """
    t, q, start = timed_points(times, points)
    steps, moves = np.diff(t), np.diff(q, axis=0)
    if acceleration is not None and blend_times is None:
        A = positive_numbers("acceleration", acceleration, q.shape[1])
        blends = np.column_stack([_blends(steps, move, a) for move, a in zip(moves.T, A, strict=True)])
    elif blend_times is not None and acceleration is None:
        blends = np.tile(positive_numbers("blend_times", blend_times, len(t))[:, None], (1, q.shape[1]))
    else:
        raise InputError("give acceleration= or blend_times=, one of them")
    inside = steps[:, None] - (blends[:-1] + blends[1:]) / 2
    inside[0] -= blends[0] / 2  # the first and the last blend are within their segments
    inside[-1] -= blends[-1] / 2
    if (inside < -ROUNDING * steps[:, None]).any():
        k, j = (int(i[0]) for i in np.nonzero(inside < -ROUNDING * steps[:, None]))
        raise InputError(
            f"the blends of joint {j} overlap in the segment from t = {t[k] + start:g} to {t[k + 1] + start:g} by "
            f"{-inside[k, j]:g} s: a larger acceleration, shorter blends or more time for the segment separate them"
        )
    law = JointTrajectory(tuple(_law(q[:, j], steps, blends[:, j], inside[:, j]) for j in range(q.shape[1])))
    return LaterMotion(law, start) if start else law


def _blends(steps: Array, moves: Array, A: float) -> Array:
    """Return the blend times T_k (m,) of one joint, for an acceleration ±A in each blend."""
    last = len(steps) - 1
    v = moves / steps
    ends = []
    for k in dict.fromkeys((0, last)):
        size, step, both = abs(moves[k]), steps[k], 4 if last == 0 else 2
        if A * step**2 < both * size * (1 - ROUNDING):
            raise InputError(
                f"acceleration must be at least {both * size / step**2:g} for a distance of {size:g} in {step:g} s "
                f"from or to rest; it is {A:g}"
            )
        root = np.sqrt(max(0.0, step**2 - both * size / A))
        blend = (both * size / A) / (step + root)  # t − √(t² − 2Δ/A) without a difference of large numbers
        ends.append(blend / 2 if last == 0 else blend)
        if last:
            v[k] = moves[k] / (step - blend / 2)
    return np.concatenate([ends[:1], np.abs(np.diff(v)) / A, ends[-1:]])


def _law(q: Array, steps: Array, blends: Array, inside: Array) -> PiecewisePolynomial:
    """Return the motion of one joint from its points, blend times and times between blends."""
    used = steps.copy()
    used[0] -= blends[0] / 2
    used[-1] -= blends[-1] / 2
    v = np.concatenate([[0.0], np.diff(q) / used, [0.0]])
    pieces: list[tuple[npt.ArrayLike, float]] = []  # of the velocity
    for k, T in enumerate(blends):
        if T > 0:
            pieces.append(([v[k], v[k + 1] - v[k]], float(T)))
        if k < len(inside) and inside[k] > ROUNDING * steps[k]:
            pieces.append(([v[k + 1]], float(inside[k])))
    return PiecewisePolynomial.from_pieces(pieces).integral(q[0])
