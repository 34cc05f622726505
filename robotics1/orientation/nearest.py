"""The rotation nearest to a matrix, such as one printed with four digits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number
from robotics1.notation import vector
from robotics1.results import Frozen

PRINTED = 1e-3  # largest correction of an entry: three or four printed digits are accepted
SINGULAR = 1e-9  # a sine or cosine below this counts as zero where something is divided by it, as singular values do
ROUNDING = 2e-15  # what rounding leaves of a sine or cosine that is zero: nine units of the last digit of 1


@dataclass(frozen=True, eq=False)
class NearestRotation(Frozen):
    """The rotation nearest to a given matrix.

    Attributes:
        rotation: R (3, 3).
        correction: the largest change of an entry, max |R − M|: 1e-16 of an exact matrix, 5e-5 of four digits.
    """

    rotation: Array
    correction: float

    @property
    def resolution(self) -> float:
        """What counts as zero in R: its rounding, 2e-15, or the correction where that is larger."""
        return max(ROUNDING, self.correction)


def nearest_rotation(M: npt.ArrayLike, *, tolerance: float = PRINTED) -> NearestRotation:
    """Return the rotation R that minimises |R − M| (Frobenius): R = U Vᵀ with M = U Σ Vᵀ.

    Args:
        M: (3, 3).
        tolerance: the largest correction of an entry that is accepted.

    Raises:
        InputError: M is no (3, 3) matrix, a reflection (det −1), or needs a larger correction; the message says
            which columns are not unit vectors or not orthogonal.

    Source: Golub, Van Loan, Matrix Computations, 2013, section 6.4 (the orthogonal Procrustes problem).
    """
    return rotation_of("M", M, real_number("tolerance", tolerance, non_negative=True))


def rotation_of(name: str, M: npt.ArrayLike, tolerance: float = PRINTED) -> NearestRotation:
    """Return the nearest rotation of the argument of this name.

    Raises:
        InputError: there is none within the tolerance.
    """
    M = real_array(name, M, (3, 3), "a rotation matrix")
    if np.abs(M).max() > 10:
        raise InputError(f"{name} is no rotation: its entries must lie between −1 and 1; one is {np.abs(M).max():.3g}")
    U, _, Vt = np.linalg.svd(M)
    R = U @ Vt
    det = float(np.linalg.det(M))
    if np.linalg.det(R) < 0:
        kind = "a reflection" if np.abs(R - M).max() <= tolerance else "no rotation"
        raise InputError(
            f"{name} is {kind}: its determinant is {det:.4g}, and must be +1: the axes of a frame are right-handed"
        )
    correction = float(np.abs(R - M).max())
    if correction > tolerance:
        x, y, z = M.T
        raise InputError(
            f"{name} is no rotation: its columns must be orthonormal; their lengths are "
            f"{vector(np.linalg.norm(M, axis=0))}, their products x·y, y·z, z·x are {vector([x @ y, y @ z, z @ x])}; "
            f"the nearest rotation differs by {correction:.1e}, more than the tolerance {tolerance:.0e}"
        )
    return NearestRotation(R, correction)
