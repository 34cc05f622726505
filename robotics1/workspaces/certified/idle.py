"""The coordinates that a distance depends on: not those of first joints that turn about what it is measured from."""

import numpy as np
import numpy.typing as npt

from robotics1.workspaces.axes import Axis, distance_to
from robotics1.workspaces.certified.driven_chain import ALIKE, DrivenChain
from robotics1.workspaces.sampled.extremes import Measure


def free_coordinates(chain: DrivenChain, measure: Measure) -> npt.NDArray[np.bool_]:
    """Return the coordinates (n,) on which a measure of the point depends.

    The first joint does not change a distance from a point of its axis, nor a coordinate along its axis; and so the
    next ones, until one does. A joint that mimics another one, or is mimicked on the way, is not left out.
    """
    free = np.ones(len(chain.lower), dtype=bool)
    size = float(np.abs(chain.chain.jacobian(np.zeros((1, len(chain.A))))[1]).max()) + 1e-300
    for row, axis in zip(chain.A, chain.chain.axes, strict=True):
        own = np.flatnonzero(row)
        alone = np.count_nonzero(chain.A[:, own[0]]) == 1
        if not (alone and _changes_nothing(axis, measure, size)):
            break
        free[own[0]] = False
    return free


def _changes_nothing(axis: Axis, measure: Measure, size: float) -> bool:
    n, a = measure.direction, axis.direction
    if n is not None:
        return bool(np.linalg.norm(np.cross(a, n)) < ALIKE if axis.revolute else abs(a @ n) < ALIKE)
    across = bool(np.linalg.norm(measure.P @ a) < ALIKE)
    if not axis.revolute:
        return across
    whole = np.allclose(measure.P, np.eye(3), rtol=0, atol=ALIKE)
    return (across or whole) and distance_to(axis, measure.centre) < ALIKE * size
