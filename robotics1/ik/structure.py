"""Arms whose inverse kinematics falls into parts that have finitely many solutions by formula.

The joint axes are compared by their own numbers. A wrist whose axes miss each other by rounding counts as spherical;
what is found is then polished on the real arm.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from robotics1.ik.elimination import elimination
from robotics1.ik.general_six import Roots
from robotics1.ik.joint_chain import FixedChain
from robotics1.ik.loops import LoopSolve, LoopSolver, loop_solver
from robotics1.ik.subproblems import one_row, orientation, planar_loop, point, turns_and_slides, two_rows
from robotics1.inputs import Array

Solve = Callable[[Array], Array | None]


@dataclass(frozen=True, eq=False)
class ClosedForm:
    """A way to all solutions.

    Attributes:
        method: its name.
        chain: of the joints that it finds.
        deviation: by how much the arm differs from one for which it is exact, relative.
        solve: goal (4, 4) in the task's axes → q modulo 2π, (k, n); None where they are not finitely many.
        loop: of six joints, how their loop is solved, and the joint at which it begins.
        roots: in place of `solve`, where some may be missing: goal → the same with what is known about the roots.
    """

    method: str
    chain: FixedChain
    deviation: float
    solve: Solve | None
    loop: tuple[LoopSolver, int] | None = None
    roots: Callable[[Array], Roots | None] | None = None

    def candidates(self, goal: Array) -> Roots | None:
        """Return what may be solutions of a goal; None where they are not finitely many, or not known."""
        if self.roots is not None:
            return self.roots(goal)
        x = None if self.solve is None else self.solve(goal)
        return None if x is None else Roots(x, np.zeros(len(x), dtype=bool), True)


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
        method, solve = "elimination to a polynomial", _of_a_point(chain, rows)
    elif rows == [3, 4, 5] and not any(chain.prismatic):
        method, solve = "three turns in sequence", _of_a_rotation(chain)
    elif len(rows) == 3 and rows[1] < 3 <= rows[2]:
        n = chain.P[0][:3, :3].T @ np.eye(3)[rows[2] - 3]
        method, solve = "the planar loop", _of_a_loop(chain, partial(planar_loop, prismatic=chain.prismatic, n=n))
    else:
        return None
    return ClosedForm(method, chain, 0.0, solve)


def _of_a_point(chain: FixedChain, rows: list[int]) -> Solve:
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
        return None if x is None else chain.in_metres(x, unit)

    return solve


def _of_a_rotation(chain: FixedChain) -> Solve:
    R = [P[:3, :3] for P in chain.P]
    return lambda goal: orientation(R[1:3], R[0].T @ goal[:3, :3] @ R[3].T)


def _of_a_loop(chain: FixedChain, solve: LoopSolve, begin: int = 0) -> Solve:
    """Return the solver of goals by one of the loop of the joints, which begins at one of them."""

    def solve_goal(goal: Array) -> Array | None:
        A, unit = chain.loop(goal)
        x = solve(A[begin:] + A[:begin])
        return None if x is None else chain.in_metres(np.roll(x, begin, axis=1), unit)

    return solve_goal


def _pose(chain: FixedChain) -> ClosedForm | None:
    """Return the solver of an arm with six joints: by three of them that are special, if there are, else by all."""
    for i in (3, 0, 1, 2):
        part = loop_solver(chain.P[1:6], chain.prismatic, i, chain.length)
        if part is not None:
            name = f"{part.name}, joints {i + 1} to {i + 3}"
            return ClosedForm(name, chain, part.deviation, _of_a_loop(chain, part.solve, i), (part, i))
    if sum(chain.prismatic) == 3:
        solve = partial(turns_and_slides, prismatic=chain.prismatic)
        return ClosedForm("three turns in sequence", chain, 0.0, _of_a_loop(chain, solve))
    name, roots = elimination(chain)
    return None if roots is None else ClosedForm(name, chain, 0.0, None, roots=roots)
