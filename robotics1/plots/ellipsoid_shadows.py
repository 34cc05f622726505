"""The shadows, in a plane, of the velocity and the force ellipsoid of a Jacobian."""

from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE, numeric_rank
from robotics1.results import Frozen

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


def velocity_shadow(J: Array, plane: tuple[int, int]) -> Shadow:
    """Return the shadow of {J q̇ : |q̇| ≤ 1}; its semi-axes are the singular values of the two rows of J."""
    return Shadow(_ellipse(J[list(plane)]), NOTHING, np.zeros(0))


def force_shadow(J: Array, plane: tuple[int, int]) -> Shadow:
    """Return the shadow of {f : |Jᵀ f| ≤ 1}, f = U diag(1/σ) x with |x| ≤ 1.

    Where J loses rank, forces of N(Jᵀ) need no torque: of those the shadow is unbounded.
    """
    U, sigma, _ = np.linalg.svd(J)
    rank = numeric_rank(sigma)
    finite, free = U[list(plane), :rank] / sigma[:rank], U[list(plane), rank:]
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
