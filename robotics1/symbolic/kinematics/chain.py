"""The chain of joints in exact form: the pose of a frame as trigonometric polynomials."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyRing

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.exact import FINE, exact_axis, exact_length, exact_turn
from robotics1.symbolic.kinematics.followers import turns_of_leaders
from robotics1.symbolic.kinematics.parameters import JointNumbers, Monomial, joints_to
from robotics1.symbolic.polynomials.laurent import ROOTS, Frequencies, Laurent, Matrix, gaussian, reduced

Pose = tuple[Matrix, Matrix]  # rotation (3, 3), position (3,)
MOST_JOINTS = 12  # on the way to a frame


@dataclass(frozen=True, eq=False)
class Chain:
    """The joints from the world to a frame, with symbols q1, q2, ... and the robot's named parameters.

    Attributes:
        robot: whose joints these are.
        frame: the link at the end.
        joints: their numbers.
        base: another chain of the robot whose symbols are to be used.
        turns: after how many turns of each joint its followers are back too, here and in chains with this base.
        rational: whether √2 and √3, of turns by π/4 or π/6 and of oblique axes, are left out: turns and axes are then
            rational to 1e-16, and polynomials fall into all their factors.
    """

    robot: Robot
    frame: str
    joints: tuple[JointNumbers, ...]
    base: "Chain | None" = None
    turns: tuple[int, ...] = ()
    rational: bool = False

    @cached_property
    def q(self) -> tuple[sympy.Symbol, ...]:
        """q1, q2, ...: one for each entry of q."""
        return tuple(sympy.symbols(f"q1:{self.robot.nq + 1}", real=True))

    @cached_property
    def frequencies(self) -> Frequencies:
        """The angles: revolute joints, and parameters that are angles; the lengths: all others."""
        if self.base is not None:
            return self.base.frequencies
        used = {name for joint in self.joints for number in joint.rpy for m in number for name in m}
        symbols = {name: sympy.Symbol(name, real=True) for name in self.robot.parameters}
        angles = [q for q, turns in zip(self.q, self.robot.revolute, strict=True) if turns]
        lengths = [q for q, turns in zip(self.q, self.robot.revolute, strict=True) if not turns]
        angles += [symbols[name] for name in symbols if name in used]
        lengths += [symbols[name] for name in symbols if name not in used]
        turns = dict(zip(self.q, self.turns, strict=True))
        return Frequencies(
            tuple(angles),
            PolyRing([*lengths, *map(sympy.Symbol, ROOTS)], QQ_I),
            self.q,
            tuple(turns.get(angle, 1) for angle in angles),
        )

    @cached_property
    def poses(self) -> list[Pose]:
        """The rotation (3, 3) and position (3,) of each joint's frame, before it moves, and of the end."""
        found = []
        pose = self.still
        for placement, motion in self._steps:
            found.append(_product(pose, placement))
            pose = _product(found[-1], motion)
        return [*found, pose]

    def axes_after(self, number: int) -> Matrix:
        """Return the axes (3, 3) of a joint's frame, after it has moved, in the world."""
        R, _ = self.still
        for (placement, _), (motion, _) in self._steps[: number + 1]:
            R = R @ placement @ motion
        return R

    @cached_property
    def still(self) -> Pose:
        """The identity."""
        one, zero = self.frequencies.constant(1), self.frequencies.constant(0)
        R = np.array([[one if i == j else zero for j in range(3)] for i in range(3)], dtype=object)
        return R, np.array([zero] * 3, dtype=object)

    @cached_property
    def _steps(self) -> list[tuple[Pose, Pose]]:
        """The placement of each joint in its parent link, and its motion."""
        return [(self._placement(joint), self._motion(joint)) for joint in self.joints]

    @property
    def motions(self) -> list[Pose]:
        """The motion of each joint."""
        return [motion for _, motion in self._steps]

    def _placement(self, joint: JointNumbers) -> Pose:
        R, _ = self.still
        for axis, number in zip((2, 1, 0), joint.rpy[::-1], strict=True):
            if number:
                R = R @ self._rotation(np.eye(3)[axis], self._turn(joint, number))
        return R, np.array([self._polynomial(number) for number in joint.xyz], dtype=object)

    def _motion(self, joint: JointNumbers) -> Pose:
        R, p = self.still
        if joint.kind == "revolute":
            return self._rotation(joint.axis, self._joint_turn(joint)), p
        if joint.kind == "prismatic":
            return R, self._vector(joint.axis) * self._joint_length(joint)
        return R, p

    def jacobian_at(self, middle: int) -> Matrix:
        """Return J (6, n) in the axes of joint `middle` and for the point of the last link that is at its origin.

        det J is that of the world's axes and the frame's origin, and each column depends only on the joints between
        its own and the middle one, which keeps the determinant of a long arm short.
        """
        zero = self.frequencies.constant(0)
        J = np.array([[zero] * len(self.q) for _ in range(6)], dtype=object)
        for number, joint in enumerate(self.joints):
            if joint.kind == "fixed":
                continue
            R, p = self.relative(middle, number)
            i = self.robot.joint_names.index(joint.leader)
            axis = R @ self._vector(joint.axis)
            rate = self.frequencies.constant(_rational(joint.multiplier))
            if joint.kind == "prismatic":
                J[:3, i] += axis * rate
            else:
                J[:3, i] += cross(p, axis) * rate
                J[3:, i] += axis * rate
        return J

    def relative(self, start: int, end: int) -> Pose:
        """Return the pose of joint `end`, before it moves, in the frame of joint `start`, after it has moved; that
        of the chain's last link for the number after the last joint.
        """
        if end > start:
            steps = [*self._steps, (self.still, self.still)]
            pose = steps[start + 1][0]
            for number in range(start + 1, end):
                pose = _product(_product(pose, steps[number][1]), steps[number + 1][0])
            return pose
        pose = self._steps[start][1]
        for number in range(start, end, -1):
            pose = _product(_product(self._steps[number - 1][1], self._steps[number][0]), pose)
        R, p = pose
        return R.T, -(R.T @ p)

    @cached_property
    def jacobian(self) -> Matrix:
        """J (6, n), linear rows over angular, world axes, at the frame."""
        zero = self.frequencies.constant(0)
        J = np.array([[zero] * len(self.q) for _ in range(6)], dtype=object)
        _, p = self.poses[-1]
        for i, q in enumerate(self.q):
            J[:3, i] = [entry.derivative(q) for entry in p]
        for joint, (R, _) in zip(self.joints, self.poses, strict=False):
            if joint.kind == "revolute":
                i = self.robot.joint_names.index(joint.leader)
                rate = self.frequencies.constant(_rational(joint.multiplier))
                J[3:, i] += R @ self._vector(joint.axis) * rate
        return J

    def _vector(self, axis: Array) -> Matrix:
        return np.array([self.frequencies.constant(n) for n in self._axis(axis)], dtype=object)

    def _axis(self, axis: Array) -> list[Any]:
        """Return the unit axis in the ring."""
        v, square = exact_axis(axis, rational=self.rational)
        root = self.frequencies.root(square)
        return [root * gaussian(value) for value in v]

    def _polynomial(self, number: dict[Monomial, float]) -> Laurent:
        ring = self.frequencies.ring
        total = ring.zero
        for monomial, coefficient in number.items():
            term = ring(gaussian(exact_length(coefficient, self.robot.reach)))
            for name in monomial:
                term *= ring(sympy.Symbol(name, real=True))
            total += term
        return self.frequencies.constant(total)

    def _turn(self, joint: JointNumbers, number: dict[Monomial, float]) -> Laurent:
        """Return exp(i angle) of an angle that is a constant plus whole multiples of parameters."""
        multiples = {m: c for m, c in number.items() if m}
        if any(len(m) > 1 or abs(c - round(c)) > 1e-9 for m, c in multiples.items()):
            raise FormulaError(f"rpy of joint {joint.name!r} is no sum of whole multiples of parameters")
        whole = {sympy.Symbol(m[0], real=True): round(c) for m, c in multiples.items()}
        return self.frequencies.exponential(whole) * self._constant_turn(number.get((), 0.0))

    def _joint_turn(self, joint: JointNumbers) -> Laurent:
        i = self.robot.joint_names.index(joint.leader)
        multiple = round(joint.multiplier * self.frequencies.turns_of(self.q[i]))
        return self.frequencies.exponential({self.q[i]: multiple}) * self._constant_turn(joint.offset)

    def _joint_length(self, joint: JointNumbers) -> Laurent:
        i = self.robot.joint_names.index(joint.leader)
        ring = self.frequencies.ring
        slope, offset = ring(_rational(joint.multiplier)), ring(_rational(joint.offset))
        return self.frequencies.constant(slope * ring(self.q[i]) + offset)

    def _constant_turn(self, angle: float) -> Laurent:
        """Return exp(i angle): exact for multiples of π/12, else a rational point of the circle next to it.

        The point (1 + i t)² / (1 + t²), with t rational next to tan(angle/2), has the length 1, so that rotations
        stay rotations.
        """
        k = exact_turn(angle)
        if k is not None and (k % 6 == 0 or not self.rational):
            return self.frequencies.turn(k)
        angle = angle if k is None else k * np.pi / 12
        t = QQ_I(0, Fraction(np.tan(angle / 2)).limit_denominator(FINE))
        return self.frequencies.constant((1 + t) ** 2 / (1 - t**2))

    def _rotation(self, axis: Array, turn: Laurent) -> Matrix:
        """Return R = n nᵀ + (1 − n nᵀ) cos + [n]× sin, with exp(i angle) = turn."""
        F = self.frequencies
        half, down = F.constant(gaussian(Fraction(1, 2))), F.constant(QQ_I(0, Fraction(-1, 2)))
        cos, sin = (turn + turn.conjugate) * half, (turn - turn.conjugate) * down
        n = self._axis(axis)
        skew = [[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]]
        R = np.empty((3, 3), dtype=object)
        for a in range(3):
            for b in range(3):
                outer = reduced(n[a] * n[b])
                R[a, b] = F.constant(outer) + F.constant((a == b) - outer) * cos + F.constant(skew[a][b]) * sin
        return R


