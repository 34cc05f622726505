"""The frame that goes along a curve: tangent, normal, binormal, and how they turn."""

from dataclasses import dataclass

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array, real_number
from robotics1.paths.path import Path, across

STRAIGHT = 1e-9  # κ times the length: a curve that bends less is straight


@dataclass(frozen=True, eq=False)
class FrenetFrame:
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


def frenet_frame(path: Path, s: float, *, side: str = "right") -> FrenetFrame:
    """Return the tangent, normal, binormal, curvature and torsion of a curve at the parameter s.

    Args:
        path: in the plane or in space; s need not be the arc length.
        s: where.
        side: at a break, from which side: "right" or "left".

    Raises:
        InputError: the path is no curve in the plane or in space, s is outside it, or it has no tangent there.

    Source: do Carmo, Differential Geometry of Curves and Surfaces, 1976, section 1.5.
    """
    if not isinstance(path, Path) or path.dimension not in (2, 3):
        raise InputError("the Frenet frame is that of a curve in the plane or in space: two or three coordinates")
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
