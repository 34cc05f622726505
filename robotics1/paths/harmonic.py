"""Lines, arcs, circles, ellipses and helices: one formula for all of them.

p(u) = c + a cos u + b sin u + h u. A line has a = b = 0; a circle a ⊥ b of equal length; an ellipse of any length; a
helix h normal to both. But for the ellipse |p'| is constant, and u = s/√(|a|² + |h|²) makes s the arc length.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.path import Path
from robotics1.paths.points import LARGEST, distance, point, size

PARALLEL = 1e-9  # the sine of an angle that counts as zero, and lengths that count as equal


@dataclass(frozen=True, eq=False)
class HarmonicPath(Path):
    """p(s) = c + a cos ωs + b sin ωs + h ωs, 0 ≤ s ≤ end.

    Attributes:
        c: (n,) the centre [m]; of a line its start.
        a: (n,) from the centre to where s = 0.
        b: (n,) from the centre to a quarter of a turn later.
        h: (n,) rise per radian; of a line its direction.
        omega: ω, radians per unit of s.
        end: the last s.
        unit_speed: whether s is the arc length.
    """

    c: Array
    a: Array
    b: Array
    h: Array
    omega: float
    end: float = 0.0
    unit_speed: bool = True

    @property
    def dimension(self) -> int:
        """The number of coordinates, n."""
        return len(self.c)

    @property
    def is_unit_speed(self) -> bool:
        """Whether s is the arc length: of all but ellipses."""
        return self.unit_speed

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        u = self.omega * s[:, None]
        quarter = order * np.pi / 2  # each derivative turns the cosine by a quarter
        wave = self.a * np.cos(u + quarter) + self.b * np.sin(u + quarter)
        straight = self.c + self.h * u if order == 0 else self.h * np.ones_like(u) if order == 1 else 0 * u
        return np.asarray(self.omega**order * wave + straight * (self.omega if order == 1 else 1.0))


def line_path(p0: npt.ArrayLike, p1: npt.ArrayLike) -> HarmonicPath:
    """Return the segment p(s) = p0 + s (p1 − p0)/L, 0 ≤ s ≤ L = |p1 − p0|, with s the arc length.

    Args:
        p0, p1: (n,) start and end: Cartesian [m] or joint values.

    Raises:
        InputError: the points are the same, or of different lengths.
    """
    p0 = point("p0", p0)
    p1 = point("p1", p1, p0.shape, "a point like p0")
    length = distance("p0", p0, "p1", p1)
    none = np.zeros_like(p0)
    return HarmonicPath(p0, none, none, (p1 - p0) / length, 1.0, length)


def ellipse_path(
    centre: npt.ArrayLike, a: npt.ArrayLike, b: npt.ArrayLike, *, angle: float = 2 * np.pi
) -> HarmonicPath:
    """Return p(u) = c + a cos u + b sin u, 0 ≤ u ≤ angle; u is the eccentric angle, not the arc length.

    Its curvature is largest, |a|/|b|², at the ends of the longer axis a. `by_arc_length` makes s the arc length.

    Args:
        centre: c, (n,) [m].
        a: (n,) the semi-axis from the centre to the start [m].
        b: (n,) the semi-axis normal to it, towards which the path sets out [m].
        angle: the last u [rad].

    Raises:
        InputError: a and b are not normal to each other, one of them is zero, or the angle is not positive.
    """
    c = point("centre", centre)
    a, b = (point(name, axis, c.shape, "a vector like centre") for name, axis in (("a", a), ("b", b)))
    sizes = np.linalg.norm(a), np.linalg.norm(b)
    if min(sizes) < 1 / LARGEST or abs(a @ b) > PARALLEL * sizes[0] * sizes[1]:
        raise InputError(f"a and b must be the semi-axes, normal to each other and not zero; a·b is {a @ b:.4g}")
    return HarmonicPath(c, a, b, np.zeros_like(c), 1.0, size("angle", angle), False)


def helix_path(
    centre: npt.ArrayLike, start: npt.ArrayLike, pitch: float, turns: float, *, normal: npt.ArrayLike = (0.0, 0.0, 1.0)
) -> HarmonicPath:
    """Return the helix from a point about an axis, p(s) = c + a cos ωs + b sin ωs + (pitch/2π) n ωs, s the arc length.

    With the radius r and h = pitch/2π: κ = r/(r² + h²), τ = h/(r² + h²), length 2π turns √(r² + h²).

    Args:
        centre: (3,) a point of the axis, on the level of the start [m].
        start: (3,) where the path begins [m].
        pitch: the rise along the normal in one turn [m]; negative for a left-handed helix.
        turns: how many turns, positive.
        normal: (3,) the axis's direction; the path turns about it counter-clockwise.

    Raises:
        InputError: the start is on the axis or on another level, or turns is not positive.
    """
    c, a, n = about_axis(centre, start, normal)
    h = float(point("pitch", pitch, (), "a length")) / (2 * np.pi)
    angle = 2 * np.pi * size("turns", turns)
    return turning(c, a, np.cross(n, a), h * n, angle)


def turning(c: Array, a: Array, b: Array, h: Array, angle: float) -> HarmonicPath:
    """Return the path with |a| = |b| and h normal to both, by its arc length, over an angle [rad]."""
    speed = float(np.hypot(np.linalg.norm(a), np.linalg.norm(h)))
    return HarmonicPath(c, a, b, h, 1 / speed, speed * angle)


def about_axis(centre: npt.ArrayLike, start: npt.ArrayLike, normal: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """Return the centre, the vector from it to the start, and the unit normal, (3,) each, if they fit."""
    from robotics1.orientation.elementary import unit_vector

    c, p = point("centre", centre, (3,)), point("start", start, (3,))
    n = unit_vector("normal", normal)
    radius = distance("centre", c, "start", p)
    if abs((p - c) @ n) > PARALLEL * radius:
        raise InputError(f"start must be in the plane of the centre; it is {(p - c) @ n:.4g} m off along the normal")
    a = p - c
    return c, a - (a @ n) * n, n
