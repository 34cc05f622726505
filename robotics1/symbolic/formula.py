"""Formulas of a task: its value, its Jacobian, determinant and minors, in SymPy, checked against Pinocchio."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import pinocchio as pin
import sympy

from robotics1.errors import FormulaError, TaskError
from robotics1.inputs import Array
from robotics1.kinematics import frame_jacobian
from robotics1.robot.model import Robot
from robotics1.symbolic.chain import Chain, Matrix, chain_to
from robotics1.symbolic.cleaning import cleaned
from robotics1.symbolic.determinants import determinant, minors
from robotics1.symbolic.factoring import factors
from robotics1.symbolic.laurent import Laurent
from robotics1.symbolic.writing import Groups, written, written_product
from robotics1.tasks.task import FrameTask, Task

AGREES = 1e-9  # largest difference of a formula from Pinocchio, relative to the larger of 1 and the value
TRIALS = 3  # random q and parameters at which it is tried


@dataclass(frozen=True, eq=False)
class Formulas:
    """The formulas of a task, in q1, q2, ... and the robot's named parameters.

    Attributes:
        robot, task: of what.
        q: the symbols q1, q2, ...
        value: r = f(q): a column; of an orientation (3, 3), of a pose the homogeneous (4, 4).
        jacobian: J(q), (m, n).
        cleaned: the largest correction that made an angle of the file exact, as 1.5708 to π/2 [rad].
    """

    robot: Robot
    task: Task
    q: tuple[sympy.Symbol, ...]
    value: sympy.Matrix
    jacobian: sympy.Matrix
    cleaned: float
    chain: Chain = field(repr=False)
    rows: Matrix = field(repr=False)

    @cached_property
    def groups(self) -> Groups:
        """The angles that are added up: of consecutive joints with parallel axes."""
        return parallel_groups(self.chain)

    @cached_property
    def determinant(self) -> sympy.Expr:
        """Det J(q), reduced and factored.

        Raises:
            TaskError: J is not square.
            FormulaError: the formula does not agree with Pinocchio.
        """
        return written_product(self.determinant_factors, self.groups)

    @cached_property
    def determinant_factors(self) -> tuple[Laurent, ...]:
        """Factors whose product is det J."""
        m, n = self.rows.shape
        if m != n:
            raise TaskError(f"J is {m} × {n}: it has minors, but no determinant")
        moving = [i for i, joint in enumerate(self.chain.joints) if joint.kind != "fixed"]
        whole_pose = m == 6 and self._is_whole_pose
        M = self.chain.jacobian_at(moving[len(moving) // 2]) if whole_pose else self.rows
        found = factors(determinant(M))
        self._check_minors({(): written_product(found, self.groups)})
        return found

    @cached_property
    def minors(self) -> dict[tuple[int, ...], sympy.Expr]:
        """The largest minors: the columns (or, of a tall J, rows) that are left out, from 0 → the minor, factored.

        Raises:
            FormulaError: a formula does not agree with Pinocchio.
        """
        if self.rows.shape[0] == self.rows.shape[1]:
            return {(): self.determinant}
        found = {out: written_product(factors(f), self.groups) for out, f in minors(self.rows).items()}
        self._check_minors(found)
        return found

    @property
    def _is_whole_pose(self) -> bool:
        return isinstance(self.task, FrameTask) and self.task.row_names == ("x", "y", "z", "ωx", "ωy", "ωz")

    def _check_minors(self, found: dict[tuple[int, ...], sympy.Expr]) -> None:
        def numeric(J: Array) -> Array:
            wide = J.shape[1] > J.shape[0]
            return np.array([np.linalg.det(np.delete(J, out, axis=int(wide))) for out in found])

        expression = sympy.Matrix(list(found.values()))
        verify(self.robot, self.q, expression, lambda robot, q: numeric(self.task.jacobian(robot, q)), "a minor of J")


def formulas(robot: Robot, task: Task) -> Formulas:
    """Return the formulas of a task, built from the same file as the robot's numbers.

    Every formula is compared with Pinocchio at random q and parameters before it is returned.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q), on a frame.

    Raises:
        TaskError: the task does not fit the robot.
        FormulaError: the file's numbers depend on the parameters in a way that cannot be told, or a formula does
            not agree with Pinocchio to 1e-9.
    """
    task.check(robot)
    if not isinstance(task, FrameTask):
        raise FormulaError("formulas are written for tasks on a frame, not for a function of the user's own")
    chain = chain_to(robot, robot.model.frames[robot.frame_id(task.frame)].name)
    groups = parallel_groups(chain)
    R, p, J = _in_axes(chain, task)
    selected = np.array([_combined(row, J) for row in _selection(task)], dtype=object)
    value = sympy.Matrix(task.g(_expressions(p, groups), _expressions(R, groups)))
    jacobian = sympy.Matrix(_expressions(selected, groups))
    found = Formulas(robot, task, chain.q, value, jacobian, cleaned(robot)[1], chain, selected)
    verify(robot, chain.q, jacobian, task.jacobian, "J")
    verify(robot, chain.q, value, lambda robot, q: _plain(task.value(robot, q)), "the value")
    return found


def verify(
    robot: Robot,
    q: tuple[sympy.Symbol, ...],
    expression: sympy.Matrix,
    numbers: Callable[[Robot, Array], Array],
    name: str,
) -> None:
    """Compare a formula with numbers at random q and parameters.

    Raises:
        FormulaError: they differ by more than 1e-9, relative to the larger of 1 and the value.
    """
    symbols = [sympy.Symbol(parameter, real=True) for parameter in robot.parameters]
    evaluate = sympy.lambdify([*q, *symbols], expression, modules="numpy")
    rng = np.random.default_rng(0)
    for _ in range(TRIALS):
        parameters = {key: value * rng.uniform(0.7, 1.3) for key, value in robot.parameters.items()}
        at = cleaned(robot.variant(parameters) if robot.variant is not None else robot)[0]
        point = rng.uniform(-2, 2, robot.nq)
        ours = np.asarray(evaluate(*point, *parameters.values()), dtype=float).ravel()
        theirs = np.asarray(numbers(at, point), dtype=float).ravel()
        if np.abs(ours - theirs).max() > AGREES * max(1.0, np.abs(theirs).max()):
            raise FormulaError(f"the formula of {name} differs from Pinocchio by {np.abs(ours - theirs).max():.1e}")


def parallel_groups(chain: Chain) -> Groups:
    """Return the places of the angles that are added up: consecutive revolute joints with parallel axes."""
    robot = chain.robot
    own = [joint.leader for joint in chain.joints if joint.kind == "revolute"]
    columns = [robot.joint_names.index(name) for name in dict.fromkeys(own)]
    places = {i: chain.frequencies.angles.index(chain.q[i]) for i in columns}
    rng = np.random.default_rng(0)
    axes = [frame_jacobian(robot, rng.uniform(-2, 2, robot.nq), frame=chain.frame)[3:] for _ in range(2)]
    groups: list[list[int]] = []
    for before, i in zip([None, *columns], columns, strict=False):
        parallel = before is not None and all(np.linalg.norm(np.cross(w[:, before], w[:, i])) < 1e-9 for w in axes)
        if parallel:
            groups[-1].append(places[i])
        else:
            groups.append([places[i]])
    rest = [[j] for j in range(len(chain.frequencies.angles)) if j not in places.values()]
    return tuple(map(tuple, groups + rest))


def _in_axes(chain: Chain, task: FrameTask) -> tuple[Matrix, Matrix, Matrix]:
    """Return R, p and J of the task's frame, in the axes of its reference."""
    R, p = chain.poses[-1]
    if task.reference == "world":
        return R, p, chain.jacobian
    robot = chain.robot
    name = robot.model.frames[robot.frame_id(None if task.reference == "tool" else task.reference)].name
    if name == chain.frame:
        return chain.still[0], R.T @ p, chain.jacobian_at(len(chain.joints) - 1)
    J = chain.jacobian
    A = replace(chain_to(robot, name), base=chain).poses[-1][0].T
    return A @ R, A @ p, np.vstack([A @ J[:3], A @ J[3:]])


def _selection(task: FrameTask) -> Matrix:
    """Return S of a task whose rows do not depend on the pose.

    Raises:
        FormulaError: S depends on it.
    """
    poses = [pin.SE3.Random() for _ in range(2)]
    first, second = (task.S(T.translation, T.rotation) for T in poses)
    if not np.array_equal(first, second) or not np.isin(first, (-1, 0, 1)).all():
        raise FormulaError("formulas are written for tasks whose rows are rows of the frame's velocity")
    return first.astype(int)


def _combined(row: Array, J: Matrix) -> Matrix:
    """Return row @ J for a row of −1, 0 and 1."""
    parts = [J[i] if sign > 0 else -J[i] for i, sign in enumerate(row) if sign]
    return np.asarray(sum(parts[1:], start=parts[0]))


def _expressions(M: Matrix, groups: Groups) -> Matrix:
    found = np.empty(M.shape, dtype=object)
    for index, entry in np.ndenumerate(M):
        found[index] = written(entry, groups)
    return found


def _plain(value: Any) -> Array:
    return value.homogeneous if isinstance(value, pin.SE3) else np.asarray(value)
