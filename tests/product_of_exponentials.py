"""A product of exponentials with 4×4 matrices; it imports nothing of ours. Twists are (v, ω)."""

import numpy as np
from scipy.linalg import expm


def bracket(twist):
    """[V] (4, 4) of V = (v, ω)."""
    (vx, vy, vz), (x, y, z) = twist[:3], twist[3:]
    return np.array([[0, -z, y, vx], [z, 0, -x, vy], [-y, x, 0, vz], [0, 0, 0, 0.0]])


def Ad(T):
    """Ad_T (6, 6) for (v, ω): v + p × ω over ω, both turned by R."""
    R, p = T[:3, :3], T[:3, 3]
    P = np.array([[0, -p[2], p[1]], [p[2], 0, -p[0]], [-p[1], p[0], 0]])
    return np.block([[R, P @ R], [np.zeros((3, 3)), R]])


def pose(M, screws, q):
    """e^([S₁] q₁) ⋯ e^([Sₙ] qₙ) M."""
    T = np.eye(4)
    for S, angle in zip(screws, q, strict=True):
        T = T @ expm(bracket(S) * angle)
    return T @ M


def space_jacobian(screws, q):
    """Column i is Ad of the exponentials before it times S_i, (6, n)."""
    T, columns = np.eye(4), []
    for S, angle in zip(screws, q, strict=True):
        columns.append(Ad(T) @ S)
        T = T @ expm(bracket(S) * angle)
    return np.array(columns).T


def body_jacobian(M, screws, q):
    """Ad of T⁻¹ times the space Jacobian, (6, n)."""
    return Ad(np.linalg.inv(pose(M, screws, q))) @ space_jacobian(screws, q)
