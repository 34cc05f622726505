"""A formula as it is typed, such as "R*cos(s)", read as a SymPy expression without running it.

Nothing of the text is evaluated by Python: its syntax tree is walked, and only numbers, names, arithmetic and a list of
functions are known. Its length, its depth and its numbers are limited, since SymPy computes powers of numbers at once:
9**9**9 would have 369 million digits.
"""

import ast
import operator
import re
from typing import Any

from robotics1.errors import InputError
from robotics1.names import refuse_no_number
from robotics1.syntax import syntax_tree

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
LONGEST = 10_000  # characters
SHOWN = 100  # characters of it in an error
DEEPEST = 200  # operations inside one another; a sum of so many terms is as deep
INNERMOST = 20  # functions inside one another: derivatives of order 3 grow with the cube
LARGEST_POWER = 1000
LARGEST = 10**308  # of a number, or of the parts of a fraction
CHARACTERS = re.compile(r"[\w\s.+\-*/(),]*")
NOT_A_NUMBER = re.compile(r"\d(and|else|for|if|in|is|not|or)\b")  # Python still reads "1or 2", and warns


def expression_of(formula: str) -> Any:
    """Return a text of numbers, names, pi, + − * / ** and the usual functions as a SymPy expression.

    Raises:
        InputError: it is no formula, has something else in it, or is too large.
    """
    if len(formula) > LONGEST:
        raise InputError(f"a formula must not be longer than {LONGEST} characters; it has {len(formula)}")
    try:
        if not CHARACTERS.fullmatch(formula) or NOT_A_NUMBER.search(formula):
            raise ValueError("a character that no formula has")
        tree = syntax_tree(formula.strip())
        return _read(tree, DEEPEST, INNERMOST)
    except InputError:
        raise
    except (SyntaxError, TypeError, ValueError, RecursionError, MemoryError, ZeroDivisionError) as error:
        raise InputError(
            f"a formula is made of numbers, names, pi, + - * / ** and {', '.join(FUNCTIONS)}, as 'R*cos(s)'; "
            f"{formula[:SHOWN]!r} is none"
        ) from error


def _read(node: ast.AST, depth: int, functions: int) -> Any:
    """Return the expression of a node, with at most so many operations and functions inside one another."""
    import sympy

    if depth < 0 or functions < 0:
        raise InputError(
            f"a formula must not have more than {DEEPEST} operations, or {INNERMOST} functions, inside one another"
        )
    match node:
        case ast.Constant(value=int() | float() as value) if not isinstance(value, bool):
            return _moderate(sympy.sympify(value))
        case ast.Name(id="pi"):
            return sympy.pi
        case ast.Name(id=name):
            refuse_no_number("each part of a formula", name)
            return sympy.Symbol(name)
        case ast.UnaryOp(op=op, operand=operand) if type(op) in OPERATIONS:
            return OPERATIONS[type(op)](_read(operand, depth - 1, functions))
        case ast.BinOp(left=left, op=op, right=right) if type(op) in OPERATIONS:
            a, b = (_read(side, depth - 1, functions) for side in (left, right))
            if isinstance(op, ast.Pow):
                _refuse_large_power(b)
            return _moderate(OPERATIONS[type(op)](a, b))
        case ast.Call(func=ast.Name(id=name), args=args, keywords=[]) if name in FUNCTIONS:
            return _moderate(getattr(sympy, name)(*(_read(arg, depth - 1, functions - 1) for arg in args)))
    raise ValueError(f"{ast.dump(node)} is no part of a formula")


def _refuse_large_power(exponent: Any) -> None:
    """Raise InputError for an exponent with a large number in it; with a symbol, a number in it becomes a power too."""
    import sympy

    numbers = [exponent, *exponent.atoms(sympy.Number)]
    if any(number.is_number and number.is_comparable and abs(number) > LARGEST_POWER for number in numbers):
        raise InputError(f"a formula must not have an exponent beyond {LARGEST_POWER}; there is {exponent}")


def _moderate(found: Any) -> Any:
    """Return an expression, if none of its numbers is so large that it is none in floating point."""
    import sympy

    for number in found.atoms(sympy.Number):
        parts = (number.p, number.q) if isinstance(number, sympy.Rational) else (number,)
        if any(abs(part) > LARGEST for part in parts):
            raise InputError("a formula must be real and finite, with no number beyond 1e308")
    return found
