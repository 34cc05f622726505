"""What proves that no q inside the limits reaches a target."""

from dataclasses import dataclass
from math import hypot
from time import perf_counter

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.ik.descent import REACHED
from robotics1.ik.pose_problem import PoseProblem, pose_problem
from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array
from robotics1.kernels.compilation import COMPILED
from robotics1.kernels.out_of_reach import OPEN, SPLITS, exclude
from robotics1.kinematics import forward_kinematics, frame_jacobian, reference_axes
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameMap

STILL = 1e-12  # of a row of J that is zero but for rounding, lengths in reaches
MOST = 200_000 if COMPILED else 2_000  # boxes that a proof may take
AT_ONCE = 4_000  # boxes between two looks at the clock
SWEEPS, SMOOTHING = 400, 50  # over the axes, until the shortest way over them is found


@dataclass(frozen=True, eq=False)
class Motionless:
    """What no joint changes: coordinates of the frame, and an axis about which alone it turns, or its whole rotation.

    Attributes:
        rows: (3,) True for the coordinates that are constant.
        p, R: the position (3,) [m] and the rotation (3, 3) at some q, in the task's axes.
        normals: (3, d) of the directions that turns leave alone: all three if the frame does not turn, one if it
            turns about one axis, none otherwise.
    """

    rows: Array
    p: Array
    R: Array
    normals: Array

    def excess(self, goals: Array, counted: Array, axis: Array) -> tuple[Array, Array]:
        """Return how far goals, (k, 4, 4), are from what is constant: (k,) [m] and, at least, (k,) [rad]."""
        with np.errstate(over="ignore"):
            linear = np.hypot.reduce((goals[:, :3, 3] - self.p) * (self.rows * counted[:3]), axis=1)
        if not counted[3:].all() or not self.normals.size:
            return linear, np.zeros(len(goals))
        if axis.any():  # n·r is constant
            return linear, np.abs((goals[:, :3, :3] - self.R) @ axis @ self.normals).max(axis=1)
        turned = goals[:, :3, :3] @ (self.R.T @ self.normals) - self.normals  # a turn about n alone leaves n
        return linear, np.linalg.norm(turned, axis=1).max(axis=1)


def motionless(robot: Robot, form: FrameMap) -> Motionless:
    """Return what no joint changes, read from J at five random configurations."""
    rng = np.random.default_rng(0)
    samples = rng.uniform(-1, 1, (5, robot.nq)) * robot.units
    J = np.hstack([frame_jacobian(robot, q, frame=form.frame, reference=form.reference) * robot.units for q in samples])
    axes = reference_axes(robot, samples[0], form.reference)
    T = forward_kinematics(robot, samples[0], frame=form.frame)
    U, sigma, _ = np.linalg.svd(J[3:])
    rank = int(np.count_nonzero(sigma > STILL * 10))
    normals = np.eye(3) if rank == 0 else U[:, :1] if rank == 1 else np.zeros((3, 0))
    rows = np.abs(J[:3]).max(axis=1) <= STILL * robot.reach
    return Motionless(rows, axes.T @ T.translation, axes.T @ T.rotation, normals)


@dataclass(frozen=True, eq=False)
class ReachBound:
    """No configuration takes the frame's origin farther from a point o on the first joint axis than `length`.

    A path from o over one point on each joint axis to the frame turns or stretches as the joints move, but its pieces
    keep their lengths: |p − o| ≤ Σ |pieces| + Σ travel. Any points on the axes of turning joints will do; those that
    make the sum least bound best.

    Attributes:
        o: (3,) the point on the first axis [m], in the task's axes.
        length: Σ |pieces| + Σ max |travel| [m]; ∞ if a prismatic joint has no limits.
        hand: (3,) where the last of the points on axes is in the task's frame [m], if that joint turns: a target pose
            fixes where it must be.
        length_to_hand: the sum without the last piece [m].
        least: no configuration takes the origin nearer to o: the longest piece without all the others [m].
        arms: (k,) the sums of what follows each joint: how far its axis is from the frame's origin at most [m].
    """

    o: Array
    length: float
    hand: Array | None
    length_to_hand: float
    least: float
    arms: Array

    def excess(self, goals: Array, counted: Array) -> Array:
        """Return by how much goals, (k, 4, 4) [m], are farther or nearer than the chain reaches: (k,).

        A negative one proves nothing. Of coordinates that do not count nothing is known, so just the others,
        counted (6,), enter |p_d − o|.
        """
        with np.errstate(over="ignore"):  # ∞ is far too
            away = np.linalg.norm((goals[:, :3, 3] - self.o) * counted[:3], axis=1)
            far = away - self.length
            if counted[:3].all():
                far = np.maximum(far, self.least - away)
            if self.hand is not None and counted.all():
                hand = goals[:, :3, :3] @ self.hand + goals[:, :3, 3]
                far = np.maximum(far, np.linalg.norm(hand - self.o, axis=1) - self.length_to_hand)
        return np.asarray(far)


