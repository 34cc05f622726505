"""A robot without shapes, drawn as a skeleton: drums on revolute axes, rails on prismatic ones, rods between.

The looks are those of a robot that is made from a DH table.
"""

from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.viewer.arm_data import placement

THICK = 0.03  # radius of a drum, of the size of the arm
BASE, DRUM, ROD, RAIL, TIP = (
    (0.55, 0.58, 0.62, 1.0),
    (0.18, 0.20, 0.24, 1.0),
    (0.13, 0.42, 0.71, 1.0),
    (0.93, 0.55, 0.14, 1.0),
    (0.80, 0.15, 0.15, 1.0),
)
Z = np.array([0.0, 0.0, 1.0])


def skeleton(robot: Robot) -> list[dict[str, Any]]:
    """Return the shapes of the skeleton, as the page draws them."""
    w = THICK * (robot.fixed_length if robot.fixed_length > 1e-6 else robot.reach)
    shapes = [_rod(-1, -w * Z, 0 * Z, 1.5 * w, BASE, "base")]
    named = {joint.name: joint for joint in robot.joints}
    for i in range(1, robot.own_model.njoints):
        joint, number = named[robot.own_model.names[i]], i - 1
        axis = np.array(joint.axis)
        place = robot.own_model.jointPlacements[i]
        above = robot.own_model.parents[i] - 1
        shapes += _rods(above, 0 * Z, place.translation, w / 2, ROD, joint.parent)
        if joint.kind == "prismatic":
            travel = [value if np.isfinite(value) else 0.0 for value in (joint.lower, joint.upper)]
            back = max(travel[1], 0.0) + 2 * w
            shapes += _rods(above, place.translation, place.act(axis * back), w / 3, RAIL, joint.parent)
            shapes.append(_cube(number, 1.7 * w, axis, DRUM, joint.child))
        elif joint.kind == "revolute":
            shapes.append(_rod(number, -1.3 * w * axis, 1.3 * w * axis, w, DRUM, joint.child))
        else:
            shapes.append(_cube(number, 1.5 * w, Z, DRUM, joint.child))
    if robot.tool is not None:
        frame = robot.own_model.frames[robot.frame_id(robot.tool)]
        number, end = frame.parentJoint - 1, frame.placement.translation
        shapes += _rods(number, 0 * Z, end, w / 2, ROD, robot.tool)
        shapes.append(_shape(number, "sphere", [0.8 * w], pin.SE3(np.eye(3), end), TIP, robot.tool))
    return shapes


def _shape(joint: int, kind: str, size: list[float], T: pin.SE3, color: tuple[float, ...], link: str) -> dict[str, Any]:
    return {"joint": joint, "kind": kind, "size": size, "placement": placement(T), "color": color, "link": link}


def _rods(joint: int, start: Array, end: Array, radius: float, color: tuple[float, ...], link: str) -> list[Any]:
    return [_rod(joint, start, end, radius, color, link)] if np.linalg.norm(end - start) > 1e-9 else []


def _rod(joint: int, start: Array, end: Array, radius: float, color: tuple[float, ...], link: str) -> dict[str, Any]:
    """Return a cylinder between two points."""
    length = float(np.linalg.norm(end - start))
    return _shape(joint, "cylinder", [radius, length], _turned((end - start) / length, (start + end) / 2), color, link)


def _cube(joint: int, side: float, axis: Array, color: tuple[float, ...], link: str) -> dict[str, Any]:
    return _shape(joint, "box", [side] * 3, _turned(axis, 0 * Z), color, link)


def _turned(axis: Array, centre: Array) -> pin.SE3:
    """Return the placement whose z is the axis."""
    return pin.SE3(pin.Quaternion.FromTwoVectors(Z, axis).toRotationMatrix(), centre)
