"""The joint axes of a chain as lines in space, at many configurations at once."""

from typing import NamedTuple

import numpy as np

from robotics1.ik.joint_chain import FixedChain
from robotics1.ik.subproblems import motions
from robotics1.inputs import Array


class JointLines(NamedTuple):
    """The axes of n joints, at k configurations, and the point that the frame is at.

    Attributes:
        z: (k, n, 3) their directions.
        o: (k, n, 3) a point on each [m].
        p: (k, 3) the frame's origin [m].
    """

    z: Array
    o: Array
    p: Array


def joint_lines(chain: FixedChain, x: Array) -> JointLines:
    """Return the joint axes of a chain at coordinates x (k, n) [rad or m]."""
    T = np.broadcast_to(chain.P[0], (len(x), 4, 4))
    z, o = [], []
    for i, slides in enumerate(chain.prismatic):
        z.append(T[:, :3, 2])
        o.append(T[:, :3, 3])
        T = T @ motions(slides, x[:, i]) @ chain.P[i + 1]
    return JointLines(np.stack(z, axis=1), np.stack(o, axis=1), T[:, :3, 3])


def meeting_point(z: Array, o: Array) -> tuple[Array, Array]:
    """Return the point next to several lines, (k, 3), and its distance from the farthest of them, (k,).

    Args:
        z: (k, j, 3) unit directions.
        o: (k, j, 3) a point on each [m].
    """
    across = np.eye(3) - z[..., :, None] * z[..., None, :]
    A, b = across.sum(axis=1), (across @ o[..., None])[..., 0].sum(axis=1)
    c = (np.linalg.pinv(A, rcond=1e-9) @ b[..., None])[..., 0]
    apart = np.linalg.norm((across @ (c[:, None] - o)[..., None])[..., 0], axis=2)
    return c, apart.max(axis=1)


def are_parallel(a: Array, b: Array, tolerance: float) -> bool:
    """Whether unit vectors (k, 3) are parallel or opposite at all k configurations."""
    return bool(np.linalg.norm(np.cross(a, b), axis=1).max() < tolerance)


def are_perpendicular(a: Array, b: Array, tolerance: float) -> bool:
    """Whether unit vectors (k, 3) are perpendicular at all k configurations."""
    return bool(np.abs((a * b).sum(axis=1)).max() < tolerance)
