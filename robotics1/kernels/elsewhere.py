"""A part of a kernel compiled by another process, on another core, while this one compiles the rest."""

import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any, cast

from robotics1.kernels.compilation import COMPILED, is_ready, threads

PROGRAM = """
import sys
sys.path[:] = {path!r}
from robotics1.kernels.elsewhere import compile_part
compile_part({part})
"""


def compile_elsewhere(kernel: Callable[..., Any], types: str) -> None:
    """Begin to compile an inner kernel in another process, which leaves it on disk; whoever needs it waits for that.

    Nothing is done where it would not help: there is one core, no directory for machine code, or it is there already.

    Args:
        kernel: of a module of this package.
        types: of its arguments, as Numba writes them: "(f8[:, ::1], i8)".
    """
    code = getattr(kernel, "_cache", None)
    if not COMPILED or not hasattr(code, "holds_code") or is_ready(kernel) or threads() < 2:
        return
    if not Path(sys.executable or "").stem.startswith("python"):  # a program that holds Python, such as Blender
        return
    function = cast(Any, kernel).py_func
    part = f"{function.__module__!r}, {function.__name__!r}, {types!r}"
    command = [sys.executable, "-c", PROGRAM.format(path=sys.path, part=part)]
    nothing = subprocess.DEVNULL
    try:
        process = subprocess.Popen(command, stdin=nothing, stdout=nothing, stderr=nothing)
    except OSError:  # then it is compiled here
        return
    cast(Any, code).awaited = process


def compile_part(module: str, name: str, types: str) -> None:
    """Compile a kernel, and leave it on disk: what the other process does."""
    from numba.core.sigutils import normalize_signature

    arguments, _ = normalize_signature(types)
    getattr(import_module(module), name).compile(arguments)
