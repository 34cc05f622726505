"""Arcs of circles: about a centre, through three points, whole circles; each by its arc length."""

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_number
from robotics1.paths.harmonic import PARALLEL, HarmonicPath, about_axis, turning
from robotics1.paths.points import distance, point, size


def arc_path(
    centre: npt.ArrayLike, start: npt.ArrayLike, angle: float, *, normal: npt.ArrayLike | None = None
) -> HarmonicPath:
    """Return the arc p(s) = c + a cos(s/r) + n × a sin(s/r) with a = start − c, 0 ≤ s ≤ r |angle|, s the arc length.

    Args:
        centre: c, (2,) or (3,) [m].
        start: (2,) or (3,) where the arc begins [m].
        angle: counter-clockwise about the normal [rad]; negative: clockwise.
        normal: (3,) n, of the plane in space; by default z. In the plane there is none.

    Raises:
        InputError: the start is the centre or not in the plane, or the angle is zero.
    """
    c = point("centre", centre)
    angle = real_number("angle", angle)
    if angle == 0:
        raise InputError("angle must not be zero: the arc has no length")
    turned = size("|angle|", abs(angle))
    if len(c) == 2 and normal is None:
        p = point("start", start, (2,))
        distance("centre", c, "start", p)
        a: Array = p - c
        b: Array = np.array([-a[1], a[0]])
    else:
        c, a, n = about_axis(centre, start, (0.0, 0.0, 1.0) if normal is None else normal)
        b = np.cross(n, a)
    return turning(c, a, np.copysign(1.0, angle) * b, np.zeros_like(c), turned)


def circle_path(centre: npt.ArrayLike, radius: float, *, normal: npt.ArrayLike | None = None) -> HarmonicPath:
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

    c = point("centre", centre)
    radius = size("radius", radius)
    if len(c) == 2 and normal is None:
        return arc_path(c, c + np.array([radius, 0.0]), 2 * np.pi)
    n = unit_vector("normal", (0.0, 0.0, 1.0) if normal is None else normal)
    x = np.eye(3)[0 if np.hypot(n[1], n[2]) > PARALLEL else 1]
    start = point("centre", c, (3,)) + radius * unit_vector("x", x - (x @ n) * n)
    return arc_path(c, start, 2 * np.pi, normal=n)


def arc_through(p0: npt.ArrayLike, p1: npt.ArrayLike, p2: npt.ArrayLike) -> HarmonicPath:
    """Return the arc from p0 over p1 to p2, by its arc length, in space of any dimension.

    With u = p1 − p0 and v = p2 − p0, the centre is p0 + w, where w·u = |u|²/2, w·v = |v|²/2 and w is in their plane.

    Args:
        p0, p1, p2: (n,) three points [m].

    Raises:
        InputError: two of the points are the same, or the three are on a line.
    """
    p0 = point("p0", p0)
    p1, p2 = (point(name, p, p0.shape, "a point like p0") for name, p in (("p1", p1), ("p2", p2)))
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
    b = max((_normal_part(w, a) for w in (u, v)), key=lambda part: float(part @ part))  # one may be a diameter
    b = b * np.linalg.norm(a) / np.linalg.norm(b)
    first, last = (np.arctan2((p - c) @ b, (p - c) @ a) % (2 * np.pi) for p in (p1, p2))
    if first > last:  # the other way round
        b, last = -b, 2 * np.pi - last
    return turning(c, a, b, np.zeros_like(c), float(last))


def _normal_part(v: Array, a: Array) -> Array:
    return np.asarray(v - (v @ a) / (a @ a) * a)
