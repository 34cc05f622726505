"""Helpers of the tests: differences, angles, spans, singular values."""

import numpy as np

STEP = 5e-4  # of fourth-order central differences: truncation about 2e-15 f⁽⁵⁾, rounding about 5e-13 f


def along(f, q, qdot):
    """df(q)/dt while q moves with q̇, by central differences of fourth order."""
    q, d = np.asarray(q, dtype=float), STEP * np.asarray(qdot)
    return (8 * (np.asarray(f(q + d)) - f(q - d)) - (np.asarray(f(q + 2 * d)) - f(q - 2 * d))) / (12 * STEP)


def derivative(f, q):
    """∂f/∂q of a vector-valued f, (m, n)."""
    return np.array([along(f, q, d) for d in np.eye(len(q))]).T


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


def key(values):
    """The constant joint values of a branch, as something to sort and compare."""
    return tuple(sorted((name, round(value, 9)) for name, value in values.items()))


def unitless(robot, task, q):
    """The task's Jacobian, lengths in units of the reach."""
    rows = [1 / robot.reach if unit == "m" else 1.0 for unit in task.row_units]
    columns = np.where(robot.revolute, 1.0, robot.reach)
    return np.array(rows)[:, None] * task.jacobian(robot, q) * columns


def sigma(task, robot, q):
    """σ_ρ/σ₁ of the task's Jacobian, the last singular value over the first, lengths in units of the reach."""
    values = np.linalg.svd(unitless(robot, task, q), compute_uv=False)
    return values[-1] / values[0]
