"""Pages of a robot: at a configuration, with several solutions, or in motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.angles import warn_of_degrees
from robotics1.curves.curve import Curve
from robotics1.curves.given import Motion
from robotics1.errors import InputError
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array, text
from robotics1.plots.figures import names_of
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.given import TaskLike, task_from
from robotics1.trajectories.target_motion import TargetMotion
from robotics1.viewer.arm_data import arm_data, is_planar, stand_in
from robotics1.viewer.page import Page, page_of
from robotics1.viewer.samples import recorded, samples_of, target_samples
from robotics1.viewer.shapes import Shapes
from robotics1.viewer.voxels import voxels_of
from robotics1.workspaces.reachability.result import ReachabilityMap

APART = 0.2  # between two robots side by side, of the reach
TINTS = (
    (0.13, 0.42, 0.71),
    (0.93, 0.55, 0.14),
    (0.17, 0.54, 0.24),
    (0.53, 0.18, 0.61),
)  # of several motions of one arm


def animate(
    robot: RobotLike | Sequence[RobotLike],
    motion: Motion | Sequence[Motion] | None = None,
    file: str | Path | None = None,
    *,
    times: npt.ArrayLike | None = None,
    q: npt.ArrayLike | None = None,
    target: TargetMotion | None = None,
    task: TaskLike | None = None,
    names: Sequence[str] | None = None,
    title: str | None = None,
    caption: str = "",
) -> Page:
    """Return an animated page of a motion, and write it if a file is given: one offline HTML file.

    The robot moves in real time and its tool leaves a trail; the target, if there is one, runs along its dotted path.
    Under the scene there are a bar to play, and plots of q, q̇, σ_min and the distance to the target. Several motions
    of one robot are drawn in one place, in different colours; those of several robots side by side.

    Args:
        robot: the robot; or several, one for each motion.
        motion: q(t), any motion of the robot's joints; or several.
        file: the file to write.
        times, q: recorded instants (k,) [s] and configurations (k, n), in the place of a motion.
        target: a moving point p(t) with two (x, y) or three coordinates [m].
        task: the task whose Jacobian the page shows; by default the position or the pose of the tool. In the place of
            a task whose rows S in ṙ = S V are not constant, the page shows the default one, and says so.
        names: one for each of several motions; by default the robots' names.
        title: by default the robot's name.
        caption: lines under the title.

    Raises:
        MissingExtraError: Meshcat or trimesh is not installed.
        InputError: a motion is not of its robot's joints, it or the target is not finite, the instants do not grow, or
            the file cannot be written there.

    Warns:
        RobotWarning: angles of a motion look like degrees; a mesh was not found or cannot be read, and is not drawn.
    """
    robots, motions = _pairs(robot, motion, recorded_values=times is not None or q is not None)
    labels = names_of("names", names, [one.name for one in robots])
    in_one_place = isinstance(robot, Robot) and len(motions) > 1
    shapes = Shapes()
    arms, actors, across = [], [], -(1 + APART) * robots[0].reach
    for i, (one, moved, label) in enumerate(zip(robots, motions, labels, strict=True)):
        across += (1 + APART) * one.reach  # from the edge of the robot before
        samples = samples_of(moved, one) if moved is not None else recorded(times, q, one)
        warn_of_degrees("the motion", samples.q[[0, -1]], one.revolute, one.lower, one.upper)
        arms.append(_arm(one, samples.q[0], task, shapes, label))
        actors.append(
            {
                **_actor(i, samples.q[0]),
                "motion": samples.packed(),
                "target": None if target is None else target_samples(target, samples.times[-1]).packed(),
                "offset": [0.0 if in_one_place else across, 0.0, 0.0],
                "tint": TINTS[i % len(TINTS)] if in_one_place else None,
            }
        )
        across += one.reach
    return _page(robots, arms, actors, shapes, (), title=title, caption=caption, file=file)


def view(
    robot: RobotLike,
    q: ConfigurationLike | None = None,
    file: str | Path | None = None,
    *,
    task: TaskLike | None = None,
    solutions: IKSolutions | Sequence[npt.ArrayLike] | Mapping[str, npt.ArrayLike] = (),
    reach: ReachabilityMap | None = None,
    title: str | None = None,
    caption: str = "",
) -> Page:
    """Return a page to play with a robot, and write it if a file is given: one offline HTML file.

    The page has a slider for each joint and a handle to drag the tool by, and shows what the Jacobian says there.

    Args:
        robot: the robot.
        q: (nq,) where it is at first; by default the first of the solutions, or zero, or what is next to it inside the
            limits.
        file: the file to write.
        task: the task whose Jacobian the page shows; by default the position or the pose of the tool. In the place of
            a task whose rows S in ṙ = S V are not constant, the page shows the default one, and says so.
        solutions: what `ik_solutions` has found, or configurations (n,), to leaf through; or label → configuration.
        reach: a map of a grid that `reachability_map` returns, in the axes of the world: the cells that are reached are
            drawn as boxes, with a colour scale, and a slider that cuts them open.
        title: by default the robot's name.
        caption: lines under the title.

    Raises:
        MissingExtraError: Meshcat or trimesh is not installed.
        InputError: q or a solution has the wrong shape or is not finite, the map is none of a grid, or the file cannot
            be written there.

    Warns:
        RobotWarning: a mesh was not found or cannot be read, and is not drawn.
    """
    robot = robot_from(robot)
    if isinstance(q, Curve):
        raise InputError("a motion is shown by animate(robot, motion); here a motion stands in the place of q")
    if isinstance(q, IKSolutions):
        raise InputError("solutions are shown by view(robot, solutions=...); here they stand in the place of q")
    states = _labelled(robot, solutions)
    start = robot.configuration(q) if q is not None else states[0][1] if states else robot.postures["zero"]
    shapes = Shapes()
    arms = [_arm(robot, start, task, shapes, robot.name)]
    voxels = None if reach is None else voxels_of(reach)
    actors = [_actor(0, start)]
    return _page([robot], arms, actors, shapes, states, voxels, title=title, caption=caption, file=file)


def _labelled(robot: Robot, solutions: Any) -> list[tuple[str, Array]]:
    """Return the solutions, each with its label or none."""
    found: list[tuple[str, Any]]
    if isinstance(solutions, IKSolutions):
        found = [(", ".join(names), q) for names, q in zip(solutions.labels, solutions.q, strict=True)]
    elif isinstance(solutions, Mapping):
        found = list(solutions.items())
    elif isinstance(solutions, str) or not np.iterable(solutions):
        raise InputError(f"solutions must be configurations, or label → configuration; it is {solutions!r}")
    else:
        found = [("", solution) for solution in solutions]
    return [(text("the label of a solution", label), robot.configuration(at, "a solution")) for label, at in found]


def _pairs(robot: Any, motion: Any, *, recorded_values: bool) -> tuple[list[Robot], list[Any]]:
    """Return the robots and the motion of each."""
    if (motion is None) != recorded_values:
        raise InputError("give a motion, or times and q of a recorded one")
    motions = list(motion) if isinstance(motion, list | tuple) else [motion]
    listed = isinstance(robot, Sequence) and not isinstance(robot, str)
    robots = [robot_from(one) for one in (robot if listed else [robot] * len(motions))]
    if not motions or len(robots) != len(motions):
        raise InputError(f"each motion wants its robot: there are {len(robots)} robots and {len(motions)} motions")
    return robots, motions


def _arm(robot: Robot, q: Array, task: TaskLike | None, shapes: Shapes, label: str) -> dict[str, Any]:
    """Return an arm of the page with its shapes."""
    if task is not None:
        task = task_from(task)
        shapes.note(stand_in(robot, task))
    return {**arm_data(robot, q, task), "label": label, "shapes": shapes.of(robot)}


def _actor(arm: int, q: Array) -> dict[str, Any]:
    """Return a robot of the page that stands still at q."""
    return {"arm": arm, "q": q.tolist(), "motion": None, "target": None, "offset": [0.0, 0.0, 0.0], "tint": None}


def _page(
    robots: Sequence[Robot],
    arms: Sequence[dict[str, Any]],
    actors: Sequence[dict[str, Any]],
    shapes: Shapes,
    solutions: Sequence[tuple[str, Array]],
    voxels: dict[str, Any] | None = None,
    *,
    title: str | None,
    caption: str,
    file: str | Path | None,
) -> Page:
    text("caption", caption)
    name = text("title", title or "") or ", ".join(dict.fromkeys(robot.name for robot in robots))
    data = {
        "planar": all(map(is_planar, robots)),
        "arms": arms,
        "actors": actors,
        "meshes": shapes.meshes,
        "solutions": [{"label": label, "q": q.tolist()} for label, q in solutions],
        "voxels": voxels,
    }
    return page_of(data, title=name, caption=caption, notes="\n".join(shapes.notes), file=file)
