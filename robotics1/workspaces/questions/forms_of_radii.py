"""The smallest and largest distance from the first joint's axis as formulas, of any planar chain that begins to turn.

Where |p − c| is extreme, each joint after the first is at a limit, or |p − c| does not change with it. If such a joint
turns, its centre o is in line with c and p: |p − c| is |o − c| + |p − o|, or the difference. If it slides, the distance
between the two centres around it is that from a line. So the distance is a sum of lengths, with signs, in each of which
the joints are at limits. Which joints those are is read from the exact workspace of the arm as it is.
"""

from itertools import pairwise, product
from typing import Any

import sympy

from robotics1.inputs import Array
from robotics1.workspaces.questions.closed_forms import ClosedForm, PlaneFormulas, root_of
from robotics1.workspaces.result import Workspace

AT_LIMIT = 1e-6  # rad, or of a slide's values
AGREE = 1e-9  # of the distance, relative


def form_of_radii(arm: PlaneFormulas, exact: Workspace) -> ClosedForm | None:
    """Return r_min and r_max, and the area of an annulus; None if the first joint slides."""
    if not arm.joints[0].revolute:
        return None
    found = [_extreme(arm, q, r, exact.r_max) for q, r in ((exact.nearest, exact.r_min), (exact.farthest, exact.r_max))]
    (inner, below, _), (outer, above, lengths) = found
    if inner is None or outer is None:
        return None
    area = sympy.pi * (outer**2 - inner**2) if arm.joints[0].circular else None
    if area is None or abs(arm.number(area) - exact.area) > AGREE * exact.area:
        area = None
    words = [f"{name} holds where {where}." for name, where in (("r_min", below), ("r_max", above)) if where]
    return ClosedForm(inner, outer, area, tuple(lengths), tuple(words))


def _extreme(arm: PlaneFormulas, configurations: Array, r: float, size: float) -> tuple[Any, str, list[Any]]:
    """Return a distance, what holds of the joints there, and the lengths that it is made of; None if none agrees."""
    if r < AGREE * size:
        return sympy.Integer(0), "", []
    for q in configurations:
        at_limit, free = _state(arm, q)
        lengths = [_between(arm, a, b, at_limit, free) for a, b in pairwise([0, *free["R"], len(arm.joints)])]
        for signs in product((1, -1), repeat=len(lengths)):
            total = sum(sign * length for sign, length in zip(signs, lengths, strict=True))
            if abs(arm.number(total) - r) < AGREE * size:
                return sympy.simplify(total), _words(arm, at_limit, free), lengths
    return None, "", []


def _state(arm: PlaneFormulas, q: Array) -> tuple[dict[Any, Any], dict[str, list[int]]]:
    """Return the ends at which joints after the first are, by their symbols, and the numbers of the others, by kind."""
    at_limit: dict[Any, Any] = {}
    free: dict[str, list[int]] = {"R": [], "P": []}
    for k, joint in enumerate(arm.joints[1:], start=1):
        symbol = arm.q[joint.number]
        ends = {name: arm.number(arm.end(k, name)) for name in ("min", "max")}
        near = [name for name, end in ends.items() if abs(q[joint.number] - end) < AT_LIMIT * max(1.0, abs(end))]
        if near and not joint.circular:
            at_limit[symbol] = arm.end(k, near[0])
        else:
            free["R" if joint.revolute else "P"].append(k)
    return at_limit, free


def _between(arm: PlaneFormulas, a: int, b: int, at_limit: dict[Any, Any], free: dict[str, list[int]]) -> Any:
    """Return the distance from the centre of joint a to that of joint b, or to the tip."""
    square = arm.square_between(a, b, at_limit)
    for k in free["P"]:
        slide = arm.q[arm.joints[k].number]
        if a < k < b and square.has(slide):
            square = sympy.simplify(square.subs(slide, sympy.solve(sympy.diff(square, slide), slide)[0]))
    return root_of(square)


def _words(arm: PlaneFormulas, at_limit: dict[Any, Any], free: dict[str, list[int]]) -> str:
    words = [f"{symbol} = {end}" for symbol, end in at_limit.items()]
    straight = [str(arm.q[arm.joints[k].number]) for k in free["R"]]
    words += [f"the arm is straight or folded at {', '.join(straight)}"] if straight else []
    across = [str(arm.q[arm.joints[k].number]) for k in free["P"]]
    words += [f"{', '.join(across)} is nearest to a centre"] if across else []
    return " and ".join(words)
