"""Plots against time: of motions, of timing laws with their bounds, and of the joints and the errors of a run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve, as_law
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, text
from robotics1.plots.figures import (
    draw_coordinates,
    drawn_over_time,
    legend_text,
    line_style,
    names_of,
    panels_of,
    smooth_samples,
)
from robotics1.robot.given import RobotLike, robot_from
from robotics1.trajectories.limits import MotionLimits

QUANTITIES = ("position", "velocity", "acceleration", "jerk")
PER = ("", "/s", "/s²", "/s³")
SYMBOLS = ("s", "ds/dt", "d²s/dt²", "d³s/dt³")
TURNS = ("θx", "θy", "θz")


def plot_trajectory(
    trajectory: Any,
    ax: Sequence[Any] | None = None,
    *,
    file: str | Path | None = None,
    robot: RobotLike | None = None,
    names: Sequence[str] | None = None,
    units: str | Sequence[str] | None = None,
    limits: MotionLimits | None = None,
    derivatives: int = 2,
    title: str = "",
) -> Any:
    """Draw every coordinate of a motion over time, and its derivatives; return the axes, one for each.

    Where a value jumps it is drawn upright. Of poses the position is (p, θ), with the rotation vector θ from the start.

    Args:
        trajectory: of joints, of points, of poses.
        ax: the Matplotlib axes to draw in, one for the position and each derivative; by default those of a new figure.
        file: where to write the figure, as .svg, .pdf or .png.
        robot: whose joints move; it gives the names and units.
        names: of the coordinates; by default those of the robot's joints, (x, y, z, θx, θy, θz) of poses, or numbers.
        units: of the coordinates, such as "m" for all, or ["m", "rad"]; by default those of the joints or of poses.
        limits: drawn thin, both ways, in the line style of their coordinate; one bound for all is dashed.
        derivatives: 1 for the velocity, 2 for the acceleration too, 3 for the jerk.
        title: above the plots.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: names or units are too many or too few, the axes are of another number, or the file has another
            suffix or cannot be written there.
    """
    motion = as_curve("trajectory", trajectory, derivatives=min(counting_number("derivatives", derivatives), 3))
    pieces = smooth_samples(motion.ends)
    t = np.concatenate([times for _, times in pieces])
    values = [np.concatenate([_positions(motion, times) for _, times in pieces])]
    values += [
        np.concatenate([motion.derivative(times, order, side=side) for side, times in pieces])
        for order in range(1, derivatives + 1)
    ]
    if not motion.shape:
        values = [x[:, None] for x in values]
    default = _labels(motion(0.0), values[0].shape[1], motion.dimension, robot)
    names = names_of("names", names, default[0])
    units = names_of("units", [units] * len(names) if isinstance(units, str) else units, default[1])
    bounds = None if limits is None else limits.of_joints(len(names))
    panels = panels_of(ax, derivatives + 1)
    same = len(set(units)) == 1
    for panel, quantity, per, curves in zip(panels, QUANTITIES, PER, values, strict=False):
        labels = names if same else [f"{name} [{unit}{per}]" for name, unit in zip(names, units, strict=True)]
        draw_coordinates(panel, t, curves, labels, f"{quantity} [{units[0]}{per}]" if same else quantity)
        if bounds is not None and quantity != "position":
            _draw_bounds(panel, getattr(bounds, quantity))
    return drawn_over_time(panels, file, title)


def plot_timing_law(
    law: Curve,
    ax: Sequence[Any] | None = None,
    *,
    file: str | Path | None = None,
    limits: MotionLimits | None = None,
    unit: str = "m",
    title: str = "",
) -> Any:
    """Draw s(t) and its three derivatives, and return the four axes.

    The bounds are dashed, the breakpoints dotted, and the peak of each derivative is marked with its value.

    Args:
        law: s(t).
        ax: four Matplotlib axes to draw in; by default those of a new figure.
        file: where to write the figure, as .svg, .pdf or .png.
        limits: the bounds on velocity, acceleration and jerk.
        unit: of s: "m", "rad", or "1".
        title: above the plots.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: the limits are for several joints, or the file has another suffix or cannot be written there.
    """
    text("unit", unit)
    law = as_law("law", law)
    pieces = smooth_samples(law.ends)
    t = np.concatenate([times for _, times in pieces])
    bounds = (limits or MotionLimits()).of_joints(1)
    panels = panels_of(ax, 4)
    for order, panel in enumerate(panels):
        values = np.concatenate([law.derivative(times, order, side=side) for side, times in pieces])
        panel.plot(t, values, "-", color="black")
        for instant in law.breakpoints:
            panel.axvline(instant, color="grey", linestyle=":", linewidth=0.9)
        if order and np.isfinite(bound := float(getattr(bounds, QUANTITIES[order])[0])):
            panel.axhline(bound, color="C3", linestyle="--", label=f"bound {bound:.4g}")
            if values.min() < 0:
                panel.axhline(-bound, color="C3", linestyle="--")
        if order:
            peak = law.peak(order)
            label = f"peak {peak.value:.4g} at t = {peak.time:.4g} s"
            panel.plot(peak.time, peak.value, "o", color="C0", label=label)
            panel.legend(loc="best", fontsize="small")
        panel.set(ylabel=f"{SYMBOLS[order]} [{unit}{PER[order]}]")
        panel.margins(y=0.12)
        panel.grid(alpha=0.4)
    return drawn_over_time(panels, file, title)


def plot_run(
    run: Any,
    ax: Sequence[Any] | None = None,
    *,
    robot: RobotLike | None = None,
    file: str | Path | None = None,
    title: str = "",
) -> Any:
    """Draw q, q̇ and the errors of a run over time; return the axes, one for each, or one for each level's error.

    Args:
        run: what `control.simulate_law` or `redundancy.follow_by_priority` returns.
        ax: the Matplotlib axes to draw in; by default those of a new figure.
        robot: whose joints move; it gives their names.
        file: where to write the figure, as .svg, .pdf or .png.
        title: above the plots.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: it is no run, or one of another robot; the axes are of another number, or the file has another
            suffix or cannot be written there.
    """
    t, q, qdot, errors = _parts(run)
    n = q.shape[1]
    names = [f"q{i + 1}" for i in range(n)] if robot is None else list(map(legend_text, robot_from(robot).joint_names))
    if len(names) != n:
        raise InputError(f"the run has {n} joints, and the robot {len(names)}: give the robot of the run")
    several = len(errors) > 1
    titles = [f"error of level {i}" if several else "error" for i in range(1, len(errors) + 1)]
    panels = panels_of(ax, 2 + len(errors))
    curves = [("position", q, names), ("velocity", qdot, names)]
    curves += [(word, e, [f"e{i + 1}" for i in range(e.shape[1])]) for word, e in zip(titles, errors, strict=True)]
    for panel, (word, values, labels) in zip(panels, curves, strict=True):
        draw_coordinates(panel, t, values, labels, word)
    return drawn_over_time(panels, file, title)


def _draw_bounds(panel: Any, bounds: Array) -> None:
    """Draw the bounds both ways: in the line style of their coordinate, or once where they are all the same."""
    same = len(set(bounds)) == 1
    for i, bound in enumerate(bounds[:1] if same else bounds):
        style = {"color": "black", "linestyle": "--"} if same else {**line_style(i), "marker": "", "color": f"C{i}"}
        if np.isfinite(bound):
            for sign in (1, -1):
                panel.axhline(sign * bound, linewidth=0.8, **style)


def _positions(motion: Curve, t: Array) -> Array:
    """Return the positions, (k, n); of poses (p, log(R R₀ᵀ)), of orientations log(R R₀ᵀ)."""
    import pinocchio as pin

    values, start = motion(t), motion(0.0)
    if hasattr(start, "rotation"):
        turns = [np.asarray(pin.log3(value.rotation @ start.rotation.T)) for value in values]
        return np.array([[*value.translation, *turn] for value, turn in zip(values, turns, strict=True)])
    if np.ndim(start) == 2:
        return np.array([pin.log3(value @ start.T) for value in values])
    return np.asarray(values)


def _labels(start: Any, n: int, rates: int, robot: RobotLike | None) -> tuple[list[str], list[str]]:
    """Return names and units of the coordinates: of a robot's joints, of a pose, of a rotation, or numbers."""
    if n != rates:
        raise InputError(f"the trajectory has {n} coordinates and {rates} velocities; both must be as many")
    if robot is not None:
        robot = robot_from(robot)
        robot.require_single_coordinates("have a motion of one number a joint")
        if robot.nv != n:
            raise InputError(f"robot {robot.name!r} has {robot.nv} joints; the trajectory moves {n}")
        return list(map(legend_text, robot.joint_names)), ["rad" if angle else "m" for angle in robot.revolute]
    if hasattr(start, "rotation"):
        return [*"xyz", *TURNS], ["m"] * 3 + ["rad"] * 3
    if np.ndim(start) == 2:
        return list(TURNS), ["rad"] * 3
    return [str(i + 1) for i in range(n)], ["1"] * n


def _parts(run: Any) -> tuple[Any, Any, Any, tuple[Any, ...]]:
    """Return t, q, q̇ and the errors of a run.

    Raises:
        InputError: it is none.
    """
    errors = getattr(run, "errors", None)
    if errors is None and hasattr(run, "error"):
        errors = (run.error,)
    parts: list[Any] = [getattr(run, name, None) for name in ("t", "q", "qdot")]
    shaped = [np.ndim(part) for part in parts] == [1, 2, 2] and isinstance(errors, tuple)
    if isinstance(run, type) or not shaped or any(np.ndim(e) != 2 for e in errors or ()):
        raise InputError(f"run must be what simulate_law or follow_by_priority returns; it is {run!r}")
    return parts[0], parts[1], parts[2], errors or ()
