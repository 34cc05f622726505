"""Plots of workspaces: the regions with their numbers of solutions, and the boundary with its reasons."""

from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.plots.figures import drawn, legend_text, line_style, new_axes
from robotics1.workspaces.result import BoundaryCurve, Workspace, WorkspaceRegion

HATCHES = {0: "", 1: "//", 2: "", 3: "..", 4: "xx"}  # so that regions differ without colour
LONG_LABEL = 36  # letters of a label; two longer ones do not fit beside each other
SMALL = 1e-3  # of the whole area: a region without a number in it
COLORS = {1: "#fdd49e", 2: "#9ecae1", 3: "#c7e9c0", 4: "#bcbddc"}  # of the number of solutions


def plot_workspace(ws: Workspace, ax: Any = None, *, file: str | Path | None = None, title: str = "") -> Any:
    """Draw the regions of a workspace and its boundary, and return the axes.

    Each region has the number of its solutions written in it, and a colour and hatching by this number; of a redundant
    arm it says "reached". The curves of the boundary have one kind of line for each reason, which the legend tells: a
    joint at a limit, or joints that are singular together. Cusps are stars, and crossings of singular curves squares.
    Of an arm in space it is the section, see `Workspace`; a line of dashes and dots is the axis of a first joint that
    turns.

    Args:
        ws: what `workspaces.workspace` returns.
        ax: the Matplotlib axes to draw in; by default those of a new figure.
        file: where to write the figure, as .svg, .pdf or .png.
        title: above the plot.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: it is no workspace, or the file has another suffix or cannot be written there.
    """
    if not isinstance(ws, Workspace):
        raise InputError(f"ws must be what workspace(robot, task) returns, not {ws!r}")
    panel = new_axes(ax, 2)
    for region in ws.regions:
        _fill(panel, region, ws.area, ws.redundant)
    reasons = list(dict.fromkeys(map(_why, ws.boundary)))
    for i, reason in enumerate(reasons):
        lines = [np.vstack([curve.points, [[np.nan, np.nan]]]) for curve in ws.boundary if _why(curve) == reason]
        panel.plot(*np.vstack(lines).T, label=legend_text(reason), color=f"C{i}", linewidth=1.8, **line_style(i))
    panel.autoscale_view()
    x, y = ws.coordinates
    panel.set_aspect("equal", adjustable="box")
    if x == "ρ":
        panel.axvline(0, color="0.3", linestyle=(0, (8, 3, 1, 3)), linewidth=0.9, label="axis of the first joint")
    panel.set(xlabel=f"{x} [m]", ylabel=f"{y} [m]", title=title)
    panel.grid(visible=True, alpha=0.4)
    for points, marker, label in (
        (ws.cusps, "k*", "cusp: three solutions meet"),
        (ws.nodes, "ks", "critical curves cross"),
    ):
        if len(points):
            panel.plot(*points.T, marker, label=label, markersize=6, markerfacecolor="white")
    labels = panel.get_legend_handles_labels()[1]
    if labels:
        columns = 2 if max(map(len, labels)) <= LONG_LABEL else 1
        panel.legend(loc="upper center", bbox_to_anchor=(0.5, 0), borderaxespad=4.5, ncols=columns, fontsize="small")
    return drawn(panel, file)


def _why(curve: BoundaryCurve) -> str:
    """Return in few words why a curve is a boundary."""
    parts = [f"{name} at its {limit} limit" for name, limit in curve.limits.items()]
    return "; ".join(parts + ([f"{', '.join(curve.singular)} singular"] if curve.singular else []))


def _fill(panel: Any, region: WorkspaceRegion, area: float, redundant: bool) -> None:
    """Fill a region but its holes, and write its number of solutions into it."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    closed = [np.vstack([line, line[:1]]) for line in region.outline]
    outline = Outline.make_compound_path(*[Outline(line, closed=True) for line in closed])
    color, hatch = COLORS.get(region.solutions, "0.85"), HATCHES.get(region.solutions, "++")
    panel.add_patch(PathPatch(outline, facecolor=color, edgecolor="0.55", hatch=hatch, linewidth=0.6))
    if region.area < SMALL * area:
        return
    word = "reached" if redundant else str(region.solutions)
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}
    panel.text(*region.point, word, ha="center", va="center", fontsize="small", bbox=box)
