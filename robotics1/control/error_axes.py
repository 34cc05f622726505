"""The axes in which an error is split: those of the world, turned ones, or those that go along the path."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.curves.composition import PathTrajectory
from robotics1.curves.curve import Curve
from robotics1.curves.frenet import FrenetRotation, frenet_frame, frenet_path
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError, shown
from robotics1.inputs import Array, real_array
from robotics1.orientation.elementary import cross_matrix

QUARTER = np.array([[0.0, -1.0], [1.0, 0.0]])  # a turn of π/2 in the plane
ORTHONORMAL = 1e-9


class AxesAt(NamedTuple):
    """Axes at an instant: A (m, m), whose columns they are, Ȧ and Ä."""

    A: Array
    rate: Array
    acceleration: Array


@dataclass(frozen=True, eq=False)
class ErrorAxes:
    """Axes A(t): of the world, turned once and for all, or the tangent and the normals of a path.

    Attributes:
        m: how many.
        fixed: A where it is constant; None where it moves.
        motion: the path and its timing, where the axes go along.
        turning: the Frenet frame of a path in space.
        given: a motion R(t) of the user's, whose columns are the axes.
    """

    m: int
    fixed: Array | None
    motion: PathTrajectory | None = None
    turning: FrenetRotation | None = None
    given: Curve | None = None

    def at(self, t: float, side: Side = "right") -> AxesAt:
        """Return A, Ȧ and Ä."""
        if self.given is not None:
            R = np.asarray(self.given(t))
            omega, slope = (cross_matrix(self.given.derivative(t, order, side=side)) for order in (1, 2))
            return AxesAt(R, omega @ R, (slope + omega @ omega) @ R)
        if self.fixed is not None or self.motion is None:
            A = np.eye(self.m) if self.fixed is None else self.fixed
            return AxesAt(A, np.zeros((self.m, self.m)), np.zeros((self.m, self.m)))
        s = float(np.clip(self.motion.law(t), 0.0, self.motion.path.end))
        rates = tuple(float(self.motion.law.derivative(t, order, side=side)) for order in (1, 2))
        if self.turning is None:
            return _in_plane(self.motion.path, s, rates, side)
        return _in_space(self.turning, s, rates, side)


def error_axes(value: Any, m: int, motion: Curve | None) -> ErrorAxes:
    """Return the axes that a law is given: None for the world's, an (m, m) rotation, a motion R(t), or "frenet".

    Raises:
        InputError: they are none, or the error or the trajectory has no such axes.
    """
    if value is None:
        return ErrorAxes(m, np.eye(m))
    if isinstance(value, str) and value == "frenet":
        if m not in (2, 3) or not isinstance(motion, PathTrajectory) or motion.shape != (m,):
            raise InputError(
                "axes='frenet' needs two or three coordinates that follow PathTrajectory(path, law), whose path has a "
                "tangent and a normal"
            )
        path = motion.path
        if m == 3 and frenet_frame(path, 0.0).normal is None:
            return ErrorAxes(3, _about(frenet_frame(path, 0.0).tangent))
        return ErrorAxes(m, None, motion, frenet_path(path) if m == 3 else None)
    if isinstance(value, Curve):
        if m != 3 or value.of_points or value.shape != (3,) or np.shape(value(0.0)) != (3, 3):
            raise InputError("axes that move are a motion R(t) of three axes: PathTrajectory(turn_path(...), law)")
        return ErrorAxes(m, None, given=value)
    if isinstance(value, str):
        raise InputError(
            f"axes must be None, an ({m}, {m}) rotation matrix, a motion R(t), or 'frenet'; it is {shown(value)}"
        )
    A = real_array("axes", value, (m, m), "a rotation matrix whose columns are the axes")
    if not np.allclose(A.T @ A, np.eye(m), atol=ORTHONORMAL):
        raise InputError(f"axes must be orthonormal: AᵀA = 1; they are {A.tolist()}")
    return ErrorAxes(m, A)


def _in_plane(path: Curve, s: float, rates: tuple[float, ...], side: Side) -> AxesAt:
    """Return (t, n) with n a quarter turn to the left of t, at the angle ψ of the tangent: ψ' = (p' × p'')/|p'|²."""
    d1, d2, d3 = (np.asarray(path.derivative(s, order, side=side)) for order in (1, 2, 3))
    path.refuse_standstill(np.array([s]), np.array([np.linalg.norm(d1)]))
    square, slope = float(d1 @ d1), 2 * float(d1 @ d2)
    cross, growth = float(d1[0] * d2[1] - d1[1] * d2[0]), float(d1[0] * d3[1] - d1[1] * d3[0])
    bend, bend_rate = cross / square, (growth * square - cross * slope) / square**2
    turn, turn_rate = bend * rates[0], bend_rate * rates[0] ** 2 + bend * rates[1]
    tangent = d1 / np.sqrt(square)
    A = np.column_stack([tangent, QUARTER @ tangent])
    return AxesAt(A, turn * QUARTER @ A, turn_rate * QUARTER @ A - turn**2 * A)


def _in_space(turning: FrenetRotation, s: float, rates: tuple[float, ...], side: Side) -> AxesAt:
    """Return the Frenet frame (t, n, b), which turns with ω = ṡ w: Ȧ = [ω]× A, Ä = ([ω̇]× + [ω]×²) A."""
    A = frenet_frame(turning.path, s, side=side).rotation
    w, slope = (np.asarray(turning.derivative(s, order, side=side)) for order in (1, 2))
    omega = cross_matrix(rates[0] * w)
    return AxesAt(A, omega @ A, (cross_matrix(rates[0] ** 2 * slope + rates[1] * w) + omega @ omega) @ A)


def _about(tangent: npt.NDArray[Any]) -> Array:
    """Return axes, the first along a tangent, for a straight path."""
    other = np.cross(tangent, np.eye(3)[np.argmin(np.abs(tangent))])
    other /= np.linalg.norm(other)
    return np.column_stack([tangent, other, np.cross(tangent, other)])
