"""A checked URDF brought to the form in which Pinocchio reads it right, without changing what it means."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import real_number
from robotics1.robot.checking import linked
from robotics1.robot.checking_parts import MOMENTS, ON_AN_AXIS

WITHOUT_LIMIT = "1e308"  # urdfdom refuses infinity


def clean(root: ET.Element) -> list[str]:
    """Bring the tree to the form Pinocchio reads right; return the continuous joints.

    Axes become unit vectors, inertias that lack a part are left out, a joint that mimics a mimicking joint follows
    the leader itself, and a continuous joint, for which Pinocchio would take two numbers, becomes revolute.
    """
    _tidy(root)
    return [_as_revolute(joint) for joint in root.findall("joint") if joint.get("type") == "continuous"]


def lock(root: ET.Element, locked: Mapping[str, float]) -> None:
    """Turn joints into fixed ones at the given values [rad or m].

    Raises:
        UnknownNameError: there is no such joint.
        InputError: a value is not finite, or the joint has not one coordinate.
    """
    if locked:
        _tidy(root)
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    moving = [name for name, joint in joints.items() if joint.get("type") in ("revolute", "prismatic", "continuous")]
    for name, value in locked.items():
        if name not in joints:
            raise UnknownNameError("joint named", name, moving)
        if name not in moving or joints[name].find("mimic") is not None:
            raise InputError(f"joint {name!r} cannot be locked: it has no coordinate of its own")
        q = real_number(f"the value of locked joint {name!r}", value)
        followers = [joint for joint in joints.values() if _leader(joint) == name]
        _fix(joints[name], q)
        for follower in followers:
            mimic = follower.find("mimic")
            _fix(follower, _factor(mimic, "multiplier", 1.0) * q + _factor(mimic, "offset", 0.0))


def rebase(root: ET.Element, base: str, tool: str | None) -> None:
    """Make `base` the world: a link fixed to the root, or the link from which the arm of interest hangs.

    A link fixed to the root gives the world its axes; from another link, its subtree is kept and the rest left out.

    Raises:
        UnknownNameError: there is no such link.
        InputError: the tool, or the leader of a joint that mimics, does not hang from the base.
    """
    joints = root.findall("joint")
    above = {linked(joint, "child"): joint for joint in joints}
    links = [link.get("name", "") for link in root.findall("link")]
    if not isinstance(base, str) or base not in links:
        raise UnknownNameError("link named", base, links)
    T = pin.SE3.Identity()  # of the base in the root, while all joints up to it are fixed
    link: str | None = base
    while link in above and above[link].get("type") == "fixed":
        T, link = placement(above[link]) * T, linked(above[link], "parent")
    if link not in above:
        _put_world_at(root, str(link), T)
        return
    kept = _hanging_from(base, joints)
    if tool is not None and tool not in kept:
        raise InputError(f"the tool {tool!r} does not hang from the base {base!r}; name a base that carries it")
    moving = {joint.get("name"): joint for joint in joints if linked(joint, "parent") in kept}
    for name, joint in moving.items():
        if _leader(joint) is not None and _leader(joint) not in moving:
            raise InputError(f"joint {name!r} mimics {_leader(joint)!r}, which does not hang from the base {base!r}")
    for element in [*root.findall("link"), *joints]:
        name = element.get("name") if element.tag == "link" else linked(element, "parent")
        if name not in kept:
            root.remove(element)


def _tidy(root: ET.Element) -> None:
    for link in root.findall("link"):
        for i, inertial in enumerate(link.findall("inertial")):
            if i > 0 or not _is_whole(inertial):
                link.remove(inertial)
    for joint in root.findall("joint"):
        for extra in joint.findall("mimic")[1:]:
            joint.remove(extra)
        if joint.get("type") == "fixed":
            _remove(joint, "mimic")
        if joint.get("type") in ON_AN_AXIS:
            _make_unit(joint.find("axis"))
        else:
            _remove(joint, "axis")
    _follow_leaders(root)


def placement(joint: ET.Element) -> pin.SE3:
    """Return the placement of a joint in its parent link."""
    origin = joint.find("origin")
    texts = ("0 0 0", "0 0 0") if origin is None else (origin.get("xyz", "0 0 0"), origin.get("rpy", "0 0 0"))
    xyz, rpy = (np.array([float(value) for value in text.split()]) for text in texts)
    return pin.SE3(pin.rpy.rpyToMatrix(rpy), xyz)


def written(values: np.ndarray) -> str:
    """Return numbers as text, with every digit."""
    return " ".join(repr(float(value)) for value in values)


def _make_unit(axis: ET.Element | None) -> None:
    if axis is not None:
        direction = np.array([float(value) for value in axis.get("xyz", "").split()])
        axis.set("xyz", written(direction / np.linalg.norm(direction)))


def _set_placement(joint: ET.Element, T: pin.SE3) -> None:
    origin = joint.find("origin")
    if origin is None:
        origin = ET.SubElement(joint, "origin")
    origin.set("xyz", written(T.translation))
    origin.set("rpy", written(pin.rpy.matrixToRpy(T.rotation)))


def _hanging_from(base: str, joints: list[ET.Element]) -> set[str]:
    kept = {base}
    while more := {str(linked(joint, "child")) for joint in joints if linked(joint, "parent") in kept} - kept:
        kept |= more
    return kept


def _put_world_at(root: ET.Element, old: str, T: pin.SE3) -> None:
    """Hang the old root on a new one, which has the axes of the base."""
    names = {element.get("name") for element in root}
    world = "world"
    while world in names:
        world += "_"
    joint = ET.SubElement(root, "joint", name=f"{world}_to_{old}", type="fixed")
    ET.SubElement(joint, "parent", link=world)
    ET.SubElement(joint, "child", link=old)
    _set_placement(joint, T.inverse())
    root.insert(0, ET.Element("link", name=world))


def _fix(joint: ET.Element, q: float) -> None:
    axis = joint.find("axis")
    text = "1 0 0" if axis is None else axis.get("xyz", "1 0 0")
    direction = np.array([float(value) for value in text.split()])
    if joint.get("type") == "prismatic":
        motion = pin.SE3(np.eye(3), q * direction)
    else:
        motion = pin.SE3(pin.exp3(q * direction), np.zeros(3))
    _set_placement(joint, placement(joint) * motion)
    joint.set("type", "fixed")
    _remove(joint, "axis", "limit", "mimic")


def _remove(joint: ET.Element, *tags: str) -> None:
    for tag in tags:
        for element in joint.findall(tag):
            joint.remove(element)


def _is_whole(inertial: ET.Element) -> bool:
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    whole = mass is not None and mass.get("value") is not None and inertia is not None
    return whole and all(inertia.get(name) is not None for name in MOMENTS)  # type: ignore[union-attr]


def _leader(joint: ET.Element) -> str | None:
    mimic = joint.find("mimic")
    return None if mimic is None else mimic.get("joint")


def _factor(mimic: ET.Element | None, attribute: str, default: float) -> float:
    return default if mimic is None else float(mimic.get(attribute, default))


def _follow_leaders(root: ET.Element) -> None:
    """Let q = a q₁ + b with q₁ = c q₂ + d be q = a c q₂ + a d + b."""
    mimics = {joint.get("name"): joint.find("mimic") for joint in root.findall("joint")}
    for mimic in mimics.values():
        while mimic is not None and mimics.get(mimic.get("joint")) is not None:
            leader = mimics[mimic.get("joint")]
            a, b = _factor(mimic, "multiplier", 1.0), _factor(mimic, "offset", 0.0)
            mimic.set("multiplier", repr(a * _factor(leader, "multiplier", 1.0)))
            mimic.set("offset", repr(a * _factor(leader, "offset", 0.0) + b))
            mimic.set("joint", str(leader.get("joint") if leader is not None else ""))


def _as_revolute(joint: ET.Element) -> str:
    joint.set("type", "revolute")
    limit = joint.find("limit")
    if limit is None:
        limit = ET.SubElement(joint, "limit", effort=WITHOUT_LIMIT, velocity=WITHOUT_LIMIT)
    limit.set("lower", repr(-math.pi))
    limit.set("upper", repr(math.pi))
    return joint.get("name", "")
