"""How far any arm reaches: the largest and smallest distance from a point, or along a direction, between two bounds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from time import monotonic

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.axes import require_moving
from robotics1.workspaces.certified.extremes import Measure, extremes_of
from robotics1.workspaces.certified.objective import Objective
from robotics1.workspaces.certified.search import Search
from robotics1.workspaces.chain import driven_chain
from robotics1.workspaces.moving_point import position_rows

STARTS = 32  # at most, as far as a share of the time is enough
SHARE = 0.25
HOW = {
    "lengths": "the lengths of the links",
    "boxes": "bounds in boxes of configurations",
    "pivots": "the triangle inequality at points of the axes",
    "support function": "the support function of what is reached",
}
SAME = 1e-7  # of values that are one, by the arm's size
ROUNDING = 1e-10  # by which a bound is moved outwards, by the arm's size


@dataclass(frozen=True, eq=False)
class ExtremeReach(Frozen):
    """The largest or smallest value that a distance has inside the joint limits, between two bounds.

    Attributes:
        value: the distance that q attains [m].
        q: (nq,) a configuration that attains it [rad or m].
        point: (3,) where the tip is then, in world axes [m].
        bound: what no configuration exceeds; of a smallest value, what none is below [m].
        proven: whether value and bound are no farther apart than the tolerance.
        smallest: whether it is the smallest value, or else the largest.
        starts: the number of configurations from which it was sought, 32 where the time was enough.
        agreeing: the number of these that ended at this value.
        bounded_by: whence the bound is: the "lengths" of the links, "pivots" (the triangle inequality at points of
            axes), "boxes" of configurations, or the "support function" of what is reached.
        boxes: how many boxes of configurations were looked at.
        robot_name: the robot's name.
    """

    value: float
    q: Array
    point: Array
    bound: float
    proven: bool
    smallest: bool
    starts: int
    agreeing: int
    bounded_by: str
    boxes: int
    robot_name: str

    @property
    def gap(self) -> float:
        """How far the value and the bound are apart [m]."""
        return abs(self.bound - self.value)

    def explain(self) -> str:
        """Return the value and how sure it is, in sentences."""
        which, other = ("smallest", "less than") if self.smallest else ("largest", "more than")
        how = f"by {HOW[self.bounded_by]}"
        lines = [f"The {which} reach of {self.robot_name} is {self.value:.9g} m."]
        if self.proven:
            lines.append(f"That is proven {how}: no configuration has {other} {self.bound:.9g} m.")
        else:
            lines.append(
                f"It was found from {self.agreeing} of {self.starts} starts. No configuration has {other} "
                f"{self.bound:.9g} m, {how}; in between, {self.gap:.2g} m, a better one is not excluded. "
                f"A longer time_limit brings both nearer."
            )
        return "\n".join(lines)

    def require(self) -> ExtremeReach:
        """Return self if it is proven.

        Raises:
            NotConverged: the value and the bound are farther apart than the tolerance.
        """
        return require(self, self.proven)


def extreme_reach(
    robot: RobotLike,
    task: TaskLike,
    *,
    origin: npt.ArrayLike = (0.0, 0.0, 0.0),
    direction: npt.ArrayLike | None = None,
    smallest: bool = False,
    box: Mapping[str, tuple[float, float]] | None = None,
    tolerance: float = 1e-6,
    time_limit: float = 10.0,
) -> ExtremeReach:
    """Return max |p(q) − p₀| inside the limits, or max n·(p(q) − p₀) in a direction n, or the smallest of these.

    The value is found: from each start, a random configuration, L-BFGS-B climbs with the exact gradient Jᵀ (p − p₀) and
    the limits as bounds. The bound is proven: the joint ranges are cut into boxes |qᵢ − mᵢ| ≤ wᵢ. In each box |∂p/∂qᵢ|
    is at most ρᵢ, the largest distance from the axis of joint i; with that, Taylor's formula tells how far p can be at
    most. Boxes that can have a better value are halved. A joint that mimics another one moves with it. If more than
    three joints count, the triangle inequality at a point o of an axis gives a bound too, |p − p₀| ≤
    max |o − p₀| + max |p − o|: the right one if the arm can be stretched through o, as through a spherical shoulder or
    wrist. Where half of the time is not enough, a largest value, and any along a direction, is bounded by the support
    function as well, to some 1e-4 to 1e-3 of the arm's reach however many joints there are. Numbers are rounded as
    usual, not outwards; for that the bound is moved by 1e-10 of the reach.

    Args:
        robot: the arm.
        task: two or three coordinates of a point, as `PositionTask()`; of two, the distance is that in their plane.
        origin: (3,) the point p₀ in world axes [m]; by default the world's origin.
        direction: (3,) the direction n in world axes, of any length; by default the distance from p₀ is meant.
        smallest: whether the smallest value is sought.
        box: joint name → (lower, upper) [rad or m], inside the limits; needed for prismatic joints without limits.
        tolerance: between value and bound, at which the search ends [m].
        time_limit: after which it ends as it stands, or some seconds later [s]. Four joints that matter take seconds.

    Raises:
        InputError: a prismatic joint has neither limits nor a box, or a point, a direction or an option is wrong.
        TaskError: the task is no position, or no joint moves the point.

    Source: Horst, Tuy, Global Optimization, 3rd edition, 1996, chapter IV (branch and bound); Schneider, Convex Bodies,
    2nd edition, 2014, section 1.7 (support functions); Byrd, Lu, Nocedal, Zhu, SIAM J. Scientific Computing 16, 1995.
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    robot.require_single_coordinates("have a workspace")
    rows, frame = position_rows(task)
    centre = real_array("origin", origin, (3,), "a point in world axes [m]")
    n = _unit(direction)
    tolerance = real_number("tolerance", tolerance, positive=True)
    begun, time_limit = monotonic(), real_number("time_limit", time_limit, positive=True)
    chain = driven_chain(robot, frame, box)
    require_moving(chain.axes, robot)
    objective = Objective(chain, Measure(rows.T @ rows, centre, n), -1.0 if smallest else 1.0)
    for_starts = begun + time_limit * SHARE
    values, found = extremes_of(chain, objective.measure, STARTS, largest=not smallest, end=for_starts)
    best = int(np.argmin(values) if smallest else np.argmax(values))
    search = Search(objective, tolerance, begun + time_limit)
    sure, bounded_by = search.run(float(values[best]), found[best])
    q = np.clip(np.zeros(robot.nq), robot.lower, robot.upper)
    q[chain.numbers] = sure.q
    point = chain.point(sure.q[None])
    value, outwards = float(objective.measure.value(point)[0]), ROUNDING * robot.reach
    bound = objective.meant(sure.bound) + objective.sign * outwards
    bound = max(bound, 0.0) if smallest and n is None else bound
    return ExtremeReach(
        value=value,
        q=q,
        point=point[0],
        bound=bound,
        proven=bool(abs(value - bound) <= tolerance + outwards),
        smallest=bool(smallest),
        starts=len(values),
        agreeing=int((np.abs(values - value) < SAME * (robot.reach or 1.0)).sum()),
        bounded_by=bounded_by,
        boxes=sure.boxes,
        robot_name=robot.name,
    )


def _unit(direction: npt.ArrayLike | None) -> Array | None:
    if direction is None:
        return None
    n = real_array("direction", direction, (3,), "a direction in world axes")
    length = float(np.linalg.norm(n))
    if length == 0:
        raise InputError("direction must not be zero; for the distance from a point leave it out")
    return np.asarray(n / length)
