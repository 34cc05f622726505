"""What a caller changes of the robot in a file: joints that are held, and another link as the world."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import real_array, real_number
from robotics1.robot.findings import LARGEST
from robotics1.robot.joints import Joint, free_name, placed
from robotics1.robot.placements import homogeneous
from robotics1.robot.urdf import PLAIN, Link


def lock(joints: Sequence[Joint], locked: Mapping[str, Any]) -> tuple[Joint, ...]:
    """Return the joints with some of them fixed at the given values: rad or m, of a planar or floating joint as at
    `load_robot`. No leader mimics another joint.

    Raises:
        UnknownNameError: there is no such joint.
        InputError: a value is not finite or has another form, or the joint has no coordinate of its own.

    Warns:
        RobotWarning: an angle is one in degrees.
    """
    found = {joint.name: joint for joint in joints}
    moving = [joint.name for joint in joints if joint.kind != "fixed" and not joint.follows]
    for name, value in locked.items():
        if name not in found:
            raise UnknownNameError("joint named", name, moving)
        if name not in moving:
            raise InputError(f"joint {name!r} cannot be locked: it has no coordinate of its own")
        joint, what = found[name], f"the value of locked joint {name!r}"
        if joint.kind in FREE:
            still = isinstance(value, int | float) and value == 0
            found[name] = _fixed(joint, pin.SE3.Identity() if still else FREE[joint.kind](what, value))
            continue
        q = _bounded(what, real_number(what, value))
        warn_of_degrees(what, np.array([q]), joint.kind == "revolute", joint.lower, joint.upper)
        found[name] = _fixed(joint, _along_axis(joint, q))
        for follower in [j for j in found.values() if j.follows and j.leader == name]:
            q_follower = follower.multiplier * q + follower.offset
            _bounded(f"{what}, by which {follower.name!r} follows", q_follower)
            found[follower.name] = _fixed(follower, _along_axis(follower, q_follower))
    return tuple(found.values())


def _fixed(joint: Joint, motion: pin.SE3) -> Joint:
    at_value = placed(joint, joint.placement * motion)
    return Joint(joint.name, "fixed", joint.parent, joint.child, at_value.xyz, at_value.rpy)


def _along_axis(joint: Joint, q: float) -> pin.SE3:
    """Return the motion of a joint about or along its axis."""
    axis = np.array(joint.axis)
    if joint.kind == "prismatic":
        return pin.SE3(np.eye(3), q * axis)
    return pin.SE3(pin.AngleAxis(q, axis).toRotationMatrix(), np.zeros(3))


def _planar(what: str, value: Any) -> pin.SE3:
    """Return the motion by [x, y, θ] in the plane."""
    x, y, theta = _bounded(what, real_array(what, value, (3,), "[x, y, theta] of a planar joint, or 0"))
    return pin.SE3(pin.AngleAxis(theta, np.array([0.0, 0.0, 1.0])).toRotationMatrix(), np.array([x, y, 0.0]))


def _floating(what: str, value: Any) -> pin.SE3:
    """Return the motion by [x, y, z, qx, qy, qz, qw], by a `pin.SE3`, or by a matrix (4, 4)."""
    if not (isinstance(value, pin.SE3) or np.shape(value) == (4, 4)):
        meaning = "[x, y, z, qx, qy, qz, qw] of a floating joint, a pin.SE3, a matrix (4, 4), or 0"
        q = real_array(what, value, (7,), meaning)
        value = (q[:3], q[3:])
    T = homogeneous(what, value)
    _bounded(what, T.translation)
    return T


def _bounded(what: str, value: Any) -> Any:
    if np.abs(value).max() > LARGEST:
        raise InputError(f"{what} is {value}; at most {LARGEST:g} can be computed with")
    return value


FREE = {"planar": _planar, "floating": _floating}


def rebase(
    links: Mapping[str, Link], joints: Sequence[Joint], base: str, tool: str | None
) -> tuple[dict[str, Link], tuple[Joint, ...]]:
    """Return the robot with `base` as the world: a link fixed to the root, or the one from which the arm hangs.

    A link fixed to the root gives the world its axes; from another link, its subtree is kept and the rest left out.

    Raises:
        UnknownNameError: there is no such link.
        InputError: the tool, or the leader of a joint that mimics, does not hang from the base.
    """
    if not isinstance(base, str) or base not in links:
        raise UnknownNameError("link named", base, links)
    above = {joint.child: joint for joint in joints}
    T, link = pin.SE3.Identity(), base  # of the base in the root, while all joints up to it are fixed
    while link in above and above[link].kind == "fixed":
        T, link = above[link].placement * T, above[link].parent
    if link not in above:
        world = free_name("world", {*links, *(joint.name for joint in joints)})
        mount = placed(Joint(f"{world}_to_{link}", "fixed", world, link), T.inverse())
        return {world: PLAIN, **links}, (*joints, mount)
    kept = {base}
    while more := {joint.child for joint in joints if joint.parent in kept} - kept:
        kept |= more
    if tool is not None and tool not in kept:
        raise InputError(f"the tool {tool!r} does not hang from the base {base!r}; name a base that carries it")
    moving = {joint.name: joint for joint in joints if joint.parent in kept}
    for joint in moving.values():
        if joint.leader not in moving:
            raise InputError(
                f"joint {joint.name!r} mimics {joint.leader!r}, which does not hang from the base {base!r}"
            )
    return {name: link for name, link in links.items() if name in kept}, tuple(moving.values())
