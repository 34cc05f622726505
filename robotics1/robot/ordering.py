"""An order of joints in which leaders come before the joints that mimic them, where the tree allows it.

The order is depth first, and below a link by the joints' names, as Pinocchio has it.
"""

import xml.etree.ElementTree as ET
from graphlib import CycleError, TopologicalSorter

from robotics1.robot.checking import linked


def root_link(root: ET.Element) -> str:
    """Return the link that hangs on no joint."""
    children = {linked(joint, "child") for joint in root.findall("joint")}
    return next((str(link.get("name")) for link in root.findall("link") if link.get("name") not in children), "")


def leaders_first(root: ET.Element) -> list[ET.Element]:
    """Return the joints depth first: by name below a link, or so that branches with leaders come first."""
    below: dict[str, list[ET.Element]] = {}
    for joint in sorted(root.findall("joint"), key=lambda joint: joint.get("name", "").encode()):
        below.setdefault(str(linked(joint, "parent")), []).append(joint)
    top = root_link(root)
    order = _walk(below, top)
    if not late_leaders(order):
        return order
    for siblings in below.values():
        siblings[:] = _in_turn(below, siblings)
    return _walk(below, top)


def late_leaders(order: list[ET.Element]) -> list[ET.Element]:
    """Return the leaders that come after a joint that mimics them."""
    place = {joint.get("name"): i for i, joint in enumerate(order)}
    leaders = {
        place[mimic.get("joint")] for i, joint in enumerate(order) for mimic in joint.findall("mimic")
        if place[mimic.get("joint")] > i
    }  # fmt: skip
    return [order[i] for i in sorted(leaders)]


def _walk(below: dict[str, list[ET.Element]], link: str) -> list[ET.Element]:
    order: list[ET.Element] = []
    ahead = below.get(link, [])[::-1]
    while ahead:  # no recursion: a robot can be a thousand links long
        joint = ahead.pop()
        order.append(joint)
        ahead += below.get(str(linked(joint, "child")), [])[::-1]
    return order


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
    except CycleError:  # two branches follow each other: one of them comes after its followers
        return siblings
