"""The section of the picture: the page of the viewer, inside the sheet."""

import html
import warnings

import numpy as np

from robotics1.data_sheet.asked import Answer, Asked, open_slides
from robotics1.data_sheet.inverse import SHOWN
from robotics1.data_sheet.markup import note, paragraphs
from robotics1.errors import Robotics1Error, RobotWarning
from robotics1.ik.result import IKStatus
from robotics1.ik.solutions import ik_solutions
from robotics1.inputs import Array
from robotics1.notation import vector
from robotics1.viewer.animation import view


def scene(asked: Asked) -> Answer:
    """Return the arm to play with, and the solutions of its pose to leaf through, this posture first."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", RobotWarning)
        page = view(asked.robot, asked.q, task=asked.task, solutions=_solutions(asked), title=asked.title or None)
    text = html.escape(page.html)
    frame = f'<iframe title="the arm, to play with" srcdoc="{text}" loading="lazy"></iframe>'
    caption = paragraphs(
        f"At first q = {vector(asked.q)}, the posture of this sheet. Move the sliders, or drag the tool."
    )
    return Answer(frame + caption + "".join(note(str(warning.message)) for warning in caught))


def _solutions(asked: Asked) -> dict[str, Array]:
    if asked.task is None:
        return {}
    try:
        found = ik_solutions(asked.robot, asked.task, asked.task.value(asked.robot, asked.q), box=open_slides(asked))
    except Robotics1Error:
        return {}  # the section of inverse kinematics says why
    if found.status is IKStatus.INFINITE:
        return {}
    pairs = sorted(zip(found.q, found.labels, strict=True), key=lambda pair: float(np.abs(pair[0] - asked.q).max()))
    return {f"{i}: {', '.join(names)}".rstrip(": "): q for i, (q, names) in enumerate(pairs[:SHOWN], 1)}
