"""Figures as SVG files: made without pyplot's state, the same bytes each time, lines that differ without colour."""

from collections.abc import Sequence
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from robotics1.errors import InputError, MissingExtraError
from robotics1.files import write_file
from robotics1.inputs import Array, text
from robotics1.names import printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STYLES = ("-", "--", "-.", ":")  # so that lines can be told apart without colour
MARKERS = ("", "o", "s", "^", "x")  # of the fifth line, the ninth, ...
SAMPLES = 201  # on each smooth piece


def new_figure(size: tuple[float, float]) -> "Figure":
    """Return an empty figure of a size in inches.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise MissingExtraError("matplotlib", "plots") from error
    return Figure(figsize=size, layout="constrained")


def write_svg(figure: "Figure", path: str | Path) -> Path:
    """Write a figure as SVG and return the path.

    Raises:
        InputError: the file cannot be written there.
    """
    from matplotlib import rc_context

    drawn = BytesIO()
    with rc_context({"svg.hashsalt": "robotics1"}):  # the same figure gives the same bytes
        figure.savefig(drawn, format="svg", metadata={"Date": None})
    return write_file(path, drawn.getvalue())


def legend_text(name: str) -> str:
    """Return a name from a file as Matplotlib draws it: $ begins no formula, and _ at the start hides no line."""
    text = printable(name).replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text


def line_style(i: int) -> dict[str, Any]:
    """Return how the i-th line of a plot is drawn: twenty that can be told apart without colour."""
    marker = MARKERS[i // 4 % len(MARKERS)]
    return {"linestyle": STYLES[i % 4], "marker": marker, "markevery": (10 * (i % 4) + 5, 40), "markersize": 4}


def smooth_samples(ends: Sequence[float], samples: int = SAMPLES) -> list[tuple[str, Array]]:
    """Return the instants to draw, with the side from which each is taken: what jumps at an end is drawn upright."""
    pieces: list[tuple[str, Array]] = []
    for a, b in pairwise(ends):
        t = np.linspace(a, b, samples)
        pieces += [("right", t[:-1]), ("left", t[-1:])]
    return pieces


def names_of(name: str, given: Sequence[str] | None, default: Sequence[str]) -> list[str]:
    """Return one text for each coordinate.

    Raises:
        InputError: there are more or fewer, or they are no texts.
    """
    if given is None:
        return list(default)
    listed = [] if isinstance(given, str) or not np.iterable(given) else list(given)
    if len(listed) != len(default):
        raise InputError(f"{name} must be {len(default)} texts, one for each coordinate; it is {given!r}")
    for entry in listed:
        if not text(f"one of {name}", entry) or entry.startswith("_"):  # Matplotlib keeps such from the legend
            raise InputError(f"one of {name} must be a word; it is {entry!r}")
    return listed
