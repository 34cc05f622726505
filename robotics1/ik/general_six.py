"""All solutions of six joints without special geometry: the eigenvalues of a matrix pencil, sixteen at most.

In the loop Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 the axis of joint 5, a point p and a direction l, does not feel joint 5. From the
one side it is a matter of joints 2, 3, 4, from the other of joints 0 and 1. Fourteen functions of p and l have no
products of functions of one joint: p, l, |p|², pᵀl, p × l, |p|² l − 2 (pᵀl) p. Eight products of joints 0 and 1 are
eliminated linearly; six equations are left. With half tangents, and each taken once more times that of joint 3, they
are twelve in twelve products of joints 3 and 4, quadratic in the half tangent of joint 2.

Source: Raghavan, Roth, Trans. ASME J. Mech. Design 115, 1993; Manocha, Canny, IEEE Trans. Robotics Automation 10, 1994.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from robotics1.ik.subproblems import inverse, motions
from robotics1.inputs import Array

ANGLES, LENGTHS = np.array([0.0, 0.5 * np.pi, np.pi]), np.array([-1.0, 0.0, 1.0])
OF_ANGLES = np.array([[0.5, 0, 0.5], [0.5, 0, -0.5], [-0.5, 1, -0.5]])  # values at ANGLES → f₀, f₁, f₂
OF_LENGTHS = np.array([[0, 1, 0], [-0.5, 0, 0.5], [0.5, -1, 0.5]])
IN_HALF_TANGENTS = np.array([[1, 1, 0], [0, 0, 2], [1, -1, 0.0]])  # f₀, f₁, f₂ → coefficients of 1, t, t²
OFFSETS = (0.4, 1.5, 2.6)  # [rad] from where joint 2 is counted: its half tangent is then finite at the roots
REGULAR = 1e-9  # 1/condition of the pencil's last matrix
REAL = 0.05  # |Im t|/(1 + |t|²) of a root that may be real
CIRCLE = 0.2  # distance from ±i, the roots of 1 + t²; each is there four times
SEPARATE = 1e-4  # roots at this distance have eigenvectors that differ
ROUNDING = 1e-15


@dataclass(frozen=True)
class Roots:
    """Coordinates that may be solutions.

    Attributes:
        x: (k, 6).
        real: (k,) whether a root is real but for rounding: if it is no solution, something went wrong.
        proven: whether rounding hides no other.
    """

    x: Array
    real: npt.NDArray[np.bool_]
    proven: bool


@dataclass(frozen=True, eq=False)
class GeneralLoop:
    """A loop of six joints.

    Attributes:
        prismatic: of its joints; joint 5 turns.
        left: (14, 3, 3, 3) the fourteen functions in those of joints 2, 3, 4.
    """

    prismatic: tuple[bool, ...]
    left: Array

    def roots(self, A: Sequence[Array]) -> Roots | None:
        """Return candidates for placements A, six (4, 4); None where the pencil is singular."""
        right = self._right(A)
        constant, products = right[:, 0], right[:, 1:]
        null = np.linalg.qr(products, mode="complete")[0][:, 8:].T
        left = self.left.copy()
        left[:, 0, 0, 0] -= constant
        six = np.tensordot(null, left, 1)
        for offset in OFFSETS if not self.prismatic[2] else (0.0,):
            found = self._of_pencil(six, offset)
            if found is not None:
                return replace(found, x=self._completed(A, found.x, products, constant))
        return None

    def _right(self, A: Sequence[Array]) -> Array:
        """Return the fourteen functions in the nine products of joints 0 and 1, (14, 9)."""
        first, second = (LENGTHS if slides else ANGLES for slides in self.prismatic[:2])
        zero = motions(self.prismatic[0], -first) @ inverse(A[5])
        one = motions(self.prismatic[1], -second) @ inverse(A[0])
        frames = inverse(A[1]) @ one @ zero[:, None]
        values = fourteen(frames[..., :3, 3], frames[..., :3, 2])
        found = np.einsum("kij,ai,bj->kab", values, *map(_basis, self.prismatic[:2]))
        return np.asarray(found).reshape(14, 9)

    def _of_pencil(self, six: Array, offset: float) -> Roots | None:
        """Return the roots with coordinates of joints 2, 3, 4 alone, (k, 3); None at a singular pencil."""
        turned = np.eye(3)
        if not self.prismatic[2]:
            c, s = np.cos(offset), np.sin(offset)
            turned[1:, 1:] = [[c, s], [-s, c]]
        maps = [np.eye(3) if slides else IN_HALF_TANGENTS for slides in self.prismatic[2:5]]
        E = np.einsum("kabc,xa,yb,zc->xkyz", six, maps[0] @ turned, maps[1], maps[2])
        M = np.zeros((3, 12, 12))
        M[:, :6, :9], M[:, 6:, 3:] = E.reshape(3, 6, 9), E.reshape(3, 6, 9)
        size = np.linalg.svd(M[2], compute_uv=False)
        if size[-1] < REGULAR * size[0]:
            return None
        companion = np.zeros((24, 24))
        companion[:12, 12:] = np.eye(12)
        companion[12:] = -np.linalg.solve(M[2], np.hstack([M[0], M[1]]))
        return self._real(companion, offset)

    def _real(self, companion: Array, offset: float) -> Roots:
        """Return the roots at eigenvalues that may be real; the others surely are not, or nothing is proven."""
        from scipy.linalg import eig

        t, left, vectors = eig(companion, left=True, right=True, check_finite=False)  # unit columns
        on_circle = (np.abs(t.real) + np.abs(np.abs(t.imag) - 1) < CIRCLE) & (not self.prismatic[2])
        overlap = np.abs((left.conj() * vectors).sum(axis=0))
        doubt = ROUNDING * np.linalg.norm(companion) / np.maximum(overlap, 1e-300)
        near = ~on_circle & (np.abs(t.imag) < np.maximum(REAL * (1 + np.abs(t) ** 2), 10 * doubt))
        others = np.where(np.arange(24) == np.flatnonzero(near)[:, None], np.inf, np.abs(t[near, None] - t))
        proven = bool((doubt[near] < SEPARATE).all() and (others > SEPARATE).all())
        proven = proven and np.count_nonzero(on_circle) == (0 if self.prismatic[2] else 8)
        x = np.empty((np.count_nonzero(near), 3))
        x[:, 0] = t[near].real if self.prismatic[2] else 2 * np.arctan(t[near].real) + offset
        for n, v in enumerate(vectors[:12, near].T):
            x[n, 1:] = self._of_products(v.reshape(4, 3))
        return Roots(x, np.abs(t[near].imag) < 10 * doubt[near], proven)

    def _of_products(self, v: Array) -> list[float]:
        """Return the coordinates of joints 3 and 4 from the products of their half tangents, (4, 3), up to a factor."""
        i, j = (max(int(k), 1) for k in np.unravel_index(np.argmax(np.abs(v)), v.shape))
        found = []
        for slides, below in ((self.prismatic[3], v[i - 1, j]), (self.prismatic[4], v[i, j - 1])):
            high, low = (v[i, j] * np.conj(below)).real, abs(below) ** 2
            found.append(high / max(low, 1e-300) if slides else 2 * np.arctan2(high, low))
        return found

    def _completed(self, A: Sequence[Array], x: Array, products: Array, constant: Array) -> Array:
        """Return all six coordinates, (k, 6), from those of joints 2, 3, 4."""
        found = np.zeros((len(x), 6))
        found[:, 2:5] = x
        Z = [motions(slides, column) for slides, column in zip(self.prismatic[2:5], x.T, strict=True)]
        T = Z[0] @ A[2] @ Z[1] @ A[3] @ Z[2] @ A[4]
        m = np.linalg.pinv(products, rcond=1e-10) @ (fourteen(T[:, :3, 3], T[:, :3, 2]) - constant[:, None])
        found[:, 0] = m[2] if self.prismatic[0] else np.arctan2(m[5], m[2])
        found[:, 1] = m[0] if self.prismatic[1] else np.arctan2(m[1], m[0])
        front = motions(self.prismatic[0], found[:, 0]) @ A[0] @ motions(self.prismatic[1], found[:, 1]) @ A[1]
        around = A[5] @ front @ T  # the inverse of Z₅
        found[:, 5] = np.arctan2(around[:, 0, 1], around[:, 0, 0])
        return found


def general_loop(A: Sequence[Array], prismatic: Sequence[bool]) -> GeneralLoop:
    """Return what a loop has in common for all targets: A are placements (4, 4); 2, 3 and 4 of them matter."""
    Z = [motions(slides, LENGTHS if slides else ANGLES) for slides in prismatic[2:5]]
    frames = (Z[0] @ A[2])[:, None, None] @ (Z[1] @ A[3])[:, None] @ (Z[2] @ A[4])
    values = fourteen(frames[..., :3, 3], frames[..., :3, 2])
    left = np.einsum("kxyz,ax,by,cz->kabc", values, *map(_basis, prismatic[2:5]))
    return GeneralLoop(tuple(prismatic), left)


def fourteen(p: Array, axis: Array) -> Array:
    """Return p, l, |p|², pᵀl, p × l, |p|² l − 2 (pᵀl) p of points and directions (..., 3): (14, ...)."""
    square, along = (p * p).sum(axis=-1, keepdims=True), (p * axis).sum(axis=-1, keepdims=True)
    (x, y, z), (a, b, c) = np.moveaxis(p, -1, 0), np.moveaxis(axis, -1, 0)
    moment = np.stack([y * c - z * b, z * a - x * c, x * b - y * a], axis=-1)
    parts = [p, axis, square, along, moment, square * axis - 2 * along * p]
    return np.moveaxis(np.concatenate(parts, axis=-1), -1, 0)


def _basis(slides: bool) -> Array:
    return OF_LENGTHS if slides else OF_ANGLES
