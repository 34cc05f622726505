"""Tables in the form of a written exam."""

from collections.abc import Iterable, Sequence

import numpy as np
import pinocchio as pin
from rich.table import Table

from robotics1.ik.iterate import IKIteration
from robotics1.inputs import Array
from robotics1.notation import number, vector
from robotics1.robot.model import Robot
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory


def table(
    headings: Sequence[str], rows: Iterable[Sequence[str]], title: str = "", *, left: Sequence[str] = ("",)
) -> Table:
    """Return a table of texts; the columns whose headings are in `left` are aligned there, the others right."""
    made = Table(title=title or None, title_justify="left", show_header=any(map(str.strip, headings)))
    for heading in headings:
        made.add_column(heading, justify="left" if heading in left else "right")
    for row in rows:
        made.add_row(*row)
    return made


def matrix_table(values: Array, rows: tuple[str, ...] = (), columns: tuple[str, ...] = (), title: str = "") -> Table:
    """Return a matrix as a table with named rows and columns."""
    numbers = [[number(float(value)) for value in row] for row in values]
    headings = columns or (" ",) * values.shape[1]
    if not rows:
        return table(headings, numbers, title)
    return table(("", *headings), [(name, *row) for name, row in zip(rows, numbers, strict=True)], title)


def iteration_table(run: IKIteration, title: str = "") -> Table:
    """Return the iterates as the exam prints them: k, q, r, |e|, and det J or σ_min."""
    square = not np.isnan(run.table[0].det)
    rows = []
    for row in run.table:
        r = row.r.translation if isinstance(row.r, pin.SE3) else row.r
        last = row.det if square else row.sigma_min
        rows.append((str(row.k), vector(row.q), vector(r), f"{row.error_norm:.5f}", number(last)))
    return table(("k", "q", "r", "|e|", "det J" if square else "σ_min"), rows, title)


def polynomial_table(robot: Robot, trajectory: PolynomialTrajectory) -> Table:
    """Return the coefficients of q and q̇ in powers of τ = t/T and of t, joint by joint."""
    polynomials = (
        ("q(τ)", trajectory.coefficients, "τ"),
        ("q(t)", trajectory.coefficients_t, "t"),
        ("q̇(τ)", trajectory.rate.coefficients, "τ"),
        ("q̇(t)", trajectory.rate.coefficients_t, "t"),
    )
    rows = [(name, *(polynomial_text(c, variable) for c in columns.T)) for name, columns, variable in polynomials]
    headings = ("", *robot.joint_names)
    return table(headings, rows, f"T = {trajectory.duration:.4f} s, τ = t/T", left=headings)


def polynomial_text(coefficients: Array, variable: str) -> str:
    """Return a polynomial as it is written, ascending, without the terms that vanish."""
    powers = ("", variable, *(f"{variable}{exponent}" for exponent in "²³⁴⁵⁶⁷⁸⁹"))
    terms = [(float(c), power) for c, power in zip(coefficients, powers, strict=False) if abs(c) > 1e-12]
    if not terms:
        return "0"
    text = " ".join(f"{'−' if c < 0 else '+'} {abs(c):.4f} {power}".rstrip() for c, power in terms)
    return text.removeprefix("+ ").replace("− ", "−", 1) if text.startswith("−") else text.removeprefix("+ ")
