"""An order of joints in which every leader comes before the joints that mimic it.

Pinocchio goes through the joints below a link in the order of their names, and refuses a joint whose leader it has
not met yet. Where that happens the joints are numbered, and get their names back in the model.
"""

import xml.etree.ElementTree as ET
from graphlib import CycleError, TopologicalSorter

import pinocchio as pin

from robotics1.robot.checking import linked

MARK = "\u241f"  # stands between the number and the name


def leaders_first(root: ET.Element) -> list[ET.Element] | None:
    """Return the joints in an order that Pinocchio can take, or None when its own order will do."""
    below: dict[str, list[ET.Element]] = {}
    for joint in sorted(root.findall("joint"), key=lambda joint: joint.get("name", "")):
        below.setdefault(str(linked(joint, "parent")), []).append(joint)
    children = {linked(joint, "child") for joint in root.findall("joint")}
    top = next((str(link.get("name")) for link in root.findall("link") if link.get("name") not in children), "")
    order = _walk(below, top)
    if not _early_followers(order):
        return None
    for siblings in below.values():
        siblings[:] = _in_turn(below, siblings)
    return _walk(below, top)


def _walk(below: dict[str, list[ET.Element]], link: str) -> list[ET.Element]:
    order: list[ET.Element] = []
    ahead = below.get(link, [])[::-1]
    while ahead:  # no recursion: a robot can be a thousand links long
        joint = ahead.pop()
        order.append(joint)
        ahead += below.get(str(linked(joint, "child")), [])[::-1]
    return order


def _early_followers(order: list[ET.Element]) -> list[ET.Element]:
    place = {joint.get("name"): i for i, joint in enumerate(order)}
    return [joint for i, joint in enumerate(order) for mimic in joint.findall("mimic") if place[mimic.get("joint")] > i]


def _in_turn(below: dict[str, list[ET.Element]], siblings: list[ET.Element]) -> list[ET.Element]:
    """Return the joints below a link so that each branch comes after those in which its leaders are."""
    branches = [[joint, *_walk(below, str(linked(joint, "child")))] for joint in siblings]
    place = {member.get("name"): i for i, branch in enumerate(branches) for member in branch}
    needs: dict[int, list[int]] = {}
    for i, branch in enumerate(branches):
        leaders = [place.get(mimic.get("joint"), i) for member in branch for mimic in member.findall("mimic")]
        needs[i] = [leader for leader in leaders if leader != i]
    try:
        return [siblings[i] for i in TopologicalSorter(needs).static_order()]
    except CycleError:  # two branches that follow each other: Pinocchio says so
        return siblings


def numbered(root: ET.Element, order: list[ET.Element]) -> None:
    """Put a number before the name of every joint, wherever it is named."""
    new = {joint.get("name"): f"{i:04}{MARK}{joint.get('name')}" for i, joint in enumerate(order)}
    for joint in order:
        joint.set("name", new[joint.get("name")])
        for mimic in joint.findall("mimic"):
            mimic.set("joint", new[mimic.get("joint")])


def unnumbered(model: pin.Model) -> None:
    """Give the joints of a model, and their frames, their names back."""
    for i, name in enumerate(model.names):
        model.names[i] = name.split(MARK)[-1]
    for frame in model.frames:
        frame.name = frame.name.split(MARK)[-1]
