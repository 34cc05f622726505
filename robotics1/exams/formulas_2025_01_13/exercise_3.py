"""Exercise 3 in formulas: the 2R robot, the target on its line, and the cubic that meets it."""

from math import degrees

import sympy

from robotics1.exams.exam_2025_01_13 import ANGLE, P0, POINT, SPEED, Exercise3
from robotics1.exams.formula_table import FormulaRow, FormulaTable
from robotics1.notation import vector
from robotics1.report.tables import polynomial_text
from robotics1.symbolic.tasks.formula import formulas
from robotics1.trajectories.meeting import MeetingBranch
from robotics1.trajectories.symbolic_polynomial import polynomial_formula

x0, y0, v, delta, t = sympy.symbols("x0 y0 v delta t", real=True)
q_rv, qdot_rv, t_rv = sympy.symbols("q_rv qdot_rv t_rv", real=True)

DIRECTION = "Matrix([cos(delta), sin(delta)])"
POSITION = "(3*q_rv - t_rv*qdot_rv)*tau**2 + (-2*q_rv + t_rv*qdot_rv)*tau**3"
VELOCITY = "2/t_rv*(3*q_rv - t_rv*qdot_rv)*tau + 3/t_rv*(-2*q_rv + t_rv*qdot_rv)*tau**2"


def formulas_3(three: Exercise3) -> FormulaTable:
    """Return the formulas of exercise 3."""
    lengths = three.robot.parameters
    said = ", ".join(f"{name} = {length:g} m" for name, length in lengths.items())
    return FormulaTable(
        "Exercise 3: rendez-vous of the 2R robot",
        [*_target(), *_robot(three)],
        f"Lengths {said}; the target starts at (x0, y0) = {vector(P0)} m, v = {SPEED} m/s, δ = {degrees(ANGLE):g}°.",
        {**lengths, "x0": P0[0], "y0": P0[1], "v": SPEED, "delta": ANGLE},
        [*_numbers("right", three.right), *_numbers("left", three.left)],
    )


def _target() -> list[FormulaRow]:
    p = sympy.Matrix([x0 + v * t * sympy.cos(delta), y0 + v * t * sympy.sin(delta)])
    (time,) = sympy.solve(p[0], t)
    height = sympy.simplify(p[1].subs(t, time))
    return [
        FormulaRow("3", "position of the target, as given", "p_T", p),
        FormulaRow("3", "velocity of the target", "pdot_T", p.diff(t), f"v*{DIRECTION}", "m/s"),
        FormulaRow("3b", "time of the rendez-vous, x = 0", "t_rv", time, "-x0/(v*cos(delta))", "s"),
        FormulaRow("3", "y at the rendez-vous", "p_Ty", height, "y0 + v*(-x0/(v*cos(delta)))*sin(delta)", "m"),
    ]


def _robot(three: Exercise3) -> list[FormulaRow]:
    f = formulas(three.robot, POINT)
    pdot = sympy.Matrix([v * sympy.cos(delta), v * sympy.sin(delta)])
    matching = sympy.simplify(f.jacobian.inv() * pdot)
    cubic = polynomial_formula((0, 0), (q_rv, qdot_rv), t_rv)
    return [
        FormulaRow("3", "p(q) of the 2R robot", "p", f.value),
        FormulaRow("3", "Jacobian of the 2R robot", "J", f.jacobian),
        FormulaRow("3", "velocity J⁻¹ ṗ_T that matches the target's", "qdot", matching),
        FormulaRow("3", "cubic from rest at 0, τ = t/tᵣᵥ", "q_d", cubic.formula, POSITION),
        FormulaRow("3b", "velocity of the cubic", "qdot_d", cubic.rate.formula, VELOCITY),
    ]


def _numbers(name: str, branch: MeetingBranch) -> list[str]:
    """Return the numbers of one arm: where it meets the target, and its cubics."""
    lines = [f"{name} arm: q = {vector(branch.q)} rad, q̇ = {vector(branch.qdot)} rad/s at the rendez-vous"]
    for symbol, motion in (("q", branch.trajectory), ("q̇", branch.trajectory.rate)):
        parts = (f"{symbol}{i}(τ) = {polynomial_text(c, 'τ')}" for i, c in enumerate(motion.coefficients.T, start=1))
        lines.append("; ".join(parts))
    return lines
