"""Curves one after the other, and how smoothly they join."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve, piece_at
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.results import Frozen

CONTINUOUS = 1e-9  # of the coordinate's largest value in the two pieces: a smaller jump is rounding
NOISE = 1e-14  # of the largest value of all coordinates: what is as small as this is rounding too
MEET = 1e-9  # of the largest coordinate in the two pieces: ends so near are the same point
LOOKS = np.linspace(0.0, 1.0, 9)  # where the pieces are looked at for their size, of their durations
QUANTITIES = ("position", "velocity", "acceleration", "jerk")


@dataclass(frozen=True, eq=False)
class Join(Frozen):
    """Where a curve passes from one piece to the next.

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
class CurveSequence(Curve):
    """The pieces in a row: the second begins when, and where, the first ends. A line, an arc, a line; or motions.

    Attributes:
        pieces: curves of the same coordinates.
        jumps: whether a piece may begin elsewhere than the one before it ends.
    """

    pieces: tuple[Curve, ...]
    jumps: bool = False

    def __post_init__(self) -> None:
        """Refuse pieces of other coordinates, and pieces that do not meet."""
        pieces = tuple(self.pieces) if isinstance(self.pieces, Sequence) else ()
        if not pieces:
            raise InputError(f"pieces must be one curve or several, such as line_path(...); they are {self.pieces!r}")
        pieces = tuple(as_curve("piece", piece, derivatives=2) for piece in pieces)
        kinds = [(piece.shape, piece.of_points) for piece in pieces]
        if len(set(kinds)) > 1:
            shapes = [piece.shape for piece in pieces]
            raise InputError(f"the pieces must have the same coordinates; their velocities have the shapes {shapes}")
        object.__setattr__(self, "pieces", pieces)
        for i, (before, after) in enumerate(pairwise(pieces)):
            gap = float(np.linalg.norm(_difference(after(0.0), before(before.end))))
            if not self.jumps and gap > MEET * _position_sizes(before, after).max(initial=0.0):
                raise InputError(
                    f"piece {i + 1} must begin where piece {i} ends; it begins {gap:.4g} from there; "
                    "jumps=True allows that"
                )

    @property
    def of_points(self) -> bool:
        """Whether the pieces are curves of points."""
        return self.pieces[0].of_points

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the pieces."""
        return self.pieces[0].shape

    @cached_property
    def starts(self) -> Array:
        """(m,) the parameters at which the pieces begin."""
        return np.concatenate([[0.0], np.cumsum([piece.end for piece in self.pieces])[:-1]])

    @property
    def end(self) -> float:
        """The sum of the pieces' ends."""
        return float(self.starts[-1]) + self.pieces[-1].end

    @property
    def is_unit_speed(self) -> bool:
        """Whether the parameter is the arc length."""
        return all(piece.is_unit_speed for piece in self.pieces)

    @cached_property
    def breakpoints(self) -> Array:
        """The joins, and the pieces' own breakpoints."""
        inner = [start + piece.breakpoints for start, piece in zip(self.starts, self.pieces, strict=True)]
        return np.unique(np.concatenate([self.starts[1:], *inner]))

    @cached_property
    def joins(self) -> tuple[Join, ...]:
        """Where the pieces join, (m − 1), and what jumps there."""
        pairs = zip(self.starts[1:], self.pieces, self.pieces[1:], strict=False)
        return tuple(Join(float(start), _jumps(before, after)) for start, before, after in pairs)

    @property
    def continuity(self) -> int:
        """The least of the joins: −1 where a position jumps, else up to which derivative, 0 to 3, all is continuous."""
        return min((join.continuity for join in self.joins), default=3)

    def _value(self, t: Array, side: Side) -> Any:
        if self.of_points:
            return self._derivative(t, 0, side)
        values: list[Any] = [None] * len(t)
        for piece, here, local in self._located(t, side):
            for j, value in zip(here, piece._value(local, side), strict=True):
                values[j] = value
        return values if values and hasattr(values[0], "rotation") else np.array(values)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        values = np.empty((len(t), *self.shape))
        for piece, here, local in self._located(t, side):
            values[here] = piece._derivative(local, order, side)
        return values

    def _located(self, t: Array, side: Side) -> Iterator[tuple[Curve, npt.NDArray[np.intp], Array]]:
        """Yield each piece with the numbers of the parameters in it, and these from its start."""
        number = piece_at(self.starts, t, side)
        for i in np.unique(number):
            here = np.flatnonzero(number == i)
            yield self.pieces[i], here, self.pieces[i]._snapped(t[here] - self.starts[i])


def _jumps(before: Curve, after: Curve) -> Array:
    """Return what the position and its three derivatives gain from the end of a piece to the start of the next."""
    gains, sizes = [_difference(after(0.0), before(before.end))], [_position_sizes(before, after)]
    for order in (1, 2, 3):
        x = np.asarray(before.derivative(before.end, order, side="left"))
        y = np.asarray(after.derivative(0.0, order, side="right"))
        gains.append(y - x)
        inside = [np.abs(piece.derivative(LOOKS * piece.end, order)).max(axis=0) for piece in (before, after)]
        sizes.append(np.max([np.abs(x), np.abs(y), *inside], axis=0))
    jumps, size = np.stack([np.atleast_1d(x) for x in gains]), np.stack([np.atleast_1d(x) for x in sizes])
    rounding = CONTINUOUS * size + NOISE * size.max(axis=1, keepdims=True, initial=0.0)
    return np.where(np.abs(jumps) > rounding, jumps, 0.0)


def _position_sizes(*pieces: Curve) -> Array:
    """Return how large each coordinate becomes; an angle of an orientation counts as 1 rad."""
    values = [value for piece in pieces for value in piece(LOOKS * piece.end)]
    if hasattr(values[0], "rotation"):
        return np.concatenate([np.abs([T.translation for T in values]).max(axis=0), np.ones(3)])
    return np.ones(3) if np.ndim(values[0]) == 2 else np.asarray(np.abs(values).max(axis=0))


def _difference(b: Any, a: Any) -> Array:
    """Return b − a of points, and with rotations log(R_b R_aᵀ)."""
    import pinocchio as pin

    if hasattr(a, "rotation"):
        turn = pin.log3(b.rotation @ a.rotation.T)
        return np.concatenate([b.translation - a.translation, turn])
    return np.asarray(pin.log3(b @ a.T)) if np.ndim(a) == 2 else np.asarray(b) - np.asarray(a)
