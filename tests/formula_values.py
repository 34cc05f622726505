"""Numbers of formulas, for the tests: by substitution, in high precision, and not as the package evaluates them."""

import numpy as np
import sympy


def real(names):
    """Real symbols, as the formulas have them."""
    return sympy.symbols(names, real=True)


def number(formula, f, q, qdot=None, **parameters):
    """A formula of `f` at numbers, as a float array or a float; parameters default to the robot's."""
    values = dict(zip(f.q, map(float, q), strict=True))
    values |= {} if qdot is None else dict(zip(f.qdot, map(float, qdot), strict=True))
    values |= {sympy.Symbol(name, real=True): value for name, value in {**f.robot.parameters, **parameters}.items()}
    if isinstance(formula, sympy.MatrixBase):
        return np.array(formula.xreplace(values).evalf(20), dtype=float)
    return float(sympy.sympify(formula).xreplace(values).evalf(20))


def same(a, b):
    """Whether two expressions or matrices are equal as trigonometric polynomials."""
    difference = sympy.Matrix([a]) - sympy.Matrix([b])
    return all(sympy.expand(sympy.expand_trig(entry).rewrite(sympy.exp)) == 0 for entry in difference)
