"""Exercise 2 in formulas: the cylindrical robot, and one iteration of Newton's method."""

import sympy

from robotics1.exams.exam_2025_01_13 import GOAL, SPACE, Exercise2
from robotics1.exams.formula_table import FormulaRow, FormulaTable
from robotics1.notation import vector
from robotics1.symbolic.tasks.formula import formulas

VALUE = "Matrix([q3*cos(q2), q3*sin(q2), q1])"
JACOBIAN = "Matrix([[0, -q3*sin(q2), cos(q2)], [0, q3*cos(q2), sin(q2)], [1, 0, 0]])"
P_D = "Matrix([x_d, y_d, z_d])"


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
