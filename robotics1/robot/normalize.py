"""A checked URDF brought to one simple form, without changing what it means, so that every reader takes it.

Readers differ in what they stumble over: materials without colour, limits of joints that have none, tabs between
numbers, the elements of other programs. What is neither kinematics nor shape nor inertia is left out.
"""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, UnknownNameError
from robotics1.robot.checking import DEFINITIONS
from robotics1.robot.checking_parts import MOMENTS, ON_AN_AXIS
from robotics1.robot.markup import linked

ROBOT, LINK = ("link", "joint", "material"), ("inertial", "visual", "collision")
FIXED, MOVING = ("parent", "child", "origin"), ("axis", "limit", "mimic", "dynamics")
OF_ONE_COORDINATE = ("revolute", "prismatic", "continuous")


def clean(root: ET.Element) -> None:
    """Bring the tree to its simplest form.

    Axes become unit vectors, inertias that lack a part are left out, and a joint that mimics a mimicking joint
    follows the leader itself.
    """
    _trim(root)
    tidy(root)


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
        if leader(joint) is not None and leader(joint) not in moving:
            raise InputError(f"joint {name!r} mimics {leader(joint)!r}, which does not hang from the base {base!r}")
    for element in [*root.findall("link"), *joints]:
        name = element.get("name") if element.tag == "link" else linked(element, "parent")
        if name not in kept:
            root.remove(element)


def tidy(root: ET.Element) -> None:
    """Leave one meaning to each joint and link: unit axes, leaders that follow no other, inertias that are whole."""
    for link in root.findall("link"):
        for i, inertial in enumerate(link.findall("inertial")):
            if i > 0 or not _is_whole(inertial):
                link.remove(inertial)
    for joint in root.findall("joint"):
        for extra in joint.findall("mimic")[1:]:
            joint.remove(extra)
        if joint.get("type") == "fixed":
            remove(joint, "mimic")
        if joint.get("type") in ON_AN_AXIS:
            _make_unit(joint.find("axis"))
        else:
            remove(joint, "axis")
    _follow_leaders(root)


def placement(part: ET.Element) -> pin.SE3:
    """Return the placement of a joint, or of another part with an <origin>, in its link."""
    xyz, rpy = (np.array(numbers(part.find("origin"), key, "0 0 0")) for key in ("xyz", "rpy"))
    return pin.SE3(pin.rpy.rpyToMatrix(rpy), xyz)


def numbers(element: ET.Element | None, attribute: str, default: str = "") -> list[float]:
    """Return the numbers of an attribute, or of the default where there is none."""
    return [float(value) for value in (default if element is None else element.get(attribute, default)).split()]


def written(values: np.ndarray) -> str:
    """Return numbers as text, with every digit."""
    return " ".join(repr(float(value)) for value in values)


def _make_unit(axis: ET.Element | None) -> None:
    if axis is not None:
        direction = np.array([float(value) for value in axis.get("xyz", "").split()])
        axis.set("xyz", written(direction / np.linalg.norm(direction)))


def set_placement(joint: ET.Element, T: pin.SE3) -> None:
    """Write the placement of a joint."""
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
    set_placement(joint, T.inverse())
    root.insert(0, ET.Element("link", name=world))


def remove(joint: ET.Element, *tags: str) -> None:
    """Take the parts with these tags out of a joint."""
    for tag in tags:
        for element in joint.findall(tag):
            joint.remove(element)


def _is_whole(inertial: ET.Element) -> bool:
    mass, inertia = inertial.find("mass"), inertial.find("inertia")
    whole = mass is not None and mass.get("value") is not None and inertia is not None
    return whole and all(inertia.get(name) is not None for name in MOMENTS)  # type: ignore[union-attr]


def leader(joint: ET.Element) -> str | None:
    """Return the joint that a joint mimics, or None."""
    mimic = joint.find("mimic")
    return None if mimic is None else mimic.get("joint")


def factor(mimic: ET.Element | None, attribute: str, default: float) -> float:
    """Return the multiplier or the offset of a <mimic>."""
    return default if mimic is None else float(mimic.get(attribute, default))


def _follow_leaders(root: ET.Element) -> None:
    """Let q = a q₁ + b with q₁ = c q₂ + d be q = a c q₂ + a d + b."""
    mimics = {joint.get("name"): joint.find("mimic") for joint in root.findall("joint")}
    for mimic in mimics.values():
        while mimic is not None and mimics.get(mimic.get("joint")) is not None:
            above = mimics[mimic.get("joint")]
            a, b = factor(mimic, "multiplier", 1.0), factor(mimic, "offset", 0.0)
            mimic.set("multiplier", repr(a * factor(above, "multiplier", 1.0)))
            mimic.set("offset", repr(a * factor(above, "offset", 0.0) + b))
            mimic.set("joint", str(above.get("joint") if above is not None else ""))


def _trim(root: ET.Element) -> None:
    """Leave out what is neither kinematics nor shape nor inertia, and what of it is not whole."""
    _drop_definitions(root)
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


def _drop_definitions(root: ET.Element) -> None:
    """Take the definitions out of a tree that needs none of them."""
    for element in list(root.iter()):
        for part in [part for part in element if part.tag in DEFINITIONS]:
            element.remove(part)
