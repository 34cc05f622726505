"""A robot made of a model of Pinocchio, and of its shapes."""

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.checking import MOST_DEGREES, MOST_LINKS
from robotics1.robot.findings import LARGEST
from robotics1.robot.joints import Joint, Triple, placed
from robotics1.robot.model import Robot
from robotics1.robot.placements import ROTATION_TOLERANCE
from robotics1.robot.urdf import PLAIN, Link, element, numbers_text

KINDS = {"R": "revolute", "P": "prismatic"}
FREE = {"JointModelPlanar": "planar", "JointModelFreeFlyer": "floating"}
AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
WORLD = "universe"
SAME_PLACE = 1e-12  # of a link and its joint
NO_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")  # characters that no URDF can hold
STEP = 0.5  # of a follower, by which its axis is found [rad or m]


def robot_of_model(model: pin.Model, shapes: pin.GeometryModel | None = None, tool: str | None = None) -> Robot:
    """Return the robot of a `pin.Model`, with the shapes of a `pin.GeometryModel`.

    Its joints and frames keep their names, and inertias are left out. A joint without limits, which Pinocchio may
    count by (cos, sin), has one angle here, so that q is shorter than the model's.

    Args:
        model: joints that turn, slide, move in a plane or float.
        shapes: boxes, balls, cylinders and meshes.
        tool: the frame that is the tool; by default the only tip, else `tool0` or `tool`.

    Raises:
        InputError: the model has a joint of another kind, or two links of one name.
    """
    _check_model(model)
    if not isinstance(shapes, pin.GeometryModel | None):
        raise InputError(f"the shapes of a pin.Model are a pin.GeometryModel, not {type(shapes).__name__}")
    links, joints = _tree(model)
    if len(set(links)) < len(links):
        raise InputError("two frames of the model have one name, so that neither can be asked about")
    name = model.name or "robot"
    return robot_of_joints(name, joints, dict.fromkeys(links, PLAIN) | _with_shapes(links, shapes), tool=tool)


def _tree(model: pin.Model) -> tuple[list[str], tuple[Joint, ...]]:
    """Return the links of a model, and the joints between them: one carries a link, other frames are fixed to that."""
    carried = [_own_link(model, number) for number in range(model.njoints)]
    joints = [_joint(model, number, carried) for number in range(1, model.njoints)]
    fixed = []
    for frame in model.frames:
        parent = carried[frame.parentJoint]
        if frame.type in (pin.FrameType.BODY, pin.FrameType.OP_FRAME) and frame.name != parent:
            fixed.append(placed(Joint(f"{frame.name} (fixed)", "fixed", parent, frame.name), frame.placement))
    return [*carried, *(joint.child for joint in fixed)], (*joints, *fixed)


def _own_link(model: pin.Model, number: int) -> str:
    """Return the link that a joint carries, which has its place; the root's is that of the world."""
    for frame in model.frames:
        own = frame.type == pin.FrameType.BODY and frame.parentJoint == number
        if own and frame.placement.isIdentity(SAME_PLACE):
            return str(frame.name)
    return "world" if number == 0 else f"{model.names[number]}_link"


def _joint(model: pin.Model, number: int, carried: Sequence[str]) -> Joint:
    """Return a joint of a model, in its numbers.

    Raises:
        InputError: it is none that turns, slides, moves in a plane or floats.
    """
    name, model_joint = str(model.names[number]), model.joints[number]
    if model_joint.shortname() == "JointModelMimic":
        return _follower(model, number, carried)
    kind, axis = _motion(name, model_joint)
    q, v = model_joint.idx_q, model_joint.idx_v
    limits: dict[str, float] = {}
    if kind in ("revolute", "prismatic"):
        limits = {"max_velocity": float(model.upperVelocityLimit[v]), "max_effort": float(model.upperEffortLimit[v])}
        if model_joint.nq == 1:
            limits |= {"lower": float(model.lowerPositionLimit[q]), "upper": float(model.upperPositionLimit[q])}
        for key, value in limits.items():  # one beyond all that can be computed with stands for none
            limits[key] = float(np.copysign(np.inf, value)) if abs(value) > LARGEST else value
        _check_limits(
            name, limits.get("lower", 0), limits.get("upper", 0), limits["max_velocity"], limits["max_effort"]
        )
    parent = carried[model.parents[number]]
    joint = replace(Joint(name, kind, parent, carried[number], axis=axis), **limits)  # type: ignore[arg-type]
    return placed(joint, model.jointPlacements[number])


def _follower(model: pin.Model, number: int, carried: Sequence[str]) -> Joint:
    """Return a joint that mimics another one.

    Pinocchio does not tell its axis: it is that of the motion, while the leader moves. With the factor 0 it is fixed.
    """
    name, mimic = str(model.names[number]), model.joints[number].extract()
    leader = next(i for i, joint in enumerate(model.joints) if joint.nq > 0 and joint.idx_q == mimic.idx_q)
    data, leaders = model.createData(), np.arange(model.nq) == mimic.idx_q
    poses = []
    for moved in (0.0, STEP / max(abs(mimic.scaling), 1e-300)):
        pin.forwardKinematics(model, data, moved * leaders)
        poses.append(model.jointPlacements[number].actInv(data.liMi[number]))
    motion = pin.log6(poses[1] * poses[0].inverse())
    turns = float(np.linalg.norm(motion.angular)) > STEP / 2
    kind = KINDS["R" if turns else "P"] if mimic.scaling != 0 else "fixed"
    joint = Joint(name, kind, carried[model.parents[number]], carried[number])
    if kind == "fixed":
        return placed(joint, model.jointPlacements[number] * poses[0])
    axis = np.sign(mimic.scaling) * (motion.angular if turns else motion.linear)
    x, y, z = map(float, axis / np.linalg.norm(axis))
    a, b, leads = float(mimic.scaling), float(mimic.offset), str(model.names[leader])
    return placed(replace(joint, axis=(x, y, z), leader=leads, multiplier=a, offset=b), model.jointPlacements[number])


