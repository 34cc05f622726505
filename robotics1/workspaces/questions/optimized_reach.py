"""How far any arm reaches: the largest and smallest distance from a point, or along a direction, by optimization."""

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.results import Frozen
from robotics1.robot.box import refuse_open_range
from robotics1.robot.given import RobotLike
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.reading import moving_point
from robotics1.workspaces.sampled.chain_map import ChainMap, chain_map
from robotics1.workspaces.sampled.extremes import Measure, extremes_of

STARTS = 32
SAME = 1e-7  # of values that are one, by the arm's size


@dataclass(frozen=True, eq=False)
class ExtremeReach(Frozen):
    """The largest or smallest value that a distance has inside the joint limits.

    Attributes:
        value: the distance [m].
        q: (nq,) a configuration that attains it [rad or m].
        point: (3,) where the tip is then, in world axes [m].
        smallest: whether it is the smallest value, or else the largest.
        starts: the number of configurations from which it was sought.
        agreeing: the number of these that ended at this value.
        bound: of a largest distance, the sum of the lengths of the links and strokes, which no configuration exceeds;
            of a smallest one 0; along a direction infinite [m].
        proven: whether the value is the bound, so that no search could have missed a better one.
        robot_name: the robot's name.
    """

    value: float
    q: Array
    point: Array
    smallest: bool
    starts: int
    agreeing: int
    bound: float
    proven: bool
    robot_name: str

    def explain(self) -> str:
        """Return the value and how sure it is, in sentences."""
        which = "smallest" if self.smallest else "largest"
        lines = [f"The {which} reach of {self.robot_name} is {self.value:.9g} m."]
        if self.proven:
            lines.append("No configuration can have a better one, since it is the bound of the lengths.")
        else:
            lines.append(
                f"It was found from {self.agreeing} of {self.starts} starts by optimization inside the limits. "
                "A better one is not excluded."
            )
        return "\n".join(lines)


def extreme_reach(
    robot: RobotLike,
    task: TaskLike,
    *,
    origin: npt.ArrayLike = (0.0, 0.0, 0.0),
    direction: npt.ArrayLike | None = None,
    smallest: bool = False,
    box: Mapping[str, tuple[float, float]] | None = None,
) -> ExtremeReach:
    """Return max |p(q) − p₀| inside the limits, or max n·(p(q) − p₀) in a direction n, or the smallest of these.

    Each start is a random configuration, from which L-BFGS-B climbs with the exact gradient Jᵀ (p − p₀)/|p − p₀| and
    the limits as bounds.

    Args:
        robot: the arm.
        task: two or three coordinates of a point, as `PositionTask()`; of two, the distance is that in their plane.
        origin: (3,) the point p₀ in world axes [m]; by default the world's origin.
        direction: (3,) the direction n in world axes, of any length; by default the distance from p₀ is meant.
        smallest: whether the smallest value is sought.
        box: joint name → (lower, upper) [rad or m], inside the limits; needed for prismatic joints without limits.

    Raises:
        InputError: a prismatic joint has neither limits nor a box, or a point or direction is wrong.
        TaskError: the task is no position, or no joint moves the point.

    Source: Byrd, Lu, Nocedal, Zhu, SIAM J. Scientific Computing 16, 1995 (L-BFGS-B).
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    rows, tip, axes = moving_point(robot, task, box)
    for axis in axes:
        if not axis.revolute:
            refuse_open_range(axis.name, axis.lower, axis.upper)
    centre = real_array("origin", origin, (3,), "a point in world axes [m]")
    chain = chain_map(axes, tip)
    measure = Measure(rows.T @ rows, centre, _unit(direction))
    values, found = extremes_of(chain, measure, STARTS, largest=not smallest)
    best = int(np.argmin(values) if smallest else np.argmax(values))
    bound = np.inf if direction is not None else 0.0 if smallest else _longest(chain, centre)
    near = SAME * (robot.reach or 1.0)
    q = np.clip(np.zeros(robot.nq), robot.lower, robot.upper)
    q[[axis.number for axis in axes]] = found[best]
    value = float(values[best])
    return ExtremeReach(
        value=value,
        q=q,
        point=chain.point(found[best][None])[0],
        smallest=smallest,
        starts=STARTS,
        agreeing=int((np.abs(values - value) < near).sum()),
        bound=float(bound),
        proven=bool(abs(value - bound) < near),
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


def _longest(chain: ChainMap, centre: Array) -> float:
    """Return the length of the way from a point along the joints to the tip, with all slides at their ends."""
    places = [centre, *(axis.point for axis in chain.axes if axis.revolute), chain.tip]
    slides = sum(max(abs(axis.lower), abs(axis.upper)) for axis in chain.axes if not axis.revolute)
    return slides + sum(float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(places))
