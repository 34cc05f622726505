"""Joints that are held: each becomes a fixed one, at its value."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import real_array, real_number
from robotics1.robot.findings import LARGEST
from robotics1.robot.normalize import factor, leader, numbers, placement, remove, set_placement, tidy
from robotics1.robot.placements import homogeneous


def lock(root: ET.Element, locked: Mapping[str, Any]) -> None:
    """Turn joints into fixed ones at the given values: rad or m, of a planar or floating joint as at `load_robot`.

    Raises:
        UnknownNameError: there is no such joint.
        InputError: a value is not finite or has another form, or the joint has no coordinate of its own.
    """
    if locked:
        tidy(root)
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    moving = [name for name, joint in joints.items() if joint.get("type") != "fixed" and leader(joint) is None]
    for name, value in locked.items():
        if name not in joints:
            raise UnknownNameError("joint named", name, moving)
        if name not in moving:
            raise InputError(f"joint {name!r} cannot be locked: it has no coordinate of its own")
        joint, what = joints[name], f"the value of locked joint {name!r}"
        if joint.get("type") == "planar":
            _fix(joint, _planar(what, value))
        elif joint.get("type") == "floating":
            _fix(joint, _floating(what, value))
        else:
            q = _bounded(what, real_number(what, value))
            _fix(joint, _along_axis(joint, q))
            for follower in joints.values():
                if leader(follower) == name:
                    mimic = follower.find("mimic")
                    q_follower = factor(mimic, "multiplier", 1.0) * q + factor(mimic, "offset", 0.0)
                    _fix(
                        follower,
                        _along_axis(
                            follower, _bounded(f"{what}, by which {follower.get('name')!r} follows", q_follower)
                        ),
                    )


def _along_axis(joint: ET.Element, q: float) -> pin.SE3:
    """Return the motion of a joint about or along its axis."""
    axis = np.array(numbers(joint.find("axis"), "xyz", "1 0 0"))
    if joint.get("type") == "prismatic":
        return pin.SE3(np.eye(3), q * axis)
    return pin.SE3(pin.AngleAxis(q, axis).toRotationMatrix(), np.zeros(3))


def _planar(what: str, value: Any) -> pin.SE3:
    """Return the motion by [x, y, θ] in the plane."""
    if _is_zero(value):
        return pin.SE3.Identity()
    x, y, theta = _bounded(what, real_array(what, value, (3,), "[x, y, theta] of a planar joint, or 0"))
    return pin.SE3(pin.AngleAxis(theta, np.array([0.0, 0.0, 1.0])).toRotationMatrix(), np.array([x, y, 0.0]))


def _floating(what: str, value: Any) -> pin.SE3:
    """Return the motion by [x, y, z, qx, qy, qz, qw], by a `pin.SE3`, or by a matrix (4, 4)."""
    if _is_zero(value):
        return pin.SE3.Identity()
    if isinstance(value, pin.SE3) or np.shape(value) == (4, 4):
        T = homogeneous(what, value)
    else:
        meaning = "[x, y, z, qx, qy, qz, qw] of a floating joint, a pin.SE3, a matrix (4, 4), or 0"
        q = real_array(what, value, (7,), meaning)
        if abs(float(np.linalg.norm(q[3:])) - 1) > 1e-6:
            raise InputError(f"{what} must hold a quaternion of length 1; its length is {np.linalg.norm(q[3:]):g}")
        T = pin.SE3(pin.Quaternion(q[3:] / np.linalg.norm(q[3:])).toRotationMatrix(), q[:3])
    _bounded(what, T.translation)
    return T


def _is_zero(value: Any) -> bool:
    return isinstance(value, int | float) and value == 0


def _bounded(what: str, value: Any) -> Any:
    if np.abs(value).max() > LARGEST:
        raise InputError(f"{what} is {value}; at most {LARGEST:g} can be computed with")
    return value


def _fix(joint: ET.Element, motion: pin.SE3) -> None:
    set_placement(joint, placement(joint) * motion)
    joint.set("type", "fixed")
    remove(joint, "axis", "limit", "mimic")
