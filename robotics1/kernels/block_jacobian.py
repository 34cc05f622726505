"""Where the frame of a chain is, and its Jacobian, at a block of configurations; `forward` is the same at one."""

from robotics1.inputs import Array
from robotics1.kernels.block_trigonometry import cosines_and_sines
from robotics1.kernels.blocks import BLOCK
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import compiled


@compiled()  # not contract, which would be handed on to the reduction of the angles
def place_block(
    placements: Array, prismatic: Indices, coordinate: Indices, ratio: Array, q: Array, T: Array, lines: Array, z: Array
) -> None:
    """Write the poses to T, (3, 4, BLOCK), and of each joint its axis and a point on it to lines, (k, 6, BLOCK).

    T ← T P, then Z: a turn about z mixes the first two columns, a motion along z moves p along the third.

    Args:
        placements, prismatic, coordinate, ratio: as of `ChainArrays`.
        q: (n, BLOCK) configurations.
        T: (3, 4, BLOCK), to be written.
        lines: (k, 6, BLOCK), to be written.
        z: (3, BLOCK), scratch: motion, cosine and sine of one joint.
    """
    for i in range(3):
        for j in range(4):
            for c in range(BLOCK):
                T[i, j, c] = placements[0, i, j]
    for joint in range(len(coordinate)):
        row, factor = coordinate[joint], ratio[joint]
        for i in range(3):
            for c in range(BLOCK):
                lines[joint, i, c], lines[joint, 3 + i, c] = T[i, 2, c], T[i, 3, c]
        for c in range(BLOCK):
            z[0, c] = factor * q[row, c]
        P = placements[joint + 1]
        if prismatic[joint]:
            for i in range(3):
                for c in range(BLOCK):
                    T[i, 3, c] += z[0, c] * T[i, 2, c]
        else:
            cosines_and_sines(z[0], z[1], z[2])
            for i in range(3):
                for c in range(BLOCK):
                    x, y = T[i, 0, c], T[i, 1, c]
                    T[i, 0, c], T[i, 1, c] = z[1, c] * x + z[2, c] * y, z[1, c] * y - z[2, c] * x
        for i in range(3):
            for c in range(BLOCK):
                x, y, a, p = T[i, 0, c], T[i, 1, c], T[i, 2, c], T[i, 3, c]
                T[i, 0, c] = x * P[0, 0] + y * P[1, 0] + a * P[2, 0]
                T[i, 1, c] = x * P[0, 1] + y * P[1, 1] + a * P[2, 1]
                T[i, 2, c] = x * P[0, 2] + y * P[1, 2] + a * P[2, 2]
                T[i, 3, c] = x * P[0, 3] + y * P[1, 3] + a * P[2, 3] + p


@compiled(contract=True)
def jacobian_block(prismatic: Indices, coordinate: Indices, ratio: Array, T: Array, lines: Array, J: Array) -> None:
    """Write J, (6, n, BLOCK), from what `place_block` found: the columns (z × (p − o), z) and, of a prismatic joint,
    (z, 0). Joints that share a coordinate add up.
    """
    for i in range(6):
        for j in range(J.shape[1]):
            for c in range(BLOCK):
                J[i, j, c] = 0.0
    for joint in range(len(coordinate)):
        column, factor = coordinate[joint], ratio[joint]
        if prismatic[joint]:
            for i in range(3):
                for c in range(BLOCK):
                    J[i, column, c] += factor * lines[joint, i, c]
            continue
        for c in range(BLOCK):
            x, y, z = factor * lines[joint, 0, c], factor * lines[joint, 1, c], factor * lines[joint, 2, c]
            dx, dy = T[0, 3, c] - lines[joint, 3, c], T[1, 3, c] - lines[joint, 4, c]
            dz = T[2, 3, c] - lines[joint, 5, c]
            J[0, column, c] += y * dz - z * dy
            J[1, column, c] += z * dx - x * dz
            J[2, column, c] += x * dy - y * dx
            J[3, column, c] += x
            J[4, column, c] += y
            J[5, column, c] += z


@compiled(contract=True)
def task_rows_block(S: Array, J: Array, A: Array) -> None:
    """Write the task's Jacobian S J, with S (m, 6) the same for all: to A, (m, n, BLOCK), or its transpose to A,
    (n, m, BLOCK), if n < m.
    """
    m, n = S.shape[0], J.shape[1]
    for i in range(m):
        for j in range(n):
            a, b = (i, j) if m <= n else (j, i)
            for c in range(BLOCK):
                A[a, b, c] = 0.0
            for r in range(6):
                if S[i, r] != 0.0:
                    for c in range(BLOCK):
                        A[a, b, c] += S[i, r] * J[r, j, c]
