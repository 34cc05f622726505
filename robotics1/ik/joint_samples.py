"""One target at many values of a joint that stands still: at an end of the arm each value moves the goal instead."""

from collections.abc import Callable, Iterator, Mapping

import numpy as np

from robotics1.ik.joint_chain import fixed_chain
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array

UNMOVED = 1e-12  # of a placement, in metres


class LaterSolutions(Mapping[int, IKSolutions]):
    """Answers that are found when they are read, each once.

    Args:
        found: number → those that are known.
        later: the numbers of the others, which have no solution inside the limits.
        find: a number → its answer.
    """

    def __init__(self, found: dict[int, IKSolutions], later: list[int], find: Callable[[int], IKSolutions]) -> None:
        self.missed, self._found, self._find = later, found, find
        self._numbers = sorted({*found, *later})

    def __getitem__(self, i: int) -> IKSolutions:
        if i not in self._found:
            if i not in self._numbers:
                raise KeyError(i)
            self._found[i] = self._find(i)
        return self._found[i]

    def __iter__(self) -> Iterator[int]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)


def moves_of_goals(problem: ScaledTask, joint: int, values: Array) -> tuple[Array, Array] | None:
    """Return L and R, (k, 4, 4): with the joint at value i, a goal T has the solutions of L_i T R_i with it as is.

    None unless the joint comes before or behind all joints that move, so that it changes just the first placement P₀
    or the last one P_n: P₀' M P_n' = T is P₀ M P_n = P₀ P₀'⁻¹ T P_n'⁻¹ P_n.
    """
    now = fixed_chain(problem)
    before, behind = [], []
    for value in values:
        still = problem.middle.copy()
        still[joint] = value
        then = fixed_chain(problem, still)
        if now is None or then is None:
            return None
        if any(np.abs(P - Q).max() > UNMOVED for P, Q in zip(now.P[1:-1], then.P[1:-1], strict=True)):
            return None
        before.append(now.P[0] @ np.linalg.inv(then.P[0]))
        behind.append(np.linalg.inv(then.P[-1]) @ now.P[-1])
    return np.array(before), np.array(behind)
