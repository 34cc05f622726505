"""Sizes of workspaces of a plane chain that a first joint turns about an axis: shells, rings, and sectors of shells.

By Pappus a volume is the angle of the turn times ∫ ρ dA over what the plane reaches at ρ ≥ 0, on both of its sides.
"""

from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np
import sympy

from robotics1.workspaces.questions.closed_forms import ClosedForm, PlaneFormulas

NONE_BELOW = 1e-12  # of a direction's component, which is 0 at the end of a range


@dataclass(frozen=True, eq=False)
class TurnedPlane:
    """A plane chain that a first joint turns.

    Attributes:
        plane: the position (ρ, h) of the tip in the plane, at q1 = 0.
        flat: what is known of the chain in its plane.
        beside: the distance of the plane from the axis, a formula.
        angle: the range of the turn, a formula.
        full: whether it is a full turn.
    """

    plane: PlaneFormulas
    flat: ClosedForm
    beside: Any
    angle: Any
    full: bool


def form_in_space(arm: TurnedPlane) -> dict[str, Any] | None:
    """Return r_min, r_max, volume and conditions, or None."""
    if arm.flat.r_max is None or not arm.plane.joints[0].revolute:
        return None
    a = sympy.simplify(arm.plane.centre(0)[0])
    if not arm.plane.joints[0].circular:
        return _sector(arm) if a == 0 and arm.beside == 0 else None
    if a == 0:
        return _shell(arm)
    return _beside_the_axis(arm, without_sign(a)) if arm.full and arm.beside == 0 else None


def without_sign(length: Any) -> Any:
    """Return |length|; a name is that of a positive one."""
    return -length if length.could_extract_minus_sign() else length


def _shell(arm: TurnedPlane) -> dict[str, Any] | None:
    """Return the shell between two spheres, whose points are moved away from the axis if the plane is beside it.

    ρ² = u² + d² with u in the plane, so that ρ dρ = u du: the volume is that of the shell itself.
    """
    inner, outer, d = arm.flat.r_min, arm.flat.r_max, arm.beside
    if d != 0 and not arm.full:
        return None
    share = 1 if arm.full else sympy.Min(arm.angle, sympy.pi) / sympy.pi  # the plane's two sides, half a turn apart
    return {
        "r_min": d,
        "r_max": outer if d == 0 else sympy.sqrt(outer**2 + d**2),
        "volume": share * sympy.Rational(4, 3) * sympy.pi * (outer**3 - inner**3),
        "conditions": arm.flat.conditions,
    }


def _beside_the_axis(arm: TurnedPlane, a: Any) -> dict[str, Any]:
    """Return the ring that an annulus about a point at ρ = a draws, and what its other side reaches."""
    inner, outer = arm.flat.r_min, arm.flat.r_max
    known = {"r_min": sympy.Max(0, a - outer), "r_max": a + outer, "volume": None, "conditions": ()}
    if arm.plane.number(outer) <= arm.plane.number(a):
        known["volume"] = 2 * sympy.pi**2 * a * (outer**2 - inner**2)
        known["conditions"] = (f"The volume holds if {outer} <= {a}: the arm stays off the axis.",)
    elif arm.plane.number(2 * a + inner) <= arm.plane.number(outer):
        has_hole = arm.plane.number(inner) > arm.plane.number(a)
        known["volume"] = 2 * sympy.pi * (_moment(a, outer) - (_moment(-a, inner) if has_hole else 0))
        hole = f"{inner} {'>' if has_hole else '<='} {a}"
        condition = f"The volume holds if {2 * a + inner} <= {outer} and {hole}: the arm reaches over its axis."
        known["conditions"] = (condition,)
    return known


def _moment(a: Any, radius: Any) -> Any:
    """Return ∫ ρ dA over the part at ρ ≥ 0 of a disc about ρ = a that the axis cuts."""
    area = radius**2 * (sympy.pi - sympy.acos(a / radius)) + a * sympy.sqrt(radius**2 - a**2)
    return a * area + sympy.Rational(2, 3) * (radius**2 - a**2) ** sympy.Rational(3, 2)


def _sector(arm: TurnedPlane) -> dict[str, Any] | None:
    """Return the sector of a shell that a slide through the shoulder draws on one side of the axis.

    With the elevation φ(q2) and the stroke s: V = Δq1 ∫ s² ds ∫ cos φ dφ.
    """
    if arm.plane.kinds != "RP" or arm.flat.lengths != (0,):
        return None
    shoulder, slide = arm.plane.joints
    q2, q3 = (arm.plane.q[joint.number] for joint in (shoulder, slide))
    along, up = (sympy.simplify(arm.plane.value[k].diff(q3)) for k in range(2))
    q = np.linspace(shoulder.lower, shoulder.upper, 60)
    cosines = np.array([arm.plane.number(along.subs(q2, x)) for x in q])
    if slide.lower * slide.upper < 0 or cosines.min() * cosines.max() < -NONE_BELOW or np.ptp(q) > pi + NONE_BELOW:
        return None
    ends = [{q2: arm.plane.end(0, name)} for name in ("min", "max")]
    cos_ends = [sympy.Abs(along.subs(end)) for end in ends]
    inner, outer = arm.flat.r_min, arm.flat.r_max
    level = np.abs(cosines).argmax() not in (0, len(q) - 1)
    sines = sympy.Abs(up.subs(ends[1]) - up.subs(ends[0]))
    return {
        "r_min": inner * sympy.Min(*cos_ends),
        "r_max": outer if level else outer * sympy.Max(*cos_ends),
        "volume": arm.angle * (outer**3 - inner**3) / 3 * sines,
        "conditions": (
            f"The volume holds if the range of {q2} keeps the slide on one side of the axis.",
            f"r_max holds if the slide can{' ' if level else 'not '}be across the axis.",
        ),
    }
