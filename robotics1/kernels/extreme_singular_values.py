"""The smallest and the largest singular value of a block of bidiagonal matrices, by Laguerre's iteration.

With λᵢ = σᵢ², at a number μ beside all of them, p = Σ 1/|λᵢ − μ| and q = Σ 1/(λᵢ − μ)² give the step

    s = k / (p + √((k − 1)(k q − p²)))

towards the nearest λ, which it never passes; it is exact if the other λᵢ are one, so that a single λ is approached
with the cube of its distance.

Source: Parlett, Laguerre's method applied to the matrix eigenvalue problem, Math. Comp. 18, 1964; Fernando, Parlett,
Accurate singular values and differential qd algorithms, Numer. Math. 67, 1994.
"""

import math

from robotics1.inputs import Array
from robotics1.kernels.block_jacobian import BLOCK
from robotics1.kernels.compilation import compiled

CLOSE = 1e-13  # of λ: what the steps not taken may add to it
ROUNDING = 1e-14  # of k q − p²: of λᵢ that are nearly one this is all there is, and without it a step could pass them
SWEEPS = 100  # 3 to 6 are usual; a λ that is twofold to fivefold needs 40: a step then leaves 0.4 of the distance


@compiled(contract=True, inner=True)
def smallest_eigenvalues(Q: Array, E: Array, k: int, smallest: Array, work: Array) -> int:
    """Write λ_min of B Bᵀ, with the squares Q (k, BLOCK) and E of `bidiagonal_squares`; return the number of sweeps.

    μ rises from zero. p and q are sums of positive terms: with R = Bᵀ, xᵢ = |R⁻¹eᵢ|² and yᵢ the squares of
    (R Rᵀ)⁻¹ left of its diagonal. After a step the differential qd transform, R̂ᵀR̂ = R Rᵀ − s, makes μ the new zero.
    Nothing is subtracted but s, so λ_min has its own leading digits right, however small it is beside λ_max.

    Args:
        Q, E: overwritten.
        k: the number of rows of B.
        smallest: (BLOCK,), to be written; 0 if it is below 1e-150.
        work: (5, BLOCK), scratch.

    Source of p and q: von Matt, The orthogonal qd-algorithm, SIAM J. Sci. Comput. 18, 1997.
    """
    x, y, p, q, step = work[0], work[1], work[2], work[3], work[4]
    for c in range(BLOCK):
        smallest[c] = 0.0
    for sweep in range(SWEEPS):
        for c in range(BLOCK):
            x[c], y[c] = 1.0 / Q[0, c], 0.0
            p[c], q[c] = x[c], x[c] * x[c]
        for i in range(1, k):
            for c in range(BLOCK):
                inverse = 1.0 / Q[i, c]
                t = E[i - 1, c] * inverse
                y[c] = t * (y[c] + x[c] * x[c])
                x[c] = inverse + t * x[c]
                p[c] += x[c]
                q[c] += x[c] * x[c] + 2.0 * y[c]
        if not laguerre_steps(p, q, k, 1.0, step, smallest):
            return sweep + 1
        for c in range(BLOCK):
            x[c] = Q[0, c] - step[c]
        for i in range(k - 1):
            for c in range(BLOCK):
                Q[i, c] = x[c] + E[i, c]
                t = Q[i + 1, c] / Q[i, c]
                E[i, c] *= t
                x[c] = x[c] * t - step[c]
        for c in range(BLOCK):
            Q[k - 1, c] = x[c]
    return SWEEPS


@compiled(contract=True, inner=True)
def largest_eigenvalues(Q: Array, E: Array, k: int, largest: Array, work: Array) -> int:
    """Write λ_max of BᵀB, with the squares Q (k, BLOCK) and E of `bidiagonal_squares`; return the number of sweeps.

    μ falls from the trace. The pivots of μ − T, T = R Rᵀ tridiagonal, are δᵢ = μ − tᵢ − oᵢ₋₁²/δᵢ₋₁; their product is
    the characteristic polynomial f, so that p = f'/f and q = −(f'/f)' are sums over g = δ'/δ and f = δ''/δ.

    Args:
        Q, E: read only.
        k: the number of rows of B.
        largest: (BLOCK,), to be written.
        work: (6, BLOCK), scratch.
    """
    pivot, g, f, p, q, step = work[0], work[1], work[2], work[3], work[4], work[5]
    for c in range(BLOCK):
        largest[c] = Q[0, c]
    for i in range(1, k):
        for c in range(BLOCK):
            largest[c] += Q[i, c] + E[i - 1, c]
    for sweep in range(SWEEPS):
        for c in range(BLOCK):
            pivot[c] = largest[c] - Q[0, c]
            g[c], f[c] = 1.0 / pivot[c], 0.0
            p[c], q[c] = g[c], g[c] * g[c]
        for i in range(1, k):
            for c in range(BLOCK):
                t = Q[i - 1, c] * E[i - 1, c] / pivot[c]
                pivot[c] = largest[c] - Q[i, c] - E[i - 1, c] - t
                inverse = 1.0 / pivot[c]
                f[c] = t * (f[c] - 2.0 * g[c] * g[c]) * inverse
                g[c] = (1.0 + t * g[c]) * inverse
                p[c] += g[c]
                q[c] += g[c] * g[c] - f[c]
        if not laguerre_steps(p, q, k, -1.0, step, largest):
            return sweep + 1
    return SWEEPS


@compiled(contract=True, inner=True)
def laguerre_steps(p: Array, q: Array, k: int, direction: float, step: Array, root: Array) -> bool:
    """Take the step of each, and return whether another is needed.

    p²/q counts the λᵢ that are as near as the nearest; for a single one the excess over 1, squared, bounds the part
    of the step that is still missing. Where λ is met p is infinite or, by rounding, not positive: no step then.
    """
    missing = 0
    for c in range(BLOCK):
        spread = (k - 1.0) * (k * q[c] - p[c] * p[c] + ROUNDING * q[c])
        s = k / (p[c] + math.sqrt(spread if spread > 0.0 else 0.0))
        s = s if (p[c] > 0.0) and (s > 0.0) else 0.0
        excess = p[c] * p[c] / q[c] - 1.0
        root[c] += direction * s
        step[c] = s
        missing += s * excess * excess > CLOSE * root[c]
    return missing > 0
