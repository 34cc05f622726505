"""From a file to a `Robot`: the text is read once, and Pinocchio makes the model of it."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, RobotFileError, UnknownNameError
from robotics1.robot.expansion import XACRO, expand_xacro, not_well_formed
from robotics1.robot.model import Robot, tips
from robotics1.robot.sources import robot_file


def load_robot(source: str | Path, *, parameters: Mapping[str, float] | None = None, tool: str | None = None) -> Robot:
    """Load a robot from a URDF or xacro file, or one of the named robots.

    A source with a suffix or a separator is a path; any other is a name: "prr", "cylindrical", "planar_2r".
    A `continuous` joint becomes a revolute joint without limits, so that q has one number a joint.

    Args:
        source: a path or a name.
        parameters: values for the named lengths of a xacro file, such as {"l2": 0.5} [m].
        tool: the link meant when no frame is named; without it the only tip, else the one called
            `tool0` or `tool`, else none.

    Raises:
        RobotFileError: the file is missing, or is no robot.
        UnknownNameError: no robot, parameter or tool of that name.
        InputError: a parameter is not a finite number, or the file has no parameters.
    """
    path = robot_file(source)
    text, values = _read(path, parameters or {})
    text, unlimited = _continuous_as_revolute(text, path)
    try:
        model = pin.buildModelFromXML(text)
    except Exception as error:
        raise RobotFileError(f"Pinocchio cannot read it: {error}", path=path) from error
    for joint in unlimited:
        index = model.joints[model.getJointId(joint)].idx_q
        model.lowerPositionLimit[index], model.upperPositionLimit[index] = -np.inf, np.inf
    return Robot(model.name, model, _tool(model, tool), MappingProxyType(values), text, path)


def _read(path: Path, parameters: Mapping[str, float]) -> tuple[str, dict[str, float]]:
    """Return the URDF text and the values of its parameters."""
    text = path.read_text(encoding="utf-8", errors="replace")
    if path.suffix == ".xacro" or XACRO.strip("{}") in text:
        return expand_xacro(path, parameters)
    if parameters:
        raise InputError(f"{path.name} is a plain URDF and has no parameters; {', '.join(parameters)} cannot be set")
    return text, {}


def _continuous_as_revolute(text: str, path: Path) -> tuple[str, list[str]]:
    """Return the text with `continuous` joints as revolute ones, and their names.

    Pinocchio gives a continuous joint two numbers, (cos q, sin q). urdfdom refuses infinite limits, so the
    text gets (−π, π) and the model's limits are opened afterwards.
    """
    try:
        root = ET.fromstring(text.encode())
    except ET.ParseError as error:
        raise not_well_formed(path, error) from error
    names = []
    for joint in root.iter("joint"):
        if joint.get("type") == "continuous":
            joint.set("type", "revolute")
            limit = joint.find("limit")
            if limit is None:
                limit = ET.SubElement(joint, "limit", effort="inf", velocity="inf")
                limit.set("effort", "1e308")
                limit.set("velocity", "1e308")
            limit.set("lower", repr(-math.pi))
            limit.set("upper", repr(math.pi))
            names.append(joint.get("name", ""))
    return (ET.tostring(root, encoding="unicode"), names) if names else (text, names)


def _tool(model: pin.Model, named: str | None) -> str | None:
    """Return the tool frame: the named one, the only tip, or the tip with a usual name."""
    if named is not None:
        if not model.existFrame(named):
            links = [frame.name for frame in model.frames if frame.type == pin.FrameType.BODY]
            raise UnknownNameError(f"frame of robot {model.name!r} named", named, links)
        return named
    candidates = tips(model)
    if len(candidates) == 1:
        return candidates[0]
    return next((name for name in ("tool0", "tool") if name in candidates), None)
