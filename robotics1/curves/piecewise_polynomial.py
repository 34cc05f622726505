"""Polynomials one after the other: motions between states, velocity profiles, splines, parabolic blends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import perm
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import polynomial

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve, piece_at
from robotics1.curves.drawing import polynomial_text
from robotics1.curves.interpolants import minimum_and_maximum
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, dimensions, positive_number, real_array, real_number

JUMP, NOISE = 1e-9, 1e-13  # of a coordinate's largest value in the two pieces, and in all: a smaller jump is rounding
NEWTON = 3  # steps: from three digits to all


MOST_WRITTEN = 12  # polynomials that are written out


@dataclass(frozen=True, eq=False)
class PiecewisePolynomial(Curve):
    """q(t) = Σₖ c[K − k, i] τᵏ on the i-th piece, with τ = (t − xᵢ)/Tᵢ, the highest power K first.

    It is `scipy.interpolate.PPoly` but for two things. Powers of τ in place of t − xᵢ: a polynomial between two states
    keeps whole numbers as coefficients, and no power of a short duration leaves the range of floating-point numbers.
    Durations in place of the ends x of the pieces: one of them may be as short as the rounding of x.

    Attributes:
        c: (K + 1, m, n) the coefficients of m pieces and n coordinates, or (K + 1, m) of a timing law.
        durations: (m,) the Tᵢ, positive; one piece alone may have none, with τ = t.
    """

    c: Array
    durations: Array

    def __post_init__(self) -> None:
        """Refuse what are no coefficients of pieces in a row."""
        c = real_array("c", self.c, (None, None, None)[: 2 + (dimensions("c", self.c) > 2)], "coefficients, pieces")
        T = real_array("durations", self.durations, (c.shape[1],), "one for each piece")
        if not c.shape[0] or not c.shape[1] or T[0] < 0 or (len(T) > 1 and (T <= 0).any()):
            raise InputError(f"durations must be positive, with coefficients of each piece; they are {T.tolist()}")
        object.__setattr__(self, "c", c)
        object.__setattr__(self, "durations", T)
        super().__post_init__()

    @classmethod
    def from_pieces(cls, pieces: Sequence[tuple[npt.ArrayLike, float]]) -> PiecewisePolynomial:
        """Return polynomials in a row, each of (degree + 1, n) ascending coefficients of τᵏ and a duration."""
        rows = [np.asarray(c, dtype=float) for c, _ in pieces]
        c = np.zeros((max(map(len, rows)), len(rows), *rows[0].shape[1:]))
        for i, row in enumerate(rows):
            c[len(c) - len(row) :, i] = row[::-1]
        return PiecewisePolynomial(c, np.array([T for _, T in pieces]))

    @classmethod
    def from_ppoly(cls, spline: Any) -> PiecewisePolynomial:
        """Return the curve of a `scipy.interpolate.PPoly`, such as a CubicSpline, that begins at x = 0.

        Raises:
            InputError: it is none, or begins elsewhere.
        """
        if not hasattr(spline, "c") or not hasattr(spline, "x"):
            raise InputError(f"spline must be a PPoly such as CubicSpline(x, y); it is {spline!r}")
        if spline.x[0] != 0:
            raise InputError(f"a motion begins at x = 0; the spline begins at {spline.x[0]:g}")
        durations = np.diff(spline.x)
        return PiecewisePolynomial(_times_powers(spline.c, durations), durations)

    def to_ppoly(self) -> Any:
        """Return it as a `scipy.interpolate.PPoly`.

        Raises:
            InputError: a piece has no duration, but for rounding.
        """
        from scipy.interpolate import PPoly

        if (np.diff(self.x) <= 0).any():
            raise InputError("a PPoly has no pieces without duration")
        return PPoly(_times_powers(self.c, 1 / self.durations), self.x)

    @property
    def end(self) -> float:
        """The end of the last piece."""
        return float(self.x[-1])

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,), or () of a timing law."""
        return self.c.shape[2:]

    @cached_property
    def x(self) -> Array:
        """(m + 1,) where the pieces begin and end."""
        return np.concatenate([[0.0], np.cumsum(self.durations)])

    @cached_property
    def breakpoints(self) -> Array:
        """The ends of pieces inside (0, end) at which a derivative jumps."""
        m = len(self.durations)
        jumps = np.zeros(m - 1, dtype=bool)
        motion = self
        for _ in range(len(self.c)):
            c = motion.c.reshape(len(motion.c), m, self.dimension)
            before, after, sizes = c.sum(axis=0)[:-1], c[-1, 1:], np.abs(c).max(axis=0)
            rounding = JUMP * np.maximum(sizes[1:], sizes[:-1]) + NOISE * sizes.max(axis=0) + 1e-300
            jumps |= (np.abs(after - before) > rounding).any(axis=1)
            motion = motion.rate
        return np.unique(self.x[1:-1][jumps])

    @cached_property
    def rate(self) -> PiecewisePolynomial:
        """q̇, made of polynomials too."""
        return PiecewisePolynomial(self._differentiated(1), self.durations)

    def integral(self, start: npt.ArrayLike) -> PiecewisePolynomial:
        """Return x(t) = start + ∫ q dt, from 0 to t, made of polynomials too."""
        T = self.durations if self.end else np.ones(1)
        terms = ((self.c.T * T[:, None]) / np.arange(len(self.c), 0, -1.0)).T
        gains = terms.sum(axis=0)
        begins = start + np.concatenate([0 * gains[:1], np.cumsum(gains, axis=0)[:-1]])
        return PiecewisePolynomial(np.concatenate([terms, begins[None]]), self.durations)

    @property
    def pieces(self) -> tuple[PiecewisePolynomial, ...]:
        """The polynomials in the order of time, each with its `coefficients` and `coefficients_t`."""
        count = len(self.durations)
        return tuple(PiecewisePolynomial(self.c[:, i : i + 1], self.durations[i : i + 1]) for i in range(count))

    @property
    def coefficients(self) -> Array:
        """(degree + 1, n) the cₖ of the one polynomial q(t) = Σₖ cₖ τᵏ with τ = t/T, ascending.

        Raises:
            InputError: there are several polynomials.
        """
        if self.c.shape[1] > 1:
            raise InputError("there are several polynomials; ask one of pieces for its coefficients")
        return self.c[::-1, 0]

    def _sentences(self) -> str:
        """Return the polynomials in t, or how many there are where these are too many to read."""
        if len(self.durations) * self.dimension > MOST_WRITTEN:
            return f"{len(self.durations)} polynomials of degree {len(self.c) - 1} in {self.dimension} coordinates"
        lines, begin = [], 0.0
        for piece in self.pieces:
            c = np.reshape(piece.coefficients_t, (len(piece.c), -1))
            since = "t" if not begin else f"(t − {begin:.4g})"
            interval = f", {begin:.4g} ≤ t ≤ {begin + piece.end:.4g}"
            lines += [f"x{i + 1}(t) = {polynomial_text(c[:, i], since)}{interval}" for i in range(c.shape[1])]
            begin += piece.end
        return "\n".join(lines)

    @property
    def coefficients_t(self) -> Array:
        """(degree + 1, n) the coefficients cₖ/Tᵏ of powers of t instead of τ.

        Raises:
            InputError: there are several polynomials.
        """
        c = self.coefficients
        return np.asarray((c.T / (self.end or 1.0) ** np.arange(len(c))).T)

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the parameters and values of each coordinate's minimum and maximum, as every curve does.

        Exact: they are at the ends of pieces or where the derivative vanishes.
        """
        c = self._differentiated(counting_number("order", order))[::-1]
        c = c.reshape(*c.shape[:2], self.dimension)
        times, values = np.empty((2, 2, self.dimension))
        for j in range(self.dimension):
            polynomials = c[:, :, j].T
            taus = [stationary_points(a) if self.end else np.zeros(1) for a in polynomials]
            pieces = zip(self.x, self.durations, taus, strict=False)
            t = np.concatenate([start + T * tau for start, T, tau in pieces])
            x = np.concatenate([polynomial.polyval(tau, a) for tau, a in zip(taus, polynomials, strict=True)])
            times[:, j], values[:, j] = minimum_and_maximum(t, x)
        return times.reshape(2, *self.shape), values.reshape(2, *self.shape)

    def stretched(self, factor: float) -> PiecewisePolynomial:
        """Return q(t/k), slower for k > 1: velocities are divided by k, accelerations by k², jerks by k³.

        Raises:
            InputError: k is not positive, or so large or small that the derivatives are no numbers.
        """
        k = real_number("factor", factor, positive=True)
        if self.end:
            positive_number("the new duration", k * self.end)
        return PiecewisePolynomial(self.c, k * self.durations)

    def _joint(self, index: int) -> PiecewisePolynomial:
        return PiecewisePolynomial(self.c[:, :, index], self.durations)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        i = piece_at(self.x[:-1], t, side)
        # A piece can be as short as the rounding of t: no value is taken beyond its ends.
        tau = np.clip(t - self.x[i], 0.0, self.durations[i]) / (self.durations[i] if self.end else 1.0)
        tau = tau.reshape(-1, *[1] * len(self.shape))
        values = np.zeros((len(t), *self.shape))
        motion = self
        for _ in range(order):
            motion = motion.rate
        for coefficients in motion.c[:, i]:
            values = values * tau + coefficients
        return values

    def _differentiated(self, order: int) -> Array:
        """Return the coefficients of the derivative, the highest power first; one row of zeros beyond the degree."""
        degree = len(self.c) - 1
        if order > degree:
            return np.zeros_like(self.c[:1])
        factors = np.array([float(perm(k, order)) for k in range(degree, order - 1, -1)])
        scales = (self.durations if self.end else np.ones(1)) ** order
        return np.asarray((self.c[: degree + 1 - order].T * factors / scales[:, None]).T)


def _times_powers(c: Array, h: Array) -> Array:
    """Return coefficients (K + 1, m, ...), the highest power first, times hᵢᵏ of the piece i and the power k."""
    return np.asarray((c.T * (h ** np.arange(len(c) - 1, -1, -1)[:, None]).T).T)


def stationary_points(c: Array) -> Array:
    """Return 0, the τ inside (0, 1) at which Σₖ cₖ τᵏ may have an extreme, and 1, ascending.

    Coefficients below 1e-14 of the largest are rounding: as leading ones they would spoil the roots. Those a little
    larger cost the roots as many digits, which Newton's steps bring back; what they began with is kept beside it.
    """
    slope = polynomial.polytrim(polynomial.polyder(c), 1e-14 * np.abs(c).max())
    bend = polynomial.polyder(slope)
    roots = polynomial.polyroots(slope).real
    near = polished = roots[np.abs(roots - 0.5) < 1.0]
    for _ in range(NEWTON):
        curvature = polynomial.polyval(polished, bend)
        steps = polynomial.polyval(polished, slope) / np.where(curvature == 0, 1.0, curvature)
        polished = polished - np.clip(steps, -1.0, 1.0)
    inside = np.union1d(near, polished)
    return np.concatenate([[0.0], inside[(inside > 0) & (inside < 1)], [1.0]])
