"""Lines, arcs of circles, circles, ellipses and helices; all but ellipses by their arc length."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from robotics1.curves.harmonic import HarmonicCurve
from robotics1.errors import InputError
from robotics1.inputs import LARGEST, Array, moderate_array, positive_number, real_number

PARALLEL = 1e-9  # the sine of an angle that counts as zero, and lengths that count as equal
SAME_POINT = 1e-12  # relative to the coordinates: points so near are the same


def line_path(p0: npt.ArrayLike, p1: npt.ArrayLike) -> HarmonicCurve:
    """Return the segment p(s) = p0 + s (p1 − p0)/L, 0 ≤ s ≤ L = |p1 − p0|, with s the arc length.

    Args:
        p0, p1: (n,) start and end: Cartesian [m] or joint values.

    Raises:
        InputError: the points are the same, or of different lengths.
    """
    p0 = moderate_array("p0", p0)
    p1 = moderate_array("p1", p1, p0.shape, "a point like p0")
    length = distance("p0", p0, "p1", p1)
    none = np.zeros_like(p0)
    return HarmonicCurve(p0, none, none, (p1 - p0) / length, 1.0, length, True)


def ellipse_path(
    centre: npt.ArrayLike, a: npt.ArrayLike, b: npt.ArrayLike, *, angle: float = 2 * np.pi
) -> HarmonicCurve:
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
    c = moderate_array("centre", centre)
    a, b = (moderate_array(name, axis, c.shape, "a vector like centre") for name, axis in (("a", a), ("b", b)))
    sizes = np.linalg.norm(a), np.linalg.norm(b)
    if min(sizes) < 1 / LARGEST or abs(a @ b) > PARALLEL * sizes[0] * sizes[1]:
        raise InputError(f"a and b must be the semi-axes, normal to each other and not zero; a·b is {a @ b:.4g}")
    return HarmonicCurve(c, a, b, np.zeros_like(c), 1.0, positive_number("angle", angle))


def helix_path(
    centre: npt.ArrayLike, start: npt.ArrayLike, pitch: float, turns: float, *, normal: npt.ArrayLike = (0.0, 0.0, 1.0)
) -> HarmonicCurve:
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
    h = float(moderate_array("pitch", pitch, (), "a length")) / (2 * np.pi)
    angle = 2 * np.pi * positive_number("turns", turns)
    return turning(c, a, np.cross(n, a), h * n, angle)


def arc_path(
    centre: npt.ArrayLike, start: npt.ArrayLike, angle: float, *, normal: npt.ArrayLike | None = None
) -> HarmonicCurve:
    """Return the arc p(s) = c + a cos(s/r) + n × a sin(s/r) with a = start − c, 0 ≤ s ≤ r |angle|, s the arc length.

    Args:
        centre: c, (2,) or (3,) [m].
        start: (2,) or (3,) where the arc begins [m].
        angle: counter-clockwise about the normal [rad]; negative: clockwise.
        normal: (3,) n, of the plane in space; by default z. In the plane there is none.

    Raises:
        InputError: the start is the centre or not in the plane, or the angle is zero.
    """
    c = moderate_array("centre", centre)
    angle = real_number("angle", angle)
    if angle == 0:
        raise InputError("angle must not be zero: the arc has no length")
    turned = positive_number("|angle|", abs(angle))
    if len(c) == 2 and normal is None:
        p = moderate_array("start", start, (2,))
        distance("centre", c, "start", p)
        a: Array = p - c
        b: Array = np.array([-a[1], a[0]])
    else:
        c, a, n = about_axis(centre, start, (0.0, 0.0, 1.0) if normal is None else normal)
        b = np.cross(n, a)
    return turning(c, a, np.copysign(1.0, angle) * b, np.zeros_like(c), turned)


def circle_path(centre: npt.ArrayLike, radius: float, *, normal: npt.ArrayLike | None = None) -> HarmonicCurve:
    """Return the circle, counter-clockwise about the normal, by its arc length.

    It begins in the direction of x from the centre, or of its projection on the plane; where x is the normal, of y.

    Args:
        centre: (2,) or (3,) [m].
        radius: [m], positive.
        normal: (3,) of the plane in space; by default z. In the plane there is none.

    Raises:
        InputError: the radius is not positive, or a shape is wrong.
    """
    from robotics1.orientation.elementary import unit_vector

    c = moderate_array("centre", centre)
    radius = positive_number("radius", radius)
    if len(c) == 2 and normal is None:
        return arc_path(c, c + np.array([radius, 0.0]), 2 * np.pi)
    n = unit_vector("normal", (0.0, 0.0, 1.0) if normal is None else normal)
    x = np.eye(3)[0 if np.hypot(n[1], n[2]) > PARALLEL else 1]
    start = moderate_array("centre", c, (3,)) + radius * unit_vector("x", x - (x @ n) * n)
    return arc_path(c, start, 2 * np.pi, normal=n)


def arc_through(p0: npt.ArrayLike, p1: npt.ArrayLike, p2: npt.ArrayLike) -> HarmonicCurve:
    """Return the arc from p0 over p1 to p2, by its arc length, in space of any dimension.

    With u = p1 − p0 and v = p2 − p0, the centre is p0 + w, where w·u = |u|²/2, w·v = |v|²/2 and w is in their plane.

    Args:
        p0, p1, p2: (n,) three points [m].

    Raises:
        InputError: two of the points are the same, or the three are on a line.
    """
    p0 = moderate_array("p0", p0)
    p1, p2 = (moderate_array(name, p, p0.shape, "a point like p0") for name, p in (("p1", p1), ("p2", p2)))
    u, v = p1 - p0, p2 - p0
    sizes = distance("p0", p0, "p1", p1), distance("p0", p0, "p2", p2)
    distance("p1", p1, "p2", p2)
    directions = np.column_stack([u / sizes[0], v / sizes[1]])
    if np.linalg.svd(directions, compute_uv=False)[-1] <= PARALLEL:
        raise InputError(
            f"p0, p1 and p2 must not be on a line, or no circle goes through them; they are "
            f"{p0.tolist()}, {p1.tolist()}, {p2.tolist()}"
        )
    c = p0 + np.linalg.pinv(directions.T) @ (np.array(sizes) / 2)  # the shortest w is in the plane
    a = p0 - c
    b = max((w - (w @ a) / (a @ a) * a for w in (u, v)), key=lambda part: float(part @ part))  # one may be a diameter
    b = b * np.linalg.norm(a) / np.linalg.norm(b)
    first, last = (np.arctan2((p - c) @ b, (p - c) @ a) % (2 * np.pi) for p in (p1, p2))
    if first > last:  # the other way round
        b, last = -b, 2 * np.pi - last
    return turning(c, a, b, np.zeros_like(c), float(last))


def turning(c: Array, a: Array, b: Array, h: Array, angle: float) -> HarmonicCurve:
    """Return the path with |a| = |b| and h normal to both, by its arc length, over an angle [rad]."""
    speed = float(np.hypot(np.linalg.norm(a), np.linalg.norm(h)))
    return HarmonicCurve(c, a, b, h, 1 / speed, speed * angle, True)


def about_axis(centre: npt.ArrayLike, start: npt.ArrayLike, normal: npt.ArrayLike) -> tuple[Array, Array, Array]:
    """Return the centre, the vector from it to the start, and the unit normal, (3,) each, if they fit."""
    from robotics1.orientation.elementary import unit_vector

    c, p = moderate_array("centre", centre, (3,)), moderate_array("start", start, (3,))
    n = unit_vector("normal", normal)
    radius = distance("centre", c, "start", p)
    if abs((p - c) @ n) > PARALLEL * radius:
        raise InputError(f"start must be in the plane of the centre; it is {(p - c) @ n:.4g} m off along the normal")
    a = p - c
    return c, a - (a @ n) * n, n


def distance(name: str, p: Array, other: str, q: Array) -> float:
    """Return |q − p|.

    Raises:
        InputError: the points are the same, or nearer than 1e-30.
    """
    length = float(np.linalg.norm(q - p))
    if length <= max(SAME_POINT * float(np.abs([p, q]).max(initial=0.0)), 1 / LARGEST):
        raise InputError(f"{name} and {other} must be different points; both are {p.tolist()}")
    return length
