"""The matrices of Denavit and Hartenberg as the books print them; imports nothing of ours."""

import numpy as np
from hypothesis import strategies as st


def standard_matrix(a, alpha, d, theta):
    """A_i of Siciliano et al., section 2.8.2."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])


def modified_matrix(a, alpha, d, theta):
    """The matrix of Craig, section 3.6, with a_{i−1} and α_{i−1}."""
    c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -s, 0, a], [s * ca, c * ca, -sa, -sa * d], [s * sa, c * sa, ca, ca * d], [0, 0, 0, 1]])


def dh_pose(rows, q, convention="standard", base=None, tool=None):
    """T_base A_1(q_1) ⋯ A_n(q_n) T_tool."""
    matrix = {"standard": standard_matrix, "modified": modified_matrix}[convention]
    T = np.eye(4) if base is None else np.array(base, dtype=float)
    for (kind, a, alpha, d, theta), q_i in zip(rows, q, strict=True):
        T = T @ (matrix(a, alpha, d, theta + q_i) if kind == "R" else matrix(a, alpha, d + q_i, theta))
    return T if tool is None else T @ np.array(tool, dtype=float)


def rotation(yaw, pitch, roll):
    """R_z(yaw) R_y(pitch) R_x(roll)."""
    about_z, about_x = standard_matrix(0, 0, 0, yaw), standard_matrix(0, roll, 0, 0)
    c, s = np.cos(pitch), np.sin(pitch)
    return (about_z[:3, :3] @ [[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ about_x[:3, :3]


def homogeneous(R, p):
    return np.block([[np.array(R), np.reshape(p, (3, 1))], [np.zeros((1, 3)), np.ones((1, 1))]])


# Axes in general position, and every degenerate one: parallel, antiparallel, intersecting, coincident, perpendicular.
RIGHT = (0.0, np.pi / 2, -np.pi / 2, np.pi)
angles = st.sampled_from(RIGHT) | st.sampled_from(RIGHT) | st.floats(-3.1, 3.1).map(lambda x: round(x, 2))
offsets = st.just(0.0) | st.floats(-1.5, 1.5).map(lambda x: round(x, 3))
dh_rows = st.lists(st.tuples(st.sampled_from("RRRP"), offsets, angles, offsets, angles), min_size=1, max_size=8)
placements = st.none() | st.builds(homogeneous, st.builds(rotation, angles, angles, angles), st.tuples(*[offsets] * 3))
conventions = st.sampled_from(["standard", "modified"])
seeds = st.integers(0, 2**32 - 1)
