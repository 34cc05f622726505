"""How a target moves: its position and velocity at any time."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, answer_of, real_array
from robotics1.results import Frozen


class TargetMotion(Protocol):
    """A moving target: p(t), in the form of a task's value, and its velocity ṗ(t). A trajectory is one too."""

    def __call__(self, t: float) -> Any:
        """Return p(t)."""

    def velocity(self, t: float) -> Array:
        """Return ṗ(t), (m,)."""


@dataclass(frozen=True, eq=False)
class LinearMotion(Frozen):
    """p(t) = p0 + v t: a straight line at constant speed.

    Attributes:
        p0: (m,) position at t = 0 [m].
        v: (m,) velocity [m/s].
    """

    p0: npt.ArrayLike
    v: npt.ArrayLike

    def __post_init__(self) -> None:
        """Refuse a position and a velocity of different lengths."""
        p0 = real_array("p0", self.p0, (None,), "the position at t = 0")
        object.__setattr__(self, "p0", p0)
        object.__setattr__(self, "v", real_array("v", self.v, p0.shape, "as long as p0"))
        super().__post_init__()

    def __call__(self, t: float) -> Array:
        """Return p(t), (m,) [m]."""
        return np.asarray(self.p0) + np.asarray(self.v) * t

    def velocity(self, t: float) -> Array:
        """Return v, (m,) [m/s]."""
        return np.asarray(self.v)


@dataclass(frozen=True)
class FunctionMotion:
    """p(t) and ṗ(t) as two functions.

    Attributes:
        position: t [s] → p, in the form of the task's value.
        rate: t [s] → ṗ (m,).
    """

    position: Callable[[float], Any]
    rate: Callable[[float], npt.ArrayLike]

    def __post_init__(self) -> None:
        """Refuse what cannot be called."""
        if not all(callable(f) and not isinstance(f, type) for f in (self.position, self.rate)):
            raise InputError("FunctionMotion takes two functions of t: the position and its velocity")

    def __call__(self, t: float) -> Any:
        """Return p(t)."""
        return answer_of("the target's position", self.position, t)

    def velocity(self, t: float) -> Array:
        """Return ṗ(t), (m,)."""
        return real_array("the target's velocity", answer_of("the target's rate", self.rate, t), (None,))
