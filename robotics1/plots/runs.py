"""Plots of the joints and the errors of a run: of a simulated law, or of tasks followed by priority."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.plots.figures import draw_coordinates, drawn_over_time, legend_text, panels_of
from robotics1.robot.given import RobotLike, robot_from


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
