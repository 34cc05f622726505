"""Parts of inverse kinematics that have finitely many solutions by formula: a point, a plane, an orientation.

Z(x) turns about z by x, or moves along it; A and B are fixed placements (4, 4).

Source: Pieper, The kinematics of manipulators under computer control, 1968: what the first joint leaves alone.
"""

from collections.abc import Sequence

import numpy as np

from robotics1.ik.common_roots import MISS, coefficients, common_roots, real_roots, samples
from robotics1.inputs import Array

Z = np.array([0.0, 0.0, 1.0])
ON_AXIS = 1e-9  # distance from a joint axis at which its angle is arbitrary
NEAR_AXIS = 1e-3  # distance from a joint axis at which its angle may be arbitrary
DEPENDENT = 1e-6  # 1/condition of the directions of three slides that may be dependent


def motion(prismatic: bool, x: float) -> Array:
    """Return Z(x), (4, 4)."""
    return np.asarray(motions(prismatic, np.array([x]))[0])


def motions(prismatic: bool, x: Array) -> Array:
    """Return Z(x) of coordinates (k,): (k, 4, 4)."""
    T = np.zeros((len(x), 4, 4))
    T[:, 2, 2] = T[:, 3, 3] = 1.0
    if prismatic:
        T[:, 0, 0] = T[:, 1, 1] = 1.0
        T[:, 2, 3] = x
        return T
    T[:, 0, 0] = T[:, 1, 1] = np.cos(x)
    T[:, 1, 0] = np.sin(x)
    T[:, 0, 1] = -T[:, 1, 0]
    return T


def moved(prismatic: bool, x: Array, p: Array, *, point: bool = True) -> Array:
    """Return Z(x) p for coordinates (k, 1, ..., 1) and vectors (..., 3); a direction is turned only."""
    if prismatic:
        return np.asarray(p + (x[..., None] * Z if point else 0 * x[..., None]))
    c, s = np.cos(x), np.sin(x)
    turned = c * p[..., 0] - s * p[..., 1], s * p[..., 0] + c * p[..., 1]
    return np.stack([*turned, np.broadcast_to(p[..., 2], turned[0].shape)], axis=-1)


def placed(A: Array, p: Array) -> Array:
    """Return A p for points (..., 3)."""
    return np.asarray(p @ A[:3, :3].T + A[:3, 3])


def inverse(A: Array) -> Array:
    """Return A⁻¹ of a placement."""
    T = np.eye(4)
    T[:3, :3] = A[:3, :3].T
    T[:3, 3] = -A[:3, :3].T @ A[:3, 3]
    return T


def first_coordinate(prismatic: bool, p: Array, t: Array) -> float:
    """Return x with Z(x) p = t, or 0 where it is arbitrary."""
    if prismatic:
        return float(t[2] - p[2])
    if max(np.hypot(*p[:2]), np.hypot(*t[:2])) < ON_AXIS:
        return 0.0
    return float(np.arctan2(t[1], t[0]) - np.arctan2(p[1], p[0]))


def one_row(prismatic: bool, c: Array, row: Array, value: float) -> Array | None:
    """Return the (k, 1) coordinates with row · Z(x) c = value."""
    p = moved(prismatic, samples(prismatic), c)
    found = real_roots(coefficients(p @ row - value, [prismatic]), prismatic)
    return None if found is None else found[:, None]


def two_rows(A: Array, prismatic: Sequence[bool], c: Array, rows: Array, values: Array) -> Array | None:
    """Return the (k, 2) coordinates with rows · Z₀ A Z₁ c = values; rows are (2, 3).

    None if the coordinates are not finitely many, or the equations do not tell.
    """
    p = placed(A, moved(prismatic[1], samples(prismatic[1]), c))
    p = moved(prismatic[0], samples(prismatic[0])[:, None], p)
    F, G = (coefficients(p @ row - value, prismatic) for row, value in zip(rows, values, strict=True))
    found = common_roots(F, G, prismatic)
    return None if found is None else found.x


def point(A: Sequence[Array], prismatic: Sequence[bool], c: Array, t: Array) -> Array | None:
    """Return the (k, 3) coordinates with Z₀ A₀ Z₁ A₁ Z₂ c = t; None as `two_rows`.

    Where the equations do not tell, those of the arm from its tool to its base may: Z₂⁻¹ A₁⁻¹ Z₁⁻¹ A₀⁻¹ Z₀⁻¹ t = c.
    """
    x = _point(A, prismatic, c, t)
    if x is None:
        x = _point([inverse(A[1]), inverse(A[0])], prismatic[::-1], t, c)
        x = None if x is None else -x[:, ::-1]
    return x


def _point(A: Sequence[Array], prismatic: Sequence[bool], c: Array, t: Array) -> Array | None:
    """Return what `point` does, from what the first joint leaves alone.

    With p = A₀ Z₁ A₁ Z₂ c a first joint that turns leaves p_z and |p|², one that moves leaves p_x and p_y.
    """

    def p(x1: Array, x2: Array) -> Array:
        return placed(A[0], moved(prismatic[1], x1, placed(A[1], moved(prismatic[2], x2, c))))

    grid = p(samples(prismatic[1])[:, None], samples(prismatic[2]))
    if prismatic[0]:
        left = grid[..., 0] - t[0], grid[..., 1] - t[1]
    else:
        left = grid[..., 2] - t[2], (grid**2).sum(axis=-1) - t @ t
    F, G = (coefficients(values, prismatic[1:]) for values in left)
    found = common_roots(F, G, prismatic[1:])
    if found is None:
        return None
    ends = p(*found.x.T)
    first = [first_coordinate(prismatic[0], end, t) for end in ends]
    return np.column_stack([np.array(first).reshape(-1), found.x])


