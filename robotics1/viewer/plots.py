"""Plots of joint motions and of the tool's path, as SVG."""

from pathlib import Path

import numpy as np

from robotics1.curves.given import Motion, joint_motion
from robotics1.kinematics import forward_kinematics
from robotics1.robot.model import Robot
from robotics1.trajectories.target_motion import TargetMotion
from robotics1.viewer.plot_figures import SAMPLES, legend_text, line_style, new_figure as _figure, write_svg as _write


def plot_joint_motion(robot: Robot, trajectory: Motion, path: str | Path, *, title: str = "") -> Path:
    """Draw q(t) above q̇(t), write it as SVG and return the path.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: the trajectory is not of the robot's joints, or the file cannot be written there.
    """
    motion = joint_motion("trajectory", trajectory, robot.nv)
    figure = _figure((6.4, 5.6))
    upper, lower = figure.subplots(2, 1, sharex=True)
    t = np.linspace(0.0, motion.end, SAMPLES)
    units = ["rad" if angle else "m" for angle in robot.revolute]
    for i, (name, q, v) in enumerate(zip(robot.joint_names, motion(t).T, motion.velocity(t).T, strict=True)):
        upper.plot(t, q, label=f"{legend_text(name)} [{units[i]}]", **line_style(i))
        lower.plot(t, v, label=f"{legend_text(name)} [{units[i]}/s]", **line_style(i))
    upper.set(ylabel="joint position", title=title)
    lower.set(xlabel="t [s]", ylabel="joint velocity")
    for axes in (upper, lower):
        axes.grid(alpha=0.4)
        if robot.nv:
            axes.legend()
    return _write(figure, path)


def plot_tool_path(
    robot: Robot,
    trajectory: Motion,
    path: str | Path,
    *,
    target: TargetMotion | None = None,
    title: str = "",
) -> Path:
    """Draw the path of the tool in the xy plane, with the target's path dotted, write it as SVG and return the path.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: the trajectory is not of the robot's joints, or the file cannot be written there.
    """
    motion = joint_motion("trajectory", trajectory, robot.nv)
    figure = _figure((6.4, 5.0))
    axes = figure.subplots()
    t = np.linspace(0.0, motion.end, SAMPLES)
    x, y, _ = np.array([forward_kinematics(robot, q).translation for q in motion(t)]).T
    axes.plot(x, y, "-", label="tool")
    axes.plot(x[0], y[0], "o", color="C0", label="start")
    axes.plot(x[-1], y[-1], "s", color="C3", label="end")
    if target is not None:
        course = np.array([np.asarray(target(float(time)))[:2] for time in t])
        axes.plot(*course.T, ":", color="green", linewidth=2, label="target")
    axes.set(xlabel="x [m]", ylabel="y [m]", title=title, aspect="equal")
    axes.grid(alpha=0.4)
    axes.legend()
    return _write(figure, path)
