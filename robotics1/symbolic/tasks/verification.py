"""No formula is returned before it has been compared with Pinocchio, at random q, q̇ and parameters."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin
import sympy

from robotics1.caching import cached_property
from robotics1.differentiation import Estimate, derivative
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.exact import exact_robot
from robotics1.symbolic.writing.printing import numpy_function
from robotics1.tasks.task import Task

AGREES = 1e-9  # largest difference of a formula from Pinocchio, relative to what the numbers are sums of
EPSILON = float(np.finfo(float).eps)
MARGIN = 30  # a comparison stands so many times above the error of the numbers
UNDECIDED = 1e-6  # relative: numbers whose error is larger, with that margin, decide nothing
TRIALS = 3


class Point(NamedTuple):
    """Where a formula is tried: a robot with its parameters at some values, q and q̇."""

    robot: Robot
    parameters: dict[str, float]
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
            q, qdot = rng.uniform(-2, 2, self.robot.nq), rng.uniform(-1, 1, self.robot.nq)
            robot, _ = exact_robot(self.robot, values or None)
            found.append(Point(robot, values, q, qdot / np.abs(qdot).sum()))
        return found

    def verify(
        self,
        formula: Any,
        numbers: Callable[[Point], Estimate],
        name: str,
        *,
        difference: Callable[..., Any] = np.subtract,
    ) -> None:
        """Compare a formula, or a matrix of them, with numbers at every point.

        Raises:
            FormulaError: they differ by more than 1e-9, relative to the value or to the terms that it is a sum of (1
                where these are larger), and by more than 30 times the estimated error of the numbers; or that error is
                too large to tell.
        """
        parameters = [sympy.Symbol(parameter, real=True) for parameter in self.robot.parameters]
        evaluate = numpy_function([*self.q, *self.qdot, *parameters], formula)
        for point in self.points:
            theirs, error = numbers(point)
            with np.errstate(all="ignore"):
                ours = np.asarray(evaluate(*point.q, *point.qdot, *point.parameters.values()), dtype=float)
            doubt = float(np.max(error, initial=0.0))
            terms = min(1.0, doubt / EPSILON) if doubt else 1.0  # rounding is as large as ε times the terms
            size = max(terms, np.abs(theirs).max(initial=0.0))
            if not MARGIN * doubt <= UNDECIDED * size:
                raise FormulaError(f"the formula of {name} cannot be compared: numbers are known to {doubt:.1e} only")
            apart = np.abs(difference(ours, theirs.reshape(ours.shape))).max(initial=0.0)
            if not apart <= max(AGREES * size, MARGIN * doubt):
                raise FormulaError(f"the formula of {name} differs from Pinocchio by {apart:.1e}")


@dataclass(frozen=True, eq=False)
class TaskNumbers:
    """Value and Jacobian of a task in numbers, at the points of its trials.

    Attributes:
        task: of the robot of the points; its named lengths have the values of the point.
        places: the rows that are read.
    """

    task: Any
    places: list[int]

    def value(self, point: Point) -> Estimate:
        """Return r, of a pose as the homogeneous matrix."""
        r = self._at(point).value(point.robot, point.q)
        found = rounded(r.homogeneous if isinstance(r, pin.SE3) else r)
        return self._chosen(found) if found.value.shape == (self.task.rows,) else found

    def jacobian(self, point: Point) -> Estimate:
        """Return J; of a function of the user's own as the derivative of its values."""
        task, robot, q = self._at(point), point.robot, point.q
        form = task.frame_map()
        if form is None or form.S is not None or not robot.nv:
            return self._chosen(rounded(task.jacobian(robot, q) if robot.nv else np.zeros((task.rows, 0))))
        columns = [derivative(lambda t, d=d: task.value(robot, q + t * d)) for d in np.eye(robot.nv)]  # type: ignore[misc]
        return self._chosen(Estimate(*(np.stack(parts, axis=-1) for parts in zip(*columns, strict=True))))

    def jacobian_rate(self, point: Point) -> Estimate:
        """Return J̇ = dJ(q + t q̇)/dt."""

        def J(t: float) -> Estimate:
            return self.jacobian(point._replace(q=point.q + t * point.qdot))

        return derivative(lambda t: J(t).value, noise=J(0.0).error)  # J may itself be a derivative

    def _at(self, point: Point) -> Task:
        if not hasattr(self.task, "with_parameters"):
            return self.task  # type: ignore[no-any-return]
        return self.task.with_parameters(point.parameters)  # type: ignore[no-any-return]

    def _chosen(self, found: Estimate) -> Estimate:
        return Estimate(found.value[self.places], found.error[self.places])


def numeric_determinant(J: Estimate) -> Estimate:
    """Return det J, with an error of one row in proportion to the product of the lengths of the rows (Hadamard)."""
    lengths = np.linalg.norm(J.value, axis=1)
    error = np.linalg.norm(J.error, axis=1) + len(lengths) * EPSILON * lengths
    others = [np.prod(np.delete(lengths, i)) for i in range(len(lengths))]
    return Estimate(np.asarray(np.linalg.det(J.value)), np.asarray(float(np.sum(error * others))))


def numeric_product(A: Estimate, B: Estimate) -> Estimate:
    """Return A B, with |δ(A B)| ≤ |δA||B| + |A||δB| entry by entry."""
    error = A.error @ np.abs(B.value) + np.abs(A.value) @ B.error
    return Estimate(A.value @ B.value, error)


def rounded(value: Any) -> Estimate:
    """Return an array that is exact but for rounding, of about ten operations on numbers of the size of its largest."""
    value = np.asarray(value, dtype=float)
    largest = float(np.abs(value).max(initial=0.0))
    return Estimate(value, np.full(value.shape, 10 * EPSILON * largest))
