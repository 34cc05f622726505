"""Paths one after the other: a line, an arc, a line."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.course import piece_at
from robotics1.paths.path import Path

MEET = 1e-9  # of the length: ends so near are the same point


@dataclass(frozen=True, eq=False)
class PathSequence(Path):
    """The pieces in a row; s goes through the first, then the second, and so on.

    Attributes:
        pieces: each begins where the one before ends.
    """

    pieces: tuple[Path, ...]

    def __post_init__(self) -> None:
        """Refuse pieces that do not meet."""
        pieces = tuple(self.pieces) if isinstance(self.pieces, Sequence) else ()
        if not pieces or not all(isinstance(piece, Path) for piece in pieces):
            raise InputError(f"pieces must be one path or several, such as line_path(...); they are {self.pieces!r}")
        if len({piece.dimension for piece in pieces}) > 1:
            raise InputError(f"the pieces must have one dimension; it is {[piece.dimension for piece in pieces]}")
        object.__setattr__(self, "pieces", pieces)
        for i, (before, after) in enumerate(pairwise(pieces)):
            gap = float(np.linalg.norm(after(0.0) - before(before.end)))
            if gap > MEET * self.length:
                raise InputError(f"piece {i + 1} must begin where piece {i} ends; it begins {gap:.4g} from there")

    @cached_property
    def starts(self) -> Array:
        """(m,) the parameters at which the pieces begin."""
        return np.concatenate([[0.0], np.cumsum([piece.end for piece in self.pieces])[:-1]])

    @property
    def end(self) -> float:
        """The sum of the pieces' ends."""
        return float(self.starts[-1]) + self.pieces[-1].end

    @property
    def dimension(self) -> int:
        """The number of coordinates, n."""
        return self.pieces[0].dimension

    @property
    def is_unit_speed(self) -> bool:
        """Whether s is the arc length."""
        return all(piece.is_unit_speed for piece in self.pieces)

    @cached_property
    def breaks(self) -> Array:
        """The joints, and the pieces' own breaks."""
        inner = [start + piece.breaks for start, piece in zip(self.starts, self.pieces, strict=True)]
        return np.unique(np.concatenate([self.starts[1:], *inner]))

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        number = piece_at(self.starts, s, side)
        values = np.empty((len(s), self.dimension))
        for i in np.unique(number):
            here = number == i
            values[here] = self.pieces[i].derivative(s[here] - self.starts[i], order, side=side)
        return values
