"""What a reader of a URDF would overlook: elements that are there twice, stand elsewhere, or are misspelt."""

import xml.etree.ElementTree as ET
from collections import Counter
from typing import cast

from robotics1.errors import nearest_names
from robotics1.robot.findings import Findings
from robotics1.robot.markup import Element, child, children, linked

PARTS = {
    "joint": ("origin", "parent", "child", "axis", "limit", "mimic", "dynamics", "calibration", "safety_controller"),
    "link": ("inertial", "visual", "collision"),
    "inertial": ("origin", "mass", "inertia"),
    "visual": ("origin", "geometry", "material"),
    "collision": ("origin", "geometry"),
}
ATTRIBUTES = {
    "origin": ("xyz", "rpy"),
    "axis": ("xyz",),
    "limit": ("lower", "upper", "effort", "velocity"),
    "mimic": ("joint", "multiplier", "offset"),
    "parent": ("link",),
    "child": ("link",),
}
ENDS = ("parent", "child")
SEVERAL = ("visual", "collision")  # of one link
ALIKE = 0.65  # of two names, the larger part that they share: "xzy" for "xyz"


def check_overlooked(findings: Findings, root: Element) -> None:
    """Find what no reader would read, in links and joints and beside them."""
    for owner in (*children(root, "link"), *children(root, "joint")):
        _check_parts(findings, owner, owner)
        for part in owner:
            if part.tag in PARTS:
                _check_parts(findings, owner, cast("Element", part))
    for part in root:
        joint = None if part.tag in PARTS else _joint_inside(part)
        if joint is not None:
            findings.error(joint, f"stands inside <{part.tag}>; only what stands in <robot> itself is read")


def _check_parts(findings: Findings, owner: Element, element: Element) -> None:
    """Check the names and the number of an element's parts, and the names of their attributes."""
    known = PARTS[element.tag]
    where = "" if element is owner else f" in its <{element.tag}>"
    for tag, count in Counter(part.tag for part in element).items():
        if count > 1 and tag in ENDS:
            findings.error(owner, f"has {count} <{tag}> elements; it needs one", child(element, tag))
        elif count > 1 and tag in known and tag not in SEVERAL:
            findings.warn(owner, f"has {count} <{tag}> elements{where}; the first is read", child(element, tag))
    present = {part.tag for part in element}
    for part in cast("list[Element]", list(element)):
        if part.tag not in known:
            meant = nearest_names(part.tag, set(known) - present, ALIKE)
            if meant:
                findings.warn(owner, f"has <{part.tag}>{where}, which is not read; is <{meant[0]}> meant?", part)
        names = ATTRIBUTES.get(part.tag, ())
        for attribute in sorted(part.attrib.keys() - set(names)) if names else ():
            _check_attribute(findings, owner, part, attribute, set(names) - part.attrib.keys())


def _check_attribute(findings: Findings, owner: Element, part: Element, attribute: str, missing: set[str]) -> None:
    if attribute == "quat_xyzw":
        findings.error(owner, f"has quat_xyzw in its <{part.tag}>, which is not read; write the rotation as rpy", part)
        return
    meant = nearest_names(attribute, missing, ALIKE)
    if meant:
        what = f"{attribute!r} in its <{part.tag}>, which is not read"
        findings.warn(owner, f"has {what}; is {meant[0]!r} meant?", part)


def _joint_inside(part: ET.Element) -> Element | None:
    """Return the first joint below an element that names two links, as those of a URDF do, or None."""
    joints = (cast("Element", joint) for joint in part.iter("joint"))
    return next((joint for joint in joints if all(linked(joint, end) is not None for end in ENDS)), None)
