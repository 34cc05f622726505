"""A screw: the axis, the pitch and the size of a displacement or of a twist."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, moderate
from robotics1.notation import joint_value, number, vector
from robotics1.orientation.elementary import unit_vector
from robotics1.orientation.nearest import ROUNDING
from robotics1.results import Frozen
from robotics1.rigid_motions.changes_of_frame import linear_first
from robotics1.rigid_motions.exponential import pose_log

SMALLEST_TURN = 1e-200  # rad/m of a slide: with less, the axis is nowhere


@dataclass(frozen=True, eq=False)
class Screw(Frozen):
    """A turn about an axis with a slide along it.

    Attributes:
        axis: (3,) the unit vector r along the axis; None of no motion, which has every axis.
        point: (3,) the point of the axis that is nearest to the origin [m]; zero of a slide alone, which has no place.
        angle: θ ≥ 0, the turn about the axis [rad, or rad/s of a twist].
        distance: d, the slide along the axis [m, or m/s]; negative against r.
    """

    axis: Array | None
    point: Array
    angle: float
    distance: float

    @property
    def pitch(self) -> float:
        """The pitch h = d/θ, the slide per turned angle [m/rad]: 0 of a turn alone, ∞ of a slide alone."""
        return self.distance / self.angle if self.angle > 0 else np.inf

    @property
    def twist(self) -> Array:
        """(6,) the unit screw S = (v, ω) = (−r × point + h r, r), with V = S θ; of a slide (r, 0), with V = S d."""
        if self.axis is None:
            return np.zeros(6)
        if self.angle == 0:
            return np.concatenate([self.axis, np.zeros(3)])
        return np.concatenate([np.cross(self.point, self.axis) + self.pitch * self.axis, self.axis])

    def explain(self) -> str:
        """Return what the motion is, in a sentence."""
        if self.axis is None:
            return "no motion: every axis is one of it"
        if self.angle == 0:
            return f"a slide by {number(self.distance)} along {vector(self.axis)}; its pitch is infinite"
        turn = f"a turn by {joint_value(self.angle)} about the axis through {vector(self.point)} along "
        return (
            f"{turn}{vector(self.axis)}, with a slide by {number(self.distance)}: the pitch is {self.pitch:.6g} m/rad"
        )


def twist_screw(V: npt.ArrayLike, *, angular_first: bool = False) -> Screw:
    """Return the screw of a twist: r = ω/|ω|, point = r × v/|ω|, d = rᵀv; without ω, r = v/|v| and d = |v|.

    Args:
        V: (6,) v [m or m/s] and ω [rad or rad/s].
        angular_first: V is (ω, v), as Lynch and Park write it; otherwise (v, ω).

    Raises:
        InputError: V is not six finite numbers, or one is larger than 1e30.

    Source: Lynch, Park, Modern Robotics, 2017, section 3.3.2.
    """
    twist = moderate("V", linear_first("V", V, angular_first))
    v, omega = twist[:3], twist[3:]
    theta, slide = float(np.hypot.reduce(omega)), float(np.hypot.reduce(v))
    if theta > SMALLEST_TURN * slide:
        r = unit_vector("ω", omega)
        return Screw(r, np.cross(r, v) / theta + 0.0, theta, float(r @ v))
    if slide == 0:
        return Screw(None, np.zeros(3), 0.0, 0.0)
    return Screw(unit_vector("v", v), np.zeros(3), 0.0, slide)


def displacement_screw(T: Any) -> Screw:
    """Return the screw of a displacement T, by which the identity moves to T: every one is a turn with a slide.

    A turn counts as none where rounding, 2e-15 rad, leaves no more of it.

    Args:
        T: a `pin.SE3`, or a homogeneous matrix (4, 4); T_1 T_0⁻¹ of a motion from T_0 to T_1, in world axes.

    Raises:
        InputError: T is no pose.

    Source: Chasles' theorem; Lynch, Park, Modern Robotics, 2017, section 3.3.3.
    """
    V = pose_log(T)
    if np.linalg.norm(V[3:]) <= ROUNDING:
        V[3:] = 0.0
    return twist_screw(V)
