"""Inverse formulas are compared with Pinocchio before they are returned: at random q, with other lengths.

Every solution of the formulas must have the value of the target, and the q that made the target must be among them.
That each of many q is found, wherever it lies, shows that no solution is missing.
"""

from typing import Any

import numpy as np

from robotics1.angles import without_turns
from robotics1.errors import FormulaError
from robotics1.ik.closed_form.family import IKFormulas
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.symbolic.tasks.verification import Trials

AGREES = 1e-7  # relative: formulas lose digits near singular targets
TRIALS = 8  # configurations for each set of lengths


def verify(formulas: IKFormulas) -> None:
    """Compare formulas with numbers.

    Raises:
        FormulaError: a solution misses its target, or one is not among the formulas' own.
    """
    robot, rng = formulas.robot, np.random.default_rng(1)
    columns = [robot.joint_names.index(name) for name in formulas.in_order]
    inverse = formulas.function()
    for point in Trials(robot, (), ()).points:
        for _ in range(TRIALS):
            q = np.where(robot.revolute, rng.uniform(-3, 3, robot.nq), robot.reach * rng.uniform(-1, 1, robot.nq))
            target = formulas.task.value(point.robot, q)
            lengths = dict(zip(inverse.__kwdefaults__ or {}, map(np.float64, point.parameters.values()), strict=True))
            found = inverse(formulas.numbers(target), **lengths)
            _compare(formulas, point.robot, q, target, found, columns)


def _compare(formulas: IKFormulas, robot: Robot, q: Array, target: Any, found: Array, columns: list[int]) -> None:
    size = max(1.0, robot.reach)
    apart = []
    for values in found:
        p = q.copy()
        p[columns] = values
        error = np.abs(formulas.task.error(robot, p, target)).max(initial=0.0)
        if not error <= AGREES * size:
            raise FormulaError(f"a solution of the formulas misses its target by {error:.1e}")
        d = values - q[columns]
        apart.append(np.abs(np.where(robot.revolute[columns], without_turns(d), d)).max(initial=0.0))
    if not apart or min(apart) > 1e3 * AGREES * size:
        raise FormulaError("a solution that is known is not among those of the formulas")
