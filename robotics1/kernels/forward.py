"""Where the frame of a chain is, and its Jacobian, at one configuration."""

import math

from robotics1.inputs import Array
from robotics1.kernels.chain import COORDINATE, PRISMATIC, RATIO
from robotics1.kernels.compilation import compiled


@compiled(contract=True, inline=True)
def forward_kinematics(links: Array, q: Array, T: Array, joint_axes: Array) -> None:
    """Write the frame's pose to T, (3, 4) = [R p], and of each joint its axis and a point on it to joint_axes, (k, 6).

    T ← T P, then Z: a turn about z mixes the first two columns, a motion along z moves p along the third.
    `links` are those of a chain.
    """
    for i in range(3):
        for j in range(4):
            T[i, j] = links[0, 4 * i + j]
    for joint in range(len(links) - 1):
        for i in range(3):
            joint_axes[joint, i], joint_axes[joint, 3 + i] = T[i, 2], T[i, 3]
        motion = links[joint, RATIO] * q[int(links[joint, COORDINATE])]
        if links[joint, PRISMATIC] != 0.0:
            for i in range(3):
                T[i, 3] += motion * T[i, 2]
        else:
            c, s = math.cos(motion), math.sin(motion)
            for i in range(3):
                x, y = T[i, 0], T[i, 1]
                T[i, 0], T[i, 1] = c * x + s * y, c * y - s * x
        P = links[joint + 1]
        for i in range(3):
            x, y, z, p = T[i, 0], T[i, 1], T[i, 2], T[i, 3]
            for j in range(3):
                T[i, j] = x * P[j] + y * P[4 + j] + z * P[8 + j]
            T[i, 3] = x * P[3] + y * P[7] + z * P[11] + p


@compiled(contract=True, inline=True)
def geometric_jacobian(links: Array, T: Array, joint_axes: Array, J: Array) -> None:
    """Write J, (6, n), from what `forward_kinematics` found.

    A column is (z × (p − o), z), or (z, 0) of a prismatic joint; joints that share a coordinate add up.
    """
    J[:] = 0.0
    for joint in range(len(links) - 1):
        column, r = int(links[joint, COORDINATE]), links[joint, RATIO]
        x, y, z = r * joint_axes[joint, 0], r * joint_axes[joint, 1], r * joint_axes[joint, 2]
        if links[joint, PRISMATIC] != 0.0:
            J[0, column] += x
            J[1, column] += y
            J[2, column] += z
        else:
            dx, dy, dz = T[0, 3] - joint_axes[joint, 3], T[1, 3] - joint_axes[joint, 4], T[2, 3] - joint_axes[joint, 5]
            J[0, column] += y * dz - z * dy
            J[1, column] += z * dx - x * dz
            J[2, column] += x * dy - y * dx
            J[3, column] += x
            J[4, column] += y
            J[5, column] += z
