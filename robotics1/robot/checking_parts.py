"""The checks of one joint and of one link."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from typing import cast

import numpy as np

from robotics1.angles import WIDE, looks_like_degrees
from robotics1.robot.findings import Findings
from robotics1.robot.markup import Element, child, children

JOINT_TYPES = ("revolute", "prismatic", "continuous", "fixed", "floating", "planar")
ON_AN_AXIS = ("revolute", "prismatic", "continuous", "planar")
SHAPES = {  # shape → its attributes, and how many numbers each has
    "box": {"size": 3},
    "cylinder": {"radius": 1, "length": 1},
    "capsule": {"radius": 1, "length": 1},
    "sphere": {"radius": 1},
    "mesh": {},
}
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")


def check_joint(findings: Findings, joint: Element, types: Mapping[str | None, str | None]) -> None:
    """Check the type, placement, axis, limits and mimicry of a joint; `types` are those of all joints, by name."""
    kind = joint.get("type")
    if kind not in JOINT_TYPES:
        fault = "has no type" if kind is None else f"has the unknown type {kind!r}"
        findings.error(joint, f"{fault}; it can be {', '.join(JOINT_TYPES)}")
    _check_origin(findings, joint, joint)
    if kind in ON_AN_AXIS:
        _check_axis(findings, joint)
    if kind in ("revolute", "prismatic", "continuous"):
        _check_limit(findings, joint, kind)
        _check_dynamics(findings, joint)
    _check_mimic(findings, joint, types)


def check_link(findings: Findings, link: Element) -> None:
    """Check the inertia and the shapes of a link."""
    inertial = child(link, "inertial")
    if inertial is not None:
        _check_inertial(findings, link, inertial)
    for kind in ("visual", "collision"):
        for shape in children(link, kind):
            _check_origin(findings, link, shape)
            _check_geometry(findings, link, shape)


def _check_origin(findings: Findings, owner: Element, parent: Element) -> None:
    origin = child(parent, "origin")
    if origin is not None:
        findings.numbers(owner, origin, "xyz", 3)
        _warn_of_degrees(findings, owner, origin, "the rpy of its <origin>", findings.numbers(owner, origin, "rpy", 3))


def _warn_of_degrees(
    findings: Findings, owner: Element, element: Element, what: str, angles: Sequence[float] | None
) -> None:
    typed = next((angle for angle in angles or () if looks_like_degrees(angle)), None)
    if typed is not None:
        findings.warn(owner, f"has the angle {typed:g} in {what}: a URDF is in radians; are degrees meant?", element)


def _check_axis(findings: Findings, joint: Element) -> None:
    axis = child(joint, "axis")
    planar = joint.get("type") == "planar"
    if axis is None:
        if planar:
            findings.warn(joint, "is planar and has no <axis>; it is taken to move in its xy plane")
        return
    if axis.get("xyz") is None:
        findings.error(joint, "has an <axis> without xyz; leave it out for the x axis", axis)
    values = findings.numbers(joint, axis, "xyz", 3)
    if values is not None:
        length = math.hypot(*values)
        if not 1e-9 < length < 1e9:
            findings.error(joint, f"has the axis {axis.get('xyz')!r}, which gives no direction", axis)
        elif planar and values[2] < (1 - 1e-9) * length:
            findings.error(joint, f"is planar about {axis.get('xyz')!r}; only '0 0 1' can be read, the xy plane", axis)
        elif abs(length - 1) > 1e-6:
            findings.warn(joint, f"has an axis of length {length:.6g}; it is taken as a direction", axis)


def _check_limit(findings: Findings, joint: Element, kind: str) -> None:
    limit = child(joint, "limit")
    if limit is None:
        if kind != "continuous":
            findings.error(joint, f"is {kind} and has no <limit>; write <limit lower upper velocity effort>")
        return
    for attribute in ("effort", "velocity"):
        if limit.get(attribute) is None:
            findings.error(joint, f"has a <limit> without {attribute}", limit)
            continue
        value = findings.numbers(joint, limit, attribute, largest=math.inf)
        if value is not None and value[0] < 0:
            findings.error(joint, f"has a negative {attribute} limit, {value[0]:g}", limit)
    lower, upper = (findings.numbers(joint, limit, name) for name in ("lower", "upper"))
    if kind == "continuous":
        return
    if limit.get("lower") is None and limit.get("upper") is None:
        findings.warn(joint, "has a <limit> without lower and upper, which means [0, 0]: it cannot move", limit)
    low = 0.0 if lower is None else lower[0]
    high = 0.0 if upper is None else upper[0]
    both = (lower is not None or limit.get("lower") is None) and (upper is not None or limit.get("upper") is None)
    if both and low > high:
        absent = [name for name in ("lower", "upper") if limit.get(name) is None]
        note = f"; {absent[0]} is not given, which means 0" if absent else ""
        findings.error(joint, f"has its limits the wrong way round: lower {low:g} is above upper {high:g}{note}", limit)
    elif kind == "revolute":
        _warn_of_degrees(findings, joint, limit, "its limits", [x for x in (low, high) if abs(x) > WIDE])


def _check_dynamics(findings: Findings, joint: Element) -> None:
    dynamics = child(joint, "dynamics")
    if dynamics is not None:
        findings.numbers(joint, dynamics, "damping")
        friction = findings.numbers(joint, dynamics, "friction")
        if friction is not None and friction[0] < 0:
            findings.error(joint, f"has a negative friction, {friction[0]:g}", dynamics)


def _check_mimic(findings: Findings, joint: Element, types: Mapping[str | None, str | None]) -> None:
    mimic = child(joint, "mimic")
    if mimic is None:
        return
    if joint.get("type") == "fixed":
        findings.warn(joint, "is fixed and has a <mimic>, which is left out", mimic)
        return
    name = mimic.get("joint")
    if name is None:
        findings.error(joint, "has a <mimic> without the joint it follows", mimic)
    elif name not in types:
        findings.error(joint, f"mimics joint {name!r}, and there is no such joint", mimic)
    elif types[name] not in ("revolute", "prismatic", "continuous"):
        findings.error(joint, f"mimics joint {name!r}, which is {types[name]} and has not one coordinate", mimic)
    if joint.get("type") not in ("revolute", "prismatic", "continuous"):
        findings.error(joint, f"is {joint.get('type')} and cannot mimic; only joints of one coordinate can", mimic)
    for attribute in ("multiplier", "offset"):
        findings.numbers(joint, mimic, attribute)


def _check_inertial(findings: Findings, link: Element, inertial: Element) -> None:
    _check_origin(findings, link, inertial)
    mass, inertia = child(inertial, "mass"), child(inertial, "inertia")
    if (missing := lacking(inertial)) or mass is None or inertia is None:
        findings.warn(link, f"has an <inertial> that lacks {missing}; it is left out", inertial)
        return
    weight = findings.numbers(link, mass, "value")
    moments = [findings.numbers(link, inertia, name) for name in MOMENTS]
    if weight is None or any(moment is None for moment in moments):
        return
    if weight[0] <= 0:
        findings.warn(link, f"has the mass {weight[0]:g}; nothing physical has", inertial)
    xx, xy, xz, yy, yz, zz = (cast("list[float]", moment)[0] for moment in moments)
    principal = np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    slack = 1e-6 * max(abs(principal).max(), 1e-300)
    if principal[0] < -slack or principal[0] + principal[1] < principal[2] - slack:
        findings.warn(
            link, "has an inertia that no body can have: a principal moment exceeds the sum of the others", inertial
        )


def lacking(inertial: ET.Element) -> str:
    """Return what an <inertial> lacks, in words; "" of one that is whole."""
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    if mass is None or inertia is None:
        return "mass or inertia"
    missing = [name for name in MOMENTS if inertia.get(name) is None]
    return ", ".join(missing) or ("the value of its mass" if mass.get("value") is None else "")


def _check_geometry(findings: Findings, link: Element, shape: Element) -> None:
    geometry = child(shape, "geometry")
    if geometry is None or not len(geometry):
        findings.error(link, f"has a <{shape.tag}> without a shape in its <geometry>", shape)
        return
    form = cast("Element", geometry[0])
    if form.tag not in SHAPES:
        findings.error(link, f"has the unknown shape <{form.tag}>; it can be {', '.join(SHAPES)}", form)
        return
    for name, size in SHAPES[form.tag].items():
        if form.get(name) is None:
            findings.error(link, f"has a {form.tag} without {name}", form)
            continue
        values = findings.numbers(link, form, name, size)
        if values is not None and min(values) < 0:
            findings.error(link, f"has a {form.tag} with a negative {name}, {form.get(name)!r}", form)
    if form.tag == "mesh":
        findings.numbers(link, form, "scale", 3)
        if not (form.get("filename") or "").strip():
            findings.error(link, "has a mesh without filename", form)
