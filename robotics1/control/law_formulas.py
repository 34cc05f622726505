"""A control law in symbols: what it commands as expressions in q, the wanted motion and the gains."""

from typing import Any

from robotics1.control.law import ControlLaw
from robotics1.errors import FormulaError, InputError


def law_formula(law: ControlLaw) -> Any:
    """Return the command of a law as a SymPy column, in q1, q2, ... and the robot's named lengths.

    The wanted value of row i is the symbol rd_i, its derivatives rd_dot_i and rd_ddot_i, and the gains K_ij and D_ij;
    entries that are zero are left out. Of second order the joint velocities are qdot1, qdot2, ... J# is that of
    `redundancy.redundancy_formulas`, which is J⁻¹ of a square J.

    Raises:
        InputError: it is no law.
        FormulaError: the law has moving axes, null motion or damping, or its task has no formulas.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.
    """
    import sympy

    from robotics1.redundancy.formulas_of_redundancy import redundancy_formulas

    if not isinstance(law, ControlLaw):
        raise InputError(f"law must be joint_law(...) or cartesian_law(...); it is {law!r}")
    if law.axes.fixed is None or law.null_motion is not None or law.resolution.damping:
        raise FormulaError("only a law in fixed axes, without null motion and without damping, is written in symbols")
    m, axes = law.task.rows, law.axes.fixed

    def column(name: str) -> Any:
        return sympy.Matrix([sympy.Symbol(f"{name}_{i + 1}", real=True) for i in range(m)])

    def gain(name: str, G: Any) -> Any:
        inside = sympy.Matrix(
            m, m, lambda i, j: sympy.Symbol(f"{name}_{i + 1}{j + 1}", real=True) if G[i, j] else sympy.S.Zero
        )
        turn = sympy.Matrix(m, m, lambda i, j: sympy.nsimplify(float(axes[i, j]), rational=True))
        return turn * inside * turn.T

    found = redundancy_formulas(law.robot, law.task, weights=law.resolution.weights)
    formulas = found.task_formulas
    if formulas.value.shape != (m, 1):
        raise FormulaError("the error of a pose is no difference of numbers; use a task by angles or of a position")
    e = column("rd") - formulas.value
    if law.method == "gradient":
        return formulas.jacobian.T * gain("K", law.K) * e
    moving = law.motion is not None
    ahead = law.feedforward and moving
    rate = column("rd_dot") if moving else sympy.zeros(m, 1)
    if law.D is None:
        return found.pseudoinverse * ((rate if ahead else sympy.zeros(m, 1)) + gain("K", law.K) * e)
    qdot = sympy.Matrix(formulas.qdot)
    rate_error = rate - formulas.jacobian * qdot
    asked = (column("rd_ddot") if ahead else sympy.zeros(m, 1)) + gain("D", law.D) * rate_error + gain("K", law.K) * e
    return found.pseudoinverse * (asked - formulas.velocity_product)
