"""The pictures and pages of docs/gallery.md, made anew by each build of the site."""

from collections.abc import Callable
from pathlib import Path

import robotics1 as r1
from robotics1 import plots
from robotics1.cli.exam import FIRST, example
from robotics1.robot.sources import own_folder
from robotics1.workspaces import workspace

XY = r1.PositionTask("xy")


def draw(folder: Path) -> list[Path]:
    """Make each picture that is not there yet, and return all files."""
    folder.mkdir(exist_ok=True)
    files = [folder / name for name in MADE]
    for file in files:
        if not file.is_file():
            MADE[file.name](file)
    return files


def _workspace(file: Path) -> None:
    plots.plot_workspace(
        workspace(r1.load_robot("planar_2r"), XY, box={"q1": (-1.0, 2.0), "q2": (0.3, 2.6)}), file=file
    )


def _ellipses(file: Path) -> None:
    motion = r1.cubic([0.1, 0.4], [1.3, 2.0], 1.0)
    plots.plot_ellipses(r1.load_robot("planar_2r"), XY, motion, count=4, file=file)


def _fastest(file: Path) -> None:
    limits = r1.MotionLimits([1.0, 2.0], [2.0, 4.0])
    plots.plot_trajectory(r1.minimum_time([0, 0], [1.2, 2.0], limits).trajectory, derivatives=2, file=file)


def _rendezvous(file: Path) -> None:
    target = r1.LinearMotion([-2, 1], [1.449, 0.388])
    robot = r1.load_robot("planar_2r")
    meeting = r1.rendezvous(robot, XY, target, q0=[0, 0], meet=lambda t, p: p[0])
    r1.animate(robot, [branch.trajectory for branch in meeting.branches], file, target=target, names=["right", "left"])


def _view(file: Path) -> None:
    r1.view(r1.load_robot("prr"), [0.2, 0.9, 1.0], file)


def _sheet(file: Path) -> None:
    r1.report(r1.load_robot("prr"), file)


def _exam(file: Path) -> None:
    example("exams.from_file.worked").work_file(own_folder("examples") / "exams" / FIRST, file)


MADE: dict[str, Callable[[Path], None]] = {
    "workspace.svg": _workspace,
    "ellipses.svg": _ellipses,
    "fastest.svg": _fastest,
    "rendezvous.html": _rendezvous,
    "prr.html": _view,
    "prr-sheet.html": _sheet,
    "exam.html": _exam,
}
