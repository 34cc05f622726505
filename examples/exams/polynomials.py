"""Polynomials of joint motions as a written exam has them: a table of coefficients, and one polynomial as text."""

import numpy as np
import numpy.typing as npt
from rich.table import Table

from robotics1 import Robot
from robotics1.curves import PiecewisePolynomial
from robotics1.terminal_tables import table


def polynomial_table(robot: Robot, trajectory: PiecewisePolynomial) -> Table:
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


def polynomial_text(coefficients: npt.NDArray[np.floating], variable: str) -> str:
    """Return a polynomial as it is written, ascending, without the terms that vanish."""
    powers = ("", variable, *(f"{variable}{exponent}" for exponent in "²³⁴⁵⁶⁷⁸⁹"))
    terms = [(float(c), power) for c, power in zip(coefficients, powers, strict=False) if abs(c) > 1e-12]
    if not terms:
        return "0"
    text = " ".join(f"{'−' if c < 0 else '+'} {abs(c):.4f} {power}".rstrip() for c, power in terms)
    return text.replace("− ", "−", 1) if text.startswith("−") else text.removeprefix("+ ")
