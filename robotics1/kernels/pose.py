"""The pose of a chain's frame at one configuration, its Jacobian, and what the pose is missing to a goal."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import COORDINATE, PRISMATIC, RATIO
from robotics1.kernels.compilation import compiled

SMALL = 1e-8  # sin θ below which θ / sin θ is 1 to the last digit
HALF_TURN = -0.999  # cos θ below which the axis is read from R + Rᵀ, since sin θ loses its digits
TOLERANCE = 10  # where the tolerance stands in `task`


@compiled(contract=True, inline=True, inner=True)
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
        motion = links[joint, RATIO] * q[np.int64(links[joint, COORDINATE])]
        if links[joint, PRISMATIC] != 0.0:
            for i in range(3):
                T[i, 3] += motion * T[i, 2]
            after_turn(links, joint, 1.0, 0.0, T)
        else:
            after_turn(links, joint, math.cos(motion), math.sin(motion), T)


@compiled(contract=True, inline=True, inner=True)
def after_turn(links: Array, joint: int, c: float, s: float, T: Array) -> None:
    """T ← T Z P: a turn of a joint with the cosine c and the sine s, and the placement behind it."""
    behind = joint + 1  # no view of this row, whose reference would be counted
    for i in range(3):
        x, y, z, p = c * T[i, 0] + s * T[i, 1], c * T[i, 1] - s * T[i, 0], T[i, 2], T[i, 3]
        for j in range(3):
            T[i, j] = x * links[behind, j] + y * links[behind, 4 + j] + z * links[behind, 8 + j]
        T[i, 3] = x * links[behind, 3] + y * links[behind, 7] + z * links[behind, 11] + p


@compiled(contract=True, inline=True, inner=True)
def geometric_jacobian(links: Array, T: Array, joint_axes: Array, J: Array) -> None:
    """Write J, (6, n), from what `forward_kinematics` found.

    A column is (z × (p − o), z), or (z, 0) of a prismatic joint; joints that share a coordinate add up.
    """
    J[:] = 0.0
    for joint in range(len(links) - 1):
        column, r = np.int64(links[joint, COORDINATE]), links[joint, RATIO]
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


@compiled(inline=True, inner=True)
def task_parts(task: Array) -> tuple[Array, Array, float, float]:
    """Return what a task is to the kernels, (11,), in parts.

    They are 1 for the six rows of the error that count; the axis that is pointed, or zero; the unit of lengths [m];
    and the tolerance on |e| [m, rad].
    """
    return task[:6], task[6:9], task[9], task[TOLERANCE]


@compiled()
def rotation_vector(M: Array, w: Array) -> None:
    """Write log3(M) to w, (3,): the axis of a rotation matrix times its angle θ ∈ [0, π].

    2 sin θ a = (M₃₂ − M₂₃, M₁₃ − M₃₁, M₂₁ − M₁₂) and 1 + 2 cos θ = tr M; near a half turn
    M + Mᵀ = 2 cos θ 1 + 2 (1 − cos θ) a aᵀ.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.5.
    """
    w[0], w[1], w[2] = 0.5 * (M[2, 1] - M[1, 2]), 0.5 * (M[0, 2] - M[2, 0]), 0.5 * (M[1, 0] - M[0, 1])
    sine = math.sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2])
    cosine = 0.5 * (M[0, 0] + M[1, 1] + M[2, 2] - 1.0)
    angle = math.atan2(sine, cosine)
    if cosine > HALF_TURN:
        factor = angle / sine if sine > SMALL else 1.0
        for i in range(3):
            w[i] *= factor
        return
    k = 0
    for i in range(1, 3):
        if M[i, i] > M[k, k]:
            k = i
    side = math.copysign(1.0, w[k])
    norm = 0.0
    column = np.empty(3)
    for i in range(3):  # the column a aₖ, whose largest entry stands at k
        column[i] = 0.5 * (M[i, k] + M[k, i]) - (cosine if i == k else 0.0)
        norm += column[i] * column[i]
    for i in range(3):
        w[i] = side * angle * column[i] / math.sqrt(norm)


@compiled()
def pose_error(goal: Array, axis: Array, T: Array, M: Array, e: Array) -> None:
    """Write (p_d − p, ω) to e, (6,): ω turns the frame into the goal, or just its axis into that of the goal.

    Args:
        goal: [R_d p_d], (3, 4) or more rows.
        axis: zero: ω = log3(R_d Rᵀ). An axis a of the frame: ω is the least turn from r = R a to r_d = R_d a.
        T: [R p], (3, 4).
        M: (3, 3) working space.
        e: (6,) the result.
    """
    for i in range(3):
        e[i] = goal[i, 3] - T[i, 3]
    if axis[0] == 0.0 and axis[1] == 0.0 and axis[2] == 0.0:
        for i in range(3):
            for j in range(3):
                M[i, j] = goal[i, 0] * T[j, 0] + goal[i, 1] * T[j, 1] + goal[i, 2] * T[j, 2]
        rotation_vector(M, e[3:])
        return
    for i in range(3):
        M[0, i] = T[i, 0] * axis[0] + T[i, 1] * axis[1] + T[i, 2] * axis[2]
        M[1, i] = goal[i, 0] * axis[0] + goal[i, 1] * axis[1] + goal[i, 2] * axis[2]
    cosine, square = 0.0, 0.0
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        e[3 + i] = M[0, j] * M[1, k] - M[0, k] * M[1, j]
        square += e[3 + i] * e[3 + i]
        cosine += M[0, i] * M[1, i]
    sine = math.sqrt(square)
    if sine > SMALL:
        for i in range(3):
            e[3 + i] *= math.atan2(sine, cosine) / sine
    elif cosine < 0.0:  # opposite: any axis across r turns it over
        k = 0
        for i in range(1, 3):
            if abs(M[0, i]) < abs(M[0, k]):
                k = i
        for i in range(3):
            e[3 + i] = math.pi * ((1.0 if i == k else 0.0) - M[0, i] * M[0, k]) / math.sqrt(1.0 - M[0, k] * M[0, k])


@compiled()
def leave_out(counted: Array, axis: Array, T: Array, columns: Array, e: Array) -> None:
    """Set the rows of Jᵀ, (n, 6), and of e, (6,), that do not count to zero.

    Of a task that points an axis a, the turns about r = R a do not count either: ω ← ω − r (rᵀ ω).
    """
    n = len(columns)
    if axis[0] != 0.0 or axis[1] != 0.0 or axis[2] != 0.0:
        x = T[0, 0] * axis[0] + T[0, 1] * axis[1] + T[0, 2] * axis[2]
        y = T[1, 0] * axis[0] + T[1, 1] * axis[1] + T[1, 2] * axis[2]
        z = T[2, 0] * axis[0] + T[2, 1] * axis[1] + T[2, 2] * axis[2]
        for j in range(n):
            along = x * columns[j, 3] + y * columns[j, 4] + z * columns[j, 5]
            columns[j, 3] -= x * along
            columns[j, 4] -= y * along
            columns[j, 5] -= z * along
    for i in range(6):
        e[i] *= counted[i]
    for j in range(n):
        for i in range(6):
            columns[j, i] *= counted[i]
