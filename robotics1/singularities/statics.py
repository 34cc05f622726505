"""Forces and joint torques of a robot at rest: the transpose of the Jacobian, and what loads the links."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number
from robotics1.kinematics import frame_jacobian
from robotics1.results import Frozen
from robotics1.robot.model import Robot

GRAVITY = (0.0, 0.0, -9.81)  # m/s²


def balancing_torque(J: npt.ArrayLike, f: npt.ArrayLike) -> Array:
    """Return τ = −Jᵀ f, (n,): what the motors hold against a force that the environment applies to the tool.

    The sign makes the sum of the generalized forces zero: τ + Jᵀ f = 0. Forces in N(Jᵀ) need no torque.

    Args:
        J: (m, n) Jacobian of the task.
        f: (m,) force conjugate to the task's velocity [N, or N m on angular rows].

    Raises:
        InputError: f has not one entry for each row of J.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.8.
    """
    return -exerting_torque(J, f)


def exerting_torque(J: npt.ArrayLike, f: npt.ArrayLike) -> Array:
    """Return τ = Jᵀ f, (n,): what the motors give so that the tool exerts the force f on the environment.

    Arguments and errors are those of `balancing_torque`; here f acts on the environment.
    """
    J = real_array("J", J, (None, None), "a matrix")
    return J.T @ real_array("f", f, (J.shape[0],), "one number for each row of J")


@dataclass(frozen=True, eq=False)
class Load(Frozen):
    """A force and a moment that the environment applies to a link at rest.

    Attributes:
        force: (3,) f [N].
        moment: (3,) m, about the point [N m].
        frame: the link; None for the tool.
        point: (3,) where the force acts, in the axes of the link, from its origin [m].
        reference: the axes in which force and moment are written: "world", "tool", or the name of a frame.
    """

    force: Any = (0.0, 0.0, 0.0)
    moment: Any = (0.0, 0.0, 0.0)
    frame: str | None = None
    point: Any = (0.0, 0.0, 0.0)
    reference: str = "world"

    def __post_init__(self) -> None:
        """Check the vectors, and copy them.

        Raises:
            InputError: one is no vector of three numbers.
        """
        meanings = {"force": "[N]", "moment": "[N m]", "point": "in the axes of the link [m]"}
        for name, meaning in meanings.items():
            vars(self)[name] = real_array(name, getattr(self, name), (3,), meaning)
        super().__post_init__()

    def torque(self, robot: Robot, q: Array) -> Array:
        """Return Jᵀ (f, m), (n,): what the load does to the joints."""
        J = frame_jacobian(robot, q, frame=self.frame, point=self.point, reference=self.reference)
        return np.asarray(J.T @ np.r_[self.force, self.moment])


@dataclass(frozen=True, eq=False)
class Payload(Frozen):
    """A mass that a link carries.

    Attributes:
        mass: [kg].
        centre: (3,) its centre of mass, in the axes of the link, from its origin [m].
        frame: the link; None for the tool.
    """

    mass: float
    centre: Any = (0.0, 0.0, 0.0)
    frame: str | None = None

    def __post_init__(self) -> None:
        """Check mass and centre.

        Raises:
            InputError: the mass is negative, or the centre is no vector of three numbers.
        """
        vars(self)["mass"] = real_number("mass", self.mass, non_negative=True)
        vars(self)["centre"] = real_array("centre", self.centre, (3,), "in the axes of the link [m]")
        super().__post_init__()

    def torque(self, robot: Robot, q: Array, gravity: Array) -> Array:
        """Return Jᵀ (m g₀), (n,): what the weight does to the joints."""
        return Load(self.mass * gravity, frame=self.frame, point=self.centre).torque(robot, q)


def gravity_vector(value: Any) -> Array:
    """Return g₀, (3,) [m/s²].

    Raises:
        InputError: it is no vector of three numbers.
    """
    return real_array("gravity", value, (3,), "in the world [m/s²], as (0, 0, -9.81)")


def own_weight(robot: Robot, q: Array, gravity: Array) -> Array:
    """Return g(q) = ∂U/∂q, (n,): what the motors hold against the weight of the links, from their inertias.

    Raises:
        InputError: a joint has several degrees of freedom.
    """
    robot.require_single_coordinates("have a gravity torque here")
    model = pin.Model(robot.own_model)
    model.gravity = pin.Motion(gravity, np.zeros(3))
    return np.array(pin.computeGeneralizedGravity(model, model.createData(), q))


def loads_of(value: Any, kind: type, name: str) -> tuple[Any, ...]:
    """Return one or several loads, or payloads, as a tuple.

    Raises:
        InputError: one is none.
    """
    listed = (value,) if isinstance(value, kind) else value
    try:
        found = tuple(listed)
    except TypeError:
        found = (listed,)
    for one in found:
        if not isinstance(one, kind):
            raise InputError(f"{name} must be {kind.__name__}(...), or a list of them; it has {one!r}")
    return found
