"""A planar arm as motions of the complex plane: p(q) = g₁(q₁) ∘ … ∘ gₙ(qₙ) (p₀), with z = x + i y.

A revolute joint about c is g(z) = c + e^{±iq} (z − c), a prismatic joint along d is g(z) = z + q d. The centres c, the
directions d and the tip p₀ are those of the arm at q = 0 (a product of exponentials).
"""

from cmath import exp
from dataclasses import dataclass

from robotics1.workspaces.axes import CLOSED


@dataclass(frozen=True)
class PlanarJoint:
    """A joint that moves the tip in the plane.

    Attributes:
        number: its place in q.
        name: its name.
        revolute: whether it turns.
        place: the centre c, or the unit vector d.
        sign: ±1, the direction in which a positive q turns; 1 of a prismatic joint.
        lower, upper: its range [rad or m].
        circular: whether it can make a full turn, so that it has no limits.
    """

    number: int
    name: str
    revolute: bool
    place: complex
    sign: int
    lower: float
    upper: float
    circular: bool

    def move(self, z: complex, value: float) -> complex:
        """Return g(z) at a value of the joint."""
        if self.revolute:
            return self.place + exp(1j * self.sign * value) * (z - self.place)
        return z + value * self.place

    def turn(self, direction: complex, value: float) -> complex:
        """Return how a direction is turned by g."""
        return direction * exp(1j * self.sign * value) if self.revolute else direction

    def limit_at(self, value: float) -> str:
        """Return "lower" or "upper" if the value is that limit, else ""."""
        if self.circular:
            return ""
        return "lower" if abs(value - self.lower) < CLOSED else "upper" if abs(value - self.upper) < CLOSED else ""
