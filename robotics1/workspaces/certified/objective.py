"""What is optimized, and how much of it a box of configurations can have at most.

Over a box |qᵢ − mᵢ| ≤ wᵢ a distance from joint i's axis is at most ρᵢ: what it is in the middle, and how far the joints
after it move the point. So |∂p/∂qᵢ| ≤ ρᵢ, |∂²p/∂qᵢ∂qⱼ| ≤ ρⱼ and |∂³p/∂qᵢ∂qⱼ∂qₖ| ≤ ρₖ, where the last of the joints
counts. From these follow three bounds, and the least counts: of order 0 (a ball about p), 2 and 3 (Taylor).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.certified.extremes import Measure
from robotics1.workspaces.chain import Chain

SWEEPS = 6  # along the coordinates, towards the largest value of a concave function


class BoxBounds(NamedTuple):
    """Of k boxes.

    Attributes:
        value: (k,) F in the middle.
        bound: (k,) what F is at most.
        slope: (k, n) by how much F changes at least along the whole side, with its sign; 0 where it may turn back.
        spread: (k, n) how much a side has to do with the distance between value and bound.
    """

    value: Array
    bound: Array
    slope: Array
    spread: Array


class _Sizes(NamedTuple):
    """Over k boxes of half sides w (k, m): ρ (k, m), and bounds on |p − p(m)| (k,), |∂²p| and Σ |∂³p| w (k, m, m)."""

    half: Array
    radii: Array
    moved: Array
    second: Array
    third: Array


@dataclass(frozen=True, eq=False)
class Objective:
    """F(q) = ± |P (p(q) − c)|²/2, or ± n · (p(q) − c), to be made as large as possible.

    Attributes:
        chain: what moves p.
        measure: P, c and n.
        sign: 1 for the largest, −1 for the smallest.
    """

    chain: Chain
    measure: Measure
    sign: float

    def value(self, q: Array) -> Array:
        """Return F (k,) at q (k, n)."""
        return self._of(self.chain.point(q))

    def meant(self, F: float) -> float:
        """Return the distance, or the coordinate, that belongs to a value of F."""
        if self.measure.direction is not None:
            return self.sign * F
        return float(np.sqrt(max(2 * self.sign * F, 0.0)))

    def wanted(self, meant: float) -> float:
        """Return F of a distance or coordinate."""
        return self.sign * (meant if self.measure.direction is not None else 0.5 * max(meant, 0.0) ** 2)

    def bounds(self, middle: Array, half: Array) -> BoxBounds:
        """Return what F is at most in boxes (k, n), given by their middles and half sides."""
        A, B = self.chain.A, np.abs(self.chain.A)
        p, J, turned = self._derivatives(middle @ A.T)
        sizes = self._sizes(J, half @ B.T)
        value, pull = self._of(p), self._pull(p)
        scale = half[:, :, None] * half[:, None, :]
        g = np.einsum("kd,kdi->ki", pull, J) @ A * half
        H = A.T @ self._hessian(pull, J, turned) @ A * scale
        second, third = (B.T @ entry @ B * scale for entry in self._sizes_of_value(p, sizes))
        least = np.minimum(second, np.abs(H) + third)
        taylor = np.abs(g).sum(axis=1) + 0.5 * least.sum(axis=(1, 2))
        cubic = largest_on_cube(g, H, half > 0) + third.sum(axis=(1, 2)) / 6
        bound = np.minimum(self._ball(p, sizes.moved), value + np.minimum(taylor, cubic))
        sure = np.abs(g) - least.sum(axis=2)
        slope = np.where((sure > 0) & (half > 0), np.sign(g) * sure, 0.0)
        return BoxBounds(value, bound, slope, np.minimum(least, third).sum(axis=2) + 1e-3 * np.abs(g))

    def _of(self, p: Array) -> Array:
        offset = p - self.measure.centre
        if self.measure.direction is not None:
            return np.asarray(self.sign * (offset @ self.measure.direction))
        return np.asarray(self.sign * 0.5 * ((offset @ self.measure.P) ** 2).sum(axis=1))

    def _pull(self, p: Array) -> Array:
        """Return ∂F/∂p (k, 3)."""
        if self.measure.direction is not None:
            return np.broadcast_to(self.sign * self.measure.direction, p.shape)
        return np.asarray(self.sign * (p - self.measure.centre) @ self.measure.P)

    def _ball(self, p: Array, radius: Array) -> Array:
        """Return what F is at most in balls about points (k, 3)."""
        if self.measure.direction is not None:
            return np.asarray(self._of(p) + radius)
        d = np.linalg.norm((p - self.measure.centre) @ self.measure.P, axis=1)
        return np.asarray(0.5 * (d + radius) ** 2 if self.sign > 0 else -0.5 * np.maximum(d - radius, 0.0) ** 2)

    def _derivatives(self, v: Array) -> tuple[Array, Array, Array]:
        """Return p (k, 3), the columns J (k, 3, m), and the axes ω (k, m, 3), which are zero of slides."""
        p, J = self.chain.joint_columns(v)
        return p, J, self.chain.turning(v)

    def _hessian(self, pull: Array, J: Array, turning: Array) -> Array:
        """Return ∂²F (k, m, m): ∂²p/∂vᵢ∂vⱼ = ωᵢ × Jⱼ where joint i is not after joint j."""
        columns = np.moveaxis(J, 1, 2)
        bent = np.einsum("kid,kjd->kij", np.cross(pull[:, None], turning), columns)  # pull · (ω × J) = (pull × ω) · J
        upper = np.triu(bent)
        H = upper + np.swapaxes(np.triu(bent, 1), 1, 2)
        if self.measure.direction is None:
            H = H + self.sign * np.einsum("kdi,de,kej->kij", J, self.measure.P, J)
        return np.asarray(H)

    @cached_property
    def _order(self) -> tuple[Array, Array, Array, Array]:
        """Which joint of two, and of three, is the last, and whether those before it all turn."""
        turns = np.array([axis.revolute for axis in self.chain.axes])
        i = np.arange(len(turns))
        two = np.maximum(i[:, None], i)
        three = np.maximum(two[:, :, None], i)
        first = np.minimum(i[:, None], i)
        places = np.sort(np.stack(np.broadcast_arrays(i[:, None, None], i[:, None], i)), axis=0)
        return two, turns[first], three, turns[places[0]] & turns[places[1]]

    def _sizes(self, J: Array, w: Array) -> _Sizes:
        """Return bounds on the derivatives of p over boxes with half sides w (k, m)."""
        length = np.linalg.norm(J, axis=1)
        moved = np.zeros(len(w))
        radii = np.ones_like(w)
        for i in range(w.shape[1] - 1, -1, -1):
            if self.chain.axes[i].revolute:
                radii[:, i] = length[:, i] + moved
                moved = moved + 2 * np.sin(np.minimum(w[:, i], np.pi) / 2) * radii[:, i]
            else:
                moved = moved + w[:, i]
        two, bends, three, twice = self._order
        second = np.where(bends, radii[:, two], 0.0)
        third = np.einsum("kijl,kl->kij", np.where(twice, radii[:, three], 0.0), w)
        return _Sizes(w, radii, moved, second, third)

    def _sizes_of_value(self, p: Array, sizes: _Sizes) -> tuple[Array, Array]:
        """Return bounds on |∂²F| (k, m, m) and Σₖ |∂³F| wₖ (k, m, m)."""
        w, radii, moved, second, third = sizes
        if self.measure.direction is not None:
            return second, third
        far = (np.linalg.norm((p - self.measure.centre) @ self.measure.P, axis=1) + moved)[:, None, None]
        bent = np.einsum("kij,kj->ki", second, w)
        mixed = second * np.einsum("ki,ki->k", radii, w)[:, None, None]
        crossed = radii[:, :, None] * bent[:, None, :]
        return (
            radii[:, :, None] * radii[:, None, :] + far * second,
            mixed + crossed + np.swapaxes(crossed, 1, 2) + far * third,
        )


def largest_on_cube(g: Array, H: Array, active: npt.NDArray[np.bool_]) -> Array:
    """Return numbers (k,) that g·x + xᵀH x/2 does not exceed for |xᵢ| ≤ 1.

    With λ the largest eigenvalue of H, or 0, the function is at most g·x − xᵀN x/2 + λ n/2, with N = λI − H positive
    semidefinite. That is concave, so that it is below each of its tangents; the one is taken at which a few steps along
    the coordinates end.

    Args:
        g: (k, n).
        H: (k, n, n).
        active: (k, n) where a row of g and H is not zero.
    """
    k, n = g.shape
    top = np.maximum(np.linalg.eigvalsh(H)[:, -1], 0.0)
    N = top[:, None, None] * np.eye(n) - H
    y, slope = np.zeros((k, n)), g.copy()
    for _ in range(SWEEPS):
        for i in range(n):
            curve = N[:, i, i]
            with np.errstate(divide="ignore", invalid="ignore"):
                free = y[:, i] + slope[:, i] / curve
            end = np.where(curve > 1e-300, np.clip(np.nan_to_num(free), -1, 1), np.sign(slope[:, i]))
            slope -= N[:, :, i] * (end - y[:, i])[:, None]
            y[:, i] = end
    at_y = np.einsum("ki,ki->k", g + slope, y) / 2
    rise = (np.abs(slope) - slope * y).sum(axis=1)
    return np.asarray(at_y + rise + 0.5 * top * active.sum(axis=1))
