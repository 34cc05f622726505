"""A URDF reduced to what a robot is, so that every reader of the text takes it.

Readers differ in what they stumble over: materials without colour, limits of joints that have none, tabs between
numbers, the elements of other programs.
"""

import math
import xml.etree.ElementTree as ET

from robotics1.robot.leftovers import drop_definitions

ROBOT, LINK = ("link", "joint", "material"), ("inertial", "visual", "collision")
FIXED, MOVING = ("parent", "child", "origin"), ("axis", "limit", "mimic", "dynamics")
OF_ONE_COORDINATE = ("revolute", "prismatic", "continuous")


def trim(root: ET.Element) -> None:
    """Leave out what is neither kinematics nor shape nor inertia, and what of it is not whole."""
    drop_definitions(root)
    root.attrib = {"name": root.get("name", "")}
    _keep(root, ROBOT)
    for link in root.findall("link"):
        _keep(link, LINK)
    for joint in root.findall("joint"):
        axis = ("axis",) if joint.get("type") == "planar" else ()
        _keep(joint, FIXED + (MOVING if joint.get("type") in OF_ONE_COORDINATE else axis))
        for dynamics in joint.findall("dynamics"):
            if not {"damping", "friction"} & set(dynamics.attrib):
                joint.remove(dynamics)
    _trim_materials(root)
    for element in root.iter():
        for key in ("xyz", "rpy", "size", "scale"):
            if key in element.attrib:
                element.set(key, " ".join(element.get(key, "").split()))


def _keep(element: ET.Element, tags: tuple[str, ...]) -> None:
    for part in [part for part in element if part.tag not in tags]:
        element.remove(part)


def _trim_materials(root: ET.Element) -> None:
    """Give every shape its colour where it is named, and leave out other materials."""
    colors: dict[str, str] = {}
    for material in root.findall("material"):
        if color := _color(material):
            colors.setdefault(material.get("name", ""), color)
        root.remove(material)
    for visual in root.iterfind("link/visual"):
        for material in visual.findall("material"):
            name = material.get("name", "")
            color = _color(material)
            if color and name not in colors:
                colors[name] = color
            visual.remove(material)
            if name in colors:
                ET.SubElement(ET.SubElement(visual, "material", name=name), "color", rgba=colors[name])
                break


def _color(material: ET.Element) -> str:
    """Return the numbers of a colour, or nothing where they are not four from 0 to 1."""
    color = material.find("color")
    texts = [] if color is None else color.get("rgba", "").split()
    try:
        whole = len(texts) == 4 and all(math.isfinite(float(text)) and 0 <= float(text) <= 1 for text in texts)
    except ValueError:
        whole = False
    return " ".join(texts) if whole and material.get("name", "").strip() else ""
