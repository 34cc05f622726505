"""How the commands print: JSON for programs, degrees and warnings for people."""

import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import pinocchio as pin
from rich.console import Console
from rich.text import Text

from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.robot.model import Robot


class PlainConsole(Console):
    """A console that prints text as it is: names come from files, and may hold markup or control characters.

    Colour is given by `style=`, never by marks in the text.
    """

    def __init__(self, *, stderr: bool = False):
        super().__init__(stderr=stderr, markup=False, highlight=False, emoji=False)

    def render_str(self, text: str, **options: Any) -> Text:
        """Return a text as Rich draws it, here and in the cells of tables."""
        return super().render_str(printable(text, keep="\n"), **options)


def write_json(answer: Any) -> None:
    """Print an answer as JSON on stdout, in ASCII: so it fits every terminal, and holds every name as it is."""
    json.dump(plain(answer), sys.stdout, indent=2)
    sys.stdout.write("\n")


def plain(value: Any) -> Any:
    """Return a value made of what JSON knows; NaN and infinity become null."""
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


def in_degrees(robot: Robot, q: Array, degrees: bool) -> Array:
    """Return q for printing: its angles in degrees where asked."""
    return np.where(robot.revolute, np.degrees(q), q) if degrees else q


def joint_names(robot: Robot) -> tuple[str, ...]:
    """Return the names of the joints for printing, each on one line."""
    return tuple(map(printable, robot.joint_names))


def say_outside_limits(console: Console, robot: Robot, q: Array) -> None:
    """Say which joints are beyond their limits."""
    for name, value, low, high in zip(joint_names(robot), q, robot.lower, robot.upper, strict=True):
        if not low - 1e-9 <= value <= high + 1e-9:
            console.print(f"{name} = {value:.4g} is outside its limits [{low:.4g}, {high:.4g}]", style="yellow")


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
