"""The pages of the reference: one for each namespace, with what its `.pyi` lists."""

import inspect
from enum import Enum
from pathlib import Path
from types import ModuleType

import robotics1

DIRECTIVES = {True: "autoclass", False: "autofunction"}


def write(folder: Path) -> None:
    """Write a page for the top and one for each namespace, and the page that leads to them."""
    folder.mkdir(exist_ok=True)
    spaces = {"robotics1": robotics1}
    spaces |= {f"robotics1.{name}": getattr(robotics1, name) for name in robotics1.__all__ if _is_space(name)}
    deeper = {member for name, space in spaces.items() if name != "robotics1" for member in space.__all__}
    for name, space in spaces.items():
        left_out = deeper if name == "robotics1" else set()
        _write(folder / f"{name}.rst", _page(name, space, left_out))
    listed = "\n".join(f"   {name}" for name in spaces)
    _write(folder / "index.rst", f"Reference\n=========\n\n.. toctree::\n   :maxdepth: 1\n\n{listed}\n")


def _is_space(name: str) -> bool:
    return inspect.ismodule(getattr(robotics1, name))


def _page(name: str, space: ModuleType, left_out: set[str]) -> str:
    """Return the page of a namespace; what another one has too stands there."""
    members = {member: getattr(space, member) for member in sorted(space.__all__) if member not in left_out}
    blocks = []
    for member, value in members.items():
        if callable(value):
            options = "   :undoc-members:\n" if inspect.isclass(value) and issubclass(value, Enum) else ""
            blocks.append(f".. {DIRECTIVES[inspect.isclass(value)]}:: {name}.{member}\n{options}")
    others = [f"``{member}`` = {value}" for member, value in members.items() if isinstance(value, float)]
    return "\n".join([name, "=" * len(name), "", *others, "", *blocks])


def _write(path: Path, text: str) -> None:
    """Write a page whose text has changed, so that the next build reads only what is new."""
    if not path.is_file() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
