"""The sizes of an arm's workspace as formulas, compared with the exact workspace before they are given."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import sympy

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.symbolic.tasks.formula import formulas
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task
from robotics1.workspaces.find import workspace
from robotics1.workspaces.flat.flat_arm import PlanarArm, planar_arm, plane_beside_axis
from robotics1.workspaces.moving_point import moving_point
from robotics1.workspaces.questions.closed_forms import ClosedForm, PlaneFormulas, closed_form
from robotics1.workspaces.questions.forms_in_space import TurnedPlane, form_in_space, without_sign
from robotics1.workspaces.questions.forms_of_radii import form_of_radii

AGREE = 1e-9  # relative, between a formula and the exact workspace


@dataclass(frozen=True, eq=False)
class WorkspaceFormulas(Frozen):
    """Formulas in the named lengths and in the ends of ranges, as q2_min and q2_max.

    Attributes:
        r_min, r_max: the smallest and largest distance from the first joint's axis [m]; None where it is not known.
        area: [m²], of an arm in a plane; else None.
        volume: [m³], of an arm in space; else None.
        lengths: of the links that count [m].
        conditions: what decides between cases, in sentences. Lengths are taken to be positive.
        values: the names in the formulas and their values.
    """

    r_min: Any
    r_max: Any
    area: Any
    volume: Any
    lengths: tuple[Any, ...]
    conditions: tuple[str, ...]
    values: Mapping[str, float]

    def number(self, formula: Any) -> float:
        """Return the value of one of the formulas with the robot's own lengths and limits."""
        return float(formula.subs({s: self.values[s.name] for s in formula.free_symbols}))

    def explain(self) -> str:
        """Return the formulas and their conditions, one a line."""
        names = ("r_min", "r_max", "area", "volume")
        lines = [f"{name} = {getattr(self, name)}" for name in names if getattr(self, name) is not None]
        return "\n".join([*lines, *self.conditions])


def workspace_formulas(
    robot: RobotLike, task: TaskLike, *, box: Mapping[str, tuple[float, float]] | None = None
) -> WorkspaceFormulas:
    """Return the radii and the area or volume of a workspace as formulas.

    Known are: planar arms of revolute joints that turn fully, r from Max(0, 2 l_max − Σ l) to Σ l; RR with limits and
    RP, from the extremes of r(q2); RPR and RRP that turn fully; PP; PR, PRR and PPR along strokes; the radii of any
    other planar chain that begins to turn, with limits, and its area if it is an annulus; these times a slide
    across their plane (SCARA, cylindrical, gantry); the spherical shells of anthropomorphic and polar arms,
    4/3 π (R³ − r³), with q1 limited too, also where the shoulder is beside the axis of joint 1 in the arm's plane or
    across it; the sector of a shell of a polar arm with limits. Each formula is compared with the exact workspace, at
    the robot's own lengths and at others.

    Args:
        robot: the arm, with named lengths where these shall stay.
        task: two or three coordinates of a point.
        box: joint name → (lower, upper) [rad or m], inside the limits.

    Raises:
        TaskError: no formula is known of this arm.
        InputError: a prismatic joint has no limits.
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    point = moving_point(robot, task, box)
    arm = planar_arm(robot, point) or plane_beside_axis(robot, point)
    symbolic = formulas(robot, task)
    moving = {axis.number for axis in point.axes}
    others = {x: sympy.nsimplify(point.neutral[i], rational=True) for i, x in enumerate(symbolic.q) if i not in moving}
    position = symbolic.value.subs(others)
    values = dict(robot.parameters)
    for axis in point.axes:
        q = str(symbolic.q[axis.number])
        values |= {f"{q}_min": axis.lower, f"{q}_max": axis.upper}
    found = None
    if arm is not None:
        plane = _plane(arm, position, symbolic.q, values)
        flat = closed_form(plane)
        if flat is None and arm.turn is None:
            flat = form_of_radii(plane, workspace(robot, task, box=box))
        found = None if flat is None else _sized(arm, flat, position, symbolic.q, values)
    if found is None:
        raise TaskError(
            f"no formula is known of the workspace of robot {robot.name!r}; workspace(robot, task) has its numbers"
        )
    result = WorkspaceFormulas(**found, values=values)
    _compare(robot, task, box, result)
    if robot.parameters:
        others = {name: value * (1 + 0.003 * (i + 1)) for i, (name, value) in enumerate(robot.parameters.items())}
        _compare(robot.with_parameters(others), task, box, replace(result, values=values | others))
    return result


def _plane(arm: PlanarArm, position: Any, q: Sequence[Any], values: Mapping[str, float]) -> PlaneFormulas:
    """Return the position in the plane of the chain; a joint that turns the plane stands at 0."""
    value = position
    if arm.place.base is not None:
        value = _exact(arm.directions @ arm.place.rows.T) * value
    if arm.turn is not None:
        value = value.subs(q[arm.turn.number], 0)
    return PlaneFormulas(sympy.Matrix(value), list(q), arm.joints, values)


def _exact(numbers: Array) -> Any:
    return sympy.Matrix([[sympy.nsimplify(float(x), rational=True) for x in row] for row in numbers])


def _sized(
    arm: PlanarArm, flat: ClosedForm, position: Any, q: Sequence[Any], values: dict[str, float]
) -> dict[str, Any] | None:
    """Return r_min, r_max, area, volume, lengths and conditions, in the plane or in space."""
    known: dict[str, Any] = {"r_min": flat.r_min, "r_max": flat.r_max, "area": None, "volume": None}
    known |= {"lengths": flat.lengths, "conditions": flat.conditions}
    if arm.slide is not None:
        stroke = _range(q[arm.slide.number])
        return known | {"volume": None if flat.area is None else flat.area * stroke}
    if arm.turn is None:
        return known | {"area": flat.area}
    first = q[arm.turn.number]
    angle = 2 * sympy.pi if arm.turn.circular else _range(first)
    across = sympy.simplify((_exact(arm.normal[None] @ arm.place.rows.T) * position.subs(first, 0))[0])
    turned = TurnedPlane(_plane(arm, position, q, values), flat, without_sign(across), angle, arm.turn.circular)
    found = form_in_space(turned)
    return None if found is None else known | found


def _range(q: Any) -> Any:
    """Return upper − lower of a joint."""
    return sympy.Symbol(f"{q}_max", real=True) - sympy.Symbol(f"{q}_min", real=True)


def _compare(robot: Robot, task: Task, box: Mapping[str, tuple[float, float]] | None, found: WorkspaceFormulas) -> None:
    """Raise TaskError if a formula has another value than the exact workspace."""
    exact = workspace(robot, task, box=box)
    for name in ("r_min", "r_max", "area", "volume"):
        formula, value = getattr(found, name), getattr(exact, name)
        if formula is not None and abs(found.number(formula) - value) > AGREE * max(1.0, abs(value)):
            raise TaskError(
                f"no formula is known of the workspace of robot {robot.name!r}: that of {name} does not hold for its "
                "offsets; workspace(robot, task) has its numbers"
            )
