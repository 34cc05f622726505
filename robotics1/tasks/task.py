"""What every task answers, and the frame of the built-in ones."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, Protocol

import numpy as np
import pinocchio as pin

from robotics1.errors import TaskError
from robotics1.inputs import Array, text
from robotics1.kinematics import forward_kinematics, frame_jacobian, is_batch, of_each, point_of_frame, reference_axes
from robotics1.orientation.elementary import cross_matrix
from robotics1.other_words import names_what_is_meant
from robotics1.robot.box import turns_of_followers
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot


@dataclass(frozen=True, eq=False)
class PoseError:
    """How the error of a task follows from that of its frame's pose, (p_d − p, log3(R_d Rᵀ)), (6,).

    Attributes:
        rows: which of the six rows vanish where the task's error does.
        goal: (robot, target) → (4, 4), a pose T_d at which the task has the target's value; rows that do not count are
            arbitrary. It raises InputError for a target of the wrong form.
        axis: (3,) the axis of the frame whose direction alone counts, of the three of R; zero if all of R does.
        by_angles: whether the task's error holds angles, which near their singularity are many times the missing turn.
        takes_poses: whether a target is a `pin.SE3`, and its own goal.
    """

    rows: tuple[int, ...]
    goal: Callable[[Robot, Any], Array]
    axis: Array = field(default_factory=lambda: np.zeros(3))
    by_angles: bool = False
    takes_poses: bool = False

    @property
    def counted(self) -> Array:
        """(6,) 1 for the rows that count, 0 for the others."""
        return np.isin(np.arange(6), self.rows).astype(float)


@dataclass(frozen=True, eq=False)
class FrameMap:
    """A task as a function of the pose of one frame: r = g(p, R, q), and ṙ = S(p, R) V where S is known.

    Attributes:
        frame: the frame's name; None for the tool.
        reference: the axes of p (3,), R (3, 3) and V: "world", "tool", or a frame's name.
        g: r, of numbers or of expressions.
        S: (m, 6), of numbers or of expressions; None for a function of the user's own, which is differentiated.
        pose_error: how the task's error follows from that of the pose; None where S is.
        by_differences: whether J is found by differences of the value.
        constant_rows: whether S is the same at every pose.
        knows_units: whether the units of the rows are known; a row without may count turns, or be an angle.
        parameters: names of lengths that g takes by keyword, and their values; formulas keep the names.
    """

    frame: str | None
    reference: str
    g: Callable[[Array, Array, Array], Any]
    S: Callable[[Array, Array], Array] | None = None
    pose_error: PoseError | None = None
    constant_rows: bool = False
    by_differences: bool = False
    knows_units: bool = True
    parameters: Mapping[str, float] = field(default_factory=dict)


class Task(Protocol):
    """A map r = f(q) with its Jacobian J = ∂f/∂q: what the analyses, IK and trajectories ask of a task."""

    @property
    def row_names(self) -> tuple[str, ...]:
        """A name for each row of J, such as ("x", "y", "φ")."""

    @property
    def row_units(self) -> tuple[str, ...]:
        """The unit of each row: "m", "rad", or "1"."""

    @property
    def rows(self) -> int:
        """m, the number of rows of J."""

    def value(self, robot: Robot, q: ConfigurationLike) -> Any:
        """Return r = f(q)."""

    def target(self, target: Any) -> Any:
        """Return a target in the form of `value`, or raise InputError saying what would be right."""

    def error(self, robot: Robot, q: ConfigurationLike, target: Any) -> Array:
        """Return e = r_d − f(q), (m,)."""

    def jacobian(self, robot: Robot, q: ConfigurationLike) -> Array:
        """Return J(q), (m, nv), with ṙ = J q̇."""

    def check(self, robot: Robot) -> None:
        """Raise TaskError if the task does not fit the robot."""

    def check_integrable(self, robot: Robot) -> None:
        """Raise TaskError if J is not the derivative of the value."""

    def frame_map(self) -> FrameMap | None:
        """Return the task as a function of one frame's pose, for kernels and formulas; None if it is no such one."""


