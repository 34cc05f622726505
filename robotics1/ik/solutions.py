"""Every inverse kinematics solution of a target."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from itertools import product
from typing import Any, Literal

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.prepared import prepare
from robotics1.ik.scaled_task import ScaledTask, kept_for_poses
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.solutions_by_search import searched
from robotics1.inputs import counting_number, one_of, true_or_false
from robotics1.robot.given import RobotLike
from robotics1.tasks.given import TaskLike, robot_and_task

Method = Literal["auto", "search"]
MOST_WINDINGS = 100_000  # copies by whole turns that are listed


def ik_solutions(
    robot: RobotLike,
    task: TaskLike,
    target: Any,
    *,
    method: Method = "auto",
    windings: bool = False,
    box: Mapping[str, tuple[float, float]] | None = None,
    locked: Mapping[str, float] | None = None,
    starts: int | None = None,
    seed: int = 0,
) -> IKSolutions:
    """Return the solutions of f(q) = r_d inside the joint limits.

    Where as many joints move the task as it has rows, and the joint axes allow, all solutions follow from polynomials:
    one to three joints that move a point, a planar pose or an orientation; six joints, three of which, one after the
    other, have axes through a point (a spherical wrist) or move in a plane (three parallel axes, as UR arms have); six
    joints of any geometry, three of which may slide, by elimination. An arm with fewer joints than rows has the
    solutions of one with more joints in which the added ones stand still. Each solution is polished by Newton's method
    on the robot itself, and verified. `complete` then says that there are no others (of six joints not where two
    solutions meet, since rounding may hide a third), `method` how they were found, and BOUNDARY that two of them meet,
    or nearly do: `boundary_distance` says how far the target is from there.

    Otherwise a search runs damped least squares from random starts and keeps what differs. It can miss a solution, so
    that `complete` is False where it has found some. It tells BOUNDARY as well. Of a redundant arm `dimension` is
    n − ρ, the joints that move the task less the rank of J, where J has this rank. UNREACHABLE is proven; a search that
    finds nothing is NOT_FOUND.

    A row of a `FunctionTask` with the unit "rad" is taken modulo 2π. Without units a row that counts turns, as q1 + q3
    does, has its own value: joints are turned as far as their limits allow until it is the target's. A row that is
    an angle of the frame about a fixed axis, or jumps by 2π as atan2 does, is taken modulo 2π where that fails.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        target: r_d, in the form of the task's value.
        method: "auto", or "search" to search in any case.
        windings: whether to list also what differs by whole turns, inside limits that both end.
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits that move the task.
        locked: joint name → value [rad or m], of joints that stand still: a redundant arm then has finitely many
            solutions.
        starts: the number of random starts of a search; None for as many as leave half a solution to be expected.
        seed: of the random starts.

    Raises:
        InputError: the target has the wrong form, or a prismatic joint has neither limits nor a box.
        TaskError: the task does not fit the robot, or its axes move.

    Source: Pieper, The kinematics of manipulators under computer control, 1968; Siciliano, Sciavicco, Villani, Oriolo,
    Robotics, 2009, section 2.12.
    """
    robot, task = robot_and_task(robot, task)
    one_of("method", method, ("auto", "search"))
    windings = true_or_false("windings", windings)
    seed = counting_number("seed", seed)
    starts = None if starts is None else counting_number("starts", starts, least=1)
    task.check_integrable(robot)
    target = task.target(target)
    prepared = _kept(robot, task) if box is None and not locked else prepare(robot, task, box, locked)
    if method == "search":
        found = searched(prepared.problem, target, starts, seed)
    else:
        found = prepared.solve(target, starts, seed)
    return _with_windings(found, prepared.problem) if windings else found


_kept = kept_for_poses(prepare)


def _with_windings(found: IKSolutions, problem: ScaledTask) -> IKSolutions:
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
