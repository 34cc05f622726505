"""The section cut into level strips in which critical curves neither begin, end nor meet; equal strips make a region.

From the left each curve that is passed changes the number of solutions by what it jumps (the degree of the map).

Source: the vertical decomposition of an arrangement of curves; de Berg, Cheong, van Kreveld, Overmars, Computational
Geometry, 2008, section 6.1.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.image_curves import RisingPiece

TOGETHER = 1e-8  # distance of curves that are one, when the arm is one long
MERGED = 1e-9  # difference of heights that are one
LEVELS = 240  # at which curves are compared, beside those where they begin and end
AXIS = -1  # in place of the number of a curve


@dataclass(frozen=True)
class Strip:
    """What is between two curves, from one level to the next.

    Attributes:
        level: its number, from below.
        left, right: the pieces that bound it; None where it goes on for ever.
        count: the number of solutions.
    """

    level: int
    left: int | None
    right: int | None
    count: int


@dataclass(frozen=True, eq=False)
class Strips:
    """The decomposition.

    Attributes:
        pieces: the pieces of curves.
        heights: (k + 1,) where levels begin and end.
        strips: all strips, from below, and from the left.
        across: (pieces, levels) where pieces are in the middle of each level; NaN where they are not.
        parameters: (pieces, heights) t of the pieces at each height; NaN where they are not.
        crossings: (j, 4) where curves cross, as (up, across), and the numbers of the two pieces.
    """

    pieces: tuple[RisingPiece, ...]
    heights: Array
    strips: tuple[Strip, ...]
    across: Array
    parameters: Array
    crossings: Array

    @property
    def consistent(self) -> bool:
        """Whether no strip has fewer than no solutions, and those without an end have none."""
        return all(s.count >= 0 and (s.count == 0 or (s.left is not None and s.right is not None)) for s in self.strips)


def strips_between(pieces: Sequence[RisingPiece]) -> Strips:
    """Return the strips between pieces of critical curves."""
    crossings = _crossings(pieces)
    ends = [height for p in pieces for height in (p.low, p.high)]
    heights = _distinct(np.array(sorted([*ends, *crossings[:, 0]])))
    found: list[Strip] = []
    middles = (heights[:-1] + heights[1:]) / 2
    across = np.full((len(pieces), len(middles)), np.nan)
    for i, piece in enumerate(pieces):
        here = (middles > piece.low) & (middles < piece.high)
        across[i, here] = piece.across(middles[here])
    for level in range(len(middles)):
        found += _strips_of(level, across[:, level], pieces)
    return Strips(tuple(pieces), heights, tuple(found), across, _parameters(pieces, heights), crossings)


def _distinct(values: Array) -> Array:
    kept = [float(values[0])]
    for v in values[1:]:
        if v - kept[-1] > MERGED:
            kept.append(float(v))
    return np.array(kept)


def _parameters(pieces: Sequence[RisingPiece], heights: Array) -> Array:
    table = np.full((len(pieces), len(heights)), np.nan)
    for i, piece in enumerate(pieces):
        here = (heights > piece.low - TOGETHER) & (heights < piece.high + TOGETHER)
        table[i, here] = piece.parameter(np.clip(heights[here], piece.low, piece.high))
    return table


def _strips_of(level: int, across: Array, pieces: Sequence[RisingPiece]) -> list[Strip]:
    """Return the strips of a level; curves that lie together bound none."""
    order = np.flatnonzero(~np.isnan(across))
    order = order[np.argsort(across[order], kind="stable")]
    groups: list[list[int]] = []
    for i in order:
        if groups and across[i] - across[groups[-1][-1]] < TOGETHER:
            groups[-1].append(int(i))
        else:
            groups.append([int(i)])
    found, left, count = [], None, 0
    for group in groups:
        found.append(Strip(level, left, min(group), count))
        count -= sum(pieces[i].jump for i in group)
        left = min(group)
    return [*found, Strip(level, left, None, count)]


def _crossings(pieces: Sequence[RisingPiece]) -> Array:
    """Return where pieces cross, see `Strips`."""
    low, high = min(p.low for p in pieces), max(p.high for p in pieces)
    levels = _distinct(
        np.array(sorted([*np.linspace(low, high, LEVELS), *(e for p in pieces for e in (p.low, p.high))]))
    )
    table = np.full((len(pieces), len(levels)), np.nan)
    for i, piece in enumerate(pieces):
        here = (levels >= piece.low - 2 * MERGED) & (levels <= piece.high + 2 * MERGED)
        table[i, here] = piece.across(np.clip(levels[here], piece.low, piece.high))
    found = []
    least, most = np.nanmin(table, axis=1), np.nanmax(table, axis=1)
    for i in range(len(pieces)):
        for j in range(i + 1, len(pieces)):
            if least[i] > most[j] or least[j] > most[i]:
                continue
            d = table[i] - table[j]
            both = np.flatnonzero(~np.isnan(d))
            if len(both) < 2 or np.abs(d[both]).max() < TOGETHER:
                continue
            found += [(*at, i, j) for at in _where_equal(pieces[i], pieces[j], levels[both], d[both])]
    return np.array(found).reshape(-1, 4)


def _where_equal(a: RisingPiece, b: RisingPiece, levels: Array, d: Array) -> list[tuple[float, float]]:
    """Return the crossings of two pieces whose distances d at levels are known."""
    from scipy.optimize import brentq, minimize_scalar

    def distance(up: float) -> float:
        at = np.array([up])
        return float(a.across(at)[0] - b.across(at)[0])

    clear = np.flatnonzero(np.abs(d) > TOGETHER)
    levels, d = levels[clear], d[clear]
    brackets = [(levels[k], levels[k + 1]) for k in np.flatnonzero((d[1:] > 0) != (d[:-1] > 0))]
    size = np.abs(d)
    for k in range(1, len(d) - 1):
        if size[k] <= size[k - 1] and size[k] <= size[k + 1] and (d[k - 1] > 0) == (d[k] > 0) == (d[k + 1] > 0):
            if _vertex(levels[k - 1 : k + 2], size[k - 1 : k + 2]) > 0.3 * size[k]:
                continue
            sign = 1 if d[k] > 0 else -1
            at = minimize_scalar(
                lambda up, s=sign: s * distance(up),
                bounds=(levels[k - 1], levels[k + 1]),
                method="bounded",
                options={"xatol": 1e-10},
            )
            if at.fun < -TOGETHER:
                brackets += [(levels[k - 1], at.x), (at.x, levels[k + 1])]
    roots = [float(brentq(distance, *bracket, xtol=1e-13)) for bracket in brackets]
    return [(up, float(a.across(np.array([up]))[0])) for up in roots]


def _vertex(x: Array, y: Array) -> float:
    """Return the least value of the parabola through three points."""
    c = np.polyfit(x - x[1], y, 2)
    return float(c[2] - c[1] ** 2 / (4 * c[0])) if c[0] > 0 else float(y.min())
