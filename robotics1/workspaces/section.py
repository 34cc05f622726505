"""The workspace of a planar chain, from its last joint to its first."""

from collections.abc import Sequence
from dataclasses import dataclass

from robotics1.workspaces.arrangement import Divider, dividers
from robotics1.workspaces.counting import configurations_at, solution_count
from robotics1.workspaces.critical_curves import CriticalCurve, drawn_by, swept
from robotics1.workspaces.pieces import cut
from robotics1.workspaces.planar_joints import PlanarJoint


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
