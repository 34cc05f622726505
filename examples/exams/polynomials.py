"""Polynomials of joint motions as a written exam has them: a table of coefficients, and one polynomial as text."""

import numpy as np
import numpy.typing as npt

from robotics1 import Robot
from robotics1.curves import PiecewisePolynomial


def polynomial_rows(robot: Robot, trajectory: PiecewisePolynomial) -> tuple[list[str], list[tuple[str, ...]]]:
    """Return headings and rows: the polynomials of q and q̇ in τ = t/T and in t, joint by joint."""
    polynomials = (
        ("q(τ)", trajectory.coefficients, "τ"),
        ("q(t)", trajectory.coefficients_t, "t"),
        ("q̇(τ)", trajectory.rate.coefficients, "τ"),
        ("q̇(t)", trajectory.rate.coefficients_t, "t"),
    )
    rows = [(name, *(polynomial_text(c, variable) for c in columns.T)) for name, columns, variable in polynomials]
    return ["", *robot.joint_names], rows


def polynomial_text(coefficients: npt.NDArray[np.floating], variable: str) -> str:
    """Return a polynomial as it is written, ascending, without the terms that vanish."""
    powers = ("", variable, *(f"{variable}{exponent}" for exponent in "²³⁴⁵⁶⁷⁸⁹"))
    terms = [(float(c), power) for c, power in zip(coefficients, powers, strict=False) if abs(c) > 1e-12]
    if not terms:
        return "0"
    text = " ".join(f"{'−' if c < 0 else '+'} {abs(c):.4f} {power}".rstrip() for c, power in terms)
    return text.replace("− ", "−", 1) if text.startswith("−") else text.removeprefix("+ ")
