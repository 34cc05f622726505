"""Plots of paths in the plane and in space: those of a point, of a pose, and of a robot's tool."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal

import numpy as np

from robotics1.curves.composition import PathTrajectory
from robotics1.curves.curve import Curve
from robotics1.curves.frenet import frenet_frame
from robotics1.curves.given import as_curve, joint_motion
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, one_of, text
from robotics1.plots.figures import MOST_DRAWN, PLANES, STYLES, drawn, new_axes, new_projections, smooth_samples
from robotics1.robot.given import RobotLike, robot_from
from robotics1.tasks.pose import PoseTask
from robotics1.trajectories.following.task_rates import TaskTrajectory
from robotics1.trajectories.target_motion import TargetMotion

Projection = Literal["3d", "projections"]
AXIS = 0.12  # length of a drawn axis, of the size of the path
SPATIAL = 0.82  # of the figure, so that the labels of three axes have room
Line = tuple[str, Array, dict[str, Any]]  # the label, the points (k, n), how they are drawn
FLAT = 1e-9  # of the reach: a height that changes less is that of a planar arm


def plot_path(
    curve: Any,
    ax: Any = None,
    *,
    robot: RobotLike | None = None,
    projection: Projection = "3d",
    file: str | Path | None = None,
    frames: int = 0,
    target: TargetMotion | None = None,
    unit: str = "m",
    title: str = "",
) -> Any:
    """Draw a path in the plane or in space, and return the axes.

    The start is a circle, the end a square, a breakpoint a cross, and the middle has an arrow head in the plane.

    Args:
        curve: a path of two or three coordinates, a path of poses, or a trajectory of either; with a robot, a motion of
            its joints, and the path is that of its tool.
        ax: the Matplotlib axes to draw in, three-dimensional for a path in space, or three for the projections; by
            default those of a new figure.
        robot: whose tool moves; that of a planar arm is drawn in the plane.
        projection: how a path in space is drawn: "3d", in perspective, or "projections", into the three planes xy, xz
            and yz.
        file: where to write the figure, as .svg, .pdf or .png.
        frames: how many frames to draw along it: of poses theirs, x solid, y dashed, z dotted; of paths the Frenet
            frame, the tangent solid, the normal dashed, the binormal dotted.
        target: a moving point, dotted, at the instants of the trajectory.
        unit: of the coordinates.
        title: above the plot.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: it has not two or three coordinates, the motion is of other joints, or the file has another suffix
            or cannot be written there.
    """
    counting_number("frames", frames, most=MOST_DRAWN)
    text("unit", unit)
    one_of("projection", projection, ("3d", "projections"))
    robot = None if robot is None else robot_from(robot)
    if robot is None:
        curve = as_curve("curve", curve, derivatives=0)
    else:
        curve = TaskTrajectory(robot, PoseTask(), joint_motion("curve", curve, robot.nv, derivatives=2))
    samples = [s for _, s in smooth_samples(curve.ends)]
    points = np.concatenate([_points(curve, s) for s in samples])
    if robot is not None and np.ptp(points[:, 2]) <= FLAT * robot.reach:
        points = points[:, :2]
    n = points.shape[1]
    if n not in (2, 3):
        raise InputError(f"a path of two or three coordinates can be drawn; this one has {n}")
    lines = _lines(curve, samples, points, target)
    size = AXIS * float(np.ptp(points, axis=0).max())
    for s in np.linspace(0.0, curve.end, frames) if frames else ():
        lines += _frame(curve, float(s), size, n)
    if n == 3 and projection == "projections":
        panels = new_projections(ax)
        for panel, plane in zip(panels, PLANES, strict=True):
            _draw(panel, lines, plane, unit)
            panel.set_aspect("equal", adjustable="datalim")
        panels[0].set(title=title)
        panels[-1].legend(*panels[0].get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(1.0, 1.0))
        return drawn(panels, file)
    axes = new_axes(ax, n)
    _draw(axes, lines, tuple(range(n)), unit)
    axes.set(title=title)
    axes.legend()
    return drawn(axes, file)


def _lines(curve: Curve, samples: Sequence[Array], points: Array, target: TargetMotion | None) -> list[Line]:
    """Return the path, its ends and breakpoints, and the moving point, as lines."""
    n = points.shape[1]
    lines: list[Line] = [
        ("path", points, {"linestyle": "-", "color": "C0"}),
        ("start", points[:1], {"marker": "o", "linestyle": "", "color": "black"}),
        ("end", points[-1:], {"marker": "s", "linestyle": "", "color": "black"}),
    ]
    if len(curve.breakpoints):
        breaks = _points(curve, curve.breakpoints)[:, :n]
        lines.append(("break", breaks, {"marker": "x", "linestyle": "", "color": "C3"}))
    if target is not None:
        course = np.array([np.asarray(target(float(t)))[:n] for t in np.concatenate(samples)])
        lines.append(("target", course, {"linestyle": ":", "color": "green", "linewidth": 2}))
    return lines


def _draw(axes: Any, lines: Sequence[Line], columns: Sequence[int], unit: str) -> None:
    """Draw the given columns of lines of points, with labels; in the plane the first line has an arrow head."""
    for label, points, style in lines:
        axes.plot(*points[:, columns].T, label=label, **style)
    letters = [name for name, _ in zip("xyz", columns, strict=False)]
    axes.set(aspect="equal", **{f"{a}label": f"{'xyz'[k]} [{unit}]" for a, k in zip(letters, columns, strict=True)})
    axes.grid(visible=True, alpha=0.4)
    if len(columns) == 3:
        axes.set_box_aspect(axes.get_box_aspect(), zoom=SPATIAL)
        for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
            axis.labelpad = 8.0
        axes.locator_params(nbins=5)
    else:
        points = lines[0][1][:, columns]
        middle = len(points) // 2
        axes.annotate("", points[middle + 1], points[middle], arrowprops={"arrowstyle": "->", "color": "C0", "lw": 2})


def _points(curve: Curve, s: Array) -> Array:
    """Return the positions, (k, n)."""
    values = curve(s)
    if len(values) and hasattr(values[0], "translation"):
        return np.array([value.translation for value in values])
    if np.ndim(values) != 2:
        raise InputError("a path of points or of poses can be drawn; this one has neither")
    return np.asarray(values)


def _frame(curve: Curve, s: float, size: float, n: int) -> list[Line]:
    """Return the axes of a pose, or as many of the Frenet frame as there are, as lines."""
    value = curve(s)
    if hasattr(value, "rotation"):
        origin, directions = value.translation, list(value.rotation.T)
    else:
        if isinstance(curve, PathTrajectory):  # a motion at rest has a tangent where its path has one
            s, curve = min(float(curve.law(s)), curve.path.end), curve.path
        frame = frenet_frame(curve, s)
        origin, directions = frame.position, [frame.tangent, frame.normal, frame.binormal]
    return [
        (
            "",
            np.array([origin, origin + size * direction])[:, :n],
            {"linestyle": style, "color": "C3", "linewidth": 1.2},
        )
        for direction, style in zip(directions[:n], STYLES[:2] + STYLES[3:], strict=False)
        if direction is not None
    ]
