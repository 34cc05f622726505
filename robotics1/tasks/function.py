"""The user's own task: r = f(p, R, q)."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from keyword import iskeyword
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import configuration_derivative
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, by_name, counting_number, real_array, real_number
from robotics1.kinematics import forward_kinematics, is_batch, of_each, point_of_frame
from robotics1.orientation.expressions import wrapped
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.robot.parameters import Parameters
from robotics1.tasks.task import FrameMap

TaskFunction = Callable[..., npt.ArrayLike]
UNITS = ("m", "rad", "1")


@dataclass(frozen=True)
class FunctionTask:
    """r = f(p, R, q), with p (3,) and R (3, 3) of a frame in world axes and q (nq,).

    With named lengths it is f(p, R, q, l2=...): numbers have their values, and formulas keep their names. A name that
    the robot has too is that of the robot's own parameter.

    Attributes:
        f: the function; it returns (m,).
        rows: m, how many numbers it returns.
        derivative: J(p, R, q), (m, nv), if known; otherwise central differences are taken. `jacobian=` gives it too.
        frame: the frame's name; None for the tool.
        units: the unit of each row: "m", "rad" or "1". A row in "rad" is an angle: of its error whole turns are left
            out. None if they are unknown: then each row is a number, whose whole turns count.
        parameters: name → value of the lengths that f and its derivative take by keyword.
        point: (3,) a point that is fixed to the frame, in its axes [m], whose position p is; None for its origin.
    """

    f: TaskFunction
    rows: int
    derivative: TaskFunction | None = None
    frame: str | None = None
    units: tuple[str, ...] | None = None
    parameters: Mapping[str, float] = field(default_factory=dict, hash=False)
    point: tuple[float, float, float] | None = None

    def __init__(
        self,
        f: TaskFunction,
        rows: int,
        jacobian: TaskFunction | None = None,
        *,
        frame: str | None = None,
        units: Sequence[str] | None = None,
        derivative: TaskFunction | None = None,
        parameters: Mapping[str, float] | None = None,
        point: npt.ArrayLike | None = None,
    ) -> None:
        m = counting_number("rows", rows, least=1)
        c = point_of_frame(point)
        values = {
            "f": f,
            "rows": m,
            "derivative": derivative if jacobian is None else jacobian,
            "frame": frame,
            "units": None if units is None else _row_units(units, m),
            "parameters": _named_lengths(parameters),
            "point": None if c is None else tuple(c.tolist()),
        }
        for name, value in values.items():
            object.__setattr__(self, name, value)

    @property
    def row_names(self) -> tuple[str, ...]:
        """r1, r2, ..."""
        return tuple(f"r{i + 1}" for i in range(self.rows))

    @property
    def row_units(self) -> tuple[str, ...]:
        """Those that were given; without them the rows are taken as numbers."""
        return ("1",) * self.rows if self.units is None else self.units

    def with_parameters(self, values: Mapping[str, float]) -> FunctionTask:
        """Return the task with other values of its named lengths; names that it has not are left out."""
        own = {name: values.get(name, value) for name, value in self.parameters.items()}
        return replace(self, parameters=own)

    def value(self, robot: RobotLike, q: ConfigurationLike) -> Array:
        """Return r = f(p, R, q), (m,).

        Raises:
            TaskError: f fails, or returns something else than m finite numbers.
        """
        robot = robot_from(robot)
        return self._evaluate(self.f, robot, robot.configuration(q), (self.rows,))

    def target(self, target: Any) -> Array:
        """Return the target as (m,)."""
        return real_array("the target", target, (self.rows,), "one number for each row of the task")

    def error(self, robot: RobotLike, q: ConfigurationLike, target: Any) -> Array:
        """Return r_d − r, (m,); a row in "rad" is wrapped into (−π, π]."""
        return self._difference(self.target(target), self.value(robot, q))

    def jacobian(self, robot: RobotLike, q: ConfigurationLike) -> Array:
        """Return ∂f/∂q, (m, nv): the given one, else by central differences; of several q (k, nq), (k, m, nv)."""
        robot = robot_from(robot)
        if is_batch(q):
            return of_each(partial(self.jacobian, robot), robot, q, (self.rows, robot.nv))
        if self.derivative is None:
            r = self.value(robot, q)  # from which an angle differs little, also where it jumps from π to −π
            return configuration_derivative(lambda x: self._difference(self.value(robot, x), r), robot, q)
        return self._evaluate(self.derivative, robot, robot.configuration(q), (self.rows, robot.nv))

    def check(self, robot: Robot) -> None:
        """Raise TaskError if the robot has a parameter of one of these names with another value."""
        for name, value in self.parameters.items():
            own = robot.parameters.get(name, value)
            if own != value:
                raise TaskError(
                    f"parameter {name!r} of the task is {value:g}, and that of robot {robot.name!r} is {own:g}; "
                    f"give both the same value, or one another name"
                )

    def check_integrable(self, robot: Robot) -> None:
        """J is the derivative of f by construction."""

    def frame_map(self) -> FrameMap:
        """Return f itself, of the frame in world axes."""
        return FrameMap(
            self.frame,
            "world",
            self.f if self.point is None else self._at_the_point,
            by_differences=self.derivative is None,
            knows_units=self.units is not None,
            parameters=self.parameters,
        )

    def _at_the_point(self, p: Array, R: Array, q: Array, **parameters: Any) -> npt.ArrayLike:
        """Return f(p + R c, R, q), of the pose of the frame itself."""
        return self.f(p + R @ np.array(self.point), R, q, **parameters)

    def _difference(self, a: Array, b: Array) -> Array:
        """Return a − b, (m,), angles wrapped into (−π, π]."""
        d = a - b
        for i, unit in enumerate(self.row_units):
            if unit == "rad":
                d[i] = wrapped(d[i])
        return d

    def _evaluate(self, function: TaskFunction, robot: Robot, q: Array, shape: tuple[int, ...]) -> Array:
        if self.parameters:
            self.check(robot)
        T = forward_kinematics(robot, q, frame=self.frame, point=self.point)
        try:
            result = np.array(function(T.translation, T.rotation, q, **self.parameters), dtype=float)
        except Exception as error:
            raise TaskError(f"the task's function failed at q = {q.tolist()}: {error!r}") from error
        if result.shape != shape or not np.isfinite(result).all():
            raise TaskError(f"the task's function must return finite numbers of shape {shape}; it returned {result!r}")
        return result


def _named_lengths(parameters: Mapping[str, float] | None) -> Mapping[str, float]:
    """Return names and values of lengths, checked.

    Raises:
        InputError: a name is none that Python takes as a keyword, or is that of a joint, or a value is no number.
    """
    named = {
        name: real_number(f"parameter {name!r}", value)
        for name, value in by_name("parameters", parameters, "{'l2': 0.5}").items()
    }
    for name in named:
        if not name.isidentifier() or iskeyword(name) or name in ("p", "R", "q") or re.fullmatch(r"q(dot)?\d+", name):
            raise InputError(
                f"a named length needs a name such as 'l2', which is not that of p, R, q or of a joint; it is {name!r}"
            )
    return Parameters(named)


def _row_units(units: Sequence[str], rows: int) -> tuple[str, ...]:
    """Return the units of the rows.

    Raises:
        InputError: there is not one of "m", "rad" and "1" for each row.
    """
    given = tuple(units) if isinstance(units, Sequence) and not isinstance(units, str) else ()
    if len(given) != rows or any(unit not in UNITS for unit in given):
        raise InputError(f"units must hold 'm', 'rad' or '1' for each of the {rows} rows; it is {units!r}")
    return given
