"""The steps of a DH table that a robot's own frames already are, so that a table comes back as it was written.

The frame F_i of joint i at q = 0 is that of a table where its z is the joint's axis, and a screw along its x leads to
the axis of the next joint. Frame 0 is then the link on which joint 1 hangs, and the last frame the link nearest the
tool to which a screw along x leads from F_n:

    S_i = Z_i X_i,  Z_i from frame i − 1 to F_i,  X_i from F_i to frame i
"""

from dataclasses import replace
from math import atan2, cos, hypot, sin

import numpy as np
import pinocchio as pin

from robotics1.angles import clean_angle
from robotics1.dh.common_normals import Axis, Step, clean_placement, first_step
from robotics1.dh.table import Z
from robotics1.robot.model import Robot

EXACT = 1e-12  # sine of an angle, and length in the size of the arm: what is left of a table by rounding


def own_steps(
    robot: Robot, data: pin.Data, joints: list[int], frame: int, convention: str
) -> tuple[pin.SE3, list[Step]] | None:
    """Return the base and the steps S_0 ... S_n, or None where the robot's frames are not those of a table.

    A table has |θ_i| ≤ π/2 before its last row: the same arm has another in which x_i is turned round.

    Args:
        robot: the robot.
        data: the placements of joints and frames at q = 0, with lengths in the size of the arm.
        joints: the joints from the world to the frame.
        frame: the tool.
        convention: "standard" or "modified".
    """
    model = robot.own_model
    axes = {joint.name: joint.axis for joint in robot.moving_joints}
    if any(np.abs(axes[model.names[joint]] - Z).max() > EXACT for joint in joints):
        return None
    F = [pin.SE3(data.oMi[joint]) for joint in joints]
    base, first = _start(model, data, joints[0], F[0], convention)
    T, steps = base * first.placement, [first]
    for here, following in zip(F, [*F[1:], None], strict=True):
        z = _along_z(T.actInv(here))
        x = _last(model, data, joints[-1], frame, here) if following is None else _to_axis(here.actInv(following))
        if x is None and following is None and convention == "modified":
            x = Step()  # a modified table ends with Z_n
        if z is None or x is None:
            return None
        if following is not None and abs(z.theta) > np.pi / 2:
            return None
        steps.append(Step(z.theta, z.d, x.alpha, x.a))
        T = T * steps[-1].placement
    steps[-1] = _without_half_turn(steps[-1], T.actInv(_placement(data, frame)), convention)
    return base, steps


def _without_half_turn(step: Step, left: pin.SE3, convention: str) -> Step:
    """Return the last step with the half turn about z or y in it that would be left for the tool placement.

    A half turn about z turns x round; one about y is one about z and one about x, which α takes in a standard table.
    """
    half = np.diag(left.rotation).round(12).tolist()
    if hypot(*left.translation) > EXACT or half not in ([-1, -1, 1], [-1, 1, -1]):
        return step
    turned = step.other_way
    if half[2] == 1:
        return turned
    return replace(turned, alpha=_angle(-sin(turned.alpha), -cos(turned.alpha))) if convention == "standard" else step


def _start(model: pin.Model, data: pin.Data, joint: int, F: pin.SE3, convention: str) -> tuple[pin.SE3, Step]:
    """Return the base and S_0: from the link on which joint 1 hangs, in a modified table from the link before it.

    A first axis that is parallel to the world's z needs only a base that is shifted in the plane.
    """
    mount = _links_above(model, int(model.getFrameId(model.names[joint], pin.FrameType.JOINT)))
    start = [_placement(data, link) for link in mount]
    if convention == "modified" and len(start) > 1:
        before = _along_x(start[1].actInv(start[0]))
        if before is not None and before != Step():
            return start[1], before
    base, step = first_step(Axis(np.array(F.translation), np.array(F.rotation[:, 2])))
    return (base, step) if hypot(*F.rotation[:2, 2]) <= EXACT else (start[0], Step())


def _along_z(T: pin.SE3) -> Step | None:
    """Return θ and d of T = Rot_z(θ) Trans_z(d), or None."""
    if hypot(*T.rotation[:2, 2]) > EXACT or T.rotation[2, 2] < 0 or hypot(*T.translation[:2]) > EXACT:
        return None
    return Step(theta=_angle(T.rotation[1, 0], T.rotation[0, 0]), d=_length(T.translation[2]))


def _along_x(T: pin.SE3) -> Step | None:
    """Return α and a of T = Rot_x(α) Trans_x(a), or None."""
    if hypot(*T.rotation[1:, 0]) > EXACT or T.rotation[0, 0] < 0 or hypot(*T.translation[1:]) > EXACT:
        return None
    return Step(alpha=_angle(T.rotation[2, 1], T.rotation[1, 1]), a=_length(T.translation[0]))


def _to_axis(T: pin.SE3) -> Step | None:
    """Return α and a of the screw along x that leads to the z axis of T, or None."""
    p, u = T.translation, T.rotation[:, 2]
    if abs(u[0]) > EXACT or abs(p[1] * u[2] - p[2] * u[1]) > EXACT:
        return None
    return Step(alpha=_angle(-u[1], u[2]), a=_length(p[0]))


def _last(model: pin.Model, data: pin.Data, joint: int, frame: int, here: pin.SE3) -> Step | None:
    """Return the screw from F_n to the link nearest the tool to which there is one, beyond the joint's own link."""
    for link in _links_above(model, frame, itself=True):
        if int(model.frames[link].parentJoint) == joint:
            x = _along_x(here.actInv(_placement(data, link)))
            own = model.frames[model.frames[link].parentFrame].type == pin.FrameType.JOINT
            if x is not None and not (own and link != frame):
                return x
    return None


def _links_above(model: pin.Model, frame: int, *, itself: bool = False) -> list[int]:
    """Return the links from a frame towards the world, as far as they are fixed to each other."""
    links = [frame] if itself else []
    while frame != model.frames[frame].parentFrame:
        frame = int(model.frames[frame].parentFrame)
        kind = model.frames[frame].type
        if kind == pin.FrameType.JOINT:
            break
        if kind == pin.FrameType.BODY:
            links.append(frame)
    return links


def _placement(data: pin.Data, link: int) -> pin.SE3:
    return clean_placement(data.oMf[link])


def _angle(sine: float, cosine: float) -> float:
    angle = clean_angle(atan2(sine, cosine)) + 0.0
    return -angle if angle == -np.pi else angle


def _length(value: float) -> float:
    return round(float(value), 14) + 0.0
