"""The shadow of an ellipsoid in a plane."""

from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.results import Frozen
from robotics1.singularities.ellipsoids import Ellipsoid

POINTS = 121  # on a boundary; the first is the last


@dataclass(frozen=True, eq=False)
class Shadow(Frozen):
    """The orthogonal projection of an ellipsoid about the origin into a plane.

    Attributes:
        boundary: (k, 2) the ellipse; empty where the shadow is not bounded.
        edges: (2, 2) two points, one on each of the two parallel lines between which an unbounded shadow lies; empty
            where it is bounded, or where it is the whole plane.
        along: (2,) the direction of those lines; empty where there are none.
    """

    boundary: Array
    edges: Array
    along: Array

    @property
    def bounded(self) -> bool:
        """Whether it is an ellipse, which may be flat."""
        return len(self.boundary) > 0


NOTHING = np.zeros((0, 2))


def shadow_of(ellipsoid: Ellipsoid, plane: tuple[int, int]) -> Shadow:
    """Return the shadow of an ellipsoid in the plane of two coordinates; along an axis without bound it has none."""
    finite, free = ellipsoid.bounded_part[list(plane)], ellipsoid.unbounded_axes[list(plane)]
    directions, sizes, _ = np.linalg.svd(free)
    unbounded = int(np.count_nonzero(sizes > RANK_TOLERANCE))
    if unbounded == 0:
        return Shadow(_ellipse(finite), NOTHING, np.zeros(0))
    if unbounded == 1:
        across = directions[:, 1]
        edge = np.linalg.norm(across @ finite) * across
        return Shadow(NOTHING, np.array([edge, -edge]), directions[:, 0])
    return Shadow(NOTHING, NOTHING, np.zeros(0))


def _ellipse(A: Array) -> Array:
    """Return the boundary of {A x : |x| ≤ 1}, (k, 2), for a matrix of two rows."""
    U, sigma, _ = np.linalg.svd(A, full_matrices=True)
    axes = U * np.pad(sigma, (0, 2 - len(sigma)))
    angles = np.linspace(0.0, 2 * np.pi, POINTS)
    return np.asarray(np.column_stack([np.cos(angles), np.sin(angles)]) @ axes.T)
