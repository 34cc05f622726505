"""What there is to draw of a robot: the visuals of its links, as plain records."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import pinocchio as pin

from robotics1.errors import warn
from robotics1.results import Frozen
from robotics1.robot.checking_parts import SHAPES
from robotics1.robot.findings import LARGEST
from robotics1.robot.frames import frame_number
from robotics1.robot.joints import Triple
from robotics1.robot.meshes import UNDRAWN
from robotics1.robot.model import Robot

Color = tuple[float, float, float, float]


@dataclass(frozen=True)
class Box(Frozen):
    """A box about its centre, with the lengths of its sides along x, y and z [m]."""

    size: Triple


@dataclass(frozen=True)
class Cylinder(Frozen):
    """A cylinder about its centre, along z [m]."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule(Frozen):
    """A cylinder about its centre, along z, with a half ball at each end; `length` is that of the cylinder [m]."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere(Frozen):
    """A ball about its centre [m]."""

    radius: float


@dataclass(frozen=True)
class MeshFile(Frozen):
    """A mesh.

    Attributes:
        path: the place of the file; of one that was not found, the name that the robot's file gives it.
        scale: what multiplies its x, y and z; a negative one mirrors it.
        found: whether the file is there and may be read; `Robot.warnings` says why not.
    """

    path: str
    scale: Triple = (1.0, 1.0, 1.0)
    found: bool = True


Shape = Box | Cylinder | Capsule | Sphere | MeshFile
PLAIN: dict[str, Callable[..., Shape]] = {"box": Box, "cylinder": Cylinder, "capsule": Capsule, "sphere": Sphere}


@dataclass(frozen=True, eq=False)
class Visual(Frozen):
    """A shape to draw: T_world_shape(q) = T_world_joint(q) · placement.

    Attributes:
        link: the link that it belongs to.
        joint: the joint of `robot.model` with which it moves; 0 is the world.
        placement: T_joint_shape, a `pin.SE3`; fixed joints in between are in it.
        shape: what it looks like.
        color: red, green, blue and opacity from 0 to 1, or None where the robot's file gives none.
    """

    link: str
    joint: int
    placement: pin.SE3
    shape: Shape
    color: Color | None


def read_visuals(robot: Robot) -> tuple[Visual, ...]:
    """Return the visuals of a robot, in the order of its file.

    A mesh that was not found is among them. A visual without a shape, or with numbers that are not finite or beyond
    1e18, is left out, and a `RobotWarning` names its link.
    """
    return tuple(_visuals(robot))


def _visuals(robot: Robot) -> Iterator[Visual]:
    for link in ET.fromstring(robot.urdf).findall("link"):
        name = link.get("name", "")
        frame = robot.own_model.frames[frame_number(robot.own_model, name) or 0]
        for part in link:
            if part.tag not in ("visual", UNDRAWN):
                continue
            try:
                shape, T = _shape(part), _placement(part)
            except ValueError as error:
                warn(f"a visual of link {name!r} {error}, so it is not drawn")
                continue
            yield Visual(name, int(frame.parentJoint), frame.placement * T, shape, _color(part))


def _shape(visual: ET.Element) -> Shape:
    """Return the shape of a visual, or raise ValueError with what is wrong with it."""
    form = visual.find("geometry/*")
    if form is None:
        raise ValueError("has no shape")
    if form.tag == "mesh":
        scale = _numbers(form, "scale", 3) if form.get("scale") else (1.0, 1.0, 1.0)
        return MeshFile(form.get("filename", ""), scale, visual.tag != UNDRAWN)  # type: ignore[arg-type]
    if form.tag not in PLAIN:
        raise ValueError(f"has the unknown shape <{form.tag}>")
    sizes = [_numbers(form, name, count) for name, count in SHAPES[form.tag].items()]
    return PLAIN[form.tag](*(size if len(size) > 1 else size[0] for size in sizes))


def _placement(visual: ET.Element) -> pin.SE3:
    origin = visual.find("origin")
    xyz, rpy = (
        np.array(_numbers(origin, name, 3) if origin is not None and origin.get(name) else (0.0, 0.0, 0.0))
        for name in ("xyz", "rpy")
    )
    return pin.SE3(pin.rpy.rpyToMatrix(rpy), xyz)


def _color(visual: ET.Element) -> Color | None:
    """Return the colour, which the loader has written into the visual itself."""
    color = visual.find("material/color")
    if color is None:
        return None
    red, green, blue, opacity = _numbers(color, "rgba", 4)
    return red, green, blue, opacity


def _numbers(element: ET.Element, attribute: str, count: int) -> tuple[float, ...]:
    try:
        values = tuple(map(float, element.get(attribute, "").split()))
    except ValueError:
        values = ()
    if len(values) != count or not all(math.isfinite(value) and abs(value) <= LARGEST for value in values):
        raise ValueError(f"has a <{element.tag}> whose {attribute} is {element.get(attribute)!r}")
    return values
