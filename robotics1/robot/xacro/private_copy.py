"""A copy of the library xacro for one expansion.

xacro keeps the files, macros and arguments of an expansion in variables of its module. Each expansion takes a new copy
of that module: there is nothing to restore afterwards, threads share nothing, and the module that `import xacro` gives
to others stays as it is. The copy cannot open files or evaluate Python: it has no such functions.
"""

import builtins
import importlib
import re
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import find_spec
from types import CodeType, ModuleType
from typing import Any, NoReturn, cast
from xml.dom.minidom import Element

ORIGINAL = cast("ModuleSpec", find_spec("xacro"))
__path__ = ORIGINAL.submodule_search_locations  # this module is a package, in whose name xacro's own modules load
CODE = cast("CodeType", cast("SourceFileLoader", ORIGINAL.loader).get_code("xacro"))
PARAMETER = re.compile(
    r"""\s*(?P<name>[^\s:=]+)\s*:?=\s*(?P<outer>\^\|?)?"""
    r"""(?P<default>\$\{[^}]*\}|\$\([^)]*\)|(?:'[^']*'|"[^"]*"|[^\s'"])*)(?:\s+|$)"""
)
Parameter = tuple[str, tuple[str | None, str | None] | None, str]
FORBIDDEN = ("open", "eval", "exec", "compile")

_writexml = Element.writexml
importlib.import_module(f"{__name__}.xmlutils")
Element.writexml = _writexml  # type: ignore[method-assign]  # it writes XML in another layout, for everybody


def private_copy(**replacements: Any) -> ModuleType:
    """Return a new copy of xacro's module, with other functions in place of its own.

    Raises:
        AttributeError: xacro has nothing of such a name; it is another version.
    """
    copy = ModuleType(__name__)
    vars(copy)["__package__"] = __name__
    vars(copy)["__builtins__"] = vars(builtins) | dict.fromkeys(FORBIDDEN, _forbidden)
    exec(CODE, vars(copy))  # what `import` does, into a module of our own
    for name, replacement in replacements.items():
        getattr(copy, name)
        setattr(copy, name, replacement)
    return copy


def macro_parameter(text: str) -> Parameter:
    """Return the first parameter of a macro: its name, its default, and the rest of the text.

    Parameters are written as in `prefix length:=0.5 *origin parent:=^|base`. The default is None if there is none;
    else the name of a property outside, for `^`, and the text of a default. It takes a time that grows with the text
    alone, which xacro's own pattern does not.
    """
    found = PARAMETER.match(text)
    if found is None:
        name, *rest = text.split(None, 1)
        return name, None, rest[0] if rest else ""
    outer = found["name"] if found["outer"] else None
    return found["name"], (outer, found["default"] or None), text[found.end() :]


def _forbidden(*_: object, **__: object) -> NoReturn:
    raise PermissionError("xacro may not open files or evaluate Python")
