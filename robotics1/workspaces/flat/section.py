"""The workspace of a planar chain, from its last joint to its first, and the solutions of a point.

p = g₁(q₁)(w) ⇔ w = g₁(q₁)⁻¹(p). As q₁ goes through its range, w draws an arc or a segment. With one joint after it,
each crossing of this curve with that joint's own curve is a solution. With more, p is reached if the curve meets their
workspace: if it begins inside, or crosses the boundary.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from robotics1.workspaces.flat.arrangement import Divider, dividers
from robotics1.workspaces.flat.critical_curves import TOLERANCE, CriticalCurve, drawn_by, swept
from robotics1.workspaces.flat.pieces import cut, meeting_points
from robotics1.workspaces.flat.planar_joints import PlanarJoint

Curves = Sequence[CriticalCurve]


@dataclass(frozen=True)
class Section:
    """The workspace of a planar chain: what divides it, and how to count solutions at a point.

    Attributes:
        joints: the joints, the first nearest to the base.
        divided: the pieces of critical curves on whose sides the number of solutions differs.
        boundaries: of the joints after the first, see `solution_count`.
    """

    joints: tuple[PlanarJoint, ...]
    divided: tuple[Divider, ...]
    boundaries: tuple[tuple[CriticalCurve, ...], ...]

    @property
    def whole(self) -> "Section":
        """The section itself, as a half plane has that of its whole plane."""
        return self

    def count(self, z: complex) -> int:
        """Return the number of solutions at a point; of more than two joints, whether there is one."""
        return solution_count(self.joints, self.boundaries, z)

    def configurations(self, z: complex) -> list[tuple[float, ...]]:
        """Return the solutions at a point; some, if there are infinitely many."""
        return list(configurations_at(self.joints, self.boundaries, z))


def section_of(joints: Sequence[PlanarJoint], tip: complex, neutral: tuple[float, ...]) -> Section:
    """Return the workspace of two or more joints that move a point at `tip`.

    Args:
        joints: the joints, the first nearest to the base.
        tip: where the point is at q = 0.
        neutral: (nq,) values of q where these joints stand at 0.
    """
    by_number = {joint.number: joint for joint in joints}
    last = drawn_by(joints[-1], tip, neutral)
    curves = [] if last is None else [last]
    boundaries: list[tuple[CriticalCurve, ...]] = [tuple(curves)]
    divided: list[Divider] = []
    for k in range(len(joints) - 2, -1, -1):
        moving = joints[k:]
        pieces = cut(swept(joints[k], curves, by_number))
        divided = dividers(pieces, lambda z, moving=moving, inner=tuple(boundaries): solution_count(moving, inner, z))  # type: ignore[misc]
        curves = [d.piece.curve for d in divided if 0 in (d.left, d.right)]
        boundaries.insert(0, tuple(curves))
    return Section(tuple(joints), tuple(divided), tuple(boundaries[1:]))


def solution_count(joints: Sequence[PlanarJoint], boundaries: Sequence[Curves], z: complex) -> int:
    """Return the number of solutions of two joints; of more joints, 1 if the point is reached and else 0.

    Args:
        joints: the joints, the first nearest to the base.
        boundaries: for each joint but the first, the boundary of the workspace of the joints from it on; of the last
            joint, the curve that it draws.
        z: the point.
    """
    found = configurations_at(joints, boundaries, z)
    return sum(1 for _ in found) if len(joints) == 2 else int(next(found, None) is not None)


def configurations_at(
    joints: Sequence[PlanarJoint], boundaries: Sequence[Curves], z: complex
) -> Iterator[tuple[float, ...]]:
    """Yield the solutions of two joints; of more joints, those of infinitely many in which the others are critical."""
    first, rest = joints[0], boundaries[0]
    back = drawn_by(first, z, rest[0].q, back=True) if rest else None
    met: list[complex] = []
    for curve in rest:
        for w in [z] if back is None else meeting_points(back, curve):
            t = curve.position(w)
            if t is None or abs(curve.point(t) - w) > TOLERANCE or any(abs(w - other) < TOLERANCE for other in met):
                continue
            met.append(w)
            yield _with(first, _value(first, back, w), curve.configuration(t))
    if len(joints) > 2 and not met:
        inside = z if back is None else back.start
        for q in configurations_at(joints[1:], boundaries[1:], inside):
            yield _with(first, _value(first, back, inside), q)


def _value(joint: PlanarJoint, back: CriticalCurve | None, w: complex) -> float:
    """Return the value of a joint at a point of the curve that it draws backwards; any, if that is a point."""
    t = None if back is None else back.position(w)
    return joint.lower if back is None or t is None else back.configuration(t)[joint.number]


def _with(joint: PlanarJoint, value: float, q: tuple[float, ...]) -> tuple[float, ...]:
    """Return q with the value of one joint."""
    return (*q[: joint.number], value, *q[joint.number + 1 :])
