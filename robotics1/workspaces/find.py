"""The workspace of an arm: in a plane exactly, by arcs and segments; of other arms as their kind allows."""

from __future__ import annotations

from collections.abc import Mapping

from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.axes import refuse_open_slides
from robotics1.workspaces.curved.curved_workspace import curved_workspace
from robotics1.workspaces.flat.flat_arm import planar_arm
from robotics1.workspaces.flat.flat_workspace import flat_workspace
from robotics1.workspaces.moving_point import MovingPoint, moving_point
from robotics1.workspaces.result import Workspace
from robotics1.workspaces.sampled.sampled_workspace import sampled_workspace


def workspace(robot: RobotLike, task: TaskLike, *, box: Mapping[str, tuple[float, float]] | None = None) -> Workspace:
    """Return the points r = f(q) with q inside the joint limits: boundary, regions and sizes.

    At a point of the boundary the joints that are not at a limit are singular together. Of an arm in a plane such
    points lie on arcs and segments, each drawn by one joint while the others stand still. These curves cut the plane
    into regions; the number of solutions is the same everywhere in a region, and is counted at both sides of each
    curve. The area is ½ ∮ (x dy − y dx) along the arcs and segments themselves, and the volume of what turns about an
    axis is its angle times ∫ ρ dA (Pappus). So too of such an arm with a slide across its plane (SCARA, cylindrical,
    gantry), or whose plane contains the axis about which its first joint turns it (anthropomorphic, polar).

    Of any other three joints that move a point in space, the first turns or slides a section, and the critical curves
    of the section are the images of D(q2, q3) = 0 and of the limits of q2 and q3, traced. The number of solutions in a
    region is the degree of the map over it. The same holds of two joints that move two coordinates. Joints that do not
    move the point, as those of a spherical wrist about it, do not count.

    Of all other arms the section is sampled by cells: `resolution` is their side, and nothing is proven outside.

    Args:
        robot: the arm.
        task: two or three coordinates of a point, as `PositionTask("xy")`, in world axes.
        box: joint name → (lower, upper) [rad or m], inside the limits; needed for prismatic joints without limits.

    Raises:
        InputError: a prismatic joint has neither limits nor a box, or the box is wrong.
        UnknownNameError: the box names no joint.
        TaskError: the task is no position, or the point moves along a surface or a curve only.

    Source: Kumar, Waldron, The workspaces of a mechanical manipulator, 1981 (boundaries are singular); Wenger, Cuspidal
    and noncuspidal robot manipulators, Robotica, 2007 (regions and cusps of the section).
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    return workspace_of(robot, moving_point(robot, task, box))


def workspace_of(robot: Robot, point: MovingPoint) -> Workspace:
    """Return the workspace of a point: exact if it can be, else sampled."""
    arm = planar_arm(robot, point)
    if arm is not None:
        return flat_workspace(robot, arm)
    refuse_open_slides(point.axes)
    few = len(point.axes) <= len(point.rows)
    return curved_workspace(robot, point) if few else sampled_workspace(robot, point)
