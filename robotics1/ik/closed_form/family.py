"""The formulas of all solutions: a result that explains itself and can be written as source."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np
import sympy

from robotics1.caching import cached_property
from robotics1.ik.closed_form.in_the_target import InTheTarget
from robotics1.ik.closed_form.one_unknown import JointFormula
from robotics1.ik.closed_form.source import c_source, latex_source, matlab_source, python_source
from robotics1.ik.closed_form.words import sentences
from robotics1.inputs import Array
from robotics1.results import Frozen, Listed
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

LONG = 80  # operations of a condition that is not expanded
CONSISTENT = 1e-5  # [m or rad] of a target that joints have
SHORT = 3  # joints, up to which a formula in the target alone is simplified where it is put together


class SingularTarget(NamedTuple):
    """Targets at which there are more or fewer solutions than elsewhere.

    Attributes:
        condition: on the target.
        joint: the joint that is free there, or whose two values are one.
        is_free: whether the joint is free.
    """

    condition: Any
    joint: str
    is_free: bool


@dataclass(frozen=True, eq=False)
class IKBranch(Frozen):
    """One solution.

    Attributes:
        names: of the joints, in the order in which they are found.
        symbols: q1, q2, ... of these joints.
        steps: the formula of each, in the target's symbols and in the joints before it.
        conditions: when the formula of each is real.
        sign: joint → 1 or −1, which of its two formulas is taken; of the joints that have two.
    """

    names: tuple[str, ...]
    symbols: tuple[sympy.Symbol, ...]
    steps: tuple[sympy.Expr, ...]
    conditions: tuple[Any, ...]
    sign: dict[str, int]

    @cached_property
    def q(self) -> dict[str, sympy.Expr]:
        """Joint → its formula in the target's symbols and the lengths alone [rad or m]; angles count modulo 2π."""
        return {name: self._values[symbol] for name, symbol in zip(self.names, self.symbols, strict=True)}

    @cached_property
    def exists_if(self) -> Any:
        """The condition on the target, in its symbols and the lengths."""
        return sympy.And(*(self.in_the_target(condition) for condition in self.conditions))

    def in_the_target(self, e: Any) -> Any:
        """Return an expression or a condition with the formulas for the joints in it."""
        if len(self.symbols) <= SHORT:
            return self._in_the_target(e)
        with sympy.evaluate(False):
            return e.xreplace(self._values)

    @cached_property
    def _in_the_target(self) -> InTheTarget:
        return InTheTarget(dict(zip(self.symbols, self.steps, strict=True)))

    @cached_property
    def _values(self) -> dict[sympy.Symbol, sympy.Expr]:
        values: dict[sympy.Symbol, sympy.Expr] = {}
        for symbol, step in zip(self.symbols, self.steps, strict=True):
            with sympy.evaluate(len(self.symbols) <= SHORT):
                values[symbol] = step.xreplace(values)
        return values


