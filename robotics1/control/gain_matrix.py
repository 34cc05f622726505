"""Gain matrices, as they are handed in."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, moderate, real_array, real_number

SYMMETRIC = 1e-12  # relative: what differs less is equal


def gain_matrix(name: str, value: npt.ArrayLike, m: int, *, symmetric: bool = False) -> Array:
    """Return a positive definite matrix (m, m): eᵀ K e > 0 for every e ≠ 0.

    Args:
        name: what an error calls it.
        value: one number for all, (m,) the diagonal, or (m, m).
        m: how many errors there are.
        symmetric: whether it must be symmetric too.

    Raises:
        InputError: it has another shape, or is not positive definite, or not symmetric; the message has the smallest
            eigenvalue of its symmetric part.
    """
    given = dimensions(name, value)
    K: Array
    if given == 0:
        K = real_number(name, value) * np.eye(m)
    elif given == 1:
        K = np.diag(real_array(name, value, (m,), "one gain for each error"))
    else:
        K = real_array(name, value, (m, m), "a gain matrix")
    moderate(name, K)
    least = float(np.linalg.eigvalsh(0.5 * (K + K.T)).min(initial=np.inf))
    if not least > 0:
        raise InputError(
            f"{name} must be positive definite, so that eᵀ {name} e > 0 and the error decays; the smallest eigenvalue "
            f"of its symmetric part is {least:g}"
        )
    if symmetric and not np.allclose(K, K.T, rtol=SYMMETRIC, atol=0):
        raise InputError(f"{name} of a law of second order must be symmetric; it is {K.tolist()}")
    return K


def is_diagonal(K: Array) -> bool:
    """Whether a matrix is diagonal."""
    return not np.any(K - np.diag(np.diag(K)))


def written_gain(K: Array) -> str:
    """Return a gain as it is written: 4, diag(4, 9), or its rows."""
    d = [f"{x:g}" for x in np.diag(K)]
    if not is_diagonal(K):
        rows: Any = ["[" + ", ".join(f"{x:g}" for x in row) + "]" for row in K]
        return "[" + ", ".join(rows) + "]"
    return d[0] if len(set(d)) == 1 else f"diag({', '.join(d)})"
