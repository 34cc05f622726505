"""The joints that move a task, the others standing still: placements, poses, Jacobians, Newton's method."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.ik.subproblems import motion, motions
from robotics1.inputs import Array
from robotics1.kernels.chain import chain_arrays
from robotics1.kinematics import reference_axes
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SAME = 1e-9  # of a multiplier that is 1
STEPS = 20  # of Newton's method
RANK = 1e-9  # σ beside σ₁, in one of its steps
EXACT = 1e-15  # |e|, lengths relative to the arm, at which it ends


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

    def in_metres(self, x: Array | None, unit: float) -> Array | None:
        """Return coordinates (k, n) with lengths in metres."""
        return None if x is None else x * np.where(self.prismatic, unit, 1.0)

    def poses_and_jacobians(self, x: Array) -> tuple[Array, Array]:
        """Return T(x), (k, 4, 4), and the frame's Jacobians, (k, 6, n), in the task's axes."""
        T = np.broadcast_to(self.P[0], (len(x), 4, 4))
        axes, origins = [], []
        for i, slides in enumerate(self.prismatic):
            axes.append(T[:, :3, 2])
            origins.append(T[:, :3, 3])
            T = T @ motions(slides, x[:, i]) @ self.P[i + 1]
        p = T[:, :3, 3]
        columns = [
            np.hstack([z, 0 * z] if slides else [np.cross(z, p - o), z])
            for slides, z, o in zip(self.prismatic, axes, origins, strict=True)
        ]
        return T, np.stack(columns, axis=2)

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


def fixed_chain(robot: Robot, task: Task, moving: npt.NDArray[np.bool_], still: Array) -> FixedChain | None:
    """Return the chain of a task's frame in the task's axes; None if a joint follows another.

    Args:
        robot: the robot.
        task: on one frame.
        moving: (nq,) which joints move the task.
        still: (nq,) where the others stand [rad or m].
    """
    form = task.frame_map()
    if form is None:
        return None
    chain = chain_arrays(robot, form.frame, axes=reference_axes(robot, np.zeros(robot.nq), form.reference))
    if len(set(chain.coordinate)) < len(chain.coordinate) or np.abs(chain.ratio - 1.0).max(initial=0.0) > SAME:
        return None
    placements, kinds, coordinate = [], [], []
    T = np.eye(4)
    for P, prismatic, j in zip(chain.placements, chain.prismatic, chain.coordinate, strict=False):
        T = T @ np.vstack([P, [0, 0, 0, 1]])
        if moving[j]:
            placements.append(T)
            kinds.append(bool(prismatic))
            coordinate.append(int(j))
            T = np.eye(4)
        else:
            T = T @ motion(bool(prismatic), still[j])
    placements.append(T @ np.vstack([chain.placements[-1], [0, 0, 0, 1]]))
    length = sum(float(np.linalg.norm(P[:3, 3])) for P in placements[1:])
    return FixedChain(tuple(placements), tuple(kinds), tuple(coordinate), length)
