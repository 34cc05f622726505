"""Slices of reachability maps: how well each position of a grid is reached."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of, real_number
from robotics1.plots.figures import drawn, new_axes
from robotics1.workspaces.reachability.result import ReachabilityMap

Value = Literal["capability", "solutions", "manipulability", "limit_margin"]
VALUES: dict[Value, str] = {
    "capability": "share of the orientations",
    "solutions": "solutions, the most of a pose",
    "manipulability": "manipulability",
    "limit_margin": "distance from the limits",
}


def plot_reachability(
    known: ReachabilityMap,
    value: Value = "capability",
    at: Mapping[str, float] | None = None,
    ax: Any = None,
    *,
    file: str | Path | None = None,
    title: str = "",
) -> Any:
    """Draw a slice of a map as coloured cells, and return the axes. Positions that are not reached stay white.

    Args:
        known: what `reachability_map` returns, of a grid of positions.
        value: "capability", "solutions", "manipulability" or "limit_margin".
        at: of a grid in space, where to cut: a letter → a coordinate [m], as {"z": 0.3}; the nearest values of the grid
            are drawn. By default the middle of its last coordinate.
        ax: the Matplotlib axes to draw in; by default those of a new figure.
        file: where to write the figure, as .svg, .pdf or .png.
        title: above the plot.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: it is no map of a grid, the slice has no two coordinates, its solutions are not counted, or the
            file has another suffix or cannot be written there.
    """
    if not isinstance(known, ReachabilityMap) or known.grid is None:
        raise InputError("known must be a map of a grid, such as reachability_map(robot, task, {'x': ..., 'y': ...})")
    values = _values(known, one_of("value", value, tuple(VALUES)))
    letters, cut = _slice(known, at)
    place = tuple(cut.get(letter, slice(None)) for letter in known.coordinates)
    axes = [axis for letter, axis in zip(known.coordinates, known.grid, strict=True) if letter in letters]
    panel = new_axes(ax, 2)
    cells = np.ma.masked_invalid(known.on_grid(values)[place]).T
    mesh = panel.pcolormesh(*axes, cells, shading="nearest", cmap="viridis", vmin=0.0, rasterized=True)
    panel.figure.colorbar(mesh, ax=panel, label=VALUES[value])
    where = [f"{letter} = {known.grid[known.coordinates.index(letter)][i]:.4g} m" for letter, i in cut.items()]
    panel.set_aspect("equal")
    panel.set(xlabel=f"{letters[0]} [m]", ylabel=f"{letters[1]} [m]", title=", ".join([title] * bool(title) + where))
    return drawn(panel, file)


def _values(known: ReachabilityMap, value: str) -> Array:
    """Return a number for each position, (k,); NaN where it is not reached."""
    if value in ("manipulability", "limit_margin"):
        return np.asarray(getattr(known, value))
    if value == "capability":
        return np.where(known.capability > 0, known.capability, np.nan)
    if known.most_solutions is None:
        raise InputError("the solutions of this map are not counted: the arm is redundant, or has no formula")
    return np.where(known.reached.any(axis=1), known.most_solutions, np.nan)


def _slice(known: ReachabilityMap, at: Mapping[str, float] | None) -> tuple[list[str], dict[str, int]]:
    """Return the two letters that are drawn, and letter → number in the grid of the others."""
    grid = dict(zip(known.coordinates, known.grid or (), strict=True))
    wide = [letter for letter, axis in grid.items() if len(axis) > 1]
    cut = {letter: 0 for letter in grid if letter not in wide}
    if at is None and len(wide) == 3:
        cut[wide[-1]] = len(grid[wide[-1]]) // 2
    for letter, coordinate in dict(at or {}).items():
        axis = grid[one_of("a letter in at", letter, tuple(grid))]
        cut[letter] = int(np.argmin(np.abs(axis - real_number(f"at[{letter!r}]", coordinate))))
    letters = [letter for letter in grid if letter not in cut]
    if len(letters) != 2:
        raise InputError(f"a slice has two coordinates; with at={dict(at or {})!r} there are {len(letters)} left")
    return letters, cut
