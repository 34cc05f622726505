"""The arm angle of seven joints like those of a human arm, and all solutions of a pose with a given arm angle.

The first three axes meet in the shoulder S, the last three in the wrist W. The elbow E is the point of axis 4 that is
the nearest to S. With W − S given by the pose, the elbow may turn about the line SW. The arm angle is how far.

Source: Kreutz-Delgado, Long, Seraji, Kinematic analysis of 7-DOF manipulators, Int. J. Robotics Research 11, 1992.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.angles import without_turns
from robotics1.errors import TaskError
from robotics1.ik.common_roots import coefficients, real_roots, samples
from robotics1.ik.descent import REACHED
from robotics1.ik.joint_chain import FixedChain, fixed_chain
from robotics1.ik.loops import meeting, miss_of_a_point
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.ik.solution_search import SAME, SolutionSearch
from robotics1.ik.solution_set import IKSolutions, solutions_of
from robotics1.ik.subproblems import Z, inverse, motion, moved, orientation, placed
from robotics1.inputs import Array, real_number
from robotics1.robot.box import nearest_turn
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import PoseError

APART = 1e-3  # of the arm's length, by which the axes of a shoulder or a wrist may miss a common point
STRAIGHT = 1e-9  # of the arm's length, from the line SW, at which the elbow has no direction
STEP, STEPS = 1e-6, 12  # of central differences, and of Newton's method
SINGULAR = 1e-9  # σ_min beside σ_max
EXACT = 1e-9  # of the arm's length: less is rounding
NEEDED = "an arm angle needs seven turning joints: the first three axes meet in a shoulder, the last three in a wrist"


@dataclass(frozen=True, eq=False)
class HumanArm:
    """An arm with a shoulder, an elbow and a wrist; joint coordinates are those of its seven joints."""

    problem: ScaledTask
    chain: FixedChain
    pose_error: PoseError

    @property
    def shoulder(self) -> float:
        """Where the shoulder is on axis 3, from the origin of joint 3."""
        return meeting(self.chain.P[2])[1]

    @property
    def wrist(self) -> tuple[float, float]:
        """Where the wrist is on axis 5 and on axis 7."""
        return meeting(self.chain.P[5])[0], meeting(self.chain.P[6])[1]

    def sides(self, elbow: float) -> tuple[Array, Array]:
        """Return the unit vectors along SW and across it to the elbow, before joint 4, for an angle of that joint."""
        A, S, length = self.chain.P[3], self.shoulder * Z, self.chain.length
        W = placed(A @ motion(False, elbow) @ self.chain.P[4], self.wrist[0] * Z)
        along, axis = _direction(W - S, length), A[:3, 2]
        foot = A[:3, 3] - S - ((A[:3, 3] - S) @ axis) * axis  # the point of axis 4 next to S, from there
        across = foot - (foot @ along) * along
        if np.linalg.norm(across) < STRAIGHT * length:
            raise TaskError("the arm is straight, where it has no arm angle")
        return along, across / np.linalg.norm(across)

    def elbow_angle(self, q: Array) -> float:
        """Return the arm angle of q (nq,) [rad].

        Raises:
            TaskError: the wrist is on the first axis, or the arm is straight.
        """
        x = q[list(self.chain.coordinate)]
        T = self.chain.P[0]
        for k in range(3):
            T = T @ motion(False, x[k]) @ (self.chain.P[k + 1] if k < 2 else np.eye(4))
        along, across = (T[:3, :3] @ side for side in self.sides(float(x[3])))
        up = self.up(along)
        return float(np.arctan2(across @ np.cross(along, up), across @ up))

    def up(self, along: Array) -> Array:
        """Return the direction of the arm angle 0: that of the first axis, across SW."""
        axis = self.chain.P[0][:3, 2]
        up = axis - (axis @ along) * along
        if np.linalg.norm(up) < STRAIGHT:
            raise TaskError("the wrist is on the first axis, where there is no arm angle; lock a joint instead")
        return np.asarray(up / np.linalg.norm(up))

    def candidates(self, goal: Array, angle: float) -> Array:
        """Return joint coordinates (k, 7), by formula: two elbows, two shoulders and two wrists."""
        P = self.chain.P
        S = placed(P[0], meeting(P[1])[0] * Z)
        W = placed(goal @ inverse(P[7]), self.wrist[1] * Z)
        along = _direction(W - S, self.chain.length)
        up = self.up(along)
        across = np.cos(angle) * up + np.sin(angle) * np.cross(along, up)
        world = np.column_stack([along, across, np.cross(along, across)])
        found = []
        for elbow in self._elbows(float(np.linalg.norm(W - S))):
            a, b = self.sides(elbow)
            R = world @ np.column_stack([a, b, np.cross(a, b)]).T
            first = orientation([P[1][:3, :3], P[2][:3, :3]], P[0][:3, :3].T @ R)
            through = R @ P[3][:3, :3] @ motion(False, elbow)[:3, :3] @ P[4][:3, :3]
            last = orientation([P[5][:3, :3], P[6][:3, :3]], through.T @ goal[:3, :3] @ P[7][:3, :3].T)
            if first is not None and last is not None:
                found += [[*x, elbow, *y] for x in first for y in last]
        return np.array(found).reshape(-1, 7)

    def _elbows(self, distance: float) -> Array:
        """Return the angles of joint 4 at which S and W are so far apart."""
        W = placed(self.chain.P[3], moved(False, samples(False), placed(self.chain.P[4], self.wrist[0] * Z)))
        squares = ((W - self.shoulder * Z) ** 2).sum(axis=-1)
        found = real_roots(coefficients((squares - distance**2) / self.chain.length**2, [False]), False)
        return np.zeros(0) if found is None else np.unique(np.round(found, 13))

    def polished(self, q: Array, target: Any, angle: float) -> Array:
        """Return q (nq,) after Newton's method on the pose and the arm angle."""
        moving = list(self.chain.coordinate)
        for _ in range(STEPS):
            turn = without_turns(angle - self.elbow_angle(q))
            e = np.append(self.problem.error(q, target), turn)
            if np.abs(e).max() < 1e-14:
                break
            J = np.vstack([self.problem.jacobian(q)[:, moving], self._rate(q)])
            q = q.copy()
            q[moving] += np.linalg.lstsq(J, e, rcond=SINGULAR)[0]
        return q

    def _rate(self, q: Array) -> Array:
        """Return the derivatives of the arm angle by the seven joints, by central differences."""
        rates = []
        for j in self.chain.coordinate:
            step = STEP * np.eye(len(q))[j]
            rates.append(without_turns(self.elbow_angle(q + step) - self.elbow_angle(q - step)) / (2 * STEP))
        return np.array(rates)


