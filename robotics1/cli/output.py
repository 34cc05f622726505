"""How the commands print: JSON for programs, degrees and warnings for people."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from textwrap import fill
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from robotics1.names import printable

if TYPE_CHECKING:
    from robotics1.inputs import Array
    from robotics1.robot.model import Robot
    from robotics1.viewer.page import Page


SEVERAL = {  # kind of joint → unit → the entries of its q, and of its q̇
    "planar": ({"m": "x y", "1": "cos sin"}, {"m": "x y", "rad": "θ"}),
    "floating": ({"m": "x y z", "1": "qx qy qz qw"}, {"m": "x y z", "rad": "ωx ωy ωz"}),
}


class PlainConsole(Console):
    """A console that prints text as it is: names come from files, and may hold markup or control characters.

    Colour is given by `style=`, never by marks in the text.
    """

    def __init__(self, *, stderr: bool = False):
        super().__init__(stderr=stderr, markup=False, highlight=False, emoji=False)

    def render_str(self, text: str, **options: Any) -> Text:
        """Return a text as Rich draws it, here and in the cells of tables."""
        return super().render_str(printable(text, keep="\n"), **options)

    def say(self, text: str, **options: Any) -> None:
        """Print sentences: on a terminal broken between words, each line as far in as its first; else as they are."""
        if self.is_terminal:
            text = "\n".join(_broken(line, self.width) for line in text.split("\n"))
        self.print(text, soft_wrap=True, **options)

    def print(self, *objects: Any, **options: Any) -> None:
        """Print; a table that is wider than the terminal with short headings, or as one line for each cell."""
        if len(objects) == 1 and isinstance(objects[0], Table) and _width(objects[0]) > self.width:
            table, legend = _with_short_headings(objects[0])
            if legend and _width(table) <= self.width:
                super().print(table, **options)
                super().print(legend, **options)
            else:
                super().print(_one_cell_a_line(objects[0]), **options)
            return
        super().print(*objects, **options)


def _broken(line: str, width: int) -> str:
    """Return a line as several, broken between words; what follows "- " stays under it."""
    text = line.lstrip()
    first = line[: len(line) - len(text)]
    rest = f"{first}  " if text.startswith("- ") else first
    return fill(
        text,
        max(width, len(rest) + 20),
        initial_indent=first,
        subsequent_indent=rest,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _width(table: Table) -> int:
    """Return how wide a table is whose cells are not broken into lines."""
    widths = [max(map(len, (str(column.header), *map(str, column.cells)))) for column in table.columns]
    return sum(widths) + 3 * len(widths) + 1


def _with_short_headings(table: Table) -> tuple[Table, str]:
    """Return a table with numbers for headings that are wider than their columns, and what these stand for."""
    short = Table(title=table.title, title_justify="left", show_header=table.show_header)
    names = []
    for column in table.columns:
        heading, cells = str(column.header), [str(cell) for cell in column.cells]
        if len(heading) > max(map(len, cells), default=0):
            names.append(heading)
            heading = f"({len(names)})"
        short.add_column(heading, justify=column.justify)
    for row in zip(*(column.cells for column in table.columns), strict=True):
        short.add_row(*row)
    return short, ", ".join(f"({i}) {name}" for i, name in enumerate(names, 1))


def _one_cell_a_line(table: Table) -> Text:
    """Return the rows of a table as lines, each cell under the first of its row."""
    headings = [str(column.header).strip() for column in table.columns]
    lines = [str(table.title)] if table.title else []
    for cells in zip(*(column.cells for column in table.columns), strict=True):
        texts = [(heading, str(cell).strip()) for heading, cell in zip(headings, cells, strict=True)]
        first, *rest = [": ".join(filter(None, pair)) for pair in texts if pair[1]]
        lines += [first, *(f"  {text}" for text in rest)]
    return Text("\n".join(lines))


def write_json(answer: Any) -> None:
    """Print an answer as JSON on stdout, in ASCII: so it fits every terminal, and holds every name as it is."""
    json.dump(plain(answer), sys.stdout, indent=2)
    sys.stdout.write("\n")


def attributes(found: Any, names: str) -> dict[str, Any]:
    """Return attributes of an answer by their names, which a text lists."""
    return {name: getattr(found, name) for name in names.split()}


def plain(value: Any) -> Any:
    """Return a value made of what JSON knows; NaN and infinity become null."""
    import numpy as np
    import pinocchio as pin

    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, pin.SE3):
        return plain(value.homogeneous)
    if isinstance(value, np.ndarray | list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    if isinstance(value, np.bool_ | np.integer):
        return value.item()
    return value


def units(robot: Robot) -> list[str]:
    """Return the unit of each entry of q in JSON: rad, m, or 1 of a sine, a cosine and a part of a quaternion."""
    return [unit for _, unit in _entries(robot, 0)]


def effort_units(robot: Robot) -> list[str]:
    """Return the unit of each torque or force in JSON: N m or N."""
    return ["N m" if unit == "rad" else "N" for _, unit in _entries(robot, 1)]


def joint_names(robot: Robot) -> tuple[str, ...]:
    """Return a name for each entry of q̇, for printing: that of the joint, with a letter where it has several."""
    return tuple(name for name, _ in _entries(robot, 1))


def _entries(robot: Robot, order: int) -> list[tuple[str, str]]:
    """Return name and unit of each entry of q, or for order 1 of q̇, in the order of Pinocchio."""
    found = []
    for joint in robot.moving_joints:
        name = printable(joint.name)
        several = SEVERAL.get(joint.kind)
        if several is None:
            found.append((name, "rad" if joint.kind == "revolute" else "m"))
        else:
            found += [
                (f"{name} {letter}", unit) for unit, letters in several[order].items() for letter in letters.split()
            ]
    return found


def say_outside_limits(console: Console, robot: Robot, q: Array) -> None:
    """Say which joints are beyond their limits."""
    for (name, _), value, low, high in zip(_entries(robot, 0), q, robot.lower, robot.upper, strict=True):
        if not low - 1e-9 <= value <= high + 1e-9:
            console.print(f"{name} = {value:.4g} is outside its limits [{low:.4g}, {high:.4g}]", style="yellow")


def say_written(page: Page, *, json: bool, show: bool) -> None:
    """Print the file of a page, and open it in the browser where asked."""
    if json:
        write_json({"files": [str(page.file)]})
    else:
        PlainConsole().print(f"wrote {page.file}", soft_wrap=True)
    if show and page.file is not None:
        import webbrowser

        webbrowser.open(page.file.resolve().as_uri())


def say_configuration(console: Console, robot: Robot, q: Array, typed: str | None) -> None:
    """Say which configuration is taken where none was typed, and which joints are beyond their limits."""
    from robotics1.notation import vector

    if typed is None:
        console.print(f"at q = {vector(q)}, since --q is not given")
    say_outside_limits(console, robot, q)


@contextmanager
def progress_bar(doing: str, at_the_end: str = "", *, hidden: bool = False) -> Iterator[Callable[[int, int], None]]:
    """Show a bar on stderr, if that is a terminal, from the first step on.

    It is moved by a function of the number of steps done and the number of all.

    Args:
        doing: what is done.
        at_the_end: what is done after the last step, which has no measure.
        hidden: show nothing.
    """
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    console = PlainConsole(stderr=True)
    bar = Progress(*columns, console=console, transient=True, disable=hidden or not console.is_terminal)
    task = bar.add_task(doing)

    def show(done: int, total: int) -> None:
        bar.start()
        bar.update(task, completed=done, total=total, description=doing if done < total else at_the_end or doing)

    try:
        yield show
    finally:
        if bar.live.is_started:
            bar.stop()
