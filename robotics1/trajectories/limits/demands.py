"""What a motion asks of a bound."""

from dataclasses import dataclass
from typing import Any, Protocol

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "deceleration": 2, "normal acceleration": 2}
TOUCHED = 1e-6  # relative: a bound so nearly reached is active


@dataclass(frozen=True)
class Demand:
    """The most that a motion asks of one bound.

    Attributes:
        joint: its number, from 0; None for the norm of a vector.
        quantity: "velocity", "acceleration", "jerk", "deceleration" or "normal acceleration".
        value: what the motion reaches, with its sign; a norm has none.
        bound: what it should not pass.
        time: the first instant [s].
    """

    joint: int | None
    quantity: str
    value: float
    bound: float
    time: float

    @property
    def stretch(self) -> float:
        """k: the motion just touches the bound if it takes k times as long; (|value|/bound)^(1/order)."""
        return float((abs(self.value) / self.bound) ** (1 / ORDERS[self.quantity]))

    @property
    def active(self) -> bool:
        """Whether the bound is touched, to a relative 1e-6, or passed."""
        return abs(self.value) >= (1 - TOUCHED) * self.bound

    def __str__(self) -> str:
        whose = "the norm of the" if self.joint is None else f"joint {self.joint}'s"
        return f"{whose} {self.quantity} is {self.value:.6g} at t = {self.time:.4g} s, its bound {self.bound:g}"


class Limits(Protocol):
    """Bounds that a motion can be held against: MotionLimits or NormLimits."""

    def demands(self, trajectory: Any) -> tuple[Demand, ...]:
        """Return the most that a motion asks of each bound, from its exact extremes."""
