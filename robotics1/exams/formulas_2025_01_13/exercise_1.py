"""Exercise 1 in formulas: the tasks (p, φ) and p of the PRR robot, where they are singular, and what that means."""

import sympy

from robotics1.exams.exam_2025_01_13 import FORCE, POINT, POSE, Exercise1
from robotics1.exams.formula_table import FormulaRow, FormulaTable
from robotics1.singularities.result import SingularSet
from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas
from robotics1.symbolic.tasks.formula import formulas

nu, mu, phi = sympy.symbols("nu mu phi", real=True)
rdot = sympy.Matrix(sympy.symbols("rdot1:4", real=True))

X_ROW = "[1, -l2*sin(q2) - l3*sin(q2 + q3), -l3*sin(q2 + q3)]"
Y_ROW = "[0, l2*cos(q2) + l3*cos(q2 + q3), l3*cos(q2 + q3)]"
TORQUE = "Matrix([-3, 3*(l2 - l3), -3*l3])"


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
        FormulaRow("1", "Jᵣ at q₂ = π/2", "J_r", _at(J, plus), at_plus),
        _line("1a", "null space of Jᵣ at q₂ = π/2", "qdot", nu, plus.null, "[l2, 1, -1]"),
        _line("1b", "null space of Jᵣᵀ at q₂ = π/2", "rdot_0", mu, plus.left_null, "[0, 1, l3*sin(q3)]"),
        FormulaRow("1b", "ṙ cannot be realised at q₂ = π/2 if", "", lost, "Ne(rdot3*l3*sin(q3) + rdot2, 0)"),
        FormulaRow("1", "Jᵣ at q₂ = −π/2", "J_r", _at(J, minus), at_minus),
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
    J = _at(formulas(one.robot, POINT).jacobian, q_s)
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


def _at(formula: sympy.Matrix, branch: BranchFormulas) -> sympy.Matrix:
    """Return a formula on a branch."""
    return formula.subs({condition.lhs: condition.rhs for condition in branch.conditions})
