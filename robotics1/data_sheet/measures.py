"""Sections with pictures: ellipsoids at the posture, scan of σ_min."""

import numpy as np

from robotics1.data_sheet.asked import Answer, Asked, open_note, open_slides
from robotics1.data_sheet.markup import figure, paragraphs, sentences, table
from robotics1.least_squares import numeric_rank
from robotics1.notation import count, number, vector
from robotics1.plots.ellipses import plot_ellipses
from robotics1.plots.figures import new_axes
from robotics1.singularities.scan import scan_singularities
from robotics1.singularities.scan_result import SingularityScan
from robotics1.tasks.position import PositionTask
from robotics1.tasks.rows import unitless_jacobian
from robotics1.viewer.arm_data import is_planar

SCANNED = 100_000
PER_OCTAVE = 2  # bars of the histogram


def ellipsoids(asked: Asked) -> Answer:
    """Return the velocity and force ellipsoids of the tool's point at the posture."""
    robot, task = asked.robot, asked.require_task()
    point = PositionTask("xy" if is_planar(robot) else "xyz", frame=asked.frame)
    caption = f"The arm at q = {vector(asked.q)}, with the ellipsoids of its tool's velocity and force"
    text = figure(lambda: plot_ellipses(robot, point, asked.q), caption)
    sigma = np.linalg.svd(unitless_jacobian(robot, task, asked.q), compute_uv=False)
    rows = [(f"σ{i}", number(value)) for i, value in enumerate(sigma, 1)]
    rank = numeric_rank(sigma)
    ratio = f"{sigma[0] / sigma[-1]:.4g}" if rank == len(sigma) else f"∞, since J has rank {rank} of {len(sigma)}"
    rows += [("σ_max/σ_min", ratio), ("manipulability, the product", f"{np.prod(sigma):.4g}")]
    text += paragraphs(
        "Where the ellipse of velocity is long, the tool is fast and its force small; the other way round for force.",
        f"Singular values of J at this posture, lengths in units of the reach ({robot.reach:.4g} m):",
    )
    return Answer(text + table(("", "value"), rows), f"σ_max/σ_min = {ratio} at the posture")


def scan(asked: Asked) -> Answer:
    """Return how often the arm is how near to singular."""
    robot, task = asked.robot, asked.require_task()
    found = scan_singularities(robot, task, samples=SCANNED, length=robot.reach, box=open_slides(asked))
    half = found.quantile(0.5)
    text = figure(
        lambda: _histogram(found), f"σ_min of J at {found.count} random configurations, lengths in units of the reach"
    )
    text += sentences(found.explain()) + open_note(asked)
    return Answer(text, f"half of {count(found.count, 'configuration')} have σ_min below {half:.3g}, J without units")


def _histogram(found: SingularityScan) -> object:
    edges, counts = found.histogram(per_octave=PER_OCTAVE)
    shown = counts > 0
    panel = new_axes(None, 2)
    panel.bar(
        edges[:-1][shown], 100 * counts[shown] / found.count, np.diff(edges)[shown], align="edge", color="#7fb3c8"
    )
    for p, style in ((0.01, "--"), (0.5, "-")):
        panel.axvline(found.quantile(p), linestyle=style, color="0.2", label=f"{100 * p:g} % are below")
    panel.set(xscale="log", xlabel="σ_min", ylabel="configurations [%]")
    panel.legend()
    return panel
