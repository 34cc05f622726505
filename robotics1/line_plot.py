"""A small drawing of curves as SVG, which a notebook shows without a library for plots."""

from collections.abc import Sequence
from html import escape

import numpy as np
import numpy.typing as npt

WIDTH, HEIGHT, MARGIN = 420, 170, 34  # of the drawing, and of its edge for numbers [pixels]
DASHES = ("", "6 3", "2 3", "8 3 2 3")  # lines differ without colour
COLORS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#8c564b", "#17becf")


def svg_lines(t: npt.NDArray[np.float64], values: npt.NDArray[np.float64], names: Sequence[str], axis: str) -> str:
    """Return curves over one axis as an SVG element.

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
