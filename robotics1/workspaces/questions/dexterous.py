"""The dexterous workspace: the points that an arm reaches with every orientation."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.axes import STRAIGHT, Axis, axes_to, require_moving, without_joints_at
from robotics1.workspaces.find import workspace_of
from robotics1.workspaces.flat.arrangement import dividers, regions
from robotics1.workspaces.flat.critical_curves import TOLERANCE, CriticalCurve
from robotics1.workspaces.flat.flat_arm import PlanarArm, planar_arm
from robotics1.workspaces.flat.flat_workspace import region_of
from robotics1.workspaces.flat.pieces import cut, meeting_points
from robotics1.workspaces.flat.section import Section, section_of
from robotics1.workspaces.moving_point import point_moved_by, position_rows
from robotics1.workspaces.questions.wrist_dexterity import WristDexterity, wrist_of
from robotics1.workspaces.result import WorkspaceRegion

SAME_RADIUS = 1e-9


@dataclass(frozen=True, eq=False)
class _Disc:
    """The points z for which the circle of radius r about z is in the workspace of the joints before the last one."""

    inner: Section
    edges: tuple[CriticalCurve, ...]
    r: float

    def count(self, z: complex) -> int:
        """Return 1 if the whole circle is reached, else 0."""
        if self.r < TOLERANCE:
            return int(self.inner.count(z) > 0)
        circle = _circle(z, self.r)
        places = [w for edge in self.edges for w in meeting_points(circle, edge)]
        met = sorted({t for t in map(circle.position, places) if t is not None})
        ends = [*met, met[0] + circle.length] if met else [0.0, circle.length]
        for a, b in itertools.pairwise(ends):
            w = circle.point((a + b) / 2)
            if not self.inner.count(w) and min(edge.distance(w) for edge in self.edges) > TOLERANCE:
                return 0
        return 1


@dataclass(frozen=True, eq=False)
class DexterousWorkspace(Frozen):
    """The points of a plane that an arm reaches with every orientation of its last link.

    Attributes:
        robot_name: the robot's name.
        area: [m²]; 0 if there are none.
        radii: (k, 2) if the first joint turns fully: from which to which distance from its axis the points are [m];
            else (0, 2).
        regions: the connected regions; `solutions` is 1 and stands for infinitely many.
        last_link: the distance from the last joint to the point [m].
        coordinates: the names of the plane's two coordinates.
    """

    robot_name: str
    area: float
    radii: Array
    regions: tuple[WorkspaceRegion, ...]
    last_link: float
    coordinates: tuple[str, str]
    arm: PlanarArm = field(repr=False)
    disc: _Disc = field(repr=False)

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point (2,) [m] is reached with every orientation.

        Raises:
            InputError: p has another shape or is not finite.
        """
        u, v, _ = self.arm.place.local(p) / self.arm.size
        return bool(self.disc.count(complex(u, v)))

    def explain(self) -> str:
        """Return area and radii in sentences."""
        if not self.area:
            return f"{self.robot_name} reaches no point with every orientation."
        lines = [f"The dexterous workspace of {self.robot_name} has the area {self.area:.9g} m²."]
        lines += [f"It reaches every orientation at distances from {a:.9g} m to {b:.9g} m." for a, b in self.radii]
        return "\n".join(lines)


