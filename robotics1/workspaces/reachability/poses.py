"""The poses of a map: positions, and at each of them the same orientations."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from robotics1.angles import TURN
from robotics1.errors import InputError, TaskError
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.proof import motionless, reach_bound
from robotics1.inputs import Array, counting_number, dimensions, real_array, real_number
from robotics1.orientation.pointing import align_direction
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.tasks.position import AXES, PositionTask
from robotics1.tasks.task import FrameMap, PoseError, Task

PSI = 1.533751168755204288118041  # ψ⁴ = ψ + 4
GOLDEN = (1 + 5**0.5) / 2
MOST = 2**31  # poses of one map
SINGLE = 1e-6  # |RᵀR − 1| of what is taken for a rotation


@dataclass(frozen=True, eq=False)
class Poses(Frozen):
    """Goals of a task: the orientations at the first position, then at the second, ...

    Attributes:
        coordinates: the letters of the coordinates that the task has, such as "xyz" or "xy".
        positions: (k, d) [m], in the axes of the task.
        orientations: (o, 3, 3), in the axes of the task; one identity where orientation does not count.
        grid: (d,) the values of each coordinate if the positions are a grid, the last one changing first.
    """

    coordinates: str
    positions: Array
    orientations: Array
    grid: tuple[Array, ...] | None

    def __len__(self) -> int:
        return len(self.positions) * len(self.orientations)


def goals_of(coordinates: str, positions: Array, orientations: Array) -> Array:
    """Return the goals (k o, 4, 4) of positions (k, d) and orientations (o, 3, 3)."""
    k, o = len(positions), len(orientations)
    goals = np.zeros((k, o, 4, 4))
    goals[:, :, :3, :3] = orientations
    goals[:, :, [AXES.index(letter) for letter in coordinates], 3] = positions[:, None]
    goals[:, :, 3, 3] = 1.0
    return goals.reshape(k * o, 4, 4)


def task_of_map(task: Task, orientations: Any) -> tuple[Task, FrameMap, PoseError]:
    """Return the task that is asked of each pose: without orientations just the position of the same frame.

    Raises:
        TaskError: the task is none of one frame's pose, or has no position.
        InputError: there are orientations, and the task has none.
    """
    form = task.frame_map()
    if form is None or form.pose_error is None:
        raise TaskError(
            "a map needs a task on the pose of one frame, such as PoseTask(), PlanarPoseTask() or PositionTask()"
        )
    rows = form.pose_error.rows
    letters = "".join(AXES[row] for row in rows if row < 3)
    if not letters:
        raise TaskError("a map needs a task with a position, such as PoseTask(); this one has an orientation only")
    turns = len(rows) > len(letters)
    if orientations is None and turns:
        return task_of_map(PositionTask(letters, frame=form.frame, reference=form.reference), None)
    if orientations is not None and not turns:
        raise InputError("the task has no orientation, so that orientations= must be left out; or use PoseTask()")
    return task, form, form.pose_error


def poses_of(robot: Robot, form: FrameMap, error: PoseError, positions: Any, orientations: Any) -> Poses:
    """Return the poses that are asked for, checked.

    Raises:
        InputError: the positions or the orientations have the wrong form, are none, or too many.
    """
    letters = "".join(AXES[row] for row in error.rows if row < 3)
    turns = tuple(row for row in error.rows if row >= 3)
    R = np.eye(3)[None] if not turns else _orientations(robot, error, turns, len(letters), orientations)
    if isinstance(positions, int | float) and not isinstance(positions, bool):
        step = real_number("positions", positions, positive=True)
        refuse_too_many((2 * robot.reach / step) ** len(letters) * len(R))  # before it is made
        positions = grid_over_reach(robot, form, letters, step)
    if isinstance(positions, Mapping):
        grid = _axes(letters, positions)
        refuse_too_many(np.prod([len(axis) for axis in grid], dtype=float) * len(R))
        points = np.stack([values.ravel() for values in np.meshgrid(*grid, indexing="ij")], axis=1)
        return Poses(letters, points, R, grid)
    points = real_array("positions", positions, (None, len(letters)), f"the coordinates {', '.join(letters)} [m]")
    if not len(points):
        raise InputError("there is no position in positions")
    refuse_too_many(float(len(points)) * len(R))
    return Poses(letters, points, R, None)


def refuse_too_many(count: float) -> None:
    """Raise InputError if a map of so many poses fits on no machine, with the estimate."""
    if count > MOST:
        days = count * 1e-5 / 86400
        raise InputError(
            f"{count:.3g} poses are too many for one map, which has at most {MOST:.3g}: it would take "
            f"{count * 2 / 2**30:,.0f} GiB and, at 10 µs a pose, {days:,.0f} days of one core; use a coarser grid or "
            f"fewer orientations, or make a map of each part"
        )


def _axes(letters: str, positions: Mapping[Any, Any]) -> tuple[Array, ...]:
    """Return the values of each coordinate of a grid, from a mapping such as {"x": np.linspace(-1, 1, 41), "y": 0}."""
    if set(positions) != set(letters):
        raise InputError(
            f"a grid names the coordinates {', '.join(letters)}; positions names {', '.join(map(str, positions))}"
        )
    axes = []
    for letter in letters:
        value = positions[letter]
        name = f"positions[{letter!r}]"
        values = [real_number(name, value)] if dimensions(name, value) == 0 else value
        axis = real_array(name, values, (None,), "the values of a coordinate [m]")
        if not len(axis) or (np.diff(axis) <= 0).any():
            raise InputError(f"{name} must be one value or more, ascending [m]; it is {axis.tolist()}")
        axes.append(axis)
    return tuple(axes)


def _orientations(robot: Robot, error: PoseError, turns: tuple[int, ...], places: int, orientations: Any) -> Array:
    """Return rotations (o, 3, 3) from rotations, angles of a planar task, or how many there are to be."""
    whole = isinstance(orientations, int | np.integer) and not isinstance(orientations, bool)
    count = counting_number("orientations", orientations, least=1, most=10**6) if whole else 0
    if len(turns) == 1:
        angles = (
            TURN * np.arange(count) / count
            if whole
            else real_array("orientations", orientations, (None,), "angles [rad]")
        )
        found = np.array([error.goal(robot, [*np.zeros(places), angle])[:3, :3] for angle in angles])
    elif whole:
        found = directions(count, error.axis) if error.axis.any() else spread_rotations(count)
    else:
        given = orientations.as_matrix() if isinstance(orientations, Rotation) else orientations
        given = np.asarray(given)[None] if dimensions("orientations", given) == 2 else given
        found = real_array("orientations", given, (None, 3, 3), "rotation matrices, or how many")
        refuse_no_rotations("orientations", found)
    if not len(found):
        raise InputError("there is no orientation in orientations")
    return found


def refuse_no_rotations(name: str, R: Array) -> None:
    """Raise InputError if one of R, (o, 3, 3), is no rotation."""
    square = np.abs(np.einsum("oij,oik->ojk", R, R) - np.eye(3)).max(initial=0.0)
    if square > SINGLE or (len(R) and np.linalg.det(R).min() < 0):
        raise InputError(f"{name} must be rotation matrices, RᵀR = 1 and det R = 1")


def spread_rotations(count: int) -> Array:
    """Return rotations (o, 3, 3) that are spread evenly over all of them, the same each time: a spiral on |x| = 1.

    Source: Alexa, Super-Fibonacci spirals, Conf. Computer Vision and Pattern Recognition, 2022.
    """
    s = np.arange(count) + 0.5
    r, rest = np.sqrt(s / count), np.sqrt(1 - s / count)
    a, b = TURN * s / 2**0.5, TURN * s / PSI
    x = np.column_stack([r * np.sin(a), r * np.cos(a), rest * np.sin(b), rest * np.cos(b)])
    return np.asarray(Rotation.from_quat(x).as_matrix())


def directions(count: int, axis: Array) -> Array:
    """Return rotations (o, 3, 3) that turn an axis to directions spread evenly over the sphere: Fibonacci's spiral."""
    s = np.arange(count) + 0.5
    z = 1 - 2 * s / count
    r, a = np.sqrt(1 - z * z), TURN * s / GOLDEN
    ends = np.column_stack([r * np.cos(a), r * np.sin(a), z])
    return np.array([align_direction(axis, end).rotation for end in ends])


def grid_over_reach(robot: Robot, form: FrameMap, letters: str, step: float) -> dict[str, Array]:
    """Return letter → values with a step [m], of a cube around what the lengths of the arm allow.

    The middle is a point on the first axis; a coordinate that no joint changes has its one value.

    Raises:
        InputError: a slide has no limits, so that the cube has no end.
    """
    problem = pose_problem(robot, PositionTask(letters, frame=form.frame, reference=form.reference))
    bound, still = reach_bound(problem), motionless(robot, problem.form)
    if not math.isfinite(bound.length):
        raise InputError("a slide without limits reaches without end: name the positions, as {'x': [0, 0.1], ...}")
    steps = step * np.arange(-math.ceil(bound.length / step), math.ceil(bound.length / step) + 1)
    return {
        letter: np.array([still.p[i]]) if still.rows[i] else bound.o[i] + steps
        for i, letter in ((AXES.index(letter), letter) for letter in letters)
    }
