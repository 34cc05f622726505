"""Plots of any trajectory against time: position, velocity and acceleration."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.trajectories.limits import MotionLimits
from robotics1.viewer.plot_figures import legend_text, line_style, names_of, new_figure, smooth_samples, write_svg

TURNS = ("θx", "θy", "θz")
PANELS = (("position", ""), ("velocity", "/s"), ("acceleration", "/s²"))


def plot_trajectory(
    trajectory: Any,
    path: str | Path,
    *,
    robot: Robot | None = None,
    names: Sequence[str] | None = None,
    units: str | Sequence[str] | None = None,
    limits: MotionLimits | None = None,
    title: str = "",
) -> Path:
    """Draw position, velocity and acceleration of every coordinate over time, write it as SVG and return the path.

    Where a value jumps it is drawn upright. Of poses the position is (p, θ), with the rotation vector θ from the start.

    Args:
        trajectory: of joints, of points, of poses.
        path: the file to write.
        robot: whose joints move; it gives the names and units.
        names: of the coordinates; by default those of the robot's joints, (x, y, z, θx, θy, θz) of poses, or numbers.
        units: of the coordinates, such as "m" for all, or ["m", "rad"]; by default those of the joints or of poses.
        limits: drawn thin, both ways, in the line style of their coordinate; one bound for all is dashed.
        title: above the plots.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: names or units are too many or too few, or the file cannot be written there.
    """
    motion = as_curve("trajectory", trajectory, derivatives=2)
    pieces = smooth_samples(motion.ends)
    t = np.concatenate([times for _, times in pieces])
    values = [np.concatenate([_positions(motion, times) for _, times in pieces])]
    for quantity in ("velocity", "acceleration"):
        rate = getattr(motion, quantity)
        values.append(np.concatenate([np.asarray(rate(times, side=side)) for side, times in pieces]))
    default = _labels(motion(0.0), values[0].shape[1], values[1].shape[1], robot)
    names = names_of("names", names, default[0])
    units = names_of("units", [units] * len(names) if isinstance(units, str) else units, default[1])
    bounds = None if limits is None else limits.of_joints(len(names))
    figure = new_figure((6.4, 7.4))
    panels = figure.subplots(3, 1, sharex=True)
    same = len(set(units)) == 1
    for axes, (quantity, per), curves in zip(panels, PANELS, values, strict=True):
        for i, (name, unit) in enumerate(zip(names, units, strict=True)):
            axes.plot(t, curves[:, i], label=name if same else f"{name} [{unit}{per}]", **line_style(i))
        if bounds is not None and quantity != "position":
            _draw_bounds(axes, getattr(bounds, quantity))
        axes.set(ylabel=f"{quantity} [{units[0]}{per}]" if same else quantity)
        axes.grid(alpha=0.4)
        if names:
            axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    panels[0].set(title=title)
    panels[-1].set(xlabel="t [s]")
    return write_svg(figure, path)


def _draw_bounds(axes: Any, bounds: Array) -> None:
    """Draw the bounds both ways: in the line style of their coordinate, or once where they are all the same."""
    same = len(set(bounds)) == 1
    for i, bound in enumerate(bounds[:1] if same else bounds):
        style = {"color": "black", "linestyle": "--"} if same else {**line_style(i), "marker": "", "color": f"C{i}"}
        if np.isfinite(bound):
            for sign in (1, -1):
                axes.axhline(sign * bound, linewidth=0.8, **style)


def _positions(trajectory: Curve, t: Array) -> Array:
    """Return the positions, (k, n); of poses (p, log(R R₀ᵀ)), of orientations log(R R₀ᵀ)."""
    import pinocchio as pin

    values, start = trajectory(t), trajectory(0.0)
    if hasattr(start, "rotation"):
        turns = [np.asarray(pin.log3(value.rotation @ start.rotation.T)) for value in values]
        return np.array([[*value.translation, *turn] for value, turn in zip(values, turns, strict=True)])
    if np.ndim(start) == 2:
        return np.array([pin.log3(value @ start.T) for value in values])
    return np.asarray(values)


def _labels(start: Any, n: int, rates: int, robot: Robot | None) -> tuple[list[str], list[str]]:
    """Return names and units of the coordinates: of a robot's joints, of a pose, of a rotation, or numbers."""
    if n != rates:
        raise InputError(f"the trajectory has {n} coordinates and {rates} velocities; both must be as many")
    if robot is not None:
        if robot.nv != n:
            raise InputError(f"robot {robot.name!r} has {robot.nv} joints; the trajectory moves {n}")
        return list(map(legend_text, robot.joint_names)), ["rad" if angle else "m" for angle in robot.revolute]
    if hasattr(start, "rotation"):
        return [*"xyz", *TURNS], ["m"] * 3 + ["rad"] * 3
    if np.ndim(start) == 2:
        return list(TURNS), ["rad"] * 3
    return [str(i + 1) for i in range(n)], ["1"] * n
