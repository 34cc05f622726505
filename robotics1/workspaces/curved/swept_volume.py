"""The volume that a first joint with limits sweeps with a section: V = ∫ L ρ dA where it turns, ∫ L dA where it slides.

At a place of the section the solutions of the other joints have the coordinates w₁, ..., w_N of the first joint, at its
lower limit; with a range s they reach the union of the intervals [wᵢ, wᵢ + s], of length L. Across a strip, L is smooth
but where two intervals begin or end together, wᵢ − wⱼ = 0 or ± s. There the inner integral is cut; the outer one, along
the strip, is adaptive.

With x = a + (b − a) sin²(φ/2) what is like a root at the edges a, b of a strip, where two solutions meet, is smooth in
φ. So w(φ) is read from a few values by Chebyshev's polynomials.

Source: Trefethen, Approximation Theory and Approximation Practice, 2019, chapters 2 and 8.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import tau

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.curved.curved_section import CurvedSection
from robotics1.workspaces.curved.followed_solutions import solutions_across, solutions_along, solutions_one_by_one
from robotics1.workspaces.curved.image_curves import TURNED
from robotics1.workspaces.curved.strips import Strip

NODES = (17, 33, 65)  # values of w across a strip, more where so many are too few; the middle is one of all
FINE = np.linspace(-1, 1, 97)  # where it is looked for intervals that begin or end together
GAUSS = np.polynomial.legendre.leggauss(16)
FEWER, MORE = (np.polynomial.legendre.leggauss(k) for k in (8, 12))  # along a strip: two rules, that tell the error
ROUNDS = 4  # a part of a strip is halved three times at most
TOLERANCE = 1e-6  # of a part, by the cube of the size of the arm
THIN = 1e-9  # of a level, by the arm's size
ALIKE = 1e-9  # rad or sizes: a difference that is no difference

_S = np.concatenate([FEWER[0], MORE[0]])
_ORDER = np.argsort(_S)
_WEIGHTS = np.zeros((2, len(_S)))
_WEIGHTS[0, :8], _WEIGHTS[1, 8:] = FEWER[1], MORE[1]


@dataclass(frozen=True, eq=False)
class SweptStrips:
    """Strips in which several solutions reach each place, as many in each, and the length of the first joint's range.

    Attributes:
        section, strips: the section of the arm, and its strips.
        span: upper − lower of the first joint [rad or sizes].
    """

    section: CurvedSection
    strips: Sequence[Strip]
    span: float

    def volume(self) -> tuple[float, float]:
        """Return what the first joint sweeps with the strips, and about how wrong it is [sizes³]."""
        heights = self.section.strips.heights
        high = [k for k, strip in enumerate(self.strips) if np.diff(heights[strip.level : strip.level + 2]) > THIN]
        of, low, length = np.array(high, dtype=np.intp), np.zeros(len(high)), np.ones(len(high))
        total, wrong = 0.0, 0.0
        for i in range(ROUNDS):
            if not len(of):
                break
            value, error = self._parts(of, low, length)
            good = (error < TOLERANCE) | (i == ROUNDS - 1)
            total, wrong = total + float(value[good].sum()), wrong + float(error[good].sum())
            half = length[~good] / 2
            of, low, length = np.tile(of[~good], 2), np.concatenate([low[~good], low[~good] + half]), np.tile(half, 2)
        return total, wrong

    def _parts(self, of: npt.NDArray[np.intp], low: Array, length: Array) -> tuple[Array, Array]:
        """Return the integrals over parts of strips, shares of half a turn from `low` on, and how wrong they may be."""
        level = np.array([self.strips[k].level for k in of])
        bottom, top = (self.section.strips.heights[level + i][:, None] for i in (0, 1))
        angle = np.pi * (low[:, None] + length[:, None] * (1 + _S[_ORDER]) / 2)
        found = self._across(of, bottom + (top - bottom) * np.sin(angle / 2) ** 2)
        rate = (top - bottom) * np.pi / 2 * np.sin(angle) * length[:, None] / 2
        fewer, more = np.einsum("ks,ksc,ws->wkc", rate, found, _WEIGHTS[:, _ORDER])
        return more[:, 0], np.abs(more[:, 0] - fewer[:, 0]) + more[:, 1]

    def _across(self, of: npt.NDArray[np.intp], up: Array) -> Array:
        """Return ∫ L ρ dx, or ∫ L dx, across strips at heights (k, s), and about how wrong it is: (k, s, 2)."""
        pieces = self.section.strips.pieces
        a, b = np.empty_like(up), np.empty_like(up)
        for row, k in enumerate(of):
            edges = (i for i in (self.strips[k].left, self.strips[k].right) if i is not None)
            a[row], b[row] = (pieces[i].across(up[row]) for i in edges)
        return self._rows(up, a, b)

    def _rows(self, up: Array, a: Array, b: Array) -> Array:
        """Return the same of lines from (a, up) to (b, up), (k, s) of them: (k, s, 2)."""
        middle = solutions_along(self.section, np.stack([(a + b) / 2, up], axis=-1) @ TURNED, self.strips[0].count)
        middle = middle.reshape(-1, *middle.shape[2:])
        found, left = np.zeros((up.size, 2)), np.arange(up.size)
        lines = np.stack([e.ravel() for e in (up, a, b)], axis=1)
        for nodes, follow in (*((count, True) for count in NODES), (NODES[1], False)):
            at = np.cos((np.arange(nodes)[::-1] + 0.5) * np.pi / nodes)
            w, missing = self._starts(lines[left], middle[left] if follow else None, at)
            to_coefficients = np.linalg.inv(np.polynomial.chebyshev.chebvander(at, nodes - 1))
            coefficients = np.einsum("cn,knj->kcj", to_coefficients, w)
            tail = np.abs(coefficients[:, -2:]).max(axis=(1, 2))
            width = np.maximum(lines[left, 2] - lines[left, 1], 0.0)
            found[left, 0] = [self._along(*row) for row in zip(coefficients, lines[left], strict=True)]
            found[left, 1] = width * np.where(missing, self.span, tail)
            unsure = found[left, 1] > TOLERANCE
            left = left[unsure & missing if nodes == NODES[-1] else unsure]
            if not len(left):
                break
        return found.reshape(*up.shape, 2)

    def _starts(self, lines: Array, middle: Array | None, at: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Return w (k, n, N) along lines (up, a, b), and on which of them solutions are missing."""
        up, a, b = lines.T[:, :, None]
        x = a + (b - a) * np.sin(np.pi / 4 * (1 + at)) ** 2
        z = np.stack([x, np.broadcast_to(up, x.shape)], axis=-1) @ TURNED
        if middle is None:
            q, missing = solutions_one_by_one(self.section, z, self.strips[0].count)
        else:
            q, missing = solutions_across(self.section, middle, z, at)
        p, base = self.section.arm.mapped.point(q.reshape(-1, 2)), self.section.place.base
        if base is None or not base.revolute:
            return p[:, 2].reshape(q.shape[:-1]), missing
        return np.unwrap(np.arctan2(p[:, 1], p[:, 0]).reshape(q.shape[:-1]), axis=1), missing

    def _along(self, coefficients: Array, line: Array) -> float:
        """Return the integral along one line, of polynomials w (n, N)."""
        up, a, b = line
        cuts = np.unique(np.concatenate([[-1.0, 1.0], self._together(coefficients)]))
        nodes, weights = GAUSS
        half = np.diff(cuts)[:, None] / 2
        y = (cuts[:-1, None] + half * (1 + nodes)).ravel()
        phi = np.pi / 2 * (1 + y)
        x = a + (b - a) * np.sin(phi / 2) ** 2
        density = self._lengths(np.polynomial.chebyshev.chebvander(y, len(coefficients) - 1) @ coefficients)
        if self.section.place.about_axis:
            density = density * (np.column_stack([x, np.full_like(x, up)]) @ TURNED)[:, 0]
        return float((density * (b - a) * np.pi / 4 * np.sin(phi) * (half * weights).ravel()).sum())

    def _together(self, coefficients: Array) -> Array:
        """Return where two intervals begin together, or one begins where the other ends, as values of −1 to 1."""
        w = np.polynomial.chebyshev.chebvander(FINE, len(coefficients) - 1) @ coefficients
        i, j = np.triu_indices(w.shape[1], 1)
        d = (w[:, i] - w[:, j])[..., None] + np.array([0.0, self.span, -self.span])
        return _zeros((np.sin(d / 2) if self.section.place.about_axis else d).reshape(len(FINE), -1))

    def _lengths(self, w: Array) -> Array:
        """Return the lengths (k,) of the unions of intervals that begin at w (k, N)."""
        if not self.section.place.about_axis:
            gaps = np.diff(np.sort(w, axis=1), axis=1)
            return np.asarray(np.minimum(gaps, self.span).sum(axis=1) + self.span)
        around = np.sort(w % tau, axis=1)
        gaps = np.diff(np.column_stack([around, around[:, 0] + tau]), axis=1)
        return np.asarray(np.minimum(gaps, self.span).sum(axis=1))


def _zeros(d: Array) -> Array:
    """Return where smooth functions with values d (k, m) at `FINE` are zero, by parabolas, but for those that are 0."""
    d = d[:, np.abs(d).max(axis=0) > ALIKE]
    before, here, after = d[:-2], d[1:-1], d[2:]
    curve, slope = (before - 2 * here + after) / 2, (after - before) / 2  # d = here + slope t + curve t², in steps
    with np.errstate(invalid="ignore", divide="ignore"):
        root = np.sqrt(slope**2 - 4 * curve * here)
        larger = -(slope + np.where(slope < 0, -root, root)) / 2
        t = np.stack([larger / curve, here / larger])
        places = (FINE[1:-1, None] + t * (FINE[1] - FINE[0]))[np.abs(t) <= 1]
    return np.asarray(np.clip(places, -1, 1))
