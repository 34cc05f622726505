"""The formulas of one joint."""

from typing import Any, NamedTuple

import sympy


class JointFormula(NamedTuple):
    """A joint in the target's symbols and in the joints before it.

    Attributes:
        q: its symbol.
        options: one or two formulas.
        exists_if, double_if, free_if: when there are any, when the two are one, and when q is not determined.
    """

    q: sympy.Symbol
    options: tuple[sympy.Expr, ...]
    exists_if: Any
    double_if: Any
    free_if: Any
