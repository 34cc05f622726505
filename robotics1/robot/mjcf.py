"""A robot in MuJoCo's format, MJCF: its bodies become links, and its joints are read as MuJoCo reads them.

Pinocchio's own reader leaves out the place of a body that is fixed to the world, all trees but the first, included
files and joints that share a body, and takes the range of a slide for degrees (pin 4.1).
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, RobotFileError, warn
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.checking import MOST_DEGREES, MOST_LINKS
from robotics1.robot.joints import Joint, free_name, placed
from robotics1.robot.markup import Element, children, parse_xml
from robotics1.robot.mjcf_elements import MAIN, Meaning, with_included
from robotics1.robot.model import Robot
from robotics1.robot.sources import TEXT
from robotics1.robot.urdf import PLAIN

KINDS = {"hinge": "revolute", "slide": "prismatic", "free": "floating"}
SAME_PLACE = 1e-12  # of a link and its joint
WORLD = "world"


def is_mjcf(text: str, path: Path) -> bool:
    """Return whether a text is MJCF: its root is <mujoco>, and it is well-formed."""
    return "<mujoco" in text[:100_000] and parse_xml(text, path).tag == "mujoco"


def robot_of_mjcf(text: str, path: Path, tool: str | None, *, trusted: bool) -> Robot:
    """Return the robot of an MJCF text, which stands in the file `path` or, for `TEXT`, in memory.

    A body is a link, a site is a frame; inertias and shapes are left out, and bodies that only mark a place
    (`mocap`) too. What <equality> asks for is not kept, which a warning says. A free joint at 0 is where it is drawn.

    Raises:
        InputError: the file is not trusted.
        RobotFileError: it is no robot, or has what cannot be read, such as a ball joint; with the line.
    """
    if not trusted:
        raise InputError(
            f"{'the text' if path is TEXT else path} is MJCF, which may include any files of this computer; if you "
            "trust it, say trusted=True or --trusted, or give its URDF"
        )
    file = Path("robot.xml") if path is TEXT else path  # what a text includes is looked for in the working folder
    meaning = Meaning(path, with_included(parse_xml(text, path), file))
    tree = _Tree(meaning)
    for world in children(meaning.root, "worldbody"):
        tree.add_parts(world, WORLD, pin.SE3.Identity(), world.get("childclass", MAIN))
    moving = [joint for joint in tree.joints if joint.kind != "fixed"]
    if not moving:
        raise RobotFileError("it has no joints", path=path)
    freedom = sum(len(joint.turning) for joint in moving)
    if freedom > MOST_DEGREES or len(tree.links) > MOST_LINKS:
        most = f"at most {MOST_DEGREES} and {MOST_LINKS} can be computed with"
        raise RobotFileError(f"it has {freedom} degrees of freedom and {len(tree.links)} links; {most}", path=path)
    odd = tuple(_not_kept(meaning.root))
    name = meaning.root.get("model") or "robot"
    robot = robot_of_joints(name, tree.joints, dict.fromkeys(tree.links, PLAIN), tool=tool, path=path, warnings=odd)
    if odd:
        warn(f"robot {name!r}: {'; '.join(odd)}")
    return robot


def _not_kept(root: Element) -> list[str]:
    """Return a sentence on each condition that a file puts on its joints and bodies."""
    sentences = []
    for part in (part for equality in root.findall("equality") for part in equality):
        ends = [part.get(key) for key in ("joint1", "joint2", "body1", "body2", "site1", "site2") if part.get(key)]
        if part.tag in ("joint", "connect", "weld") and part.get("active") != "false":
            what = "joints are tied to each other" if part.tag == "joint" else "a loop of bodies is closed"
            sentences.append(
                f"by <{part.tag}> in <equality> {what}, {' and '.join(map(repr, ends))}; here they are free"
            )
    return sentences


@dataclass
class _Tree:
    """The links and joints of the bodies read so far."""

    meaning: Meaning
    links: list[str] = field(default_factory=lambda: [WORLD])
    joints: list[Joint] = field(default_factory=list)

    def add_parts(self, body: Element, link: str, T: pin.SE3, childclass: str) -> None:
        """Add the bodies and sites in a body, which is the given link."""
        for part, place, of_class in self.meaning.parts(body, T, childclass):
            if part.tag == "body" and part.get("mocap") != "true":
                self._add_body(part, link, place, part.get("childclass", of_class))
            elif part.tag == "site" and part.get("name"):
                attributes = self.meaning.attributes(part, of_class)
                if "fromto" not in attributes:
                    name = free_name(part.get("name", ""), self.links)
                    self._fix(name, link, place * self.meaning.place(part, attributes))

    def _add_body(self, body: Element, parent: str, T: pin.SE3, childclass: str) -> None:
        """Add a body with its joints, which move it one after the other, and what it carries."""
        name = body.get("name") or free_name(f"body_{len(self.links)}", self.links)
        if name in self.links:
            raise self.meaning.error(body, "is there twice; names of bodies must differ")
        parts = self.meaning.parts(body, pin.SE3.Identity(), childclass)
        moves = [part for part in parts if part[0].tag in ("joint", "freejoint")]
        taken, rest = {*self.links, name}, T * self.meaning.place(body, dict(body.attrib))
        for number, (element, place, of_class) in enumerate(moves, start=1):
            joint, rest = self._joint(element, parent, rest, place, of_class)
            last = number == len(moves) and rest.isIdentity(SAME_PLACE)
            parent = name if last else free_name(f"{joint.name}_link", taken)
            self.joints.append(replace(joint, child=parent))
            self.links.append(parent)
        if parent != name:
            self._fix(name, parent, rest)
        self.add_parts(body, name, pin.SE3.Identity(), childclass)

    def _fix(self, name: str, parent: str, T: pin.SE3) -> None:
        self.joints.append(placed(Joint(f"{name} (fixed)", "fixed", parent, name), T))
        self.links.append(name)

    def _joint(
        self, element: Element, parent: str, T: pin.SE3, place: pin.SE3, childclass: str
    ) -> tuple[Joint, pin.SE3]:
        """Return a joint without its child, and the place of the body behind it.

        A body at T turns about an axis through `pos`, by q less the `ref` at which it is drawn:
        T · Trans(pos) · Rot(axis, q − ref) · Trans(pos)⁻¹.
        """
        meaning, attributes = self.meaning, self.meaning.attributes(element, childclass)
        kind = "free" if element.tag == "freejoint" else attributes.get("type", "hinge")
        if kind not in KINDS:
            raise meaning.error(element, f"is of the type {kind!r}; joints that turn, slide or float can be read")
        name = element.get("name") or free_name(f"joint_{len(self.joints)}", {joint.name for joint in self.joints})
        if name in {joint.name for joint in self.joints}:
            raise meaning.error(element, "is there twice; names of joints must differ")
        joint = Joint(name, KINDS[kind], parent, "")
        if kind == "free":
            return placed(joint, T), pin.SE3.Identity()
        axis = place.rotation @ meaning.axis(element, attributes)
        ref = float(meaning.numbers(element, attributes, "ref", 1, "0")[0])
        if kind == "slide":
            before, after = pin.SE3(np.eye(3), -ref * axis), pin.SE3.Identity()
        else:
            anchor = pin.SE3(np.eye(3), place.act(meaning.numbers(element, attributes, "pos", 3, "0 0 0")))
            before = anchor * pin.SE3(pin.exp3(-meaning.angle(ref) * axis), np.zeros(3))
            after = anchor.inverse()
        x, y, z = map(float, axis)
        limits = self._limits(element, attributes, turns=kind == "hinge")
        return placed(replace(joint, axis=(x, y, z), **limits), T * before), after

    def _limits(self, element: Element, attributes: dict[str, str], *, turns: bool) -> dict[str, Any]:
        """Return the limits of a joint, and what brakes it."""
        meaning, limits = self.meaning, {}
        limited = attributes.get("limited", "auto")
        if limited == "true" or (limited == "auto" and meaning.autolimits and "range" in attributes):
            lower, upper = map(float, meaning.numbers(element, attributes, "range", 2))
            if lower > upper:
                raise meaning.error(element, f"must have lower ≤ upper; they are {lower:g} and {upper:g}")
            limits = {"lower": lower, "upper": upper}
            if turns:
                limits = {key: meaning.angle(value) for key, value in limits.items()}
        if "actuatorfrcrange" in attributes and attributes.get("actuatorfrclimited") != "false":
            limits["max_effort"] = max(0.0, float(meaning.numbers(element, attributes, "actuatorfrcrange", 2)[1]))
        for key, own in (("friction", "frictionloss"), ("damping", "damping")):
            if own in attributes:
                limits[key] = float(meaning.numbers(element, attributes, own, 1)[0])
        return limits
