"""An exam's file, read and checked: a message about a mistake names its line."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from robotics1 import Robot, load_robot, robot_from_dh
from robotics1.cli.arguments import read_text
from robotics1.errors import InputError, Robotics1Error
from robotics1.tasks.given import short_form
from robotics1.tasks.task import FrameTask

from .places import Place, meant, not_toml, places_of
from .values import number_of

FILE_KEYS = ("title", "exercise")
EXERCISE_KEYS = ("title", "text", "robot", "dh", "convention", "tool", "lengths", "data", "vary", "question")
QUESTION_KEYS = ("name", "text", "ask", "task", "published", "errata")
MOST_EXERCISES, MOST_QUESTIONS = 50, 100


@dataclass(frozen=True, eq=False)
class Question:
    """A question.

    Attributes:
        name: such as "2a".
        text: as it is asked, in words.
        ask: its kind.
        given: what else the file says, key → value as read.
        published: what → the value as printed.
        errata: the published numbers whose printed sign is known to be wrong, as "k=0 r[3]".
        place: where it stands.
        exercise: whose robot and data it has.
    """

    name: str
    text: str
    ask: str
    given: Mapping[str, Any]
    published: Mapping[str, Any]
    errata: tuple[str, ...]
    place: Place
    exercise: "Exercise"

    @property
    def task(self) -> FrameTask:
        """The task of the question.

        Raises:
            InputError: there is none.
        """
        if "task" not in self.given:
            self.place.refuse(f'question {self.name} needs a task, such as task = "position:xy"')
        task: FrameTask = self.read("task", lambda text: short_form(text_of(text)))
        return task

    def read(self, key: str, reader: Any, otherwise: Any = None) -> Any:
        """Return a given value as a reader understands it; without one, what is meant otherwise.

        Raises:
            InputError: it is missing and nothing is meant otherwise, or cannot be read; with the line.
        """
        if key not in self.given:
            if otherwise is None:
                self.place.refuse(f"question {self.name} ({self.ask}) needs {key!r}")
            return otherwise
        try:
            return reader(self.given[key])
        except Robotics1Error as error:
            self.place.refuse(f"question {self.name}, {key}: {error}", key)


@dataclass(frozen=True, eq=False)
class Exercise:
    """An exercise.

    Attributes:
        title, text: in words.
        robot: its robot; None without one.
        names: the names of lengths and data → values [m, rad, ...].
        drawn: the names whose values were drawn for a variant.
        questions: in order.
    """

    title: str
    text: str
    robot: Robot | None
    names: Mapping[str, float]
    drawn: tuple[str, ...]
    questions: list[Question]


@dataclass(frozen=True, eq=False)
class Exam:
    """An exam.

    Attributes:
        title: of it.
        exercises: in order.
        seed: of the variant; None of the exam itself.
    """

    title: str
    exercises: list[Exercise]
    seed: int | None


def read_exam(path: Path, seed: int | None = None) -> Exam:
    """Return the exam of a file; with a seed, a variant whose lengths and data are drawn anew where it has ranges.

    Raises:
        InputError: the file is none, or something in it is wrong; with the file and the line.
    """
    text = read_text(path)
    places = places_of(path, text)
    whole = places[""][0]
    try:
        content = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise not_toml(path, text, error) from error
    check_keys(content, FILE_KEYS, whole, "the exam")
    exercises = tables(content, "exercise", whole, MOST_EXERCISES)
    rng = None if seed is None else np.random.default_rng(seed)
    of_questions = iter(places["exercise.question"])
    read = []
    of_exercises = iter(places["exercise"])
    for number, table in enumerate(exercises, 1):
        place = next(of_exercises, whole)
        exercise = _exercise(table, place, number, rng)
        for k, asked in enumerate(tables(table, "question", place, MOST_QUESTIONS), 1):
            exercise.questions.append(_question(asked, next(of_questions, place), exercise, f"{number}.{k}"))
        read.append(exercise)
    return Exam(text_of(content.get("title", path.stem), whole, "title"), read, seed)


def _exercise(table: dict[str, Any], place: Place, number: int, rng: np.random.Generator | None) -> Exercise:
    check_keys(table, EXERCISE_KEYS, place, f"exercise {number}")
    lengths, data = (_numbers(table.get(key, {}), place, key) for key in ("lengths", "data"))
    drawn = _drawn(table.get("vary", {}), place, rng)
    unknown = [name for name in table.get("vary", {}) if name not in lengths and name not in data]
    if unknown:
        place.refuse(f"vary has {unknown[0]!r}, which is neither in lengths nor in data", "vary")
    lengths |= {name: value for name, value in drawn.items() if name in lengths}
    data |= {name: value for name, value in drawn.items() if name in data}
    robot = _robot(table, place, lengths)
    names = {**({} if robot is None else robot.parameters), **lengths, **data}
    title = text_of(table.get("title", f"Exercise {number}"), place, "title")
    return Exercise(title, text_of(table.get("text", ""), place, "text"), robot, names, tuple(drawn), [])


def _robot(table: dict[str, Any], place: Place, lengths: dict[str, float]) -> Robot | None:
    """Return the robot of a name, a file beside the exam's, or a DH table."""
    if "robot" in table and "dh" in table:
        place.refuse("give a robot or a DH table, not both", "dh")
    tool = text_of(table["tool"], place, "tool") if "tool" in table else None
    try:
        if "dh" in table:
            convention: Any = text_of(table.get("convention", "standard"), place, "convention")
            rows = [[_entry(entry, lengths) for entry in row] for row in table["dh"]]
            return robot_from_dh(rows, parameters=lengths, convention=convention)
        if "robot" in table:
            source = text_of(table["robot"], place, "robot")
            file = place.path.parent / source
            return load_robot(file if file.is_file() else source, parameters=lengths, tool=tool)
    except (Robotics1Error, TypeError) as error:
        place.refuse(str(error), "dh" if "dh" in table else "robot")
    return None


