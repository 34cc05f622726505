"""The Jacobian of an arm with a spherical wrist, in blocks: the joints of the wrist do not move its centre."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics, frame_jacobian
from robotics1.orientation.elementary import cross_matrix
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.tasks.pose import OrientationTask
from robotics1.tasks.position import PositionTask

WRIST = 3  # joints, whose axes meet in one point
TRIALS = 3  # random configurations
MEET = 1e-9  # of the arm's reach: the distance of axes that meet


@dataclass(frozen=True, eq=False)
class WristJacobian:
    """J = [[J₁₁, 0], [J₂₁, J₂₂]], of the wrist centre's velocity and the tool's angular velocity, in SymPy.

    So det J = det J₁₁ det J₂₂: the singularities of the arm are those of its first part and those of its wrist.

    Attributes:
        position: the formulas of the wrist centre.
        rotation: those of the tool's orientation.
    """

    position: Formulas
    rotation: Formulas

    @property
    def arm(self) -> Any:
        """J₁₁, (3, n − 3): the joints before the wrist move its centre."""
        return self.position.jacobian[:, :-WRIST]

    @property
    def coupling(self) -> Any:
        """J₂₁, (3, n − 3): they turn the tool too."""
        return self.rotation.jacobian[:, :-WRIST]

    @property
    def wrist(self) -> Any:
        """J₂₂, (3, 3): the joints of the wrist turn the tool."""
        return self.rotation.jacobian[:, -WRIST:]

    @property
    def jacobian(self) -> Any:
        """J, (6, n), with linear rows first."""
        return self.position.jacobian.col_join(self.rotation.jacobian)

    @cached_property
    def arm_determinant(self) -> Any:
        """Det J₁₁ of three joints before the wrist, factored.

        Raises:
            TaskError: J₁₁ is not square.
        """
        n = self.arm.cols
        if n != 3:
            raise TaskError(f"the wrist has {n} joints before it: J₁₁ is 3 × {n} and has no determinant")
        return self.position.minors[tuple(range(n, n + WRIST))]

    @cached_property
    def wrist_determinant(self) -> Any:
        """Det J₂₂, factored."""
        return self.rotation.minors[tuple(range(self.arm.cols))]

    @property
    def determinant(self) -> Any:
        """Det J = det J₁₁ det J₂₂.

        Raises:
            TaskError: J is not square.
        """
        return self.arm_determinant * self.wrist_determinant


def wrist_jacobian(robot: RobotLike, *, reference: str = "world") -> WristJacobian:
    """Return the Jacobian of an arm with a spherical wrist in blocks, as formulas.

    (ċ, ω) = [[J₁₁, 0], [J₂₁, J₂₂]] q̇, with c the wrist centre, in which the last three axes meet.

    Args:
        robot: its last three joints are a spherical wrist.
        reference: the axes of the vectors: "world", "tool", or a frame's name; those of link 3 give short formulas.

    Raises:
        TaskError: the last three axes do not meet in one point, or none carries the tool.
        FormulaError: a formula does not agree with Pinocchio.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.3.1.
    """
    robot = robot_from(robot)
    if robot.nv < WRIST:
        raise TaskError(f"no joint moves a wrist: it has three, and the robot has {robot.nv}")
    q = np.random.default_rng(0).uniform(-1, 1, (TRIALS, robot.nq))
    centres = np.array([_centre(robot, row) for row in q])
    near = MEET * max(robot.reach, 1e-6)
    frames = [f for f in robot.frame_names if _stays_at(robot, f, q, centres, near)]
    if frames:
        position = formulas(robot, PositionTask(frame=frames[0], reference=_named(robot, reference)))
    else:
        seen = np.array([forward_kinematics(robot, row).actInv(c) for row, c in zip(q, centres, strict=True)])
        if np.abs(seen - seen[0]).max() > near:
            raise TaskError("the last three axes meet, but not in a point of the tool's link: they are no wrist")
        point = np.where(np.abs(seen[0]) < near, 0.0, seen[0].round(12)).tolist()
        position = formulas(robot, PositionTask(reference=_named(robot, reference)), point=point)
    rotation = formulas(robot, OrientationTask(reference=reference))
    return WristJacobian(position, rotation)


def _named(robot: Robot, reference: str) -> str:
    """Return the reference of a task that is not on the tool."""
    return robot.link_of(None) if isinstance(reference, str) and reference == "tool" else reference


def _centre(robot: Robot, q: Array) -> Array:
    """Return the point c in which the last three axes meet, by least squares of vᵢ + ωᵢ × (c − p) = 0.

    Raises:
        TaskError: there is none.
    """
    J = frame_jacobian(robot, q)[:, -WRIST:]
    A = np.vstack([cross_matrix(w) for w in J[3:].T])
    c, _, rank, _ = np.linalg.lstsq(A, -J[:3].T.ravel(), rcond=1e-9)
    if rank < 3 or np.abs(A @ c + J[:3].T.ravel()).max() > MEET * max(robot.reach, 1e-6):
        raise TaskError("the last three axes do not meet in one point: the arm has no spherical wrist")
    return np.asarray(forward_kinematics(robot, q).translation + c)


def _stays_at(robot: Robot, frame: str, q: Array, centres: Array, near: float) -> bool:
    return all(
        np.abs(forward_kinematics(robot, row, frame=frame).translation - c).max() <= near
        for row, c in zip(q, centres, strict=True)
    )
