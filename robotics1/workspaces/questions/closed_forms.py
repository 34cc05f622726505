"""Sizes of workspaces as formulas in the lengths of links and the ends of strokes.

The lengths are distances between the centres of joints that turn: the mean of p over q is the centre of the joint.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import pi, tau
from typing import Any

import sympy

from robotics1.workspaces.flat.planar_joints import PlanarJoint

THIRDS = (0, 2 * sympy.pi / 3, 4 * sympy.pi / 3)  # over these the mean of cos q and of sin q is 0


@dataclass(frozen=True)
class ClosedForm:
    """What is known of an arm's workspace in the plane: None where it is not.

    Attributes:
        r_min, r_max: distances from the first joint's axis.
        area: of the workspace.
        lengths: of the links that count.
        conditions: what decides between cases, in words.
    """

    r_min: Any
    r_max: Any
    area: Any
    lengths: tuple[Any, ...]
    conditions: tuple[str, ...] = ()


@dataclass(frozen=True)
class PlaneFormulas:
    """The position (2, 1) of a planar chain as a formula in q.

    Attributes:
        value: the position.
        q: the symbols of all joints.
        joints: the joints of the chain.
        values: the names in the formulas and their values.
    """

    value: Any
    q: Sequence[Any]
    joints: Sequence[PlanarJoint]
    values: Mapping[str, float]

    @property
    def kinds(self) -> str:
        """Letters R and P, the first for the joint nearest to the base."""
        return "".join("R" if joint.revolute else "P" for joint in self.joints)

    def number(self, formula: Any) -> float:
        """Return the value of a formula."""
        known = sympy.sympify(formula)
        return float(known.subs({s: self.values[s.name] for s in known.free_symbols}))

    def end(self, k: int, name: str) -> Any:
        """Return the symbol of a limit of joint k of the chain: "min" or "max"."""
        return sympy.Symbol(f"{self.q[self.joints[k].number]}_{name}", real=True)

    def stroke(self, k: int) -> Any:
        """Return upper − lower of joint k."""
        return self.end(k, "max") - self.end(k, "min")

    def centre(self, k: int) -> Any:
        """Return where joint k of the chain is, which turns: the mean of the position over its angle; or the tip."""
        if k == len(self.joints):
            return self.value
        q = self.q[self.joints[k].number]
        return (sum((self.value.subs(q, angle) for angle in THIRDS), sympy.zeros(2, 1)) / 3).applyfunc(sympy.simplify)

    def square_between(self, a: int, b: int, at: Mapping[Any, Any] | None = None) -> Any:
        """Return the squared distance of joint a from joint b, or from the tip, with some joints' values given."""
        d = self.centre(b) - self.centre(a)
        before = {self.q[joint.number]: 0 for joint in self.joints[: a + 1]}
        return sympy.simplify(sympy.expand((d.T * d)[0].subs(before).subs(at or {})))

    def lengths(self) -> list[Any]:
        """Return the distance from each revolute joint to the next one, the last to the tip."""
        turning = [k for k, joint in enumerate(self.joints) if joint.revolute]
        return [root_of(self.square_between(a, b)) for a, b in pairwise([*turning, len(self.joints)])]


def root_of(square: Any) -> Any:
    """Return the root of a square of a length, whose names are positive."""
    square = sympy.factor(sympy.simplify(square))
    positive = {s: sympy.Symbol(s.name, positive=True) for s in square.free_symbols if "_m" not in s.name}
    back = {p: s for s, p in positive.items()}
    return sympy.sqrt(square.subs(positive)).subs(back)


