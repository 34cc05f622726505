"""Six joints in a closed loop, Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1; the first three are special.

Their axes go through a point, or they move in a plane. One of the fixed placements, (4, 4) each, holds the target.
What the three cannot change are two equations in two of the others.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from robotics1.ik.common_roots import ALONE, coefficients, common_roots, samples
from robotics1.ik.subproblems import (
    ON_AXIS,
    Z,
    first_coordinate,
    inverse,
    motion,
    moved,
    orientation,
    placed,
    planar_loop,
    point,
)
from robotics1.inputs import Array

ROUNDED = 1e-4  # of angles [rad] and of lengths beside the arm's, by which files round
PARALLEL = 1e-3  # sine of an angle between axes whose common point is not to be trusted
TURNED = np.pi / 6 * np.arange(12)  # of a joint that may have any angle
LoopSolve = Callable[[Sequence[Array]], Array | None]


@dataclass(frozen=True)
class LoopSolver:
    """How a loop is solved.

    Attributes:
        name: of what is special.
        deviation: by how much the arm differs from one for which it is exact.
        solve: placements A → the coordinates, (k, 6); None where they are not finitely many.
        normal: (3,) of the plane in which the first three joints move, before them; None of a spherical wrist.
        ends: where the common point of a spherical wrist is, on the first axis and on the last.
        backwards: whether the loop of a plane is gone through from its other end, where a joint turns.
    """

    name: str
    deviation: float
    solve: LoopSolve
    normal: Array | None = None
    ends: tuple[float, float] = (0.0, 0.0)
    backwards: bool = False


def loop_solver(between: Sequence[Array], prismatic: Sequence[bool], i: int, length: float) -> LoopSolver | None:
    """Return the solver of the loop that begins at joint i of an arm, if joints i to i + 2 are special.

    Args:
        between: five placements (4, 4), each behind a joint.
        prismatic: of the six joints.
        i: 0 to 3.
        length: of the arm [m].
    """
    A = between[i : i + 2]
    turned = [prismatic[(i + k) % 6] for k in range(6)]
    miss = miss_of_a_point(A) / max(length, 1e-300)
    if not any(turned[:3]) and miss < ROUNDED:
        ends = meeting(A[0])[0], meeting(A[1])[1]
        return LoopSolver("a spherical wrist", miss, lambda A: _spherical(A, turned), ends=ends)
    tilt, n = _tilt_of_a_plane(A, turned)
    if tilt < ROUNDED and not all(turned[:3]) and not (turned[3] and turned[5]):
        solve = partial(_planar, prismatic=turned, n=n)
        return LoopSolver("three joints of a plane", tilt, solve, normal=n, backwards=turned[3])
    return None


def meeting(A: Array) -> tuple[float, float, float]:
    """Return where the z axis and that of a placement A meet, on each, and by how much they miss; ∞ if parallel."""
    M = np.column_stack([Z, -A[:3, 2]])
    here, there = np.linalg.lstsq(M, A[:3, 3], rcond=None)[0]
    skew = np.hypot(A[0, 2], A[1, 2]) > PARALLEL
    return float(here), float(there), float(np.linalg.norm(M @ [here, there] - A[:3, 3])) if skew else np.inf


def miss_of_a_point(A: Sequence[Array]) -> float:
    """Return by how much three axes, with two placements between them, miss a common point."""
    _, on_second, miss = meeting(A[0])
    second, _, other_miss = meeting(A[1])
    return max(miss, other_miss, abs(on_second - second))


def _tilt_of_a_plane(A: Sequence[Array], prismatic: Sequence[bool]) -> tuple[float, Array]:
    """Return by how much three joints leave a plane, and its normal, before the first of them.

    Joints turn about the normal, or move across it.
    """
    n = Z if not prismatic[0] else A[0][:3, 2] if not prismatic[1] else A[0][:3, :3] @ A[1][:3, 2]
    normals = [n, A[0][:3, :3].T @ n, A[1][:3, :3].T @ A[0][:3, :3].T @ n]
    tilts = [abs(m[2]) if slides else np.hypot(*m[:2]) for m, slides in zip(normals, prismatic[:3], strict=True)]
    return float(max(tilts)), n


def _spherical(A: Sequence[Array], prismatic: Sequence[bool]) -> Array | None:
    """Return the solutions for axes 0 to 2 through one point: where it is, is a matter of the other joints alone.

    Its place on axis 2, and on axis 0 at the other end of the loop: A₂ Z₃ A₃ Z₄ A₄ Z₅ A₅ takes the one to the other.
    """
    here, there = meeting(A[0])[0], meeting(A[1])[1]
    c, t = placed(A[5], here * Z), placed(inverse(A[2]), there * Z)
    rest = point(A[3:5], prismatic[3:], c, t)
    if rest is None:
        return None
    anywhere = [bool(np.hypot(*p[:2]) < ON_AXIS) and not prismatic[k] for p, k in ((t, 3), (c, 5))]
    found = []
    for x in rest:
        reached = _with_turns(A, prismatic, x, TURNED if anywhere[0] else TURNED[:1])
        if reached is None or (any(anywhere) and not len(reached)):
            return None  # joint 3 or 5 is arbitrary, and for some of its angles the three may reach
        found += reached
    return np.array(found).reshape(-1, 6)


def _with_turns(A: Sequence[Array], prismatic: Sequence[bool], x: Array, by: Array) -> list[Array] | None:
    """Return solutions with joints 3 to 5 at x, joint 3 turned by each of some angles."""
    found = []
    for rest in x + np.outer(by, [1.0, 0.0, 0.0]):
        turns = orientation([A[0][:3, :3], A[1][:3, :3]], _through(A, prismatic, rest)[:3, :3].T)
        if turns is None:
            return None
        found += [np.array([*turn, *rest]) for turn in turns]
    return found


def _through(A: Sequence[Array], prismatic: Sequence[bool], x: Array) -> Array:
    """Return A₂ Z₃ A₃ Z₄ A₄ Z₅ A₅, the inverse of Z₀ A₀ Z₁ A₁ Z₂."""
    T = A[2]
    for k in (3, 4, 5):
        T = T @ motion(prismatic[k], x[k - 3]) @ A[k]
    return T


def _planar(A: Sequence[Array], prismatic: Sequence[bool], n: Array) -> Array | None:
    """Return the solutions for joints 0 to 2 that move in a plane with the normal n, from that end of the loop at which
    the next joint turns.
    """
    if not prismatic[3]:
        return _beside_a_plane(A, prismatic, n)
    order = [2, 1, 0, 5, 4, 3]
    back = [inverse(A[k]) for k in (1, 0, 5, 4, 3, 2)]
    n_behind = A[1][:3, :3].T @ A[0][:3, :3].T @ n
    found = _beside_a_plane(back, [prismatic[k] for k in order], n_behind)
    return None if found is None else -found[:, order]


def _beside_a_plane(A: Sequence[Array], prismatic: Sequence[bool], n: Array) -> Array | None:
    """Return the solutions for joints 0 to 2 of a plane and a joint 3 that turns.

    M = Z₀ A₀ Z₁ A₁ Z₂ takes n₂ to n, and leaves distances along n. With W = A₃ Z₄ A₄ Z₅ A₅ and m = W n, which has
    neither joint 3 nor the plane's, the direction and the place of axis 3 are two equations: m_z = (A₂ᵀ n₂)_z and
    −mᵀ p_W = n₂ᵀ p₂ + k.
    """
    n2 = A[1][:3, :3].T @ A[0][:3, :3].T @ n
    k = float(n @ (A[0] @ A[1])[:3, 3])
    wanted = A[2][:3, :3].T @ n2
    x4, x5 = samples(prismatic[4])[:, None], samples(prismatic[5])

    def through(x4: Array, x5: Array, p: Array, *, point: bool) -> Array:
        behind = moved(prismatic[5], x5, placed(A[5], p) if point else A[5][:3, :3] @ p, point=point)
        behind = placed(A[4], behind) if point else behind @ A[4][:3, :3].T
        behind = moved(prismatic[4], x4, behind, point=point)
        return placed(A[3], behind) if point else np.asarray(behind @ A[3][:3, :3].T)

    m, p = through(x4, x5, n, point=False), through(x4, x5, np.zeros(3), point=True)
    F = coefficients(m[..., 2] - wanted[2], prismatic[4:])
    G = coefficients((m * p).sum(axis=-1) + n2 @ A[2][:3, 3] + k, prismatic[4:])
    pairs = common_roots(F, G, prismatic[4:])
    if pairs is None or np.hypot(*wanted[:2]) < PARALLEL:
        return None
    found = []
    reached = dict.fromkeys(pairs.family, False)
    for pair, family in zip(*pairs, strict=True):
        m = through(pair[:1], pair[1:], n, point=False)[0]
        x = np.array([first_coordinate(False, m, wanted), *pair])
        plane = planar_loop([A[0], A[1], _through(A, prismatic, x)], prismatic[:3], n)
        if plane is None:
            return None
        found += [[*y, *x] for y in plane]
        reached[family] |= len(plane) > 0 or family == ALONE
    return np.array(found).reshape(-1, 6) if all(reached.values()) else None  # other members of a family may reach
