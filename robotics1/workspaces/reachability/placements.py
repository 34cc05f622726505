"""Where to put the base for a list of poses, or a path for the arm: each place is tried with all poses."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.caching import cached_property
from robotics1.chunks.pace import Pace, Progress
from robotics1.chunks.workers import check_executor, check_progress, workers_of
from robotics1.errors import InputError, TaskError
from robotics1.ik.goals import numbered
from robotics1.ik.solver import list_of_targets
from robotics1.inputs import Array, dimensions, one_of, real_array, real_number
from robotics1.notation import count, vector
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.robot.placements import homogeneous
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import PoseError
from robotics1.workspaces.reachability.chunk import positions_in_a_chunk
from robotics1.workspaces.reachability.evaluation import (
    Codes,
    PoseAnswers,
    PoseQuestion,
    PoseStatus,
    evaluator_of,
    question_of,
)
from robotics1.workspaces.reachability.poses import refuse_no_rotations, refuse_too_many

Moves = Literal["base", "poses"]
MOVES: tuple[Moves, ...] = get_args(Moves)
AXES = ("x", "y", "z", "turn")
IN_PLANE = 1e-9


@dataclass(frozen=True, eq=False)
class Placements(Frozen):
    """How b places suit n poses.

    Attributes:
        robot: the name of the robot.
        moves: what is put there: the "base" of the arm, or the "poses" as one piece.
        places: (b, 4, 4).
        status: (b, n) of `PoseStatus`.
        solutions: (b, n) how many configurations reach a pose, 255 where that is not known; None where they are not
            counted.
        manipulability: (b,) the least over the poses of the largest √det(J Jᵀ) found; NaN unless all are reached.
        limit_margin: (b,) the least over the poses of the largest distance from the joint limits, 1 in the middle and
            0 at a limit, as `ReachabilityMap` has it; NaN unless all are reached.
    """

    robot: str
    moves: str
    places: Array = field(repr=False)
    status: Codes
    solutions: Codes | None
    manipulability: Array
    limit_margin: Array

    def __len__(self) -> int:
        return len(self.places)

    @cached_property
    def reached(self) -> npt.NDArray[np.int64]:
        """(b,) how many of the poses are reached from each place."""
        return np.asarray(np.count_nonzero(self.status == PoseStatus.REACHED, axis=1))

    @cached_property
    def order(self) -> npt.NDArray[np.intp]:
        """(b,) the places, the best first: by the poses that are reached, then by manipulability."""
        return np.lexsort((-np.nan_to_num(self.manipulability), -self.reached))

    @property
    def best(self) -> int:
        """The number of the best place."""
        return int(self.order[0])

    def explain(self) -> str:
        """Return how many places suit all poses, and which is the best, in sentences."""
        n, best = self.status.shape[1], self.best
        good = int(np.count_nonzero(self.reached == n))
        T = self.places[best]
        where = f"p = {vector(T[:3, 3])} m, turned by {vector(pin.log3(T[:3, :3]))} rad"
        lines = [f"{self.robot}: {good} of {count(len(self), 'place')} for the {self.moves} reach all {n} poses."]
        if not good:
            unsure = " (what was not found may be in reach)" if (self.status == PoseStatus.NOT_FOUND).any() else ""
            lines.append(f"The best is number {best}, {where}: it reaches {self.reached[best]}{unsure}.")
        else:
            lines.append(
                f"The best is number {best}, {where}: there the manipulability is {self.manipulability[best]:.4g} at "
                f"least, and the limit margin {self.limit_margin[best]:.4g}."
            )
        return "\n".join(lines)

    def require(self) -> Placements:
        """Return self if a place suits all poses.

        Raises:
            NotConverged: none does.
        """
        return require(self, bool((self.reached == self.status.shape[1]).any()))


def best_placements(
    robot: RobotLike,
    task: TaskLike,
    poses: Any,
    places: Any,
    *,
    moves: Moves = "base",
    starts: int = 16,
    seed: int = 0,
    tolerance: float = 1e-6,
    configurations: int = 1,
    executor: Executor | Any | None = None,
    progress: Progress | None = None,
) -> Placements:
    """Try every place for the base of an arm, or for a list of poses, and return how well each suits all of them.

    With the base at B, a pose T_d in the world is B⁻¹ T_d for the arm; with the poses moved by X it is X T_d. Each is
    answered as `reachability_map` does it. That all poses of a path are reached does not mean that the arm can go
    from one to the next without a jump.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: of one frame's pose, in the axes of the world.
        poses: the targets, in the form of the task's value.
        places: (b, 4, 4) or a list of `pin.SE3`; or a grid of some of x, y, z [m] and turn, about z [rad], such as
            {"x": np.linspace(-1, 1, 21), "y": np.linspace(-1, 1, 21), "turn": [0, pi / 2]}.
        moves: what is put there: the "base", or the "poses" as one piece.
        starts, seed, tolerance, configurations, executor: as `reachability_map` has them.
        progress: called after each chunk with the poses done and their number.

    Raises:
        InputError: there is no pose or no place, one has the wrong form, a place turns the poses out of the plane of
            the task, or an option has a wrong value.
        TaskError: the task does not fit the robot, or is none of one frame's pose in the world.

    Source: Vahrenkamp, Asfour, Dillmann, Robot placement based on reachability inversion, ICRA 2013.
    """
    robot, task = robot_and_task(robot, task)
    question = question_of(robot, task, starts, seed, tolerance, configurations)
    form = task.frame_map()
    if form is None or form.pose_error is None or form.reference != "world":
        raise TaskError("places are tried with a task on the pose of one frame in the world, such as PoseTask()")
    one_of("moves", moves, MOVES)
    check_executor(executor)
    check_progress(progress)
    goals = _goals(robot, form.pose_error, poses)
    X = _places(places)
    moved = np.linalg.inv(X) if moves == "base" else X
    _refuse_out_of_plane(form.pose_error, moved)
    refuse_too_many(float(len(X)) * len(goals))
    found = _tried(question, goals, moved, executor, progress)
    return _judged(robot, moves, X, found, counts=evaluator_of(question.packed()).counts)


def tried(packed: bytes, goals: Array, moved: Array) -> PoseAnswers:
    """Return what is known of goals (n, 4, 4) moved by each of some transforms (b, 4, 4): this runs in the workers."""
    all_goals = np.ascontiguousarray((moved[:, None] @ goals).reshape(-1, 4, 4))
    return evaluator_of(packed).answers(all_goals)._replace(q=np.zeros((0, 0)))


def _tried(
    question: PoseQuestion, goals: Array, moved: Array, executor: Any, progress: Progress | None
) -> list[PoseAnswers]:
    size, found = positions_in_a_chunk(len(moved), len(goals)), []
    pace = Pace("poses", "fewer places, or give it to a cluster (executor=)", progress)
    packed = question.packed()
    sendable = evaluator_of(packed).measurement.sendable
    with workers_of(executor, sendable=sendable) as workers:
        parts = (moved[i : i + size] for i in range(0, len(moved), size))
        for answer in workers.in_order(partial(tried, packed, goals), parts):
            found.append(answer)
            pace(sum(len(part.status) for part in found), len(moved) * len(goals))
    return found


def _judged(robot: Robot, moves: str, places: Array, found: list[PoseAnswers], *, counts: bool) -> Placements:
    """Return what the worst pose of each place tells."""
    columns = zip(*(part[:4] for part in found), strict=True)
    status, solutions, values, margins = (np.concatenate(parts).reshape(len(places), -1) for parts in columns)
    every = (status == PoseStatus.REACHED).all(axis=1)
    worst, margin = (np.where(every, measure.min(axis=1), np.nan) for measure in (values, margins))
    return Placements(robot.name, moves, places, status, solutions if counts else None, worst, margin)


def _goals(robot: Robot, error: PoseError, poses: Any) -> Array:
    goals = []
    for i, target in enumerate(list_of_targets(poses)):
        with numbered(i):
            goals.append(error.goal(robot, target))
    return np.array(goals)


def _places(places: Any) -> Array:
    """Return the transforms (b, 4, 4) of places."""
    if isinstance(places, np.ndarray) and places.ndim == 3:
        X = real_array("places", places, (None, 4, 4), "transforms")
        refuse_no_rotations("the rotations of places", X[:, :3, :3])
        X[:, 3] = (0, 0, 0, 1)
        return X
    if not isinstance(places, Mapping):
        listed = enumerate(list_of_targets(places))
        return np.array([homogeneous(f"places[{i}]", place).homogeneous for i, place in listed])
    if not set(places) <= set(AXES) or not places:
        raise InputError(f"a grid of places has some of {', '.join(AXES)}; it has {', '.join(map(str, places))}")
    axes = []
    for name in AXES:
        value = places.get(name, 0.0)
        values = [real_number(f"places[{name!r}]", value)] if dimensions(f"places[{name!r}]", value) == 0 else value
        axes.append(real_array(f"places[{name!r}]", values, (None,), "the values of a coordinate"))
    x, y, z, turn = (values.ravel() for values in np.meshgrid(*axes, indexing="ij"))
    if not len(x):
        raise InputError("there is no place in places")
    X = np.tile(np.eye(4), (len(x), 1, 1))
    X[:, 0, 0] = X[:, 1, 1] = np.cos(turn)
    X[:, 1, 0] = np.sin(turn)
    X[:, 0, 1] = -X[:, 1, 0]
    X[:, :3, 3] = np.column_stack([x, y, z])
    return X


def _refuse_out_of_plane(error: PoseError, moved: Array) -> None:
    """Refuse a turn that mixes coordinates that the task has with such as it has not."""
    own = [row for row in error.rows if row < 3]
    rest = [row for row in range(3) if row not in own]
    if own and np.abs(moved[:, own][:, :, rest]).max(initial=0.0) > IN_PLANE:
        letters = ", ".join("xyz"[row] for row in own)
        raise InputError(f"a place turns the poses out of the coordinates {letters} that the task has")
