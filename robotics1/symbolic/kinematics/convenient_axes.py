"""The Jacobian in the axes in which it is shortest: those of a joint in the middle of the chain.

Turning the axes and moving the point changes neither the rank nor the null space nor, for whole rows, the minors.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import sympy

from robotics1.inputs import Array
from robotics1.symbolic.kinematics.chain import Chain, Pose, cross
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.laurent import Matrix

WHOLE = {("x", "y", "z", "ωx", "ωy", "ωz"): 6, ("x", "y", "z"): 3, ("ωx", "ωy", "ωz"): -3}


@dataclass(frozen=True, eq=False)
class Convenient:
    """J = X M, with M shorter.

    Attributes:
        M: (m, n) the Jacobian in the axes and, of six rows, at the origin of a joint in the middle.
        axes: R and p that lead back: the axes of the middle joint in the world, and the tool in these axes; None
            when M is J itself.
        kind: 6 for a twist, 3 for a linear and −3 for an angular velocity.
        leads_back: whether X is known; not of a task with quotients, whose rows are combinations of these.
    """

    M: Matrix
    axes: Pose | None = None
    kind: int = 0
    leads_back: bool = True

    def velocity(self, u: Matrix) -> Matrix:
        """Return X u: a task velocity (m,) in the task's own axes, at its own point."""
        if self.axes is None:
            return u
        R, p = self.axes
        if self.kind != 6:
            return np.asarray(R @ u)
        return np.concatenate([R @ (u[:3] + cross(u[3:], p)), R @ u[3:]])

    def numbers(self, q: Array, parameters: Mapping[sympy.Symbol, float]) -> Array:
        """Return X M at q (n,), (m, n)."""
        at = np.vectorize(lambda f: Evaluated(f, parameters)(q), otypes=[float])
        M = at(self.M)
        if self.axes is None:
            return np.asarray(M)
        R, p = map(at, self.axes)
        v = M[:3] + np.cross(M[3:].T, p).T if self.kind == 6 else M
        return np.vstack([R @ v, R @ M[3:]]) if self.kind == 6 else np.asarray(R @ v)

    def force(self, u: Matrix) -> Matrix:
        """Return X⁻ᵀ u: a force (m,), whose power uᵀ M q̇ stays what it is."""
        if self.axes is None:
            return u
        R, p = self.axes
        if self.kind != 6:
            return np.asarray(R @ u)
        return np.concatenate([R @ u[:3], R @ (u[3:] - cross(p, u[:3]))])


def convenient(chain: Chain, row_names: tuple[str, ...], J: Matrix) -> Convenient:
    """Return the shorter form of J, of these rows in world axes; J itself if its rows are not whole."""
    kind = WHOLE.get(row_names)
    moving = [i for i, joint in enumerate(chain.joints) if joint.kind != "fixed"]
    if kind is None or not moving:
        return Convenient(J)
    middle = moving[len(moving) // 2]
    M = chain.jacobian_at(middle)
    R = chain.axes_after(middle)
    _, p = chain.relative(middle, len(chain.joints))
    if kind == 6:
        return Convenient(M, (R, p), kind)
    if kind == -3:
        return Convenient(M[3:], (R, p), kind)
    linear = np.array([v + cross(w, p) for v, w in zip(M[:3].T, M[3:].T, strict=True)], dtype=object).T
    return Convenient(linear, (R, p), kind)
