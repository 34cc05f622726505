"""An arm that is known only by its direct kinematics, r = f(q)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.dh.entries import Limits, joint_limits
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot
from robotics1.tasks.function import FunctionTask
from robotics1.textbook_robots.joint_formulas import in_joints, joint_letters, joint_symbols, listed_formulas

KINDS = {"R": "revolute", "P": "prismatic"}
BASE = "base"


def robot_from_formula(
    formulas: Sequence[Any],
    joints: str,
    *,
    values: Mapping[str, float] | None = None,
    units: Sequence[str] | None = None,
    lower: Limits = None,
    upper: Limits = None,
) -> FormulaRobot:
    """Return an arm that is known only by its direct kinematics r = f(q), with f as its task, `arm.task`.

        arm = robot_from_formula(["q2*cos(q1)", "q2*sin(q1)", "q3"], joints="RPP")
        find_singularities(arm, arm.task); solve_ik(arm, arm.task, [0.3, 0.4, 0.1]); formulas(arm, arm.task).determinant

    A formula says where the task is, and not where the links are. So the arm has joints and no tool: what asks for a
    frame, as `forward_kinematics`, is refused, and what asks for a task takes `arm.task`. J = ∂f/∂q is exact.

    Args:
        formulas: (m,) one for each row: texts in q1, q2, ... and the names of `values`, or SymPy expressions.
        joints: a letter "R" or "P" for each joint.
        values: of the other names, such as {"l1": 0.5}, which are put in their place.
        units: "m", "rad" or "1" of each row, as in a `FunctionTask`; a row in "rad" counts up to whole turns.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: a formula is none, or has a name that is no joint and has no value; or a letter or limit is wrong.
        UnknownNameError: a value is of no name in the formulas.
    """
    n = len(joint_letters(joints))
    entries = listed_formulas(formulas, "['q2*cos(q1)', 'q2*sin(q1)']")
    f = FormulaFunction(tuple(in_joints(entries, n, values)), n)
    low, high = joint_limits(lower, upper, [letter == "R" for letter in joints])
    listed, parent = [], BASE
    for i, (letter, a, b) in enumerate(zip(joints, low.tolist(), high.tolist(), strict=True), 1):
        link = "end" if i == n else f"link{i}"
        listed.append(Joint(f"q{i}", KINDS[letter], parent, link, axis=(0, 0, 1), lower=a, upper=b))
        parent = link
    plain = robot_of_joints("formula", listed)
    known = {entry.name: getattr(plain, entry.name) for entry in fields(plain) if entry.init}
    task = FunctionTask(f, len(f.entries), f.derivative, frame=BASE, units=units)
    return FormulaRobot(**{**known, "tool": None}, task=task)


@dataclass(frozen=True, eq=False)
class FormulaRobot(Robot):
    """Joints without links, whose direct kinematics is a task.

    Attributes:
        task: r = f(q).
    """

    task: FunctionTask = field(kw_only=True)

    def frame_id(self, frame: str | None) -> int:
        """Return the number of the base; there is no other frame.

        Raises:
            InputError: another frame, or the tool, is asked for.
        """
        if frame != BASE:
            raise InputError("an arm that is known only by its formula has no frames: use its task, arm.task")
        return super().frame_id(frame)


@dataclass(frozen=True)
class FormulaFunction:
    """f(q) of expressions, in numbers and in symbols, with its derivative.

    Attributes:
        entries: (m,) SymPy expressions in q1, ..., qn.
        n: the number of joints.
    """

    entries: tuple[Any, ...]
    n: int

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: not the functions that were made of the formulas."""
        return {"entries": self.entries, "n": self.n}

    def __call__(self, p: Array, R: Array, q: Array) -> Array:
        """Return f(q), (m,): numbers of numbers, expressions of expressions."""
        if q.dtype == object:
            import sympy

            known = dict(zip(joint_symbols(self.n), map(sympy.sympify, q), strict=True))
            return np.array([entry.xreplace(known) for entry in self.entries], dtype=object)
        return self._numbers(0, q)

    def derivative(self, p: Array, R: Array, q: Array) -> Array:
        """Return ∂f/∂q, (m, n)."""
        return self._numbers(1, q).reshape(len(self.entries), self.n)

    def _numbers(self, order: int, q: Array) -> Array:
        """Return what the formulas of an order give; a complex number, such as √−1, is none, and the task says so."""
        with np.errstate(all="ignore"):
            values = [f(*q) for f in self._functions[order]]
        return np.array([np.nan if np.iscomplexobj(value) else value for value in values], dtype=float)

    @cached_property
    def _functions(self) -> tuple[list[Callable[..., Any]], list[Callable[..., Any]]]:
        from robotics1.symbolic.writing.printing import numpy_function

        symbols = joint_symbols(self.n)
        slopes = [entry.diff(q) for entry in self.entries for q in symbols]
        return [numpy_function(symbols, e) for e in self.entries], [numpy_function(symbols, e) for e in slopes]