def reach_bound(problem: PoseProblem) -> ReachBound:
    """Return the bound of a chain, with the points on the axes that make it least."""
    chain, coordinates = problem.chain, problem.coordinates[problem.active[problem.chain.coordinate]]
    P, turning = chain.placements, chain.prismatic == 0
    travel = chain.ratio * np.abs(coordinates[:, :2]).max(axis=1) / coordinates[:, 3]

    def pieces(shifts: Array) -> Array:
        """From the point shifted along each axis z to the next one, (k, 3); the last one leads to the frame."""
        shifts = np.append(shifts * turning, 0.0)
        return np.asarray(P[1:, :, 3] + shifts[1:, None] * P[1:, :, 2] - shifts[:-1, None] * np.array([0.0, 0.0, 1.0]))

    shifts = _shortest(P, turning)
    lengths = np.linalg.norm(pieces(shifts), axis=1)
    arms = np.cumsum((lengths + np.append(np.where(turning, 0.0, travel)[1:], 0.0))[::-1])[::-1]
    R, p = P[-1, :, :3], P[-1, :, 3]
    length = float(lengths.sum() + travel[~turning].sum())
    return ReachBound(
        o=problem.unit * (P[0, :, 3] + shifts[0] * P[0, :, 2]),
        length=problem.unit * length,
        hand=problem.unit * (R.T @ (np.array([0.0, 0.0, shifts[-1]]) - p)) if turning[-1] else None,
        length_to_hand=problem.unit * float(length - lengths[-1]),
        least=problem.unit * float(2 * lengths.max() - length),
        arms=problem.unit * arms,
    )


def _shortest(P: Array, turning: Array) -> Array:
    """Return the shifts along the axes, (k,), that make Σ |pieces| least, one after the other, again and again.

    The point on an axis from which the way to a and to b is shortest divides their feet a_z and b_z as their distances
    d_a and d_b from the axis. These are rounded up at first, so that no point sticks to another.
    """
    R, p = P[:, :, :3].tolist(), P[:, :, 3].tolist()
    shifts = [0.0] * len(turning)
    for sweep in range(SWEEPS):
        smooth, change = 0.5**sweep, 0.0
        for i in np.flatnonzero(turning).tolist():
            ahead = shifts[i + 1] if i + 1 < len(shifts) else 0.0
            b = [p[i + 1][row] + ahead * R[i + 1][row][2] for row in range(3)]
            foot, d_b = b[2], hypot(b[0], b[1], smooth)
            if i > 0:
                back = [-p[i][row] + (shifts[i - 1] if row == 2 else 0.0) for row in range(3)]
                a = [sum(R[i][row][column] * back[row] for row in range(3)) for column in range(3)]
                d_a = hypot(a[0], a[1], smooth)
                foot = (a[2] * d_b + b[2] * d_a) / (d_a + d_b) if d_a + d_b > 0 else 0.5 * (a[2] + b[2])
            change, shifts[i] = max(change, abs(foot - shifts[i])), foot
        if sweep > SMOOTHING and change < 1e-12:
            break
    return np.array(shifts)


