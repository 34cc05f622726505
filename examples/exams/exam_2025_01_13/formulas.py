"""The formulas of the solution of 13 January 2025, computed, each beside the published one."""

from collections.abc import Iterable
from math import degrees

import sympy

from robotics1 import formulas
from robotics1.notation import vector
from robotics1.singularities import SingularSet
from robotics1.trajectories import MeetingBranch, polynomial_formula

from ..formula_table import FormulaRow, FormulaTable
from ..polynomials import polynomial_text
from .answers import ANGLE, FORCE, GOAL, P0, POINT, POSE, SPACE, SPEED, Exercise1, Exercise2, Exercise3

nu, mu, phi = sympy.symbols("nu mu phi", real=True)
rdot = sympy.Matrix(sympy.symbols("rdot1:4", real=True))

X_ROW = "[1, -l2*sin(q2) - l3*sin(q2 + q3), -l3*sin(q2 + q3)]"
Y_ROW = "[0, l2*cos(q2) + l3*cos(q2 + q3), l3*cos(q2 + q3)]"
TORQUE = "Matrix([-3, 3*(l2 - l3), -3*l3])"

VALUE = "Matrix([q3*cos(q2), q3*sin(q2), q1])"
JACOBIAN = "Matrix([[0, -q3*sin(q2), cos(q2)], [0, q3*cos(q2), sin(q2)], [1, 0, 0]])"
P_D = "Matrix([x_d, y_d, z_d])"

x0, y0, v, delta, t = sympy.symbols("x0 y0 v delta t", real=True)
q_rv, qdot_rv, t_rv = sympy.symbols("q_rv qdot_rv t_rv", real=True)

DIRECTION = "Matrix([cos(delta), sin(delta)])"
POSITION = "(3*q_rv - t_rv*qdot_rv)*tau**2 + (-2*q_rv + t_rv*qdot_rv)*tau**3"
VELOCITY = "2/t_rv*(3*q_rv - t_rv*qdot_rv)*tau + 3/t_rv*(-2*q_rv + t_rv*qdot_rv)*tau**2"


def formula_tables(one: Exercise1, two: Exercise2, three: Exercise3) -> tuple[FormulaTable, FormulaTable, FormulaTable]:
    """Return the formulas of all three exercises."""
    return formulas_1(one), formulas_2(two), formulas_3(three)


def formulas_1(one: Exercise1) -> FormulaTable:
    """Return the formulas of exercise 1."""
    rows = [*_pose(one), *_singular_poses(one), *_point(one), *_statics(one)]
    given = ", ".join(f"{name} = {length:g} m" for name, length in one.robot.parameters.items())
    return FormulaTable("Exercise 1: PRR robot", rows, f"Lengths {given}.", one.robot.parameters)


def _pose(one: Exercise1) -> list[FormulaRow]:
    f = formulas(one.robot, POSE)
    value = "Matrix([q1 + l2*cos(q2) + l3*cos(q2 + q3), l2*sin(q2) + l3*sin(q2 + q3), q2 + q3])"
    singular = "Contains(q2, FiniteSet(pi/2, -pi/2))"
    return [
        FormulaRow("1", "r = (p, φ)", "r", f.value, value),
        FormulaRow("1", "Jacobian of (p, φ)", "J_r", f.jacobian, f"Matrix([{X_ROW}, {Y_ROW}, [0, 1, 1]])"),
        FormulaRow("1", "determinant of Jᵣ", "det(J_r)", f.determinant, "l2*cos(q2)"),
        FormulaRow("1", "(p, φ) is singular where", "", _values(one.pose), singular),
    ]


def _singular_poses(one: Exercise1) -> list[FormulaRow]:
    """J_r and its two null spaces at q2 = ±π/2, and the velocities that it does not produce."""
    branches = sorted(one.pose.branches, key=lambda branch: branch.values["q2"])
    minus, plus = (branch.require_formulas() for branch in branches)
    J = formulas(one.robot, POSE).jacobian
    at_plus = "Matrix([[1, -l2 - l3*cos(q3), -l3*cos(q3)], [0, -l3*sin(q3), -l3*sin(q3)], [0, 1, 1]])"
    at_minus = "Matrix([[1, l2 + l3*cos(q3), l3*cos(q3)], [0, l3*sin(q3), l3*sin(q3)], [0, 1, 1]])"
    lost = sympy.Ne(plus.left_null.dot(rdot), 0)
    return [
        FormulaRow("1", "Jᵣ at q₂ = π/2", "J_r", _at(J, plus.conditions), at_plus),
        _line("1a", "null space of Jᵣ at q₂ = π/2", "qdot", nu, plus.null, "[l2, 1, -1]"),
        _line("1b", "null space of Jᵣᵀ at q₂ = π/2", "rdot_0", mu, plus.left_null, "[0, 1, l3*sin(q3)]"),
        FormulaRow("1b", "ṙ cannot be realised at q₂ = π/2 if", "", lost, "Ne(rdot3*l3*sin(q3) + rdot2, 0)"),
        FormulaRow("1", "Jᵣ at q₂ = −π/2", "J_r", _at(J, minus.conditions), at_minus),
        _line("1a", "null space of Jᵣ at q₂ = −π/2", "qdot", nu, minus.null, "[l2, -1, 1]"),
        _line("1b", "null space of Jᵣᵀ at q₂ = −π/2", "rdot_0", mu, minus.left_null, "[0, -1, l3*sin(q3)]"),
    ]