def dexterous_workspace(
    robot: RobotLike, task: TaskLike, *, box: Mapping[str, tuple[float, float]] | None = None
) -> DexterousWorkspace | WristDexterity:
    """Return the points that an arm reaches with every orientation of its last link.

    Of an arm in a plane: with a last joint that turns fully, p is such a point if the circle about p with the last
    link's length as radius is in the workspace of the joints before. Its boundary is among the parallels of their
    boundary at this distance, and the circles about its corners. Of an arm with a spherical wrist: p is such a point if
    the sphere about p through the centre of the wrist is in the workspace of this centre.

    Args:
        robot: an arm that moves in the plane of the task, with three joints or more; or one with a spherical wrist.
        task: two coordinates of a point, as `PositionTask("xy")`; of an arm with a wrist all three.
        box: joint name → (lower, upper) [rad or m], inside the limits.

    Raises:
        TaskError: the arm is of another kind, or its last joint, or its wrist, cannot turn the tool anyhow.
        InputError: a prismatic joint has no limits.

    Source: Kumar, Waldron, The workspaces of a mechanical manipulator, 1981 (the dexterous workspace).
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    robot.require_single_coordinates("have a workspace")
    rows, frame = position_rows(task)
    tip = np.array(forward_kinematics(robot, np.zeros(robot.nq), frame=frame).translation)
    axes = axes_to(robot, frame, box)
    require_moving(axes, robot)
    if len(rows) == 3:
        return _of_a_wrist(robot, axes, tip, rows)
    axes = without_joints_at(tip, axes, STRAIGHT * robot.reach)
    arm = planar_arm(robot, point_moved_by(robot, axes, tip, rows)) if axes else None
    if arm is None or len(arm.joints) < 3:
        raise TaskError(
            f"robot {robot.name!r} is no planar arm of three joints or more for this task: with fewer joints a point "
            "has finitely many orientations; use PositionTask('xy') of a planar arm"
        )
    return _of_a_plane(robot, arm)


def _of_a_plane(robot: Robot, arm: PlanarArm) -> DexterousWorkspace:
    last = arm.joints[-1]
    if not (last.revolute and last.circular):
        raise TaskError(
            f"joint {last.name!r} cannot make a full turn; every orientation is known only of a last joint that can"
        )
    inner = section_of(arm.joints[:-1], last.place, tuple(arm.place.neutral))
    edges = tuple(d.piece.curve for d in inner.divided if 0 in (d.left, d.right))
    disc = _Disc(inner, edges, abs(arm.tip - last.place))
    divided = dividers(cut(_parallels(edges, disc.r)), disc.count)
    found = tuple(region_of(arm, *loops, divided) for loops in regions(divided) if loops[0][0].count)
    return DexterousWorkspace(
        robot_name=robot.name,
        area=float(sum(region.area for region in found)),
        radii=_radii(arm, disc) * arm.size,
        regions=found,
        last_link=disc.r * arm.size,
        coordinates=arm.place.names,
        arm=arm,
        disc=disc,
    )


def _of_a_wrist(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> WristDexterity:
    centre, offset = wrist_of(axes, tip, robot)
    before = axes[:-3]
    base = before[0]
    if not (base.revolute and base.circular):
        raise TaskError(
            f"every orientation in space is known of an arm whose first joint turns fully; {base.name!r} does not"
        )
    ws = workspace_of(robot, point_moved_by(robot, before, centre, rows))
    if ws.resolution:
        raise TaskError(
            f"the workspace of the wrist of robot {robot.name!r} is known by samples only: the arm is redundant"
        )
    across = base.point - (base.point @ base.direction) * base.direction
    return WristDexterity(robot.name, offset, ws, np.array([across, base.direction]))


def _circle(z: complex, r: float) -> CriticalCurve:
    return CriticalCurve(z, z + r, 1 + 0j, 2 * np.pi, (0.0,), 0, 1)


def _parallels(edges: Sequence[CriticalCurve], r: float) -> list[CriticalCurve]:
    """Return the curves at a distance on both sides of arcs and segments, and the circles about their ends."""
    found: list[CriticalCurve] = []
    for edge in edges:
        for side in (1, -1) if r > TOLERANCE else (1,):
            found += _parallel(edge, side * r)
        if not edge.closed and r > TOLERANCE:
            found += [_circle(edge.point(t), r) for t in (0.0, edge.length)]
    return found


def _parallel(edge: CriticalCurve, away: float) -> list[CriticalCurve]:
    if edge.centre is None:
        start = edge.start + away * 1j * edge.direction
        return [CriticalCurve(None, start, edge.direction, edge.length, edge.q, edge.joint, edge.rate)]
    scale = 1 + away / edge.radius
    if abs(scale) * edge.radius < TOLERANCE:
        return []
    start = edge.centre + scale * (edge.start - edge.centre)
    return [CriticalCurve(edge.centre, start, 1 + 0j, edge.length, edge.q, edge.joint, edge.rate)]


def _radii(arm: PlanarArm, disc: _Disc) -> Array:
    """Return the distances from the first joint's axis between which all points count, of a first joint that turns."""
    first = arm.joints[0]
    if not (first.revolute and first.circular):
        return np.zeros((0, 2))
    circles = [edge.radius for edge in disc.edges if edge.centre is not None]
    steps = sorted({0.0, *(abs(radius + side * disc.r) for radius in circles for side in (1, -1))})
    kept: list[list[float]] = []
    for a, b in itertools.pairwise(steps):
        if b - a < SAME_RADIUS or not disc.count(first.place + (a + b) / 2):
            continue
        if kept and a - kept[-1][1] < 2 * SAME_RADIUS:
            kept[-1][1] = b
        else:
            kept.append([a, b])
    return np.array(kept).reshape(-1, 2)
