"""Sections of inverse kinematics: the method and the number of solutions, and their formulas."""

import time

import numpy as np
import sympy

from robotics1.data_sheet.asked import UNLIMITED, Answer, Asked, open_slides
from robotics1.data_sheet.markup import equation, escaped, folded, note, paragraphs, table
from robotics1.errors import FormulaError, TaskError
from robotics1.ik.closed_form.family import IKFormulas
from robotics1.ik.closed_form.find import ik_formulas
from robotics1.ik.closed_form.named_parts import NamedParts, in_named_parts
from robotics1.ik.result import IKStatus
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.solutions import ik_solutions
from robotics1.notation import count, joint_value
from robotics1.robot.box import joint_box
from robotics1.symbolic.writing.decimals import lengths_in

POSES = 20  # reached ones, at which solutions are counted
COUNTING = 6.0  # s
SHOWN = 16  # solutions


def inverse_kinematics(asked: Asked) -> Answer:
    """Return the method, how many solutions there are, and those of the posture's pose."""
    robot, task = asked.robot, asked.require_task()
    here = ik_solutions(robot, task, task.value(robot, asked.q), box=open_slides(asked))
    text, fact = _method(asked, here)
    return Answer(text + _at_the_posture(asked, here), fact)


def inverse_formulas(asked: Asked) -> Answer:
    """Return the formulas of all solutions, or why there are none."""
    try:
        found = ik_formulas(asked.robot, asked.require_task())
    except (FormulaError, TaskError) as error:
        return Answer(paragraphs(f"There is no closed form: {error}."), "none")
    return Answer(_formulas(found), count(len(found), "solution") + ", one joint after the other")


def _formulas(found: IKFormulas) -> str:
    target = ", ".join(map(str, found.target))
    text = paragraphs(
        f"The target is ({target}): rᵢⱼ are the entries of R, x, y, z the coordinates of the point. Joint after joint:"
        if "r11" in target
        else f"The target is ({target}). Joint after joint:"
    )
    parts = in_named_parts(found.joints, lengths_in(found.robot, found.task))
    for name, joint, named in zip(found.names, found.joints, parts, strict=True):
        text += _joint(name, str(joint.q), named)
    return text + note("Verified: these formulas were compared with Pinocchio at random q before they were printed.")


def _joint(name: str, symbol: str, parts: NamedParts) -> str:
    """Return the formulas of a joint, after what they use."""
    text = f"<h3>{escaped(symbol if symbol == name else f'{symbol} ({name})')}</h3>"
    text += "".join(equation(str(u), formula) for u, formula in parts.named)
    text += "<p>or</p>".join(equation(symbol, option) for option in parts.options)
    conditions = (
        ("It exists where", parts.exists_if, sympy.true),
        ("The two are one where", parts.double_if, sympy.false),
        ("It is free where", parts.free_if, sympy.false),
    )
    unusual = "".join(f"<p>{label}</p>{equation('', c)}" for label, c, usual in conditions if c != usual)
    return text + (folded("When it exists", unusual) if unusual else "")


def _method(asked: Asked, here: IKSolutions) -> tuple[str, str]:
    text = paragraphs(f"Method: {here.method}.")
    if here.status is IKStatus.INFINITE:
        return text, f"infinitely many solutions, a family of dimension {here.dimension}; found by {here.method}"
    counts, complete = _counted(asked)
    if not counts:
        return text, f"found by {here.method}"
    low, high = min(counts), max(counts)
    many = count(low, "solution") if low == high else f"{low} to {high} solutions"
    text += paragraphs(f"At {count(len(counts), 'reached pose')}, drawn at random: {many} inside the limits.")
    text += note("Proven: no solution is missed." if complete else "Searched: a solution may be missed.")
    return text, f"{many} inside the limits, {'all of them' if complete else 'perhaps more'}; by {here.method}"


def _counted(asked: Asked) -> tuple[list[int], bool]:
    """Return the numbers of solutions at random reached poses, as many as the time allows, and whether all are sure."""
    robot, task, box = asked.robot, asked.require_task(), open_slides(asked)
    began, complete = time.monotonic(), True
    counts: list[int] = []
    for q in joint_box(robot, unlimited=UNLIMITED).random(np.random.default_rng(1), POSES):
        found = ik_solutions(robot, task, task.value(robot, q), box=box)
        if found.status is IKStatus.INFINITE:
            return [], False
        counts.append(len(found))
        complete = complete and found.complete
        if time.monotonic() - began > COUNTING:
            break
    return counts, complete


def _at_the_posture(asked: Asked, here: IKSolutions) -> str:
    labels = here.labels if here.status is not IKStatus.INFINITE else ((),) * len(here.q)
    headings = ("", *(f"q{i + 1}" for i in range(asked.robot.nq)), "posture")
    rows = [
        (i, *map(joint_value, q), ", ".join(names) or "–")
        for i, (q, names) in enumerate(zip(here.q, labels, strict=True), 1)
    ]
    title = f"Solutions at the posture's pose, inside the limits: {here.explain()}"
    more = paragraphs(f"... and {len(rows) - SHOWN} others") if len(rows) > SHOWN else ""
    return "<h3>In numbers</h3>" + paragraphs(title) + table(headings, rows[:SHOWN]) + more
