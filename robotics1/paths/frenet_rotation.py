"""Orientations that go with the Frenet frame of a curve."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.paths.frenet import frenet_frame
from robotics1.paths.interpolants import CONVERGED, interpolants
from robotics1.paths.path import Path
from robotics1.paths.rotations import RotationPath


@dataclass(frozen=True, eq=False)
class FrenetRotation(RotationPath):
    """R(s) = (t, n, b) of a curve: x goes forward, y to the centre of curvature; w = |p'| (τ t + κ b).

    Attributes:
        path: the curve, nowhere straight.
    """

    path: Path

    @property
    def end(self) -> float:
        """That of the curve."""
        return self.path.end

    @property
    def breaks(self) -> Array:
        """Those of the curve."""
        return self.path.breaks

    def _value(self, s: Array, side: str) -> Array:
        return np.stack([frenet_frame(self.path, x, side=side).rotation for x in s])

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        if order == 1:
            return self._w(s, side)
        values = np.empty((len(s), 3))
        for j, pieces in enumerate(self._interpolants):
            ends = np.array([piece.domain[1] for piece in pieces[:-1]])
            number = np.searchsorted(ends, s, side="right" if side == "right" else "left")
            values[:, j] = [pieces[i].deriv(order - 1)(x) for i, x in zip(number, s, strict=True)]
        return values

    def _w(self, s: Array, side: str) -> Array:
        darboux = np.array([frenet_frame(self.path, x, side=side).darboux for x in s])
        return np.asarray(self.path.rate(s, side=side)[:, None] * darboux)

    @cached_property
    def _interpolants(self) -> list[list[Chebyshev]]:
        """w, one coordinate after the other, as converged polynomials between the breaks.

        A coordinate that vanishes holds the rounding of the others, and no polynomial converges to that.
        """
        rounding = CONVERGED * float(np.abs(self._w(np.array(self.path.ends[:-1]), "right")).max())

        def coordinate(j: int) -> list[Chebyshev]:
            return interpolants(lambda s: self._w(s, "right")[:, j], self.path.ends, floor=rounding)[0]

        return [coordinate(j) for j in range(3)]


def frenet_path(path: Path) -> FrenetRotation:
    """Return the orientation that goes with the Frenet frame of a curve: x the tangent, y the normal, z the binormal.

    Raises:
        InputError: the path is no curve in the plane or in space, or its start is straight.
    """
    frenet_frame(path, 0.0).rotation  # noqa: B018 (raises where there is none)
    return FrenetRotation(path)