def closed_form(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the sizes of a planar chain, or None."""
    turns_fully = all(joint.circular for joint in arm.joints if joint.revolute)
    if set(arm.kinds) == {"R"} and turns_fully:
        return _links(arm)
    cases: dict[str, Callable[[PlaneFormulas], ClosedForm | None]] = {
        "RR": _about_the_first, "RP": _about_the_first, "PP": _parallelogram, "PR": _swept_circle, "PRR": _swept_circle,
        "RPR": _slide_between_turns, "RRP": _slide_after_turns, "PPR": _swept_along_two,
    }  # fmt: skip
    return cases[arm.kinds](arm) if arm.kinds in cases else None


def _links(arm: PlaneFormulas) -> ClosedForm:
    """Return the annulus of revolute joints that turn fully."""
    lengths = arm.lengths()
    outer = sum(lengths)
    if len(lengths) == 2:
        inner = sympy.Abs(lengths[0] - lengths[1])
        words = (f"There is no hole if {lengths[0]} = {lengths[1]}.",)
    else:
        inner = sympy.Max(0, *(2 * length - outer for length in lengths))
        words = ("There is no hole if no link is longer than all others together.",)
    area = sympy.pi * (outer**2 - inner**2)
    return ClosedForm(inner, outer, sympy.factor(area) if len(lengths) == 2 else area, tuple(lengths), words)


def _about_the_first(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the annulus or sector between the extremes of r(q2) = |∂p/∂q1|."""
    q2, joint = arm.q[arm.joints[1].number], arm.joints[1]
    square = arm.square_between(0, 2)
    low, high = ({q2: arm.end(1, name)} for name in ("min", "max"))
    ends = [root_of(sympy.simplify(square.subs(low))), root_of(sympy.simplify(square.subs(high)))]
    if joint.revolute:
        lengths = arm.lengths()
        if (
            sympy.simplify(square - lengths[0] ** 2 - lengths[1] ** 2 - 2 * lengths[0] * lengths[1] * sympy.cos(q2))
            != 0
        ):
            return None
        stretched, folded = _inside(joint, 0.0), _inside(joint, pi)
        outer = sum(lengths) if stretched else sympy.Max(*ends)
        inner = sympy.Abs(lengths[0] - lengths[1]) if folded else sympy.Min(*ends)
        crosses = stretched or folded
    else:
        foot = sympy.solve(sympy.diff(square, q2), q2)[0]
        lengths = [root_of(sympy.simplify(square.subs(q2, foot)))]
        crosses = joint.lower < arm.number(foot) < joint.upper
        outer = sympy.Max(*ends)
        inner = lengths[0] if crosses else sympy.Min(*ends)
    first = arm.joints[0]
    area = sympy.pi * (outer**2 - inner**2)
    words: tuple[str, ...] = ()
    if not first.circular:
        area = arm.stroke(0) / 2 * (outer**2 - inner**2)
        if crosses:
            more, words = _reached_from_one_side(arm, lengths, ends)
            area = None if more is None else area + more
    return ClosedForm(inner, outer, area, tuple(lengths), words)


def _reached_from_one_side(arm: PlaneFormulas, lengths: list[Any], ends: list[Any]) -> tuple[Any, tuple[str, ...]]:
    """Return the area beside the range of the first joint that joint 2 adds with its two signs, and when it holds.

    At a distance r the tip is at q1 ± α(r), so that the angles reach over α beyond both ends: 2 ∫ α r dr, from the
    distance at which only one sign is left. Of two links this is the circle's sector and the triangle of the links,
    without the sector of the smaller distance.
    """
    if arm.joints[1].revolute:
        if not -pi < arm.joints[1].lower < 0 < arm.joints[1].upper < pi:
            return None, ()
        l1, l2 = lengths
        S = sympy.Min(-arm.end(1, "min"), arm.end(1, "max"))
        angle = sympy.atan2(l2 * sympy.sin(S), l1 + l2 * sympy.cos(S))
        square = l1**2 + l2**2 + 2 * l1 * l2 * sympy.cos(S)
        more = l2**2 * S + l1 * l2 * sympy.sin(S) - square * angle
        widest = angle
        if arm.number(l2) < arm.number(l1) and arm.number(sympy.cos(S) + l2 / l1) < 0:
            widest = sympy.asin(l2 / l1)
    else:
        nearest = sympy.Min(*ends)
        widest = sympy.acos(lengths[0] / nearest)
        more = nearest**2 * widest - lengths[0] * sympy.sqrt(nearest**2 - lengths[0] ** 2)
    turn = arm.stroke(0)
    if not 2 * arm.number(widest) <= arm.number(turn) <= 2 * (pi - arm.number(widest)):
        return None, ()
    return more, (f"The area holds if {turn} is between 2*alpha and 2*pi - 2*alpha, with alpha = {widest}.",)


def _inside(joint: PlanarJoint, angle: float) -> bool:
    """Return whether an angle, but for whole turns, is strictly inside a joint's range, or the joint turns fully."""
    beyond = (angle - joint.lower) % tau
    return joint.circular or 1e-12 < beyond < joint.upper - joint.lower - 1e-12


def _slide_between_turns(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the annulus of a circle of full turns whose centre is at distances c(q2) from the first joint."""
    return _annulus_of_two(arm, 1, arm.square_between(0, 2), root_of(arm.square_between(2, 3)))


def _slide_after_turns(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the annulus of a link that turns fully, and a tip at distances t(q3) from its end."""
    return _annulus_of_two(arm, 2, arm.square_between(1, 3), root_of(arm.square_between(0, 1)))


def _annulus_of_two(arm: PlaneFormulas, slide: int, square: Any, link: Any) -> ClosedForm | None:
    """Return the annulus of a link and a length between two ends, whose square is known, that both turn fully."""
    joint = arm.joints[slide]
    q = arm.q[joint.number]
    foot = sympy.solve(sympy.diff(square, q), q)[0]
    if not all(j.circular for j in arm.joints if j.revolute):
        return None
    ends = [root_of(sympy.simplify(square.subs(q, arm.end(slide, name)))) for name in ("min", "max")]
    crosses = joint.lower < arm.number(foot) < joint.upper
    least = root_of(sympy.simplify(square.subs(q, foot))) if crosses else sympy.Min(*ends)
    most = sympy.Max(*ends)
    inner, outer = sympy.Max(0, least - link, link - most), link + most
    return ClosedForm(inner, outer, sympy.pi * (outer**2 - inner**2), (link,))


def _parallelogram(arm: PlaneFormulas) -> ClosedForm:
    columns = [arm.value.diff(arm.q[joint.number]) for joint in arm.joints]
    sine = sympy.Abs(sympy.simplify(sympy.Matrix.hstack(*columns).det()))
    return ClosedForm(None, None, sine * arm.stroke(0) * arm.stroke(1), ())


def _swept_circle(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the area of a circle or annulus of full turns along a stroke s: 2Rs + πR² − lens(r)."""
    if not all(joint.circular for joint in arm.joints[1:]):
        return None
    lengths, s = arm.lengths(), arm.stroke(0)
    outer = sum(lengths)
    inner = outer if len(lengths) == 1 else sympy.Abs(lengths[0] - lengths[1])
    lens = 2 * inner**2 * sympy.acos(s / (2 * inner)) - s / 2 * sympy.sqrt(4 * inner**2 - s**2)
    hole = sympy.Piecewise((lens, s < 2 * inner), (0, True))
    words = (f"There is no void if the stroke {s} is at least {2 * inner}.",)
    return ClosedForm(None, None, 2 * outer * s + sympy.pi * outer**2 - hole, tuple(lengths), words)


def _swept_along_two(arm: PlaneFormulas) -> ClosedForm | None:
    """Return the area of a full circle along two strokes s, t: s t |sin| + 2R(s + t) + πR², if it leaves no void."""
    if not arm.joints[2].circular:
        return None
    plane = _parallelogram(replace(arm, joints=arm.joints[:2]))
    a, b = (arm.value.diff(arm.q[joint.number]) for joint in arm.joints[:2])
    s, t, radius = arm.stroke(0), arm.stroke(1), arm.lengths()[0]
    diagonal = sympy.sqrt(s**2 + t**2 + 2 * s * t * sympy.Abs(sympy.simplify((a.T * b)[0])))
    if 2 * arm.number(radius) > arm.number(diagonal):
        return None
    words = (f"It holds if there is no void: 2*{radius} is at most {diagonal}.",)
    return ClosedForm(None, None, plane.area + 2 * radius * (s + t) + sympy.pi * radius**2, (radius,), words)
