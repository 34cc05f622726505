"""From one set of joint coordinates to another: DH angles to absolute ones, motors to joints."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, real_array
from robotics1.least_squares import numeric_rank
from robotics1.results import Frozen
from robotics1.robot.checking import MOST_DEGREES
from robotics1.textbook_robots.joint_formulas import in_joints, joint_symbols, listed_formulas


@dataclass(frozen=True, eq=False)
class JointMap(Frozen):
    """θ = M q + c, from the coordinates q to the coordinates θ.

    Attributes:
        matrix: M, (m, n): ∂θ/∂q, the map of the rates.
        offset: c, (m,) [rad or m].
    """

    matrix: Array
    offset: Array

    def __post_init__(self) -> None:
        """Check the shapes, and copy the arrays.

        Raises:
            InputError: they are no matrix and no vector of as many rows.
        """
        vars(self)["matrix"] = real_array("matrix", self.matrix, (None, None), "one row for each new coordinate")
        vars(self)["offset"] = real_array("offset", self.offset, (len(self.matrix),), "one number for each row")
        super().__post_init__()

    def __call__(self, q: npt.ArrayLike) -> Array:
        """Return θ = M q + c, (m,), of q (n,)."""
        return self.matrix @ self._vector("q", q, 1) + self.offset

    def rates(self, qdot: npt.ArrayLike) -> Array:
        """Return θ̇ = M q̇, (m,), of q̇ (n,); of accelerations likewise."""
        return self.matrix @ self._vector("qdot", qdot, 1)

    def torques(self, tau: npt.ArrayLike) -> Array:
        """Return the torques on q, Mᵀ τ, (n,), that do the work of torques τ (m,) on θ: τᵀ θ̇ = (Mᵀ τ)ᵀ q̇."""
        return self.matrix.T @ self._vector("tau", tau, 0)

    @cached_property
    def inverse(self) -> JointMap:
        """The map back, q = M⁻¹ (θ − c).

        Raises:
            InputError: M is not square, or singular.
        """
        m, n = self.matrix.shape
        if m != n or numeric_rank(np.linalg.svd(self.matrix, compute_uv=False)) < n:
            raise InputError("the map has no inverse: its matrix must be square and of full rank")
        back = np.linalg.inv(self.matrix)
        return JointMap(back, -back @ self.offset)

    def _vector(self, name: str, value: npt.ArrayLike, axis: int) -> Array:
        return real_array(name, value, (self.matrix.shape[axis],), "one number for each coordinate")


def joint_map(
    formulas: Sequence[Any], *, joints: int | None = None, values: Mapping[str, float] | None = None
) -> JointMap:
    """Return the map θ = M q + c of coordinates that are sums of others: joint_map(["q1", "q1 + q2 - pi/2"]).

    With M come the rates θ̇ = M q̇, the torques Mᵀ τ, and the map back. DH angles become the absolute ones of a planar
    arm, and the angles of motors, through couplings and gears, those of the joints.

    Args:
        formulas: (m,) θ₁, θ₂, ... as texts in q1, q2, ... and the names of `values`, or SymPy expressions.
        joints: n; by default the largest number of a q in the formulas.
        values: of the other names, such as {"k": 0.5}.

    Raises:
        InputError: a formula is none, is not linear in q, has an unknown q, or a name without a value.
        UnknownNameError: a value is of no name in the formulas.
    """
    entries = listed_formulas(formulas, "['q1', 'q1 + q2']")
    used = {symbol.name for entry in entries for symbol in entry.free_symbols}
    largest = max((int(name[1:]) for name in used if name[0] == "q" and name[1:].isdigit()), default=0)
    n = counting_number("joints", largest if joints is None else joints, most=MOST_DEGREES)
    if n < 1:
        raise InputError(f"the formulas must be in q1, q2, ...; they have {sorted(used)}")
    q = joint_symbols(n)
    matrix, offset = np.zeros((len(entries), n)), np.zeros(len(entries))
    for i, entry in enumerate(in_joints(entries, n, values)):
        at = entry.expand()
        slopes = [at.diff(x) for x in q]
        if not all(slope.is_number for slope in slopes):
            raise InputError(
                f"a coordinate must be a sum of numbers times q1, q2, ... and a constant; {str(entries[i])!r} is none"
            )
        matrix[i] = [float(slope) for slope in slopes]
        offset[i] = float(at.xreplace(dict.fromkeys(q, 0 * q[0])))
    return JointMap(matrix, offset)
