"""Placements [R p], (3, 4), applied to points and directions, inverted, and put one behind the other."""

import math

from robotics1.inputs import Array
from robotics1.kernels.compilation import compiled

NOTHING = 1e-300  # that is divided by, instead of zero
ON_AXIS = 1e-7  # distance from a joint axis at which its angle is arbitrary, or nearly so


@compiled(inline=True, inner=True)
def place(A: Array, p: Array, placed: Array) -> None:
    """Write A p of a point to placed, (3,)."""
    for i in range(3):
        placed[i] = A[i, 0] * p[0] + A[i, 1] * p[1] + A[i, 2] * p[2] + A[i, 3]


@compiled(inline=True, inner=True)
def turn(A: Array, p: Array, turned: Array) -> None:
    """Write A p of a direction to turned, (3,)."""
    for i in range(3):
        turned[i] = A[i, 0] * p[0] + A[i, 1] * p[1] + A[i, 2] * p[2]


@compiled(inline=True, inner=True)
def turn_back(A: Array, p: Array, turned: Array) -> None:
    """Write A⁻¹ p of a direction to turned, (3,)."""
    for i in range(3):
        turned[i] = A[0, i] * p[0] + A[1, i] * p[1] + A[2, i] * p[2]


@compiled(inner=True)
def place_back(A: Array, p: Array, placed: Array) -> None:
    """Write A⁻¹ p of a point to placed, (3,)."""
    x, y, z = p[0] - A[0, 3], p[1] - A[1, 3], p[2] - A[2, 3]
    for i in range(3):
        placed[i] = A[0, i] * x + A[1, i] * y + A[2, i] * z


@compiled(inner=True)
def after_joint(T: Array, slides: float, x: float, A: Array) -> None:
    """T ← T Z(x) A."""
    c, s = (1.0, 0.0) if slides else (math.cos(x), math.sin(x))
    for i in range(3):
        u, v, w = c * T[i, 0] + s * T[i, 1], c * T[i, 1] - s * T[i, 0], T[i, 2]
        p = T[i, 3] + (x * w if slides else 0.0)
        for j in range(3):
            T[i, j] = u * A[0, j] + v * A[1, j] + w * A[2, j]
        T[i, 3] = u * A[0, 3] + v * A[1, 3] + w * A[2, 3] + p


@compiled(inner=True)
def set_to(A: Array, T: Array) -> None:
    """T ← A."""
    for i in range(3):
        for j in range(4):
            T[i, j] = A[i, j]


@compiled(inner=True)
def invert(A: Array, T: Array) -> None:
    """T ← A⁻¹."""
    for i in range(3):
        for j in range(3):
            T[i, j] = A[j, i]
        T[i, 3] = -(A[0, i] * A[0, 3] + A[1, i] * A[1, 3] + A[2, i] * A[2, 3])


@compiled(inline=True, inner=True)
def turned_back(A: Array, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return A⁻¹ p of a direction p = (x, y, z)."""
    return (
        A[0, 0] * x + A[1, 0] * y + A[2, 0] * z,
        A[0, 1] * x + A[1, 1] * y + A[2, 1] * z,
        A[0, 2] * x + A[1, 2] * y + A[2, 2] * z,
    )


@compiled(inline=True, inner=True)
def turn_to(px: float, py: float, tx: float, ty: float) -> tuple[float, float, bool]:
    """Return the cosine and the sine of the angle that turns p to t in a plane, and whether it is well determined."""
    from_p, from_t = px * px + py * py, tx * tx + ty * ty
    factor = 1.0 / math.sqrt(max(from_p * from_t, NOTHING))
    cosine, sine = factor * (px * tx + py * ty), factor * (px * ty - py * tx)
    return cosine, sine, min(from_p, from_t) > ON_AXIS * ON_AXIS


@compiled(inline=True, inner=True)
def first_coordinate(slides: float, p: Array, t: Array) -> tuple[float, bool]:
    """Return x with Z(x) p = t, and whether it is well determined."""
    if slides:
        return t[2] - p[2], True
    c, s, determined = turn_to(p[0], p[1], t[0], t[1])
    return math.atan2(s, c), determined
