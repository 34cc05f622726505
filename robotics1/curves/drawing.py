"""How a terminal and a notebook show a curve: a few of its values, and a drawing."""

from collections.abc import Sequence
from html import escape
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.notation import vector
from robotics1.results import Frozen
from robotics1.tables import Table, table_of

DRAWN = 200  # points of a curve
WRITTEN = 5  # of its values
RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
WIDTH, HEIGHT, MARGIN = 420, 170, 34  # of the drawing, and of its edge for numbers [pixels]
DASHES = ("", "6 3", "2 3", "8 3 2 3")  # lines differ without colour
COLORS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#17becf")


class DrawnCurve(Frozen):
    """A base of curves, with values and derivatives at any parameter."""

    of_points: Any
    end: Any

    def _tables(self) -> tuple[Table, ...]:
        t = self._parameters_shown(WRITTEN)
        if t is None:
            return ()
        curve: Any = self
        values, rates = (np.reshape(curve.derivative(t, order), (len(t), -1)) for order in (0, 1))
        rows = [(f"{s:.4g}", vector(x), vector(v)) for s, x, v in zip(t, values, rates, strict=True)]
        return (table_of(("t", "x", "dx/dt"), rows),)

    def _drawings(self) -> tuple[str, ...]:
        t = self._parameters_shown(DRAWN)
        if t is None:
            return ()
        curve: Any = self
        values = np.reshape(curve(t), (len(t), -1))
        return (svg_lines(t, values, [f"x{i + 1}" for i in range(values.shape[1])], "t"),)

    def _parameters_shown(self, count: int) -> Any:
        """Return parameters from 0 to the end; None of a curve of poses, or without an extent."""
        return np.linspace(0, self.end, count) if self.of_points and self.end > 0 else None


def svg_lines(t: Array, values: Array, names: Sequence[str], axis: str) -> str:
    """Return curves over one axis as an SVG element, which a notebook shows without a library for plots.

    Args:
        t: (k,) ascending.
        values: (k, n).
        names: of the n curves.
        axis: what t is.
    """
    low, high = float(values.min()), float(values.max())
    low, high = (low, high) if high > low else (low - 1, high + 1)
    x = MARGIN + (WIDTH - 2 * MARGIN) * (t - t[0]) / ((t[-1] - t[0]) or 1)
    y = HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * (values - low) / (high - low)
    parts = [
        f'<rect x="{MARGIN}" y="{MARGIN}" width="{WIDTH - 2 * MARGIN}" height="{HEIGHT - 2 * MARGIN}" '
        'fill="none" stroke="#999"/>',
        _text(2, MARGIN + 4, f"{high:.4g}"),
        _text(2, HEIGHT - MARGIN, f"{low:.4g}"),
        _text(MARGIN, HEIGHT - MARGIN + 14, f"{t[0]:.4g}"),
        _text(WIDTH - MARGIN, HEIGHT - MARGIN + 14, f"{t[-1]:.4g}  {axis}"),
    ]
    for i, name in enumerate(names):
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y[:, i], strict=True))
        color, dash = COLORS[i % len(COLORS)], DASHES[i % len(DASHES)]
        line = f'stroke="{color}" stroke-dasharray="{dash}"'
        parts.append(f'<polyline points="{points}" fill="none" stroke-width="1.5" {line}/>')
        left = MARGIN + 60 * i
        parts += [f'<line x1="{left}" y1="14" x2="{left + 22}" y2="14" {line}/>', _text(left + 26, 18, name)]
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH + 40}" height="{HEIGHT}">{"".join(parts)}</svg>'


def _text(x: float, y: float, text: str) -> str:
    return f'<text x="{x:g}" y="{y:g}" font-size="11" font-family="sans-serif">{escape(text)}</text>'


def polynomial_text(coefficients: Array, variable: str) -> str:
    """Return a polynomial of ascending coefficients with five digits, as 1 + 0.75 t² − 0.25 t³."""
    written = ""
    for power, c in enumerate(coefficients):
        size = f"{abs(c):.5g}"
        if size == "0":
            continue
        factor = "" if power == 0 else variable if power == 1 else f"{variable}{str(power).translate(RAISED)}"
        term = size if not factor else factor if size == "1" else f"{size} {factor}"
        written += (f" {'−' if c < 0 else '+'} {term}") if written else ("−" if c < 0 else "") + term
    return written or "0"
