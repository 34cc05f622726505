"""The point that the joints of any arm move, those that mimic another one too: v = A q, and p(v) along the chain."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.robot.box import intervals, joint_box, refuse_open_range, turns_of_followers
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import Axis, distance_to
from robotics1.workspaces.sampled.chain_map import ChainMap, chain_map

ALIKE = 1e-11  # of directions that are parallel or normal, and of distances by the arm's size


@dataclass(frozen=True, eq=False)
class DrivenChain:
    """A point, moved by m joints that n coordinates drive.

    Attributes:
        chain: the joints; their values v (m,) are zero at q = 0.
        A: (m, n) v = A q; a joint that mimics none has a row with one 1.
        numbers: (n,) the places of the coordinates in the configuration of the robot.
        lower, upper: (n,) the limits [rad or m]; of a circle its ends.
        circular: (n,) whether lower and upper are the same place.
    """

    chain: ChainMap
    A: Array
    numbers: npt.NDArray[np.intp]
    lower: Array
    upper: Array
    circular: npt.NDArray[np.bool_]

    def point(self, q: Array) -> Array:
        """Return the point at q (k, n): (k, 3)."""
        return self.chain.point(q @ self.A.T)

    def jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return the point (k, 3) and its Jacobian (k, 3, n) at q (k, n)."""
        p, J = self.chain.jacobian(q @ self.A.T)
        return p, J @ self.A

    def drawn(self, rng: np.random.Generator, count: int) -> Array:
        """Return configurations (count, n) inside the limits; an eighth of the joints' values are at limits."""
        q = rng.uniform(self.lower, self.upper, (count, len(self.lower)))
        at_limit = (rng.random(q.shape) < 0.125) & ~self.circular
        return np.where(at_limit, np.where(rng.random(q.shape) < 0.5, self.lower, self.upper), q)


def driven_chain(robot: Robot, frame: str | None, box: Mapping[str, tuple[float, float]] | None) -> DrivenChain:
    """Return what moves the origin of a frame; without the last joints if they turn about it.

    Raises:
        InputError: a prismatic joint has no limits.
        UnknownNameError: the box names no joint.
    """
    tip = np.array(forward_kinematics(robot, np.zeros(robot.nq), frame=frame).translation)
    axes, factors = _axes_at_zero(robot, frame)
    while axes and axes[-1].revolute and distance_to(axes[-1], tip) < ALIKE * robot.reach:
        axes.pop()
        factors.pop()
    numbers = np.array(sorted({axis.number for axis in axes}), dtype=np.intp)
    lower, upper = intervals(robot, box)
    for i in numbers[~robot.revolute[numbers]]:  # slides that do not move the point may be endless
        refuse_open_range(robot.joint_names[i], lower[i], upper[i])
    limits = joint_box(robot, box, unlimited=1.0, turns=turns_of_followers(robot, [frame]))
    A = np.zeros((len(axes), len(numbers)))
    for row, axis, factor in zip(A, axes, factors, strict=True):
        row[np.searchsorted(numbers, axis.number)] = factor
    return DrivenChain(
        chain_map(axes, tip), A, numbers, limits.lower[numbers], limits.upper[numbers], limits.circular[numbers]
    )


def _axes_at_zero(robot: Robot, frame: str | None) -> tuple[list[Axis], list[float]]:
    """Return the joints on the way to a frame at q = 0, and how fast each moves when its leader does."""
    pin.forwardKinematics(robot.model, robot.data, np.zeros(robot.nq))
    axes, factors = [], []
    for joint in robot.joints_to(frame):
        if joint.kind == "fixed" or joint.multiplier == 0:
            continue
        T = robot.data.oMi[robot.model.getJointId(joint.name)]
        direction = T.rotation @ np.array(joint.axis) / np.linalg.norm(joint.axis)
        number = robot.joint_names.index(joint.leader)
        turns = joint.kind != "prismatic"
        axes.append(Axis(number, joint.name, turns, direction, np.array(T.translation), -np.inf, np.inf))
        factors.append(joint.multiplier)
    return axes, factors
