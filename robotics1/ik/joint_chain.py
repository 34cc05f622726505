"""The joints that move a task, the others standing still: placements, poses, Jacobians, Newton's method."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.subproblems import inverse, motion, motions
from robotics1.inputs import Array
from robotics1.kernels.chain import chain_arrays
from robotics1.kinematics import reference_axes

SAME = 1e-9  # of a multiplier that is 1
STEPS = 20  # of Newton's method
RANK = 1e-9  # σ beside σ₁, in one of its steps
EXACT = 1e-15  # |e|, lengths relative to the arm, at which it ends


class JointLines(NamedTuple):
    """The axes of n joints as lines in space, at k configurations, and the pose of the frame.

    Attributes:
        z: (k, n, 3) their directions.
        o: (k, n, 3) a point on each [m].
        T: (k, 4, 4) the frame's pose.
    """

    z: Array
    o: Array
    T: Array

    @property
    def p(self) -> Array:
        """(k, 3) the frame's origin [m]."""
        return self.T[:, :3, 3]


@dataclass(frozen=True, eq=False)
class FixedChain:
    """P₀ Z₀ P₁ Z₁ ... P_n: the joints that move a task, the others standing still.

    Attributes:
        P: (n+1) placements (4, 4) [m].
        prismatic: (n,) of each joint.
        coordinate: (n,) its entry of q.
        length: what counts as one length [m].
    """

    P: tuple[Array, ...]
    prismatic: tuple[bool, ...]
    coordinate: tuple[int, ...]
    length: float

    def unit(self, goal: Array) -> float:
        """Return the length of the arm and of its way to a goal [m], whose square may be no number."""
        return self.length + float(np.hypot.reduce(goal[:3, 3] - self.P[0][:3, 3])) or 1.0

    def scaled(self, goal: Array) -> tuple[list[Array], Array, float]:
        """Return the placements and a goal, (4, 4), with lengths of about 1, and what is one of them [m]."""
        unit = self.unit(goal)
        scale = np.ones((4, 4))
        scale[:3, 3] = unit
        return [P / scale for P in self.P], goal / scale, unit

    def loop(self, goal: Array) -> tuple[list[Array], float]:
        """Return A of Z₀ A₀ Z₁ A₁ ... Z_{n−1} A_{n−1} = 1 where the frame is at a goal, and what is one length [m]."""
        P, T, unit = self.scaled(goal)
        return [*P[1:-1], P[-1] @ inverse(T) @ P[0]], unit

    def in_metres(self, x: Array, unit: float) -> Array:
        """Return coordinates (k, n) with lengths in metres."""
        return x * np.where(self.prismatic, unit, 1.0)

    def lines(self, x: Array) -> JointLines:
        """Return the joint axes and the frame's pose at coordinates x (k, n) [rad or m], in the task's axes."""
        T = np.broadcast_to(self.P[0], (len(x), 4, 4))
        before = []
        for i, slides in enumerate(self.prismatic):
            before.append(T[:, :3])
            T = T @ motions(slides, x[:, i]) @ self.P[i + 1]
        joints = np.stack(before, axis=1)
        return JointLines(joints[..., 2], joints[..., 3], T)

    def poses_and_jacobians(self, x: Array) -> tuple[Array, Array]:
        """Return T(x), (k, 4, 4), and the frame's Jacobians, (k, 6, n), in the task's axes."""
        lines, slides = self.lines(x), np.array(self.prismatic)[:, None]
        linear = np.where(slides, lines.z, np.cross(lines.z, lines.p[:, None] - lines.o))
        columns = np.concatenate([linear, np.where(slides, 0.0, lines.z)], axis=2)
        return lines.T, columns.transpose(0, 2, 1)

    def polished(self, x: Array, goal: Array, rows: Sequence[int]) -> tuple[Array, Array]:
        """Return coordinates (k, n) after Newton's method, and σ_min/σ_max of the Jacobian, (k,).

        Some rows of (p_d − p, log3(R_d Rᵀ)) vanish there. The rotation that is missing is small, so that it is read
        from the skew part of R_d Rᵀ.
        """
        length = self.unit(goal)
        row_units = np.array([length] * 3 + [1.0] * 3)[list(rows)]
        units = np.where(self.prismatic, length, 1.0)
        best, least = x, np.full(len(x), np.inf)
        for _ in range(STEPS):
            T, J = self.poses_and_jacobians(x)
            M = goal[:3, :3] @ T[:, :3, :3].transpose(0, 2, 1)
            turn = 0.5 * np.stack([M[:, 2, 1] - M[:, 1, 2], M[:, 0, 2] - M[:, 2, 0], M[:, 1, 0] - M[:, 0, 1]], axis=1)
            e = np.hstack([goal[:3, 3] - T[:, :3, 3], turn])[:, rows] / row_units
            J = J[:, rows] * units / row_units[:, None]
            size = np.abs(e).max(axis=1, initial=0.0)
            better = size < 0.5 * least
            best = np.where((size < least)[:, None], x, best)
            least = np.minimum(size, least)
            if not (better & (least > EXACT)).any():
                break
            x = best + units * (np.linalg.pinv(J, rcond=RANK) @ e[..., None])[..., 0]
        J = self.poses_and_jacobians(best)[1][:, rows] * units / row_units[:, None]
        sigma = np.linalg.svd(J, compute_uv=False)
        return best, sigma[:, -1] / np.maximum(sigma[:, 0], 1e-300)


def chain_and_rows(problem: ScaledTask) -> tuple[FixedChain | None, tuple[int, ...]]:
    """Return the chain of the joints that move a task, and which rows of a pose it has; (None, ()) if it is no such."""
    form = problem.task.frame_map()
    if form is None or form.pose_error is None or form.pose_error.axis.any() or not problem.moving.any():
        return None, ()
    chain = fixed_chain(problem)
    if chain is None or len(chain.prismatic) != np.count_nonzero(problem.moving):
        return None, ()
    return chain, tuple(sorted(form.pose_error.rows))


def fixed_chain(problem: ScaledTask, still: Array | None = None) -> FixedChain | None:
    """Return the chain of a task's frame in the task's axes; None if a joint follows another.

    Args:
        problem: a task on one frame.
        still: (nq,) where the joints that do not move it stand [rad or m]; None for the middle of the box.
    """
    robot, form = problem.robot, problem.task.frame_map()
    still = problem.middle if still is None else still
    if form is None:
        return None
    chain = chain_arrays(robot, form.frame, axes=reference_axes(robot, np.zeros(robot.nq), form.reference))
    if len(set(chain.coordinate)) < len(chain.coordinate) or np.abs(chain.ratio - 1.0).max(initial=0.0) > SAME:
        return None
    placements, kinds, coordinate = [], [], []
    T = np.eye(4)
    for P, prismatic, j in zip(chain.placements, chain.prismatic, chain.coordinate, strict=False):
        T = T @ np.vstack([P, [0, 0, 0, 1]])
        if problem.moving[j]:
            placements.append(T)
            kinds.append(bool(prismatic))
            coordinate.append(int(j))
            T = np.eye(4)
        else:
            T = T @ motion(bool(prismatic), still[j])
    placements.append(T @ np.vstack([chain.placements[-1], [0, 0, 0, 1]]))
    length = sum(float(np.linalg.norm(P[:3, 3])) for P in placements[1:])
    return FixedChain(tuple(placements), tuple(kinds), tuple(coordinate), length)
