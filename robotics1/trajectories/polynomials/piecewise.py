"""Polynomials one after the other: profiles of constant acceleration or jerk, and splines."""

from collections.abc import Sequence
from dataclasses import dataclass

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.trajectories.polynomials.pieces import PolynomialPieces
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory


@dataclass(frozen=True, eq=False)
class PiecewiseTrajectory(PolynomialPieces):
    """q(t) made of polynomials, each of its own τ = (t − tᵢ)/Tᵢ.

    Attributes:
        pieces: the polynomials; the next begins when one ends.
    """

    pieces: tuple[PolynomialTrajectory, ...]

    def __post_init__(self) -> None:
        """Refuse what are no polynomials of the same joints."""
        pieces = tuple(self.pieces) if isinstance(self.pieces, Sequence) else ()
        if not pieces or not all(isinstance(piece, PolynomialTrajectory) for piece in pieces):
            raise InputError(f"pieces must be polynomials, such as cubic(q0, q1, T); they are {self.pieces!r}")
        if len({piece.coefficients.shape[1] for piece in pieces}) > 1:
            raise InputError("the pieces must be of the same joints")
        object.__setattr__(self, "pieces", pieces)

    @property
    def duration(self) -> float:
        """T [s], the sum of the pieces'."""
        return float(self.knots[-1])

    @cached_property
    def rate(self) -> "PiecewiseTrajectory":
        """q̇: the rates of the pieces."""
        return PiecewiseTrajectory(tuple(piece.rate for piece in self.pieces))
