"""The chain of joints in exact form: the pose of a frame as trigonometric polynomials."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyRing

from robotics1.angles import twelfths_of_pi
from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.kinematics import frame_jacobian
from robotics1.robot.box import MOST_TURNS, fraction_of, turns_of_followers
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Placement, Polynomial
from robotics1.symbolic.kinematics.exact import FINE, exact_axis, exact_length
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, Matrix, TrigPolynomial, TrigRing, gaussian, reduced
from robotics1.symbolic.writing.sums_of_angles import Groups

Pose = tuple[Matrix, Matrix]  # rotation (3, 3), position (3,)
MOST_JOINTS = 12  # on the way to a frame
PARALLEL = 1e-9  # |ω × ω'| of unit axes that counts as none


@dataclass(frozen=True, eq=False)
class Chain:
    """The joints from the world to a frame, with symbols q1, q2, ... and the robot's named parameters.

    Attributes:
        robot: whose joints these are.
        frame: the link at the end.
        joints: these joints.
        turns: after how many turns of each joint its followers are back too.
        rational: whether √2 and √3, of turns by π/4 or π/6 and of oblique axes, are left out: turns and axes are then
            rational to 1e-16, and polynomials fall into all their factors.
    """

    robot: Robot
    frame: str
    joints: tuple[Joint, ...]
    turns: tuple[int, ...] = ()
    rational: bool = False

    @cached_property
    def q(self) -> tuple[sympy.Symbol, ...]:
        """q1, q2, ...: one for each entry of q."""
        return tuple(sympy.symbols(f"q1:{self.robot.nq + 1}", real=True))

    @cached_property
    def trig_ring(self) -> TrigRing:
        """The angles: revolute joints, and parameters that are angles; the lengths: all others."""
        angular = [number for joint in self.joints for number in placement_formula(self.robot, joint).rpy]
        used = {name for number in angular for m in number for name in m}
        symbols = {name: sympy.Symbol(name, real=True) for name in self.robot.parameters}
        angles = [q for q, turns in zip(self.q, self.robot.revolute, strict=True) if turns]
        lengths = [q for q, turns in zip(self.q, self.robot.revolute, strict=True) if not turns]
        angles += [symbols[name] for name in symbols if name in used]
        lengths += [symbols[name] for name in symbols if name not in used]
        turns = dict(zip(self.q, self.turns, strict=True))
        return TrigRing(
            tuple(angles),
            PolyRing([*lengths, *map(sympy.Symbol, ROOTS)], QQ_I),
            self.q,
            tuple(turns.get(angle, 1) for angle in angles),
        )

    @cached_property
    def groups(self) -> Groups:
        """The places of the angles that are added up, as in cos(q2 + q3): of consecutive joints with parallel axes."""
        robot = self.robot
        own = [robot.joint_names.index(joint.leader) for joint in self.joints if joint.kind == "revolute"]
        columns = [i for i in dict.fromkeys(own) if robot.revolute[i]]
        places = {i: self.trig_ring.angles.index(self.q[i]) for i in columns}
        rng = np.random.default_rng(0)
        axes = [frame_jacobian(robot, rng.uniform(-2, 2, robot.nq), frame=self.frame)[3:] for _ in range(2)]
        groups: list[list[int]] = []
        for before, i in zip([None, *columns], columns, strict=False):
            if before is not None and all(np.linalg.norm(np.cross(w[:, before], w[:, i])) < PARALLEL for w in axes):
                groups[-1].append(places[i])
            else:
                groups.append([places[i]])
        rest = [[j] for j in range(len(self.trig_ring.angles)) if j not in places.values()]
        return tuple(map(tuple, groups + rest))

    @cached_property
    def still(self) -> Pose:
        """The identity."""
        one, zero = self.trig_ring.constant(1), self.trig_ring.constant(0)
        R = np.array([[one if i == j else zero for j in range(3)] for i in range(3)], dtype=object)
        return R, np.array([zero] * 3, dtype=object)

    def step(self, joint: Joint) -> Pose:
        """Return the pose of the link behind a joint in the link before it."""
        (R, p), (turn, slide) = self.placement(joint), self.motion(joint)
        return R @ turn, p + R @ slide

    def turn(self, joints: Sequence[Joint]) -> Matrix:
        """Return the rotation (3, 3) from the first link of consecutive joints to the last."""
        R, _ = self.still
        for joint in joints:
            R = R @ self.step(joint)[0]
        return R

    def velocity(self, joint: Joint) -> Matrix:
        """Return the velocity (3,) of a joint per unit of its coordinate, in the link before it: of the turn, or of the
        slide.
        """
        axis, rate = self._vector(np.array(joint.axis)), self.trig_ring.constant(_rational(joint.multiplier))
        return np.asarray(self.placement(joint)[0] @ axis * rate)

    def placement(self, joint: Joint) -> Pose:
        """Return the placement of a joint in the link before it."""
        numbers = placement_formula(self.robot, joint)
        R, _ = self.still
        for axis, number in zip((2, 1, 0), numbers.rpy[::-1], strict=True):
            if number:
                R = R @ self._rotation(np.eye(3)[axis], self._turn(joint, number))
        return R, np.array([self._polynomial(number) for number in numbers.xyz], dtype=object)

    def motion(self, joint: Joint) -> Pose:
        """Return the motion of a joint, about or along its axis."""
        R, p = self.still
        if joint.kind == "fixed":
            return R, p
        F, axis = self.trig_ring, np.array(joint.axis)
        q = self.q[self.robot.joint_names.index(joint.leader)]
        if joint.kind == "revolute":
            turn = F.exponential({q: round(joint.multiplier * F.turns_of(q))})
            return self._rotation(axis, turn * self._constant_turn(joint.offset)), p
        slope, offset = F.ring(_rational(joint.multiplier)), F.ring(_rational(joint.offset))
        return R, self._vector(axis) * F.constant(slope * F.ring(q) + offset)

    def _vector(self, axis: Array) -> Matrix:
        return np.array([self.trig_ring.constant(n) for n in self._axis(axis)], dtype=object)

    def _axis(self, axis: Array) -> list[Any]:
        """Return the unit axis in the ring."""
        v, square = exact_axis(axis, rational=self.rational)
        root = self.trig_ring.root(square)
        return [root * gaussian(value) for value in v]

    def _polynomial(self, number: Polynomial) -> TrigPolynomial:
        ring = self.trig_ring.ring
        total = ring.zero
        for monomial, coefficient in number.items():
            term = ring(gaussian(exact_length(coefficient, self.robot.reach)))
            for name in monomial:
                term *= ring(sympy.Symbol(name, real=True))
            total += term
        return self.trig_ring.constant(total)

    def _turn(self, joint: Joint, number: Polynomial) -> TrigPolynomial:
        """Return exp(i angle) of an angle that is a constant plus whole multiples of parameters."""
        multiples = {m: c for m, c in number.items() if m}
        if any(len(m) > 1 or abs(c - round(c)) > 1e-9 for m, c in multiples.items()):
            raise FormulaError(f"rpy of joint {joint.name!r} is no sum of whole multiples of parameters")
        whole = {sympy.Symbol(m[0], real=True): round(c) for m, c in multiples.items()}
        return self.trig_ring.exponential(whole) * self._constant_turn(number.get((), 0.0))

    def _constant_turn(self, angle: float) -> TrigPolynomial:
        """Return exp(i angle): exact for multiples of π/12, else a rational point of the circle next to it.

        The point (1 + i t)² / (1 + t²), with t rational next to tan(angle/2), has the length 1, so that rotations
        stay rotations.
        """
        k = twelfths_of_pi(angle)
        if k is not None and (k % 6 == 0 or not self.rational):
            return self.trig_ring.turn(k)
        angle = angle if k is None else k * np.pi / 12
        t = QQ_I(0, Fraction(np.tan(angle / 2)).limit_denominator(FINE))
        return self.trig_ring.constant((1 + t) ** 2 / (1 - t**2))

    def _rotation(self, axis: Array, turn: TrigPolynomial) -> Matrix:
        """Return R = n nᵀ + (1 − n nᵀ) cos + [n]× sin, with exp(i angle) = turn."""
        F = self.trig_ring
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
    """Return the chain from the world to a link, with symbols also for the joints to the link `beside`.

    Raises:
        FormulaError: a joint on the way has several degrees of freedom, there are too many, its numbers depend on the
            parameters in no way that can be found, or it follows another by no fraction of its angle.
    """
    joints = robot.joints_to(frame)
    moving = [joint for joint in joints if joint.kind != "fixed"]
    if len(moving) > MOST_JOINTS:
        raise FormulaError(f"{len(moving)} joints lead to {frame!r}; formulas are written for at most {MOST_JOINTS}")
    if robot.nq != robot.nv:
        raise FormulaError(f"robot {robot.name!r} has joints with several degrees of freedom")
    links = (frame,) if beside is None else (frame, beside)
    every = [joint for link in links for joint in robot.joints_to(link)]
    for joint in every:
        placement_formula(robot, joint)
    return Chain(robot, frame, joints, turns=_turns_of_leaders(robot, links, every))


def placement_formula(robot: Robot, joint: Joint) -> Placement:
    """Return the placement of a joint as polynomials in the parameters.

    Raises:
        FormulaError: there are none.
    """
    found = robot.placements[joint.name]
    if isinstance(found, str):
        raise FormulaError(found)
    return found


def _turns_of_leaders(robot: Robot, links: Sequence[str], joints: Sequence[Joint]) -> tuple[int, ...]:
    """Return after how many turns of each joint, (nq,), its followers on the ways to the links are back too.

    Raises:
        FormulaError: one of the joints follows in another way, or there are more than 12 turns.
    """
    for joint in joints:
        if joint.kind != "fixed":
            _check_follower(joint, turns=bool(robot.revolute[robot.joint_names.index(joint.leader)]))
    turns = turns_of_followers(robot, links)
    for name, number in zip(robot.joint_names, turns, strict=True):
        if not np.isfinite(number):
            raise FormulaError(f"the joints that follow {name!r} are not back together after {MOST_TURNS} turns of it")
    return tuple(map(int, turns))


def _check_follower(joint: Joint, *, turns: bool) -> None:
    """Refuse what has no formula: `turns` says whether the leader does."""
    if joint.kind == "prismatic" and turns:
        raise FormulaError(f"joint {joint.name!r} slides by {joint.multiplier:g} times the angle of {joint.leader!r}")
    if joint.kind == "revolute" and not turns:
        raise FormulaError(f"joint {joint.name!r} turns by {joint.multiplier:g} times the length of {joint.leader!r}")
    if joint.kind == "revolute" and fraction_of(joint.multiplier) is None:
        raise FormulaError(
            f"joint {joint.name!r} turns by {joint.multiplier:.15g} times the angle of {joint.leader!r}, which is no "
            f"fraction with a denominator up to {MOST_TURNS}, to twelve digits; formulas are written for those"
        )


def cross(a: Matrix, b: Matrix) -> Matrix:
    """Return a × b."""
    return np.array([a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))], dtype=object)


def _rational(value: float) -> Any:
    return gaussian(exact_length(float(value)))
