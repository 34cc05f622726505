"""Kinematics of robot arms, answered as a good textbook would: the number, the formula, the verdict, the picture.

At the top are the names that most questions need. The others are in namespaces: `curves`, `trajectories`,
`orientation`, `rigid_motions`, `singularities`, `ik`, `workspaces`, `dh`, `textbook_robots`, `plots`, `tasks`,
`redundancy` and `control`.
`__init__.pyi` lists them; each is imported when it is first used, so that `import robotics1` is quick. A name of a
namespace is found at the top too: `robotics1.solve_trig` is `robotics1.ik.solve_trig`.
"""

import sys
from types import ModuleType
from typing import Any, NoReturn

import lazy_loader

_at_the_top, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

# The namespaces read their lists of names here, in one thread: see `syntax`.
from robotics1 import (  # noqa: E402
    control,
    curves,
    dh,
    ik,
    orientation,
    plots,
    redundancy,
    rigid_motions,
    singularities,
    tasks,
    textbook_robots,
    trajectories,
    workspaces,
)
from robotics1.other_words import ALMOST, CALLS, FUNCTIONS  # noqa: E402
from robotics1.tables import MORE  # noqa: E402

SPACES = (
    tasks, curves, trajectories, orientation, rigid_motions, singularities, ik, workspaces, dh, textbook_robots, plots,
    redundancy, control,
)  # fmt: skip


def _dh_tables(robot: Any) -> str:
    from robotics1.dh.from_robot import folded_tables

    return folded_tables(robot)


MORE["Robot"] = [_dh_tables]  # `dh` is made of robots, which know nothing of it


def _call(function: str) -> str | None:
    """Return a public function with the arguments that it needs, as a user writes it; None if there is none."""
    from inspect import isfunction, signature

    found = getattr(sys.modules[__name__], function, None)
    if not isfunction(found):
        return None
    needed = [name for name, given in signature(found).parameters.items() if given.default is given.empty]
    return f"robotics1.{function}({', '.join(needed)})"


CALLS.append(_call)


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        return version("robotics1")
    try:
        return _at_the_top(name)
    except AttributeError:
        for space in SPACES:
            if name in space.__all__:
                return getattr(space, name)
        if name.startswith("_") or name in __all__:
            raise
        raise AttributeError(f"robotics1 has no {name!r}{_meant(name)}", name=name) from None


class _Namespace(ModuleType):
    """A namespace that says what is meant by an unknown name, or by a call as if it were a function."""

    def __getattr__(self, name: str) -> NoReturn:  # asked after the namespace's own `__getattr__`
        raise AttributeError(f"{self.__name__} has no {name!r}{_meant(name)}", name=name)

    def __call__(self, *given: Any, **named: Any) -> NoReturn:
        from .errors import InputError

        usual = FUNCTIONS.get(self.__name__.rpartition(".")[2])
        functions = ", ".join([name for name in self.__all__ if name.islower()][:4])
        raise InputError(f"{self.__name__} is a namespace; call a function, such as {usual or functions}")


for _space in SPACES:
    _space.__class__ = _Namespace


def _meant(name: str) -> str:
    """Return which public names may be meant."""
    from .errors import nearest_names

    spaces = [space.__name__.rpartition(".")[2] for space in SPACES]
    known = [other for other in (*__all__, *(n for space in SPACES for n in space.__all__)) if other not in spaces]
    word = name.lower().replace("_", "")
    bare = {other.lower().replace("_", ""): other for other in known}
    meant = FUNCTIONS.get(word) or bare.get(word)
    longer = [other for other in known if other.startswith(f"{name}_")]
    close = list(dict.fromkeys(longer + nearest_names(name, known))) or [other for other in known if name in other]
    if meant is None and not longer:
        meant = next((FUNCTIONS[other] for other in nearest_names(word, FUNCTIONS, ALMOST)), None)
    if meant is None and not close:
        return "; dir(robotics1) lists what there is"
    return f"; did you mean {meant or ' or '.join(close[:3])}?"