def planar_loop(B: Sequence[Array], prismatic: Sequence[bool], n: Array) -> Array | None:
    """Return the (k, 3) coordinates with Z₀ B₀ Z₁ B₁ Z₂ B₂ = 1 but for moves along n, the normal of all motions.

    The loop begins behind a joint that turns: the point on that joint's axis is a target for the two others.
    """
    turning = [i for i in range(3) if not prismatic[i]]
    if not turning:
        return None
    last = turning[-1]
    order = [(last + 1) % 3, (last + 2) % 3, last]
    for i in range(last + 1):  # n before the joint that is first now
        n = B[i][:3, :3].T @ n
    slides, (B0, B1, B2) = [prismatic[i] for i in order[:2]], [B[i] for i in order]
    back = inverse(B2)
    found = _two_in_a_plane(B0, slides, B1[:3, 3], back[:3, 3], n)
    if found is None:
        rows = np.linalg.svd(n[None])[2][1:]
        found = two_rows(B0, slides, B1[:3, 3], rows, rows @ back[:3, 3])
    if found is None:
        return None
    x = np.zeros((len(found), 3))
    for k, (x0, x1) in enumerate(found):
        Z2 = inverse(motion(slides[0], x0) @ B0 @ motion(slides[1], x1) @ B1) @ back
        x[k, order] = x0, x1, np.arctan2(Z2[1, 0], Z2[0, 0])
    return x


def _two_in_a_plane(A: Array, prismatic: Sequence[bool], c: Array, t: Array, n: Array) -> Array | None:
    """Return the (k, 2) coordinates with Z₀ A Z₁ c = t but for moves along n; None where that is not clear.

    A joint 0 that turns leaves the distance of A Z₁ c from its axis alone, one that slides its place across.
    """

    def misses(p: Array) -> Array:
        if prismatic[0]:
            return np.asarray((p - t) @ np.cross(Z, n))
        return np.asarray((p[..., :2] ** 2).sum(axis=-1) - t[:2] @ t[:2])

    if not prismatic[0] and np.hypot(*t[:2]) < NEAR_AXIS:
        return None
    left = misses(placed(A, moved(prismatic[1], samples(prismatic[1]), c)))
    if np.ptp(left) < NEAR_AXIS * max(1.0, float(np.abs(left).max())):
        return None
    roots = real_roots(coefficients(left, prismatic[1:]), prismatic[1])
    if roots is None:
        return None
    second = np.unique(np.round(roots, 13))
    ends = placed(A, moved(prismatic[1], second, c))
    hits = np.abs(misses(ends)) < MISS * np.abs(left).max()
    return np.array(
        [[first_coordinate(prismatic[0], p, t), x] for p, x in zip(ends[hits], second[hits], strict=True)]
    ).reshape(-1, 2)


def orientation(A: Sequence[Array], R: Array) -> Array | None:
    """Return the (k, 3) angles with Z₀ A₀ Z₁ A₁ Z₂ = R, rotations only: (3, 3) each.

    zᵀ R z leaves two θ₁; then Z₀ turns A₀ Z₁ A₁ z to R z. Where these are along z, θ₀ is arbitrary.
    """
    middle = [A[0] @ motion(False, angle)[:3, :3] @ A[1] for angle in samples(False)]
    found = real_roots(coefficients(np.array(middle)[:, 2, 2] - R[2, 2], [False]), False)
    if found is None or np.ptp(np.array(middle)[:, 2, 2]) < ON_AXIS:
        return None
    x = []
    for angle in np.unique(np.round(found, 13)):
        M = A[0] @ motion(False, angle)[:3, :3] @ A[1]
        first = first_coordinate(False, M[:, 2], R[:, 2])
        last = M.T @ motion(False, first)[:3, :3].T @ R
        x.append([first, angle, np.arctan2(last[1, 0], last[0, 0])])
    return np.array(x).reshape(-1, 3)


def turns_and_slides(A: Sequence[Array], prismatic: Sequence[bool]) -> Array | None:
    """Return the (k, 6) coordinates of a loop Z₀ A₀ ... Z₅ A₅ = 1 of three joints that turn and three that slide.

    Slides turn nothing: the turns are those of an orientation. Then the loop is linear in the slides. None where these
    are not independent, or the turns are not finitely many.
    """
    turning = [k for k in range(6) if not prismatic[k]]
    B = [np.eye(3), np.eye(3), np.eye(3), np.eye(3)]  # before and behind each turn
    for k in range(6):
        i = sum(turn <= k for turn in turning)
        B[i] = B[i] @ A[k][:3, :3]
    turns = orientation(B[1:3], (B[3] @ B[0]).T)
    if turns is None:
        return None
    found = []
    for angles in turns:
        x = np.zeros(6)
        x[turning] = angles
        T, U = np.eye(4), []
        for k in range(6):
            if prismatic[k]:
                U.append(T[:3, 2])
            T = T @ motion(prismatic[k], x[k]) @ A[k]
        if np.linalg.cond(np.array(U)) > 1.0 / DEPENDENT:
            return None
        x[list(map(bool, prismatic))] = np.linalg.solve(np.array(U).T, -T[:3, 3])
        found.append(x)
    return np.array(found).reshape(-1, 6)
