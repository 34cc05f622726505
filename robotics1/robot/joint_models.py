"""Pinocchio's model of one joint, and of one that follows another."""

from collections.abc import Sequence

import numpy as np
import pinocchio as pin

from robotics1.robot.joints import Joint

UNIT_AXES = np.eye(3)
ITSELF = " (itself)"  # behind the name of a leader that comes after its follower
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
