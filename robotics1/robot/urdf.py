"""A URDF as joints and links: read from a tree that has been checked, and written as a text that every reader takes.

Readers differ in what they stumble over: materials without colour, limits of joints that have none, tabs between
numbers, the elements of other programs. What is neither kinematics nor shape nor inertia is left out.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from robotics1.robot.checking_parts import MOMENTS, ON_AN_AXIS, lacking
from robotics1.robot.joints import Joint, Triple
from robotics1.robot.markup import linked
from robotics1.robot.meshes import UNDRAWN

SHAPES = ("visual", "collision", UNDRAWN)
WITHOUT_LIMIT = 1e308  # what stands for infinity in files, since urdfdom refuses that
FAR = 1000.0  # m or rad: what a file says where one limit is missing, for URDF takes no infinity


@dataclass(frozen=True, eq=False)
class Link:
    """A link: its inertia about its own axes, and its elements <inertial>, <visual>, <collision> and <undrawn>."""

    inertia: pin.Inertia
    parts: tuple[ET.Element, ...] = ()


PLAIN = Link(pin.Inertia.Zero())  # without inertia and shapes

# --- reading


def read_joints(root: ET.Element) -> tuple[Joint, ...]:
    """Return the joints, in the order of the file; axes are unit vectors."""
    return tuple(map(_joint, root.findall("joint")))


def _joint(joint: ET.Element) -> Joint:
    name, kind = joint.get("name", ""), joint.get("type", "")
    one = kind in ("revolute", "prismatic", "continuous")
    limit, dynamics = (joint.find(tag) if one else None for tag in ("limit", "dynamics"))
    mimic = joint.find("mimic") if kind != "fixed" else None
    xyz, rpy = _origin(joint)
    axis = np.array(_numbers(joint.find("axis") if kind in ON_AN_AXIS else None, "xyz", "1 0 0"))
    u, v, w = map(float, axis / np.linalg.norm(axis))
    bounded = kind in ("revolute", "prismatic")
    return Joint(
        name,
        kind.replace("continuous", "revolute"),
        str(linked(joint, "parent")),
        str(linked(joint, "child")),
        xyz,
        rpy,
        (u, v, w),
        lower=_limit(limit, "lower", 0.0) if bounded else -np.inf,
        upper=_limit(limit, "upper", 0.0) if bounded else np.inf,
        max_velocity=_limit(limit, "velocity", np.inf),
        max_effort=_limit(limit, "effort", np.inf),
        friction=_numbers(dynamics, "friction", "0")[0],
        damping=_numbers(dynamics, "damping", "0")[0],
        leader="" if mimic is None else mimic.get("joint", ""),
        multiplier=_numbers(mimic, "multiplier", "1")[0],
        offset=_numbers(mimic, "offset", "0")[0],
    )


def read_links(root: ET.Element) -> dict[str, Link]:
    """Return the links by their names; of inertias those that are whole, of shapes those with colours that are."""
    colors = _colors(root)
    links = {}
    for link in root.findall("link"):
        inertial = [inertial for inertial in link.findall("inertial")[:1] if not lacking(inertial)]
        shapes = [part for part in link if part.tag in SHAPES]
        for shape in shapes:
            _paint(shape, colors)
            for element in shape.iter():
                for key in {"xyz", "rpy", "size", "scale"} & set(element.attrib):
                    element.set(key, " ".join(element.get(key, "").split()))
        links[link.get("name", "")] = Link(_inertia(inertial), (*inertial, *shapes))
    return links


def _numbers(element: ET.Element | None, attribute: str, default: str = "") -> list[float]:
    """Return the numbers of an attribute, or of the default where there is none."""
    return [float(value) for value in (default if element is None else element.get(attribute, default)).split()]


def _origin(part: ET.Element) -> tuple[Triple, Triple]:
    x, y, z = _numbers(part.find("origin"), "xyz", "0 0 0")
    roll, pitch, yaw = _numbers(part.find("origin"), "rpy", "0 0 0")
    return (x, y, z), (roll, pitch, yaw)


def _limit(limit: ET.Element | None, key: str, default: float) -> float:
    value = _numbers(limit, key, repr(default))[0]
    return np.inf if value >= WITHOUT_LIMIT else value


def _inertia(inertials: Sequence[ET.Element]) -> pin.Inertia:
    """Return the inertia of a link about its own axes; zero where the file gives none."""
    Y = pin.Inertia.Zero()  # its constructor refuses impossible inertias, where the file's checks only warn
    for inertial in inertials:
        mass, matrix = inertial.find("mass"), inertial.find("inertia")
        xx, xy, xz, yy, yz, zz = (_numbers(matrix, moment)[0] for moment in MOMENTS)
        xyz, rpy = map(np.array, _origin(inertial))
        R = pin.rpy.rpyToMatrix(rpy)
        Y.mass, Y.lever = _numbers(mass, "value")[0], xyz
        Y.inertia = R @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ R.T
    return Y


def _colors(root: ET.Element) -> dict[str, str]:
    """Return the colour that a name first has: of the robot's materials, else of a shape's."""
    colors: dict[str, str] = {}
    for material in [*root.findall("material"), *root.iterfind("link/visual/material")]:
        if color := _color(material):
            colors.setdefault(material.get("name", ""), color)
    return colors


def _paint(shape: ET.Element, colors: Mapping[str, str]) -> None:
    """Give a shape the colour that its material names, in the shape itself; other materials are left out."""
    for material in shape.findall("material"):
        shape.remove(material)
        name = material.get("name", "")
        if shape.tag == "visual" and name in colors and shape.find("material") is None:
            shape.append(element("material", element("color", rgba=colors[name]), name=name))


def _color(material: ET.Element) -> str:
    """Return the numbers of a colour, or nothing where they are not four from 0 to 1."""
    color = material.find("color")
    texts = [] if color is None else color.get("rgba", "").split()
    try:
        whole = len(texts) == 4 and all(math.isfinite(float(text)) and 0 <= float(text) <= 1 for text in texts)
    except ValueError:
        whole = False
    return " ".join(texts) if whole and material.get("name", "").strip() else ""


# --- writing


def urdf_text(name: str, links: Mapping[str, Link], joints: Sequence[Joint]) -> str:
    """Return the text of a URDF, in one layout: xacro, once imported, changes how Python writes all XML."""
    return _text(element("robot", *_elements(links, joints), name=name))


def elements_text(links: Mapping[str, Link], joints: Sequence[Joint]) -> str:
    """Return what `urdf_text` writes of links and joints."""
    return "".join(f"  {_text(each, level=1)}\n" for each in _elements(links, joints))


def _elements(links: Mapping[str, Link], joints: Sequence[Joint]) -> list[ET.Element]:
    written = [element("link", *link.parts, name=key) for key, link in links.items()]
    return [*written, *map(_joint_element, joints)]


def _text(root: ET.Element, level: int = 0) -> str:
    ET.indent(root, level=level)
    for part in root.iter():
        part.attrib = dict(sorted(part.attrib.items()))
    return ET.tostring(root, encoding="unicode")


def element(tag: str, *children: ET.Element, **attributes: str) -> ET.Element:
    """Return an element with its children and attributes."""
    made = ET.Element(tag, attributes)
    made.extend(children)
    return made


def _joint_element(joint: Joint) -> ET.Element:
    kind = joint.kind
    parts = [
        element("parent", link=joint.parent),
        element("child", link=joint.child),
        element("origin", xyz=numbers_text(joint.xyz), rpy=numbers_text(joint.rpy)),
    ]
    if kind == "planar":
        parts.append(element("axis", xyz="0 0 1"))
    if kind in ("revolute", "prismatic"):
        rates = {"velocity": joint.max_velocity, "effort": joint.max_effort}
        limits = {key: repr(value) if math.isfinite(value) else f"{WITHOUT_LIMIT:g}" for key, value in rates.items()}
        parts.append(element("axis", xyz=numbers_text(joint.axis)))
        if kind == "revolute" and math.isinf(joint.lower) and math.isinf(joint.upper):
            kind = "continuous"
        else:
            limits |= _ends(joint.lower, joint.upper)
        if kind != "continuous" or any(map(math.isfinite, rates.values())):
            parts.append(element("limit", **limits))
        if joint.friction or joint.damping:
            parts.append(element("dynamics", friction=repr(joint.friction), damping=repr(joint.damping)))
        if joint.follows:
            factors = {"multiplier": repr(joint.multiplier), "offset": repr(joint.offset)}
            parts.append(element("mimic", joint=joint.leader, **factors))
    return element("joint", *parts, name=joint.name, type=kind)


def _ends(lower: float, upper: float) -> dict[str, str]:
    """Return the limits of a motion; where one is missing, far away."""
    low = lower if math.isfinite(lower) else min(-FAR, upper - FAR)
    high = upper if math.isfinite(upper) else max(FAR, lower + FAR)
    return {"lower": repr(low), "upper": repr(high)}


def numbers_text(values: Iterable[float]) -> str:
    """Return numbers as an attribute has them."""
    return " ".join(repr(float(value) + 0.0) for value in values)
