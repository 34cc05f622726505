"""From a checked and cleaned URDF tree to Pinocchio's model, joint by joint.

Pinocchio's own reader of URDF gives the same model, where it can read the file. It reports on the process's stderr,
which can be caught only by moving file descriptor 2 under every thread, and it takes no infinite limits.

The coordinates are in Pinocchio's order: depth first, and the joints below a link by their names. A joint can mimic
only an earlier one, so

    - below a link, the branch with the leader comes before the branch with the follower;
    - a leader that comes after a follower all the same, because it stands nearer the tip or because two branches
      follow each other, gets its coordinate at the start of q, by a joint that carries nothing, which it mimics itself.
"""

import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.robot.checking import linked
from robotics1.robot.checking_parts import MOMENTS
from robotics1.robot.ordering import late_leaders, leaders_first, root_link
from robotics1.robot.rewriting import numbers, placement

UNIT_AXES = np.eye(3)
ALIGNED = {
    "revolute": (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ),
    "prismatic": (pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ),
}
UNALIGNED = {"revolute": pin.JointModelRevoluteUnaligned, "prismatic": pin.JointModelPrismaticUnaligned}
FREE = {"planar": pin.JointModelPlanar, "floating": pin.JointModelFreeFlyer}
WITHOUT_LIMIT = 1e308  # what stands for infinity in files, since urdfdom refuses that


def build_model(root: ET.Element) -> pin.Model:
    """Return the model of a URDF tree: links are body frames, and a follower has no coordinate of its own."""
    links = {link.get("name", ""): link for link in root.findall("link")}
    order = leaders_first(root)
    late = late_leaders(order)
    model = pin.Model()
    model.name = root.get("name", "")
    coordinate = {
        joint.get("name", ""): _add_joint(model, 0, _kind(joint), pin.SE3.Identity(), joint.get("name", ""), joint)
        for joint in late
    }
    first = root_link(root)
    at = {first: model.addFrame(pin.Frame(first, 0, 0, pin.SE3.Identity(), pin.FrameType.BODY, inertia(links[first])))}
    for joint in order:
        name, child = joint.get("name", ""), str(linked(joint, "child"))
        frame, body = at[str(linked(joint, "parent"))], inertia(links[child])
        parent, T = int(model.frames[frame].parentJoint), model.frames[frame].placement * placement(joint)
        if joint.get("type") == "fixed":
            fixed = model.addFrame(pin.Frame(name, parent, frame, T, pin.FrameType.FIXED_JOINT, body))
            at[child] = model.addBodyFrame(child, parent, T, fixed)
            continue
        number = _add_moving(model, parent, T, joint, coordinate)
        model.frames[model.addJointFrame(number, frame)].name = name
        if body != pin.Inertia.Zero():
            model.appendBodyToJoint(number, body, pin.SE3.Identity())
        at[child] = model.addBodyFrame(child, number, pin.SE3.Identity(), model.nframes - 1)
    return model


def inertia(link: ET.Element) -> pin.Inertia:
    """Return the inertia of a link about its own axes; zero where the file gives none."""
    inertial = link.find("inertial")
    if inertial is None:
        return pin.Inertia.Zero()
    mass, matrix = inertial.find("mass"), inertial.find("inertia")
    xx, xy, xz, yy, yz, zz = (numbers(matrix, moment)[0] for moment in MOMENTS)
    T = placement(inertial)
    Y = pin.Inertia.Zero()  # its constructor refuses impossible inertias, where the file's checks only warn
    Y.mass, Y.lever = numbers(mass, "value")[0], T.translation
    Y.inertia = T.rotation @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ T.rotation.T
    return Y


def _add_moving(model: pin.Model, parent: int, T: pin.SE3, joint: ET.Element, coordinate: dict[str, int]) -> int:
    """Add a joint with a coordinate of its own, or one that follows; `coordinate` is leader → the joint that has it."""
    name, mimic = joint.get("name", ""), joint.find("mimic")
    if mimic is not None:
        a, b = numbers(mimic, "multiplier", "1")[0], numbers(mimic, "offset", "0")[0]
        follower = _following(model, _kind(joint), coordinate[mimic.get("joint", "")], a, b)
        return int(model.addJoint(parent, follower, T, name))
    if name in coordinate:
        itself = f"{name} (itself)"
        while model.existJointName(itself):
            itself += "_"
        return int(model.addJoint(parent, _following(model, _kind(joint), coordinate[name], 1.0, 0.0), T, itself))
    coordinate[name] = _add_joint(model, parent, _kind(joint), T, name, joint)
    return coordinate[name]


def _following(model: pin.Model, kind: pin.JointModel, leader: int, a: float, b: float) -> pin.JointModelMimic:
    """Return a joint whose coordinate is a q + b, with q that of the leader."""
    own = model.joints[leader]
    kind.setIndexes(leader, own.idx_q, own.idx_v, own.idx_vExtended)
    return pin.JointModelMimic(kind, a, b)


def _kind(joint: ET.Element) -> pin.JointModel:
    """Return the motion of a joint, about or along its axis; a continuous one is revolute, with one coordinate."""
    kind = joint.get("type", "").replace("continuous", "revolute")
    if kind in FREE:
        return pin.JointModel(FREE[kind]())
    axis = np.array(numbers(joint.find("axis"), "xyz", "1 0 0"))
    for aligned, unit in zip(ALIGNED[kind], UNIT_AXES, strict=True):
        if np.linalg.norm(axis - unit) <= 1e-12:
            return pin.JointModel(aligned())
    return pin.JointModel(UNALIGNED[kind](axis / np.linalg.norm(axis)))


def _add_joint(model: pin.Model, parent: int, kind: pin.JointModel, T: pin.SE3, name: str, joint: ET.Element) -> int:
    """Add a joint with a coordinate of its own, its limits and its friction."""
    none, free = np.zeros(kind.nv), np.full(kind.nv, np.inf)
    if kind.nq > 1:  # a length for each coordinate that moves, and a unit vector for what turns
        lengths = {3: 2, 6: 3}[kind.nv]
        upper = np.r_[np.full(lengths, np.inf), np.full(kind.nq - lengths, 1.01)]
        return int(model.addJoint(parent, kind, T, name, -free, free, -free, free, -upper, upper, none, none, none))
    limit, dynamics = joint.find("limit"), joint.find("dynamics")
    effort, velocity = (_limit(limit, key, np.inf) for key in ("effort", "velocity"))
    lower, upper = (_limit(limit, key, 0.0) for key in ("lower", "upper"))
    if joint.get("type") == "continuous":
        lower, upper = -free, free
    friction, damping = (np.array(numbers(dynamics, key, "0")) for key in ("friction", "damping"))
    ranges = (-effort, effort, -velocity, velocity, lower, upper, -friction, friction)
    return int(model.addJoint(parent, kind, T, name, *ranges, damping))


def _limit(limit: ET.Element | None, key: str, default: float) -> Array:
    values = np.array(numbers(limit, key, repr(default)))
    return np.where(values >= WITHOUT_LIMIT, np.inf, values)