def chain_to(robot: Robot, frame: str, *, beside: str | None = None) -> Chain:
    """Return the chain from the world to a link, in symbols that the joints to the link `beside` can be told in too.

    Raises:
        FormulaError: a joint on the way has several degrees of freedom, there are too many, its numbers depend on the
            parameters in no way that can be told, or it follows another by no fraction of its angle.
    """
    joints = joints_to(robot, frame)
    moving = [joint for joint in joints if joint.kind != "fixed"]
    if len(moving) > MOST_JOINTS:
        raise FormulaError(f"{len(moving)} joints lead to {frame!r}; formulas are written for at most {MOST_JOINTS}")
    if robot.nq != robot.nv:
        raise FormulaError(f"robot {robot.name!r} has joints with several degrees of freedom")
    links = (frame,) if beside is None else (frame, beside)
    return Chain(
        robot,
        frame,
        joints,
        turns=turns_of_leaders(robot, links, [j for link in links for j in joints_to(robot, link)]),
    )


def cross(a: Matrix, b: Matrix) -> Matrix:
    """Return a × b."""
    return np.array([a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))], dtype=object)


def _product(a: Pose, b: Pose) -> Pose:
    """Return the pose T_a T_b."""
    return a[0] @ b[0], a[1] + a[0] @ b[1]


def _rational(value: float) -> Any:
    return gaussian(exact_length(float(value)))
