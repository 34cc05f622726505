"""The constants of a chain of joints, from the base to a frame, as arrays for the kernels."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.robot.model import Robot

Indices = npt.NDArray[np.int64]
PRISMATIC, COORDINATE, RATIO = 12, 13, 14  # the columns of `links` after the placement
LOWER, UPPER, CIRCULAR, UNIT = 0, 1, 2, 3  # of a coordinate: its limits, whether it makes whole turns, what counts as 1
STILL = 1e-300  # |S| of a joint that does not move: one that mimics with multiplier 0


class ChainArrays(NamedTuple):
    """T(q) = P₀ Z₀(q) P₁ Z₁(q) ... P_k, where Z turns about z or moves along z.

    The axes of all joints are turned to z, once and for all, by folding that turn into the fixed placements
    beside them: a kernel then needs no axis, and a turn mixes just two columns.

    Attributes:
        placements: (k+1, 3, 4), the fixed placements [R p] before each joint, and from the last one to the frame [m].
        prismatic: (k,) 1 for a joint that moves along z, 0 for one that turns about it.
        coordinate: (k,) which entry of q moves it.
        ratio: (k,) its motion per unit of that entry: 1, or the multiplier of a mimicking joint.

    With lengths in another unit than metres, so are the entries of q that are lengths.
    """

    placements: Array
    prismatic: Indices
    coordinate: Indices
    ratio: Array

    def links(self) -> Array:
        """Return all of it as one array, (k+1, 15), for kernels that are called often: an array costs when it passes.

        Row i holds the placement before joint i, row by row (12), and of that joint in the columns PRISMATIC,
        COORDINATE and RATIO what the attributes say; the last row is of the frame.
        """
        joints = np.column_stack([self.prismatic, self.coordinate, self.ratio])
        return np.column_stack([self.placements.reshape(-1, 12), np.vstack([joints, np.zeros(3)])])


def chain_arrays(
    robot: Robot, frame: str | None = None, *, unit: float = 1.0, axes: Array | None = None
) -> ChainArrays:
    """Return the constants of the chain that carries a frame, read from Pinocchio's model.

    Args:
        robot: an arm of joints with one degree of freedom.
        frame: the frame's name; by default the tool.
        unit: the length that counts as one [m].
        axes: R_world_axes (3, 3): the axes that positions and velocities are written in; by default the world's.

    Raises:
        UnknownNameError: there is no such frame.
        InputError: a joint has several degrees of freedom, or the tool is open.
    """
    robot.require_single_coordinates("have kernels")
    model, fixed = robot.own_model, robot.own_model.frames[robot.frame_id(frame)]
    units = np.where(robot.revolute, 1.0, unit)
    before = pin.SE3.Identity() if axes is None else pin.SE3(np.array(axes).T, np.zeros(3))
    zero = np.zeros(robot.nq)
    placements, joints = [], []
    for number in list(model.supports[fixed.parentJoint])[1:]:  # the first is the world
        joint = model.joints[number]
        motion = joint.createData()
        joint.calc(motion, zero)
        before = before * model.jointPlacements[number] * pin.SE3(motion.M)  # M(0) is not 1 where <mimic> has an offset
        speed = np.asarray(motion.S).ravel()
        ratio = float(np.linalg.norm(speed))
        if ratio < STILL:
            continue
        prismatic = bool(np.any(speed[:3]))
        turn = pin.SE3(_z_to((speed[:3] if prismatic else speed[3:]) / ratio), np.zeros(3))
        placements.append(before * turn)
        joints.append((prismatic, joint.idx_q, ratio * units[joint.idx_q] / (unit if prismatic else 1.0)))
        before = turn.inverse()
    placements.append(before * fixed.placement)
    return ChainArrays(
        np.array([np.column_stack([T.rotation, T.translation / unit]) for T in placements]),
        np.array([prismatic for prismatic, _, _ in joints], dtype=np.int64),
        np.array([coordinate for _, coordinate, _ in joints], dtype=np.int64),
        np.array([ratio for _, _, ratio in joints], dtype=float),
    )


def _z_to(axis: Array) -> Array:
    """Return a rotation (3, 3) whose third column is the axis; of zeros and ones for a coordinate axis."""
    least = np.eye(3)[np.argmin(np.abs(axis))]
    x = np.cross(least, axis)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(axis, x), axis])