def _direction(along: Array, length: float) -> Array:
    distance = np.linalg.norm(along)
    if distance < STRAIGHT * length:
        raise TaskError("the wrist is in the shoulder, where there is no arm angle; lock a joint instead")
    return np.asarray(along / distance)


def _human_arm(robot: RobotLike, task: TaskLike) -> HumanArm:
    """Return the arm whose pose a task is.

    Raises:
        TaskError: the task is no pose, or the arm has no shoulder, elbow and wrist.
    """
    robot, task = robot_and_task(robot, task)
    form, problem = task.frame_map(), scaled_task(robot, task)
    if not problem.moving.any():
        raise TaskError("no joint moves the task: there is no arm angle")
    error = None if form is None else form.pose_error
    if error is None or sorted(error.rows) != list(range(6)):
        raise TaskError("an arm angle belongs to a pose: use PoseTask()")
    chain = fixed_chain(problem)
    seven = chain is not None and len(chain.prismatic) == 7 and not any(chain.prismatic)
    if chain is None or not seven or _miss(chain) > APART * chain.length:
        raise TaskError(f"{NEEDED}; of robot {robot.name!r} lock a joint instead: ik_solutions(..., locked={{...}})")
    return HumanArm(problem, chain, error)


def _miss(chain: FixedChain) -> float:
    """Return by how much the axes of the shoulder or of the wrist miss a common point [m]."""
    return max(miss_of_a_point(chain.P[1:3]), miss_of_a_point(chain.P[5:7]))


def arm_angle(robot: RobotLike, task: TaskLike, q: ConfigurationLike) -> float:
    """Return the arm angle of a configuration [rad], in (−π, π].

    It is the angle about the line SW from the direction of the first axis to that of the elbow.

    Args:
        robot: an arm with a shoulder, an elbow and a wrist.
        task: the pose that its seven joints move, such as `PoseTask()`.
        q: (nq,) [rad].

    Raises:
        TaskError: the arm has no shoulder, elbow and wrist; it is straight; or its wrist is on the first axis.
    """
    arm = _human_arm(robot, task)
    return arm.elbow_angle(arm.problem.robot.configuration(q))


def solutions_at_arm_angle(robot: RobotLike, task: TaskLike, target: Any, angle: float) -> IKSolutions:
    """Return all solutions of a pose at which the arm has a given arm angle: eight at most.

    Args:
        robot: an arm with a shoulder, an elbow and a wrist.
        task: the pose that its seven joints move, such as `PoseTask()`.
        target: r_d, in the form of the task's value.
        angle: as `arm_angle` has it [rad].

    Raises:
        InputError: the target has the wrong form, or the angle is no number.
        TaskError: the arm has no shoulder, elbow and wrist; it is straight; or the wrist is to be on the first axis.
    """
    arm, angle = _human_arm(robot, task), real_number("angle", angle)
    problem, target = arm.problem, arm.problem.task.target(target)
    found: list[Array] = []
    for x in arm.candidates(arm.pose_error.goal(problem.robot, target), angle):
        q = problem.middle.copy()
        q[list(arm.chain.coordinate)] = x
        q = arm.polished(q, target, angle)
        q = np.where(problem.moving, nearest_turn(q, problem.middle, problem.lower, problem.upper), q)
        new = all(np.abs(problem.shortest_difference(q, p)).max() > SAME for p in found)
        if new and problem.relative_error(q, target) <= REACHED:
            found.append(q)
    return _answer(arm, target, sorted(found, key=lambda q: [round(float(value), 6) for value in q]))


def _answer(arm: HumanArm, target: Any, found: list[Array]) -> IKSolutions:
    problem = arm.problem
    robot = problem.robot
    q = np.array(found).reshape(-1, robot.nq)
    inside = np.array([robot.within_limits(p) for p in q], dtype=bool)
    sigmas = [np.linalg.svd(problem.jacobian(p), compute_uv=False) for p in q[inside]]
    singular = np.array([sigma[-1] < SINGULAR * sigma[0] for sigma in sigmas], dtype=bool)
    proven = _miss(arm.chain) < EXACT * arm.chain.length and not singular.any()
    missed = IKStatus.UNREACHABLE if proven else IKStatus.NOT_FOUND
    closest = q[inside][0] if inside.any() else SolutionSearch(problem, target).nearest_miss(problem.middle)
    return solutions_of(
        problem,
        q[inside],
        singular,
        q[~inside],
        status=missed if not inside.any() else IKStatus.BOUNDARY if singular.any() else IKStatus.FINITE,
        complete=proven,
        method="shoulder, elbow and wrist at an arm angle",
        closest=closest,
        error_norm=float(np.hypot.reduce(problem.task.error(robot, closest, target))),
        dimension=0,
    )
