"""A motion as an animated page: the robot, the tool's trail, and the target it meets."""

from itertools import pairwise
from math import ceil
from pathlib import Path

import numpy as np
import numpy.typing as npt

from robotics1.curves.given import Motion, joint_motion
from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number
from robotics1.kinematics import forward_kinematics
from robotics1.robot.model import Robot
from robotics1.trajectories.target_motion import TargetMotion
from robotics1.viewer.page import write_page
from robotics1.viewer.scene import Color, Scene

FRAME_RATE = 60.0  # at most; a browser shows no more
MOST_FRAMES = 1200  # a long motion gets fewer frames a second, so that its page stays small
HOLD = 0.7  # the end is held before the motion starts again [s]
THIN = 0.005  # radius of the trail and of the dots, of the arm's reach
TRAIL: Color = (0.80, 0.15, 0.15)
TARGET: Color = (0.10, 0.60, 0.25)


def animate(
    robot: Robot,
    trajectory: Motion,
    path: str | Path,
    *,
    target: TargetMotion | None = None,
    title: str | None = None,
    caption: str = "",
) -> Path:
    """Write an animated page of the motion, one offline HTML file, and return its path.

    The robot moves in real time and its tool leaves a trail; the target, if there is one, runs along its dotted path.

    Args:
        robot: the robot, with a tool.
        trajectory: q(t), any of the robot's joints.
        path: the file to write.
        target: a moving point p(t) with two (x, y) or three coordinates [m].
        title: by default the robot's name.
        caption: lines under the title.

    Raises:
        MissingExtraError: Meshcat is not installed.
        InputError: the trajectory is not of the robot's joints, it or the target is not finite, or the file cannot be
            written there.

    Warns:
        RobotWarning: a mesh cannot be read, and is not drawn.
    """
    motion = joint_motion("trajectory", trajectory, robot.nv)
    T = real_number("the trajectory's duration", motion.end, positive=True)
    count = max(2, min(ceil(T * FRAME_RATE), MOST_FRAMES))
    times = np.linspace(0.0, T, count + 1)
    rate = count / T
    last = count + max(1, round(HOLD * rate))
    states = real_array("q(t) of the trajectory", motion(times), (len(times), robot.nv))
    course = None if target is None else np.array([_in_space(target(float(t))) for t in times])
    scene = Scene(robot, rate)
    trail = np.array([forward_kinematics(robot, q).translation for q in states])
    seen = [trail]
    for frame, q in [*enumerate(states), (last, states[-1])]:
        scene.pose(q, frame)
        seen.append(scene.corners())
    scene.pose(states[0])
    for frame, (start, end) in enumerate(pairwise(trail), start=1):
        scene.rod(f"trail/{frame}", start, end, THIN * robot.reach, TRAIL)
        scene.appear(f"trail/{frame}", frame, last)
    if course is not None:
        _show_target(scene, course, last, robot.reach)
        seen.append(course)
    scene.animate()
    return write_page(path, scene.window.commands, np.vstack(seen), title or robot.name, caption, duration=T)


def view(robot: Robot, q: npt.ArrayLike, path: str | Path, *, title: str | None = None, caption: str = "") -> Path:
    """Write a page that shows the robot at q, one offline HTML file, and return its path.

    Raises:
        MissingExtraError: Meshcat is not installed.
        InputError: q has the wrong shape or is not finite, or the file cannot be written there.

    Warns:
        RobotWarning: a mesh cannot be read, and is not drawn.
    """
    q = robot.configuration(q)
    scene = Scene(robot)
    scene.pose(q)
    return write_page(path, scene.window.commands, scene.corners(), title or robot.name, caption, duration=0.0)


def _show_target(scene: Scene, course: Array, last: int, reach: float) -> None:
    scene.dots("target/path", course[::4], THIN * reach, TARGET)
    scene.ball("target/ball", 5 * THIN * reach, TARGET)
    for frame, position in [*enumerate(course), (last, course[-1])]:
        scene.move("target/ball", position, frame)
    scene.move("target/ball", course[0])


def _in_space(p: npt.ArrayLike) -> Array:
    point = real_array("p(t) of the target", p, (None,), "two or three coordinates")
    if point.size not in (2, 3):
        raise InputError(f"p(t) of the target must have two or three coordinates; it has {point.size}")
    return np.pad(point, (0, 3 - point.size))
