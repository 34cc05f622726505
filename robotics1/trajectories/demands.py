"""What a motion asks of a bound."""

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, real_array
from robotics1.trajectories.quantities import LARGEST, moderate

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


def positive_bound(name: str, value: npt.ArrayLike | None, n: int | None = None) -> Array:
    """Return a bound as positive numbers, (n,), or as many as it has for n = None; infinite where there is none.

    Raises:
        InputError: it is not positive, or of another length.
    """
    if value is None:
        return np.full(n or 1, np.inf)
    what = f"the bound on the {name.replace('_', ' ')}"
    shape = () if dimensions(what, value) == 0 else (n,)
    raw = np.asarray(value)
    unbounded = np.isposinf(raw) if raw.dtype.kind == "f" else np.zeros(raw.shape, dtype=bool)
    finite = np.where(unbounded, 1.0, raw) if unbounded.any() else value
    bound = real_array(what, finite, shape, "one number for all, or one for each joint")
    if not (bound > 0).all() or bound.size == 0:
        raise InputError(f"{what} must be positive; it is {bound.tolist()}")
    moderate(what, bound, smallest=1 / LARGEST)
    bound[unbounded] = np.inf
    return bound if n is None else np.broadcast_to(bound, (n,)).copy()
