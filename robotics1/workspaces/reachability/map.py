"""The map of what an arm reaches: millions of poses in chunks, on as many cores as there are."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import Executor
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from robotics1.chunks.identity import identity
from robotics1.chunks.pace import ADVICE, Pace, Progress
from robotics1.chunks.workers import Workers, check_executor, check_progress, workers_of
from robotics1.inputs import Array
from robotics1.robot.given import RobotLike
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.reachability.chunk import ChunkOfMap, Description, chunk_of_map, empty_chunk
from robotics1.workspaces.reachability.evaluation import PoseQuestion, evaluator_of, question_of
from robotics1.workspaces.reachability.poses import poses_of, task_of_map
from robotics1.workspaces.reachability.result import ReachabilityMap
from robotics1.workspaces.reachability.saved import MapFolder, chunk_kept, map_folder

Answer = TypeVar("Answer")


def reachability_map(
    robot: RobotLike,
    task: TaskLike,
    positions: Any,
    orientations: Any = None,
    *,
    starts: int = 16,
    seed: int = 0,
    tolerance: float = 1e-6,
    configurations: int = 1,
    executor: Executor | Any | None = None,
    checkpoint: str | Path | None = None,
    progress: Progress | None = None,
) -> ReachabilityMap:
    """Return which of many poses an arm reaches inside its joint limits, by how many configurations, and how well.

    Each pose is a target f(q) = r_d of the task. Where all solutions follow from formulas, these are compiled, and a
    pose is either reached or proven to be out of reach; their number is known too. Elsewhere, as for redundant arms, a
    pose is reached when a descent from one of a number of starts arrives; else it is proven to be out of reach by the
    lengths of the arm, or it is not found. What is reached is verified by forward kinematics: |e| ≤ tolerance.

    The answer depends on the arguments only: not on the clock, the executor, or its number of workers. If the pace of
    the first chunks says that the others will take longer than an hour, a warning says how long.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: of one frame's pose: PoseTask(), PlanarPoseTask(), PositionTask(), ...
        positions: (k, d) the coordinates that the task has [m], d = 3 of a pose; or a grid, letter → values, such as
            {"x": np.linspace(-1, 1, 41), "y": 0.0, "z": [0.2, 0.4]}; or one number, the step [m] of a grid over all
            that the lengths of the arm allow.
        orientations: with which each position is tried: how many, spread evenly; or rotations (o, 3, 3) or SciPy's;
            of a planar task angles (o,) [rad]. None asks for the position alone, whatever the orientation.
        starts: how many starts are followed, of 128 each the one nearest to the pose, where there is no formula.
        seed: of the starts.
        tolerance: on |e| of a descent [m, rad].
        configurations: how many of a pose are compared for its manipulability and limit margin, where there is no
            formula: of a redundant arm so many samples of its self-motion. What is best of them was found, not proven.
        executor: who works: None for threads on all cores; an executor of concurrent.futures; a Dask client; or the
            address of a Dask scheduler.
        checkpoint: a folder in which what is done is kept, as Zarr arrays: the same call goes on where it was. Workers
            that see the folder, as on a disk that a cluster shares, write to it themselves.
        progress: called after each chunk with the poses done and their number.

    Raises:
        InputError: no positions, too many, or of the wrong form; an option has a wrong value; a prismatic joint that
            moves the task has no limits; or the checkpoint is of another question, damaged, or cannot be written.
        TaskError: the task does not fit the robot, has no position, or is none of one frame's pose.

    Warns:
        RobotWarning: it will take longer than an hour.

    Source: Zacharias, Borst, Hirzinger, Capturing robot workspace structure: representing robot capabilities, IROS
    2007; Vahrenkamp, Asfour, Dillmann, Robot placement based on reachability inversion, ICRA 2013.
    """
    robot, task = robot_and_task(robot, task)
    asked, form, error = task_of_map(task, orientations)
    question = question_of(robot, asked, starts, seed, tolerance, configurations)
    check_executor(executor)
    check_progress(progress)
    poses = poses_of(robot, form, error, positions, orientations)
    evaluator = evaluator_of(question.packed())  # before the threads want it
    of_poses = poses.coordinates, poses.positions, poses.orientations, poses.grid
    description = Description(robot.name, robot.joint_names, asked.row_names, *of_poses, counts=evaluator.counts)
    done = (
        _done_in_memory
        if checkpoint is None
        else partial(_done_in_a_folder, _folder(checkpoint, question, description))
    )
    sendable = evaluator.measurement.sendable
    pace = Pace("poses", f"a coarser grid or fewer orientations, {ADVICE}", progress)
    with workers_of(executor, sendable=sendable) as workers:
        return description.finished(done(question.packed(), description, workers, pace))


def _done_in_memory(packed: bytes, asked: Description, workers: Workers, progress: Progress) -> ChunkOfMap:
    """Return what is known of all positions."""
    found = empty_chunk(len(asked.positions), len(asked.orientations), len(asked.joint_names))
    work = partial(chunk_of_map, packed, asked.coordinates, asked.orientations)
    for part, answer in _answers(work, asked, asked.parts, workers, progress):
        for array, values in zip(found.arrays, answer.arrays, strict=True):
            array[part] = values
    return found


def _done_in_a_folder(
    folder: MapFolder, packed: bytes, asked: Description, workers: Workers, progress: Progress
) -> ChunkOfMap:
    """Return the same, after what is missing in a folder has been written to it: by the workers, if they see it."""
    work = partial(chunk_of_map, packed, asked.coordinates, asked.orientations)
    kept = partial(chunk_kept, packed, asked.coordinates, asked.orientations, str(folder.path), folder.token)
    for part, answer in _answers(kept, asked, folder.left(), workers, progress):
        if answer is not None:
            folder.write(part, answer)
    for part, answer in _answers(work, asked, folder.left(), workers, progress):  # written where only a worker sees it
        folder.write(part, answer)
    folder.tidy()
    return folder.read()


def _answers(
    work: Callable[[tuple[int, Array]], Answer],
    asked: Description,
    parts: list[slice],
    workers: Workers,
    progress: Progress,
) -> Iterator[tuple[slice, Answer]]:
    """Yield parts of the positions, and the answers of the work to them, in their order."""
    o, k = len(asked.orientations), len(asked.positions)
    done = k - sum(part.stop - part.start for part in parts)
    answers = workers.in_order(work, ((part.start, asked.positions[part]) for part in parts))
    for part, answer in zip(parts, answers, strict=True):
        yield part, answer
        done += part.stop - part.start
        progress(done * o, k * o)


def _folder(path: str | Path, question: PoseQuestion, asked: Description) -> MapFolder:
    """Return the folder of a checkpoint, if it is of this question."""
    options = {
        "positions": asked.positions,
        "orientations": asked.orientations,
        "starts": question.starts,
        "seed": question.seed,
        "tolerance": question.tolerance,
        "configurations": question.configurations,
    }
    return map_folder(path, identity("a reachability map", question.robot, question.task, options), asked)
