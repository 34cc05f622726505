"""Trajectories one after the other, and how smoothly they join."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.course import piece_at
from robotics1.trajectories.instants import times_inside
from robotics1.trajectories.protocols import Side, require_motion, smooth_ends

CONTINUOUS = 1e-9  # of the coordinate's largest value in the two pieces: a smaller jump is rounding
NOISE = 1e-14  # of the largest value of all coordinates: what is as small as this is rounding too
LOOKS = np.linspace(0.0, 1.0, 9)  # where the pieces are looked at for their size, of their durations
QUANTITIES = ("position", "velocity", "acceleration", "jerk")


@dataclass(frozen=True, eq=False)
class Join:
    """Where a trajectory passes from one piece to the next.

    Attributes:
        time: when [s].
        jumps: (4, n) what the position, velocity, acceleration and jerk gain there; zero where they are continuous.
            Of orientations the first is log(R₁ R₀ᵀ).
    """

    time: float
    jumps: Array

    @property
    def continuity(self) -> int:
        """How many derivatives are continuous: −1 where the position jumps, 0 where the velocity does, up to 3."""
        steady = ~self.jumps.any(axis=1)
        return int(np.argmin(np.append(steady, False))) - 1

    def __str__(self) -> str:
        if self.continuity == 3:
            return f"at t = {self.time:.6g} s nothing jumps, up to the jerk"
        size = np.linalg.norm(self.jumps[self.continuity + 1])
        return f"at t = {self.time:.6g} s the {QUANTITIES[self.continuity + 1]} jumps by {size:.6g}"


@dataclass(frozen=True, eq=False)
class TrajectorySequence:
    """The pieces in a row: the second begins when the first ends.

    Attributes:
        pieces: trajectories of the same coordinates.
    """

    pieces: tuple[Any, ...]

    def __post_init__(self) -> None:
        """Refuse what are no trajectories of the same coordinates."""
        pieces = tuple(self.pieces) if isinstance(self.pieces, Sequence) else ()
        if not pieces:
            raise InputError(f"pieces must be one trajectory or several; they are {self.pieces!r}")
        for piece in pieces:
            require_motion("piece", piece, derivatives=2)
        sizes = [np.shape(piece.velocity(0.0)) for piece in pieces]
        if len(set(sizes)) > 1:
            raise InputError(f"the pieces must have the same coordinates; their velocities have the shapes {sizes}")
        object.__setattr__(self, "pieces", pieces)

    @cached_property
    def starts(self) -> Array:
        """(m,) when the pieces begin [s]."""
        return np.concatenate([[0.0], np.cumsum([piece.duration for piece in self.pieces])[:-1]])

    @property
    def duration(self) -> float:
        """T [s], the sum of the pieces'."""
        return float(self.starts[-1]) + float(self.pieces[-1].duration)

    @cached_property
    def joins(self) -> tuple[Join, ...]:
        """Where the pieces join, (m − 1), and what jumps there."""
        return tuple(
            Join(float(start), _jumps(before, after))
            for start, before, after in zip(self.starts[1:], self.pieces, self.pieces[1:], strict=False)
        )

    @property
    def continuity(self) -> int:
        """The least of the joins: −1 where a position jumps, else up to which derivative, 0 to 3, all is continuous."""
        return min((join.continuity for join in self.joins), default=3)

    @cached_property
    def switching_times(self) -> Array:
        """The joins, and the pieces' own [s]."""
        inner = [s + np.array(smooth_ends(piece)[1:-1]) for s, piece in zip(self.starts, self.pieces, strict=True)]
        return np.unique(np.concatenate([self.starts[1:], *inner]))

    def __call__(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the value at t, in the form of the pieces'.

        Raises:
            InputError: a time is outside the trajectory.
        """
        times = times_inside(t, self.duration, side)
        values = [self.pieces[i](x) for i, x in self._located(times, side)]
        return values[0] if not times.ndim else values if hasattr(values[0], "rotation") else np.array(values)

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return ṗ(t)."""
        return self._rate(t, "velocity", side)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return p̈(t)."""
        return self._rate(t, "acceleration", side)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of p(t)."""
        return self._rate(t, "jerk", side)

    def _rate(self, t: npt.ArrayLike, quantity: str, side: Side) -> Array:
        times = times_inside(t, self.duration, side)
        values = np.array([getattr(self.pieces[i], quantity)(x, side=side) for i, x in self._located(times, side)])
        return values if times.ndim else values[0]

    def _located(self, times: Array, side: Side) -> list[tuple[int, float]]:
        """Return for each time the piece and the time in it."""
        places = np.atleast_1d(times).astype(float)
        for start in self.starts:
            places[np.abs(places - start) <= 1e-12 * self.duration] = start
        number = piece_at(self.starts, places, side)
        ends = np.array([piece.duration for piece in self.pieces])[number]
        return list(zip(number.tolist(), np.clip(places - self.starts[number], 0.0, ends).tolist(), strict=True))


def _jumps(before: Any, after: Any) -> Array:
    """Return what the position and its three derivatives gain from the end of a piece to the start of the next."""
    T = before.duration
    gains, sizes = [_difference(after(0.0), before(T))], [_position_sizes(before, after)]
    for quantity in QUANTITIES[1:]:
        x = np.asarray(getattr(before, quantity)(T, side="left"))
        y = np.asarray(getattr(after, quantity)(0.0, side="right"))
        gains.append(y - x)
        inside = [np.abs(getattr(piece, quantity)(LOOKS * piece.duration)).max(axis=0) for piece in (before, after)]
        sizes.append(np.max([np.abs(x), np.abs(y), *inside], axis=0))
    jumps, size = np.stack([np.atleast_1d(x) for x in gains]), np.stack([np.atleast_1d(x) for x in sizes])
    rounding = CONTINUOUS * size + NOISE * size.max(axis=1, keepdims=True, initial=0.0)
    return np.where(np.abs(jumps) > rounding, jumps, 0.0)


def _position_sizes(*pieces: Any) -> Array:
    """Return how large each coordinate becomes; an angle of an orientation counts as 1 rad."""
    values = [value for piece in pieces for value in piece(LOOKS * piece.duration)]
    if hasattr(values[0], "rotation"):
        return np.concatenate([np.abs([T.translation for T in values]).max(axis=0), np.ones(3)])
    return np.ones(3) if np.ndim(values[0]) == 2 else np.abs(values).max(axis=0)


def _difference(b: Any, a: Any) -> Array:
    """Return b − a of points, and with rotations log(R_b R_aᵀ)."""
    import pinocchio as pin

    if hasattr(a, "rotation"):
        turn = pin.log3(b.rotation @ a.rotation.T)
        return np.concatenate([b.translation - a.translation, turn])
    return np.asarray(pin.log3(b @ a.T)) if np.ndim(a) == 2 else np.asarray(b) - np.asarray(a)
