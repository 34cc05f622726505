"""How near to singular a task is, over all configurations of a robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from robotics1.chunks.identity import identity
from robotics1.chunks.pace import ADVICE, Pace, Progress
from robotics1.chunks.state import StateFile
from robotics1.chunks.workers import check_executor, check_progress, workers_of
from robotics1.errors import InputError, TaskError
from robotics1.inputs import counting_number, one_of, real_number
from robotics1.robot.box import joint_box
from robotics1.robot.given import RobotLike
from robotics1.singularities.points import MOVES, SingularPoints, singular_points
from robotics1.singularities.reduction import (
    MEASURES,
    Measure,
    Reduction,
    joined_together,
    reduced_together,
    reduction_from,
)
from robotics1.singularities.refinement import refine as refine_worst
from robotics1.singularities.samples import CHUNK, METHODS, Chunk, samples_of
from robotics1.singularities.scan_result import SingularityScan
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import turns_of

Sampling = Literal["random", "sobol", "grid"]
KEPT = 10  # worst configurations, or as many as are refined
TOGETHER = 256  # chunks at most that a worker joins before it answers: some seconds of work
AT_LEAST = 64  # answers, so that all workers have something to do and the progress is seen
OF_SOBOL = 32  # chunks of Sobol's sequence handed out at a time: they are made here, 30 MB for seven joints


def scan_singularities(
    robot: RobotLike,
    task: TaskLike,
    *,
    samples: int | float | Sequence[int],
    measures: Sequence[Measure] = ("sigma_min",),
    method: Sampling = "random",
    seed: int = 0,
    refine: int = 0,
    executor: Executor | Any | None = None,
    checkpoint: str | Path | None = None,
    box: Mapping[str, tuple[float, float]] | None = None,
    length: float = 1.0,
    progress: Progress | None = None,
) -> SingularityScan:
    """Measure how near J(q) is to losing rank, at many configurations of the joint box.

    With σ₁ ≥ ... ≥ σ_ρ the singular values of J(q) = `task.jacobian(robot, q)`, ρ being its rank almost everywhere
    (min(m, n), unless rows of the task depend on each other):

    - "sigma_min" is σ_ρ, the least speed of the task at unit joint speed, of the task velocities that it can have;
    - "condition" is σ₁/σ_ρ, infinite where σ_ρ = 0;
    - "manipulability" is σ₁ σ₂ ... σ_ρ, Yoshikawa's √det(J Jᵀ) where ρ = m ≤ n.

    J is in SI units, so that metres and radians mix, as textbooks have it. With `length` L, rows in metres are divided
    by L and columns of prismatic joints multiplied by it; with `length=robot.reach` J has no units.

    The configurations are gone through in chunks: the memory needed does not grow with their number. The answer
    depends on the arguments only, not on the executor or its number of workers. If the pace of the first chunks says
    that the others will take longer than an hour, a warning says how long.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q). If its rows are the same combinations of the frame's velocity everywhere, as those of a
            position, a planar pose, an orientation or a pose, compiled kernels serve it, at millions of
            configurations a second; others are asked for J one configuration at a time, in this process.
        samples: how many configurations, 1e6 or 1_000_000; of a grid at most so many, with the same number of values
            for each joint, or that number for each joint.
        measures: some of "sigma_min", "condition", "manipulability"; the first decides which configurations are the
            worst.
        method: "random": uniform; "sobol": Sobol's sequence, scrambled, which is more even; "grid": limits included.
        seed: of the random numbers.
        refine: how many of the worst configurations are moved to singular ones, σ_ρ ≤ 1e-10 σ₁ with lengths divided
            by the reach, and compared with the branches of `find_singularities`.
        executor: who measures: None for threads on all cores, since the kernels leave the interpreter free; an
            executor of concurrent.futures; a Dask client; or the address of a Dask scheduler. Arrays only are sent.
        checkpoint: a file (.npz) in which what is known is kept, every five seconds: the same call goes on from there.
        box: joint name → (lower, upper), narrower than the limits; a prismatic joint without limits needs it. A
            revolute joint that can make a whole turn is a circle, (−π, π]; as many turns as bring the joints that
            follow it back, if these are more.
        length: the length that counts as one [m].
        progress: called after each chunk with the configurations done and their number.

    Raises:
        InputError: a bad option, an unlimited prismatic joint without a box, or a joint of several degrees of freedom;
            or the checkpoint is of another question, damaged, or cannot be written.
        UnknownNameError: no such joint in the box, or no such frame.
        TaskError: the task does not fit the robot, or no joint moves it.

    Warns:
        RobotWarning: it will take longer than an hour.

    Source: Yoshikawa, Manipulability of robotic mechanisms, Int. J. Robotics Research 4, 1985; Siciliano, Sciavicco,
    Villani, Oriolo, Robotics, 2009, section 3.9.
    """
    robot, task = robot_and_task(robot, task)
    chosen = _measures(measures)
    one_of("method", method, METHODS)
    seed, refine = counting_number("seed", seed), counting_number("refine", refine)
    length = real_number("length", length, positive=True)
    check_executor(executor)
    check_progress(progress)
    task.check(robot)
    where = joint_box(robot, box, turns=turns_of(robot, task))
    points = singular_points(robot, task, where, np.random.default_rng(seed)).require_motion()
    count, chunks = samples_of(method, where, samples, seed, _moving(points))
    from robotics1.singularities.measurement import measurement_of

    alone = executor is None and checkpoint is None
    measurement = measurement_of(robot, task, points.rank, length, count if alone else None)
    keep, grid = max(KEPT, refine), np.asarray(samples) if method == "grid" else None
    asked: dict[str, Any] = {"measures": chosen, "method": method, "samples": count, "seed": seed, "worst": keep}
    asked |= {"length": length, "box": [where.lower, where.upper], "grid": grid}
    file = None if checkpoint is None else StateFile(checkpoint, identity("a scan", robot, task, asked))
    begun = _begun(file, chosen)
    work = partial(reduced_together, measurement, chosen, keep)
    groups = _in_groups(islice(chunks, _chunks(begun), None), 1 if method == "sobol" else _together(count))
    with workers_of(executor, sendable=measurement.sendable) as workers:
        join, most = partial(joined_together, keep), OF_SOBOL if method == "sobol" else workers.ahead
        answers = workers.joined_in_order(work, join, groups, most)
        total = _joined(begun, answers, keep, count, file, Pace("configurations", f"fewer samples, {ADVICE}", progress))
    return SingularityScan(
        robot,
        task,
        method,
        seed,
        total.count,
        total.undefined,
        points.rank,
        length,
        total.distributions,
        total.worst,
        total.worst_values,
        refine_worst(points, total.worst[:refine], box, seed) if refine else None,
    )


def _measures(measures: Sequence[str]) -> tuple[str, ...]:
    if isinstance(measures, str) or not isinstance(measures, Sequence) or len(measures) == 0:
        raise InputError(f"measures must be some of {', '.join(map(repr, MEASURES))}; it is {measures!r}")
    chosen = tuple(one_of("each of measures", measure, MEASURES) for measure in measures)
    if len(set(chosen)) < len(chosen):
        raise InputError(f"measures must be different ones; it is {measures!r}")
    return chosen


def _moving(points: SingularPoints) -> npt.NDArray[np.bool_]:
    """Return which joints move the task: their columns of J are not zero everywhere."""
    q = points.box.random(np.random.default_rng(0), 4)
    return np.asarray(np.any([np.abs(points.jacobian(x)).max(axis=0) > MOVES for x in q], axis=0))


def _begun(file: StateFile | None, measures: tuple[str, ...]) -> Reduction | None:
    """Return what a checkpoint holds; None if there is none."""
    state = None if file is None else file.read()
    return None if state is None else reduction_from(state, measures)


def _chunks(begun: Reduction | None) -> int:
    """Return how many chunks are done; the last one of all may be smaller than the others."""
    return 0 if begun is None else -(-begun.count // CHUNK)


def _together(count: int) -> int:
    """Return how many chunks a worker joins: the answer does not depend on it."""
    return min(max(1, count // CHUNK // AT_LEAST), TOGETHER)


def _in_groups(chunks: Iterator[Chunk], size: int) -> Iterator[tuple[Chunk, ...]]:
    while group := tuple(islice(chunks, size)):
        yield group


def _joined(
    total: Reduction | None,
    answers: Iterator[Reduction],
    keep: int,
    count: int,
    file: StateFile | None,
    progress: Progress,
) -> Reduction:
    """Return what is kept of all chunks, those before included, and write it down now and then, and at the end."""
    for answer in answers:
        total = answer if total is None else total.joined(answer, keep)
        if file is not None:
            file.write_now_and_then(total.as_arrays())
        progress(total.count, count)
    if total is None or total.undefined == total.count:
        raise TaskError("the task has no Jacobian at any of the configurations")
    if file is not None:
        file.write(total.as_arrays())
    return total
