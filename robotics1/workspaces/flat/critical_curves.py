"""Arcs and segments that one joint draws while the others stand still: what the boundary of a workspace is made of.

The workspace of joints k, …, n is that of the joints after k, moved by joint k. Its boundary is among:
- the curves of the joints after k, moved to a limit of joint k;
- what joint k draws with their ends;
- what joint k draws with those of their points where it moves along the curve: there the columns of J are parallel, so
  that the joints that are not at a limit are singular together.
"""

from cmath import exp, phase
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import tau

from robotics1.workspaces.axes import CLOSED
from robotics1.workspaces.flat.planar_joints import PlanarJoint

TOLERANCE = 1e-9  # of lengths, when the arm is one long


@dataclass(frozen=True)
class CriticalCurve:
    """An arc, counter-clockwise, or a segment. The parameter t is the angle [rad], or the distance, from its start.

    Attributes:
        centre: of the arc; None of a segment.
        start: the point at t = 0.
        direction: of a segment, a unit vector.
        length: the largest t: angle or distance.
        q: the joints' values at t = 0.
        joint: the joint that moves along the curve, as a place in q.
        rate: dq/dt of that joint, ±1.
        limits: the joints at a limit, (place in q, "lower" or "upper").
    """

    centre: complex | None
    start: complex
    direction: complex
    length: float
    q: tuple[float, ...]
    joint: int
    rate: int
    limits: tuple[tuple[int, str], ...] = ()

    @property
    def closed(self) -> bool:
        """Whether it is a full circle."""
        return self.centre is not None and self.length >= tau - CLOSED

    @property
    def radius(self) -> float:
        """The radius; infinite of a segment."""
        return float("inf") if self.centre is None else abs(self.start - self.centre)

    @property
    def size(self) -> float:
        """The length of the curve in the plane."""
        return self.length if self.centre is None else self.length * self.radius

    def point(self, t: float) -> complex:
        """Return the point at t."""
        if self.centre is None:
            return self.start + t * self.direction
        return self.centre + (self.start - self.centre) * exp(1j * t)

    def tangent(self, t: float) -> complex:
        """Return the unit tangent at t."""
        return self.direction if self.centre is None else 1j * (self.point(t) - self.centre) / self.radius

    def configuration(self, t: float) -> tuple[float, ...]:
        """Return q at t."""
        q = list(self.q)
        q[self.joint] += self.rate * t
        return tuple(q)

    def part(self, a: float, b: float) -> "CriticalCurve":
        """Return the curve from t = a to t = b."""
        return replace(self, start=self.point(a), length=b - a, q=self.configuration(a))

    def position(self, z: complex) -> float | None:
        """Return t of a point on the circle or line; None if it is beyond the ends."""
        if self.centre is None:
            t, near = ((z - self.start) * self.direction.conjugate()).real, TOLERANCE
        else:
            t, near = phase((z - self.centre) / (self.start - self.centre)) % tau, TOLERANCE / self.radius
            if t > tau - near:
                t = 0.0
        if -near <= t <= self.length + near:
            return min(max(t, 0.0), self.length)
        return None

    def moved(self, joint: PlanarJoint, value: float, limit: str) -> "CriticalCurve":
        """Return the curve when a joint before it is at a limit."""
        q = list(self.q)
        q[joint.number] = value
        return replace(
            self,
            centre=None if self.centre is None else joint.move(self.centre, value),
            start=joint.move(self.start, value),
            direction=joint.turn(self.direction, value),
            q=tuple(q),
            limits=(*self.limits, (joint.number, limit)),
        )

    def distance(self, z: complex) -> float:
        """Return the least distance of a point from the curve."""
        return min(abs(self.point(t) - z) for t in self.extreme_positions(z))

    def farthest(self, z: complex) -> float:
        """Return the largest distance of a point from the curve."""
        return max(abs(self.point(t) - z) for t in self.extreme_positions(z))

    def extreme_positions(self, z: complex) -> list[float]:
        """Return t of the ends, and of where the distance from a point is stationary.

        Of an arc about the point, whose distance is the same everywhere, it is the middle.
        """
        if self.centre is None:
            points = [self.start + ((z - self.start) * self.direction.conjugate()).real * self.direction]
        elif abs(z - self.centre) < TOLERANCE:
            return [self.length / 2]
        else:
            towards = (z - self.centre) / abs(z - self.centre) * self.radius
            points = [self.centre + towards, self.centre - towards]
        return [0.0, self.length, *(t for t in map(self.position, points) if t is not None)]

    def tangent_positions(self, joint: PlanarJoint) -> list[float]:
        """Return t of the points that the joint moves along the curve, where these are single points."""
        if joint.revolute and self.centre is None:
            points = [self.start + ((joint.place - self.start) * self.direction.conjugate()).real * self.direction]
        elif self.centre is None:
            points = []
        else:
            towards = self.centre - joint.place if joint.revolute else 1j * joint.place
            if abs(towards) < TOLERANCE:
                return []
            across = towards / abs(towards) * self.radius
            points = [self.centre + across, self.centre - across]
        return [t for t in map(self.position, points) if t is not None]


def drawn_by(
    joint: PlanarJoint,
    z: complex,
    q: tuple[float, ...],
    limits: tuple[tuple[int, str], ...] = (),
    *,
    back: bool = False,
) -> CriticalCurve | None:
    """Return what a joint draws with a point, g(q)(z), or with `back` g(q)⁻¹(z); None if the point is on its axis."""
    span, centre = joint.upper - joint.lower, joint.place if joint.revolute else None
    if joint.revolute:
        sign = -joint.sign if back else joint.sign
        first = joint.lower if sign > 0 else joint.upper
        start = joint.place + exp(1j * sign * first) * (z - joint.place)
        if abs(start - joint.place) < TOLERANCE:
            return None
        direction, rate = 1 + 0j, sign
        span = min(span, tau)
    else:
        first, rate = (joint.upper, -1) if back else (joint.lower, 1)
        start, direction = z + (-first if back else first) * joint.place, joint.place
    values = list(q)
    values[joint.number] = first
    return CriticalCurve(centre, start, direction, span, tuple(values), joint.number, rate, limits)


def swept(joint: PlanarJoint, curves: list[CriticalCurve], joints: dict[int, PlanarJoint]) -> Iterator[CriticalCurve]:
    """Yield the critical curves of the workspace that a joint makes of one with these critical curves."""
    for curve in curves:
        if not joint.circular:
            yield curve.moved(joint, joint.lower, "lower")
            yield curve.moved(joint, joint.upper, "upper")
        for t, limits in [*_ends(curve, joints), *((t, curve.limits) for t in curve.tangent_positions(joint))]:
            drawn = drawn_by(joint, curve.point(t), curve.configuration(t), limits)
            if drawn is not None:
                yield drawn


def _ends(curve: CriticalCurve, joints: dict[int, PlanarJoint]) -> Iterator[tuple[float, tuple[tuple[int, str], ...]]]:
    """Yield the ends of a curve where its joint is at a limit."""
    for t in (0.0, curve.length):
        limit = joints[curve.joint].limit_at(curve.configuration(t)[curve.joint])
        if limit:
            yield t, (*curve.limits, (curve.joint, limit))
