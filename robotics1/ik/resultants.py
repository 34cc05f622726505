"""The common roots of two equations in two angles, of any degree, by a resultant.

With w = e^{iθ} an equation is Σ c_{jk} w₁ʲ w₂ᵏ, with j and k from −degree to degree. The resultant in w₂ is a
polynomial in w₁. It is sampled on the unit circle, where the real roots are: there interpolation is as exact as the
samples. There are more samples than coefficients. What they leave beside the coefficients is rounding, and tells the
doubt of each root.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array

Coefficients = npt.NDArray[np.complex128]

SAMPLES = 64  # of a resultant, more than twice as many as it has coefficients
ROUNDING = 1e-15  # of the samples, at least
ABSENT = 1e-9  # of a resultant of equations of size 1: its roots are not to be trusted
DIVIDES = 1e-11  # of what a division leaves
REAL = 0.05  # distance from the unit circle of a root that may be real
SEPARATE = 1e-4  # roots at this distance are two


class CommonAngles(NamedTuple):
    """Angles that may be common roots.

    Attributes:
        angles: (k, 2).
        real: (k,) whether each is real but for rounding.
        proven: whether rounding hides no other.
    """

    angles: Array
    real: npt.NDArray[np.bool_]
    proven: bool


def sampled(f: Callable[[Array, Array], Array], degrees: tuple[int, int]) -> Coefficients:
    """Return the coefficients, (2 m + 1, 2 n + 1), of a function of two angles with the degrees m and n."""
    m, n = (2 * degree + 1 for degree in degrees)
    x, y = np.meshgrid(2 * np.pi / m * np.arange(m), 2 * np.pi / n * np.arange(n), indexing="ij")
    return np.asarray(np.fft.fftshift(np.fft.fft2(f(x, y))) / (m * n))


def common_angles(F: Coefficients, G: Coefficients, *, flipped: bool, most: int) -> CommonAngles | None:
    """Return the angles at which F = G = 0, from a resultant in the first.

    Args:
        F, G: the equations.
        flipped: whether the resultant is in the second.
        most: how many roots there are, complex ones too, at most.

    Returns:
        None if the resultant vanishes: the equations have a common factor.
    """
    sizes = np.abs(F).max(), np.abs(G).max()
    if min(sizes) < ABSENT:
        return None
    F, G = F / sizes[0], G / sizes[1]
    if flipped:
        F, G = F.T, G.T
    c, noise = _resultant(F, G)
    size = np.abs(c).max()
    if size < ABSENT:
        return None
    c, noise = _reduced(F, c / size, max(noise, ROUNDING) / size, most)
    if len(c) < 2:
        return CommonAngles(np.zeros((0, 2)), np.zeros(0, dtype=bool), True)
    w = np.roots(c[::-1])
    doubt = noise * len(c) / np.maximum(np.abs(np.polyval(np.polyder(c[::-1]), w)), 1e-300)
    off = np.abs(np.abs(w) - 1.0)
    near = off < np.maximum(REAL, 10 * doubt)
    others = np.where(np.arange(len(w)) == np.flatnonzero(near)[:, None], np.inf, np.abs(w[near, None] - w))
    proven = bool((doubt[near] < SEPARATE).all() and (others > SEPARATE).all())
    pairs = [(float(np.angle(root)), _second(F, G, root)) for root in w[near]]
    angles = np.array(pairs).reshape(-1, 2)
    return CommonAngles(angles[:, ::-1] if flipped else angles, (off < 10 * doubt)[near], proven)


def _resultant(F: Coefficients, G: Coefficients) -> tuple[Coefficients, float]:
    """Return the resultant of the polynomials in w₂, and its rounding: the determinant of Sylvester's matrix."""
    w = np.exp(2j * np.pi / SAMPLES * np.arange(SAMPLES))
    f, g = _powers(w, len(F)) @ F, _powers(w, len(G)) @ G
    m, n = f.shape[1] - 1, g.shape[1] - 1
    S = np.zeros((SAMPLES, m + n, m + n), dtype=complex)
    for k in range(n):
        S[:, k, k : k + m + 1] = f
    for k in range(m):
        S[:, n + k, k : k + n + 1] = g
    c = np.fft.fftshift(np.fft.fft(np.linalg.det(S))) / SAMPLES
    degree, middle = n * (len(F) // 2) + m * (len(G) // 2), SAMPLES // 2
    inside = np.abs(np.arange(SAMPLES) - middle) <= degree
    return c[inside], float(np.abs(c[~inside]).max())


def _reduced(F: Coefficients, c: Coefficients, noise: float, most: int) -> tuple[Coefficients, float]:
    """Return the polynomial without the roots at which w₂ is 0 or ∞, which are none: there F loses its outer terms."""
    c = _trimmed(c, noise)
    outer = _trimmed(np.convolve(F[:, 0], F[:, -1]), ROUNDING)
    while len(outer) > 1 and len(c) > max(most + 1, len(outer)):
        M = np.zeros((len(c), len(c) - len(outer) + 1), dtype=complex)
        for k in range(M.shape[1]):
            M[k : k + len(outer), k] = outer
        quotient = np.linalg.lstsq(M, c, rcond=None)[0]
        left = np.abs(M @ quotient - c).max()
        if left > DIVIDES:
            break
        size = np.abs(quotient).max()
        c, noise = quotient / size, max(noise, float(left)) / min(size, 1.0)
    return c, noise


def _trimmed(c: Coefficients, noise: float) -> Coefficients:
    """Return coefficients without those at the ends that are zero but for rounding."""
    significant = np.flatnonzero(np.abs(c) > 100 * noise * np.abs(c).max())
    return c[significant[0] : significant[-1] + 1] if len(significant) else c[:0]


def _second(F: Coefficients, G: Coefficients, w: complex) -> float:
    """Return the second angle at which both equations are as small as they can be, where the first has e^{iθ} = w."""
    both = [_powers(np.array([w]), len(C))[0] @ C for C in (F, G)]
    v = np.concatenate([np.roots(c[::-1]) for c in both if np.abs(c).max() > ABSENT] or [np.ones(1)])
    v = v[np.abs(np.abs(v) - 1.0) < 0.5] if (np.abs(np.abs(v) - 1.0) < 0.5).any() else np.ones(1, dtype=complex)
    misses = sum(np.abs(_powers(v, len(c)) @ c) for c in both)
    return float(np.angle(v[np.argmin(misses)]))


def _powers(w: Coefficients, count: int) -> Coefficients:
    """Return w^k for k from −(count − 1)/2 to (count − 1)/2, (..., count)."""
    return np.asarray(w[:, None] ** np.arange(-(count // 2), count // 2 + 1))
