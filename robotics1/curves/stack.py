"""Curves side by side: joints that each have a law of their own, coordinates of several paths."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.caching import cached_property
from robotics1.curves.composition import stretched
from robotics1.curves.curve import SAME_BREAK, Curve
from robotics1.curves.given import as_law, as_path
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, positive_number

SAME_DURATION = 1e-9  # relative


@dataclass(frozen=True, eq=False)
class StackedCurve(Curve):
    """The coordinates of several curves one after the other; a curve that ends before the last one stays where it is.

    Attributes:
        curves: of numbers or of points.
    """

    curves: tuple[Curve, ...]

    def __post_init__(self) -> None:
        """Refuse a coordinate that would have to stop at once."""
        for i, curve in enumerate(self.curves):
            if not self._stays(curve):
                continue
            v1 = np.atleast_1d(curve.derivative(curve.end, side="left"))
            if (np.abs(v1) > 1e-9 * np.abs(curve.extremes(1)[1]).max(axis=0)).any():
                raise InputError(
                    f"joint {i} arrives at {curve.end:g} s with the velocity {np.abs(v1).max():g}, before the others, "
                    "and cannot stay; let all joints take the same time"
                )

    @cached_property
    def end(self) -> float:
        """T, of the longest curve."""
        return max(curve.end for curve in self.curves)

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,), the sum of the dimensions."""
        return (sum(curve.dimension for curve in self.curves),)

    @cached_property
    def breakpoints(self) -> Array:
        """The parameters inside (0, T) at which a derivative of some coordinate jumps; without those that are one."""
        ends = [curve.end for curve in self.curves if self._stays(curve)]
        ordered = np.unique(np.concatenate([[self.end], ends, *(curve.breakpoints for curve in self.curves)]))
        apart = np.diff(ordered, prepend=0.0) > SAME_BREAK * self.end
        return np.asarray(ordered[:-1][apart[:-1] & (self.end - ordered[:-1] > SAME_BREAK * self.end)])

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return those of each curve; the derivatives of a curve that stays are zero."""
        found = []
        for curve in self.curves:
            times, values = (x.reshape(2, curve.dimension).copy() for x in curve.extremes(order))
            if order and self._stays(curve):
                beyond = np.array([values[0] > 0, values[1] < 0])
                times[beyond], values[beyond] = curve.end, 0.0
            found.append((times, values))
        times, values = (np.hstack(parts) for parts in zip(*found, strict=True))
        return times, values

    def stretched(self, factor: float) -> "StackedCurve":
        """Return q(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        return type(self)(tuple(stretched(curve, factor) for curve in self.curves))

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        columns = []
        for curve in self.curves:
            values = curve._derivative(curve._snapped(t), order, side).reshape(len(t), curve.dimension)
            if order and self._stays(curve):
                ended = t >= curve.end if side == "right" else t > curve.end
                values = np.where(ended[:, None], 0.0, values)
            columns.append(values)
        return np.hstack(columns)

    def _stays(self, curve: Curve) -> bool:
        """Return whether a curve ends before the last one."""
        return curve.end < self.end * (1 - SAME_DURATION)


@dataclass(frozen=True, eq=False)
class JointTrajectory(StackedCurve):
    """q(t) = (s₁(t), ..., sₙ(t)); a joint whose law ends before the last one's stays where it is.

    Attributes:
        curves: one timing law for each joint.
    """

    def __post_init__(self) -> None:
        """Read the laws.

        Raises:
            InputError: they are no laws, or a joint would have to stop at once.
        """
        listed = tuple(self.curves) if isinstance(self.curves, Sequence) else ()
        if not listed:
            raise InputError(f"laws must be one timing law for each joint; they are {self.curves!r}")
        object.__setattr__(self, "curves", tuple(as_law("a law", law) for law in listed))
        super().__post_init__()

    @property
    def laws(self) -> tuple[Curve, ...]:
        """The laws of the joints."""
        return self.curves

    def _joint(self, index: int) -> Curve:
        return self.laws[index]


def stacked_path(paths: Sequence[Curve], end: float | None = None) -> StackedCurve:
    """Return the coordinates of several paths, (n₁ + n₂ + …), passed together: each from its start to its end.

    The k-th path is at s endₖ/end. `stacked_path([path], 1.0)` is a path over [0, 1].

    Args:
        paths: such as that of a position and that of an angle.
        end: the last s; by default that of the first path, whose parameter s then is.

    Raises:
        InputError: they are no paths, or the end is not positive.
    """
    listed = [as_path("each of paths", path) for path in paths] if isinstance(paths, Sequence) else []
    if not listed:
        raise InputError(f"paths must be one path or several, such as line_path(...); they are {paths!r}")
    last = listed[0].end if end is None else positive_number("end", end)
    return StackedCurve(tuple(path if path.end == last else stretched(path, last / path.end) for path in listed))