@names_what_is_meant
@dataclass(frozen=True, kw_only=True)
class FrameTask:
    """A task on one frame: r = g(T) and ṙ = S(T) V, with T the frame's pose and V = (v, ω) its velocity.

    A subclass has g, S and the error of two values; this class knows where the frame is and which axes are meant.
    With axes other than the world's, T has p = R_rᵀ p and R = R_rᵀ R, and V is resolved in them: J is the
    textbook's ʳJ, which is ∂r/∂q when those axes do not move.

    Attributes:
        frame: the frame's name; None for the tool.
        reference: the axes: "world", "tool", or a frame's name.
        point: (3,) a point that is fixed to the frame, in the frame's axes [m], in the place of its origin; None for
            the origin. Inverse kinematics of such a task goes by numbers, unless the task fixes the orientation too.
    """

    frame: str | None = None
    reference: str = "world"
    point: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        """Refuse axes and a frame that are no names, and a point that is none."""
        text("reference", self.reference)
        if self.frame is not None:
            text("frame", self.frame)
        c = point_of_frame(self.point)
        object.__setattr__(self, "point", None if c is None else tuple(c.tolist()))

    @property
    @abstractmethod
    def row_names(self) -> tuple[str, ...]:
        """A name for each row of J."""

    @property
    @abstractmethod
    def row_units(self) -> tuple[str, ...]:
        """The unit of each row."""

    @abstractmethod
    def g(self, p: Array, R: Array) -> Any:
        """Return r = g(T) of the position p (3,) and the rotation R (3, 3)."""

    @abstractmethod
    def S(self, p: Array, R: Array) -> Array:
        """Return S(T), (m, 6)."""

    @abstractmethod
    def target(self, target: Any) -> Any:
        """Return a target in the form of g."""

    @abstractmethod
    def difference(self, target: Any, value: Any) -> Array:
        """Return r_d − r, (m,)."""

    @abstractmethod
    def pose_error(self) -> PoseError:
        """Return how the task's error follows from that of the frame's pose."""

    @property
    def has_constant_rows(self) -> bool:
        """Whether S(T) is the same at every pose."""
        return False

    def frame_map(self) -> FrameMap:
        """Return g, S and the error of the pose."""
        if self.point is not None:
            return self._map_at(np.array(self.point))
        return FrameMap(
            self.frame,
            self.reference,
            lambda p, R, q: self.g(p, R),
            self.S,
            self.pose_error(),
            constant_rows=self.has_constant_rows,
        )

    def _map_at(self, c: Array) -> FrameMap:
        """Return g(p + R c, R), S for the velocity v + ω × R c of the point, and the error of the frame's pose.

        That error is known where the target fixes the orientation R_d: the origin is then at p_d − R_d c.
        """

        def S(p: Array, R: Array) -> Array:
            there = self.S(p + R @ c, R)
            return np.hstack([there[:, :3], there[:, 3:] - there[:, :3] @ cross_matrix(R @ c)])

        error = self.pose_error()

        def goal(robot: Robot, target: Any) -> Array:
            T = np.array(error.goal(robot, target))
            T[:3, 3] -= T[:3, :3] @ c
            return T

        oriented = self._orients(error.rows)
        return FrameMap(
            self.frame,
            self.reference,
            lambda p, R, q: self.g(p + R @ c, R),
            S,
            replace(error, goal=goal, takes_poses=False) if oriented else None,
        )

    def _orients(self, rows: tuple[int, ...]) -> bool:
        """Whether the rows of the pose's error fix the orientation, at least of a frame that the task fits."""
        return {3, 4, 5} <= set(rows)

    @property
    def rows(self) -> int:
        """m, the number of rows of J."""
        return len(self.row_names)

    def value(self, robot: RobotLike, q: ConfigurationLike) -> Any:
        """Return r = g(T(q)); of several configurations (k, nq), an array of k values, poses as matrices (4, 4)."""
        robot = robot_from(robot)
        self.check(robot)
        if is_batch(q):
            every = [self.value(robot, one) for one in robot.configurations(q)]
            return np.array([getattr(value, "homogeneous", value) for value in every])
        T = self._pose(robot, q)
        return self.g(T.translation, T.rotation)

    def error(self, robot: RobotLike, q: ConfigurationLike, target: Any) -> Array:
        """Return e = r_d − r, (m,), angles wrapped into (−π, π].

        Raises:
            InputError: the target has the wrong form.
            TaskError: the task does not fit the robot.
        """
        robot = robot_from(robot)
        return self.difference(self.target(target), self.value(robot, robot.configuration(q)))

    def jacobian(self, robot: RobotLike, q: ConfigurationLike) -> Array:
        """Return J(q) = S(T) ʳJ(q), (m, nv); of several configurations (k, nq), (k, m, nv).

        Raises:
            TaskError: the task does not fit the robot.
        """
        robot = robot_from(robot)
        self.check(robot)
        if is_batch(q):
            return of_each(partial(self.jacobian, robot), robot, q, (self.rows, robot.nv))
        T = self._pose(robot, q)
        J = frame_jacobian(robot, q, frame=self.frame, reference=self.reference, point=self.point)
        return self.S(T.translation, T.rotation) @ J

    def check(self, robot: Robot) -> None:
        """Raise TaskError if the task does not fit the robot; here any robot will do."""

    def check_integrable(self, robot: Robot) -> None:
        """Raise TaskError if the axes move with the robot, so that J is not ∂r/∂q and no target stands still."""
        self.check(robot)
        axes = None if self.reference == "tool" else self.reference
        if self.reference != "world" and robot.own_model.frames[robot.frame_id(axes)].parentJoint != 0:
            raise TaskError(
                f"the axes of {self.reference!r} move with the robot, so a target in them does not stand still; "
                f"use reference='world'"
            )

    def _pose(self, robot: Robot, q: ConfigurationLike) -> pin.SE3:
        T = forward_kinematics(robot, q, frame=self.frame, point=self.point)
        if self.reference == "world":
            return T
        R = reference_axes(robot, q, self.reference)
        return pin.SE3(R.T @ T.rotation, R.T @ T.translation)


def turns_of(robot: Robot, task: Task) -> Array:
    """Return after how many turns of each joint, (nq,), all joints that matter to the task are back; ∞ if never.

    More than one are needed where another joint turns by a fraction of its angle.
    """
    form = task.frame_map()
    if form is None:
        return turns_of_followers(robot, [frame.name for frame in robot.own_model.frames])
    axes = [] if form.reference == "world" else [None if form.reference == "tool" else form.reference]
    return turns_of_followers(robot, [form.frame, *axes])
