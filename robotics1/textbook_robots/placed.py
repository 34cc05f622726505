"""Any robot with its base placed in the world, and a tool on its tool."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any
from xml.sax.saxutils import quoteattr

import pinocchio as pin

from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.joints import Joint, placed, root_of
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Placements, constant_placements
from robotics1.robot.placements import homogeneous


def place_robot(robot: RobotLike, *, base_placement: Any = None, tool_placement: Any = None) -> Robot:
    """Return the robot on another base and with another tool: T_world_tool = T_base T(q) T_tool.

    Joints, limits and named parameters stay. Its root link is fixed to a new one, `world`, and a new link `tool` is
    fixed to the tool (`world_`, `tool_`, ... where these names are taken).

    Args:
        robot: any robot.
        base_placement: T_base, a `pin.SE3` or (4, 4): the robot's root in the world; by default the identity.
        tool_placement: T_tool, likewise: the new tool in the robot's tool.

    Raises:
        InputError: a placement is none, or the robot has several tips and no tool.
    """
    robot = robot_from(robot)
    base, tool = homogeneous("base_placement", base_placement), homogeneous("tool_placement", tool_placement)
    return PlacedRobot(
        robot, base if base_placement is not None else None, tool if tool_placement is not None else None
    ).robot_at()


@dataclass(frozen=True, eq=False)
class PlacedRobot:
    """What a placed robot is made from.

    Attributes:
        robot: as it was.
        base, tool: where its root, and the new tool, are placed; None where they stay.
    """

    robot: Robot
    base: pin.SE3 | None
    tool: pin.SE3 | None

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with these values of its names; the others stay."""
        return replace(self, robot=self.robot.with_parameters(values)).robot_at()

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints as polynomials in the names."""
        own = self.robot.placements
        return {**constant_placements([joint for joint in robot.joints if joint.name not in own]), **own}

    def robot_at(self) -> Robot:
        """Return the robot."""
        found = self.robot
        if self.base is not None:
            found = _on_base(found, self.base)
        if self.tool is not None:
            found = _with_tool(found, self.tool)
        return replace(found, source=self if found.parameters else None)


def _on_base(robot: Robot, T: pin.SE3) -> Robot:
    root = root_of(robot.frame_names, robot.joints)
    name = _free(robot, "world")
    joint = placed(Joint(f"{name}_joint", "fixed", name, root, leader=f"{name}_joint"), T)
    model = pin.Model(robot.own_model)
    for number in range(1, model.njoints):
        if model.parents[number] == 0:
            model.jointPlacements[number] = joint.placement * model.jointPlacements[number]
    for frame in model.frames:
        if frame.parentJoint == 0 and frame.name != "universe":
            frame.placement = joint.placement * frame.placement
    model.addFrame(pin.Frame(name, 0, 0, pin.SE3.Identity(), pin.FrameType.BODY))
    return _written(replace(robot, own_model=model, joints=(joint, *robot.joints)), joint, name)


def _with_tool(robot: Robot, T: pin.SE3) -> Robot:
    link, name = robot.link_of(None), _free(robot, "tool")
    joint = placed(Joint(f"{name}_joint", "fixed", link, name, leader=f"{name}_joint"), T)
    model = pin.Model(robot.own_model)
    number = robot.frame_id(link)
    parent = model.frames[number]
    model.addFrame(pin.Frame(name, parent.parentJoint, number, parent.placement * joint.placement, pin.FrameType.BODY))
    return _written(replace(robot, own_model=model, joints=(*robot.joints, joint), tool=name), joint, name)


def _free(robot: Robot, name: str) -> str:
    while robot.own_model.existFrame(name) or robot.own_model.existFrame(f"{name}_joint"):
        name += "_"
    return name


def _written(robot: Robot, joint: Joint, link: str) -> Robot:
    """Return the robot with the new link and joint in its text."""
    xyz, rpy = (" ".join(repr(x + 0.0) for x in triple) for triple in (joint.xyz, joint.rpy))
    before, end, after = robot.urdf.rpartition("</robot>")
    element = (
        f'  <link name="{link}"/>\n  <joint name="{joint.name}" type="fixed">\n    <origin xyz="{xyz}" rpy="{rpy}"/>\n'
        f"    <parent link={quoteattr(joint.parent)}/>\n    <child link={quoteattr(joint.child)}/>\n  </joint>\n"
    )
    return replace(robot, urdf=before + element + end + after)
