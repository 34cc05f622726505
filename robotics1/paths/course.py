"""What goes along a parameter s ∈ [0, end]: its value, and its derivatives with respect to s, one-sided at breaks."""

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, dimensions, one_of, real_array

SAME_PLACE = 1e-9  # of the end: a parameter so little beyond it is the end
SAME_BREAK = 1e-11  # of the end: a parameter so near to a break is the break


class Course(ABC):
    """A value that depends on a parameter s, 0 ≤ s ≤ end.

    At a break a derivative jumps; `side` says from which side it is taken there: "right", the default, or "left".
    """

    @property
    @abstractmethod
    def end(self) -> float:
        """The last value of s."""

    @property
    def breaks(self) -> Array:
        """The parameters inside (0, end) at which a derivative may jump."""
        return np.empty(0)

    def __call__(self, s: npt.ArrayLike, *, side: str = "right") -> Any:
        """Return the value at s, or a sequence of k values for (k,) parameters.

        Raises:
            InputError: a parameter is outside [0, end].
        """
        parameters, alone = self._parameters(s, side)
        values = self._value(parameters, side)
        return values[0] if alone else values

    def derivative(self, s: npt.ArrayLike, order: int = 1, *, side: str = "right") -> Array:
        """Return the derivative of an order with respect to s: (n,) for a number, (k, n) for (k,) parameters.

        The order 0 is the value.

        Raises:
            InputError: a parameter is outside [0, end], or the order is not known.
        """
        parameters, alone = self._parameters(s, side)
        known = counting_number("order", order)
        values = self._derivative(parameters, known, side) if known else self._value(parameters, side)
        return values[0] if alone else values

    @abstractmethod
    def _value(self, s: Array, side: str) -> Any:
        """The values at s, (k,)."""

    @abstractmethod
    def _derivative(self, s: Array, order: int, side: str) -> Array:
        """The derivatives of this order ≥ 1 at s, (k, n)."""

    def _parameters(self, s: npt.ArrayLike, side: str) -> tuple[Array, bool]:
        """Return s as (k,), moved on the break that is near, and whether it was one number."""
        one_of("side", side, ("right", "left"))
        dims = dimensions("s", s)
        parameters = np.atleast_1d(real_array("s", s, (None,) * min(dims, 1), "one parameter or several"))
        slack = SAME_PLACE * self.end
        if parameters.size and (parameters.min() < -slack or parameters.max() > self.end + slack):
            raise InputError(f"s must be in [0, {self.end:.10g}]; it is {parameters.tolist()}")
        for place in self.breaks:
            parameters[np.abs(parameters - place) <= SAME_BREAK * self.end] = place
        return np.clip(parameters, 0.0, self.end), dims == 0


def piece_at(starts: Array, s: Array, side: str) -> npt.NDArray[np.int_]:
    """Return which piece each s belongs to, (k,), of pieces that begin at `starts` (m,), the first at 0."""
    return np.clip(np.searchsorted(starts, s, side="right" if side == "right" else "left") - 1, 0, len(starts) - 1)


def chain_rule(inner: tuple[Array, ...], outer: tuple[Array, ...]) -> Array:
    """Return the derivative of p(s(t)) of order 1, 2 or 3, (k, n), from those of p and of s up to that order.

    ṗ = p' ṡ; p̈ = p'' ṡ² + p' s̈; p⃛ = p''' ṡ³ + 3 p'' ṡ s̈ + p' s⃛.

    Args:
        inner: ṡ, s̈, s⃛, each (k,).
        outer: p', p'', p''', each (k, n).
    """
    v, *rest = (x[:, None] for x in inner)
    if not rest:
        return outer[0] * v
    if len(rest) == 1:
        return outer[1] * v**2 + outer[0] * rest[0]
    return outer[2] * v**3 + 3 * outer[1] * v * rest[0] + outer[0] * rest[1]
