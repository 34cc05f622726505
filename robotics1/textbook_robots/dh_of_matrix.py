"""The row of a DH table that a homogeneous matrix is, or why it is none."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, NotConverged
from robotics1.inputs import Array
from robotics1.notation import joint_value, number
from robotics1.orientation.expressions import angle_of, expressions, simplified, vanishes
from robotics1.robot.placements import homogeneous

NEAR = 1e-6  # of an entry, relative to the length of p: what counts as zero in numbers


class DHParameters(NamedTuple):
    """A [m], alpha [rad], d [m], theta [rad]: numbers or SymPy expressions; d or theta holds the joint's coordinate."""

    a: Any
    alpha: Any
    d: Any
    theta: Any

    def __str__(self) -> str:
        """The four with their names."""
        names = ("a", "α", "d", "θ")
        texts = [
            (joint_value(x) if name in "αθ" else number(x)) if isinstance(x, float) else str(x)
            for name, x in zip(names, self, strict=True)
        ]
        return ", ".join(f"{name} = {text}" for name, text in zip(names, texts, strict=True))


@dataclass(frozen=True)
class DHRowOfMatrix:
    """What a homogeneous matrix is in either convention.

    Attributes:
        standard: of T = Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α); None if T has not this form.
        modified: of T = Rot_x(α) Trans_x(a) Rot_z(θ) Trans_z(d); None if T has not this form.
        reasons: why not, for each that is None.
    """

    standard: DHParameters | None
    modified: DHParameters | None
    reasons: tuple[str, ...]

    def explain(self) -> str:
        """Return the rows, or why there are none, in sentences."""
        found = [("standard", self.standard), ("modified", self.modified)]
        rows = [f"the {name} row is {row}" for name, row in found if row is not None]
        return "; ".join([*rows, *self.reasons])

    def require(self) -> "DHRowOfMatrix":
        """Return this, if there is a row in one of the conventions.

        Raises:
            NotConverged: there is none; the message says why.
        """
        if self.standard is None and self.modified is None:
            raise NotConverged(self.explain(), self)
        return self


def dh_row(T: Any) -> DHRowOfMatrix:
    """Return the DH parameters of a homogeneous matrix T, in the standard and in the modified convention.

    T = Rot_z(θ) Trans_z(d) Trans_x(a) Rot_x(α) has R₃₁ = 0, and p_x sin θ = p_y cos θ: x_i is normal to z_{i−1} and
    meets it. T = Rot_x(α) Trans_x(a) Rot_z(θ) Trans_z(d) has R₁₃ = 0, and p_y cos α = −p_z sin α. Each row is the only
    one of its convention.

    Args:
        T: a `pin.SE3`, or (4, 4) of numbers, or of SymPy expressions and names.

    Raises:
        InputError: T is no homogeneous matrix of a rotation.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; Craig, Introduction to Robotics,
    2005, section 3.6.
    """
    M = expressions("T", T.homogeneous if isinstance(T, pin.SE3) else T, (4, 4), "a homogeneous matrix")
    if M.dtype == object:
        _check_symbolic(M)
    else:
        M = np.round(homogeneous("T", M).homogeneous, 15) + 0.0
    (standard, first), (modified, second) = _standard(M), _modified(M)
    return DHRowOfMatrix(standard, modified, tuple(reason for reason in (first, second) if reason))


def _standard(M: Array) -> tuple[DHParameters | None, str]:
    c, s, (x, y, z) = M[0, 0], M[1, 0], M[:3, 3]
    if not _zero(M[2, 0], 1.0):
        return (
            None,
            f"it is no standard row: R31 = {_short(M[2, 0])} is not zero, so that x is not normal to the z before",
        )
    if not _zero(x * s - y * c, _size(M)):
        return (
            None,
            "no standard row: x does not meet the z axis before, as p_x sin θ differs from p_y cos θ",
        )
    return DHParameters(_length(x * c + y * s), _angle(M[2, 1], M[2, 2]), _length(z), _angle(s, c)), ""


def _modified(M: Array) -> tuple[DHParameters | None, str]:
    c, s, (x, y, z) = M[2, 2], -M[1, 2], M[:3, 3]
    if not _zero(M[0, 2], 1.0):
        return (
            None,
            f"no modified row: R13 = {_short(M[0, 2])} is not zero, so that z is not normal to the x before",
        )
    if not _zero(y * c + z * s, _size(M)):
        return (
            None,
            "no modified row: z does not meet the x axis before, as p_y cos α differs from −p_z sin α",
        )
    return DHParameters(_length(x), _angle(s, c), _length(z * c - y * s), _angle(-M[0, 1], M[0, 0])), ""


def _check_symbolic(M: Array) -> None:
    R, last = M[:3, :3], M[3]
    orthonormal = R.T @ R - np.eye(3, dtype=int)
    entries = [*orthonormal[np.triu_indices(3)], *last[:3], last[3] - 1]
    import sympy

    if not all(vanishes(sympy.sympify(entry)) for entry in entries) or not vanishes(sympy.Matrix(R).det() - 1):
        raise InputError("T must be a homogeneous matrix: a rotation (3, 3), p, and the last row (0, 0, 0, 1)")


def _zero(value: Any, size: float) -> bool:
    return bool(abs(value) <= NEAR * size) if isinstance(value, float) else vanishes(value)


def _size(M: Array) -> float:
    return max(1e-12, float(np.linalg.norm(M[:3, 3]))) if M.dtype != object else 1.0


def _angle(sine: Any, cosine: Any) -> Any:
    if isinstance(sine, float):
        return float(angle_of(float(sine), float(cosine))) + 0.0
    if sine.is_number and cosine.is_number:
        import sympy

        return sympy.atan2(sine, cosine)
    return angle_of(simplified(sine), simplified(cosine))


def _length(value: Any) -> Any:
    return round(float(value), 14) + 0.0 if isinstance(value, float) else simplified(value)


def _short(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)
