"""Unit quaternions, the scalar first."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of, real_number
from robotics1.orientation.elementary import cross_matrix
from robotics1.orientation.expressions import Matrix, as_matrix, expressions
from robotics1.orientation.nearest import PRINTED, SINGULAR, NearestRotation, rotation_of
from robotics1.orientation.rates import AXES, Axes
from robotics1.results import Frozen


def quaternion_to_rotation(quaternion: Any) -> Matrix:
    """Return R = (η² − εᵀε) 1 + 2 ε εᵀ + 2 η [ε]×, (3, 3), of a unit quaternion (η, ε).

    Args:
        quaternion: (4,) scalar first: η = cos(θ/2), ε = sin(θ/2) r. Numbers may miss the length 1 by 1e-3, as printed
            ones do, and are divided by theirs; SymPy expressions or names are taken to be of length 1.

    Raises:
        InputError: it has not four entries, or its length is not 1.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.6.
    """
    Q = unit_quaternion(quaternion)
    eta, epsilon = Q[0], Q[1:]
    one = np.eye(3, dtype=int)
    return as_matrix(
        (eta**2 - epsilon @ epsilon) * one + 2 * np.outer(epsilon, epsilon) + 2 * eta * cross_matrix(epsilon)
    )


def quaternion_rate_map(quaternion: Any, *, reference: Axes = "world") -> Matrix:
    """Return E(Q), (4, 3), with Q̇ = E ω: η̇ = −½ εᵀω and ε̇ = ½ (η 1 − [ε]×) ω; of ω in the body's axes ½ (η 1 + [ε]×).

    Its columns have the length ½ and are normal to Q and to each other, whatever Q: unlike the rates of three angles,
    those of a quaternion are never singular. Conversely ω = 4 Eᵀ Q̇.

    Args:
        quaternion: (4,) scalar first, as in `quaternion_to_rotation`.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: it has not four entries, or its length is not 1.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.3.
    """
    one_of("reference", reference, AXES)
    half = unit_quaternion(quaternion) / 2
    turned = -cross_matrix(half[1:]) if reference == "world" else cross_matrix(half[1:])
    return as_matrix(np.vstack([-half[1:], half[0] * np.eye(3, dtype=int) + turned]))


def unit_quaternion(quaternion: Any) -> Array:
    """Return Q (4,): numbers divided by their length, if that is 1 to within 1e-3, expressions as they are.

    Raises:
        InputError: it has not four entries, or its length is not 1.
    """
    Q = expressions("quaternion", quaternion, (4,), "(η, ε), the scalar first")
    if Q.dtype != object:
        length = math.hypot(*Q)
        if abs(length - 1) > PRINTED:
            raise InputError(f"quaternion must have length 1 to within {PRINTED:.0e}; its length is {length:.4g}")
        Q = Q / length
    return Q


@dataclass(frozen=True, eq=False)
class UnitQuaternions(Frozen):
    """The two unit quaternions of a rotation.

    Attributes:
        solutions: (2, 4) Q = (η, ε) and −Q, the scalar first. The first has η > 0; of half a turn, where η = 0, the
            first entry of its ε that is not zero is positive.
        correction: the largest change of an entry that made a rotation of the given matrix.
    """

    solutions: Array
    correction: float


def rotation_to_quaternion(R: npt.ArrayLike, *, tolerance: float = PRINTED) -> UnitQuaternions:
    """Return both unit quaternions (η, ε), scalar first, of a rotation: η = cos(θ/2), ε = sin(θ/2) r, and −Q.

    Args:
        R: (3, 3), a rotation; one printed with four digits is projected on the nearest.
        tolerance: the largest correction of an entry of R that is accepted.

    Raises:
        InputError: R is no rotation.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.6.
    """
    near = rotation_of("R", R, real_number("tolerance", tolerance, non_negative=True))
    Q = quaternion_of(near)
    return UnitQuaternions(np.stack([Q, -Q + 0.0]), near.correction)


def quaternion_of(near: NearestRotation) -> Array:
    """Return Q (4,) with η ≥ 0; an η or |ε| is zero where rounding leaves no more of it."""
    from scipy.spatial.transform import Rotation

    Q = np.roll(Rotation.from_matrix(near.rotation).as_quat(), 1)
    if abs(Q[0]) <= near.resolution:
        Q[0] = 0.0
    if np.linalg.norm(Q[1:]) <= near.resolution:
        Q[1:] = 0.0
    Q /= np.linalg.norm(Q)
    leading = Q[np.abs(Q) > (SINGULAR if Q[0] == 0 else 0.0)][0]  # not the sign of what rounding leaves of a zero
    return np.asarray(Q * np.sign(leading) + 0.0)
