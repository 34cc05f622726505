"""What every task answers, and the frame of the built-in ones."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.errors import TaskError
from robotics1.inputs import Array, text
from robotics1.kinematics import forward_kinematics, frame_jacobian, reference_axes
from robotics1.robot.model import Robot


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

    def value(self, robot: Robot, q: npt.ArrayLike) -> Any:
        """Return r = f(q)."""

    def target(self, target: Any) -> Any:
        """Return a target in the form of `value`, or raise InputError saying what would be right."""

    def error(self, robot: Robot, q: npt.ArrayLike, target: Any) -> Array:
        """Return e = r_d − f(q), (m,)."""

    def jacobian(self, robot: Robot, q: npt.ArrayLike) -> Array:
        """Return J(q), (m, nv), with ṙ = J q̇."""

    def check(self, robot: Robot) -> None:
        """Raise TaskError if the task does not fit the robot."""

    def check_integrable(self, robot: Robot) -> None:
        """Raise TaskError if J is not the derivative of the value."""


@dataclass(frozen=True, kw_only=True)
class FrameTask:
    """A task on one frame: r = g(T) and ṙ = S(T) V, with T the frame's pose and V = (v, ω) its velocity.

    A subclass says g, S and the error of two values; where the frame is, and which axes are meant, is said here.
    With axes other than the world's, T has p = R_rᵀ p and R = R_rᵀ R, and V is resolved in them: J is the
    textbook's ʳJ, which is ∂r/∂q when those axes do not move.

    Attributes:
        frame: the frame's name; None for the tool.
        reference: the axes: "world", "tool", or a frame's name.
    """

    frame: str | None = None
    reference: str = "world"

    def __post_init__(self) -> None:
        """Refuse axes and a frame that are no names."""
        text("reference", self.reference)
        if self.frame is not None:
            text("frame", self.frame)

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

    @property
    @abstractmethod
    def pose_rows(self) -> tuple[int, ...]:
        """Which of the six rows of the pose error (p_d − p, log3(R_d Rᵀ)) vanish where this task's error does."""

    @property
    def pointed_axis(self) -> Array:
        """(3,) the axis of the frame whose direction alone counts, of the three of R; zero if all of R does."""
        return np.zeros(3)

    @property
    def has_constant_rows(self) -> bool:
        """Whether S(T) is the same at every pose."""
        return False

    @property
    def tells_angles(self) -> bool:
        """Whether the task's error is one of angles, which near their singularity are many times the turn missing."""
        return False

    @property
    def takes_poses(self) -> bool:
        """Whether a target is a `pin.SE3`, and its own goal."""
        return False

    @abstractmethod
    def goal(self, robot: Robot, target: Any) -> Array:
        """Return (4, 4), a pose T_d at which the task has the target's value; rows that do not count are arbitrary.

        Raises:
            InputError: the target has the wrong form.
        """

    @property
    def rows(self) -> int:
        """m, the number of rows of J."""
        return len(self.row_names)

    def value(self, robot: Robot, q: npt.ArrayLike) -> Any:
        """Return r = g(T(q))."""
        self.check(robot)
        T = self._pose(robot, q)
        return self.g(T.translation, T.rotation)

    def error(self, robot: Robot, q: npt.ArrayLike, target: Any) -> Array:
        """Return e = r_d − r, (m,), angles wrapped into (−π, π].

        Raises:
            InputError: the target has the wrong form.
            TaskError: the task does not fit the robot.
        """
        return self.difference(self.target(target), self.value(robot, q))

    def jacobian(self, robot: Robot, q: npt.ArrayLike) -> Array:
        """Return J(q) = S(T) ʳJ(q), (m, nv).

        Raises:
            TaskError: the task does not fit the robot.
        """
        self.check(robot)
        T = self._pose(robot, q)
        return self.S(T.translation, T.rotation) @ frame_jacobian(robot, q, frame=self.frame, reference=self.reference)

    def check(self, robot: Robot) -> None:
        """Raise TaskError if the task does not fit the robot; here any robot will do."""

    def check_integrable(self, robot: Robot) -> None:
        """Raise TaskError if the axes move with the robot, so that J is not ∂r/∂q and no target stands still."""
        self.check(robot)
        if self.reference == "world":
            return
        frame = robot.frame_id(None if self.reference == "tool" else self.reference)
        if robot.model.frames[frame].parentJoint != 0:
            raise TaskError(
                f"the axes of {self.reference!r} move with the robot, so a target in them does not stand still; "
                f"use reference='world'"
            )

    def _pose(self, robot: Robot, q: npt.ArrayLike) -> pin.SE3:
        T = forward_kinematics(robot, q, frame=self.frame)
        if self.reference == "world":
            return T
        R = reference_axes(robot, q, self.reference)
        return pin.SE3(R.T @ T.rotation, R.T @ T.translation)
