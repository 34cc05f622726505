"""The steps of Denavit and Hartenberg: from a frame on one axis, along the common normal, to the next axis.

A step is a screw along z and a screw along x, Rot_z(θ) Trans_z(d) · Rot_x(α) Trans_x(a). Seen from the frame that the
step starts from, the next axis goes through p with the direction u, and

    not parallel:  x = z × u / |z × u|,  a = p·x,  α = ∠(z, u) about x,  d where x meets the z axis
    parallel:      x from axis to axis,  a = their distance,  α = 0 or π,  d = 0
    coincident:    x as it was, a = d = 0

Lengths are in the size of the arm.
"""

from dataclasses import dataclass
from math import atan2, hypot, inf, log10, pi

import numpy as np
import pinocchio as pin

from robotics1.angles import clean_angle
from robotics1.dh.table import X, Z, screw
from robotics1.inputs import Array

NEAR_TOOL = 1e-6  # rad and sizes: base and tool placement make up for what is overlooked, so that it costs nothing
FAR = 1000.0  # sizes: axes with a common normal farther away are parallel but for the digits of the file


@dataclass(frozen=True)
class Axis:
    """A line: through `point`, with the unit vector `direction`."""

    point: Array
    direction: Array

    def seen_from(self, T: pin.SE3) -> "Axis":
        """Return the line in the coordinates of the frame T."""
        return Axis(T.actInv(self.point), T.rotation.T @ self.direction)

    def at_height_zero(self) -> Array:
        """Return where a line that is about parallel to z meets the plane z = 0, (x, y)."""
        return np.asarray((self.point - self.point[2] / self.direction[2] * self.direction)[:2])


@dataclass(frozen=True)
class Step:
    """Rot_z(theta) Trans_z(d) · Rot_x(alpha) Trans_x(a)."""

    theta: float = 0.0
    d: float = 0.0
    alpha: float = 0.0
    a: float = 0.0

    @property
    def along_z(self) -> pin.SE3:
        """Rot_z(θ) Trans_z(d)."""
        return screw(Z, self.theta, self.d)

    @property
    def along_x(self) -> pin.SE3:
        """Rot_x(α) Trans_x(a)."""
        return screw(X, self.alpha, self.a)

    @property
    def other_way(self) -> "Step":
        """The step to the same axis with x turned round: Rot_z(θ + π) ... Rot_x(−α) Trans_x(−a)."""
        theta = clean_angle(self.theta - pi if self.theta > 0 else self.theta + pi)
        return Step(theta, self.d, (self.alpha if self.alpha == pi else -self.alpha) + 0.0, -self.a + 0.0)

    @property
    def keeps_parallel(self) -> bool:
        """Whether the two axes are taken as parallel."""
        return abs(self.alpha) in (0.0, pi)

    def in_metres(self, unit: float) -> "Step":
        """Return the step with its lengths in metres; they are in the unit [m]."""
        a, d = (round(length * unit, _decimals(unit)) + 0.0 for length in (self.a, self.d))
        return Step(self.theta, d, self.alpha, a)

    @property
    def placement(self) -> pin.SE3:
        """The next frame in this one."""
        return self.along_z * self.along_x


def step_to(axis: Axis, parallel: float, coincident: float, far: float = inf) -> Step:
    """Return the step from the z axis to another, with |θ| ≤ π/2.

    Args:
        axis: the next axis, seen from this frame.
        parallel: the sine of the angle below which two axes are parallel.
        coincident: the distance below which parallel axes are one.
        far: d, beyond which axes are parallel too: their common normal is where the digits of the file put it.
    """
    p, u = axis.point, axis.direction
    s = hypot(u[0], u[1])
    d = float(p[2] - (p[0] * u[0] + p[1] * u[1]) / s**2 * u[2]) if s > parallel else inf
    if abs(d) <= far and d < inf:
        x = np.array([-u[1], u[0], 0.0]) / s
        return _turned_least(atan2(x[1], x[0]), d, atan2(s, u[2]), float(p @ x))
    alpha = 0.0 if u[2] > 0 else pi
    r = axis.at_height_zero()
    distance = hypot(*r)
    return _turned_least(atan2(r[1], r[0]), 0.0, alpha, distance) if distance > coincident else Step(alpha=alpha)


def first_step(axis: Axis) -> tuple[pin.SE3, Step]:
    """Return the placement of the base and the step from there to the first axis, seen from the world.

    A first axis parallel to the world's z needs only a base that is shifted.
    """
    step, u = step_to(axis, NEAR_TOOL, NEAR_TOOL, FAR), axis.direction
    if not step.keeps_parallel:
        return pin.SE3.Identity(), step
    up = u if u[2] > 0 else -u
    tilt = pin.Quaternion.FromTwoVectors(Z, up).toRotationMatrix()
    return pin.SE3(tilt, np.array([*axis.at_height_zero(), 0.0])), Step(alpha=0.0 if u[2] > 0 else pi)


def last_step(T: pin.SE3) -> Step:
    """Return the step from the last axis towards the tool T, seen from the frame on that axis.

    It goes to the tool's z axis; where the axes are parallel it reaches the tool's origin, and where they are one its
    x axis too, so that nothing or a turn about z is left for the tool placement. No half turn is left.
    """
    step = step_to(Axis(T.translation, T.rotation[:, 2]), NEAR_TOOL, NEAR_TOOL, FAR)
    if step.placement.actInv(T).rotation[0, 0] < NEAR_TOOL**2 - 1:
        step = step.other_way
    if not step.keeps_parallel:
        return step
    d = round(float(T.translation[2]), 14)
    theta = step.theta if step.a else clean_angle(atan2(T.rotation[1, 0], T.rotation[0, 0]))
    return Step(theta, d, step.alpha, step.a)


def clean_placement(T: pin.SE3, unit: float = 1.0) -> pin.SE3:
    """Return T without the last digit, so that zeros and ones are such; its lengths have the size of the unit."""
    return pin.SE3(np.round(T.rotation, 15) + 0.0, np.round(T.translation, _decimals(unit)) + 0.0)


def in_metres(T: pin.SE3, unit: float) -> pin.SE3:
    """Return T with its lengths in metres; they are in the unit [m]."""
    return clean_placement(pin.SE3(T.rotation, T.translation * unit), unit)


def _decimals(unit: float) -> int:
    """Return up to which decimal a length is no rounding; 14 in a unit of one metre."""
    return 14 - round(log10(unit))


def _turned_least(theta: float, d: float, alpha: float, a: float) -> Step:
    """Return the step along x or along −x: with |θ| ≤ π/2, then a > 0, then θ = π/2; without the last digit."""
    theta, alpha, a = clean_angle(theta), clean_angle(alpha), round(a, 14)
    right = abs(theta) == pi / 2
    if (right and (a < 0 or (a == 0 and theta < 0))) or abs(theta) > pi / 2:
        return Step(theta, round(d, 14) + 0.0, alpha, a).other_way
    return Step(theta + 0.0, round(d, 14) + 0.0, alpha + 0.0, a + 0.0)
