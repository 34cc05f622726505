"""What a xacro may reach: packages in known folders; YAML files and the environment only when it is trusted."""

import ast
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from robotics1.robot.meshes import PACKAGE, find_file, find_package

INSIDE = ("_", "gi_", "cr_", "ag_", "f_", "co_", "tb_")  # beginnings of names that lead into the interpreter
Exchange = tuple[dict[str, Any], str, Callable[..., Any]]  # a table, a key, and what stands there meanwhile


class NotAllowed(Exception):  # noqa: N818 (it is turned into a RobotFileError)
    """The file asks for something that is refused."""


@contextmanager
def guarded(path: Path, packages: list[Path], *, trusted: bool) -> Iterator[None]:
    """Let xacro find packages in the given folders and above the file, and refuse the rest unless trusted.

    xacro keeps these functions in its module and in tables of symbols; they are exchanged while this lasts.
    """
    exchanged = [*_lookups(path, packages), *([] if trusted else _refusals())]
    before = [(table, key, table[key]) for table, key, _ in exchanged]
    for table, key, function in exchanged:
        table[key] = function
    try:
        yield
    finally:
        for table, key, function in before:
            table[key] = function


def _lookups(path: Path, packages: list[Path]) -> list[Exchange]:
    """Where packages and included files are looked for."""
    import xacro
    from xacro import substitution_args

    plain = xacro.abs_filename_spec

    def filename(spec: str) -> str:
        if not spec.startswith(PACKAGE):
            return str(plain(spec))
        found = find_file(spec, path, packages)
        if found is None:
            raise NotAllowed(f"{spec!r} is in none of the folders given as packages")
        return str(found)

    def find(package: str) -> str:
        folder = find_package(package, path, packages)
        if folder is None:
            raise NotAllowed(f"package {package!r} of $(find {package}) is in none of the folders given as packages")
        return str(folder)

    return [
        (vars(xacro), "abs_filename_spec", filename),
        (vars(substitution_args), "_eval_find", find),
        (substitution_args._eval_dict, "find", find),
    ]


def _refusals() -> list[Exchange]:
    """What reads the computer."""
    import xacro
    from xacro import substitution_args

    symbols = xacro._global_symbols
    return [
        (vars(substitution_args), "_eval_env", _refuse("$(env)")),
        (vars(substitution_args), "_eval_optenv", _refuse("$(optenv)")),
        (substitution_args._eval_dict, "env", _refuse("$(env)")),
        (substitution_args._eval_dict, "optenv", _refuse("$(optenv)")),
        (vars(xacro), "safe_eval", _plain_expressions(xacro.safe_eval)),
        (symbols, "load_yaml", _refuse("load_yaml")),
        (symbols["xacro"], "load_yaml", _refuse("load_yaml")),
    ]


def _plain_expressions(evaluate: Callable[..., Any]) -> Callable[..., Any]:
    """Return xacro's evaluation of an expression, for expressions that stay away from Python's inside.

    xacro itself looks for names with "__" at the top of an expression only, not in what is nested in it.
    """

    def checked(expression: str, *rest: Any) -> Any:
        tree = ast.parse(expression.strip(), mode="eval")
        for node in ast.walk(tree):
            name = str(getattr(node, "attr", getattr(node, "id", "")))
            if isinstance(node, ast.Lambda) or name.startswith(INSIDE) or name in ("format", "format_map", "mro"):
                raise NotAllowed(
                    f"the expression {expression.strip()!r} uses {name or 'a lambda'}; trusted=True allows it"
                )
        return evaluate(expression, *rest)

    return checked


def _refuse(what: str) -> Callable[..., NoReturn]:
    def refuse(*_: object, **__: object) -> NoReturn:
        raise NotAllowed(f"it uses {what}, which reads this computer; load it with trusted=True if you trust it")

    return refuse
