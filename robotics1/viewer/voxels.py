"""A reachability map as the page draws it: a box for each cell of the grid that is reached."""

from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.notation import count
from robotics1.tasks.position import AXES
from robotics1.workspaces.reachability.result import ReachabilityMap

MOST = 200_000  # boxes that a browser draws without delay
FLAT = 0.1  # of the smallest width: how thick a cell is along a coordinate with one value
DIGITS = 4


def voxels_of(known: ReachabilityMap) -> dict[str, Any]:
    """Return the boxes of the positions that are reached, in the order in which a cut takes them away.

    The cut goes along y, or along the last coordinate that has several values.

    Raises:
        InputError: it is no map of a grid in the axes of the world, nothing is reached, or there are too many boxes.
    """
    if not isinstance(known, ReachabilityMap) or known.grid is None:
        raise InputError("reach must be a map of a grid, such as reachability_map(robot, task, {'x': ..., 'y': ...})")
    reached = np.flatnonzero(known.reached.any(axis=1))
    if not 0 < len(reached) <= MOST:
        raise InputError(
            f"a page draws the cells that are reached, up to {MOST}; of this map that are {count(len(reached), 'cell')}"
        )
    wide = [letter for letter, axis in zip(known.coordinates, known.grid, strict=True) if len(axis) > 1]
    cut = "y" if "y" in wide or not wide else wide[-1]
    points = np.zeros((len(known), 3))
    points[:, [AXES.index(letter) for letter in known.coordinates]] = known.positions
    order = reached[np.argsort(-points[reached, AXES.index(cut)], kind="stable")]
    measures = {
        "share of the orientations": known.capability,
        "manipulability": known.manipulability,
        "distance from the limits": known.limit_margin,
    }
    if known.most_solutions is not None:
        measures["solutions"] = known.most_solutions.astype(float)
    return {
        "cut": AXES.index(cut),
        "size": _size(known).tolist(),
        "points": np.round(points[order], DIGITS).ravel().tolist(),
        "measures": [
            [name, [float(f"{value:.{DIGITS}g}") for value in values[order]]] for name, values in measures.items()
        ],
    }


def _size(known: ReachabilityMap) -> Array:
    """Return the widths of a cell, (3,) [m]: those of the nearest values of the grid."""
    size = np.full(3, np.inf)
    for letter, axis in zip(known.coordinates, known.grid or (), strict=True):
        if len(axis) > 1:
            size[AXES.index(letter)] = np.diff(axis).min()
    least = float(size.min())
    return np.where(np.isfinite(size), size, FLAT * least if np.isfinite(least) else 0.01)
