"""Plots of paths in the plane and in space, with frames along them."""

from pathlib import Path
from typing import Any

import numpy as np

from robotics1.curves.composition import PathTrajectory
from robotics1.curves.curve import Curve
from robotics1.curves.frenet import frenet_frame
from robotics1.curves.given import as_curve
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, text
from robotics1.viewer.plot_figures import STYLES, new_figure, smooth_samples, write_svg

AXIS = 0.12  # length of a drawn axis, of the size of the path
SPATIAL = 0.82  # of the figure, so that the labels of three axes have room


def plot_path(curve: Any, path: str | Path, *, frames: int = 0, unit: str = "m", title: str = "") -> Path:
    """Draw a path in the plane or in space, write it as SVG and return the path.

    The start is a circle, the end a square, a break a cross, and the middle has an arrow head in the plane.

    Args:
        curve: a path of two or three coordinates, a path of poses, or a trajectory of either.
        path: the file to write.
        frames: how many frames to draw along it: of poses theirs, x solid, y dashed, z dotted; of paths the Frenet
            frame, the tangent solid, the normal dashed, the binormal dotted.
        unit: of the coordinates.
        title: above the plot.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: it has not two or three coordinates, or the file cannot be written there.
    """
    counting_number("frames", frames)
    text("unit", unit)
    curve = as_curve("curve", curve, derivatives=0)
    ends = curve.ends
    points = np.concatenate([_points(curve, s) for _, s in smooth_samples(ends)])
    n = points.shape[1]
    if n not in (2, 3):
        raise InputError(f"a path of two or three coordinates can be drawn; this one has {n}")
    figure = new_figure((6.4, 5.4))
    axes: Any = figure.add_subplot(projection="3d") if n == 3 else figure.add_subplot()
    axes.plot(*points.T, "-", color="C0", label="path")
    axes.plot(*points[:1].T, "o", color="black", label="start")
    axes.plot(*points[-1:].T, "s", color="black", label="end")
    if len(ends) > 2:
        axes.plot(*_points(curve, np.array(ends[1:-1])).T, "x", color="C3", label="break")
    size = AXIS * float(np.ptp(points, axis=0).max())
    for s in np.linspace(0.0, ends[-1], frames) if frames else ():
        _draw_frame(axes, curve, float(s), size, n)
    labels = {f"{name}label": f"{name} [{unit}]" for name in "xyz"[:n]}
    axes.set(title=title, aspect="equal", **labels)
    axes.grid(visible=True, alpha=0.4)
    axes.legend()
    if n == 3:
        axes.set_box_aspect(axes.get_box_aspect(), zoom=SPATIAL)
        for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
            axis.labelpad = 8.0
        axes.locator_params(nbins=5)
    else:
        middle = len(points) // 2
        axes.annotate("", points[middle + 1], points[middle], arrowprops={"arrowstyle": "->", "color": "C0", "lw": 2})
    return write_svg(figure, path)


def _points(curve: Curve, s: Array) -> Array:
    """Return the positions, (k, n)."""
    values = curve(s)
    if len(values) and hasattr(values[0], "translation"):
        return np.array([value.translation for value in values])
    if np.ndim(values) != 2:
        raise InputError("a path of points or of poses can be drawn; this one has neither")
    return np.asarray(values)


def _draw_frame(axes: Any, curve: Curve, s: float, size: float, n: int) -> None:
    """Draw the axes of a pose, or as many of the Frenet frame as there are."""
    value = curve(s)
    if hasattr(value, "rotation"):
        origin, directions = value.translation, list(value.rotation.T)
    else:
        if isinstance(curve, PathTrajectory):  # of a motion at rest the path still has a tangent
            s, curve = min(float(curve.law(s)), curve.path.end), curve.path
        frame = frenet_frame(curve, s)
        origin, directions = frame.position, [frame.tangent, frame.normal, frame.binormal]
    for direction, style in zip(directions[:n], STYLES[:2] + STYLES[3:], strict=False):
        if direction is not None:
            tip = origin + size * direction
            axes.plot(*np.array([origin, tip])[:, :n].T, style, color="C3", linewidth=1.2)
