"""The Jacobians of a task at many configurations with NumPy alone: what serves where Numba cannot be imported."""

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays


def task_jacobians(chain: ChainArrays, S: Array, q: Array) -> Array:
    """Return S J_frame, (m, n, N), at the configurations q (n, N).

    Args:
        chain: the constants of the chain.
        S: (m, 6) the rows of the task.
        q: (n, N) configurations, one a column.
    """
    n, count = q.shape
    T = np.repeat(chain.placements[0][:, :, None], count, axis=2)
    axes, points = [], []
    for P, prismatic, motion in zip(chain.placements[1:], chain.prismatic, _motions(chain, q), strict=True):
        axes.append(T[:, 2].copy())
        points.append(T[:, 3].copy())
        if prismatic:
            T[:, 3] += motion * T[:, 2]
        else:
            c, s = np.cos(motion), np.sin(motion)
            T[:, 0], T[:, 1] = c * T[:, 0] + s * T[:, 1], c * T[:, 1] - s * T[:, 0]
        p = T[:, 3]
        T = np.einsum("ijc,jk->ikc", T[:, :3], P)
        T[:, 3] += p
    J = np.zeros((6, n, count))
    for joint, (z, o) in enumerate(zip(axes, points, strict=True)):
        column, factor = chain.coordinate[joint], chain.ratio[joint]
        if chain.prismatic[joint]:
            J[:3, column] += factor * z
        else:
            J[:3, column] += factor * np.cross(z, T[:, 3] - o, axis=0)
            J[3:, column] += factor * z
    return np.asarray(np.einsum("ir,rjc->ijc", S, J))


def _motions(chain: ChainArrays, q: Array) -> Array:
    """Return the motion of each joint, (k, N)."""
    return np.asarray(chain.ratio[:, None] * q[chain.coordinate])
