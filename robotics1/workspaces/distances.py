"""How far a point is from an arc or a segment, and where these are nearest and farthest."""

from robotics1.workspaces.critical_curves import TOLERANCE, CriticalCurve


def distance_to_curve(curve: CriticalCurve, z: complex) -> float:
    """Return the least distance of a point from a curve."""
    return min(abs(curve.point(t) - z) for t in extreme_positions(curve, z))


def largest_distance(curve: CriticalCurve, z: complex) -> float:
    """Return the largest distance of a point from a curve."""
    return max(abs(curve.point(t) - z) for t in extreme_positions(curve, z))


def extreme_positions(curve: CriticalCurve, z: complex) -> list[float]:
    """Return t of the ends of a curve, and of where its distance from a point is stationary.

    Of an arc about the point, whose distance is the same everywhere, it is the middle.
    """
    if curve.centre is None:
        points = [curve.start + ((z - curve.start) * curve.direction.conjugate()).real * curve.direction]
    else:
        away = z - curve.centre
        if abs(away) < TOLERANCE:
            return [curve.length / 2]
        points = [curve.centre + sign * away / abs(away) * curve.radius for sign in (1, -1)]
    return [0.0, curve.length, *(t for t in map(curve.position, points) if t is not None)]
