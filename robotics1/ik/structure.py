"""Arms whose inverse kinematics falls into parts that have finitely many solutions by formula.

The joint axes are compared by their own numbers. A wrist whose axes miss each other by rounding counts as spherical;
what is found is then polished on the real arm.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from robotics1.ik.general_six import Roots, general_loop
from robotics1.ik.loops import LoopSolve, LoopSolver, loop_solver
from robotics1.ik.subproblems import inverse, motion, motions, one_row, orientation, planar_loop, point, two_rows
from robotics1.inputs import Array
from robotics1.kernels.chain import chain_arrays
from robotics1.kinematics import reference_axes
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SAME = 1e-9  # of a multiplier that is 1
SAMPLES = 5  # poses at which an elimination is tried
STEPS = 20  # of Newton's method
RANK = 1e-9  # σ beside σ₁, in one of its steps
EXACT = 1e-15  # |e|, lengths relative to the arm, at which it ends


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """A way to all solutions.

    Attributes:
        method: its name.
        chain: of the joints that it finds.
        deviation: by how much the arm differs from one for which it is exact, relative.
        solve: goal (4, 4) in the task's axes → (k, n), q modulo 2π; None where they are not finitely many.
        loop: of six joints, how their loop is solved, and the joint at which it begins.
        roots: of six joints without special geometry, goal → the same with what is known about the roots.
    """

    method: str
    chain: "FixedChain"
    deviation: float
    solve: Callable[[Array], Array | None]
    loop: tuple[LoopSolver, int] | None = None
    roots: Callable[[Array], Roots | None] | None = None


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
        length = self.length + float(np.linalg.norm(goal[:3, 3] - self.P[0][:3, 3])) or 1.0
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


def closed_form(chain: FixedChain, rows: Sequence[int]) -> ClosedForm | None:
    """Return the way to all solutions of as many rows of a pose as there are joints; None if none is known.

    Args:
        chain: the joints that move the rows.
        rows: of (p, turn), in ascending order.
    """
    rows = list(rows)
    if len(chain.prismatic) == 6:
        return _pose(chain)
    if max(rows) < 3:
        method, solve = "elimination to a polynomial", _position(chain, rows)
    elif rows == [3, 4, 5] and not any(chain.prismatic):
        method, solve = "three turns in sequence", _rotation(chain)
    elif len(rows) == 3 and rows[1] < 3 <= rows[2]:
        method, solve = "the planar loop", _planar_pose(chain, np.eye(3)[rows[2] - 3])
    else:
        return None
    return ClosedForm(method, chain, 0.0, solve)


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
    """Return the solver of an arm with six joints: by three of them that are special, if there are, else by all."""
    for i in (3, 0, 1, 2):
        part = loop_solver(chain.P[1:6], chain.prismatic, i, chain.length)
        if part is not None:
            name = f"{part.name}, joints {i + 1} to {i + 3}"
            return ClosedForm(name, chain, part.deviation, _around(chain, i, part.solve), (part, i))
    roots = _elimination(chain)
    if roots is None:
        return None

    def solve(goal: Array) -> Array | None:
        found = roots(goal)
        return None if found is None else found.x

    return ClosedForm("elimination to an eigenvalue problem", chain, 0.0, solve, roots=roots)


def _elimination(chain: FixedChain) -> Callable[[Array], Roots | None] | None:
    """Return the solver of six joints without special geometry; None if it proves nothing at poses of the arm.

    The loop may begin at any joint before one that turns; those that prove most are tried first.
    """
    orders = [[(i + k) % 6 for k in range(6)] for i in range(6) if not chain.prismatic[i - 1]]
    x = np.random.default_rng(0).uniform(-1, 1, (SAMPLES, 6)) * np.where(chain.prismatic, chain.length or 1.0, np.pi)
    goals = chain.poses_and_jacobians(x)[0]
    found = [[_roots_in_order(chain, order, goal) for goal in goals] for order in orders]
    proofs = [sum(roots is not None and roots.proven for roots in row) for row in found]
    best = [orders[k] for k in sorted(range(len(orders)), key=lambda k: -proofs[k]) if proofs[k] > 0][:3]

    def roots(goal: Array) -> Roots | None:
        """Return the roots that are proven to be all, or some."""
        some = None
        for order in best:
            found = _roots_in_order(chain, order, goal)
            if found is not None and found.proven:
                return found
            some = found if some is None else some
        return some

    return roots if best else None


def _roots_in_order(chain: FixedChain, order: list[int], goal: Array) -> Roots | None:
    """Return the roots of the loop whose joints stand in that order."""
    P, T, unit = chain.scaled(goal)
    A = [*P[1:6], P[6] @ inverse(T) @ P[0]]
    around, slides = [A[k] for k in order], [chain.prismatic[k] for k in order]
    found = general_loop(around, slides).roots(around)
    if found is None:
        return None
    x = np.zeros((len(found.x), 6))
    x[:, order] = found.x
    return replace(found, x=x * np.where(chain.prismatic, unit, 1.0))


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
