"""The steps of iterative inverse kinematics: (J, e) → Δq."""

import numpy as np

from robotics1.inputs import Array
from robotics1.singularities.spaces import pseudoinverse


def newton_step(J: Array, e: Array) -> Array:
    """Return Δq = J⁻¹ e, for a square regular J."""
    return np.linalg.solve(J, e)


def pseudoinverse_step(J: Array, e: Array) -> Array:
    """Return Δq = J⁺ e: the shortest of the Δq that leave the least |e − J Δq|."""
    return pseudoinverse(J) @ e


def gradient_step(J: Array, e: Array, gain: float | None = None) -> Array:
    """Return Δq = α Jᵀ e, down the gradient of ½ eᵀe.

    Without a gain, α = |Jᵀe|² / |J Jᵀe|² minimises the error to first order along the gradient (Cauchy's step).
    """
    g = J.T @ e
    if gain is None:
        size = np.hypot.reduce(g)
        slope = np.hypot.reduce(J @ (g / size)) if size > 0 else 0.0  # of a unit vector, whose squares do not overflow
        gain = float(1 / slope) ** 2 if slope > 0 else 0.0
    return gain * g


def damped_step(J: Array, e: Array, damping: float) -> Array:
    """Return Δq = Jᵀ (J Jᵀ + λ² 1)⁻¹ e, which minimises |e − J Δq|² + λ² |Δq|².

    Source: Nakamura, Hanafusa, J. Dyn. Sys. Meas. Control 108, 1986; Wampler, IEEE Trans. SMC 16, 1986.
    """
    return np.asarray(J.T @ np.linalg.solve(J @ J.T + damping**2 * np.eye(len(e)), e))
