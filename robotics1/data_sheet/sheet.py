"""The data sheet of an arm as one offline page."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy.typing as npt

from robotics1.chunks.workers import check_progress
from robotics1.data_sheet.asked import Asked, good_posture
from robotics1.data_sheet.contents import SECTIONS, WRITTEN, Section
from robotics1.data_sheet.markup import Part, laid_out, note
from robotics1.data_sheet.worker import NoAnswer, Worker
from robotics1.files import check_file
from robotics1.inputs import real_number, text
from robotics1.notation import vector
from robotics1.robot.given import RobotLike, robot_from
from robotics1.tasks.given import TaskLike, task_from
from robotics1.viewer.arm_data import default_task
from robotics1.viewer.page import Page

LEAST = 1.0  # s, without which a section is not begun

Progress = Callable[[int, int], None]


def report(
    robot: RobotLike,
    file: str | Path | None = None,
    *,
    task: TaskLike | None = None,
    q: npt.ArrayLike | None = None,
    title: str | None = None,
    time_limit: float = 60.0,
    progress: Progress | None = None,
) -> Page:
    """Return the data sheet of an arm, and write it if a file is given: one offline HTML page.

    It has the arm to play with; its joints, limits and DH tables in both conventions; the formulas of its direct
    kinematics, Jacobian and determinant; its singular set in sentences; its inverse kinematics in closed form, or the
    method and the number of solutions; its workspace; velocity and force ellipsoids at a posture; how near to singular
    it is at 100 000 configurations; what is odd about its file; and the versions of what computed it. Each answer says
    whether it is proven, verified or searched.

    The sections are written in a process of their own, each in at most 5 to 25 s. One that fails or takes longer is
    ended; the sheet then says why, and has the others.

    Args:
        robot: the arm.
        file: the file to write.
        task: r = f(q), the task that the sheet is about; by default the position or the pose of the tool, in the arm's
            plane if it has one.
        q: (nq,) the posture at which numbers are given; by default one that is far from singular.
        title: by default the robot's name.
        time_limit: of all sections together [s].
        progress: called with the number of sections that are done, and of all.

    Raises:
        InputError: q has the wrong shape or is not finite, or the file cannot be written there.
        TaskError: the task does not fit the robot.
    """
    robot = robot_from(robot)
    asked = None if task is None else task_from(task)
    if asked is not None:
        asked.check(robot)
    if file is not None:
        check_file(file)
    check_progress(progress)
    limit = real_number("time_limit", time_limit, positive=True)
    name = text("title", title or "") or robot.name
    chosen = default_task(robot) if asked is None else asked
    posture = good_posture(robot, chosen) if q is None else robot.configuration(q)
    answers = _answers(Asked(robot, chosen, posture, name), limit, progress)
    rows = "" if chosen is None else f" Task r = ({', '.join(chosen.row_names)}), posture q = {vector(posture)}."
    parts = [Part(section.name, section.title, *answers[section.name]) for section in SECTIONS]
    page = Page(None, name, laid_out(name, f"Data sheet of a robot arm.{rows}", parts))
    return page if file is None else page.save(file)


def _answers(asked: Asked, limit: float, progress: Progress | None) -> dict[str, tuple[str, str]]:
    """Return what each section says, or why it says nothing: its HTML, and its fact."""
    end = time.monotonic() + limit
    answers: dict[str, tuple[str, str]] = {}
    with Worker(asked) as worker:
        for done, section in enumerate(WRITTEN):
            if progress is not None:
                progress(done, len(WRITTEN))
            answers[section.name] = _answer(worker, section, end - time.monotonic(), limit)
    if progress is not None:
        progress(len(WRITTEN), len(WRITTEN))
    return answers


def _answer(worker: Worker, section: Section, left: float, limit: float) -> tuple[str, str]:
    try:
        if left < LEAST:
            raise NoAnswer(f"the sections before took all of the time ({limit:g} s)")
        answer = worker.answer(section.name, min(section.seconds, left))
    except NoAnswer as error:
        return note(f"This section has no answer: {error}."), f"no answer: {error}"
    return answer.html, answer.fact
