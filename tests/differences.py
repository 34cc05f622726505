"""Helpers of the tests: differences, angles, spans."""

import numpy as np

STEP = 1e-5  # of fourth-order central differences: truncation about 1e-20, rounding about 1e-11


def derivative(f, q):
    """∂f/∂q of a vector-valued f, (m, n), by central differences of fourth order."""
    q = np.asarray(q, dtype=float)

    def along(d):
        return (8 * (np.asarray(f(q + d)) - f(q - d)) - (np.asarray(f(q + 2 * d)) - f(q - 2 * d))) / (12 * STEP)

    return np.array([along(d) for d in STEP * np.eye(len(q))]).T


def twist(T_of_q, q):
    """The Jacobian of a pose, (6, n): ∂p/∂q over the vectors ω_i of (∂R/∂q_i) Rᵀ = [ω_i]×; T as a (4, 4) matrix."""
    columns = []
    R = T_of_q(q)[:3, :3]
    for flat in derivative(lambda x: T_of_q(x).ravel(), q).T:
        dT = flat.reshape(4, 4)
        W = dT[:3, :3] @ R.T
        columns.append([*dT[:3, 3], W[2, 1], W[0, 2], W[1, 0]])
    return np.array(columns).T


def turned(angles):
    """Angles in (−π, π]."""
    return np.pi - (np.pi - np.asarray(angles)) % (2 * np.pi)


def outside(basis, v):
    """The part of v outside the span of orthonormal columns."""
    return v - basis @ (basis.T @ v)


def same_rows(found, wanted, revolute, atol):
    """Assert that two lists of configurations are the same set, whole turns apart being one."""
    found, wanted = np.atleast_2d(found), np.atleast_2d(wanted)
    assert found.shape == wanted.shape
    for q in wanted:
        apart = np.where(revolute, turned(found - q), found - q)
        assert np.abs(apart).max(axis=1).min() <= atol, f"{q} is not among {found}"
