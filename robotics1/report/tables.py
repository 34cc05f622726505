"""Tables in the form of a written exam."""

import numpy as np
import pinocchio as pin
from rich.table import Table

from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.ik.iterate import IKIteration
from robotics1.inputs import Array
from robotics1.notation import number, vector
from robotics1.robot.model import Robot


def matrix_table(values: Array, rows: tuple[str, ...] = (), columns: tuple[str, ...] = (), title: str = "") -> Table:
    """Return a matrix as a table with named rows and columns."""
    table = Table(title=title or None, title_justify="left", show_header=bool(columns))
    if rows:
        table.add_column("")
    for i in range(values.shape[1]):
        table.add_column(columns[i] if columns else "", justify="right")
    for i, row in enumerate(values):
        table.add_row(*([rows[i]] if rows else []), *(number(float(value)) for value in row))
    return table


def iteration_table(run: IKIteration, title: str = "") -> Table:
    """Return the iterates as the exam prints them: k, q, r, |e|, and det J or σ_min."""
    square = not np.isnan(run.table[0].det)
    table = Table(title=title or None, title_justify="left")
    for heading in ("k", "q", "r", "|e|", "det J" if square else "σ_min"):
        table.add_column(heading, justify="right")
    for row in run.table:
        r = row.r.translation if isinstance(row.r, pin.SE3) else row.r
        last = row.det if square else row.sigma_min
        table.add_row(str(row.k), vector(row.q), vector(r), f"{row.error:.5f}", number(last))
    return table


def polynomial_table(robot: Robot, trajectory: PiecewisePolynomial) -> Table:
    """Return the coefficients of q and q̇ in powers of τ = t/T and of t, joint by joint."""
    table = Table(title=f"T = {trajectory.duration:.4f} s, τ = t/T", title_justify="left")
    table.add_column("")
    for name in robot.joint_names:
        table.add_column(name)
    rows = (
        ("q(τ)", trajectory.coefficients, "τ"),
        ("q(t)", trajectory.coefficients_t, "t"),
        ("q̇(τ)", trajectory.rate.coefficients, "τ"),
        ("q̇(t)", trajectory.rate.coefficients_t, "t"),
    )
    for name, coefficients, variable in rows:
        table.add_row(name, *(polynomial_text(c, variable) for c in coefficients.T))
    return table


def polynomial_text(coefficients: Array, variable: str) -> str:
    """Return a polynomial as it is written, ascending, without the terms that vanish."""
    powers = ("", variable, *(f"{variable}{exponent}" for exponent in "²³⁴⁵⁶⁷⁸⁹"))
    terms = [(float(c), power) for c, power in zip(coefficients, powers, strict=False) if abs(c) > 1e-12]
    if not terms:
        return "0"
    text = " ".join(f"{'−' if c < 0 else '+'} {abs(c):.4f} {power}".rstrip() for c, power in terms)
    return text.removeprefix("+ ").replace("− ", "−", 1) if text.startswith("−") else text.removeprefix("+ ")
