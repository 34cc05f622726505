"""A robot and a task as the kernels of inverse kinematics take them: arrays, with lengths in units of the reach."""

from dataclasses import dataclass, replace

import numpy as np

from robotics1.angles import TURN
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays, Indices, chain_arrays
from robotics1.kernels.inverse import start_table
from robotics1.kinematics import reference_axes
from robotics1.robot.box import JointBox, joint_box, within_two_turns
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameMap, PoseError, Task


@dataclass(frozen=True, eq=False)
class PoseProblem:
    """The constants of `kernels.inverse.solve`.

    Attributes:
        robot: the robot.
        form: the task as a function of its frame's pose.
        pose_error: how its error follows from the pose's.
        chain: from the base to the task's frame, in its axes; coordinates numbered 0, ..., n − 1.
        coordinates: (nq, 4) the limits of each entry of q, whether it can make whole turns, and what counts as one.
        active: (n,) which entries of q move the chain.
        unit: what counts as one length [m]: a power of two near the reach, so that scaling rounds nothing.
        box: where starts are drawn.
    """

    robot: Robot
    form: FrameMap
    pose_error: PoseError
    chain: ChainArrays
    coordinates: Array
    active: Indices
    unit: float
    box: JointBox

    def arrays(self, tolerance: float) -> tuple[Array, Array, Indices, Array]:
        """Return the first arguments of the kernels."""
        task = np.concatenate([self.pose_error.counted, self.pose_error.axis, [self.unit, tolerance]])
        return self.chain.links(), self.coordinates, self.active, task

    @property
    def middle(self) -> Array:
        """(nq,) the middle of the joint ranges [rad or m]."""
        return np.asarray(0.5 * (self.box.lower + self.box.upper))

    def table(self, rng: np.random.Generator, count: int) -> Array:
        """Return random starts, uniform in the box, with their poses: (count, 12 + n)."""
        starts = self.box.random(rng, count)[:, self.active] / self.coordinates[self.active, 3]
        return start_table(self.chain.links(), np.ascontiguousarray(starts))


def pose_problem(robot: Robot, task: Task, limits: tuple[Array, Array] | None = None) -> PoseProblem:
    """Return the arrays of a robot and a task, with other limits, (n,) and (n,), than the robot's if they are given.

    Raises:
        InputError: the robot has joints with several degrees of freedom.
        TaskError: the task does not fit the robot, its axes move, or no joint moves its frame.
    """
    task.check_integrable(robot)
    form = task.frame_map()
    if form is None or form.pose_error is None:
        raise TaskError("the kernels need a task on one frame, such as PoseTask")
    box = joint_box(robot, unlimited=2.0)
    axes = reference_axes(robot, np.zeros(robot.nq), form.reference)
    unit = float(2.0 ** np.clip(np.round(np.log2(robot.reach)), -1000, 1000))
    chain = chain_arrays(robot, form.frame, unit=unit, axes=axes)
    active = np.unique(chain.coordinate)
    if not active.size:
        raise TaskError("nothing moves this task: there is no joint between the base and its frame")
    back = (chain.prismatic == 0) & (np.abs(chain.ratio - np.round(chain.ratio)) < 1e-9)  # after a turn of its leader
    whole = np.ones(robot.nq, dtype=bool)
    whole[chain.coordinate[~back]] = False
    lower, upper = (robot.lower, robot.upper) if limits is None else limits
    circular = robot.revolute & whole & (upper - lower >= TURN - 1e-12)
    units = np.where(robot.revolute, 1.0, unit)
    low, high = (
        np.where(box.circular & ~circular, near, end)
        for near, end in zip(within_two_turns(lower, upper), (box.lower, box.upper), strict=True)
    )
    box = replace(box, lower=low, upper=high, circular=box.circular & circular)
    return PoseProblem(
        robot,
        form,
        form.pose_error,
        chain=chain._replace(coordinate=np.searchsorted(active, chain.coordinate)),
        coordinates=np.column_stack([lower, upper, circular, units]),
        active=active,
        unit=unit,
        box=box,
    )
