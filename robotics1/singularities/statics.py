"""Forces and joint torques: the transpose of the Jacobian."""

from __future__ import annotations

import numpy.typing as npt

from robotics1.inputs import Array, real_array


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
