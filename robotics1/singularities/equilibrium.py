"""A robot at rest under loads: the torques that hold it, the wrenches that need none, the largest force it exerts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, joint_rates, positive_bound, real_array
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.notation import enumeration, vector
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.rounding import (
    AtPrintedConfiguration,
    RoundedConfiguration,
    singularity_within_rounding,
)
from robotics1.singularities.spaces import echelon
from robotics1.singularities.statics import GRAVITY, Load, Payload, gravity_vector, loads_of, own_weight
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.pose import PoseTask
from robotics1.tasks.rows import unitless_factors, unitless_rows


@dataclass(frozen=True, eq=False)
class StaticTorques(Frozen):
    """The torques that hold a robot at rest, and what they are made of.

    Attributes:
        torque: (n,) what the motors give [N m, or N of a prismatic joint].
        of_links: (n,) for the weight of the links.
        of_payloads: (p, n) for each weight that is carried.
        of_loads: (k, n) for each force and moment.
        limits: (n,) the effort limits.
        joint_names: of the robot.
    """

    torque: Array
    of_links: Array
    of_payloads: Array
    of_loads: Array
    limits: Array
    joint_names: tuple[str, ...]

    @property
    def within_limits(self) -> npt.NDArray[np.bool_]:
        """(n,) whether each motor can give its torque."""
        return np.asarray(np.abs(self.torque) <= self.limits)

    def explain(self) -> str:
        """Return the torques, and what exceeds a limit, in sentences."""
        text = f"τ = {vector(self.torque)} for {enumeration(self.joint_names)}"
        over = [
            f"{name} needs {value:.6g}, more than its limit {limit:g}"
            for name, value, limit, ok in zip(
                self.joint_names, self.torque, self.limits, self.within_limits, strict=True
            )
            if not ok
        ]
        return "; ".join([text, *over])


def static_torques(
    robot: RobotLike,
    q: ConfigurationLike,
    loads: Load | Sequence[Load] = (),
    *,
    payloads: Payload | Sequence[Payload] = (),
    gravity: Any = GRAVITY,
) -> StaticTorques:
    """Return the torques that hold a robot at rest: τ = g(q) − Σ Jᵢᵀ (fᵢ, mᵢ) − Σ Jₖᵀ mₖ g₀.

    g(q) is for the weight of the links, by the inertias of the robot's file; a robot of a DH table has none. Each force
    acts at a point of any link, in any axes. The sign is that of `balancing_torque`: the environment applies the loads.

    Args:
        robot: of revolute and prismatic joints.
        q: (nq,) configuration [rad or m].
        loads: forces and moments on links.
        payloads: masses that links carry.
        gravity: g₀ in the world, (3,) [m/s²]; (0, -9.81, 0) of an arm in a vertical plane xy.

    Raises:
        InputError: q has the wrong shape, or a load, a payload or gravity is none.
        UnknownNameError: a load's frame or reference is none of the robot's.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, sections 3.8 and 7.1.
    """
    robot = robot_from(robot)
    x, g0 = robot.configuration(q), gravity_vector(gravity)
    forces, masses = loads_of(loads, Load, "loads"), loads_of(payloads, Payload, "payloads")
    links = own_weight(robot, x, g0)
    of_payloads = -np.array([mass.torque(robot, x, g0) for mass in masses]).reshape(len(masses), robot.nv)
    of_loads = -np.array([load.torque(robot, x) for load in forces]).reshape(len(forces), robot.nv)
    torque = links + of_payloads.sum(axis=0) + of_loads.sum(axis=0)
    return StaticTorques(torque, links, of_payloads, of_loads, np.array(robot.max_effort), robot.joint_names)


@dataclass(frozen=True, eq=False)
class FreeWrenches(AtPrintedConfiguration):
    """The wrenches on a link that need no torque: its bearings hold them.

    Attributes:
        wrenches: (6, k) a basis of them, (f, m) at the point, orthonormal with 1 N and 1 N m alike.
        rounded: q with the digits it is given by.
    """

    wrenches: Array
    rounded: RoundedConfiguration

    @property
    def at_singularity(self) -> Array:
        """(6, k) a basis at the singular configuration that the digits may stand for; without one, `wrenches`."""
        there = self.rounded.at_singularity
        return self.wrenches if there is None else there.left_null

    def explain(self) -> str:
        """Return the wrenches, with simple numbers, in sentences."""
        parts = [_named(self.wrenches)]
        if self.rounded.singular_q is not None:
            parts += [self.rounded.explain(), f"there, {_named(self.at_singularity)}"]
        return "; ".join(parts)


def wrenches_without_torque(
    robot: RobotLike,
    q: ConfigurationLike,
    *,
    frame: str | None = None,
    point: npt.ArrayLike = (0, 0, 0),
    reference: str = "world",
) -> FreeWrenches:
    """Return the wrenches (f, m) on a link with Jᵀ (f, m) = 0, which need no torque: N(Jᵀ) of its Jacobian.

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m].
        frame: the link; by default the tool's.
        point: (3,) where the force acts and about which the moment is, in the axes of the link [m].
        reference: the axes of f and m: "world", "tool", or the name of a frame.

    Raises:
        InputError: q or the point has the wrong shape.
        UnknownNameError: there is no such frame or reference.
    """
    robot = robot_from(robot)
    c = real_array("point", point, (3,), "in the axes of the link [m]")
    rounded = singularity_within_rounding(robot, PoseTask(frame=frame, reference=reference, point=tuple(c)), q)
    return FreeWrenches(rounded.spaces.left_null, rounded)


def _named(basis: Array) -> str:
    columns = [f"({vector(w[:3])}, {vector(w[3:])})" for w in echelon(basis).T]
    return f"no torque is needed for (f, m) along {enumeration(columns)}" if columns else "every wrench needs a torque"


@dataclass(frozen=True, eq=False)
class LargestForce(AtPrintedConfiguration):
    """The largest force along a direction that motors within their bounds exert.

    Attributes:
        magnitude: λ; ∞ where the force needs no torque.
        force: (m,) λ u/|u|; the direction alone where λ is ∞.
        torque: (n,) what the motors give then.
        joints: the joints that are at their bounds.
        rounded: q with the digits it is given by.
    """

    magnitude: float
    force: Array
    torque: Array
    joints: tuple[str, ...]
    rounded: RoundedConfiguration

    def explain(self) -> str:
        """Return the force and what bounds it, in sentences."""
        if not self.joints:
            parts = ["the force needs no torque: it has no bound"]
        else:
            parts = [
                f"at most {self.magnitude:.6g}, bounded by {enumeration(self.joints)}, with τ = {vector(self.torque)}"
            ]
        if self.rounded.singular_q is not None:
            parts.append(self.rounded.explain())
        return "; ".join(parts)


def largest_force(
    robot: RobotLike,
    task: TaskLike,
    q: ConfigurationLike,
    direction: npt.ArrayLike,
    *,
    torque: npt.ArrayLike | None = None,
    held: npt.ArrayLike = 0.0,
) -> LargestForce:
    """Return the largest λ for which the tool exerts λ u/|u| on the environment: |h + λ Jᵀ u/|u||ᵢ ≤ Tᵢ of each motor.

    Args:
        robot: the robot.
        task: the force is conjugate to its rows.
        q: (nq,) configuration [rad or m].
        direction: u (m,), of any length.
        torque: T > 0 [N m or N], (n,) or one number for all; by default the robot's effort limits.
        held: h (n,), what the motors give beside, as `static_torques(...).torque` for the weight.

    Raises:
        InputError: u has no direction, a joint has no bound, or h alone is beyond a bound.
        TaskError: the task does not fit the robot, or nothing moves it.

    Source: Chiu, Task compatibility of manipulator postures, Int. J. Robotics Research 7, 1988.
    """
    robot, task = robot_and_task(robot, task)
    if robot.nv == 0:
        raise TaskError("no joint moves the task, so that no motor exerts a force")
    limits = np.array(robot.max_effort) if torque is None else positive_bound("torque", torque, robot.nv)
    h = joint_rates("held", held, robot.nv)
    u = real_array("direction", direction, (task.rows,), "one number for each row of the task")
    length = float(np.linalg.norm(u))
    if length == 0:
        raise InputError("direction must have a direction; it is the zero vector")
    if not np.isfinite(limits).any():
        raise InputError("no joint has a bound on its torque: give torque=..., one number for all or one a joint")
    if (np.abs(h) > limits).any():
        joint = robot.joint_names[int(np.argmax(np.abs(h) - limits))]
        raise InputError(f"what is held alone is beyond the bound of {joint}: {vector(np.abs(h))} and {vector(limits)}")
    rounded = singularity_within_rounding(robot, task, q)
    needed = rounded.spaces.J.T @ u / length
    rows, scale = unitless_rows(robot, task), unitless_factors(robot, task)
    size = np.linalg.norm(scale * rounded.spaces.J) * np.linalg.norm(u / length / rows)
    counts = np.abs(needed) * scale[0] / rows[0] > RANK_TOLERANCE * size
    if not (counts & np.isfinite(limits)).any():
        return LargestForce(np.inf, u / length, h, (), rounded)
    room = np.full(robot.nv, np.inf)
    room[counts] = (limits[counts] - np.sign(needed[counts]) * h[counts]) / np.abs(needed[counts])
    magnitude = float(room.min())
    active = tuple(np.array(robot.joint_names)[room <= magnitude * (1 + RANK_TOLERANCE)].tolist())
    return LargestForce(magnitude, magnitude * u / length, h + magnitude * needed, active, rounded)
