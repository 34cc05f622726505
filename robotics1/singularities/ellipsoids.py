"""The velocity and the force ellipsoid of a Jacobian: axes and lengths, exact where the rank is lost."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.results import Frozen
from robotics1.singularities.spaces import Subspaces


@dataclass(frozen=True, eq=False)
class Ellipsoid(Frozen):
    """An ellipsoid about the origin of the task's space.

    Attributes:
        axes: (m, m) its axes, as orthonormal columns.
        lengths: (m,) the semi-axes: 0 where it is flat, ∞ where it is not bounded.
    """

    axes: Array
    lengths: Array

    @property
    def bounded_part(self) -> Array:
        """(m, k) the axes of finite length, times their lengths: {this x : |x| ≤ 1} is the part along them."""
        finite = np.isfinite(self.lengths)
        return np.asarray(self.axes[:, finite] * self.lengths[finite])

    @property
    def unbounded_axes(self) -> Array:
        """(m, m − k) the axes along which it is not bounded."""
        return self.axes[:, np.isinf(self.lengths)]

    def radius(self, u: npt.ArrayLike) -> float:
        """Return the distance from the origin to the surface along u (m,), of any length: 1/√(uᵀ A⁻¹ u) of a unit u.

        It is 0 where u leaves a flat ellipsoid, and ∞ along an axis that is not bounded, each to 1e-9.

        Raises:
            InputError: u has no direction, or not one number for each row of the task.
        """
        u = real_array("u", u, (len(self.lengths),), "one number for each row of the task")
        largest = float(np.abs(u).max(initial=0.0))
        if largest == 0:
            raise InputError("u must have a direction; it is the zero vector")
        along = self.axes.T @ (u / largest)
        along /= np.linalg.norm(along)
        counted = np.isfinite(self.lengths) & (self.lengths > 0)
        if (np.abs(along[self.lengths == 0]) > RANK_TOLERANCE).any():
            return 0.0
        if np.linalg.norm(along[counted]) <= RANK_TOLERANCE:
            return np.inf
        return float(1 / np.linalg.norm(along[counted] / self.lengths[counted]))


def velocity_ellipsoid(spaces: Subspaces) -> Ellipsoid:
    """Return {J q̇ : |q̇| ≤ 1}, with the singular values of J (m, n) as semi-axes, the longest first."""
    axes = np.hstack([spaces.range, spaces.left_null])
    return Ellipsoid(axes, np.pad(spaces.singular_values[: spaces.rank], (0, len(axes) - spaces.rank)))


def force_ellipsoid(spaces: Subspaces) -> Ellipsoid:
    """Return {f : |Jᵀ f| ≤ 1}, with 1/σᵢ along the axes of the velocity ellipsoid: forces of N(Jᵀ) need no torque."""
    moved = velocity_ellipsoid(spaces)
    return Ellipsoid(moved.axes, np.array([1 / s if s > 0 else np.inf for s in moved.lengths]))
