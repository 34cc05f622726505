"""The user's own task: r = f(p, R, q)."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import configuration_derivative
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, counting_number, real_array
from robotics1.kinematics import forward_kinematics, is_batch
from robotics1.orientation.expressions import wrapped
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.task import FrameMap

TaskFunction = Callable[[Array, Array, Array], npt.ArrayLike]
UNITS = ("m", "rad", "1")


@dataclass(frozen=True)
class FunctionTask:
    """r = f(p, R, q), with p (3,) and R (3, 3) of a frame in world axes and q (nq,).

    Attributes:
        f: the function; it returns (m,).
        rows: m, how many numbers it returns.
        derivative: J(p, R, q), (m, nv), if known; otherwise central differences are taken. `jacobian=` gives it too.
        frame: the frame's name; None for the tool.
        units: the unit of each row: "m", "rad" or "1". A row in "rad" is an angle: of its error whole turns are left
            out. None if they are unknown: then each row is a number, whose whole turns count.
    """

    f: TaskFunction
    rows: int
    derivative: TaskFunction | None = None
    frame: str | None = None
    units: tuple[str, ...] | None = None

    def __init__(
        self,
        f: TaskFunction,
        rows: int,
        jacobian: TaskFunction | None = None,
        *,
        frame: str | None = None,
        units: Sequence[str] | None = None,
        derivative: TaskFunction | None = None,
    ) -> None:
        m = counting_number("rows", rows, least=1)
        values = {
            "f": f,
            "rows": m,
            "derivative": derivative if jacobian is None else jacobian,
            "frame": frame,
            "units": None if units is None else _row_units(units, m),
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
            every = [self.jacobian(robot, one) for one in robot.configurations(q)]
            return np.reshape(every, (len(every), self.rows, robot.nv))
        if self.derivative is None:
            r = self.value(robot, q)  # from which an angle differs little, also where it jumps from π to −π
            return configuration_derivative(lambda x: self._difference(self.value(robot, x), r), robot, q)
        return self._evaluate(self.derivative, robot, robot.configuration(q), (self.rows, robot.nv))

    def check(self, robot: Robot) -> None:
        """Any robot will do."""

    def check_integrable(self, robot: Robot) -> None:
        """J is the derivative of f by construction."""

    def frame_map(self) -> FrameMap:
        """Return f itself, of the frame in world axes."""
        return FrameMap(
            self.frame,
            "world",
            self.f,
            by_differences=self.derivative is None,
            knows_units=self.units is not None,
        )

    def _difference(self, a: Array, b: Array) -> Array:
        """Return a − b, (m,), angles wrapped into (−π, π]."""
        d = a - b
        for i, unit in enumerate(self.row_units):
            if unit == "rad":
                d[i] = wrapped(d[i])
        return d

    def _evaluate(self, function: TaskFunction, robot: Robot, q: Array, shape: tuple[int, ...]) -> Array:
        T = forward_kinematics(robot, q, frame=self.frame)
        try:
            result = np.array(function(T.translation, T.rotation, q), dtype=float)
        except Exception as error:
            raise TaskError(f"the task's function failed at q = {q.tolist()}: {error!r}") from error
        if result.shape != shape or not np.isfinite(result).all():
            raise TaskError(f"the task's function must return finite numbers of shape {shape}; it returned {result!r}")
        return result


def _row_units(units: Sequence[str], rows: int) -> tuple[str, ...]:
    """Return the units of the rows.

    Raises:
        InputError: there is not one of "m", "rad" and "1" for each row.
    """
    given = tuple(units) if isinstance(units, Sequence) and not isinstance(units, str) else ()
    if len(given) != rows or any(unit not in UNITS for unit in given):
        raise InputError(f"units must hold 'm', 'rad' or '1' for each of the {rows} rows; it is {units!r}")
    return given
