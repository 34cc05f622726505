"""A robot without shapes, drawn as a skeleton: drums on revolute axes, rails on prismatic ones, rods between.

The looks are those of a robot that is made from a DH table.
"""

import numpy as np
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.robot.building import joints_of
from robotics1.robot.model import Robot
from robotics1.robot.visuals import Box, Color, Cylinder, Sphere, Visual

THICK = 0.03  # radius of a drum, of the size of the arm
BASE, DRUM, ROD, RAIL, TIP = (  # colours
    (0.55, 0.58, 0.62, 1.0),
    (0.18, 0.20, 0.24, 1.0),
    (0.13, 0.42, 0.71, 1.0),
    (0.93, 0.55, 0.14, 1.0),
    (0.80, 0.15, 0.15, 1.0),
)
Z = np.array([0.0, 0.0, 1.0])


def skeleton(robot: Robot) -> list[Visual]:
    """Return the shapes of the skeleton."""
    w = THICK * (robot.fixed_length if robot.fixed_length > 1e-6 else robot.reach)
    shapes = [_rod(0, -w * Z, 0 * Z, 1.5 * w, BASE, "base")]
    joints = joints_of(robot.own_model, robot.joints)
    for i, joint in enumerate(joints, 1):
        if joint in joints[i:]:  # a coordinate that carries nothing
            continue
        axis = np.array(joint.axis)
        place = robot.own_model.jointPlacements[i]
        above = robot.own_model.parents[i]
        shapes += _rods(above, 0 * Z, place.translation, w / 2, ROD, joint.parent)
        if joint.kind == "prismatic":
            travel = [value if np.isfinite(value) else 0.0 for value in (joint.lower, joint.upper)]
            back = max(travel[1], 0.0) + 2 * w
            shapes += _rods(above, place.translation, place.act(axis * back), w / 3, RAIL, joint.parent)
            shapes.append(_cube(i, 1.7 * w, axis, DRUM, joint.child))
        elif joint.kind == "revolute":
            shapes.append(_rod(i, -1.3 * w * axis, 1.3 * w * axis, w, DRUM, joint.child))
        else:
            shapes.append(_cube(i, 1.5 * w, Z, DRUM, joint.child))
    if robot.tool is not None:
        frame = robot.own_model.frames[robot.frame_id(robot.tool)]
        number, end = frame.parentJoint, frame.placement.translation
        shapes += _rods(number, 0 * Z, end, w / 2, ROD, robot.tool)
        shapes.append(Visual(robot.tool, number, pin.SE3(np.eye(3), end), Sphere(0.8 * w), TIP))
    return shapes


def _rods(joint: int, start: Array, end: Array, radius: float, color: Color, link: str) -> list[Visual]:
    return [_rod(joint, start, end, radius, color, link)] if np.linalg.norm(end - start) > 1e-9 else []


def _rod(joint: int, start: Array, end: Array, radius: float, color: Color, link: str) -> Visual:
    """Return a cylinder between two points."""
    length = float(np.linalg.norm(end - start))
    T = _turned((end - start) / length, (start + end) / 2)
    return Visual(link, joint, T, Cylinder(radius, length), color)


def _cube(joint: int, side: float, axis: Array, color: Color, link: str) -> Visual:
    return Visual(link, joint, _turned(axis, 0 * Z), Box((side, side, side)), color)


def _turned(axis: Array, centre: Array) -> pin.SE3:
    """Return the placement whose z is the axis."""
    return pin.SE3(pin.Quaternion.FromTwoVectors(Z, axis).toRotationMatrix(), centre)
