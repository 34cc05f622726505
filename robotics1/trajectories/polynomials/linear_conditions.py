"""Polynomials from linear conditions: values of derivatives at instants, and continuity where two of them join."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import accumulate
from math import perm

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory

SINGULAR = 1e13  # of the condition number: conditions that do not determine the polynomials


@dataclass(frozen=True)
class Place:
    """The derivative of this order, of this piece, at τ = (t − tᵢ)/Tᵢ."""

    piece: int
    tau: float
    order: int


@dataclass(frozen=True, eq=False)
class Condition:
    """The derivative at a place has a value; or, with another place, the same value as there.

    Attributes:
        place: where.
        value: (n,) of the derivative with respect to t.
        other: the other place.
    """

    place: Place
    value: Array
    other: Place | None = None


def solve_pieces(
    degrees: Sequence[int], durations: Sequence[float], conditions: Sequence[Condition]
) -> tuple[PolynomialTrajectory, ...]:
    """Return the polynomials of these degrees and durations that meet as many conditions as they have coefficients.

    The conditions are linear in the coefficients: Σₖ k!/(k − r)! τᵏ⁻ʳ cₖ/Tʳ is the derivative of order r.

    Raises:
        InputError: the conditions are too many, too few, or contradict or repeat one another.
    """
    starts = [0, *accumulate(degree + 1 for degree in degrees)]
    if len(conditions) != starts[-1]:
        raise InputError(
            f"polynomials of the degrees {', '.join(map(str, degrees))} have {starts[-1]} coefficients for each joint; "
            f"they need as many conditions, not {len(conditions)}"
        )
    unit = float(np.mean(durations))
    A = np.zeros((len(conditions), starts[-1]))
    for row, condition in zip(A, conditions, strict=True):
        for place, sign in ((condition.place, 1), (condition.other, -1)):
            if place is not None:
                i, r = place.piece, place.order
                terms = [perm(k, r) * place.tau ** max(k - r, 0) for k in range(degrees[i] + 1)]
                row[starts[i] : starts[i + 1]] += sign * np.array(terms) * (unit / durations[i]) ** r
    b = np.array([condition.value * unit**condition.place.order for condition in conditions])
    if np.linalg.cond(A) > SINGULAR:
        raise InputError("the conditions contradict or repeat one another: they do not determine the polynomials")
    c = np.linalg.solve(A, b)
    return tuple(PolynomialTrajectory(c[starts[i] : starts[i + 1]], float(T)) for i, T in enumerate(durations))
