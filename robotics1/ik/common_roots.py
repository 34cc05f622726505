"""The common roots of two equations in two joint coordinates, each at most quadratic in both.

A revolute coordinate θ enters as w = e^{iθ}: A + B cos θ + C sin θ = c₋ w⁻¹ + c₀ + c₊ w. A prismatic coordinate d is
its own w. One coordinate is eliminated by the resultant of two quadratics, a polynomial in the other whose roots are
the eigenvalues of its companion matrix: none is missed.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.angles import without_turns
from robotics1.inputs import Array

Complex = npt.NDArray[np.complex128]

ANGLES = 2 * np.pi / 3 * np.arange(3)
LENGTHS = np.array([-1.0, 0.0, 1.0])
POWERS = np.arange(3)
OF_ANGLES = np.linalg.inv(np.exp(1j * np.outer(ANGLES, POWERS - 1)))
OF_LENGTHS = np.linalg.inv(LENGTHS[:, None] ** POWERS).astype(complex)
ZERO = 1e-12  # of a coefficient, beside the largest
VANISHES = 1e-9  # of a resultant, the equations having coefficients of 1: below, its roots are not to be trusted
NEAR = 0.02  # of a root that may be real: multiple roots split by rounding, and near misses are looked at too
MISS = 1e-4  # residual of a common root: those that miss are seen, so that a near boundary is
ARBITRARY, NEARLY_ARBITRARY = 1e-6, 1e-2  # coefficients of both equations, where any value solves them, or may
PLAUSIBLE = 0.02  # residual of a pair of roots with which Newton's method begins
RANK = 1e-9  # σ beside σ₁, in a step
EXACT, SAME = 1e-13, 1e-8  # of a step, and of the distance of two roots that are one
DOUBTFUL, LOST = 1e-4, 1e-2  # coefficients of both that are near zero, and how far a root may then be
ALONE = -1  # a root that is no member of a family
MEMBERS = 24  # of a family of angles: for some of them the rest of an arm may not reach
STEPS = 12  # of Newton's method, which converges slowly to a double root


class CommonRoots(NamedTuple):
    """The coordinates x, (k, 2), at which two equations vanish, and the `family` of each, (k,): ALONE, or a number that
    roots share whose second coordinate is arbitrary.
    """

    x: Array
    family: npt.NDArray[np.int64]


def samples(prismatic: bool) -> Array:
    """Return the three coordinates at which an equation is evaluated: they determine its three coefficients."""
    return LENGTHS if prismatic else ANGLES


def coefficients(values: Array, prismatic: Sequence[bool]) -> Complex:
    """Return the coefficients, one axis a coordinate, of an equation from its values at all samples."""
    c = np.asarray(values, dtype=complex)
    for axis, slides in enumerate(prismatic):
        c = np.moveaxis(np.tensordot(OF_LENGTHS if slides else OF_ANGLES, c, (1, axis)), 0, axis)
    return c


def real_roots(c: Complex, prismatic: bool) -> Array | None:
    """Return the coordinates that solve Σ c_k w^k = 0, nearly real roots too; None if all c vanish."""
    largest = np.abs(c).max()
    if largest == 0:
        return None
    significant = np.flatnonzero(np.abs(c) > ZERO * largest)
    w = np.roots(c[significant[0] : significant[-1] + 1][::-1])
    if prismatic:
        found = w[np.abs(w.imag) < NEAR * np.maximum(1.0, np.abs(w))].real
        return np.append(found, 0.0) if significant[0] > 0 else np.asarray(found)
    return np.asarray(np.angle(w[np.abs(np.abs(w) - 1.0) < NEAR]))


def common_roots(F: Complex, G: Complex, prismatic: Sequence[bool]) -> CommonRoots | None:
    """Return the coordinates at which F = G = 0; of one that is arbitrary there some values.

    Args:
        F, G: (3, 3) coefficients of w₁^i w₂^j; of angles the powers begin at −1.
        prismatic: of the two coordinates.

    Returns:
        None if the resultants vanish: the equations have a common factor, or they are nearly dependent.
    """
    sizes = np.abs(F).max(), np.abs(G).max()
    if min(sizes) < ZERO * max(*sizes, 1.0):
        return None  # an equation of lengths and sines of about 1 that is rounding tells nothing
    F, G = F / sizes[0], G / sizes[1]
    for order in ((0, 1), (1, 0)):
        A, B = F.transpose(order), G.transpose(order)
        first, second = prismatic[order[0]], prismatic[order[1]]
        c = _resultant(A, B, second)
        if c is None or np.abs(c).max() < VANISHES:
            continue
        of_first = _distinct(real_roots(c, first))
        starts = [(x, y) for x in of_first for y in _second(A, B, x, first, second)]
        roots = _polished(F, G, np.array(starts).reshape(-1, 2)[:, order], prismatic)
        free = [x for x in of_first if _size(*_in_the_second(A, B, x, first)) < DOUBTFUL]
        family = np.full(len(roots), ALONE)
        for k, x in enumerate(free):
            family[np.abs(difference(roots[:, order[0]], x, first)) < LOST] = k
        if len(set(family) - {ALONE}) < len(free):
            return None  # a family is at hand, and was not met
        return CommonRoots(roots, family)
    return None


def _resultant(A: Complex, B: Complex, prismatic: bool) -> Complex | None:
    """Return the polynomial in the first coordinate that vanishes where A and B have a common root in the second."""
    others = (1, 2) if prismatic else (0, 2)
    for C in (A, B):
        if np.abs(C[:, others]).max() < ZERO:  # the second coordinate does not enter: C itself is it
            return C[:, 0 if prismatic else 1]
    (a0, a1, a2), (b0, b1, b2) = A.T, B.T

    def minor(a: Complex, b: Complex, c: Complex, d: Complex) -> Complex:
        return np.asarray(np.convolve(a, d) - np.convolve(b, c))

    low = minor(a0, a1, b0, b1)
    if max(np.abs(a2).max(), np.abs(b2).max()) < ZERO:
        return low
    middle = minor(a0, a2, b0, b2)
    return np.asarray(np.convolve(middle, middle) - np.convolve(low, minor(a1, a2, b1, b2)))


def _distinct(x: Array | None) -> Array:
    """Return the roots without those that are within rounding of another."""
    return np.zeros(0) if x is None else np.unique(np.round(x, 13))


def _second(A: Complex, B: Complex, x: float, first: bool, second: bool) -> Array:
    """Return what may be the second coordinate where the first is x: the roots of either equation."""
    a, b = _in_the_second(A, B, x, first)
    members = samples(second) if second else 2 * np.pi / MEMBERS * np.arange(MEMBERS)
    anywhere = members if _size(a, b) < NEARLY_ARBITRARY else np.zeros(0)
    of_a, of_b = (real_roots(c, second) if np.abs(c).max() > ARBITRARY else None for c in (a, b))
    return np.concatenate([anywhere, _distinct(of_a), _distinct(of_b)])


def _in_the_second(A: Complex, B: Complex, x: float, prismatic: bool) -> tuple[Complex, Complex]:
    """Return the coefficients, (3,) each, of both equations in the second coordinate, where the first is x."""
    w = _powers(np.array([x]), prismatic)[0]
    return w @ A, w @ B


def _size(a: Complex, b: Complex) -> float:
    return float(max(np.abs(a).max(), np.abs(b).max()))


def _powers(x: Array, prismatic: bool) -> Complex:
    """Return w^k of coordinates (k,), (k, 3)."""
    return np.asarray(x[:, None] ** POWERS if prismatic else np.exp(1j * np.outer(x, POWERS - 1)), dtype=complex)


def _rates(w: Complex, prismatic: bool) -> Complex:
    """Return the derivatives of w^k by the coordinate, (k, 3)."""
    if prismatic:
        return np.column_stack([0 * w[:, 0], w[:, 0], 2 * w[:, 1]])
    return w * (1j * (POWERS - 1))


def _polished(F: Complex, G: Complex, x: Array, prismatic: Sequence[bool]) -> Array:
    """Return those of the starts (k, 2) that Newton's method leads to a common root, each once."""
    both = np.stack([F, G])
    x = x[np.abs(_values_and_jacobians(both, x, prismatic)[0]).max(axis=1, initial=0.0) < PLAUSIBLE]
    for _ in range(STEPS):
        e, J = _values_and_jacobians(both, x, prismatic)
        step = (np.linalg.pinv(J, rcond=RANK) @ e[..., None])[..., 0]
        size = np.abs(step).max(axis=1, keepdims=True, initial=0.0)
        x = x - step / np.maximum(1.0, 4 * size)
        if not size.max(initial=0.0) > EXACT:
            break
    x = x[np.abs(_values_and_jacobians(both, x, prismatic)[0]).max(axis=1, initial=0.0) < MISS]
    found: list[Array] = []
    for p in x:
        if all(np.abs(difference(p, q, prismatic)).max() > SAME for q in found):
            found.append(p)
    return np.array(found).reshape(-1, 2)


def _values_and_jacobians(both: Complex, x: Array, prismatic: Sequence[bool]) -> tuple[Array, Array]:
    """Return both equations at coordinates (k, 2), (k, 2), and their derivatives by these, (k, 2, 2)."""
    u, v = (_powers(x[:, i], prismatic[i]) for i in range(2))
    du, dv = _rates(u, prismatic[0]), _rates(v, prismatic[1])
    values = [((u @ C) * v).sum(axis=1) for C in both]
    rates = [[((du @ C) * v).sum(axis=1), ((u @ C) * dv).sum(axis=1)] for C in both]
    return np.transpose(values).real, np.transpose(rates, (2, 0, 1)).real


def difference(p: Array | float, q: Array, prismatic: Sequence[bool] | bool) -> Array:
    """Return p − q, angles the short way round."""
    return np.where(prismatic, p - q, without_turns(p - q))
