"""What stays the same along a curve of solutions: joint coordinates, and sums and differences of them."""

from collections.abc import Iterator, Sequence
from itertools import combinations, product

import numpy as np
import numpy.typing as npt

from robotics1.angles import without_turns
from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array
from robotics1.notation import joint_value
from robotics1.robot.model import Robot

SAME = 1e-6  # [rad, m] by which what is constant may change, by rounding
TERMS = 4  # of a sum, at most
MOST = 10  # joints of one kind that change: of more no sums are looked for


def joint_relations(q: Array, problem: ScaledTask, same: float = SAME) -> tuple[str, ...]:
    """Return the equations, such as "q5 = 0" and "q4 + q6 = 0.7", that all configurations q (k, nq) of a curve satisfy.

    They are linear with the coefficients 1 and −1, and have four terms at most. Angles count modulo 2π. What is
    constant may change by `same` [rad, m]. Joints that do not move the task are free, and have no equation.
    """
    names, revolute = problem.robot.joint_names, problem.robot.revolute
    bound = [j for j, name in enumerate(names) if name not in problem.free_joints]
    changing = [j for j in bound if np.ptp(_from_the_first(q[:, j], turns=bool(revolute[j]))) > same]
    found = [_equation(q, problem.robot, (j,), (1,)) for j in bound if j not in changing]
    known = np.zeros((0, len(names)))
    for joints, signs in _sums(changing, revolute):
        coefficients = np.zeros(len(names))
        coefficients[list(joints)] = signs
        turns = bool(revolute[joints[0]])
        if np.ptp(_from_the_first(q @ coefficients, turns=turns)) > same:
            continue
        if np.linalg.matrix_rank([*known, coefficients]) > len(known):
            known = np.vstack([known, coefficients])
            found.append(_equation(q, problem.robot, joints, signs))
    return tuple(found)


def _from_the_first(values: Array, *, turns: bool) -> Array:
    """Return values − the first of them; of angles without whole turns."""
    d = values - values[0]
    return without_turns(d) if turns else d


def _sums(
    changing: Sequence[int], revolute: npt.NDArray[np.bool_]
) -> Iterator[tuple[tuple[int, ...], tuple[int, ...]]]:
    """Yield joints of one kind with their signs, the shorter sums first; the first sign is 1."""
    kinds = [[j for j in changing if revolute[j] == kind] for kind in (True, False)]
    for terms in range(2, TERMS + 1):
        for kind in kinds:
            for joints in combinations(kind if len(kind) <= MOST else [], terms):
                for signs in product((1, -1), repeat=terms - 1):
                    yield joints, (1, *signs)


def _equation(q: Array, robot: Robot, joints: tuple[int, ...], signs: tuple[int, ...]) -> str:
    value = float(q[0, list(joints)] @ signs)
    if robot.revolute[joints[0]]:
        value = float(without_turns(value))
    left = robot.joint_names[joints[0]]
    for j, sign in zip(joints[1:], signs[1:], strict=True):
        left += f" {'+' if sign > 0 else '−'} {robot.joint_names[j]}"
    return f"{left} = {joint_value(value)}"
