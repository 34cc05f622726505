"""Figures as SVG, PDF or PNG files: without pyplot's state, always the same bytes, lines that differ without colour."""

from collections.abc import Sequence
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError, MissingExtraError, shown
from robotics1.files import check_suffix, write_file
from robotics1.inputs import Array, text
from robotics1.names import printable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STYLES = ("-", "--", "-.", ":")  # so that lines differ without colour
MARKERS = ("", "o", "s", "^", "x")  # of the fifth line, the ninth, ...
METADATA: dict[str, dict[str, None]] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}, ".png": {}}
MOST_DRAWN = 10_000  # frames or ellipses in one plot
SAMPLES = 201  # on each smooth piece
PLANES = ((0, 1), (0, 2), (1, 2))  # into which what is in space is projected: xy, xz, yz


def new_axes(ax: Any, dimensions: int) -> Any:
    """Return the axes that are given, or those of a new figure, of two or three dimensions.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: what is given are no axes of so many dimensions.
    """
    if ax is None:
        return _figure((6.4, 5.4)).add_subplot(projection="3d" if dimensions == 3 else None)
    if not hasattr(ax, "plot") or hasattr(ax, "zaxis") != (dimensions == 3):
        raise InputError(f"ax must be Matplotlib axes of {dimensions} dimensions; it is {ax!r}")
    return ax


def panels_of(ax: Any, count: int) -> Any:
    """Return the axes that are given, or so many of a new figure one below the other.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: what is given are not so many axes.
    """
    if ax is None:
        return _figure((6.4, 2.2 + 1.7 * count)).subplots(count, 1, sharex=True)
    panels = np.ravel(np.asarray(ax, dtype=object))
    hint = f"; a file is file={str(ax)!r}" if isinstance(ax, str | Path) else ""
    if len(panels) != count or not all(hasattr(panel, "plot") for panel in panels):
        raise InputError(f"ax must be {count} Matplotlib axes, as from plt.subplots({count}); it is {shown(ax)}{hint}")
    return panels


def new_projections(ax: Any) -> Any:
    """Return the three axes that are given, or those of a new figure side by side, for the projections of `PLANES`.

    Raises:
        MissingExtraError: Matplotlib is not installed.
        InputError: what is given are not three axes.
    """
    return _figure((12.0, 4.2)).subplots(1, len(PLANES)) if ax is None else panels_of(ax, len(PLANES))


def drawn(axes: Any, file: str | Path | None) -> Any:
    """Return the axes; write their figure if there is a file, in the format of its suffix: .svg (or none), .pdf, .png.

    Raises:
        InputError: the file has another suffix, or cannot be written there.
    """
    if file is not None:
        check_suffix("a figure", file, METADATA)
        suffix = Path(str(file)).suffix.lower() or ".svg"
        write_file(file, picture(axes, suffix))
    return axes


def picture(axes: Any, suffix: str) -> bytes:
    """Return the figure of axes as it is written in the format of a suffix; the same figure gives the same bytes."""
    from matplotlib import rc_context

    written = BytesIO()
    with rc_context({"svg.hashsalt": "robotics1"}):
        np.ravel(axes)[0].figure.savefig(
            written, format=suffix[1:], dpi=150, metadata=METADATA[suffix], bbox_inches="tight"
        )
    return written.getvalue()


def _figure(size: tuple[float, float]) -> "Figure":
    """Return an empty figure of a size in inches."""
    try:
        from matplotlib.figure import Figure
    except ImportError as error:
        raise MissingExtraError("matplotlib", "plots") from error
    return Figure(figsize=size, layout="constrained")


def draw_coordinates(panel: Any, t: Array, values: Array, names: Sequence[str], title: str) -> None:
    """Draw the columns of values (k, n) over time, lines that differ without colour, with their names beside them."""
    for i, name in enumerate(names):
        panel.plot(t, values[:, i], label=name, **line_style(i))
    panel.set(ylabel=title)
    panel.grid(alpha=0.4)
    if names:
        panel.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))


def drawn_over_time(panels: Any, file: str | Path | None, title: str) -> Any:
    """Return panels over one time with a title above them, as `drawn` does. Raises as that."""
    panels[0].set(title=title)
    panels[-1].set(xlabel="t [s]")
    return drawn(panels, file)


def legend_text(name: str) -> str:
    """Return a name from a file as Matplotlib draws it: $ begins no formula, and _ at the start hides no line."""
    text = printable(name).replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text


def line_style(i: int) -> dict[str, Any]:
    """Return how the i-th line of a plot is drawn: twenty ways that differ without colour."""
    marker = MARKERS[i // 4 % len(MARKERS)]
    return {"linestyle": STYLES[i % 4], "marker": marker, "markevery": (10 * (i % 4) + 5, 40), "markersize": 4}


def smooth_samples(ends: Sequence[float], samples: int = SAMPLES) -> list[tuple[Side, Array]]:
    """Return the instants to draw, with the side from which each is taken: what jumps at an end is drawn upright."""
    pieces: list[tuple[Side, Array]] = []
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
