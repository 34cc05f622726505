"""The point that any number of joints move, for many configurations at once: a product of exponentials.

Source: Lynch, Park, Modern Robotics, 2017, sections 4.1 and 5.1.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.axes import Axis


@dataclass(frozen=True, eq=False)
class ChainMap:
    """The joints on the way to a point, at q = 0.

    Attributes:
        axes: the joints, the first nearest to the base.
        tip: (3,) the point at q = 0 [m].
    """

    axes: tuple[Axis, ...]
    tip: Array

    @property
    def lower(self) -> Array:
        """The lower limits (n,) [rad or m]."""
        return np.array([axis.lower for axis in self.axes])

    @property
    def upper(self) -> Array:
        """The upper limits (n,) [rad or m]."""
        return np.array([axis.upper for axis in self.axes])

    @property
    def circular(self) -> npt.NDArray[np.bool_]:
        """Which joints make a full turn (n,)."""
        return np.array([axis.circular for axis in self.axes], dtype=bool)

    @cached_property
    def _motions(self) -> list["_Motion"]:
        return [_Motion.of(axis) for axis in self.axes]

    def point(self, q: Array) -> Array:
        """Return the point at q (k, n): (k, 3)."""
        p = np.broadcast_to(self.tip, (len(q), 3))
        for i in range(len(self.axes) - 1, -1, -1):
            p = self._motions[i].point(q[:, i], p)
        return np.asarray(p)

    def jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return the point (k, 3) and its Jacobian (k, 3, n) at q (k, n)."""
        k, n = q.shape
        columns = np.zeros((n, k, 3))
        p = np.broadcast_to(self.tip, (k, 3))
        for i in range(n - 1, -1, -1):
            motion = self._motions[i]
            p = motion.point(q[:, i], p)
            columns[i + 1 :] = motion.vectors(q[:, i], columns[i + 1 :])
            columns[i] = motion.velocity(p)
        return np.asarray(p), np.moveaxis(columns, 0, -1)

    def turning(self, q: Array) -> Array:
        """Return the axes of the joints in the frame of the base at q (k, n): (k, n, 3); zero of slides."""
        k, n = q.shape
        directions = np.zeros((n, k, 3))
        for i in range(n - 1, -1, -1):
            motion = self._motions[i]
            directions[i + 1 :] = motion.vectors(q[:, i], directions[i + 1 :])
            if motion.revolute:
                directions[i] = motion.direction
        return np.moveaxis(directions, 0, 1)

    def drawn(self, rng: np.random.Generator, count: int) -> Array:
        """Return configurations (count, n) inside the limits; a quarter of the joints' values are at limits."""
        q = rng.uniform(self.lower, self.upper, (count, len(self.axes)))
        at_limit = rng.random(q.shape) < 0.125
        ends = np.where(rng.random(q.shape) < 0.5, self.lower, self.upper)
        return np.where(at_limit & ~self.circular, ends, q)


@dataclass(frozen=True, eq=False)
class _Motion:
    """A joint: R v = v + sin q K v + (1 − cos q) K² v (Rodrigues), with K v = a × v."""

    revolute: bool
    direction: Array
    place: Array
    K: Array
    square: Array

    @classmethod
    def of(cls, axis: Axis) -> "_Motion":
        x, y, z = axis.direction
        K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return cls(axis.revolute, axis.direction, axis.point, K.T, (K @ K).T)

    def vectors(self, value: Array, v: Array) -> Array:
        """Return vectors (..., k, 3), turned by values (k,)."""
        if not self.revolute:
            return v
        return np.asarray(v + np.sin(value)[:, None] * (v @ self.K) + (1 - np.cos(value))[:, None] * (v @ self.square))

    def point(self, value: Array, p: Array) -> Array:
        """Return points (k, 3), moved by values (k,)."""
        if not self.revolute:
            return np.asarray(p + value[:, None] * self.direction)
        return np.asarray(self.place + self.vectors(value, p - self.place))

    def velocity(self, p: Array) -> Array:
        """Return how fast points (k, 3) move at unit speed."""
        return np.asarray((p - self.place) @ self.K) if self.revolute else np.broadcast_to(self.direction, p.shape)


def chain_map(axes: Sequence[Axis], tip: Array) -> ChainMap:
    """Return the map of joints that move a tip (3,)."""
    return ChainMap(tuple(axes), np.array(tip))
