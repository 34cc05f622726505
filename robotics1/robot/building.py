"""From the joints of a robot to Pinocchio's model, joint by joint.

Pinocchio's own reader of URDF gives the same model, where it can read the file. It reports on the process's stderr,
which can be caught only by moving file descriptor 2 under every thread, and it takes no infinite limits.

The coordinates are in Pinocchio's order: depth first, and the joints below a link by their names. A joint can mimic
only an earlier one, so

    - below a link, the branch with the leader comes before the branch with the follower;
    - a leader that comes after a follower all the same, because it stands nearer the tip or because two branches
      follow each other, gets its coordinate at the start of q, by a joint that carries nothing, which it mimics itself.
"""

from collections.abc import Mapping, Sequence

import numpy as np
import pinocchio as pin

from robotics1.robot.joints import Joint, root_of
from robotics1.robot.mimic import late_leaders, leaders_first

UNIT_AXES = np.eye(3)
ITSELF = " (itself)"  # behind the name of a leader that comes after its follower
ALIGNED = {
    "revolute": (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ),
    "prismatic": (pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ),
}
UNALIGNED = {"revolute": pin.JointModelRevoluteUnaligned, "prismatic": pin.JointModelPrismaticUnaligned}
FREE = {"planar": pin.JointModelPlanar, "floating": pin.JointModelFreeFlyer}


def build_model(name: str, links: Mapping[str, pin.Inertia], joints: Sequence[Joint]) -> pin.Model:
    """Return the model of a tree of links: links are body frames, and a follower has no coordinate of its own.

    Args:
        name: the robot's name.
        links: link → its inertia about its own axes.
        joints: what connects them.
    """
    model = pin.Model()
    model.name = name
    order = leaders_first(tuple(links), joints)
    coordinate = {joint.name: _add_joint(model, 0, pin.SE3.Identity(), joint) for joint in late_leaders(order)}
    first = root_of(tuple(links), joints)
    at = {first: model.addFrame(pin.Frame(first, 0, 0, pin.SE3.Identity(), pin.FrameType.BODY, links[first]))}
    for joint in order:
        frame, body = at[joint.parent], links[joint.child]
        parent, T = int(model.frames[frame].parentJoint), model.frames[frame].placement * joint.placement
        if joint.kind == "fixed":
            fixed = model.addFrame(pin.Frame(joint.name, parent, frame, T, pin.FrameType.FIXED_JOINT, body))
            at[joint.child] = model.addBodyFrame(joint.child, parent, T, fixed)
            continue
        number = _add_moving(model, parent, T, joint, coordinate)
        model.frames[model.addJointFrame(number, frame)].name = joint.name
        if body != pin.Inertia.Zero():
            model.appendBodyToJoint(number, body, pin.SE3.Identity())
        at[joint.child] = model.addBodyFrame(joint.child, number, pin.SE3.Identity(), model.nframes - 1)
    return model


def _add_moving(model: pin.Model, parent: int, T: pin.SE3, joint: Joint, coordinate: dict[str, int]) -> int:
    """Add a joint with a coordinate of its own, or one that follows; `coordinate` is leader → the joint that has it."""
    if joint.follows:
        follower = follower_model(model, joint, coordinate[joint.leader], joint.multiplier, joint.offset)
        return int(model.addJoint(parent, follower, T, joint.name))
    if joint.name in coordinate:
        itself = joint.name + ITSELF
        while model.existJointName(itself):
            itself += "_"
        return int(model.addJoint(parent, follower_model(model, joint, coordinate[joint.name], 1.0, 0.0), T, itself))
    coordinate[joint.name] = _add_joint(model, parent, T, joint)
    return coordinate[joint.name]


def _add_joint(model: pin.Model, parent: int, T: pin.SE3, joint: Joint) -> int:
    """Add a joint with a coordinate of its own, its limits and its friction."""
    kind = joint_model(joint)
    none, free = np.zeros(kind.nv), np.full(kind.nv, np.inf)
    if kind.nq > 1:  # a length for each coordinate that moves, and a unit vector for what turns
        lengths = {3: 2, 6: 3}[kind.nv]
        upper = np.r_[np.full(lengths, np.inf), np.full(kind.nq - lengths, 1.01)]
        return int(
            model.addJoint(parent, kind, T, joint.name, -free, free, -free, free, -upper, upper, none, none, none)
        )
    effort, velocity, friction = joint.max_effort, joint.max_velocity, joint.friction
    ranges = (-effort, effort, -velocity, velocity, joint.lower, joint.upper, -friction, friction)
    return int(model.addJoint(parent, kind, T, joint.name, *(np.array([x]) for x in ranges), np.array([joint.damping])))


# --- one joint


def follower_model(model: pin.Model, joint: Joint, leader: int, a: float, b: float) -> pin.JointModelMimic:
    """Return a joint whose coordinate is a q + b, with q that of the leader."""
    own, kind = model.joints[leader], joint_model(joint)
    kind.setIndexes(leader, own.idx_q, own.idx_v, own.idx_vExtended)
    return pin.JointModelMimic(kind, a, b)


def joint_model(joint: Joint) -> pin.JointModel:
    """Return the motion of a joint, about or along its axis; a continuous one is revolute, with one coordinate."""
    if joint.kind in FREE:
        return pin.JointModel(FREE[joint.kind]())
    axis = np.array(joint.axis)
    for aligned, unit in zip(ALIGNED[joint.kind], UNIT_AXES, strict=True):
        if np.linalg.norm(axis - unit) <= 1e-12:
            return pin.JointModel(aligned())
    return pin.JointModel(UNALIGNED[joint.kind](axis / np.linalg.norm(axis)))


def joints_of(model: pin.Model, joints: Sequence[Joint]) -> tuple[Joint, ...]:
    """Return the joint that each of a model is, from its number 1 on.

    A leader that comes after its follower is there twice: first as the coordinate that carries nothing, then itself.
    """
    named = {joint.name: joint for joint in joints}
    return tuple(named.get(name) or named[name.split(ITSELF)[0]] for name in [*model.names][1:])


def restore_followers(model: pin.Model, joints: Sequence[Joint]) -> None:
    """Give the followers of a model that was unpickled the motion that they have lost.

    Pinocchio does not pickle the joint inside a `JointModelMimic`: the first use of such a model ends the process.
    """
    own = {joint.idx_q: i for i, joint in enumerate(model.joints) if joint.nq > 0}  # coordinate → the joint that has it
    for i, moved in enumerate(joints_of(model, joints), 1):
        joint = model.joints[i]
        if joint.shortname() != "JointModelMimic":
            continue
        lost = joint.extract()
        follower = follower_model(model, moved, own[joint.idx_q], lost.scaling, lost.offset)
        follower.setIndexes(i, joint.idx_q, joint.idx_v, lost.idx_vExtended)
        model.joints[i] = pin.JointModel(follower)
