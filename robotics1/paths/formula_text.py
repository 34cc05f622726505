"""A formula as it is typed, such as "R*cos(s)", read as a SymPy expression without running it."""

import ast
import operator
from typing import Any

from robotics1.errors import InputError

OPERATIONS: dict[type, Any] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.Pow: operator.pow,
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
}
FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log", "sqrt")


def expression_of(formula: str) -> Any:
    """Return a text of numbers, names, pi, + − * / ** and the usual functions as a SymPy expression.

    Raises:
        InputError: it is no formula, or has something else in it.
    """
    try:
        return _read(ast.parse(formula, mode="eval").body)
    except (SyntaxError, TypeError, ValueError, RecursionError, ZeroDivisionError) as error:
        raise InputError(
            f"a formula is made of numbers, names, pi, + - * / ** and {', '.join(FUNCTIONS)}, as 'R*cos(s)'; "
            f"{formula!r} is none"
        ) from error


def _read(node: ast.AST) -> Any:
    import sympy

    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return sympy.sympify(value)
        case ast.Name(id="pi"):
            return sympy.pi
        case ast.Name(id=name):
            return sympy.Symbol(name)
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATIONS:
            return OPERATIONS[type(op)](_read(operand))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATIONS:
            return OPERATIONS[type(op)](_read(left), _read(right))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS:
            return getattr(sympy, name)(*(_read(arg) for arg in args))
    raise ValueError(f"{ast.dump(node)} is no part of a formula")
