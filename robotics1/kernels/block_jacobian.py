"""Where the frame of a chain is, and its Jacobian, at a block of configurations; `pose` is the same at one.

What belongs to one configuration is spread: each number of it, such as an entry of J, stands in a row of its own, with
one place for each configuration of the block. An operation is then a loop along a row, that LLVM turns into vector
instructions, eight configurations at a time where the processor has AVX-512; and a block fits the first-level cache.
The loops are written out, since a slice of an array costs the compiler more than the loop.
"""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays
from robotics1.kernels.compilation import compiled

BLOCK = 64  # with 16 and 32, LLVM unrolls the loops, and the rate is 0.6 of this; with 128 it is 1.05 times this
LARGEST = 1e5  # [rad]; beyond, the reduction loses digits and the C library is used
TWO_BY_PI = 2 / math.pi
# π/2 in three parts; the first two have 33 bits, so that a multiple of them below 2²⁰ is exact.
HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)


@compiled(inner=True)  # not contract: summed in another order, the three parts of π/2 would be one
def cosines_and_sines(angle: Array, cosine: Array, sine: Array) -> None:
    """Write cos and sin of the angles (BLOCK,) [rad], to 2e-16.

    r = x − k π/2 with k the nearest integer; then the polynomials for |r| ≤ π/4; then k mod 4 says which of
    ±cos r, ±sin r is meant.

    Source of the reduction: Cody, Waite, Software Manual for the Elementary Functions, 1980, chapter 8. Of the
    constants: Sun Microsystems' fdlibm, 1993, k_sin.c, k_cos.c and e_rem_pio2.c.
    """
    beyond = 0
    for c in range(BLOCK):
        x = angle[c]
        beyond += abs(x) > LARGEST
        k = np.rint(x * TWO_BY_PI)
        r = ((x - k * HALF_PI[0]) - k * HALF_PI[1]) - k * HALF_PI[2]
        z = r * r
        a = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        a = a + z * z * z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)
        s = r + r * z * (-1.66666666666666324348e-01 + z * a)
        b = 4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05)
        t = 2.08757232129817482790e-09 - z * 1.13596475577881948265e-11
        b = b + z * z * z * (-2.75573143513906633035e-07 + z * t)
        d = (1.0 - 0.5 * z) + z * z * b
        quarter = np.int64(k)
        x, y = (s, d) if quarter & 1 else (d, s)
        cosine[c] = -x if (quarter + 1) & 2 else x
        sine[c] = -y if quarter & 2 else y
    if beyond > 0:
        for c in range(BLOCK):
            cosine[c], sine[c] = math.cos(angle[c]), math.sin(angle[c])


@compiled(inner=True)  # not contract, which would be handed on to the reduction of the angles
def place_block(chain: ChainArrays, q: Array, T: Array, joint_axes: Array, z: Array) -> None:
    """Write the poses to T, (3, 4, BLOCK), and of each joint its axis and a point on it to joint_axes, (k, 6, BLOCK).

    T ← T P, then Z: a turn about z mixes the first two columns, a motion along z moves p along the third.

    Args:
        chain: its constants.
        q: (n, BLOCK) configurations.
        T: (3, 4, BLOCK), to be written.
        joint_axes: (k, 6, BLOCK), to be written.
        z: (3, BLOCK), scratch: motion, cosine and sine of one joint.
    """
    for i in range(3):
        for j in range(4):
            for c in range(BLOCK):
                T[i, j, c] = chain.placements[0, i, j]
    for joint in range(len(chain.ratio)):
        row, factor = chain.coordinate[joint], chain.ratio[joint]
        for i in range(3):
            for c in range(BLOCK):
                joint_axes[joint, i, c], joint_axes[joint, 3 + i, c] = T[i, 2, c], T[i, 3, c]
        for c in range(BLOCK):
            z[0, c] = factor * q[row, c]
        P = chain.placements[joint + 1]
        if chain.prismatic[joint]:
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


@compiled(contract=True, inner=True)
def jacobian_block(chain: ChainArrays, T: Array, joint_axes: Array, J: Array) -> None:
    """Write J, (6, n, BLOCK), from what `place_block` found: the columns (z × (p − o), z) and, of a prismatic joint,
    (z, 0). Joints that share a coordinate add up.
    """
    for i in range(6):
        for j in range(J.shape[1]):
            for c in range(BLOCK):
                J[i, j, c] = 0.0
    for joint in range(len(chain.ratio)):
        column, factor = chain.coordinate[joint], chain.ratio[joint]
        if chain.prismatic[joint]:
            for i in range(3):
                for c in range(BLOCK):
                    J[i, column, c] += factor * joint_axes[joint, i, c]
            continue
        for c in range(BLOCK):
            x, y = factor * joint_axes[joint, 0, c], factor * joint_axes[joint, 1, c]
            z = factor * joint_axes[joint, 2, c]
            dx, dy = T[0, 3, c] - joint_axes[joint, 3, c], T[1, 3, c] - joint_axes[joint, 4, c]
            dz = T[2, 3, c] - joint_axes[joint, 5, c]
            J[0, column, c] += y * dz - z * dy
            J[1, column, c] += z * dx - x * dz
            J[2, column, c] += x * dy - y * dx
            J[3, column, c] += x
            J[4, column, c] += y
            J[5, column, c] += z


@compiled(contract=True, inner=True)
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
