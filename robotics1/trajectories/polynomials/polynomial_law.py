"""One joint of a motion of polynomials, read as a timing law."""

from dataclasses import dataclass, replace
from typing import Any

import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.trajectories.peaks.extremes import LawWithExtremes
from robotics1.trajectories.polynomials.pieces import PolynomialPieces
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory
from robotics1.trajectories.protocols import Side


@dataclass(frozen=True, eq=False)
class PolynomialLaw(LawWithExtremes):
    """s(t): the joint `index` of a motion made of polynomials.

    Attributes:
        motion: of one joint or several.
        index: which of them.
    """

    motion: PolynomialPieces
    index: int = 0

    @property
    def duration(self) -> float:
        """T [s]."""
        return self.motion.duration

    @property
    def start(self) -> float:
        """s(0)."""
        return float(self.motion.pieces[0].coefficients[0, self.index])

    @property
    def end(self) -> float:
        """s(T)."""
        return float(self(self.duration))

    @property
    def switching_times(self) -> Array:
        """The instants inside (0, T) at which a derivative jumps [s]."""
        return self.motion.switching_times

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return s(t): a number for a number, (k,) for (k,) times.

        Raises:
            InputError: a time is outside the law.
        """
        return self._of(self.motion(t))

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return ṡ(t)."""
        return self._of(self.motion.velocity(t, side=side))

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return s̈(t)."""
        return self._of(self.motion.acceleration(t, side=side))

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return d³s/dt³."""
        return self._of(self.motion.jerk(t, side=side))

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the times (2,) [s] and values (2,) of the minimum and maximum of the derivative of this order."""
        times, values = self.motion.extremes(order)
        return times[:, self.index], values[:, self.index]

    def stretched(self, factor: float) -> "PolynomialLaw":
        """Return s(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        return replace(self, motion=self.motion.stretched(factor))

    @property
    def pieces(self) -> tuple[PolynomialTrajectory, ...]:
        """The polynomials, in the order of time, each with its coefficients in τ and in t."""
        return self.motion.pieces

    def _of(self, rows: Array) -> Any:
        column = rows[..., self.index]
        return column if column.ndim else float(column)
