"""All solutions of six joints of which four turn and two slide: the roots of a polynomial of degree eight.

In the loop Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 slides turn nothing. So the four that turn are a spherical linkage,
Z(θ₁) B₁ Z(θ₂) B₂ Z(θ₃) B₃ Z(θ₄) B₄ = 1. The angle between the axes 3 and 4 is an equation F(θ₁, θ₂) = 0. Where it
holds, cosines and sines of θ₃ and θ₄ are polynomials in those of θ₁ and θ₂.

Behind each Z(θ_k) is a gap, a vector b_k. Two slides d u and d' u' are in two gaps, or both in one. Seen from one frame
the gaps and the slides add up to zero. So det(u, u', Σ b_k) = 0, which is a second equation, G(θ₁, θ₂) = 0. The
resultant of F and G is a polynomial in θ₁. The slides follow linearly.

Source: Raghavan, Roth, Trans. ASME J. Mech. Design 115, 1993; Duffy, Analysis of Mechanisms and Robot
Manipulators, 1980.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.ik.general_six import Roots
from robotics1.ik.resultants import Coefficients, common_angles, sampled
from robotics1.inputs import Array

MOST = 8  # solutions, complex ones too
PARALLEL = 1e-6  # sine of the angle of axes 3 and 4 that gives no equation
# before θ₁, between θ₁ and θ₂, and behind θ₂: the degrees in θ₁ and θ₂ with which the gaps are seen from there
DEGREES: tuple[dict[int, tuple[int, int]], ...] = (
    {3: (0, 0), 0: (1, 0), 1: (1, 1), 2: (1, 1)},
    {0: (0, 0), 3: (1, 0), 1: (0, 1)},
    {1: (0, 0), 0: (0, 1), 3: (1, 1), 2: (1, 1)},
)
Term = list[tuple[int, Array]]  # two or three vectors with their gaps, whose product is a part of G


@dataclass(frozen=True, eq=False)
class Linkage:
    """Four joints that turn, in a loop.

    Attributes:
        B: four rotations (3, 3), each behind a joint.
        b: four vectors (3,), each behind a joint and before its rotation.
        slides: the gap and the direction of both joints that slide.
    """

    B: list[Array]
    b: list[Array]
    slides: list[tuple[int, Array]]

    def turns(self, x: Array, y: Array) -> tuple[Array, Array, Array]:
        """Return the rotations by θ₃ and by θ₄, (..., 3, 3), which hold where F = 0, and F, for angles θ₁ and θ₂."""
        M = self.B[3] @ _about_z(np.cos(x), np.sin(x)) @ self.B[0] @ _about_z(np.cos(y), np.sin(y)) @ self.B[1]
        third = _turning(self.B[2][:, 2], M[..., 2, :], self.sine)
        fourth = _turning(M[..., :, 2], self.B[2][2], self.sine)
        return third, fourth, np.asarray(M[..., 2, 2] - self.B[2][2, 2])

    @property
    def sine(self) -> float:
        """The sine of the angle between the axes 3 and 4."""
        return float(np.hypot(*self.B[2][:2, 2]))

    def seen(self, x: Array, y: Array) -> list[dict[int, Array]]:
        """Return, for each of the frames of `DEGREES`, the rotations (..., 3, 3) to it from the gaps."""
        X, Y = _about_z(np.cos(x), np.sin(x)), _about_z(np.cos(y), np.sin(y))
        third, fourth, _ = self.turns(x, y)
        B, one = self.B, np.broadcast_to(np.eye(3), X.shape)
        back = _inverse(X) @ B[3].T
        return [
            {3: one @ B[3].T, 0: X, 1: X @ B[0] @ Y, 2: B[3].T @ _inverse(fourth) @ B[2].T},
            {0: one, 3: back, 1: B[0] @ Y},
            {1: one, 0: _inverse(Y) @ B[0].T, 3: _inverse(Y) @ B[0].T @ back, 2: B[1] @ third},
        ]

    def terms(self) -> list[Term]:
        """Return what adds up to G = det(u, u', Σ b_k); vectors of one gap are multiplied there."""
        (i, u), (j, v) = self.slides
        found: list[Term] = []
        for k, b in enumerate(self.b):
            if i == j:
                found.append([(i, np.cross(u, v)), (k, b)])
            elif k == i:
                found.append([(i, np.cross(b, u)), (j, v)])
            elif k == j:
                found.append([(i, u), (j, np.cross(v, b))])
            else:
                found.append([(i, u), (j, v), (k, b)])
        return found

    def equations(self) -> tuple[Coefficients, Coefficients]:
        """Return F and G."""
        terms = self.terms()
        views = [_view(term) for term in terms]
        degrees = np.max([degree for _, degree in views], axis=0)

        def G(x: Array, y: Array) -> Array:
            seen = self.seen(x, y)
            return np.asarray(sum(_product(term, seen[k]) for term, (k, _) in zip(terms, views, strict=True)))

        return sampled(lambda x, y: self.turns(x, y)[2], (1, 1)), sampled(G, (int(degrees[0]), int(degrees[1])))

    def completed(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Return the four angles, (k, 4), and the two slides, (k, 2), from θ₁ and θ₂, (k,)."""
        third, fourth, _ = self.turns(x, y)
        first = self.seen(x, y)[0]
        gaps = sum(first[k] @ b for k, b in enumerate(self.b))
        U = np.stack([first[k] @ u for k, u in self.slides], axis=-1)
        d = -(np.linalg.pinv(U) @ np.asarray(gaps)[..., None])[..., 0]
        others = [np.arctan2(turn[:, 1, 0], turn[:, 0, 0]) for turn in (third, fourth)]
        return np.column_stack([x, y, *others]), d


def roots_of_two_slides(A: list[Array], prismatic: tuple[bool, ...], begin: int, *, flipped: bool) -> Roots | None:
    """Return candidates for placements A, six (4, 4); None where θ₁ and θ₂ do not determine the others.

    Args:
        A: of the loop, each behind a joint.
        prismatic: of the six joints, two of which slide.
        begin: the joint that is θ₁.
        flipped: whether θ₁ is eliminated, and not θ₂.
    """
    slides = np.array(prismatic[begin:] + prismatic[:begin])
    linkage = _linkage(A[begin:] + A[:begin], slides)
    if linkage.sine < PARALLEL:
        return None
    found = common_angles(*linkage.equations(), flipped=flipped, most=MOST)
    if found is None:
        return None
    x = np.zeros((len(found.angles), 6))
    x[:, ~slides], x[:, slides] = linkage.completed(*found.angles.T)
    return Roots(np.roll(x, begin, axis=1), found.real, found.proven)


def _linkage(A: Sequence[Array], slides: npt.NDArray[np.bool_]) -> Linkage:
    """Return the linkage of a loop whose first joint turns."""
    ends: list[Array] = []
    directions: list[tuple[int, Array]] = []
    T = A[0]
    for slide, placement in zip(slides[1:], A[1:], strict=True):
        if slide:
            directions.append((len(ends), T[:3, 2]))
        else:
            ends.append(T)
            T = np.eye(4)
        T = T @ placement
    ends.append(T)
    return Linkage([T[:3, :3] for T in ends], [T[:3, 3] for T in ends], directions)


def _view(term: Term) -> tuple[int, Array]:
    """Return the frame from which a term has the lowest degrees, and these."""
    gaps = {k for k, _ in term}
    views = [(n, np.sum([of[k] for k in gaps], axis=0)) for n, of in enumerate(DEGREES) if gaps <= of.keys()]
    return min(views, key=lambda view: int(view[1].sum()))


def _product(term: Term, seen: dict[int, Array]) -> Array:
    """Return the scalar or triple product of the vectors of a term."""
    if term[0][0] == term[1][0]:
        return np.asarray(term[0][1] @ term[1][1])
    u, v, *rest = [seen[k] @ vector for k, vector in term]
    return np.asarray((np.cross(u, v) * rest[0] if rest else u * v).sum(axis=-1))


def _about_z(c: Array, s: Array) -> Array:
    """Return the rotations (..., 3, 3) of cosines and sines."""
    R = np.zeros((*c.shape, 3, 3))
    R[..., 0, 0] = R[..., 1, 1] = c
    R[..., 1, 0], R[..., 0, 1], R[..., 2, 2] = s, -s, 1.0
    return R


def _turning(p: Array, t: Array, radius: float) -> Array:
    """Return the rotation about z that turns p to t, whose distances from z are the radius, as a polynomial in both."""
    c = (p[..., 0] * t[..., 0] + p[..., 1] * t[..., 1]) / radius**2
    s = (p[..., 0] * t[..., 1] - p[..., 1] * t[..., 0]) / radius**2
    return _about_z(c, s)


def _inverse(R: Array) -> Array:
    return np.swapaxes(R, -1, -2)
