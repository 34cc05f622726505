"""Cosine and sine of a block of angles, in vector instructions: the C library takes one angle at a time."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.blocks import BLOCK
from robotics1.kernels.compilation import compiled

LARGEST = 1e5  # [rad]; beyond, the reduction loses digits and the C library serves
TWO_BY_PI = 2 / math.pi
# π/2 in three parts; the first two have 33 bits, so that a multiple of them below 2²⁰ is exact.
HALF_PI = (1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21)


@compiled()  # not contract: summed in another order, the three parts of π/2 would be one
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
