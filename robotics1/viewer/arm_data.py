"""An arm as the page computes with it: joints, coordinates, frames and task as plain numbers."""

from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.least_squares import numeric_rank
from robotics1.robot.box import joint_box
from robotics1.robot.building import joints_of
from robotics1.robot.joints import tips
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.planar_pose import PlanarPoseTask
from robotics1.tasks.pose import PoseTask
from robotics1.tasks.position import PositionTask
from robotics1.tasks.rows import constant_rows, unitless_jacobian, unitless_rows
from robotics1.tasks.task import Task

SAMPLES = 16  # random configurations, at which the usual σ₁ and the rank are measured
FLAT = 1e-9  # of a rate out of the plane z = 0 that is rounding


def stand_in(robot: Robot, task: Task) -> str:
    """Return the sentence for a page that shows another task in the place of `task`; "" where it shows this one."""
    if constant_rows(with_frame_at_point(robot, task)[1]) is not None:
        return ""
    shown = default_task(robot)
    instead = "nothing is shown of it"
    if shown is not None:
        instead = f"σ_min and the arrows are those of {type(shown).__name__} ({', '.join(shown.row_names)})"
    asked = f"{type(task).__name__} ({', '.join(task.row_names)})"
    return f"The page computes with tasks of one frame and constant rows; {asked} is none: {instead}."


def arm_data(robot: Robot, q: Array, task: Task | None) -> dict[str, Any]:
    """Return what the page needs to move an arm.

    Args:
        robot: the robot. One with a planar or floating joint stands still in the page, at q.
        q: (nq,) a configuration.
        task: the task whose Jacobian the page shows; by default that of `default_task`, also in the place of one
            without constant rows S in ṙ = S V.
    """
    if task is not None:
        robot, task = with_frame_at_point(robot, task)
    moves = robot.nq == robot.nv
    if task is None or constant_rows(task) is None:
        task = default_task(robot)
    return {
        "name": robot.name,
        "reach": robot.reach,
        "joints": _moving_joints(robot) if moves else _joints_at(robot, q),
        "coordinates": _coordinates(robot) if moves else [],
        "tool": {"name": shown_tool(robot), **_frame(robot, shown_tool(robot))},
        "task": None if task is None else _task(robot, task),
        "chain": _chain(robot, shown_tool(robot) if task is None else _frame_of(robot, task)),
    }


def default_task(robot: Robot) -> Task | None:
    """Return the task that a robot is made for: position or pose, in its plane if it has one; None if nothing moves."""
    frame = shown_tool(robot)
    moving = _moving(robot, frame)
    if robot.nq != robot.nv or moving == 0:
        return None
    if is_planar(robot):
        return PlanarPoseTask("xy", frame=frame) if moving >= 3 else PositionTask("xy", frame=frame)
    return PoseTask(frame=frame) if moving >= 6 else PositionTask("xyz", frame=frame)


def shown_tool(robot: Robot) -> str:
    """Return the tool. Of a robot with several tips it is the last link on the way to all of them, if that link moves;
    else the tip with the most moving joints on its way.
    """
    if robot.tool is not None:
        return robot.tool
    ends = tips(robot.frame_names, robot.joints)
    ways = [[joint.child for joint in robot.joints_to(end)] for end in ends]
    common = [link for link in ways[0] if all(link in way for way in ways)]
    if common and _moving(robot, common[-1]):
        return common[-1]
    return max(ends, key=lambda end: _moving(robot, end))


def _moving(robot: Robot, link: str) -> int:
    """Return how many coordinates move a link."""
    return len({joint.leader for joint in robot.joints_to(link) if joint.kind != "fixed"})


def is_planar(robot: Robot) -> bool:
    """Return whether every joint turns about z or slides along the plane z = 0."""
    if robot.nv == 0 or robot.nq != robot.nv:
        return False
    for q in _random_configurations(robot):
        J = pin.computeJointJacobians(robot.own_model, robot.data, q).reshape(6, -1)
        if np.abs(J[[2, 3, 4]]).max() > FLAT * max(1.0, robot.reach):
            return False
    return True


def placement(T: pin.SE3) -> list[float]:
    """Return the rows of (R | p), twelve numbers."""
    return [float(value) for value in T.homogeneous[:3].ravel()]


def _random_configurations(robot: Robot) -> Array:
    return joint_box(robot, unlimited=1.0).random(np.random.default_rng(0), SAMPLES)


