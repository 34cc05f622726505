"""How large a quadratic function is at most on a cube."""

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array

SWEEPS = 6


def largest_on_cube(g: Array, H: Array, active: npt.NDArray[np.bool_]) -> Array:
    """Return numbers (k,) that g·x + xᵀH x/2 does not exceed for |xᵢ| ≤ 1.

    With λ the largest eigenvalue of H, or 0, the function is at most g·x − xᵀN x/2 + λ n/2, with N = λI − H positive
    semidefinite. That is concave, so that it is below each of its tangents; the one is taken at which a few steps along
    the coordinates end.

    Args:
        g: (k, n).
        H: (k, n, n).
        active: (k, n) where a row of g and H is not zero.
    """
    k, n = g.shape
    top = np.maximum(np.linalg.eigvalsh(H)[:, -1], 0.0)
    N = top[:, None, None] * np.eye(n) - H
    y, slope = np.zeros((k, n)), g.copy()
    for _ in range(SWEEPS):
        for i in range(n):
            curve = N[:, i, i]
            with np.errstate(divide="ignore", invalid="ignore"):
                free = y[:, i] + slope[:, i] / curve
            end = np.where(curve > 1e-300, np.clip(np.nan_to_num(free), -1, 1), np.sign(slope[:, i]))
            slope -= N[:, :, i] * (end - y[:, i])[:, None]
            y[:, i] = end
    at_y = np.einsum("ki,ki->k", g + slope, y) / 2
    rise = (np.abs(slope) - slope * y).sum(axis=1)
    return np.asarray(at_y + rise + 0.5 * top * active.sum(axis=1))
