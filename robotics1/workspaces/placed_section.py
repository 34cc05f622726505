"""A section of a workspace, and where it is in the world: what answers questions about a point."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_array
from robotics1.workspaces.axes import Axis, across

ROOM = 0.02  # of the size of a box around what is reached, beyond what is known to be


@dataclass(frozen=True, eq=False)
class SectionFrame:
    """The coordinates of a section, and the joint before the others, which moves it: the base.

    With p = frame (P − origin) they are (p₁, p₂); or ρ = √(p₁² + p₂²) and h = p₃ if the base turns the section.

    Attributes:
        rows: (m, 3) the rows of the task: r = rows P.
        origin, frame: (3,) [m], and (3, 3) with unit vectors as rows; the base is along the last one.
        base: what turns the section about the last axis, or slides it along that; None of a task with two coordinates.
        neutral: (nq,) the values of the joints that do not move the point [rad or m].
    """

    rows: Array
    origin: Array
    frame: Array
    base: Axis | None
    neutral: Array

    @property
    def about_axis(self) -> bool:
        """Whether the section is (ρ, h)."""
        return self.base is not None and self.base.revolute

    @property
    def limited(self) -> bool:
        """Whether there is a base that makes no full turn."""
        return self.base is not None and not self.base.circular

    def local(self, p: npt.ArrayLike) -> Array:
        """Return a point (m,) of the task in the frame (3,) [m].

        Raises:
            InputError: p has another shape or is not finite.
        """
        point = self.rows.T @ real_array("p", p, (len(self.rows),), "the task's coordinates [m]")
        return np.asarray(self.frame @ (point - self.origin))

    def coordinates(self, p: npt.ArrayLike) -> Array:
        """Return the coordinates (2,) of a point (m,) of the task in the section [m]."""
        return in_section(self.local(p), self.about_axis)

    @property
    def names(self) -> tuple[str, str]:
        """Names of the section's coordinates: letters of world axes, ρ and h, or u and v."""
        if self.about_axis:
            return "ρ", "h"
        letters = ["xyz"[int(np.argmax(axis))] if np.max(axis) > 1 - 1e-9 else "" for axis in self.frame[:2]]
        return (letters[0], letters[1]) if all(letters) else ("u", "v")


def in_section(p: Array, about_axis: bool) -> Array:
    """Return the coordinates (..., 2) of points (..., 3) in the frame of a section."""
    if not about_axis:
        return p[..., :2]
    return np.stack([np.hypot(p[..., 0], p[..., 1]), p[..., 2]], axis=-1)


def frame_of_section(base: Axis | None, rows: Array) -> tuple[Array, Array]:
    """Return axes (3, 3) of a section, and its origin (3,): of a slide it starts at 0."""
    if base is None:
        return np.vstack([rows, np.cross(rows[0], rows[1])]), np.zeros(3)
    a = base.direction
    if base.revolute:
        first = across(a)
        return np.array([first, np.cross(a, first), a]), base.point - (base.point @ a) * a  # h is one of the world
    first, second = plane_across(a)
    return np.array([first, second, a]), np.zeros(3)


def plane_across(direction: Array) -> tuple[Array, Array]:
    """Return two unit vectors normal to a direction: axes of the world if these are."""
    normal = direction * np.sign(direction[np.argmax(np.abs(direction))])
    first = across(normal)
    return first, np.cross(normal, first)


@dataclass(frozen=True, eq=False)
class PlacedSection(ABC):
    """A section of a workspace, and where it is."""

    place: SectionFrame

    @abstractmethod
    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point (m,) is reached."""

    @abstractmethod
    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return configurations (k, nq) that reach a point (m,), some if there are infinitely many."""

    @abstractmethod
    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point (m,) from the boundary [m]."""

    @abstractmethod
    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative where it is outside."""

    @abstractmethod
    def _extent(self) -> tuple[Array, tuple[float, float]]:
        """Return points (k, 2) of the section's boundary, and the range of the third coordinate [m]."""

    def clearance(self, p: npt.ArrayLike) -> float:
        """Return a length [m] that the distance is not below, perhaps in less time."""
        return self.distance(p)

    def contains_each(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return which points (k, m) are reached."""
        return np.array([self.contains(p) for p in points], dtype=bool)

    def sphere_ranges(self, place: Array) -> list[tuple[float, float]]:
        """Return the smallest and largest distance of a point at (ρ, h) [m] from each turned part of the boundary."""
        return []

    def full_turn(self) -> tuple[Array, Array] | None:
        """Return a point (3,) and the direction (3,) of the axis about which a first joint turns fully; or None."""
        base = self.place.base
        return (base.point, base.direction) if base is not None and base.circular else None

    def corners(self) -> Array:
        """Return the corners (8, 3) of a box around what is reached, in world axes [m]."""
        z, heights = self._extent()
        if self.place.about_axis:
            far, heights = float(np.abs(z[:, 0]).max()), (z[:, 1].min(), z[:, 1].max())
            z = np.array([[-far, -far], [far, far]])
        ends = np.column_stack([np.array([z.min(axis=0), z.max(axis=0)]), heights])
        room = ROOM * float((ends[1] - ends[0]).max())
        ends += [[-room], [room]]
        box = np.array([[ends[i, k] for k, i in enumerate(pick)] for pick in product((0, 1), repeat=3)])
        return box @ self.place.frame + self.place.origin
