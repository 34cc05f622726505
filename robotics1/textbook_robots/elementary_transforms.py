"""An arm as a chain of elementary transforms: turns about, and shifts along, the axes of the moving frame."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Any

import numpy as np

from robotics1.angles import printed_twelfths_of_pi
from robotics1.curves.symbolic_path import formula_of
from robotics1.dh.entries import Limits, joint_limits
from robotics1.errors import InputError
from robotics1.inputs import by_name
from robotics1.notation import joint_value
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.checking import MOST_DEGREES
from robotics1.robot.findings import LARGEST
from robotics1.robot.joints import Joint, Triple
from robotics1.robot.model import Robot
from robotics1.robot.parameters import HIGHEST_DEGREE, Placements, Polynomial, placement_of, with_values

STEP = re.compile(r"([RT])([xyz])\((.*)\)")
JOINT = re.compile(r"q[1-9]\d*")
MOST_STEPS = 4 * MOST_DEGREES


def robot_from_transforms(
    transforms: Sequence[Any],
    *,
    parameters: Mapping[str, float] | None = None,
    lower: Limits = None,
    upper: Limits = None,
) -> Robot:
    """Return the arm with T_world_tool(q) the product of elementary transforms, each in the axes that have moved.

    Rx, Ry, Rz turn and Tx, Ty, Tz shift. In the brackets stand q1 or −q1, q2, ..., a constant, or the sum of both:

        robot_from_transforms(["Tz(d1)", "Rz(q1)", "Ry(-q2)", "Tx(l2)", "Tx(q3)", "Rx(pi/2)"], parameters={"d1": 0.3})

    A joint that comes again follows the first: "Ry(-q2)" after "Ry(q2)" turns back, as a parallelogram does, and
    "Rz(2*q1)" turns twice as far. An angle printed as 1.5708 is read as π/2, and `robot.warnings` says so. The world
    is `base`, and the last frame `tool`.

    Args:
        transforms: texts such as "Rz(q1 + pi/2)", or pairs such as ("Rz", "q1") or ("Tx", 0.3) [rad, m].
        parameters: the values of the names, which the robot keeps as `robot.parameters`; 1 where there is none.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: a transform, a value or a limit is wrong; the joints do not first come as q1, q2, ...; one comes
            first with another factor than 1 or −1, or both turns and slides.
        UnknownNameError: a parameter is not among the names.

    Source: Corke, A simple and systematic approach to assigning Denavit-Hartenberg parameters, IEEE Trans. Robotics
    23, 2007.
    """
    steps, sentences = _steps(transforms)
    names = list(dict.fromkeys(name for step in steps for name in step.names))
    given = by_name("parameters", parameters, "{'l1': 0.5}")
    known = with_values("the transforms", dict.fromkeys(names, 1.0), given)
    n = _check_order(steps)
    turns = {step.joint: step.turns for step in reversed(steps)}  # of each joint the first step
    low, high = joint_limits(lower, upper, [turns[i] for i in range(1, n + 1)])
    limits = tuple(zip(low.tolist(), high.tolist(), strict=True))
    return TransformChain(steps, limits, sentences, known).robot()


@dataclass(frozen=True)
class Step:
    """A turn about or a shift along an axis, by factor · q + constant.

    Attributes:
        text: as it was written.
        turns: whether it is a turn.
        axis: 0, 1 or 2 of x, y or z.
        joint: the number of q, from 1; 0 without a joint.
        factor: of q.
        constant: a polynomial in the names.
    """

    text: str
    turns: bool
    axis: int
    joint: int
    factor: float
    constant: Polynomial

    @property
    def names(self) -> tuple[str, ...]:
        """The names in the constant."""
        return tuple(dict.fromkeys(name for monomial in self.constant for name in monomial))

    @property
    def numbers(self) -> list[Polynomial]:
        """The placement: x, y, z, roll, pitch, yaw; one of them is not zero."""
        place = self.axis + (3 if self.turns else 0)
        return [self.constant if i == place else {} for i in range(6)]


@dataclass(frozen=True)
class TransformChain:
    """What the robot is made from; `robot_from_transforms` has checked it.

    Attributes:
        steps: the transforms.
        limits: (lower, upper) of each joint.
        warnings: sentences about angles that are read as others.
        parameters: the values of the names.
    """

    steps: tuple[Step, ...]
    limits: tuple[tuple[float, float], ...]
    warnings: tuple[str, ...]
    parameters: Mapping[str, float]

    def robot(self) -> Robot:
        """Return the robot."""
        made = robot_of_joints("transforms", self._joints(), parameters=self.parameters, source=self)
        return replace(made, warnings=self.warnings)

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot with these values of its names; the others stay."""
        return replace(self, parameters=with_values("the transforms", self.parameters, values)).robot()

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints as polynomials in the names."""
        found = {joint.name: placement_of(step.numbers) for joint, step in zip(robot.joints, self.steps, strict=False)}
        return {**found, "tip": placement_of([{}] * 6)}

    def _joints(self) -> list[Joint]:
        """Return a joint for each transform, fixed where it has no q; and the tool."""
        found: list[Joint] = []
        at = "base"
        seen: dict[int, float] = {}  # q → the factor it first comes with
        for i, step in enumerate(self.steps, 1):
            x, y, z, roll, pitch, yaw = placement_of(step.numbers).at(self.parameters).tolist()
            child, kind = f"link{i}", "fixed"
            name, leader, multiplier, axis, limits = f"step{i}", f"step{i}", 1.0, (0.0, 0.0, 1.0), (-np.inf, np.inf)
            if step.joint:
                kind, leader = "revolute" if step.turns else "prismatic", f"q{step.joint}"
                if step.joint in seen:
                    name, multiplier, axis = f"step{i}", step.factor, _axis(step.axis, 1.0)
                else:
                    name, axis, limits = leader, _axis(step.axis, step.factor), self.limits[step.joint - 1]
                    seen[step.joint] = step.factor
            fixed = Joint(name, kind, at, child, (x, y, z), (roll, pitch, yaw), axis, *limits)
            found.append(replace(fixed, leader=leader, multiplier=multiplier))
            at = child
        return [*found, Joint("tip", "fixed", at, "tool")]


def _axis(number: int, sign: float) -> Triple:
    x, y, z = (sign * np.eye(3)[number] + 0.0).tolist()
    return (x, y, z)


def _steps(transforms: Any) -> tuple[tuple[Step, ...], tuple[str, ...]]:
    if isinstance(transforms, str) or not isinstance(transforms, Sequence) or not 0 < len(transforms) <= MOST_STEPS:
        raise InputError(
            f"transforms must be a list such as ['Rz(q1)', 'Tx(l1)'], of at most {MOST_STEPS}; it is {transforms!r}"
        )
    steps, sentences = [], []
    for i, given in enumerate(transforms, 1):
        step, sentence = _step(i, given)
        steps.append(step)
        sentences += [sentence] if sentence else []
    return tuple(steps), tuple(sentences)


def _step(i: int, given: Any) -> tuple[Step, str]:
    """Return a transform, and a sentence if its angle is read as another.

    Raises:
        InputError: it is none.
    """
    import sympy

    kind, argument = _parts(i, given)
    turns, axis = kind[0] == "R", "xyz".index(kind[1])
    expression = formula_of(argument)
    where = f"transform {i}, {kind}({argument})"
    real = {symbol: sympy.Symbol(symbol.name, real=True) for symbol in expression.free_symbols}
    expression = expression.xreplace(real)
    joints = [symbol for symbol in expression.free_symbols if JOINT.fullmatch(symbol.name)]
    if len(joints) > 1:
        raise InputError(f"{where} has {len(joints)} joints; each transform has one at most")
    factor, joint = 0.0, 0
    if joints:
        slope = expression.diff(joints[0])
        if not slope.is_number:
            raise InputError(f"{where} must be a number times {joints[0]}, and a constant")
        factor, joint = float(slope), int(joints[0].name[1:])
        expression = sympy.expand(expression - slope * joints[0])
    constant, sentence = _constant(where, expression, turns=turns)
    return Step(f"{kind}({argument})", turns, axis, joint, factor, constant), sentence


def _parts(i: int, given: Any) -> tuple[str, Any]:
    if isinstance(given, str):
        found = STEP.fullmatch(given.strip())
        if found:
            return found[1] + found[2], found[3]
    elif isinstance(given, Sequence) and len(given) == 2 and re.fullmatch("[RT][xyz]", str(given[0])):
        return str(given[0]), given[1]
    raise InputError(
        f"transform {i} must be Rx, Ry, Rz, Tx, Ty or Tz of something, as 'Rz(q1)' or ('Tx', 0.3): {given!r}"
    )


def _constant(where: str, expression: Any, *, turns: bool) -> tuple[Polynomial, str]:
    """Return a constant as a polynomial in its names, and a sentence if it is an angle that is read as another."""
    import sympy

    symbols = sorted(expression.free_symbols, key=str)
    if not symbols:
        number = float(expression)
        if abs(number) > LARGEST:
            raise InputError(f"{where} is larger than {LARGEST:g}")
        k = printed_twelfths_of_pi(number) if turns else None
        if k is not None:
            return {(): k * pi / 12}, f"{where} is read with {joint_value(k * pi / 12)}"
        return {(): number}, ""
    if not expression.is_polynomial(*symbols) or sympy.Poly(expression, *symbols).total_degree() > HIGHEST_DEGREE:
        raise InputError(f"{where} must be a polynomial of degree {HIGHEST_DEGREE} at most in its names")
    terms = sympy.Poly(expression, *symbols).terms()
    return {
        tuple(s.name for s, power in zip(symbols, powers, strict=True) for _ in range(power)): float(c)
        for powers, c in terms
    }, ""


def _check_order(steps: Sequence[Step]) -> int:
    """Return the number of joints, if they first come as q1, q2, ..., each with the factor 1 or −1.

    Raises:
        InputError: they do not.
    """
    first: dict[int, Step] = {}
    for step in steps:
        if not step.joint:
            continue
        if step.joint not in first:
            if step.joint != len(first) + 1:
                raise InputError(
                    f"the joints must first come in the order q1, q2, ...; {step.text} is the joint after {len(first)}"
                )
            if abs(step.factor) != 1:
                raise InputError(f"{step.text}: a joint first comes as q{step.joint} or -q{step.joint}")
            first[step.joint] = step
        elif step.turns != first[step.joint].turns or step.factor == 0:
            raise InputError(
                f"{step.text}: q{step.joint} cannot both turn and slide; it first comes in {first[step.joint].text}"
            )
    if not first:
        raise InputError("transforms must have a joint, as in 'Rz(q1)'")
    if len(first) > MOST_DEGREES:
        raise InputError(f"an arm has at most {MOST_DEGREES} joints here; there are {len(first)}")
    return len(first)
