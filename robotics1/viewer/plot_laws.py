"""Plots of timing laws: s, its derivatives, and the bounds they keep."""

from pathlib import Path

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_law
from robotics1.inputs import text
from robotics1.trajectories.limits import MotionLimits
from robotics1.viewer.plot_figures import new_figure, smooth_samples, write_svg

PANELS = (("s", "", ""), ("velocity", "ds/dt", "/s"), ("acceleration", "d²s/dt²", "/s²"), ("jerk", "d³s/dt³", "/s³"))


def plot_timing_law(
    law: Curve, path: str | Path, *, limits: MotionLimits | None = None, unit: str = "m", title: str = ""
) -> Path:
    """Draw s(t) and its three derivatives, write it as SVG and return the path.

    The bounds are dashed, the switching times dotted, and the peak of each derivative is marked with its value.

    Args:
        law: s(t).
        path: the file to write.
        limits: the bounds on velocity, acceleration and jerk.
        unit: of s: "m", "rad", or "1".
        title: above the plots.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: the limits are for several joints, or the file cannot be written there.
    """
    text("unit", unit)
    law = as_law("law", law)
    pieces = smooth_samples(law.ends)
    t = np.concatenate([times for _, times in pieces])
    bounds = MotionLimits().of_joints(1) if limits is None else limits.of_joints(1)
    peaks = [None, *(law.peak(order) for order in (1, 2, 3))]
    figure = new_figure((6.4, 8.2))
    panels = figure.subplots(4, 1, sharex=True)
    for axes, (quantity, symbol, per), peak in zip(panels, PANELS, peaks, strict=True):
        rate = None if quantity == "s" else getattr(law, quantity)
        values = np.concatenate([np.asarray(law(x) if rate is None else rate(x, side=side)) for side, x in pieces])
        axes.plot(t, values, "-", color="black")
        for instant in law.breakpoints:
            axes.axvline(instant, color="grey", linestyle=":", linewidth=0.9)
        if quantity != "s" and np.isfinite(bound := float(getattr(bounds, quantity)[0])):
            axes.axhline(bound, color="C3", linestyle="--", label=f"bound {bound:.4g}")
            if values.min() < 0:
                axes.axhline(-bound, color="C3", linestyle="--")
        if peak is not None:
            label = f"peak {peak.value:.4g} at t = {peak.time:.4g} s"
            axes.plot(peak.time, peak.value, "o", color="C0", label=label)
            axes.legend(loc="best", fontsize="small")
        axes.set(ylabel=f"{symbol or quantity} [{unit}{per}]")
        axes.margins(y=0.12)
        axes.grid(alpha=0.4)
    panels[0].set(title=title)
    panels[-1].set(xlabel="t [s]")
    return write_svg(figure, path)
