"""Whether the digits of a velocity and of a configuration leave open that the velocity is in the range of J."""

from collections.abc import Callable

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE, least_distance_in_box


def realised_within_digits(
    normal: Array,
    asked: tuple[Array, Array],
    outside: Array,
    made: Callable[[Array], Array],
    configuration: tuple[Array, Array],
) -> bool:
    """Return whether a velocity and a configuration that round to the given ones have no part outside the range of J.

    If q is off by δ, then J(q + δ) q̇ is in the range of the true Jacobian. So N, the basis of N(Jᵀ), must satisfy
    Nᵀ(r + ε − ∂(J q̇)/∂q δ) = 0, r being what J(q) q̇ lacks, with |ε| and |δ| of half a unit of the last digits at most.

    Args:
        normal: (m, m − r) N.
        asked: ṙ as given, any number of entries, and (m,) half a unit of the last digits of those of r.
        outside: (m,) the part of it, less the drift, outside the range.
        made: q → J(q) q̇ with the inputs of the answer, and for accelerations J̇ q̇ with it.
        configuration: (nq,) q, and half a unit of the last digit of each joint; 0 where it is exact.
    """
    (given, half_units), (q, q_half_units) = asked, configuration
    here, steps = made(q), np.diag(q_half_units)[q_half_units > 0]
    by_joints = [normal.T @ (made(q + step) - here) for step in steps]
    moves = np.column_stack([normal.T * half_units, *by_joints])
    return least_distance_in_box(moves, normal.T @ outside) <= RANK_TOLERANCE * float(np.linalg.norm(given))
