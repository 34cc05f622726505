"""The cusps of a 3R arm: targets at which three solutions meet, found by excluding all other places.

The first joint only turns the target about its axis, so that (q₂, q₃) → (ρ², z), with ρ the distance from it, is the
whole problem. With its 2 × 2 Jacobian [a b; c d], J is singular where D = ad − bc = 0. There (b, −a) and
(d, −c) do not move the target, and three solutions meet where one of them is tangent to the curve D = 0:
D = 0, g₁ = ∇D · (b, −a) = 0, g₂ = ∇D · (d, −c) = 0. All are trigonometric polynomials.

Source: El Omri and Wenger, How to recognize simply a non-singular posture changing 3-DOF manipulator, ICAR 1995;
Wenger, Cuspidal and noncuspidal robot manipulators, Robotica, 2007.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.angles import without_turns
from robotics1.ik.joint_chain import FixedChain
from robotics1.inputs import Array

Complex = npt.NDArray[np.complex128]
GRID = 32  # samples a turn, more than twice the degree of any of the polynomials
CELLS, LEVELS, MOST_CELLS = 64, 14, 6_000  # of the first grid; how often cells are halved, and how many at most
ROUNDING = 1e-11  # of a value, beside the sum of the coefficients' sizes
BESIDE = 0.01  # [rad] from a cusp, within which cells are not excluded
SAME = 1e-4  # [rad] distance of two cusps that are one


@dataclass(frozen=True, eq=False)
class Cusps:
    """What is known of the cusps of a 3R arm.

    Attributes:
        q: (j, 2) values of (q₂, q₃) at cusps, polished by Newton's method [rad].
        complete: whether it is proven that there are none elsewhere.
        generic: whether it is proven that the singular curve D = 0 has no point with ∇D = 0.
    """

    q: Array
    complete: bool
    generic: bool


@dataclass(frozen=True, eq=False)
class TrigSurface:
    """A trigonometric polynomial of two angles, f = Σ c_km exp(i (k x + m y)), by its values on a grid.

    Attributes:
        c: (GRID, GRID) the coefficients.
        k, m: their frequencies.
    """

    c: Complex
    k: Array
    m: Array

    @classmethod
    def of(cls, values: Array) -> "TrigSurface":
        """Return the polynomial that has these values, (GRID, GRID), at the multiples of 2π/GRID."""
        frequencies = np.fft.fftfreq(GRID, 1 / GRID)
        k, m = np.meshgrid(frequencies, frequencies, indexing="ij")
        c = np.fft.fft2(values) / GRID**2
        return cls(np.where(np.abs(c) < 1e-14 * np.abs(c).max(initial=0.0), 0.0, c), k, m)

    def __call__(self, x: Array) -> Array:
        """Return the values at (k, 2): (k,)."""
        some = np.abs(self.c) > 0
        rows, columns = np.flatnonzero(some.any(axis=1)), np.flatnonzero(some.any(axis=0))
        of_x = np.exp(1j * x[..., :1] * self.k[rows, 0])
        of_y = np.exp(1j * x[..., 1:] * self.m[0, columns])
        return np.asarray((of_x @ self.c[np.ix_(rows, columns)] * of_y).sum(axis=-1).real)

    def slope(self, axis: int) -> "TrigSurface":
        """Return ∂f/∂x of the first or the second angle."""
        return TrigSurface(self.c * 1j * (self.m if axis else self.k), self.k, self.m)

    @property
    def grid(self) -> Array:
        """The values on the grid."""
        return np.asarray(np.fft.ifft2(self.c).real * GRID**2)

    def bound(self, order: int) -> float:
        """Return Σ |c| (|k| + |m|)^order, which bounds all derivatives of that order."""
        return float((np.abs(self.c) * (np.abs(self.k) + np.abs(self.m)) ** order).sum())

    def may_vanish(self, x: Array, half: float) -> npt.NDArray[np.bool_]:
        """Return in which cells of half a width around x (k, 2) the polynomial may have a zero."""
        slope = half * (np.abs(self.slope(0)(x)) + np.abs(self.slope(1)(x)))
        slack = slope + 0.5 * half**2 * self.bound(2) + ROUNDING * self.bound(0)
        return np.asarray(np.abs(self(x)) <= slack)


def cusps(chain: FixedChain) -> Cusps:
    """Return the cusps of three revolute joints that move a point."""
    rho2, z = _reduced_map(chain)
    a, b, c, d = rho2.slope(0), rho2.slope(1), z.slope(0), z.slope(1)
    D = TrigSurface.of(a.grid * d.grid - b.grid * c.grid)
    Dx, Dy = D.slope(0), D.slope(1)
    g1 = TrigSurface.of(Dx.grid * b.grid - Dy.grid * a.grid)
    g2 = TrigSurface.of(Dx.grid * d.grid - Dy.grid * c.grid)
    found, complete = _common_zeros((D, g1, g2))
    nodes, all_nodes = _common_zeros((D, Dx, Dy))
    return Cusps(found, complete, all_nodes and not len(nodes))


def _reduced_map(chain: FixedChain) -> tuple[TrigSurface, TrigSurface]:
    """Return ρ² and z of the point, relative to the arm, as functions of (q₂, q₃)."""
    turns = np.arange(GRID) * 2 * np.pi / GRID
    q2, q3 = np.meshgrid(turns, turns, indexing="ij")
    x = np.stack([np.zeros(GRID**2), q2.ravel(), q3.ravel()], axis=1)
    lines = chain.lines(x)
    v = (lines.p - lines.o[:, 0]) / (chain.length or 1.0)
    height = (v * lines.z[:, 0]).sum(axis=1)
    rho2 = (v * v).sum(axis=1) - height**2
    return TrigSurface.of(rho2.reshape(GRID, GRID)), TrigSurface.of(height.reshape(GRID, GRID))


def _common_zeros(surfaces: tuple[TrigSurface, TrigSurface, TrigSurface]) -> tuple[Array, bool]:
    """Return common zeros (j, 2) of three polynomials, and whether the rest of the square is free of them for sure."""
    half = np.pi / CELLS
    centres = -np.pi + half * (2 * np.arange(CELLS) + 1)
    cells = np.stack(np.meshgrid(centres, centres, indexing="ij"), axis=-1).reshape(-1, 2)
    found: Array = np.zeros((0, 2))
    for level in range(LEVELS):
        for surface in surfaces:
            cells = cells[surface.may_vanish(cells, half)]
        if not len(cells):
            return found, True
        if level >= 4:
            found = np.asarray(_polished(surfaces, cells))
            if len(found) and half < 0.1 * BESIDE:
                apart = np.abs(without_turns(cells[:, None] - found)).max(axis=2).min(axis=1)
                if apart.max() < BESIDE:  # all cells that are left lie at the zeros found
                    return found, True
        half /= 2
        corners = half * np.array([[-1, -1], [-1, 1], [1, -1], [1, 1]])
        cells = (cells[:, None] + corners).reshape(-1, 2)
        if len(cells) > MOST_CELLS:
            return found, False
    return found, False


def _polished(surfaces: tuple[TrigSurface, ...], x: Array) -> Array:
    """Return the distinct common zeros to which Newton's method leads from x (k, 2)."""
    x = x[:: max(1, len(x) // 100)].copy()
    slopes = [(f.slope(0), f.slope(1)) for f in surfaces]
    sizes = np.array([f.bound(0) or 1.0 for f in surfaces])
    for _ in range(12):
        values = np.stack([f(x) for f in surfaces], axis=1) / sizes
        A = np.stack([np.stack([sx(x), sy(x)], axis=1) for sx, sy in slopes], axis=1) / sizes[:, None]
        step = (np.linalg.pinv(A, rcond=1e-10) @ values[..., None])[..., 0]
        x = x - np.clip(step, -0.1, 0.1)
    values = np.stack([f(x) for f in surfaces], axis=1) / sizes
    good = x[np.abs(values).max(axis=1) < 1e-13]
    distinct: list[Array] = []
    for p in without_turns(good):
        if all(np.abs(without_turns(p - other)).max() > SAME for other in distinct):
            distinct.append(p)
    return np.array(distinct).reshape(-1, 2)
