"""From a robot and a task to formulas: its value, its Jacobian, determinant and minors, in SymPy."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

from robotics1.errors import FormulaError, InputError, UnknownNameError
from robotics1.inputs import text
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.chain import Chain, chain_to
from robotics1.symbolic.kinematics.exact import exact_robot
from robotics1.symbolic.kinematics.points import with_point
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS
from robotics1.symbolic.tasks.symbolic_task import SymbolicTask
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.symbolic.tasks.task_map import task_map
from robotics1.tasks.given import TaskLike, refuse_swapped, task_from
from robotics1.tasks.task import FrameMap, Task


def formulas(robot: RobotLike, task: TaskLike, *, point: Any = None, rows: Sequence[str] | None = None) -> Formulas:
    """Return the formulas of a task, built from the same file as the robot's numbers.

    Every formula is compared with Pinocchio, at random q and parameters, when it is first asked for.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q), on a frame; or r = f(p, R, q), a function written with arithmetic, NumPy or SymPy.
        point: (3,) a point of the task's frame, in its axes [m], instead of its origin: numbers, names such as "d"
            that become symbols, or polynomials of names in SymPy.
        rows: some of the task's rows by name, such as ("y", "ωz") of a pose; w is read as ω, phi as φ.

    Raises:
        TaskError: the task does not fit the robot.
        InputError: the point or the rows are none.
        UnknownNameError: the task has no row, or the robot no frame, of that name.
        FormulaError: the task's function cannot be read, the file's numbers depend on the parameters in a way that
            cannot be found, or a formula does not agree with Pinocchio to 1e-9.
    """
    refuse_swapped(robot, task)
    robot = robot_from(robot)
    asked: Task = task_from(task) if isinstance(task, type | str) else task
    form, given = _on_a_frame(asked), {*robot.parameters}
    asked.check(robot)
    if point is not None:
        robot, frame = with_point(robot, form.frame, point, form.parameters)
        asked = replace(asked, frame=frame, point=None)  # type: ignore[type-var]  # a task on a frame is a dataclass
    elif form.parameters:
        robot, _ = with_point(robot, form.frame, (0, 0, 0), form.parameters)
    given |= {*form.parameters}
    asked.check(robot)
    places = row_places(asked, rows)
    read: Callable[..., SymbolicTask] = _kept_reading if _is_hashable(asked) else _reading
    reading = read(robot, asked, places)
    return Formulas(
        robot,
        asked,
        tuple(asked.row_names[i] for i in places),
        reading.chain.q,
        exact_robot(robot)[1],
        tuple(name for name in robot.parameters if name not in given),
        reading,
    )


def _reading(robot: Robot, task: Task, places: tuple[int, ...]) -> SymbolicTask:
    """Return the task read in symbols."""
    form = _on_a_frame(task)
    axes = None  # the link in whose axes the task is written
    if form.reference != "world":
        axes = robot.link_of(None if form.reference == "tool" else form.reference)
    chain = chain_to(robot, robot.link_of(form.frame), beside=axes)
    _check_names(robot, chain)
    joints = () if axes is None else robot.joints_to(axes)
    return SymbolicTask(chain, joints, task_map(form, task.rows, chain.q).chosen(list(places)))


_kept_reading = lru_cache(maxsize=8)(_reading)  # find_singularities reads the same again


def _is_hashable(task: Task) -> bool:
    try:
        hash(task)
    except TypeError:
        return False
    return True


def _on_a_frame(task: Task) -> FrameMap:
    """Return the task as a function of its frame.

    Raises:
        FormulaError: it is none.
    """
    form = task.frame_map() if hasattr(task, "frame_map") else None
    if form is None:
        raise FormulaError(f"formulas are written for tasks on a frame and for FunctionTask, not for {task!r}")
    return form


def _check_names(robot: Robot, chain: Chain) -> None:
    joints = {symbol.name for symbol in chain.q}
    for name in robot.parameters:
        if name in joints:
            raise FormulaError(f"robot {robot.name!r} has a parameter {name!r}, which in formulas is a joint")
        if name in ROOTS:
            raise FormulaError(f"robot {robot.name!r} has a parameter {name!r}, which in formulas is a number")


def row_places(task: Task, rows: Sequence[str] | None) -> tuple[int, ...]:
    """Return the places of the chosen rows of a task; of all without a choice.

    Raises:
        InputError: the rows are no names, or one is there twice.
        UnknownNameError: the task has no row of that name.
    """
    names = task.row_names
    if rows is None:
        return tuple(range(len(names)))
    if isinstance(rows, str) or not isinstance(rows, Sequence) or not rows:
        raise InputError(f"rows must be names such as {names[:2]}; it is {rows!r}")
    spelled = [text("a row", row).replace("w", "ω").replace("phi", "φ") for row in rows]
    for row, name in zip(rows, spelled, strict=True):
        if name not in names:
            raise UnknownNameError("row of the task named", row, names)
    if len(set(spelled)) != len(spelled):
        raise InputError(f"rows must be distinct; they are {tuple(rows)}")
    return tuple(names.index(name) for name in spelled)
