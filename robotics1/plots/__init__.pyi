"""The public names of `robotics1.plots`, and where they are."""

from .against_time import plot_run, plot_timing_law, plot_trajectory
from .ellipses import plot_ellipses
from .paths import plot_path
from .reach import plot_workspace
from .reachability import plot_reachability

__all__ = [
    "plot_ellipses",
    "plot_path",
    "plot_reachability",
    "plot_run",
    "plot_timing_law",
    "plot_trajectory",
    "plot_workspace",
]
