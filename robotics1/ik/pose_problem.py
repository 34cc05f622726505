"""A robot and a task as the kernels of inverse kinematics take them: arrays, with lengths in units of the reach."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays, Indices, chain_arrays
from robotics1.kernels.inverse import pose_table
from robotics1.kinematics import reference_axes
from robotics1.robot.box import TURN, JointBox, joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask


@dataclass(frozen=True, eq=False)
class PoseProblem:
    """The constants of `kernels.inverse.solve`.

    Attributes:
        chain: from the base to the task's frame, in its axes; coordinates numbered 0, ..., n − 1.
        limits: (3, n) lower, upper, and 1 for joints that can make whole turns and need no limits on the way.
        active: (n,) which entries of q they are.
        units: (n,) what counts as one of each.
        joints: (2, nq) the limits of q.
        counted: (6,) 1 for the rows of the pose error that count.
        axis: (3,) the axis that is pointed, or zero.
        unit: what counts as one length [m]: a power of two near the reach, so that scaling rounds nothing.
        box: where starts are drawn.
    """

    chain: ChainArrays
    limits: Array
    active: Indices
    units: Array
    joints: Array
    counted: Array
    axis: Array
    unit: float
    box: JointBox

    @cached_property
    def arrays(self) -> tuple[Any, ...]:
        """The first arguments of `solve` and `solve_all`, as plain tuples, which pass into a kernel quickest."""
        return (
            tuple(self.chain), self.limits, self.active, self.units, self.joints, self.counted, self.axis, self.unit,
        )  # fmt: skip

    @property
    def middle(self) -> Array:
        """(nq,) the middle of the joint ranges [rad or m]."""
        return np.asarray(0.5 * (self.box.lower + self.box.upper))

    def table(self, rng: np.random.Generator, count: int) -> tuple[Array, Array]:
        """Return random starts, (count, n), uniform in the box, and their poses, (count, 12)."""
        starts = np.ascontiguousarray(self.box.random(rng, count)[:, self.active] / self.units)
        return starts, pose_table(tuple(self.chain), starts)  # type: ignore[arg-type]


def pose_problem(robot: Robot, task: FrameTask) -> PoseProblem:
    """Return the arrays of a robot and a task.

    Raises:
        InputError: the robot has joints with several degrees of freedom.
        TaskError: the task does not fit the robot, its axes move, or no joint moves its frame.
    """
    task.check_integrable(robot)
    box = joint_box(robot, unlimited=2.0)
    axes = reference_axes(robot, np.zeros(robot.nq), task.reference)
    unit = float(2.0 ** np.round(np.log2(robot.reach)))
    chain = chain_arrays(robot, task.frame, unit=unit, axes=axes)
    active = np.unique(chain.coordinate)
    if not active.size:
        raise TaskError("nothing moves this task: there is no joint between the base and its frame")
    whole = np.ones(robot.nq, dtype=bool)
    whole[chain.coordinate[chain.ratio % 1.0 != 0.0]] = False  # a joint that mimics by ½ is back after two turns
    lower, upper = robot.lower, robot.upper
    circular = robot.revolute & whole & (upper - lower >= TURN - 1e-9)
    units = np.where(robot.revolute, 1.0, unit)[active]
    return PoseProblem(
        chain=chain._replace(coordinate=np.searchsorted(active, chain.coordinate)),
        limits=np.array([lower[active] / units, upper[active] / units, circular[active].astype(float)]),
        active=active,
        units=units,
        joints=np.array([lower, upper]),
        counted=np.isin(np.arange(6), task.pose_rows).astype(float),
        axis=task.pointed_axis,
        unit=unit,
        box=box,
    )
