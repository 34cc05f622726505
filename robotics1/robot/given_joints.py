"""A robot made of joints that are given, not read from a file."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import pinocchio as pin

from robotics1.robot.building import build_model
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot, RobotSource
from robotics1.robot.parameters import Parameters
from robotics1.robot.urdf import Link, urdf_text


def robot_of_joints(
    name: str,
    joints: Sequence[Joint],
    *,
    parameters: Mapping[str, float] | None = None,
    source: RobotSource | None = None,
) -> Robot:
    """Return the robot of a chain of joints, the last of which carries the link `tool`; its links have no shapes."""
    links = [joints[0].parent, *(joint.child for joint in joints)]
    model = build_model(name, dict.fromkeys(links, pin.Inertia.Zero()), joints)
    text = urdf_text(name, {link: Link(pin.Inertia.Zero()) for link in links}, joints)
    known = Parameters(parameters)
    return Robot(name, model, tuple(joints), "tool", known, text, Path(f"{name}.urdf"), (), source)
