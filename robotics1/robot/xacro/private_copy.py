"""A copy of the library xacro for one expansion.

xacro keeps the files, macros and arguments of an expansion in variables of its module. Each expansion takes a new copy
of that module: there is nothing to restore afterwards, threads share nothing, and the module that `import xacro` gives
to others stays as it is. The copy cannot open files or evaluate Python: it has no such functions.
"""

import builtins
import importlib
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import find_spec
from types import CodeType, ModuleType
from typing import Any, NoReturn, cast
from xml.dom.minidom import Element

ORIGINAL = cast("ModuleSpec", find_spec("xacro"))
__path__ = ORIGINAL.submodule_search_locations  # this module is a package, in whose name xacro's own modules load
CODE = cast("CodeType", cast("SourceFileLoader", ORIGINAL.loader).get_code("xacro"))
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


def _forbidden(*_: object, **__: object) -> NoReturn:
    raise PermissionError("xacro may not open files or evaluate Python")
