"""The frame that goes along a curve: tangent, normal, binormal, how they turn, and the orientation they make."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve, across
from robotics1.curves.given import as_path
from robotics1.curves.interpolants import CONVERGED, interpolants
from robotics1.curves.named_derivatives import Side
from robotics1.curves.rotations import RotationPath
from robotics1.errors import InputError
from robotics1.inputs import Array, real_number
from robotics1.results import Frozen

STRAIGHT = 1e-9  # κ times the length: a curve that bends less is straight


@dataclass(frozen=True, eq=False)
class FrenetFrame(Frozen):
    """The Frenet frame of a curve at one point; a planar curve lies in the plane z = 0.

    By the arc length: t' = κ n, n' = −κ t + τ b, b' = −τ n.

    Attributes:
        position: (3,) p [m].
        tangent: (3,) t = p'/|p'|.
        normal: (3,) n, towards the centre of curvature; None where the curve is straight.
        binormal: (3,) b = t × n; None where the curve is straight.
        curvature: κ [1/m].
        torsion: τ = (p' × p'')·p''' / |p' × p''|² [1/m]; None where the curve is straight.
    """

    position: Array
    tangent: Array
    normal: Array | None
    binormal: Array | None
    curvature: float
    torsion: float | None

    @property
    def radius(self) -> float:
        """1/κ [m]; infinite where the curve is straight."""
        return 1 / self.curvature if self.curvature else float("inf")

    @property
    def rotation(self) -> Array:
        """(3, 3) the frame (t, n, b).

        Raises:
            InputError: the curve is straight, so that it has no normal.
        """
        if self.normal is None or self.binormal is None:
            raise InputError("the curve is straight here: it has a tangent, but no normal and so no Frenet frame")
        return np.column_stack([self.tangent, self.normal, self.binormal])

    @property
    def darboux(self) -> Array:
        """(3,) ω = τ t + κ b, with which the frame turns for each unit of arc length [rad/m].

        Raises:
            InputError: the curve is straight.
        """
        return np.asarray(self.rotation @ [self.torsion, 0.0, self.curvature])


def frenet_frame(path: Curve, s: float, *, side: Side = "right") -> FrenetFrame:
    """Return the tangent, normal, binormal, curvature and torsion of a curve at the parameter s.

    Args:
        path: in the plane or in space; s need not be the arc length.
        s: where.
        side: at a break, from which side: "right" or "left".

    Raises:
        InputError: the path is no curve in the plane or in space, s is outside it, or it has no tangent there.

    Source: do Carmo, Differential Geometry of Curves and Surfaces, 1976, section 1.5.
    """
    path = as_path("the path of a Frenet frame", path, (2, 3))
    s = real_number("s", s)
    p, d1, d2, d3 = (_in_space(path.derivative(s, order, side=side)) for order in range(4))
    speed = float(np.linalg.norm(d1))
    path.refuse_standstill(np.array([s]), np.array([speed]))
    t = d1 / speed
    bend = across(d2[None], t)[0] / speed**2
    kappa = float(np.linalg.norm(bend))
    if kappa * path.length <= STRAIGHT:
        return FrenetFrame(p, t, None, None, 0.0, None)
    n = bend / kappa
    b = np.cross(t, n)
    return FrenetFrame(p, t, n, b, kappa, float(b @ d3) / (kappa * speed**3))


def _in_space(v: Array) -> Array:
    return np.pad(v, (0, 3 - len(v)))


@dataclass(frozen=True, eq=False)
class FrenetRotation(RotationPath):
    """R(s) = (t, n, b) of a curve: x goes forward, y to the centre of curvature; w = |p'| (τ t + κ b).

    Attributes:
        path: the curve, nowhere straight.
    """

    path: Curve

    @property
    def end(self) -> float:
        """That of the curve."""
        return self.path.end

    @property
    def breakpoints(self) -> Array:
        """Those of the curve."""
        return self.path.breakpoints

    def _value(self, t: Array, side: Side) -> Array:
        return np.stack([frenet_frame(self.path, x, side=side).rotation for x in t])

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        if order == 1:
            return self._w(t, side)
        values = np.empty((len(t), 3))
        for j, pieces in enumerate(self._interpolants):
            ends = np.array([piece.domain[1] for piece in pieces[:-1]])
            number = np.searchsorted(ends, t, side=side)
            values[:, j] = [pieces[i].deriv(order - 1)(x) for i, x in zip(number, t, strict=True)]
        return values

    def _w(self, t: Array, side: Side) -> Array:
        darboux = np.array([frenet_frame(self.path, x, side=side).darboux for x in t])
        return np.asarray(self.path.speed(t, side=side)[:, None] * darboux)

    @cached_property
    def _interpolants(self) -> list[list[Chebyshev]]:
        """w, one coordinate after the other, as converged polynomials between the breaks.

        A coordinate that vanishes holds the rounding of the others, and no polynomial converges to that.
        """
        rounding = CONVERGED * float(np.abs(self._w(np.array(self.path.ends[:-1]), "right")).max())

        def coordinate(j: int) -> list[Chebyshev]:
            return interpolants(lambda s: self._w(s, "right")[:, j], self.path.ends, floor=rounding)[0]

        return [coordinate(j) for j in range(3)]


def frenet_path(path: Curve) -> FrenetRotation:
    """Return the orientation that goes with the Frenet frame of a curve: x the tangent, y the normal, z the binormal.

    Raises:
        InputError: the path is no curve in the plane or in space, or its start is straight.
    """
    frenet_frame(path, 0.0).rotation  # noqa: B018 (raises where there is none)
    return FrenetRotation(path)
