"""Kinematic control laws: joint and Cartesian, of first and second order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.control.decay import ErrorDecay
from robotics1.control.error_axes import ErrorAxes
from robotics1.control.gain_matrix import written_gain
from robotics1.curves.curve import Curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, real_number
from robotics1.kinematics import velocity_of_joints
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.trajectories.following.resolution import Resolution, Wish, resolved

DOT, DOTS = {"q": "q̇", "r": "ṙ"}, {"q": "q̈", "r": "r̈"}


@dataclass(frozen=True, eq=False)
class ControlCommand(Frozen):
    """What a law commands at one state.

    Attributes:
        joints: (n,) q̇ [rad/s or m/s] of a law of first order, q̈ of second.
        error: (m,) e = r_d − r.
        error_in_axes: (m,) e in the law's axes, Aᵀ e.
        error_rate: (m,) ė = ṙ_d − J q̇, with the q̇ that is given, or commanded.
        asked: (m,) ṙ or r̈ that the joints shall make.
        residual: (m,) what of it they do not make.
    """

    joints: Array
    error: Array
    error_in_axes: Array
    error_rate: Array
    asked: Array
    residual: Array


@dataclass(frozen=True, eq=False)
class ControlLaw(Frozen):
    """A feedback law; `joint_law` and `cartesian_law` make it.

    With the error in the axes A, e' = Aᵀ(r_d − r), a law of first order makes ė' = −K e', one of second order
    ë' = −D ė' − K e', where what it asks of the joints is in the range of J. The gradient law makes the error smaller,
    but with no such equation.

    Attributes:
        robot: the robot.
        task: r = f(q); of a joint law r = q.
        target: r_d at rest, in the form of the task's value; None where there is a motion.
        motion: r_d(t).
        K, D: (m, m) gains; D is None for a law of first order.
        axes: A(t).
        method: "newton" or "gradient".
        feedforward: whether ṙ_d, or r̈_d, is part of it.
        resolution: which inverse of J.
        null_motion: q̇₀ or q̈₀ in the null space.
        of_joints: whether it is a joint law.
    """

    robot: Robot
    task: Task
    target: Any
    motion: Curve | None
    K: Array
    D: Array | None
    axes: ErrorAxes
    method: str
    feedforward: bool
    resolution: Resolution
    null_motion: Wish
    of_joints: bool

    @property
    def order(self) -> int:
        """1 where it commands q̇, 2 where it commands q̈."""
        return 1 if self.D is None else 2

    def error(self, t: float, q: npt.ArrayLike) -> Array:
        """Return e = r_d(t) − f(q), (m,)."""
        return self.task.error(self.robot, q, self.target if self.motion is None else self.motion(t))

    def command(
        self, q: npt.ArrayLike, qdot: npt.ArrayLike | None = None, *, t: float = 0.0, side: Side = "right"
    ) -> ControlCommand:
        """Return what the law commands at a state.

        Args:
            q: (nq,) configuration [rad or m].
            qdot: (nv,) q̇ [rad/s or m/s], for a law of second order.
            t: the instant of the trajectory [s].
            side: at a breakpoint of the trajectory.

        Raises:
            InputError: a shape is wrong, or q̇ is missing or too much.
        """
        q, t = self.robot.configuration(q), real_number("t", t)
        e, A = self.error(t, q), self.axes.at(t, side)
        inside = A.A.T @ e
        ahead = [self._ahead(t, order, side) for order in (1, 2)]
        J = self.task.jacobian(self.robot, q)
        if self.D is None:
            if qdot is not None:
                raise InputError("a law of first order commands q̇ itself: leave out qdot")
            asked = self.feedforward * ahead[0] + A.A @ (self.K @ inside) + A.A @ A.rate.T @ e
            x = self._velocity(q, asked, J)
            return ControlCommand(x, e, inside, ahead[0] - J @ x, asked, asked - J @ x)
        if qdot is None:
            raise InputError("a law of second order needs q̇ too: command(q, qdot)")
        v = velocity_of_joints(self.robot, "qdot", qdot)
        e_rate = ahead[0] - J @ v
        rate_inside = A.rate.T @ e + A.A.T @ e_rate
        feedback = self.D @ rate_inside + self.K @ inside + 2 * A.rate.T @ e_rate + A.acceleration.T @ e
        asked = self.feedforward * ahead[1] + A.A @ feedback
        rates = resolved(self.robot, self.task, self.resolution, q, asked, self.null_motion, u=v)
        return ControlCommand(rates.joints, e, inside, e_rate, asked, asked - rates.realised)

    def decay(self, q0: npt.ArrayLike, qdot0: npt.ArrayLike | None = None) -> ErrorDecay:
        """Return the error in the law's axes as a function of time, from the start at t = 0.

        It holds as long as what is asked of the joints is in the range of J and within their limits.

        Args:
            q0: (nq,) [rad or m].
            qdot0: (nv,) [rad/s or m/s], for a law of second order.

        Raises:
            TaskError: the law has no linear error equation: a gradient law, one without feedforward along a motion,
                or a task whose error is no difference of numbers.
            InputError: a shape is wrong.
        """
        if self.method == "gradient" or (self.motion is not None and not self.feedforward):
            raise TaskError("only a Newton law with feedforward has a linear error equation; simulate_law shows others")
        if np.shape(self.task.value(self.robot, q0)) != (self.task.rows,):
            raise TaskError("the error of a pose is no difference of numbers; use angles=, or simulate_law")
        start = self.command(q0, qdot0)
        A = self.axes.at(0.0)
        rate = None if self.D is None else A.rate.T @ start.error + A.A.T @ start.error_rate
        return ErrorDecay(self.K, self.D, start.error_in_axes, rate)

    def formula(self) -> str:
        """Return the law as it is written, such as "q̇ = J⁻¹(q) (ṙ_d + K (r_d − f(q))), K = diag(4, 9)"."""
        x = "q" if self.of_joints else "r"
        r = "q" if self.of_joints else "f(q)"
        K, D = ("A K Aᵀ", "A D Aᵀ") if self._is_turned else ("K", "D")
        e = f"({x}_d − {r})"
        values = f"K = {written_gain(self.K)}" + ("" if self.D is None else f", D = {written_gain(self.D)}")
        if self.method == "gradient":
            return f"q̇ = Jᵀ(q) {K} {e}, {values}"
        moving = self.motion is not None
        rate = "q̇" if self.of_joints else "J(q) q̇"
        if self.D is None:
            ahead = f"{DOT[x]}_d + " if moving and self.feedforward else ""
            turning = f" + A Ȧᵀ {e}" if self.axes.fixed is None else ""
            inner = f"{ahead}{K} {e}{turning}"
        else:
            ahead = f"{DOTS[x]}_d + " if moving and self.feedforward else ""
            damping = f"{D} ({DOT[x]}_d − {rate})" if moving else f"− {D} {rate}"
            turning = " + terms of Ȧ, Ä" if self.axes.fixed is None else ""
            drift = "" if self.of_joints else " − J̇(q) q̇"
            inner = f"{ahead}{damping} + {K} {e}{turning}{drift}"
        left = "q̇" if self.D is None else "q̈"
        if self.of_joints:
            return f"{left} = {inner}, {values}"
        square = self.task.rows == self.robot.nv and self.resolution.damping == 0
        inverse = "J⁻¹(q)" if square else "J⁺(q)" if self.resolution.weights is None else "J#(q)"
        null = "" if self.null_motion is None else f" + (1 − J⁺J) {left}₀"
        return f"{left} = {inverse} ({inner}){null}, {values}"

    def explain(self) -> str:
        """Return the law, and the equation of its error."""
        if self.method == "gradient":
            return f"{self.formula()}; V = ½ eᵀ K e has V̇ = −|Jᵀ K e|²"
        error = "ė = −K e" if self.D is None else "ë = −D ė − K e"
        where = ", e = Aᵀ(r_d − r)" if self._is_turned else ""
        return f"{self.formula()}; {error}{where}"

    @property
    def _is_turned(self) -> bool:
        """Whether the axes are others than those of the world."""
        return self.axes.fixed is None or not np.array_equal(self.axes.fixed, np.eye(self.axes.m))

    def _ahead(self, t: float, order: int, side: Side) -> Array:
        if self.motion is None:
            return np.zeros(self.task.rows)
        return np.asarray(self.motion.derivative(t, order, side=side))

    def _velocity(self, q: Array, asked: Array, J: Array) -> Array:
        if self.method == "gradient":
            return np.asarray(J.T @ asked)
        return resolved(self.robot, self.task, self.resolution, q, asked, self.null_motion).joints