class UnreachableProof:
    """Proofs that targets are out of reach, for one robot, one task and its limits: prepared once.

    At hand are the length of the arm, what no joint changes, and, for few joints, joint boxes that are excluded one
    by one. None of them succeeding proves nothing.
    """

    def __init__(self, problem: PoseProblem) -> None:
        self.problem, self.counted = problem, problem.pose_error.counted

    @cached_property
    def reach(self) -> ReachBound:
        """How far the chain reaches at most."""
        return reach_bound(self.problem)

    @cached_property
    def still(self) -> Motionless:
        """What no joint changes."""
        return motionless(self.problem.robot, self.problem.form)

    def at_once(self, goal: Array, linear: float, angular: float) -> bool:
        """Whether a goal, (4, 4), is farther from every q than the tolerances [m] and [rad], seen without a search."""
        return bool(self.all_at_once(goal[None], linear, angular)[0])

    def all_at_once(self, goals: Array, linear: float, angular: float) -> npt.NDArray[np.bool_]:
        """Return what `at_once` does, of goals (k, 4, 4): (k,)."""
        off, turned = self.still.excess(goals, self.counted, self.problem.pose_error.axis)
        size = self.problem.robot.reach + float(np.abs(self.still.p).max())
        still = (off > linear + 1e-12 * size) | (turned > angular + 1e-9)
        return np.asarray(still | (self.reach.excess(goals, self.counted) > linear + 1e-13 * size))

    @cached_property
    def _speeds(self) -> Array:
        """(2, n): by how much a unit of each coordinate moves the frame at most, in units, and turns it [rad]."""
        chain, n = self.problem.chain, len(self.problem.active)
        speeds = np.zeros((2, n))
        turning = chain.prismatic == 0
        np.add.at(
            speeds[0], chain.coordinate, chain.ratio * np.where(turning, self.reach.arms / self.problem.unit, 1.0)
        )
        np.add.at(speeds[1], chain.coordinate, chain.ratio * turning)
        position, turn = self.counted[:3].any(), self.counted[3:].any()
        return np.asarray(speeds * np.array([[float(position)], [float(turn)]]))

    @cached_property
    def _whole_box(self) -> Array | None:
        """The joint box as (2 n,), centre and half widths in units; None if it is not bounded."""
        own = self.problem.coordinates[self.problem.active]
        lower, upper, circular, unit = own.T
        low = np.where(circular > 0, -np.pi, lower / unit)
        high = np.where(circular > 0, np.pi, upper / unit)
        if not (np.isfinite([low, high]).all() and np.isfinite(self._speeds).all()):
            return None
        return np.concatenate([0.5 * low + 0.5 * high, 0.5 * high - 0.5 * low])

    def by_exclusion(self, goal: Array, linear: float, angular: float, *, seconds: float = np.inf) -> bool:
        """Whether every joint box can be excluded, before the time is over; 4000 boxes are looked at in any case."""
        if self._whole_box is None:
            return False
        n = len(self.problem.active)
        boxes = np.empty((SPLITS * n + 2, 2 * n))
        boxes[0] = self._whole_box
        scaled = np.array(goal[:3], dtype=float)
        with np.errstate(over="ignore"):
            scaled[:, 3] /= self.problem.unit
        links, _, _, task = self.problem.arrays(linear)
        tolerance = np.array([linear / self.problem.unit, angular])
        left, end = 1, perf_counter() + seconds
        for _ in range(0, MOST, AT_ONCE):
            left = exclude(links, task, scaled, self._speeds, tolerance, boxes, left, AT_ONCE)
            if left in (0, OPEN) or perf_counter() > end:
                break
        return left == 0


def is_out_of_reach(problem: ScaledTask, target: object) -> bool:
    """Whether it is proven that no q in the box of a problem reaches a target, in the form of the task's value.

    Of a user's function nothing is known, unless the robot has no joint.
    """
    robot, task = problem.robot, problem.task
    if robot.nq == 0:
        return True
    form = task.frame_map()
    if form is None or form.pose_error is None:
        return False
    if not problem.moving.any():
        return True
    goal = form.pose_error.goal(robot, target)
    proof = UnreachableProof(pose_problem(robot, task, (problem.lower, problem.upper)))
    linear, angular = 2 * REACHED * problem.length, 1e-8 if form.pose_error.by_angles else 2 * REACHED
    return proof.at_once(goal, linear, angular) or proof.by_exclusion(goal, linear, angular)
