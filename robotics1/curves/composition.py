"""Compositions p(s(t)): a path with a timing law, a path by its arc length, a motion in another time."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import comb
from typing import Any

import numpy as np
import numpy.typing as npt
from numpy.polynomial import Chebyshev

from robotics1.caching import cached_property
from robotics1.curves.curve import SAME_PLACE, Curve
from robotics1.curves.given import as_curve, as_law, as_path
from robotics1.curves.interpolants import interpolants, roots
from robotics1.curves.named_derivatives import Side
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.errors import InputError
from robotics1.inputs import Array, positive_number, real_number

NEWTON_STEPS = 50  # four are enough where |p'| varies little


@dataclass(frozen=True, eq=False)
class PathTrajectory(Curve):
    """p(s(t)), 0 ≤ t ≤ T: ṗ = p' ṡ, p̈ = p'' ṡ² + p' s̈, p⃛ = p''' ṡ³ + 3 p'' ṡ s̈ + p' s⃛.

    Of a path in Rⁿ the values are (n,) for a number and (k, n) for (k,) times. Of a pose they are `pin.SE3`, or a list
    of them, and the velocity is the twist (v, ω), (6,), in world axes; of an orientation (3, 3) and ω.

    At a breakpoint `side` says from which side a value is taken; "right", the default, is just after it. There the
    path may be at a breakpoint, and the law at one of its own.

    Attributes:
        path: p(s), or poses T(s), or orientations R(s).
        law: s(t), in the parameter of the path: the arc length [m] where |p'| = 1.
    """

    path: Curve
    law: Curve

    def __post_init__(self) -> None:
        """Refuse a law that leaves the path."""
        if not isinstance(self.path, Curve):
            raise InputError(f"path must be a path, such as line_path(...); it is {self.path!r}")
        object.__setattr__(self, "law", as_law("law", self.law))
        low, high = self.law.extremes()[1]
        slack = SAME_PLACE * self.path.end
        if low < -slack or high > self.path.end + slack:
            raise InputError(
                f"the law must stay on the path, 0 ≤ s ≤ {self.path.end:.10g}; it goes from {low:.10g} to {high:.10g}"
            )

    @property
    def of_points(self) -> bool:
        """Whether the path is one of points."""
        return self.path.of_points

    @property
    def end(self) -> float:
        """T [s]."""
        return self.law.end

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the path."""
        return self.path.shape

    @cached_property
    def breakpoints(self) -> Array:
        """The instants in (0, T) at which a derivative may jump: the law's own, and where it passes one of the path."""
        places, times = self.path.breakpoints, self.law.ends
        pieces = interpolants(lambda t: self.law._derivative(t, 0, "right"), times)[0] if len(places) else []
        for piece in pieces:
            reach = float(np.abs(piece.coef[1:]).sum()) * (1 + SAME_PLACE)
            for place in places[np.abs(places - piece.coef[0]) <= reach]:
                for t in roots(piece - place):
                    if min(abs(t - other) for other in times) > SAME_PLACE * self.end:
                        times.append(t)
        return np.sort(times)[1:-1]

    def stretched(self, factor: float) -> "PathTrajectory":
        """Return p(s(t/k)), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        return PathTrajectory(self.path, stretched(self.law, factor))

    def _value(self, t: Array, side: Side) -> Any:
        return self.path._value(self.path._snapped(self.law._derivative(t, 0, side)), side)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        return self._derivatives(t, (order,), side)[0]

    def _derivatives(self, t: Array, orders: Sequence[int], side: Side) -> list[Array]:
        highest = max(orders, default=0)
        upto = range(1, highest + 1)
        s, *rates = self.law._derivatives(t, range(highest + 1), side)
        places = self.path._snapped(s)
        outer = self.path._derivatives(places, upto, side)
        if upto and len(self.path.breakpoints):
            turned = self._forward(t, rates, side) != (side == "right")
            other: Side = "left" if side == "right" else "right"
            if turned.any():
                at = turned.reshape(-1, *[1] * len(self.shape))
                others = self.path._derivatives(places, upto, other)
                outer = [np.where(at, new, old) for new, old in zip(others, outer, strict=True)]
        return [chain_rule(rates[:k], outer[:k]) if k else np.asarray(self.path._value(places, side)) for k in orders]

    def _forward(self, t: Array, rates: Sequence[Array], side: Side) -> npt.NDArray[np.bool_]:
        """Return whether the path is passed towards larger s just after t, or just before it at the end, (k,).

        s(t + ε) − s(t) = v ε + a ε²/2 + j ε³/6 and s(t) − s(t − ε) = v ε − a ε²/2 + j ε³/6: the first term decides.
        """
        after = t < self.end if side == "right" else t <= 0.0  # whether the values are those just after t
        if (rates[0] > 0).all():
            return np.asarray(after)
        v, a, j = self.law._derivatives(t, (1, 2, 3), side)
        a = np.where(after, a, -a)
        ahead = np.where(v != 0, v, np.where(a != 0, a, j)) >= 0
        return np.asarray(np.where(after, ahead, ~ahead))


def chain_rule(inner: Sequence[Array], outer: Sequence[Array]) -> Array:
    """Return the derivative of p(s(t)) of order n by Faà di Bruno: Σₖ p⁽ᵏ⁾ Bₙₖ, with the partial Bell polynomials.

    Bₙₖ = Σᵢ C(n − 1, i − 1) s⁽ⁱ⁾ Bₙ₋ᵢ,ₖ₋₁.

    Args:
        inner: ṡ, s̈, ..., each (k,).
        outer: p', p'', ..., each (k, ...), n of them.
    """
    n = len(outer)
    bell: dict[tuple[int, int], Any] = {(0, 0): 1.0}
    for m in range(1, n + 1):
        for k in range(1, m + 1):
            terms = [(i, m - i, k - 1) for i in range(1, m - k + 2) if (m - i, k - 1) in bell]
            bell[m, k] = sum(comb(m - 1, i - 1) * inner[i - 1] * bell[a, b] for i, a, b in terms)
    return np.asarray(sum((outer[k - 1].T * bell[n, k]).T for k in range(1, n + 1)))


def stretched(motion: Any, factor: float) -> Curve:
    """Return q(t/k), slower for k > 1: of the same kind for polynomials, profiles, splines and stacks of them.

    Args:
        motion: a trajectory or a timing law.
        factor: k > 0.

    Raises:
        InputError: k is not positive.
    """
    curve = as_curve("motion", motion)
    k = real_number("factor", factor, positive=True)
    if hasattr(curve, "stretched"):
        same_kind: Curve = curve.stretched(k)
        return same_kind
    end = positive_number("the new duration", k * curve.end)
    return PathTrajectory(curve, PiecewisePolynomial.from_pieces([([0.0, curve.end], end)]))


# --- by the arc length


@dataclass(frozen=True, eq=False)
class ArcLengthLaw(Curve):
    """σ(s), the parameter of a path by its arc length s = ∫₀^σ |p'| dσ.

    With g = |p'|²: dσ/ds = g^(−1/2), d²σ/ds² = −g'/(2g²), d³σ/ds³ = (g'² − g g''/2) g^(−7/2).

    Attributes:
        path: p(σ).
    """

    path: Curve

    @cached_property
    def _pieces(self) -> tuple[list[Chebyshev], Array]:
        """s(σ) on each piece, from 0, and s where the pieces begin and end."""
        pieces, _ = interpolants(self.path.speed, self.path.ends)
        integrals = [piece.integ(lbnd=piece.domain[0]) for piece in pieces]
        steps = [integral(integral.domain[1]) for integral in integrals]
        return integrals, np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def end(self) -> float:
        """The length."""
        return float(self._pieces[1][-1])

    @property
    def shape(self) -> tuple[int, ...]:
        """Of a number: ()."""
        return ()

    @cached_property
    def breakpoints(self) -> Array:
        """The breakpoints of the path, by arc length."""
        integrals, knots = self._pieces
        starts = np.array([integral.domain[0] for integral in integrals])
        return np.array([knots[np.argmin(np.abs(starts - place))] for place in self.path.breakpoints])

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return those of every curve; σ itself ascends from its start to its end."""
        ends = np.array([0.0, self.end]), np.array([0.0, self.path.end])
        return ends if order == 0 else super().extremes(order)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        return self._derivatives(t, (order,), side)[0]

    def _derivatives(self, t: Array, orders: Sequence[int], side: Side) -> list[Array]:
        order = max(orders, default=0)
        if order > 3:
            raise InputError(f"derivatives by arc length are known up to the third; order is {order}")
        sigma = self._parameter(t)
        p = self.path._derivatives(sigma, range(1, order + 1), side)
        found = [sigma]
        if order > 0:
            g = np.sum(p[0] ** 2, axis=1)
            self.path.refuse_standstill(sigma, np.sqrt(g))
            found.append(g**-0.5)
        if order > 1:
            g1 = 2 * np.sum(p[0] * p[1], axis=1)
            found.append(-g1 / (2 * g**2))
        if order > 2:
            g2 = 2 * np.sum(p[1] ** 2 + p[0] * p[2], axis=1)
            found.append((g1**2 - g * g2 / 2) * g**-3.5)
        return [found[k] for k in orders]

    def _parameter(self, s: Array) -> Array:
        """Return σ(s), (k,): by Newton's method on s(σ), kept inside the piece; exact at the breakpoints."""
        integrals, knots = self._pieces
        number = np.clip(np.searchsorted(knots, s, side="right") - 1, 0, len(integrals) - 1)
        sigma = np.empty_like(s)
        for i in np.unique(number):
            here = number == i
            integral, (a, b) = integrals[i], integrals[i].domain
            rest = s[here] - knots[i]
            x = a + (b - a) * rest / (knots[i + 1] - knots[i])
            for _ in range(NEWTON_STEPS):
                step = (rest - integral(x)) / np.maximum(integral.deriv()(x), 1e-300)
                x, before = np.clip(x + step, a, b), x
                if np.abs(x - before).max() <= 1e-15 * (b - a):
                    break
            sigma[here] = x
        for place, at in zip(self.path.breakpoints, self.breakpoints, strict=True):
            sigma[s == at] = place  # so that the side counts
        return sigma


class ArcLengthPath(PathTrajectory):
    """The path p(σ(s)) of another path p(σ), with s its arc length: the unit of s is the length's."""

    @property
    def breakpoints(self) -> Array:
        """The breakpoints of the path, by arc length."""
        return self.law.breakpoints

    @property
    def is_unit_speed(self) -> bool:
        """Yes."""
        return True


def by_arc_length(path: Curve) -> Curve:
    """Return the same path with s its arc length, so that |dp/ds| = 1; a path that has it already is returned as it is.

    Raises:
        InputError: it is no path of points.
    """
    path = as_path("path", path)
    if path.length == 0:
        raise InputError("path must have a length; p' vanishes all along it")
    return path if path.is_unit_speed else ArcLengthPath(path, ArcLengthLaw(path))
