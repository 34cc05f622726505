"""Bases that keep their rank on all of a piece of the singular set, where such are found.

Elimination gives a basis that is right almost everywhere on the piece: a pivot may vanish at special points of it, and
vectors become parallel there. Then vectors are chosen anew, from the columns of J and their sums, or from those vectors
of the null space that have as many zeros as can be, so that they stay independent at special points too.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import combinations, islice

import numpy as np
import sympy

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.factoring import IrreducibleFactor
from robotics1.symbolic.polynomials.half_tangents import Degrees, highest_powers, in_half_angles
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial, TrigRing
from robotics1.symbolic.singular_sets.elimination import Row, primitive_row
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.locus_sampler import special_configurations
from robotics1.symbolic.writing.sums_of_angles import Groups, recognised, written_in_halves

POINTS = 60  # special configurations of a piece, and half as many random ones
INDEPENDENT = 1e-6  # σ_min of unit vectors that are independent
RANK = 1e-9  # σᵢ of J that count, beside the usual σ₁
MOST_CHOICES = 1500  # of vectors that are tried


@dataclass(frozen=True, eq=False)
class BasisVector:
    """A vector without common divisor; its entries are polynomials of the half angles, that vanish together only where
    they must.

    Attributes:
        trig_ring: of the entries.
        row: N(t) of each entry.
    """

    trig_ring: TrigRing
    row: Row

    @cached_property
    def degrees(self) -> Degrees:
        """The highest power of each tⱼ among the entries."""
        return highest_powers(self.trig_ring, self.row)

    @property
    def has_half_angles(self) -> bool:
        """Whether half angles are needed, as in (sin(q3/2), cos(q3/2))."""
        return any(e % 2 for e in self.degrees)

    @cached_property
    def entries(self) -> list[TrigPolynomial]:
        """The entries with multiples of φ/2 as exponents."""
        return [in_half_angles(self.trig_ring, entry, self.degrees) for entry in self.row]

    def written_in_halves(self, groups: Groups) -> list[sympy.Expr]:
        """Return the entries in SymPy, in half angles."""
        return [written_in_halves(entry, groups) for entry in self.entries]


@dataclass(frozen=True, eq=False)
class SpecialPoints:
    """Configurations of a piece at which J has the piece's rank; at most of them, joints at multiples of π/2.

    Attributes:
        parameters: the lengths.
        q: (k, n).
    """

    parameters: Mapping[sympy.Symbol, float]
    q: Array

    def values(self, vector: BasisVector) -> Array:
        """Return a vector at the points, (k, n), of length one; zero where its entries vanish together."""
        functions = [Evaluated(entry, self.parameters, unit=0.5) for entry in vector.entries]
        at = np.array([f.at_many(self.q) for f in functions]).T
        usual = np.abs(at).max(initial=0.0)
        lengths = np.linalg.norm(at, axis=1, keepdims=True)
        return np.where(lengths > RANK * usual, at / np.maximum(lengths, 1e-300), 0.0)


def special_points(M: Matrix, piece: Piece, rank: int) -> SpecialPoints:
    """Return special and random configurations of a piece at which M has this rank."""
    rng = np.random.default_rng(0)
    entries = [[Evaluated(entry, piece.parameters) for entry in row] for row in M]
    drawn = list(special_configurations(piece, rng, POINTS))
    sigmas = [np.linalg.svd([[f(q) for f in row] for row in entries], compute_uv=False) for q in drawn]
    usual = max((float(sigma[0]) for sigma in sigmas), default=0.0)
    kept = [q for q, sigma in zip(drawn, sigmas, strict=True) if (sigma > RANK * usual).sum() == rank]
    return SpecialPoints(piece.parameters, np.array(kept).reshape(len(kept), len(piece.locus.trig_ring.q)))


def keeps_rank(vectors: Sequence[Array]) -> bool:
    """Whether vectors, each (k, n), are independent at all of k points."""
    if not vectors or not len(vectors[0]):
        return True
    sigmas = np.linalg.svd(np.stack(vectors, axis=2), compute_uv=False)
    return bool(sigmas[:, -1].min() > INDEPENDENT)


def independent_vectors(
    basis: list[BasisVector], others: Iterable[BasisVector], points: SpecialPoints
) -> list[BasisVector]:
    """Return the basis, or as many vectors, of these and the others, that are independent at all points; the basis if
    there are none.
    """
    known = [points.values(vector) for vector in basis]
    if keeps_rank(known):
        return basis
    pool = sorted([*basis, *others], key=lambda vector: sum(map(len, vector.row)))
    values = [points.values(vector) for vector in pool]
    for chosen in islice(combinations(range(len(pool)), len(basis)), MOST_CHOICES):
        check_time()
        if keeps_rank([values[i] for i in chosen]):
            return [pool[i] for i in chosen]
    return basis


def sums_of(columns: Sequence[Sequence[TrigPolynomial]], locus: Locus) -> Iterator[BasisVector]:
    """Yield columns, their sums and their differences, on a locus."""
    for a in columns:
        yield from _vectors(a, locus)
    for a, b in combinations(columns, 2):
        yield from _vectors([x + y for x, y in zip(a, b, strict=True)], locus)
        yield from _vectors([x - y for x, y in zip(a, b, strict=True)], locus)


def _vectors(entries: Sequence[TrigPolynomial], locus: Locus) -> Iterator[BasisVector]:
    check_time()
    reduced = [locus.reduced(entry) for entry in entries]
    if any(reduced):
        yield BasisVector(locus.trig_ring, primitive_row(reduced, locus))


def vanishing_minors(vectors: Sequence[BasisVector]) -> list[TrigPolynomial]:
    """Return polynomials in whole angles that vanish together where the vectors lose their rank, and nowhere else."""
    F = vectors[0].trig_ring
    degrees = tuple(map(sum, zip(*(vector.degrees for vector in vectors), strict=True)))
    M = np.empty((len(vectors[0].row), len(vectors)), dtype=object)
    for i, j in np.ndindex(M.shape):
        M[i, j] = vectors[j].row[i]
    return [IrreducibleFactor(F, minor, degrees).whole for minor in minors_of_order(M, len(vectors)) if minor]


def scaled(vector: list[sympy.Expr]) -> list[sympy.Expr]:
    """Return the vector without the number that its entries share."""
    parts = [entry.as_content_primitive() for entry in recognised(vector)]
    common = reduce(sympy.gcd, [number for number, part in parts if part != 0])
    first = next(entry for entry in vector if entry != 0)
    sign = -1 if first.could_extract_minus_sign() else 1
    return [sign * number / common * part for number, part in parts]