def _point(one: Exercise1) -> list[FormulaRow]:
    f = formulas(one.robot, POINT)
    first, second, third = (f.minors[(column,)] for column in range(3))
    singular = "Contains((q2, q3), FiniteSet((pi/2, 0), (pi/2, pi), (-pi/2, 0), (-pi/2, pi)))"
    return [
        FormulaRow("1", "Jacobian of p", "J_p", f.jacobian, f"Matrix([{X_ROW}, {Y_ROW}])"),
        FormulaRow("1", "minor of Jₚ without column 1", "det(J_-1)", first, "l2*l3*sin(q3)"),
        FormulaRow("1", "minor of Jₚ without column 2", "det(J_-2)", second, "l3*cos(q2 + q3)"),
        FormulaRow("1", "minor of Jₚ without column 3", "det(J_-3)", third, "l2*cos(q2) + l3*cos(q2 + q3)"),
        FormulaRow("1", "p is singular where", "", _values(one.point), singular),
    ]


def _statics(one: Exercise1) -> list[FormulaRow]:
    """The forces on the tool in the configuration q_s with positive joint values."""
    positive = (branch for branch in one.point.branches if all(value > 0 for value in branch.values.values()))
    q_s = next(positive).require_formulas()
    J = _at(formulas(one.robot, POINT).jacobian, q_s.conditions)
    at_q_s = "Matrix([[1, l3 - l2, l3], [0, 0, 0]])"
    torque, any_torque = ((-J.T * sympy.Matrix([FORCE[0], y])).applyfunc(sympy.factor) for y in (FORCE[1], phi))
    return [
        FormulaRow("1c", "Jₚ at qₛ = (q₁, π/2, π)", "J_s", J, at_q_s),
        _line("1c", "forces that need no torque at qₛ", "f", phi, q_s.left_null, "[0, 1]"),
        FormulaRow("1d", "τ that balances (3, 1)", "tau", torque, TORQUE, "[N, N m, N m]"),
        FormulaRow("1d", "τ that balances (3, φ), for any φ", "tau", any_torque, TORQUE, "[N, N m, N m]"),
    ]


def _line(
    exercise: str, name: str, symbol: str, factor: sympy.Symbol, basis: sympy.Matrix, published: str
) -> FormulaRow:
    """Return the row of a one-dimensional space: all multiples of a vector."""
    return FormulaRow(exercise, name, symbol, sympy.MatMul(factor, basis), f"MatMul({factor}, Matrix({published}))")


def _values(found: SingularSet) -> sympy.Contains:
    """Return the values of the joints on the branches, as in (q2, q3) ∈ {(π/2, 0), ...}."""
    branches = [branch.require_formulas().conditions for branch in found.branches]
    joints, values = ([[getattr(c, side) for c in conditions] for conditions in branches] for side in ("lhs", "rhs"))
    if len(joints[0]) == 1:
        return sympy.Contains(joints[0][0], sympy.FiniteSet(*(value for (value,) in values)))
    return sympy.Contains(sympy.Tuple(*joints[0]), sympy.FiniteSet(*(sympy.Tuple(*value) for value in values)))


def _at(formula: sympy.Matrix, conditions: Iterable[sympy.Eq]) -> sympy.Matrix:
    """Return a formula on the branch with these conditions."""
    return formula.subs({condition.lhs: condition.rhs for condition in conditions})


def formulas_2(two: Exercise2) -> FormulaTable:
    """Return the formulas of exercise 2."""
    f = formulas(two.robot, SPACE)
    p_d = sympy.Matrix(sympy.symbols("x_d y_d z_d", real=True))
    newton = sympy.Matrix(f.q) + sympy.simplify(f.jacobian.inv() * (p_d - f.value))
    published = f"Matrix([q1, q2, q3]) + {JACOBIAN}.inv()*({P_D} - {VALUE})"
    rows = [
        FormulaRow("2", "p(q) of the cylindrical robot", "p", f.value, VALUE),
        FormulaRow("2", "Jacobian of the cylindrical robot", "J", f.jacobian, JACOBIAN),
        FormulaRow("2", "determinant of J", "det(J)", f.determinant, "-q3"),
        FormulaRow("2", "Newton's next q, q + J⁻¹ (p_d − p)", "q", newton, published),
    ]
    return FormulaTable("Exercise 2: cylindrical robot", rows, f"p_d = (x_d, y_d, z_d) = {vector(GOAL)} m.")


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
