"""A curve of one variable: a path p(s), a timing law s(t), a motion q(t), an orientation R(s), a pose T(s)."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.curves.drawing import DrawnCurve
from robotics1.curves.interpolants import Extreme, interpolants, largest
from robotics1.curves.named_derivatives import NamedDerivatives, Side
from robotics1.curves.samples import MotionSamples, motion_samples
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, dimensions, one_of, real_array

SAME_PLACE = 1e-9  # of the end: a parameter so little beyond it is the end
SAME_BREAK = 1e-11  # of the end: a parameter so near to a breakpoint is the breakpoint
SAME_SIZE = 1e-12  # relative: magnitudes so near are equal, and the earlier instant counts
STANDSTILL = 1e-12  # |p'| relative to the length over the end: slower is no motion


class Curve(NamedDerivatives, DrawnCurve):
    """x(t), 0 ≤ t ≤ end, with its derivatives: one value for a number t, k values for (k,) parameters.

    At a breakpoint a derivative jumps; `side` says from which side it is taken there: "right", the default, or "left".
    At t = end, where there is no right side, it is the left one, and at t = 0 the right one.
    """

    @property
    @abstractmethod
    def end(self) -> float:
        """The last parameter."""

    @property
    @abstractmethod
    def shape(self) -> tuple[int, ...]:
        """The shape of one derivative: () of a timing law, (n,) of n coordinates, (3,) of R(s), (6,) of T(s)."""

    @property
    def of_points(self) -> bool:
        """Whether the values are numbers or points; those of orientations and poses are not."""
        return True

    @property
    def breakpoints(self) -> Array:
        """The parameters inside (0, end) at which a derivative may jump."""
        return np.empty(0)

    @abstractmethod
    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        """The derivatives at t (k,), (k, *shape); of points and numbers those of order 0 are the values."""

    def _value(self, t: Array, side: Side) -> Any:
        return self._derivative(t, 0, side)

    def _derivatives(self, t: Array, orders: Sequence[int], side: Side) -> list[Array]:
        """The derivatives of several orders, for curves that find them together."""
        return [self._derivative(t, order, side) for order in orders]

    # --- values

    def __call__(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the value at t, or a sequence of k values for (k,) parameters.

        Raises:
            InputError: a parameter is outside [0, end].
        """
        parameters, alone = self._parameters(t, side)
        values = self._value(parameters, side)
        return values[0] if alone else values

    def derivative(self, t: npt.ArrayLike, order: int = 1, *, side: Side = "right") -> Any:
        """Return the derivative of an order: of the shape of the curve for a number, (k, *shape) for (k,) parameters.

        The order 0 is the value. Of orientations the derivative of order 1 is the angular velocity.

        Raises:
            InputError: a parameter is outside [0, end], or the order is not known.
        """
        parameters, alone = self._parameters(t, side)
        order = counting_number("order", order)
        values = self._derivative(parameters, order, side) if order else self._value(parameters, side)
        return values[0] if alone else values

    @property
    def duration(self) -> float:
        """The end, of a motion in time T [s]."""
        return self.end

    @property
    def ends(self) -> list[float]:
        """0, the breakpoints, and the end."""
        return [0.0, *self.breakpoints.tolist(), self.end]

    @property
    def dimension(self) -> int:
        """The number of coordinates of a derivative, n."""
        return int(np.prod(self.shape))

    def sample(self, rate: float, names: Sequence[str] | None = None) -> MotionSamples:
        """Return values, velocities and accelerations at t = 0, 1/rate, 2/rate, ..., and at the end.

        Args:
            rate: samples a second [Hz].
            names: of the coordinates, such as `robot.joint_names`; by default q1, q2, ...

        Raises:
            InputError: the rate is not positive, or the curve is of orientations or poses.
        """
        return motion_samples(self, rate, names)

    # --- extremes

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the parameters (2, n) and values (2, n) of each coordinate's minimum and maximum; (2,) of a number's.

        `order` 1, 2, 3 asks for those of the velocity, acceleration, jerk. Exact: between the breakpoints the
        derivative is replaced by interpolants that agree with it to rounding. Of several instants the first counts.

        Raises:
            InputError: the curve oscillates so quickly that no interpolant agrees with it, or its values are poses.
        """
        if not counting_number("order", order) and not self.of_points:
            raise InputError("orientations and poses have no least and no largest value; ask for those of a derivative")

        def column(t: Array, side: Side, j: int, sign: float) -> Array:
            return sign * np.reshape(self.derivative(t, order, side=side), (len(t), -1))[:, j]

        rows = [
            [largest(partial(column, j=j, sign=sign), self.ends) for j in range(self.dimension)] for sign in (-1.0, 1.0)
        ]
        if not all(found.resolved for row in rows for found in row):
            raise InputError("the motion oscillates too quickly for its extremes to be found")
        times = np.array([[found.time for found in row] for row in rows])
        values = np.array([[found.value for found in row] for row in rows]) * [[-1], [1]]
        return times.reshape(2, *self.shape), values.reshape(2, *self.shape)

    def peaks(self, order: int = 1) -> tuple[Extreme, ...]:
        """Return where each coordinate of a derivative is largest in magnitude; of equal ones the first."""
        times, values = (x.reshape(2, self.dimension).T for x in self.extremes(order))
        return tuple(_larger(t, x, j) for j, (t, x) in enumerate(zip(times, values, strict=True)))

    def peak(self, order: int = 1) -> Extreme:
        """Return the largest of the peaks of all coordinates."""
        peaks = self.peaks(order)
        most = max((abs(peak.value) for peak in peaks), default=0.0)
        equal = [peak for peak in peaks if abs(peak.value) >= (1 - SAME_SIZE) * most]
        return min(equal, key=lambda peak: peak.time, default=Extreme(0.0, 0.0))

    # --- geometry

    @property
    def is_unit_speed(self) -> bool:
        """Whether the parameter is the arc length: |p'| = 1, and the end is the length."""
        return False

    def speed(self, t: Array, *, side: Side = "right") -> Array:
        """Return |p'(t)|, (k,)."""
        return np.asarray(np.linalg.norm(self._derivative(t, 1, side).reshape(len(t), -1), axis=1))

    @cached_property
    def length(self) -> float:
        """∫ |p'| dt, the arc length."""
        if self.is_unit_speed:
            return self.end
        pieces, _ = interpolants(self.speed, self.ends)
        return float(sum(piece.integ(lbnd=piece.domain[0])(piece.domain[1]) for piece in pieces))

    def curvature(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return κ = |p'' − (p''·u) u| / |p'|², with the tangent u = p'/|p'|: 1/m of a Cartesian path.

        Raises:
            InputError: the path has no tangent there, p' = 0, or its values are orientations or poses.
        """
        if not self.of_points:
            raise InputError("orientations and poses have no curvature; ask it of the path of the position")
        parameters, alone = self._parameters(t, side)
        d1, d2 = self._derivatives(parameters, (1, 2), side)
        speed = np.linalg.norm(d1, axis=1)
        self.refuse_standstill(parameters, speed)
        kappa = np.linalg.norm(across(d2, d1 / speed[:, None]), axis=1) / speed**2
        return float(kappa[0]) if alone else kappa

    def refuse_standstill(self, t: Array, speed: Array) -> None:
        """Raise InputError where |p'| vanishes."""
        still = speed <= STANDSTILL * self.length / self.end
        if still.any():
            raise InputError(f"the path has no tangent at s = {t[still][0]:.6g}: p' vanishes there")

    # --- other curves

    def joint(self, index: int = 0) -> Curve:
        """Return one coordinate as a timing law, a curve of numbers.

        Raises:
            InputError: there is no such coordinate.
        """
        if counting_number("index", index) >= self.dimension:
            raise InputError(f"index must be below {self.dimension}, the number of joints; it is {index}")
        return self._joint(index) if self.shape else self

    def _joint(self, index: int) -> Curve:
        return Coordinate(self, index)

    def _parameters(self, t: npt.ArrayLike, side: Side) -> tuple[Array, bool]:
        """Return t as (k,), moved on the breakpoint that is near, and whether it was one number."""
        one_of("side", side, ("right", "left"))
        dims = dimensions("the parameter", t)
        parameters = np.atleast_1d(real_array("the parameter", t, (None,) * min(dims, 1), "one number or several"))
        slack = SAME_PLACE * self.end
        if parameters.size and (parameters.min() < -slack or parameters.max() > self.end + slack):
            raise InputError(f"the parameter must be in [0, {self.end:.10g}]; it is {parameters.tolist()}")
        return self._snapped(parameters), dims == 0

    def _snapped(self, t: Array) -> Array:
        """Return t (k,) inside [0, end], and on the breakpoint that is near."""
        t, places = np.clip(t, 0.0, self.end), self.breakpoints
        if not len(places):
            return t
        after = np.searchsorted(places, t)
        for nearest in (places[np.minimum(after, len(places) - 1)], places[np.maximum(after - 1, 0)]):
            t = np.where(np.abs(t - nearest) <= SAME_BREAK * self.end, nearest, t)
        return t


@dataclass(frozen=True, eq=False)
class Coordinate(Curve):
    """One coordinate of a curve, as a timing law.

    Attributes:
        curve: of several coordinates.
        index: which of them.
    """

    curve: Curve
    index: int

    @property
    def end(self) -> float:
        """That of the curve."""
        return self.curve.end

    @property
    def shape(self) -> tuple[int, ...]:
        """Of a number: ()."""
        return ()

    @property
    def breakpoints(self) -> Array:
        """Those of the curve."""
        return self.curve.breakpoints

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return those of the coordinate, (2,) each."""
        times, values = self.curve.extremes(order)
        return times[:, self.index], values[:, self.index]

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        return self.curve._derivative(t, order, side)[:, self.index]


def piece_at(starts: Array, t: Array, side: Side) -> npt.NDArray[np.intp]:
    """Return the number of the piece that each t is in, (k,), of pieces that begin at `starts` (m,), the first at 0."""
    return np.asarray(np.clip(np.searchsorted(starts, t, side=side) - 1, 0, len(starts) - 1))


def across(v: Array, unit: Array) -> Array:
    """Return the part of v normal to a unit vector, row by row: v − (v·u) u, (k, n)."""
    return np.asarray(v - np.sum(v * unit, axis=1, keepdims=True) * unit)


def _larger(times: Array, values: Array, joint: int) -> Extreme:
    """Return the larger in magnitude of a minimum and a maximum; of equal ones, the earlier."""
    (t0, t1), (x0, x1) = times.tolist(), values.tolist()
    near = abs(abs(x0) - abs(x1)) <= SAME_SIZE * max(abs(x0), abs(x1))
    first = t0 <= t1 if near else abs(x0) > abs(x1)
    return Extreme(x0, t0, joint) if first else Extreme(x1, t1, joint)
