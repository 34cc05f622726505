"""Any robot with its base placed in the world, and a tool on its tool."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import pinocchio as pin

from robotics1.robot.assembly import free_link_name, with_root, with_tip
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
    base = None if base_placement is None else homogeneous("base_placement", base_placement)
    tool = None if tool_placement is None else homogeneous("tool_placement", tool_placement)
    return PlacedRobot(robot, base, tool).robot_at()


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
            name = free_link_name(found, "world")
            root = root_of(found.frame_names, found.joints)
            found = with_root(found, placed(Joint(f"{name}_joint", "fixed", name, root), self.base))
        if self.tool is not None:
            name = free_link_name(found, "tool")
            mount = placed(Joint(f"{name}_joint", "fixed", found.link_of(None), name), self.tool)
            found = replace(with_tip(found, mount), tool=name)
        return replace(found, source=self if found.parameters else None)
