"""What stands in round brackets: `$(arg length)`, `$(find package)`, `$(eval length * 2)`."""

import os
from collections import ChainMap
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from robotics1.robot.xacro.arguments import typed
from robotics1.robot.xacro.budget import Budget, Refused
from robotics1.robot.xacro.evaluator import evaluate
from robotics1.robot.xacro.functions import MATH, PYTHON
from robotics1.robot.xacro.reading import Files


class Substitutions:
    """The commands of one expansion.

    Args:
        argument: gives the text of an argument, or raises KeyError.
        files: what may be read.
        budget: what the expansion may use.
    """

    def __init__(self, argument: Callable[[str], str], files: Files, budget: Budget):
        self._argument, self._files, self._budget = argument, files, budget
        self._commands: dict[str, Callable[..., str]] = {
            "arg": self._declared,
            "find": lambda package: str(files.find(package)),
            "env": self._environment,
            "optenv": lambda name, *default: self._environment(name, " ".join(default)),
            "cwd": self._working_folder,
        }
        functions = {name: PYTHON[name] for name in ("list", "dict", "map", "str", "float", "int")} | MATH
        self._functions = functions | self._commands | {"true": True, "false": False}
        self._functions["arg"] = lambda name: typed(self._declared(name))

    def value(self, text: str) -> str:
        """Return the text that stands for what is in the brackets.

        Raises:
            Refused: it is no command, or may not be used.
        """
        command, _, rest = text.strip().partition(" ")
        if command == "eval":
            names = ChainMap(self._functions, _Typed(self._argument))  # type: ignore[arg-type]
            return str(evaluate(rest, names, self._budget))
        if command not in self._commands:
            raise Refused(f"Unknown substitution command {command!r}; there is eval, {', '.join(self._commands)}")
        return self._commands[command](*rest.split())

    def _declared(self, name: str) -> str:
        try:
            return self._argument(name)
        except KeyError:
            raise NameError(f"argument {name!r} is not declared by a xacro:arg") from None

    def _environment(self, name: str, default: str | None = None) -> str:
        self._files.need_trust("$(env)" if default is None else "$(optenv)")
        value = os.environ.get(name, default)
        if value is None:
            raise NameError(f"there is no environment variable {name!r}")
        return value

    def _working_folder(self) -> str:
        self._files.need_trust("$(cwd)")
        return str(Path.cwd())


class _Typed(Mapping[str, Any]):
    """The arguments as `$(eval ...)` sees them, by name."""

    def __init__(self, argument: Callable[[str], str]):
        self._argument = argument

    def __getitem__(self, name: str) -> Any:
        return typed(self._argument(name))

    def __iter__(self) -> Any:
        return iter(())

    def __len__(self) -> int:
        return 0
