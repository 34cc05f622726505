"""The syntax tree of an expression, in any number of threads."""

import ast

ATTEMPTS = 100


def syntax_tree(expression: str) -> ast.expr:
    """Return the tree of a Python expression, which is not evaluated.

    All threads share the counter by which Python 3.11 measures how deep a tree is. Where another thread makes a tree
    in the middle of this one, Python raises SystemError although the tree is right; then it is made again.

    Raises:
        SyntaxError, ValueError, RecursionError, MemoryError: as `ast.parse`.
    """
    for _ in range(ATTEMPTS - 1):
        try:
            return ast.parse(expression, mode="eval").body
        except SystemError:
            continue
    return ast.parse(expression, mode="eval").body
