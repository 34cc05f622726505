"""Whose answers a checkpoint holds: compared before any of them is used."""

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError, TaskError
from robotics1.kinematics import forward_kinematics
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

PLACES = 3  # configurations at which a robot and a task are compared
SAME = 1e-9  # of numbers that another processor may round in another way

Identity = dict[str, Any]  # made of what JSON knows


def identity(what: str, robot: Robot, task: Task, options: Mapping[str, Any]) -> Identity:
    """Return what must be the same for answers to be the same: the robot, the task and the options.

    Robots and tasks are known by what they do: poses, Jacobians and limits, not by the files that they come from.
    """
    q = np.random.default_rng(0).uniform(-1, 1, (PLACES, robot.nq)) * robot.units
    frames = task.frame_map()
    frame = None if frames is None else frames.frame
    poses = [forward_kinematics(robot, x, frame=frame).homogeneous[:3].tolist() for x in q]
    limits = [[float(x) if np.isfinite(x) else str(x) for x in ends] for ends in (robot.lower, robot.upper)]
    return {
        "what": what,
        "robot": [robot.name, list(robot.joint_names), limits, poses],
        "task": [list(task.row_names), [_jacobian(robot, task, x) for x in q]],
    } | {name: _plain(value) for name, value in options.items()}


def refuse_another(path: str | Path, kept: Any, asked: Identity) -> None:
    """Refuse a checkpoint of another question.

    Raises:
        InputError: it is of another robot, task or option; the message says which.
    """
    if not isinstance(kept, dict):
        raise InputError(f"{str(path)!r} holds no checkpoint of this package; name another one")
    different = [name for name in asked if not _same(kept.get(name), asked[name])]
    if different:
        raise InputError(
            f"the checkpoint {str(path)!r} is of another question: {', '.join(different)} differ"
            f"{'s' if len(different) == 1 else ''}; name another one, or ask what it was asked"
        )


def _jacobian(robot: Robot, task: Task, q: Any) -> Any:
    try:
        return np.asarray(task.jacobian(robot, q), dtype=float).tolist()
    except TaskError:
        return None


def _plain(value: Any) -> Any:
    """Return an option as what JSON knows; of an array its shape and a digest."""
    if isinstance(value, np.ndarray):
        return [list(value.shape), hashlib.sha256(np.ascontiguousarray(value).tobytes()).hexdigest()]
    if isinstance(value, list | tuple):
        return [_plain(entry) for entry in value]
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    return value


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(_same, a, b))
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) <= SAME * max(1.0, abs(a), abs(b))
    return bool(a == b)
