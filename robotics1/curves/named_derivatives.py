"""The derivatives of a motion in time that have names: velocity, acceleration, jerk."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, Literal

import numpy.typing as npt

Side = Literal["right", "left"]


class NamedDerivatives(ABC):
    """What has derivatives with respect to time has these three."""

    @abstractmethod
    def derivative(self, t: npt.ArrayLike, order: int = 1, *, side: Side = "right") -> Any:
        """Return the derivative of an order."""

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the first derivative, of a motion in time its velocity [per s]. Raises as `derivative`."""
        return self.derivative(t, 1, side=side)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the second derivative [per s²]. Raises as `derivative`."""
        return self.derivative(t, 2, side=side)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the third derivative [per s³]. Raises as `derivative`."""
        return self.derivative(t, 3, side=side)
