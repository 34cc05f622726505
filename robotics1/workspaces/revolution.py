"""A plane that turns about an axis in it: its two halves sweep the same space, one half a turn after the other."""

from cmath import phase
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import cos, pi, sin, tau

from robotics1.workspaces.arrangement import Divider, Loop, dividers
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.pieces import cut
from robotics1.workspaces.section import Section

ON_AXIS = -1  # in place of the joint that draws the axis


@dataclass(frozen=True)
class HalfPlane:
    """The workspace in one half plane from the axis, ρ ≥ 0, z = ρ + i h.

    Attributes:
        section: of the whole plane.
        sides: 1 for what the plane's positive side reaches, −1 for the negative one, which is mirrored.
        base: the place in q of the joint that turns the plane.
        divided: the pieces on whose sides the number of solutions differs; those on the axis are no boundary.
    """

    section: Section
    sides: tuple[int, ...]
    base: int
    divided: tuple[Divider, ...] = ()

    def count(self, z: complex) -> int:
        """Return the number of solutions at (ρ, h); of a redundant arm, whether there is one."""
        if z.real < 0:
            return 0
        found = sum(self.section.count(z if side > 0 else -z.conjugate()) for side in self.sides)
        return found if len(self.section.joints) == 2 else min(found, 1)


def half_plane(section: Section, sides: Sequence[int], base: int) -> HalfPlane:
    """Return the workspace in a half plane of what one side of the plane, or both, reach."""
    whole = [divider.piece.curve for divider in section.divided]
    far = 1 + max((abs(curve.point(t)) for curve in whole for t in (0.0, curve.length / 2, curve.length)), default=0.0)
    q = tuple(whole[0].q) if whole else (0.0,)
    curves = [CriticalCurve(None, complex(0, -2 * far), 1j, 4 * far, q, ON_AXIS, 0)]
    for side in sides:
        curves += whole if side > 0 else [_mirrored(curve, base) for curve in whole]
    half = HalfPlane(section, tuple(sides), base)
    return replace(half, divided=tuple(dividers(cut(curves), half.count)))


def _mirrored(curve: CriticalCurve, base: int) -> CriticalCurve:
    """Return the curve on the other side of the axis, in counter-clockwise direction, with the base half a turn on."""
    q = list(curve.configuration(curve.length))
    q[base] += pi
    return replace(
        curve,
        centre=None if curve.centre is None else -curve.centre.conjugate(),
        start=-curve.point(curve.length).conjugate(),
        direction=curve.direction.conjugate(),
        q=tuple(q),
        rate=-curve.rate,
    )


def angles_of_sides(range_of_base: float) -> tuple[float, float]:
    """Return the angle [rad] that both sides of the plane sweep, and that which each side sweeps alone."""
    both = max(0.0, 2 * (range_of_base - pi)) if range_of_base < tau else tau
    return both, min(range_of_base, tau) - both


def moment_within(loop: Loop) -> float:
    """Return ∫ x dA = ½ ∮ x² dy of what a loop goes around, exact on arcs and segments."""
    return sum(_moment_under(edge.curve) if edge.forward else -_moment_under(edge.curve) for edge in loop)


def _moment_under(curve: CriticalCurve) -> float:
    start, end = curve.start, curve.point(curve.length)
    if curve.centre is None:
        a, b = start.real, end.real
        return (end.imag - start.imag) * (a * a + a * b + b * b) / 6
    c, r = curve.centre.real, curve.radius
    begin = phase(start - curve.centre)

    def primitive(t: float) -> float:
        return (c * c * r * sin(t) + c * r * r * (t + sin(t) * cos(t)) + r**3 * (sin(t) - sin(t) ** 3 / 3)) / 2

    return primitive(begin + curve.length) - primitive(begin)
