"""The copies of solutions by whole turns of their joints."""

from dataclasses import replace
from itertools import product

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_set import IKSolutions

MOST_WINDINGS = 100_000  # copies by whole turns that are listed


def with_windings(found: IKSolutions, problem: ScaledTask) -> IKSolutions:
    """Return the solutions with all that differ from them by whole turns inside limits that both end.

    Raises:
        InputError: there are more than `MOST_WINDINGS` of them.
    """
    lower, upper = problem.lower, problem.upper
    turning = problem.robot.revolute & problem.moving & np.isfinite(lower) & np.isfinite(upper)
    period = problem.turns.period
    least = np.where(turning, np.ceil((lower - found.q) / period - 1e-9), 0.0)
    most = np.where(turning, np.floor((upper - found.q) / period + 1e-9), 0.0)
    count = float(np.prod(most - least + 1, axis=1).sum())
    if count > MOST_WINDINGS:
        raise InputError(
            f"inside these limits the solutions have {count:.3g} copies by whole turns; at most {MOST_WINDINGS} are "
            f"listed: narrow the limits with box=, or leave windings out"
        )
    copies, sources = [], []
    for i, q in enumerate(found.q):
        ranges = zip(least[i].astype(int), most[i].astype(int), strict=True)
        for turns in product(*(range(a, b + 1) for a, b in ranges)):
            copies.append(q + np.where(turning, period, 0.0) * turns)
            sources.append(i)
    return replace(
        found,
        q=np.array(copies).reshape(len(copies), problem.robot.nq),
        singular=found.singular[sources],
        within_limits=found.within_limits[sources],
    )
