"""What an expression may call: functions and methods that only compute, and whose result is of bounded size."""

import math
import re
from collections.abc import Callable, Iterable
from typing import Any

from robotics1.robot.xacro.budget import MOST_BITS, Refused, check_elements, check_length, too_large

Functions = dict[str, Any]
PLACES = re.compile(r"(?:[^%]|%%|%(?:\(\w+\))?[-+ #0]*\d{0,2}(?:\.\d{1,2})?[diouxXeEfFgGcrsa])*", re.DOTALL)


class Namespace(dict[str, Any]):
    """Names behind a dot, as in math.sin."""


def power(a: Any, b: Any) -> Any:
    """Return a ** b."""
    if isinstance(a, int) and isinstance(b, int) and abs(a) > 1 and a.bit_length() * b > MOST_BITS:
        raise too_large(f"an integer of more than {MOST_BITS} bits")
    return a**b


def times(a: Any, b: Any) -> Any:
    """Return a * b."""
    for many, count in ((a, b), (b, a)):
        if isinstance(many, str | list | tuple) and isinstance(count, int):
            (check_length if isinstance(many, str) else check_elements)(len(many) * count)
    return a * b


def modulo(a: Any, b: Any) -> Any:
    """Return a % b; of a text, b written in its places, of at most two digits' width."""
    if isinstance(a, str):
        if not PLACES.fullmatch(a):
            raise Refused(f"{a[:40]!r} is no text with places such as %s, %d or %.3f, at most 99 wide")
        check_length(a.count("%") * (99 + len(str(b))))
    return a % b


def _round(number: float, digits: int | None = None) -> float:
    if digits is not None and abs(digits) > MOST_BITS // 10:
        raise too_large(f"a number rounded to {digits} digits")
    return round(number, digits)


def _range(*ends: int) -> range:
    numbers = range(*ends)
    check_elements(len(numbers))
    return numbers


def _sum(numbers: Iterable[float], start: float = 0) -> float:
    for number in numbers:
        if not isinstance(number, int | float):
            raise TypeError(f"sum() adds numbers, not {type(number).__name__}")
        start += number
    return start


def _isinstance(value: Any, kinds: Any) -> bool:
    listed = kinds if isinstance(kinds, tuple) else (kinds,)
    return isinstance(value, tuple(kind for name, kind in TYPES.items() if PYTHON[name] in listed))


def tokenize(text: str, sep: str = ",; ", skip_empty: bool = True) -> list[str]:
    """Return the parts of a text between any of the characters of `sep`."""
    parts = re.split(f"[{re.escape(sep)}]", text)
    return [part for part in parts if part or not skip_empty]


def _joined(separator: str, parts: Iterable[str]) -> str:
    parts = list(parts)
    check_length(len(separator) * len(parts))
    return separator.join(parts)


def _replaced(text: str, old: str, new: str, count: int = -1) -> str:
    check_length(text.count(old) * len(new))
    return text.replace(old, new, count)


def _filled(text: str, width: int) -> str:
    check_length(width)
    return text.zfill(width)


def _listed(function: Callable[..., Iterable[Any]]) -> Callable[..., list[Any]]:
    """Return a function whose result is a list, where Python's own is computed when it is asked for."""

    def listed(*arguments: Any, **named: Any) -> list[Any]:
        return list(function(*arguments, **named))

    return listed


def _computing(kind: type) -> Callable[..., Any]:
    """Return a function that makes a value of a type; the type itself would lead to what it holds."""

    def make(*arguments: Any, **named: Any) -> Any:
        return kind(*arguments, **named)

    return make


TYPES = {kind.__name__: kind for kind in (str, int, float, bool, list, dict, tuple, set)}
PYTHON: Functions = {
    **{name: _computing(kind) for name, kind in TYPES.items()},
    **{function.__name__: function for function in (abs, all, any, divmod, len, max, min, ord, repr, sorted)},
    **{function.__name__: _listed(function) for function in (enumerate, filter, map, reversed, zip)},
    **{"round": _round, "range": _range, "sum": _sum, "isinstance": _isinstance, "True": True, "False": False},
}
# Left out are functions of integers whose result or time grows without bound, such as factorial and comb.
MATH: Functions = {
    name: getattr(math, name)
    for name in (
        *("pi", "tau", "e", "inf", "nan", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "radians", "degrees"),
        *("sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "sqrt", "hypot", "dist", "pow", "exp", "expm1", "log"),
        *("log1p", "log2", "log10", "fabs", "floor", "ceil", "trunc", "fmod", "modf", "remainder", "copysign", "fsum"),
        *("gcd", "isclose", "isfinite", "isinf", "isnan", "erf", "erfc", "gamma", "lgamma", "frexp"),
    )
}
GLOBAL = (  # of Python's names, those that xacro knows without "python." in front
    *("list", "dict", "map", "len", "str", "float", "int", "bool", "True", "False", "min", "max", "round", "sorted"),
    "range",
)


def _methods(kind: type, names: str) -> dict[str, Callable[..., Any]]:
    return {name: getattr(kind, name) for name in names.split()}


METHODS: dict[type, dict[str, Callable[..., Any]]] = {
    str: _methods(str, "lower upper title capitalize strip lstrip rstrip startswith endswith split rsplit splitlines")
    | _methods(str, "find rfind index count isdigit isalpha isalnum isnumeric isspace islower isupper isidentifier")
    | _methods(str, "partition rpartition removeprefix removesuffix swapcase")
    | {"join": _joined, "replace": _replaced, "zfill": _filled},
    list: _methods(list, "index count"),
    tuple: _methods(tuple, "index count"),
    dict: {name: _listed(method) for name, method in _methods(dict, "keys values items").items()} | {"get": dict.get},
}


def global_names(xacro: Functions) -> Functions:
    """Return what the names of an expression stand for: all that xacro itself knows, and no more.

    Args:
        xacro: the functions behind `xacro.`, which belong to one expansion.
    """
    spaces = {"python": Namespace(PYTHON), "math": Namespace(MATH), "xacro": Namespace(xacro)}
    return {name: PYTHON[name] for name in GLOBAL} | MATH | {name: xacro[name] for name in DIRECT} | spaces


DIRECT = ("load_yaml", "abs_filename", "dotify")  # of xacro's functions, those known without "xacro." in front
