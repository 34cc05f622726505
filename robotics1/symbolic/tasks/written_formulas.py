"""Formulas in other languages: as functions of Python, C and MATLAB, and in LaTeX."""

from typing import Any

import sympy

from robotics1.inputs import one_of
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.symbolic.writing.printing import latex_text, python_function

PRINTED = {
    "value": "r = f(q)",
    "jacobian": "J(q)",
    "determinant": "det J(q)",
    "jacobian_rate": "dJ/dt",
    "velocity_product": "dJ/dt qdot",
}


class WrittenFormulas(Frozen):
    """Formulas of a robot that can be written; each of PRINTED is an attribute."""

    robot: Robot
    q: tuple[sympy.Symbol, ...]
    row_names: tuple[str, ...]
    unvalued: tuple[str, ...]

    @property
    def qdot(self) -> tuple[sympy.Symbol, ...]:
        """The joint rates."""
        raise NotImplementedError

    def python(self, name: str = "jacobian") -> str:
        """Return the source of a function f(q) of NumPy: f(q, qdot) for J̇ and J̇ q̇, parameters by keyword.

        Args:
            name: "value", "jacobian", "determinant", "jacobian_rate" or "velocity_product".

        Raises:
            InputError: there is no such formula.
        """
        return python_function(name, *self._as_function(name))

    def c(self, name: str = "jacobian") -> str:
        """Return the source of a function of C99: `void name(const double *q, double l2, ..., double *out)`.

        Raises:
            InputError: there is no such formula.
        """
        from robotics1.symbolic.writing.other_languages import c_function

        return c_function(name, *self._as_function(name))

    def matlab(self, name: str = "jacobian") -> str:
        """Return the source of a function of MATLAB, and of GNU Octave: `function out = name(q, l2, ...)`.

        Raises:
            InputError: there is no such formula.
        """
        from robotics1.symbolic.writing.other_languages import matlab_function

        return matlab_function(name, *self._as_function(name))

    def latex(self, name: str = "jacobian") -> str:
        """Return a formula in LaTeX.

        Raises:
            InputError: there is no such formula.
        """
        return latex_text(getattr(self, one_of("name", name, tuple(PRINTED))))

    def _as_function(self, name: str) -> tuple[Any, dict[str, Any], dict[str, float | None], str]:
        """Return a formula, its arguments that are vectors, its parameters with their values, and what it is."""
        one_of("name", name, tuple(PRINTED))
        formula = getattr(self, name)
        column = name == "velocity_product" or (name == "value" and formula.cols == 1)
        vectors: dict[str, Any] = {"q": self.q}
        if name in ("jacobian_rate", "velocity_product"):
            vectors["qdot"] = self.qdot
        values = {key: None if key in self.unvalued else value for key, value in self.robot.parameters.items()}
        rows = f"; rows {', '.join(self.row_names)}" if name in ("jacobian", "jacobian_rate") else ""
        summary = f"{PRINTED[name]} of {self.robot.name}, joints {', '.join(self.robot.joint_names)}{rows}"
        return list(formula) if column else formula, vectors, values, summary
