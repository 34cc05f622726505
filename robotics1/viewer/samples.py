"""Motions as samples that the page runs through."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from itertools import pairwise
from math import ceil
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.given import Motion, joint_motion
from robotics1.errors import InputError
from robotics1.inputs import Array, answer_of, real_array
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.trajectories.target_motion import TargetMotion

RATE = 60.0  # samples a second: a browser shows no more
MOST = 1200  # samples of a smooth motion; between them the page draws a cubic curve
LARGEST = 1e9  # rad, m or s: with more, single precision, which a browser draws with, tells no two places apart
SHORTEST = 1e-6  # s that a motion lasts
MOST_RECORDED = 20_000  # samples of recorded values; of more, evenly chosen ones are kept


@dataclass(frozen=True, eq=False)
class Samples(Frozen):
    """Samples of a motion.

    Attributes:
        times: (k,) instants; a breakpoint is there twice.
        q: (k, n) the values.
        rates: (k, n) the velocities, from the left and from the right at a breakpoint; None of recorded values.
    """

    times: Array
    q: Array
    rates: Array | None

    def packed(self) -> dict[str, Any]:
        """Return the samples as the page reads them."""
        return {
            "width": self.q.shape[1],
            "times": _base64(self.times),
            "values": _base64(self.q),
            "velocities": None if self.rates is None else _base64(self.rates),
        }


def samples_of(motion: Motion, robot: Robot) -> Samples:
    """Return samples of a motion of a robot's joints, between which the page draws cubic curves.

    Raises:
        InputError: the motion is not of the robot's joints, it is not finite, or too large, long or short to be drawn.
    """
    robot.require_single_coordinates("move in a page")
    curve = joint_motion("motion", motion, robot.nv)
    _duration(curve.end)
    every = ceil(len(curve.ends) / MOST)  # of many breakpoints, some
    ends = [*curve.ends[:-1:every], curve.end]
    pieces = len(ends) - 1
    times, q, rates = [], [], []
    for a, b in pairwise(ends):
        each = max(2, min(ceil((b - a) * RATE), MOST // pieces)) + 1
        t = np.linspace(a, b, each)
        times.append(t)
        q.append(_values("q(t) of the motion", curve(t), t, robot.nv))
        after = _values("q̇(t) of the motion", curve.velocity(t, side="right"), t, robot.nv)
        before = _values("q̇(t) of the motion", curve.velocity(t, side="left"), t, robot.nv)
        rates.append(np.vstack([after[:1], before[1:]]))
    return Samples(np.concatenate(times), np.vstack(q), np.vstack(rates))


def recorded(times: npt.ArrayLike | None, q: npt.ArrayLike | None, robot: Robot) -> Samples:
    """Return recorded configurations, between which the page draws straight lines.

    Raises:
        InputError: there are fewer than two, the instants do not grow, a shape is wrong, or a value is not finite or
            too large to be drawn.
    """
    if times is None or q is None:
        raise InputError(f"a recorded motion wants times and q; {'times' if times is None else 'q'} is missing")
    instants = real_array("times", times, (None,), "one instant for each configuration [s]")
    if len(instants) < 2:
        raise InputError(f"times must be two or more instants that grow [s]; there are {len(instants)}")
    if (steps := np.diff(instants)).min() <= 0:
        k = int(np.argmin(steps > 0))
        raise InputError(f"times must be instants that grow [s]; after {instants[k]:g} comes {instants[k + 1]:g}")
    _duration(instants[-1] - instants[0])
    values = _values("q", q, instants, robot.nq)
    if len(instants) > MOST_RECORDED:
        kept = np.linspace(0, len(instants) - 1, MOST_RECORDED).round().astype(int)
        instants, values = instants[kept], values[kept]
    return Samples(instants - instants[0], values, None)


def target_samples(target: TargetMotion, duration: float) -> Samples:
    """Return the positions of a moving point, with a third coordinate of zero if it has two.

    Raises:
        InputError: it is no function of time, has not two or three coordinates, or is not finite.
    """
    if not callable(target):
        raise InputError(f"the target must be a motion p(t), such as LinearMotion(p0, v); it is {target!r}")
    times = np.linspace(0.0, duration, max(2, min(ceil(duration * RATE), MOST)) + 1)
    return Samples(times, np.array([_in_space(answer_of("the target", target, float(t))) for t in times]), None)


def _duration(T: float) -> None:
    """Refuse a motion that nobody can watch."""
    if not np.isfinite(T):
        raise InputError("a motion that does not end cannot be drawn")
    if not SHORTEST <= T <= LARGEST:
        raise InputError(f"a motion must last from {SHORTEST:g} to {LARGEST:g} s to be drawn; it lasts {T:g} s")


def _values(name: str, given: Any, t: Array, n: int) -> Array:
    """Return the values at each instant, (k, n), if all can be drawn; else say where not."""
    values = np.asarray(given)
    if values.shape == (len(t), n) and values.dtype.kind == "f":
        bad = ~(np.abs(values) <= LARGEST).all(axis=1)  # which NaN is not
        if bad.any():
            k = int(bad.argmax())
            raise InputError(
                f"{name} must be finite and below {LARGEST:g}; it is {values[k].tolist()} at t = {t[k]:.6g} s"
            )
    return real_array(name, given, (len(t), n), "a value of each joint for each instant")


def _base64(values: Array) -> str:
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f8").tobytes()).decode("ascii")


def _in_space(p: npt.ArrayLike) -> Array:
    point = real_array("p(t) of the target", p, (None,), "two or three coordinates")
    if point.size not in (2, 3):
        raise InputError(f"p(t) of the target must have two or three coordinates; it has {point.size}")
    return np.pad(point, (0, 3 - point.size))
