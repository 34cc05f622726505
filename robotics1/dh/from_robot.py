"""From a robot to a DH table, by the common normals of its joint axes at q = 0.

The walk goes from the world's z axis along the joint axes to the tool's z axis. A table of either convention is its
steps S_0 S_1 ⋯ S_n, S_i = Z_i X_i, with the brackets put in another place:

    standard:  T_base = S_0,      A_i = Z_i X_i
    modified:  T_base = Z_0,      A_i = X_{i−1} Z_i
"""

from __future__ import annotations

from math import log10

import numpy as np
import pinocchio as pin

from robotics1.dh.common_normals import FAR, Axis, Step, clean_placement, first_step, in_metres, last_step, step_to
from robotics1.dh.own_frames import own_steps
from robotics1.dh.table import CONVENTIONS, Convention, DHRow, DHTable
from robotics1.errors import InputError, Robotics1Error
from robotics1.inputs import one_of, real_number
from robotics1.robot.findings import random_within
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot

PARALLEL = 1e-8  # sine of an angle; nearer to parallel, the common normal is so far away that rounding loses more
COINCIDENT = 1e-12  # sizes of the arm
SAMPLES = 8  # configurations at which the table is held against the robot


def urdf_to_dh(
    robot: RobotLike, *, tool: str | None = None, convention: Convention = "standard", tolerance: float | None = None
) -> DHTable:
    """Return a DH table of the chain from the world to the tool, in the robot's own joint values.

    T_world_tool(q) = T_base A_1(q_1) ⋯ A_n(q_n) T_tool, as in `DHTable`; `robot_from_dh(table.rows,
    **table.options)` has the robot's forward kinematics. Where the robot's frames are those of a table already, as
    in a robot of `robot_from_dh`, it is that table. Else, of the choices that a table leaves, it takes
    |θ_i| ≤ π/2, so that a_i may be negative; d_i = 0 between parallel axes, and x_i = x_{i−1} between coincident
    ones; a prismatic joint's axis through that joint's origin; and the last row as near the tool as a row comes,
    with |θ_n| > π/2 where that reaches the tool itself.

    Args:
        robot: any robot; joints that do not move the tool are left out.
        tool: the frame at the end of the chain; by default the robot's tool.
        convention: "standard" or "modified".
        tolerance: axes whose angle has a sine below it are parallel, and parallel axes nearer than it, in the size of
            the arm, are one. In files that write 1.5708 for π/2, 1e-5 finds what was meant, and `table.residual` says
            what that costs. By default 1e-8 and 1e-12; axes are parallel too if their common normal is 1000 times
            farther away than the arm is long.

    Raises:
        InputError: a joint on the way has not one coordinate of its own, or no joint moves the tool.
        UnknownNameError: there is no such frame.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; Craig, Introduction to Robotics,
    2005, sections 3.4 and 3.6.
    """
    robot = robot_from(robot)
    one_of("convention", convention, CONVENTIONS)
    if tolerance is not None:
        tolerance = real_number("tolerance", tolerance, non_negative=True)
    frame = robot.frame_id(tool)
    joints = _joints_to(robot, frame)
    data, unit = _in_own_size(robot)
    kind_of = {joint.name: joint.kind for joint in robot.moving_joints}
    found = own_steps(robot, data, joints, frame, convention) or _walk(robot.own_model, data, joints, frame, tolerance)
    base, steps = in_metres(found[0], unit), [step.in_metres(unit) for step in found[1]]
    kinds = ["R" if kind_of[robot.own_model.names[joint]] == "revolute" else "P" for joint in joints]
    if convention == "standard":
        base = base * steps[0].placement
        rows = [DHRow(kind, s.a, s.alpha, s.d, s.theta) for kind, s in zip(kinds, steps[1:], strict=True)]
    else:
        base = base * steps[0].along_z
        pairs = zip(kinds, steps[:-1], steps[1:], strict=True)
        rows = [DHRow(kind, before.a, before.alpha, s.d, s.theta) for kind, before, s in pairs]
    return _closed(robot, joints, frame, rows, convention, clean_placement(base, unit), unit)


