"""A point that is fixed to a link, as one more frame of the robot."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pinocchio as pin
import sympy

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array, real_number
from robotics1.orientation.expressions import expressions
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Parameters

UNVALUED = 1.0  # the length that a name without a value stands for [m]


def link_of(robot: Robot, frame: str | None) -> str:
    """Return the link that a frame is: of a joint's frame, the link that the joint moves.

    Raises:
        UnknownNameError: there is no such frame.
    """
    found = robot.model.frames[robot.frame_id(frame)]
    if found.type == pin.FrameType.BODY:
        return str(found.name)
    joints = ET.fromstring(robot.urdf).iterfind(f"joint[@name='{found.name}']/child")
    return next((child.get("link", "") for child in joints), str(found.name))


def with_point(robot: Robot, frame: str | None, point: Any) -> tuple[Robot, str]:
    """Return the robot with a frame at a point of a link, and the name of that frame.

    The frame has the axes of the link. Names of coordinates that are no parameters of the robot become some.

    Args:
        robot: the robot.
        frame: the link, or None for the tool.
        point: (3,) coordinates in the link's axes [m]: numbers, names, or polynomials of names.

    Raises:
        InputError: the point is no such thing.
        UnknownNameError: there is no such frame.
    """
    link = link_of(robot, frame)
    coordinates = _coordinates(point)
    names = sorted({symbol.name for x in coordinates for symbol in x.free_symbols})
    home = {**dict.fromkeys(names, UNVALUED), **robot.parameters}
    name = "point"
    while robot.model.existFrame(name):
        name += "_"

    return RobotWithPoint(robot, link, name, tuple(coordinates), Parameters(home)).with_parameters({}), name


@dataclass(frozen=True)
class RobotWithPoint:
    """What a robot with a point on a link is made from.

    Attributes:
        robot: the robot without the point.
        link, name: the link, and the frame at the point.
        coordinates: (x, y, z) of the point in the link's axes [m], of real symbols.
        parameters: the values of the robot's parameters and of the symbols.
    """

    robot: Robot
    link: str
    name: str
    coordinates: tuple[sympy.Expr, ...]
    parameters: Mapping[str, float]

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with the point, at these values; the others stay.

        Raises:
            UnknownNameError: neither the robot nor the point has such a parameter.
            InputError: a value is not a finite number.
        """
        for key in values:
            if key not in self.parameters:
                raise UnknownNameError(f"parameter of robot {self.robot.name!r} named", key, self.parameters)
        new = {key: real_number(f"parameter {key!r}", value) for key, value in values.items()}
        at = Parameters({**self.parameters, **new})
        own = {key: value for key, value in new.items() if key in self.robot.parameters}
        robot = self.robot.with_parameters(own) if own else self.robot
        numbers = {sympy.Symbol(key, real=True): value for key, value in at.items()}
        p = np.array([float(x.xreplace(numbers)) for x in self.coordinates])
        found = _with_frame(robot, self.link, self.name, p)
        return replace(found, parameters=at, source=replace(self, robot=robot, parameters=at))


def _coordinates(point: Any) -> list[sympy.Expr]:
    """Return the coordinates as expressions of real symbols."""
    entries = [sympy.sympify(x) for x in expressions("point", point, (3,), "[m]")]
    symbols = {symbol for x in entries for symbol in x.free_symbols}
    for symbol in symbols:
        if re.fullmatch(r"q(dot)?\d+", symbol.name):
            raise InputError(
                f"point cannot depend on {symbol.name}: q1, q2, ... are the joints, and the point is fixed"
            )
    if not all(x.is_polynomial(*symbols) for x in entries):
        raise InputError(
            f"the coordinates of point must be numbers, names, or polynomials of names; they are {entries}"
        )
    real = {symbol: sympy.Symbol(symbol.name, real=True) for symbol in symbols}
    return [x.xreplace(real) for x in entries]


def _with_frame(robot: Robot, link: str, name: str, p: Array) -> Robot:
    """Return the robot with a link of this name, fixed to another one at p."""
    root = ET.fromstring(robot.urdf)
    ET.SubElement(root, "link", name=name)
    joint = ET.SubElement(root, "joint", name=f"{name}_joint", type="fixed")
    ET.SubElement(joint, "origin", xyz=" ".join(map(repr, p.tolist())), rpy="0 0 0")
    ET.SubElement(joint, "parent", link=link)
    ET.SubElement(joint, "child", link=name)
    model = pin.Model(robot.model)
    number = robot.frame_id(link)
    parent = model.frames[number]
    placement = parent.placement * pin.SE3(np.eye(3), p)
    model.addFrame(pin.Frame(name, parent.parentJoint, number, placement, pin.FrameType.BODY))
    return replace(robot, model=model, urdf=ET.tostring(root, encoding="unicode"))
