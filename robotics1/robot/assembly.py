"""A robot of links and joints: Pinocchio's model, the text of its URDF, and its tool."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import pinocchio as pin

from robotics1.robot.building import build_model
from robotics1.robot.frames import tool_frame
from robotics1.robot.joints import Joint, free_name
from robotics1.robot.markup import parse_xml
from robotics1.robot.model import Robot, RobotSource
from robotics1.robot.parameters import Parameters
from robotics1.robot.urdf import PLAIN, Link, elements_text, read_joints, read_links, urdf_text


def robot_of_joints(
    name: str,
    joints: Sequence[Joint],
    links: Mapping[str, Link] | None = None,
    *,
    tool: str | None = None,
    written: Sequence[Joint] | None = None,
    parameters: Mapping[str, float] | None = None,
    path: Path | None = None,
    warnings: tuple[str, ...] = (),
    source: RobotSource | None = None,
) -> Robot:
    """Return the robot of a tree of links and joints.

    Args:
        name: its name.
        joints: what connects the links.
        links: name → link; by default those that a chain of joints connects, without inertia and shapes.
        tool: the frame that is the tool; by default the only tip, else `tool0` or `tool`.
        written: the joints as its text has them, where these have other limits.
        parameters: name → value of its named lengths.
        path: the file it came from.
        warnings: what is odd about the file.
        source: what it is made from.

    Raises:
        UnknownNameError: there is no frame of the tool's name.
    """
    if links is None:
        links = dict.fromkeys([joints[0].parent, *(joint.child for joint in joints)], PLAIN)
    model = build_model(name, {key: link.inertia for key, link in links.items()}, joints)
    text = urdf_text(name, links, joints if written is None else written)
    tool, file = tool_frame(model, joints, tool), path or Path(f"{name}.urdf")
    return Robot(name, model, tuple(joints), tool, Parameters(parameters), text, file, warnings, source)


def with_tip(robot: Robot, joint: Joint) -> Robot:
    """Return the robot with one more link, at the end of a fixed joint."""
    model = pin.Model(robot.own_model)
    number = robot.frame_id(joint.parent)
    parent = model.frames[number]
    placement = parent.placement * joint.placement
    model.addFrame(pin.Frame(joint.child, parent.parentJoint, number, placement, pin.FrameType.BODY))
    before, end, _ = robot.urdf.rpartition("</robot>")
    text = before + elements_text({joint.child: PLAIN}, [joint]) + end
    return replace(robot, own_model=model, joints=(*robot.joints, joint), urdf=text)


def with_root(robot: Robot, joint: Joint) -> Robot:
    """Return the robot whose root is a new link, at the beginning of a fixed joint."""
    root = parse_xml(robot.urdf, robot.path)
    links, written, joints = {joint.parent: PLAIN, **read_links(root)}, (joint, *read_joints(root)), robot.joints
    model = build_model(robot.name, {key: link.inertia for key, link in links.items()}, (joint, *joints))
    text = urdf_text(robot.name, links, written)
    return replace(robot, own_model=model, joints=(joint, *joints), urdf=text)


def free_link_name(robot: Robot, name: str) -> str:
    """Return a name for a new link that no frame has, nor with "_joint" behind it, as its joint is called."""
    return free_name(name, {frame.name.removesuffix("_joint") for frame in robot.own_model.frames})
