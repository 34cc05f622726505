"""Motions made of polynomials one after the other: their values, one-sided where they switch, and exact extremes."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
from numpy.polynomial import polynomial

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, real_number
from robotics1.trajectories.instants import times_inside
from robotics1.trajectories.protocols import Side
from robotics1.trajectories.quantities import positive_duration

if TYPE_CHECKING:
    from robotics1.paths.polynomial_path import PolynomialPath
    from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory
    from robotics1.trajectories.polynomials.polynomial_law import PolynomialLaw

SAME_INSTANT = 1e-12  # of the duration: a time so near to a knot is the knot
JUMP, NOISE = 1e-9, 1e-13  # of a joint's largest value in the two pieces, and in all: a smaller jump is rounding
NEWTON = 3  # steps: from three digits to all
ROUNDING = 1e-12  # relative: two extremes so near are one, and the earlier counts


def stationary_points(c: Array) -> Array:
    """Return 0, the τ inside (0, 1) at which Σₖ cₖ τᵏ may have an extreme, and 1, ascending.

    Coefficients below 1e-14 of the largest are rounding: as leading ones they would spoil the roots. Those a little
    larger cost the roots as many digits, which Newton's steps bring back; what they began with is kept beside it.
    """
    slope = polynomial.polytrim(polynomial.polyder(c), 1e-14 * np.abs(c).max())
    bend = polynomial.polyder(slope)
    roots = polynomial.polyroots(slope).real
    near = polished = roots[np.abs(roots - 0.5) < 1.0]
    for _ in range(NEWTON):
        curvature = polynomial.polyval(polished, bend)
        steps = polynomial.polyval(polished, slope) / np.where(curvature == 0, 1.0, curvature)
        polished = polished - np.clip(steps, -1.0, 1.0)
    inside = np.union1d(near, polished)
    return np.concatenate([[0.0], inside[(inside > 0) & (inside < 1)], [1.0]])


class PolynomialPieces:
    """q(t) = Σₖ cₖ τᵏ on each piece, with τ = (t − tᵢ)/Tᵢ; of a piece of no duration, τ = t − tᵢ."""

    if TYPE_CHECKING:  # what a kind gives: a property here would be the default of a dataclass's field

        @property
        def pieces(self) -> tuple[PolynomialTrajectory, ...]:
            """The polynomials, in the order of time."""

        @property
        def duration(self) -> float:
            """T [s]."""

        @property
        def rate(self) -> "PolynomialPieces":
            """q̇, made of polynomials too."""

    @cached_property
    def knots(self) -> Array:
        """(m + 1,) where the m pieces begin, and the end [s]."""
        return np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])])

    def __call__(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q at the time t [s], 0 ≤ t ≤ T: (n,) for a number, (k, n) for (k,) times.

        Raises:
            InputError: a time is outside the trajectory.
        """
        times = times_inside(t, self.duration, side)
        i = self._piece(times, side)
        durations = np.array([piece.duration for piece in self.pieces])
        # A piece can be as short as the rounding of t: no value beyond its ends is told.
        tau = np.clip(times - self.knots[i], 0.0, durations[i]) / self._scales[i]
        return np.asarray(polynomial.polyval(tau[..., None], self._stacked[:, i], tensor=False))

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̇(t) [rad/s or m/s], in the shape of q(t)."""
        return self.rate(t, side=side)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̈(t) [rad/s² or m/s²], in the shape of q(t)."""
        return self.rate.rate(t, side=side)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of q(t) [rad/s³ or m/s³], in the shape of q(t)."""
        return self.rate.rate.rate(t, side=side)

    @cached_property
    def switching_times(self) -> Array:
        """The instants inside (0, T) at which a derivative jumps [s]."""
        inner = self.knots[1:-1]
        motion, jumps = self, np.zeros(len(inner), dtype=bool)
        for _ in range(len(self._stacked)):
            after, before = motion(inner), motion(inner, side="left")
            sizes = np.abs(motion._stacked).max(axis=0)
            rounding = JUMP * np.maximum(sizes[1:], sizes[:-1]) + NOISE * sizes.max(axis=0) + 1e-300
            jumps |= (np.abs(after - before) > rounding).any(axis=1)
            motion = motion.rate
        return inner[jumps]

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the times (2, n) [s] and values (2, n) of each joint's minimum and maximum.

        Exact: they are at the ends of pieces or where the derivative vanishes. `order` 1, 2, 3 asks for those of the
        velocity, acceleration, jerk. Of several instants the first is told.
        """
        if counting_number("order", order):
            return self.rate.extremes(order - 1)
        n = self._stacked.shape[-1]
        times, values = np.empty((2, n)), np.empty((2, n))
        for j in range(n):
            polynomials = [piece.coefficients[:, j] for piece in self.pieces]
            taus = [
                stationary_points(c) if piece.duration else np.zeros(1)
                for c, piece in zip(polynomials, self.pieces, strict=True)
            ]
            t = np.concatenate(
                [start + scale * tau for start, scale, tau in zip(self.knots, self._scales, taus, strict=False)]
            )
            x = np.concatenate([polynomial.polyval(tau, c) for tau, c in zip(taus, polynomials, strict=True)])
            for row, y in enumerate((-x, x)):
                first = int(np.argmax(y >= y.max() - ROUNDING * np.abs(x).max()))
                times[row, j], values[row, j] = t[first], x[first]
        return times, values

    @cached_property
    def _scales(self) -> Array:
        """(m,) what τ is t − tᵢ divided by [s]."""
        return np.array([piece.duration or 1.0 for piece in self.pieces])

    @cached_property
    def _stacked(self) -> Array:
        """(degree + 1, m, n) the coefficients of all pieces, lower degrees filled up with zeros."""
        pieces = [piece.coefficients for piece in self.pieces]
        stacked = np.zeros((max(map(len, pieces)), len(pieces), pieces[0].shape[1]))
        for i, c in enumerate(pieces):
            stacked[: len(c), i] = c
        return stacked

    def _piece(self, times: Array, side: str) -> npt.NDArray[np.intp]:
        """Return the number of the piece that each time is in; a knot is in the piece on its side."""
        inner, near = self.knots[1:-1], SAME_INSTANT * self.knots[-1]
        if side == "right":
            return np.asarray(np.searchsorted(inner - near, times, side="right"))
        return np.asarray(np.searchsorted(inner + near, times, side="left"))

    def stretched(self, factor: float) -> "PolynomialPieces":
        """Return q(t/k), slower for k > 1: velocities are divided by k, accelerations by k², jerks by k³.

        Raises:
            InputError: k is not positive, or so large or small that the derivatives are no numbers.
        """
        from robotics1.trajectories.polynomials.piecewise import PiecewiseTrajectory
        from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory

        k = real_number("factor", factor, positive=True)
        if self.duration:
            positive_duration("the new duration", k * self.duration)
        pieces = tuple(PolynomialTrajectory(piece.coefficients, k * piece.duration) for piece in self.pieces)
        return pieces[0] if len(pieces) == 1 else PiecewiseTrajectory(pieces)

    def as_path(self) -> "PolynomialPath":
        """Return the same curve as a path q(s), 0 ≤ s ≤ T, for a timing law of its own: `PathTrajectory(path, law)`."""
        from robotics1.paths.polynomial_path import PolynomialPath

        powers = self._scales ** np.arange(len(self._stacked))[:, None]
        return PolynomialPath(self._stacked / powers[:, :, None], self.knots)

    def joint(self, index: int = 0) -> "PolynomialLaw":
        """Return the motion of one joint as a timing law.

        Raises:
            InputError: there is no such joint.
        """
        from robotics1.trajectories.polynomials.polynomial_law import PolynomialLaw

        n = self._stacked.shape[-1]
        if counting_number("index", index) >= n:
            raise InputError(f"index must be below {n}, the number of joints; it is {index}")
        return PolynomialLaw(self, index)