def _motion(name: str, joint: Any) -> tuple[str, Triple]:
    """Return how a joint moves, and about or along which axis."""
    kind = str(joint.shortname())
    if kind in FREE:
        return FREE[kind], AXES["X"]
    letters = kind.removeprefix("JointModel")
    for motion, word in (("R", "Revolute"), ("P", "Prismatic")):
        if letters in (f"{motion}X", f"{motion}Y", f"{motion}Z", f"{motion}UBX", f"{motion}UBY", f"{motion}UBZ"):
            return KINDS[motion], AXES[letters[-1]]
        if letters in (f"{word}Unaligned", f"{word}UnboundedUnaligned"):
            axis = np.array(joint.extract().axis)
            if not abs(np.linalg.norm(axis) - 1) < 1e-6:
                raise InputError(f"joint {name!r} of the model has the axis {axis.tolist()}, which is no unit vector")
            x, y, z = map(float, axis)
            return KINDS[motion], (x, y, z)
    raise InputError(f"joint {name!r} of the model is a {kind}; joints that turn, slide or float can be read")


def _with_shapes(links: Sequence[str], shapes: pin.GeometryModel | None) -> dict[str, Link]:
    """Return the links that have shapes; each shape hangs on the link that its joint carries."""
    drawn: dict[str, list[Element]] = {}
    for shape in [] if shapes is None else shapes.geometryObjects:
        form = _form(shape)
        if form is not None:
            T = shape.placement
            xyz, rpy = map(numbers_text, (T.translation, pin.rpy.matrixToRpy(np.array(T.rotation))))
            visual = element("visual", element("origin", xyz=xyz, rpy=rpy), element("geometry", form))
            drawn.setdefault(links[shape.parentJoint], []).append(visual)
    return {link: Link(pin.Inertia.Zero(), tuple(parts)) for link, parts in drawn.items()}


def _form(shape: Any) -> Element | None:
    """Return a box, a ball, a cylinder or a mesh as a URDF has it; None of another form."""
    form, path = shape.geometry, str(shape.meshPath)
    match type(form).__name__:
        case "Box":
            return element("box", size=numbers_text(2 * np.array(form.halfSide)))
        case "Sphere":
            return element("sphere", radius=repr(float(form.radius)))
        case "Cylinder":
            return element("cylinder", radius=repr(float(form.radius)), length=repr(2 * float(form.halfLength)))
    if path and Path(path).suffix:
        return element("mesh", filename=path, scale=numbers_text(np.ravel(shape.meshScale)))
    return None


# --- the numbers of a model: Pinocchio takes any, and nothing has read them before


def _check_model(model: pin.Model) -> None:
    """Check size, names and placements of a model.

    Raises:
        InputError: there is no joint, or more than can be computed with; a name is empty, or none that a file can
            hold; a placement is not finite, is too large, or has no rotation.
    """
    if not model.njoints > 1:
        raise InputError("the model has no joints")
    if model.nv > MOST_DEGREES or model.njoints > MOST_LINKS:
        most = f"at most {MOST_DEGREES} and {MOST_LINKS} can be computed with"
        raise InputError(f"the model has {model.nv} degrees of freedom and {model.njoints} joints; {most}")
    placements = [(f"joint {name!r}", T) for name, T in zip(model.names, model.jointPlacements, strict=True)]
    for what, T in [*placements, *((f"frame {frame.name!r}", frame.placement) for frame in model.frames)]:
        _check_placement(what, T)
    for name in (*model.names, *(frame.name for frame in model.frames)):
        if not name.strip() or NO_XML.search(name):
            raise InputError(f"a joint or a frame of the model is called {name!r}, which can be no name in a file")


def _check_limits(name: str, lower: float, upper: float, velocity: float, effort: float) -> None:
    """Check the limits of a joint.

    Raises:
        InputError: lower is above upper, or one of the others is negative; or one is no number.
    """
    if not lower <= upper:
        numbers = f"they are {lower:g} and {upper:g}"
        raise InputError(f"the limits of joint {name!r} of the model must have lower ≤ upper; {numbers}")
    if not (velocity >= 0 and effort >= 0):
        numbers = f"they are {velocity:g} and {effort:g}"
        raise InputError(f"velocity and effort of joint {name!r} of the model must have limits ≥ 0; {numbers}")


def _check_placement(what: str, T: pin.SE3) -> None:
    numbers, R = np.array(T.homogeneous), np.array(T.rotation)
    if not np.abs(numbers).max() <= LARGEST:
        place = f"is placed at {numbers[:3, 3].tolist()}"
        raise InputError(f"{what} of the model {place}; at most {LARGEST:g} can be computed with")
    if np.abs(R.T @ R - np.eye(3)).max() > ROTATION_TOLERANCE or np.linalg.det(R) < 0:
        raise InputError(f"the placement of {what} of the model has no rotation: its columns must be orthonormal")
