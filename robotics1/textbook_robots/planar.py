"""An arm in a plane, by the order of its joints and the lengths of its links."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from robotics1.dh.entries import Limits, joint_limits, number_or_name, value_of
from robotics1.dh.joints import named_placement
from robotics1.errors import InputError
from robotics1.inputs import by_name, true_or_false
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.findings import LARGEST
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Placements, constant_placements, with_values
from robotics1.textbook_robots.joint_formulas import joint_letters

Entry = float | str
UP = (0.0, 0.0, 1.0)


def planar_arm(
    joints: str,
    lengths: Sequence[Entry],
    *,
    parameters: Mapping[str, float] | None = None,
    absolute: bool = False,
    lower: Limits = None,
    upper: Limits = None,
) -> Robot:
    """Return the arm in the plane z = 0 with joints R and P in this order, from the origin: "PRR", "RP", "RRR", ...

    Each revolute joint turns about z and carries a link of the next length, along its x axis. A prismatic joint slides
    along the link before it, at first along the world's x; one right after another slides across it, as in a gantry.
    The joints are q1, q2, ...; the tool is at the end of the last link or slide. So

        planar_arm("PRR", ["l2", "l3"]):  x = q1 + l2 cos q2 + l3 cos(q2 + q3),  y = l2 sin q2 + l3 sin(q2 + q3)
        planar_arm("RP", [0]):            x = q2 cos q1,  y = q2 sin q1

    Args:
        joints: a letter "R" or "P" for each joint.
        lengths: one for each R [m]: a number, or a name such as "l1", which formulas keep.
        parameters: the values of the names, which the robot keeps as `robot.parameters`; 1 m where there is none.
        absolute: each angle is measured from the world's x axis; otherwise from the link before.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: a letter, length or limit is wrong.
        UnknownNameError: a parameter is not among the lengths.
    """
    turns = joint_letters(joints).count("R")
    if isinstance(lengths, str) or not isinstance(lengths, Sequence | np.ndarray) or len(lengths) != turns:
        raise InputError(f"lengths must hold one for each R of {joints!r}, {turns} in all; it is {lengths!r}")
    links = tuple(number_or_name(f"length {i}", length) for i, length in enumerate(lengths, 1))
    given = by_name("parameters", parameters, "{'l1': 0.5}")
    ones = {link.removeprefix("-"): 1.0 for link in links if isinstance(link, str)}
    known = with_values("the planar arm", ones, given)
    if any(abs(value_of(link, known)) > LARGEST for link in links):
        raise InputError(f"lengths must be at most {LARGEST:g}; they are {[value_of(link, known) for link in links]}")
    low, high = joint_limits(lower, upper, [letter == "R" for letter in joints])
    limits = tuple(zip(low.tolist(), high.tolist(), strict=True))
    return PlanarArm(joints, links, true_or_false("absolute", absolute), limits, known).robot()


@dataclass(frozen=True)
class PlanarArm:
    """What a planar arm is made from; `planar_arm` has checked it.

    Attributes:
        letters: of the joints.
        links: the length of the link after each R.
        absolute: whether angles are measured from the world's x axis.
        limits: (lower, upper) of each joint.
        parameters: the values of the names.
    """

    letters: str
    links: tuple[Entry, ...]
    absolute: bool
    limits: tuple[tuple[float, float], ...]
    parameters: Mapping[str, float]

    def robot(self) -> Robot:
        """Return the robot."""
        joints = [joint for joint, _ in self._joints()]
        return robot_of_joints("planar_arm", joints, parameters=self.parameters, source=self)

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with these values of its names; the others stay."""
        return replace(self, parameters=with_values("the planar arm", self.parameters, values)).robot()

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints, with the names in them."""
        joints = self._joints()
        named = {joint.name: named_placement((x, 0.0, 0.0), (0.0, 0.0, 0.0)) for joint, x in joints}
        return {**constant_placements([joint for joint, _ in joints]), **named}

    def _joints(self) -> list[tuple[Joint, Entry]]:
        """Return the joints, each with the x of its placement, as a number or a name.

        With absolute angles, a joint that follows the revolute one before turns back by that one's angle first.
        """
        found: list[tuple[Joint, Entry]] = []
        x: Entry = 0.0  # from the last joint to the next one
        at, turned, across = "base", "", False
        links = iter(self.links)

        def add(joint: Joint) -> None:
            nonlocal at, x
            length = value_of(x, self.parameters)
            found.append((replace(joint, xyz=(length, 0.0, 0.0), parent=at), x))
            at, x = joint.child, 0.0

        for i, (letter, (low, high)) in enumerate(zip(self.letters, self.limits, strict=True), 1):
            name, child = f"q{i}", f"link{i}"
            if letter == "P":
                axis = (0.0, 1.0, 0.0) if across else (1.0, 0.0, 0.0)
                add(Joint(name, "prismatic", at, child, axis=axis, lower=low, upper=high))
                across = not across
                continue
            if self.absolute and turned:
                add(Joint(f"back{i}", "revolute", at, f"turn{i}", axis=UP, leader=turned, multiplier=-1.0))
            add(Joint(name, "revolute", at, child, axis=UP, lower=low, upper=high))
            x, turned, across = next(links), name, False
        add(Joint("tip", "fixed", at, "tool"))
        return found
