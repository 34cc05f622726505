"""Arms whose inverse kinematics falls into parts that have finitely many solutions by formula.

The joint axes are compared by their own numbers. A wrist whose axes miss each other by rounding counts as spherical;
what is found is then polished on the real arm.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.ik.elimination import elimination
from robotics1.ik.general_six import Roots
from robotics1.ik.joint_chain import FixedChain
from robotics1.ik.loops import LoopSolve, LoopSolver, loop_solver
from robotics1.ik.subproblems import inverse, one_row, orientation, planar_loop, point, turns_and_slides, two_rows
from robotics1.inputs import Array


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
    chain: FixedChain
    deviation: float
    solve: Callable[[Array], Array | None]
    loop: tuple[LoopSolver, int] | None = None
    roots: Callable[[Array], Roots | None] | None = None


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
    if sum(chain.prismatic) == 3:
        return ClosedForm("three turns in sequence", chain, 0.0, _turns_and_slides(chain))
    name, roots = elimination(chain)
    if roots is None:
        return None

    def solve(goal: Array) -> Array | None:
        found = roots(goal)
        return None if found is None else found.x

    return ClosedForm(name, chain, 0.0, solve, roots=roots)


def _turns_and_slides(chain: FixedChain) -> Callable[[Array], Array | None]:
    """Return the solver of three joints that turn and three that slide, in any order."""

    def solve(goal: Array) -> Array | None:
        P, T, unit = chain.scaled(goal)
        x = turns_and_slides([*P[1:6], P[6] @ inverse(T) @ P[0]], chain.prismatic)
        return chain.in_metres(x, unit)

    return solve


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