def _entry(entry: Any, lengths: Mapping[str, float]) -> Any:
    """Return an entry of a DH table: "R" and "P", the name of a length, or a number such as "pi/2"."""
    if not isinstance(entry, str) or entry in ("R", "P") or entry.removeprefix("-") in lengths:
        return entry
    return number_of(entry, {})


def _question(table: dict[str, Any], place: Place, exercise: Exercise, otherwise: str) -> Question:
    name = text_of(table.get("name", otherwise), place, "name")
    if "ask" not in table:
        place.refuse(f'question {name} needs a kind, such as ask = "jacobian"')
    published = table.get("published", {})
    if not isinstance(published, dict):
        place.refuse(f'question {name}: published must be a table, what = "as printed"', "published")
    errata = table.get("errata", [])
    if not isinstance(errata, list) or not all(isinstance(entry, str) for entry in errata):
        place.refuse(f'question {name}: errata must be names of published numbers, such as ["k=0 r[3]"]', "errata")
    read = ("name", "text", "ask", "published", "errata")
    given = {key: value for key, value in table.items() if key not in read}
    text = text_of(table.get("text", ""), place, "text")
    return Question(name, text, text_of(table["ask"], place, "ask"), given, published, tuple(errata), place, exercise)


def _numbers(table: Any, place: Place, key: str) -> dict[str, float]:
    if not isinstance(table, dict):
        place.refuse(f"{key} must be a table, such as {key} = {{ l2 = 0.5 }}", key)
    try:
        return {name: number_of(value, {}) for name, value in table.items()}
    except InputError as error:
        place.refuse(f"{key}: {error}", key)


def _drawn(table: Any, place: Place, rng: np.random.Generator | None) -> dict[str, float]:
    """Return the names with ranges → values on the grid lower, lower + step, ..., upper; none without a seed."""
    if not isinstance(table, dict):
        place.refuse("vary must be a table, such as vary = { l2 = [0.3, 0.8, 0.1] }", "vary")
    drawn = {}
    for name, span in table.items():
        if not isinstance(span, list) or len(span) != 3 or not all(type(x) in (int, float) for x in span):
            place.refuse(f"vary: {name} must be [lowest, highest, step]; it is {span!r}", f"vary.{name}")
        low, high, step = map(float, span)
        if not (low <= high and step > 0 and (high - low) / step < 1e6):
            place.refuse(f"vary: {name} must have lowest ≤ highest and a step; it is {span!r}", f"vary.{name}")
        if rng is not None:
            drawn[name] = round(low + step * int(rng.integers(int((high - low) / step + 1e-9) + 1)), 9)
    return drawn


def text_of(value: Any, place: Place | None = None, key: str = "") -> str:
    """Return a text.

    Raises:
        InputError: it is none.
    """
    if isinstance(value, str):
        return value
    message = f"{key or 'it'} must be a text in quotes; it is {value!r}"
    if place is None:
        raise InputError(message)
    place.refuse(message, key)


def check_keys(table: Mapping[str, Any], known: tuple[str, ...], place: Place, what: str) -> None:
    """Refuse a key that means nothing.

    Raises:
        InputError: there is one.
    """
    for key in table:
        if key not in known:
            place.refuse(f"{what} has {key!r}; {meant(key, known)}", key)


def tables(table: Mapping[str, Any], key: str, place: Place, most: int) -> list[dict[str, Any]]:
    """Return the tables of an array of tables.

    Raises:
        InputError: there are none, or too many.
    """
    found = table.get(key, [])
    name = key if key == "exercise" else f"exercise.{key}"
    if isinstance(found, dict):
        place.refuse(f"one pair of brackets is too few: write [[{name}]]", key)
    if not isinstance(found, list) or not found or not all(isinstance(entry, dict) for entry in found):
        place.refuse(f"there is no [[{name}]] here; each {key} begins with such a line")
    if len(found) > most:
        place.refuse(f"there are {len(found)} {key}s; at most {most} are read")
    return found
