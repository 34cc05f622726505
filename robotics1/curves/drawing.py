"""How a terminal and a notebook show a curve: a few of its values, and a drawing."""

from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.line_plot import svg_lines
from robotics1.notation import vector
from robotics1.results import Frozen
from robotics1.tables import Table, table_of

DRAWN = 200  # points of a curve
WRITTEN = 5  # of its values
RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


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