@dataclass(frozen=True, eq=False)
class IKFormulas(Listed[IKBranch]):
    """The formulas of every solution of f(q) = r_d, each compared with Pinocchio.

    Attributes:
        robot, task: of what.
        target: the symbols of r_d, such as x, y, z, phi, r11, r12, ...
        places: where each stands in the flat value of the task, and with which sign.
        names: of the joints, in the order in which they are found.
        joints: their formulas.
        constraints: what must vanish of a target that has more rows than there are joints.
        free_joints: the joints that do not move the task.
        branches: the solutions.
    """

    entries_in = "branches"

    robot: Robot
    task: Task
    target: tuple[sympy.Symbol, ...]
    places: tuple[tuple[int, int], ...]
    names: tuple[str, ...]
    joints: tuple[JointFormula, ...]
    constraints: tuple[sympy.Expr, ...]
    free_joints: tuple[str, ...]

    def _repr_latex_(self) -> str:
        return f"$${self.latex()}$$"

    @cached_property
    def branches(self) -> tuple[IKBranch, ...]:
        """The solutions: one for each choice of signs."""
        choices = product(*(range(len(joint.options)) for joint in self.joints))
        return tuple(map(self._branch, choices))

    @cached_property
    def singular_if(self) -> tuple[SingularTarget, ...]:
        """The targets at which joints are free or two solutions are one, and these joints.

        Of more than three joints the conditions are those of each joint, in the target and in the joints before it.
        """
        found: dict[tuple[str, str, bool], SingularTarget] = {}
        for branch in self.branches:
            for name, joint in zip(self.names, self.joints, strict=True):
                for found_of, is_free in ((joint.free_if, True), (joint.double_if, False)):
                    is_short = len(self.joints) <= SHORT
                    condition = _short(branch.in_the_target(found_of)) if is_short else found_of
                    if condition.free_symbols - self.constants:
                        case = SingularTarget(condition, name, is_free)
                        found.setdefault((str(condition), name, is_free), case)
        return tuple(found.values())

    @property
    def in_order(self) -> dict[str, sympy.Symbol]:
        """Joint → its symbol, in the order of the robot's q."""
        symbols = {name: joint.q for name, joint in zip(self.names, self.joints, strict=True)}
        return {name: symbols[name] for name in self.robot.joint_names if name in symbols}

    @property
    def parameters(self) -> dict[str, float]:
        """The robot's named lengths and angles."""
        return dict(self.robot.parameters)

    def at(self, target: Any) -> Array:
        """Return the solutions of a target in numbers, (k, nq), the joints of `free_joints` at zero.

        There are none of a target that is more than 1e-5 [m or rad] from what the arm can have; where the task has more
        rows than joints, forward kinematics decides.

        Raises:
            InputError: the target has the wrong form.
        """
        target = self.task.target(target)
        found = self.function()(self.numbers(target))
        q = np.zeros((len(found), self.robot.nq))
        q[:, [self.robot.joint_names.index(name) for name in self.in_order]] = found
        if len(self.joints) < self.task.rows:
            errors = [np.abs(self.task.error(self.robot, p, target)).max() for p in q]
            q = q[np.array(errors) <= CONSISTENT] if len(q) else q
        return q

    def numbers(self, target: Any) -> list[float]:
        """Return the numbers of the symbols of `target`, of one in the form of the task's value."""
        flat = np.asarray(getattr(target, "homogeneous", target), dtype=float).ravel()
        return [sign * flat[n] for n, sign in self.places]

    def function(self) -> Callable[..., Any]:
        """Return the function that `python` writes."""
        scope: dict[str, Any] = {}
        exec(compile(self.python("inverse"), "<inverse formulas>", "exec"), scope)
        return scope["inverse"]  # type: ignore[no-any-return]

    def explain(self) -> str:
        """Return the formulas with their conditions, the singular targets and the free joints, in sentences."""
        return sentences(self)

    def python(self, name: str = "inverse_kinematics") -> str:
        """Return the source of a function of the target's numbers that returns the solutions, (k, n), with NumPy.

        The joints are those of `in_order`; lengths are arguments by keyword.
        """
        return python_source(self, name)

    def latex(self) -> str:
        """Return the formulas in LaTeX, one line for each joint."""
        return latex_source(self)

    def c(self, name: str = "inverse_kinematics") -> str:
        """Return the source of a function in C (C99) that writes the solutions and returns their number."""
        return c_source(self, name)

    def matlab(self, name: str = "inverse_kinematics") -> str:
        """Return the source of a function in MATLAB, which GNU Octave reads too, that returns the solutions (k, n)."""
        return matlab_source(self, name)

    @property
    def constants(self) -> set[sympy.Symbol]:
        """The symbols of the robot's named lengths and angles."""
        return {sympy.Symbol(name, real=True) for name in self.robot.parameters}

    def _branch(self, choice: tuple[int, ...]) -> IKBranch:
        signs = {
            name: 1 - 2 * n
            for name, joint, n in zip(self.names, self.joints, choice, strict=True)
            if len(joint.options) > 1
        }
        return IKBranch(
            self.names,
            tuple(joint.q for joint in self.joints),
            tuple(joint.options[n] for joint, n in zip(self.joints, choice, strict=True)),
            (*(sympy.Eq(e, 0) for e in self.constraints), *(joint.exists_if for joint in self.joints)),
            signs,
        )


def _short(condition: Any) -> Any:
    """Return a condition e = 0 without powers and numbers in front; expanded where that is no longer."""
    if isinstance(condition, sympy.And):
        return sympy.And(*map(_short, condition.args))
    if not isinstance(condition, sympy.Eq) or condition.rhs != 0 or condition.count_ops() > LONG:
        return condition
    expanded = sympy.factor_terms(sympy.expand(condition.lhs))
    _, e = min(expanded, condition.lhs, key=sympy.count_ops).as_coeff_Mul()
    while e.is_Pow and e.exp.is_positive:
        _, e = e.base.as_coeff_Mul()
    return sympy.Eq(e, 0)
