"""A control law in simulation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.angles import angles_of_an_iteration
from robotics1.control.law import ControlLaw
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, positive_bound, real_number
from robotics1.kinematics import velocity_of_joints
from robotics1.results import Frozen
from robotics1.trajectories.following.integration import RUNAWAY, integrated, runaway

PRECISION = 1e-9
MOST_STEPS = 1_000_000  # of a sampled law


@dataclass(frozen=True, eq=False)
class ControlRun(Frozen):
    """A simulated run of a law.

    Attributes:
        t: (k,) times [s]; they end early where the joints run away.
        q: (k, n) [rad or m].
        qdot: (k, n) [rad/s or m/s].
        command: (k, n) q̇ or q̈ that was commanded, after saturation.
        error: (k, m) e = r_d − r.
        error_in_axes: (k, m) e in the law's axes.
        saturated: (n,) whether a joint's command was cut at its limit.
        complete: whether the end was reached.
    """

    t: Array
    q: Array
    qdot: Array
    command: Array
    error: Array
    error_in_axes: Array
    saturated: npt.NDArray[np.bool_]
    complete: bool

    @property
    def final_error(self) -> float:
        """|e| at the end."""
        return float(np.linalg.norm(self.error[-1]))

    def explain(self) -> str:
        """Return how the error ends, and which joints saturate, in a sentence."""
        cut = [str(i + 1) for i in np.flatnonzero(self.saturated)]
        limits = f"; joint {', '.join(cut)} saturates" if cut else ""
        early = "" if self.complete else "; the joints ran away there"
        return f"|e| = {self.final_error:.6g} at t = {self.t[-1]:.6g} s{limits}{early}"


def simulate_law(
    law: ControlLaw,
    q0: npt.ArrayLike,
    qdot0: npt.ArrayLike | None = None,
    *,
    duration: float | None = None,
    limits: npt.ArrayLike | None = None,
    samples: int = 201,
    step: float | None = None,
) -> ControlRun:
    """Integrate a law from a start, with its command cut at limits; or with its command held for each step.

    Args:
        law: `joint_law(...)` or `cartesian_law(...)`.
        q0: (n,) where the joints start [rad or m].
        qdot0: (n,) q̇(0) [rad/s or m/s], for a law of second order; None for rest.
        duration: [s], for a target at rest; a motion has its own.
        limits: (n,) largest |q̇| of a law of first order, |q̈| of second, or one number; None for no limits.
        samples: the number of times that are returned.
        step: h > 0 [s], the sampling time: the command of the times 0, h, 2h, ... is held in between, and these times
            are returned; None for a law in continuous time.

    Raises:
        InputError: it is no law, a shape is wrong, or a duration is missing.
    """
    if not isinstance(law, ControlLaw):
        raise InputError(f"law must be joint_law(...) or cartesian_law(...); it is {law!r}")
    robot, n = law.robot, law.robot.nv
    q0 = robot.configuration(q0, "q0")
    if law.order == 1 and qdot0 is not None:
        raise InputError("a law of first order commands q̇ itself: leave out qdot0")
    start = q0 if law.order == 1 else np.concatenate([q0, _at_rest(law, qdot0)])
    ends = _ends(law, duration)
    bound = np.full(n, np.inf) if limits is None else positive_bound("command", limits, n)

    def command(t: float, x: Array, side: Side) -> Array:
        return law.command(x[:n], x[n:] if law.order == 2 else None, t=t, side=side).joints

    def rate(t: float, x: Array, side: Side) -> Array:
        u = np.clip(command(t, x, side), -bound, bound)
        return u if law.order == 1 else np.concatenate([x[n:], u])

    if step is not None:
        times, states, complete = _held(lambda t, x: rate(t, x, "right")[-n:], law, start, ends[-1], step)
        return _run(law, times, states, bound, complete=complete)

    solution = integrated(
        rate,
        ends,
        start,
        method="DOP853",
        rtol=PRECISION,
        atol=PRECISION * np.tile(robot.units, law.order),
        max_step=(ends[-1] - ends[0]) / 20,
        fastest=runaway(robot, ends[-1]),
        most_steps=5000,
    )
    times, states = solution.sampled(np.linspace(0.0, ends[-1], counting_number("samples", samples, least=2)))
    return _run(law, times, states, bound, complete=solution.end >= ends[-1])


@angles_of_an_iteration()
def _held(
    command: Callable[[float, Array], Array], law: ControlLaw, start: Array, end: float, step: float
) -> tuple[Array, Array, bool]:
    """Return the times 0, h, 2h, ... up to the end, the states there, and whether the joints did not run away."""
    h, n = real_number("step", step, positive=True), law.robot.nv
    if end / h > MOST_STEPS:
        raise InputError(f"step must leave {MOST_STEPS} steps at most; {end:g} s in steps of {h:g} s are more")
    times = h * np.arange(int(end / h * (1 + PRECISION)) + 1)
    states = [start]
    for t in times[:-1]:
        x = states[-1]
        u = command(float(t), x)
        moved = x + h * u if law.order == 1 else np.concatenate([x[:n] + h * x[n:] + h * h / 2 * u, x[n:] + h * u])
        if not (np.abs(moved[:n]) < RUNAWAY * law.robot.units).all():
            break
        states.append(moved)
    return times[: len(states)], np.array(states), len(states) == len(times)


@angles_of_an_iteration()
def _run(law: ControlLaw, times: Array, states: Array, bound: Array, *, complete: bool) -> ControlRun:
    n = law.robot.nv
    found = [
        law.command(x[:n], x[n:] if law.order == 2 else None, t=float(t)) for t, x in zip(times, states, strict=True)
    ]
    asked = np.array([command.joints for command in found])
    cut = np.clip(asked, -bound, bound)
    return ControlRun(
        times,
        states[:, :n],
        cut if law.order == 1 else states[:, n:],
        cut,
        np.array([command.error for command in found]),
        np.array([command.error_in_axes for command in found]),
        (np.abs(asked) > bound).any(axis=0),
        complete,
    )


def _at_rest(law: ControlLaw, qdot0: npt.ArrayLike | None) -> Array:
    return np.zeros(law.robot.nv) if qdot0 is None else velocity_of_joints(law.robot, "qdot0", qdot0)


def _ends(law: ControlLaw, duration: float | None) -> list[float]:
    """Return the times between which the law is smooth.

    Raises:
        InputError: a target at rest has no duration, or a motion is given another.
    """
    if law.motion is None:
        if duration is None:
            raise InputError("a target at rest has no end: give duration=")
        return [0.0, real_number("duration", duration, positive=True)]
    if duration is not None:
        raise InputError(f"the motion lasts {law.motion.end:g} s: leave out duration=")
    return list(law.motion.ends)
