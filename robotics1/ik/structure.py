"""Arms whose inverse kinematics falls into parts that have finitely many solutions by formula.

The joint axes are compared by their own numbers. A wrist whose axes miss each other by rounding counts as spherical;
what is found is then polished on the real arm.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from robotics1.ik.loops import LoopSolve, loop_solver
from robotics1.ik.subproblems import inverse, motion, one_row, orientation, planar_loop, point, two_rows
from robotics1.inputs import Array
from robotics1.kernels.chain import chain_arrays
from robotics1.kinematics import reference_axes
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SAME = 1e-9  # of a multiplier that is 1


@dataclass(frozen=True)
class ClosedForm:
    """A way to all solutions.

    Attributes:
        method: its name.
        joints: which entries of q it finds, from the base to the tool.
        deviation: by how much the arm differs from one for which it is exact, relative.
        solve: goal (4, 4) in the task's axes → (k, n), q modulo 2π; None where they are not finitely many.
    """

    method: str
    joints: tuple[int, ...]
    deviation: float
    solve: Callable[[Array], Array | None]


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

    def scaled(self, goal: Array) -> tuple[list[Array], Array, float]:
        """Return the placements and a goal, (4, 4), with lengths of about 1, and what is one of them [m]."""
        unit = self.length + float(np.linalg.norm(goal[:3, 3] - self.P[0][:3, 3])) or 1.0
        scale = np.ones((4, 4))
        scale[:3, 3] = unit
        return [P / scale for P in self.P], goal / scale, unit

    def in_metres(self, x: Array | None, unit: float) -> Array | None:
        """Return coordinates (k, n) with lengths in metres."""
        return None if x is None else x * np.where(self.prismatic, unit, 1.0)


def fixed_chain(robot: Robot, task: Task, moving: Array, still: Array) -> FixedChain | None:
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


def closed_form(robot: Robot, task: Task, moving: Array, still: Array) -> ClosedForm | None:
    """Return the way to all solutions of a task that moves as many joints as it has rows; None if none is known."""
    form = task.frame_map()
    if form is None or form.pose_error is None or form.pose_error.axis.any():
        return None
    chain = fixed_chain(robot, task, moving, still)
    rows, n = sorted(form.pose_error.rows), int(np.count_nonzero(moving))
    if chain is None or len(rows) != n or len(chain.prismatic) != n:
        return None
    if n == 6:
        return _pose(chain)
    if max(rows) < 3:
        method, solve = "elimination to a polynomial", _position(chain, rows)
    elif rows == [3, 4, 5] and not any(chain.prismatic):
        method, solve = "three turns in sequence", _rotation(chain)
    elif len(rows) == 3 and rows[1] < 3 <= rows[2]:
        method, solve = "the planar loop", _planar_pose(chain, np.eye(3)[rows[2] - 3])
    else:
        return None
    return ClosedForm(method, chain.coordinate, 0.0, solve)


def _position(chain: FixedChain, rows: list[int]) -> Callable[[Array], Array | None]:
    """Return the solver of as many coordinates of a point as joints move it: one, two or three."""

    def solve(goal: Array) -> Array | None:
        P, T, unit = chain.scaled(goal)
        c, t = P[-1][:3, 3], T[:3, 3] - P[0][:3, 3]
        R = P[0][:3, :3]
        if len(rows) == 1:
            x = one_row(chain.prismatic[0], c, R[rows[0]], t[rows[0]])
        elif len(rows) == 2:
            x = two_rows(P[1], chain.prismatic, c, R[rows], t[rows])
        else:
            x = point(P[1:3], chain.prismatic, c, R.T @ t)
        return chain.in_metres(x, unit)

    return solve


def _rotation(chain: FixedChain) -> Callable[[Array], Array | None]:
    R = [P[:3, :3] for P in chain.P]
    return lambda goal: orientation(R[1:3], R[0].T @ goal[:3, :3] @ R[3].T)


def _planar_pose(chain: FixedChain, n: Array) -> Callable[[Array], Array | None]:
    def solve(goal: Array) -> Array | None:
        P, T, unit = chain.scaled(goal)
        B = [P[1], P[2], P[3] @ inverse(T) @ P[0]]
        return chain.in_metres(planar_loop(B, chain.prismatic, P[0][:3, :3].T @ n), unit)

    return solve


def _pose(chain: FixedChain) -> ClosedForm | None:
    """Return the solver of an arm with six joints, three of which, one after the other, are special."""
    for i in (3, 0, 1, 2):
        part = loop_solver(chain.P[1:6], chain.prismatic, i, chain.length)
        if part is not None:
            name = f"{part.name}, joints {i + 1} to {i + 3}"
            return ClosedForm(name, chain.coordinate, part.deviation, _around(chain, i, part.solve))
    return None


def _around(chain: FixedChain, i: int, solve: LoopSolve) -> Callable[[Array], Array | None]:
    """Return the solver that gives the loop Z₀ P₁ Z₁ ... Z₅ P₆ T⁻¹ P₀ = 1, beginning at joint i, to another one."""
    order = [(i + k) % 6 for k in range(6)]

    def from_joint_i(goal: Array) -> Array | None:
        P, T, unit = chain.scaled(goal)
        A = [*P[1:6], P[6] @ inverse(T) @ P[0]]
        found = solve([A[k] for k in order])
        if found is None:
            return None
        x = np.zeros((len(found), 6))
        x[:, order] = found
        return chain.in_metres(x, unit)

    return from_joint_i
