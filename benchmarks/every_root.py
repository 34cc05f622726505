"""Every solution of a six-joint arm, real and complex: a reference without elimination that imports nothing of ours.

A 6R arm has at most 16 solutions with complex joint angles, as a polynomial system of that degree has (Lee and Liang,
1988; Raghavan and Roth, 1990). Newton's method from random complex starts finds them one by one; where all 16 are
found, there is no other. The real ones among them are told apart in 40 digits.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import mpmath
import numpy as np
import numpy.typing as npt

Rows = Sequence[tuple[float, float, float]]  # a, α, d of each joint
Complex = npt.NDArray[np.complex128]
Array = npt.NDArray[np.float64]

ALL = 16
STARTS, BATCHES, STEPS = 200, 60, 40
SPREAD, FAR = (-0.5, 0.7), 1e6  # powers of ten of |Im θ|, and an entry of J of what has run away
NEARLY, REACHED, SAME = 1e-6, 1e-8, 1e-6  # of the pose's entries, and of e^{iθ}
REAL = 1e-12  # |Im θ| of a root that is real, where no other is near
NEAR, SINGULAR = 1e-3, 1e-3  # |Im θ| and σ_min(J) at which another may be
DIGITS, EXACT, STEPS_OF_MANY_DIGITS = 40, 1e-25, 12


@dataclass(frozen=True, eq=False)
class Roots:
    """The solutions of a target.

    Attributes:
        real: (k, 6) those with real angles [rad].
        count: how many there are with the complex ones.
    """

    real: Array
    count: int

    @property
    def certain(self) -> bool:
        """Whether all 16 were found, so that there is no other; complex ones come in pairs."""
        return self.count == ALL and len(self.real) % 2 == 0


def every_root(rows: Rows, q: Array, seed: int = 0) -> Roots:
    """Return the solutions of the pose of q (6,)."""
    rng, found = np.random.default_rng(seed), [q.astype(complex)]
    goal = links(rows, found[0][None])[-1][0]
    for _ in range(BATCHES):
        spread = 10 ** rng.uniform(*SPREAD, (STARTS, 1))  # of the imaginary parts
        start = rng.uniform(-np.pi, np.pi, (STARTS, 6)) + 1j * spread * rng.normal(0, 1, (STARTS, 6))
        ends = _newton(rows, goal, start)
        ends = _newton(rows, goal, ends[_missed(rows, goal, ends) < NEARLY])
        for p in ends[_missed(rows, goal, ends) < REACHED]:
            if all(np.abs(np.exp(1j * (p - other)) - 1).max() > SAME for other in found):
                found.append(p)
        if len(found) >= ALL:
            break
    real = [p.real for p in found if _is_real(rows, q, p)]
    return Roots(np.array(real), len(found))


def _missed(rows: Rows, goal: Complex, q: Complex) -> Array:
    """Return by how much the poses of q (k, 6) miss the goal: (k,)."""
    return np.abs(links(rows, q)[-1] - goal).max(axis=(1, 2))


def _is_real(rows: Rows, q: Array, root: Complex) -> bool:
    """Whether a root of the pose of q is real; beside another root that takes more digits."""
    size = float(np.abs(root.imag).max())
    alone = np.linalg.svd(jacobian(links(rows, root[None])), compute_uv=False)[0, -1] > SINGULAR
    return (alone and size < REAL) or (size < NEAR and _imaginary_part(rows, q, root) < EXACT)


def links(rows: Rows, q: Complex) -> list[Complex]:
    """Return the placements (k, 4, 4) of all frames for angles q (k, 6)."""
    T = np.broadcast_to(np.eye(4, dtype=complex), (len(q), 4, 4))
    frames = [T]
    for (a, alpha, d), angle in zip(rows, q.T, strict=True):
        c, s, ca, sa, zero = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha), 0 * angle
        A = np.array(
            [
                [c, -s * ca, s * sa, a * c],
                [s, c * ca, -c * sa, a * s],
                [zero, zero + sa, zero + ca, zero + d],
                [zero, zero, zero, zero + 1],
            ]
        )
        T = T @ A.transpose(2, 0, 1)
        frames.append(T)
    return frames


def jacobian(frames: list[Complex]) -> Complex:
    """Return the geometric Jacobians (k, 6, 6)."""
    end = frames[-1][:, :3, 3]
    columns = [np.hstack([np.cross(T[:, :3, 2], end - T[:, :3, 3]), T[:, :3, 2]]) for T in frames[:-1]]
    return np.stack(columns, axis=2)


def _newton(rows: Rows, goal: Complex, q: Complex) -> Complex:
    """Return the angles that Newton's method leads to from q (k, 6)."""
    for _ in range(STEPS):
        with np.errstate(all="ignore"):
            frames = links(rows, q)
            J = jacobian(frames)
        near = np.abs(J).max(axis=(1, 2)) < FAR  # what has run away does not come back
        q, J, end = q[near], J[near], frames[-1][near]
        M = goal[:3, :3] @ end[:, :3, :3].transpose(0, 2, 1)
        turn = 0.5 * np.stack([M[:, 2, 1] - M[:, 1, 2], M[:, 0, 2] - M[:, 2, 0], M[:, 1, 0] - M[:, 0, 1]], axis=1)
        e = np.concatenate([goal[:3, 3] - end[:, :3, 3], turn], axis=1)
        step = np.linalg.solve(J + 1e-14 * np.eye(6), e[..., None])[..., 0]
        q = q + step / np.maximum(1.0, np.abs(step).max(axis=1, keepdims=True))
    return q


def _imaginary_part(rows: Rows, q: Array, root: Complex) -> float:
    """Return max |Im θ| of a root of the pose of q after Newton's method with 40 digits."""
    with mpmath.workdps(DIGITS):
        goal = _exact_frames(rows, [mpmath.mpc(float(value)) for value in q])[-1]
        x = [mpmath.mpc(complex(value)) for value in root]
        for _ in range(STEPS_OF_MANY_DIGITS):
            frames = _exact_frames(rows, x)
            end, J, e = frames[-1], mpmath.matrix(6, 6), mpmath.matrix(6, 1)
            for i, T in enumerate(frames[:-1]):
                z, arm = T[:3, 2], end[:3, 3] - T[:3, 3]
                J[:3, i], J[3:, i] = _cross(z, arm), z
            M = goal[:3, :3] * end[:3, :3].T
            e[:3, 0] = goal[:3, 3] - end[:3, 3]
            e[3:, 0] = mpmath.matrix([M[2, 1] - M[1, 2], M[0, 2] - M[2, 0], M[1, 0] - M[0, 1]]) / 2
            x = [value + step for value, step in zip(x, mpmath.lu_solve(J, e), strict=True)]
        return float(max(abs(mpmath.im(value)) for value in x))


def _cross(a: mpmath.matrix, b: mpmath.matrix) -> mpmath.matrix:
    return mpmath.matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def _exact_frames(rows: Rows, q: Sequence[mpmath.mpc]) -> list[mpmath.matrix]:
    """Return the placements of all frames, (4, 4) each."""
    frames = [mpmath.eye(4)]
    for (a, alpha, d), angle in zip(rows, q, strict=True):
        c, s, ca, sa = mpmath.cos(angle), mpmath.sin(angle), mpmath.cos(alpha), mpmath.sin(alpha)
        A = [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        frames.append(frames[-1] * mpmath.matrix(A))
    return frames
