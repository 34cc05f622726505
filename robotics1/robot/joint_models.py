"""Pinocchio's model of one joint, and of one that follows another."""

from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from robotics1.robot.joints import Joint

UNIT_AXES = np.eye(3)
ALIGNED = {
    "revolute": (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ),
    "prismatic": (pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ),
}
UNALIGNED = {"revolute": pin.JointModelRevoluteUnaligned, "prismatic": pin.JointModelPrismaticUnaligned}
FREE = {"planar": pin.JointModelPlanar, "floating": pin.JointModelFreeFlyer}


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


def restore_followers(model: pin.Model, joints: Sequence[Joint]) -> None:
    """Give the followers of a model that was unpickled the motion that they have lost.

    Pinocchio does not pickle the joint inside a `JointModelMimic`: the first use of such a model ends the process.
    """
    named = {joint.name: joint for joint in joints}
    own = {joint.idx_q: i for i, joint in enumerate(model.joints) if joint.nq > 0}  # coordinate → the joint that has it
    for i, (name, joint) in enumerate(zip(model.names, model.joints, strict=True)):
        if joint.shortname() != "JointModelMimic":
            continue
        lost = joint.extract()
        moved = named.get(name) or named[name.split(" (itself)")[0]]
        follower = follower_model(model, moved, own[joint.idx_q], lost.scaling, lost.offset)
        follower.setIndexes(i, joint.idx_q, joint.idx_v, lost.idx_vExtended)
        model.joints[i] = pin.JointModel(follower)