def _moving_joints(robot: Robot) -> list[dict[str, Any]]:
    """Return the joints of the model, each with the coordinate that it follows."""
    coordinate = {name: i for i, name in enumerate(robot.joint_names)}
    joints = []
    for i, joint in enumerate(joints_of(robot.own_model, robot.joints), 1):
        joints.append(
            {
                "name": joint.name,
                "parent": robot.own_model.parents[i] - 1,
                "placement": placement(robot.own_model.jointPlacements[i]),
                "kind": joint.kind,
                "axis": list(joint.axis),
                "coordinate": coordinate[joint.leader],
                "multiplier": joint.multiplier,
                "offset": joint.offset,
            }
        )
    return joints


def _joints_at(robot: Robot, q: Array) -> list[dict[str, Any]]:
    """Return the joints as they stand at q."""
    pin.forwardKinematics(robot.own_model, robot.data, q)
    return [
        {
            "name": robot.own_model.names[i],
            "parent": robot.own_model.parents[i] - 1,
            "placement": placement(robot.data.liMi[i]),
            "kind": "fixed",
            "axis": [0.0, 0.0, 1.0],
            "coordinate": -1,
        }
        for i in range(1, robot.own_model.njoints)
    ]


def _coordinates(robot: Robot) -> list[dict[str, Any]]:
    limits = zip(robot.moving_joints, robot.lower, robot.upper, robot.max_velocity, strict=True)
    return [
        {
            "name": joint.name,
            "unit": "rad" if joint.kind == "revolute" else "m",
            "lower": _finite(lower),
            "upper": _finite(upper),
            "velocity": _finite(velocity),
        }
        for joint, lower, upper, velocity in limits
    ]


def _frame(robot: Robot, name: str | None) -> dict[str, Any]:
    frame = robot.own_model.frames[robot.frame_id(name)]
    return {"joint": frame.parentJoint - 1, "placement": placement(frame.placement)}


def _frame_of(robot: Robot, task: Task) -> str:
    """Return the name of the frame of a task."""
    form = task.frame_map()
    return shown_tool(robot) if form is None or form.frame is None else form.frame


def _chain(robot: Robot, name: str) -> dict[str, Any]:
    """Return where the first joint on the way to a frame is, and how far from there the frame can be at most [m]."""
    frame = robot.own_model.frames[robot.frame_id(name)]
    way = [*robot.own_model.supports[frame.parentJoint]][1:]  # without the world
    steps = [robot.own_model.jointPlacements[i].translation for i in way[1:]] + [frame.placement.translation]
    start = robot.own_model.jointPlacements[way[0]].translation if way else np.zeros(3)
    length = sum(float(np.linalg.norm(step)) for step in steps) + _travel(robot, name)
    return {"start": [float(value) for value in start], "length": _finite(length)}


def _travel(robot: Robot, name: str) -> float:
    """Return how far the prismatic joints on the way to a frame can slide together, ∞ where a limit is missing [m]."""
    if robot.nq != robot.nv:
        return float("inf")
    far = dict(zip(robot.joint_names, np.maximum(np.abs(robot.lower), np.abs(robot.upper)), strict=True))
    sliding = [joint for joint in robot.joints_to(name) if joint.kind == "prismatic"]
    return float(sum(abs(joint.multiplier) * far[joint.leader] + abs(joint.offset) for joint in sliding))


def _task(robot: Robot, task: Task) -> dict[str, Any]:
    """Return frame, axes, rows S, and how large and of what rank the Jacobian usually is."""
    task.check(robot)
    form, S = task.frame_map(), constant_rows(task)
    if form is None or S is None:
        raise TaskError("the page draws tasks of one frame, with constant rows")
    at = {"world": None, "tool": shown_tool(robot)}.get(form.reference, form.reference)
    sigmas = [np.linalg.svd(unitless_jacobian(robot, task, q), compute_uv=False) for q in _random_configurations(robot)]
    return {
        "name": type(task).__name__,
        "rows": list(task.row_names),
        "frame": _frame(robot, form.frame),
        "reference": None if at is None else _frame(robot, at),
        "S": S.tolist(),
        "scale": unitless_rows(robot, task).tolist(),
        "usual": max(float(sigma[0]) for sigma in sigmas),
        "generic": max(numeric_rank(sigma) for sigma in sigmas),
    }


def _finite(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None
