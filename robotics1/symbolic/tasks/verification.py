"""No formula is returned before it has been compared with Pinocchio, at random q, q̇ and parameters."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin
import sympy

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.cleaning import cleaned
from robotics1.symbolic.writing.numeric_functions import numpy_function
from robotics1.tasks.function import FunctionTask
from robotics1.tasks.task import Task

AGREES = 1e-9  # largest difference of a formula from Pinocchio, relative to the larger of 1 and the value
TRIALS = 3
ENOUGH = 1e-11  # estimated error of a derivative at which steps get no smaller; the error itself is far below


class Point(NamedTuple):
    """Where a formula is tried: a robot with its parameters at some values, q and q̇."""

    robot: Robot
    parameters: list[float]
    q: Array
    qdot: Array


@dataclass(frozen=True, eq=False)
class Trials:
    """The points at which the formulas of a robot are tried.

    Attributes:
        robot: whose formulas.
        q, qdot: the symbols of configuration and velocity.
    """

    robot: Robot
    q: tuple[sympy.Symbol, ...]
    qdot: tuple[sympy.Symbol, ...]

    @cached_property
    def points(self) -> list[Point]:
        """Random points, the parameters within 30 % of their values; angles of the file are made exact."""
        rng = np.random.default_rng(0)
        found = []
        for _ in range(TRIALS):
            values = {key: value * rng.uniform(0.7, 1.3) for key, value in self.robot.parameters.items()}
            robot = self.robot.with_parameters(values) if values else self.robot
            q, qdot = rng.uniform(-2, 2, self.robot.nq), rng.uniform(-1, 1, self.robot.nq)
            found.append(Point(cleaned(robot)[0], list(values.values()), q, qdot / np.abs(qdot).sum()))
        return found

    def verify(
        self, formula: Any, numbers: Callable[[Point], Any], name: str, *, difference: Callable[..., Any] = np.subtract
    ) -> None:
        """Compare a formula, or a matrix of them, with numbers at every point.

        Raises:
            FormulaError: they differ by more than 1e-9, relative to the larger of 1 and the value.
        """
        parameters = [sympy.Symbol(parameter, real=True) for parameter in self.robot.parameters]
        evaluate = numpy_function([*self.q, *self.qdot, *parameters], formula)
        for point in self.points:
            theirs = np.asarray(numbers(point), dtype=float)
            with np.errstate(all="ignore"):
                ours = np.asarray(evaluate(*point.q, *point.qdot, *point.parameters), dtype=float)
            theirs = theirs.reshape(ours.shape)
            error = np.abs(difference(ours, theirs)).max(initial=0.0)
            if not error <= AGREES * max(1.0, np.abs(theirs).max(initial=0.0)):
                raise FormulaError(f"the formula of {name} differs from Pinocchio by {error:.1e}")


def numeric_value(task: Task, robot: Robot, q: Array) -> Array:
    """Return r, of a pose as the homogeneous matrix."""
    r = task.value(robot, q)
    return r.homogeneous if isinstance(r, pin.SE3) else np.asarray(r)


def numeric_jacobian(task: Task, robot: Robot, q: Array) -> Array:
    """Return J; of a function of the user's own as the derivative of its values, to about 1e-13."""
    if not isinstance(task, FunctionTask):
        return np.asarray(task.jacobian(robot, q))

    def along(d: Array) -> Array:
        return rate(lambda t: task.value(robot, q + t * d))

    return np.array([along(d) for d in np.eye(robot.nv)]).T


def rate(f: Callable[[float], Array]) -> Array:
    """Return df/dt at t = 0 of an array that depends smoothly on t, to about 1e-13 of numbers that are exact."""
    from scipy.differentiate import derivative

    shape = np.shape(f(0.0))

    def flat(t: Array) -> Array:
        values = np.array([np.ravel(f(float(x))) for x in np.ravel(t)])
        return values.T.reshape(-1, *np.shape(t))

    tolerances = {"atol": ENOUGH, "rtol": ENOUGH}
    found = derivative(flat, 0.0, preserve_shape=True, tolerances=tolerances, initial_step=0.1, maxiter=8)
    return np.asarray(found.df).reshape(shape)
