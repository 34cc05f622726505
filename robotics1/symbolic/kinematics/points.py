"""A point that is fixed to a link, as one more frame of the robot."""

import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np
import pinocchio as pin
import sympy

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array
from robotics1.orientation.expressions import expressions
from robotics1.robot.model import Robot

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

    def variant(values: Mapping[str, float]) -> Robot:
        unknown = [key for key in values if key not in home]
        if unknown:
            raise UnknownNameError(f"parameter of robot {robot.name!r} named", unknown[0], home)
        at = {**home, **values}
        own = robot if robot.variant is None else robot.variant({key: at[key] for key in robot.parameters})
        p = np.array([float(x.xreplace({sympy.Symbol(key, real=True): at[key] for key in names})) for x in coordinates])
        return replace(_with_frame(own, link, name, p), parameters=MappingProxyType(at), variant=variant)

    found = variant({})
    return (found if home else replace(found, variant=None)), name


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
