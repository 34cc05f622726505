"""The step of damped least squares inside joint limits."""

from robotics1.inputs import Array
from robotics1.kernels.chain import CIRCULAR, LOWER, UPPER
from robotics1.kernels.compilation import compiled


@compiled(contract=True, inline=True)
def factor(A: Array) -> None:
    """Overwrite the lower triangle of A, (6, 6), symmetric and positive definite, with L and D: A = L D Lᵀ.

    D takes the diagonal, since that of L is 1. Each column is at once taken from all that is right of it: those
    subtractions do not wait for each other, as the sums of the usual Cholesky loop do, and the size is a constant,
    so that the compiler writes the loops out. Together that is four times as fast.

    Source: Golub, Van Loan, Matrix Computations, 2013, section 4.1.2, in the outer product form.
    """
    for j in range(5):
        inverse = 1.0 / A[j, j]
        for i in range(5, j, -1):
            entry = A[i, j] * inverse
            for k in range(j + 1, i + 1):
                A[i, k] -= entry * A[k, j]
            A[i, j] = entry


@compiled(contract=True, inline=True)
def solve_factored(A: Array, y: Array) -> None:
    """Overwrite y, (6,), with (L D Lᵀ)⁻¹ y, L and D as `factor` leaves them."""
    for j in range(5):
        for i in range(j + 1, 6):
            y[i] -= A[i, j] * y[j]
    for j in range(6):
        y[j] /= A[j, j]
    for j in range(5, 0, -1):
        for i in range(j):
            y[i] -= A[j, i] * y[j]


@compiled(contract=True)
def damped_step(
    columns: Array, e: Array, wish: Array, damping: float, limits: Array, x: Array, held: Array, A: Array, y: Array,
    step: Array,
) -> None:  # fmt: skip
    """Write to step, (n,), the Δx nearest to a wish w with J Δx ≈ e: Δx = w + Jᵀ (J Jᵀ + λ² 1)⁻¹ (e − J w).

    A joint that stands at a limit and would leave it is held, and the others make the step without it: a step that
    is cut at the limits afterwards is no descent, and ends in corners that are no solutions.

    Args:
        columns: (n, 6), Jᵀ; e: (6,).
        wish: (n,), zero for the least step.
        damping: λ².
        limits: (3, n): lower and upper limits, and 1 for joints that can make whole turns and need none.
        x: (n,) the configuration.
        held: (n,); A: (6, 6); y: (6,) working space.
        step: (n,) the result.

    Source: Nakamura, Hanafusa, J. Dyn. Sys. Meas. Control 108 (1986); holding joints at limits: the active set of
    Nocedal, Wright, Numerical Optimization, 2006, section 16.5.
    """
    n = len(x)
    held[:] = 0.0
    for _ in range(n + 1):
        for a in range(6):
            y[a] = e[a]
            for b in range(a + 1):
                A[a, b] = 0.0
            A[a, a] = damping
        for j in range(n):
            if held[j] == 0.0:
                for a in range(6):
                    y[a] -= columns[j, a] * wish[j]
                    for b in range(a + 1):
                        A[a, b] += columns[j, a] * columns[j, b]
        factor(A)
        solve_factored(A, y)
        settled = True
        for j in range(n):
            motion = 0.0
            if held[j] == 0.0:
                motion = wish[j]
                for a in range(6):
                    motion += columns[j, a] * y[a]
                below = x[j] <= limits[LOWER, j] and motion < 0.0
                above = x[j] >= limits[UPPER, j] and motion > 0.0
                if limits[CIRCULAR, j] == 0.0 and (below or above):
                    held[j], motion, settled = 1.0, 0.0, False
            step[j] = motion
        if settled:
            return
