"""The kinds of questions that a file can ask, and the keys that each reads."""

from collections.abc import Callable
from typing import NamedTuple

from robotics1.errors import InputError, Robotics1Error

from . import kinematics_questions as arm, motion_questions as motion
from .answer import Answer
from .meeting_questions import MEETING_KEYS, feedback_gain, meeting
from .places import meant
from .reading import QUESTION_KEYS, Question, check_keys


class Kind(NamedTuple):
    """A kind: what answers it, and the keys that it reads besides those of every question."""

    answer: Callable[[Question], Answer]
    keys: tuple[str, ...] = ()


KINDS = {
    "direct kinematics": Kind(arm.direct_kinematics, ("q",)),
    "jacobian": Kind(arm.jacobian, ("q", "where")),
    "determinant": Kind(arm.determinant),
    "singularities": Kind(arm.singularities),
    "subspaces": Kind(arm.subspaces_of, ("where",)),
    "torque": Kind(arm.torque, ("force", "q", "where")),
    "inverse kinematics": Kind(motion.inverse_kinematics, ("target",)),
    "iteration": Kind(motion.iteration, ("target", "q0", "method", "tolerance")),
    "rendezvous": Kind(meeting, MEETING_KEYS),
    "feedback gain": Kind(feedback_gain, (*MEETING_KEYS, "arm", "from", "final_error")),
    "least time": Kind(motion.fastest, ("from", "to", "max_velocity", "max_acceleration", "law")),
    "cubic": Kind(motion.cubic_motion, ("from", "to", "time", "v0", "v1")),
    "workspace": Kind(motion.reached),
}


def answered(question: Question) -> Answer:
    """Return the answer to a question.

    Raises:
        InputError: its kind, a key or a value is wrong, or it has no answer; with the file and the line.
    """
    kind = KINDS.get(question.ask)
    if kind is None:
        question.place.refuse(f"question {question.name} asks {question.ask!r}; {meant(question.ask, KINDS)}", "ask")
    check_keys(question.given, (*QUESTION_KEYS, *kind.keys), question.place, f"question {question.name}")
    try:
        answer = kind.answer(question)
    except Robotics1Error as error:
        if isinstance(error, InputError) and str(error).startswith(f"{question.place.path}:"):
            raise
        question.place.refuse(f"question {question.name}: {error}")
    for what in question.published:
        if what not in answer.names:
            question.place.refuse(
                f"question {question.name}: nothing is called {what!r}; to publish there is {', '.join(answer.names)}",
                f"published.{what}",
            )
    return answer