def _joints_to(robot: Robot, frame: int) -> list[int]:
    """Return the numbers of the joints from the world to a frame."""
    model = robot.own_model
    joints = [*model.supports[model.frames[frame].parentJoint]][1:]  # the first is the world
    for joint in joints:
        if model.nqs[joint] != 1 or model.nvs[joint] != 1:
            raise InputError(
                f"joint {model.names[joint]!r} ({_kind(robot, joint)}) has no row in a DH table: each joint must be "
                f"revolute or prismatic, with a coordinate of its own"
            )
    if not joints:
        raise InputError(f"no joint moves {model.frames[frame].name!r}, so there is no row to write")
    return joints


def _kind(robot: Robot, number: int) -> str:
    """Return what a joint is that has no row."""
    joint = next((joint for joint in robot.joints if joint.name == robot.own_model.names[number]), None)
    if joint is None:
        return "it leads a joint that comes before it"
    return f"it mimics {joint.leader!r}" if joint.follows else joint.kind


def _in_own_size(robot: Robot) -> tuple[pin.Data, float]:
    """Return the placements at q = 0 with lengths in the size of the arm, and this unit, a power of ten [m].

    So what is near, and what is rounding, does not depend on the unit of length.
    """
    data = pin.Data(robot.own_model)
    pin.framesForwardKinematics(robot.own_model, data, pin.neutral(robot.own_model))
    placements = [*data.oMi, *data.oMf]
    size = max(float(np.abs(T.translation).max()) for T in placements)
    unit = 10.0 ** round(log10(size)) if size > 0 else 1.0
    for T in placements:
        T.translation = T.translation / unit
    return data, unit


def _walk(
    model: pin.Model, data: pin.Data, joints: list[int], frame: int, tolerance: float | None
) -> tuple[pin.SE3, list[Step]]:
    """Return the base and the steps S_0 ... S_n.

    Each step starts from where the rounded ones before it lead, so that roundings do not add up.
    """
    T_world_tool = pin.SE3(data.oMf[frame])
    first, *others = [_axis(model, data, joint) for joint in joints]
    base, step = first_step(first)
    steps, T = [step], base * step.placement
    near = (PARALLEL, COINCIDENT, FAR) if tolerance is None else (tolerance, tolerance)
    for axis in others:
        steps.append(step_to(axis.seen_from(T), *near))
        T = T * steps[-1].placement
    return base, [*steps, last_step(T.actInv(T_world_tool))]


def _axis(model: pin.Model, data: pin.Data, joint: int) -> Axis:
    """Return the axis of a joint in the world, at the configuration of the data."""
    motion = model.joints[joint].createData()
    model.joints[joint].calc(motion, np.zeros(1))
    v, omega = motion.S.ravel()[:3], motion.S.ravel()[3:]
    T = data.oMi[joint]
    return Axis(np.array(T.translation), T.rotation @ (omega if omega.any() else v))


def _closed(
    robot: Robot, joints: list[int], frame: int, rows: list[DHRow], convention: str, base: pin.SE3, unit: float
) -> DHTable:
    """Return the table whose tool placement makes up the rest at q = 0, with its residual."""
    model, data = robot.own_model, robot.data
    index = [int(model.idx_qs[joint]) for joint in joints]
    lower, upper = robot.lower[index], robot.upper[index]
    names = tuple(model.names[joint] for joint in joints)

    def table(tool: pin.SE3, residual: float = 0.0) -> DHTable:
        return DHTable(tuple(rows), convention, base, tool, lower, upper, {}, names, residual)

    def pose(q: np.ndarray) -> pin.SE3:
        whole = pin.neutral(model)
        whole[index] = q
        pin.forwardKinematics(model, data, whole)
        return pin.SE3(pin.updateFramePlacement(model, data, frame))

    zero = np.zeros(len(rows))
    found = table(clean_placement(table(pin.SE3.Identity()).pose(zero).actInv(pose(zero)), unit))
    drawn = random_within(lower, upper, SAMPLES, np.random.default_rng(0))
    gaps = [np.abs(found.pose(q).homogeneous - pose(q).homogeneous).max() for q in drawn]
    return table(found.tool_placement, float(max(gaps)))


def folded_tables(robot: Robot) -> str:
    """Return the standard and the modified DH table as HTML, folded; nothing of a robot that has none."""
    try:
        tables = [urdf_to_dh(robot), urdf_to_dh(robot, convention="modified")]
    except Robotics1Error:  # an open tool, or a joint on the way to it that no row describes
        return ""
    shown = "".join(table._repr_html_() for table in tables)
    return f"<details><summary>DH tables, standard and modified</summary>{shown}</details>"
