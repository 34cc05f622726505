"""A set of configurations given by equations: joints that have a value, and equations that tie joints together."""

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
import numpy.typing as npt
import sympy

from robotics1.angles import TURN, clean_angle
from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.symbolic.polynomials.evaluation import Evaluated, evaluated_factor
from robotics1.symbolic.polynomials.factoring import IrreducibleFactor
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial, TrigRing
from robotics1.symbolic.singular_sets.zeros import Substitution, Zero

ROUNDING = 1e-14  # of a coefficient, beside the largest
HOLDS = 1e-10  # of an equation, beside the sum of its terms


@dataclass(frozen=True, eq=False)
class Locus:
    """The configurations at which some joints are functions of the others, and some polynomials vanish.

    Attributes:
        trig_ring: of the polynomials.
        substitutions: joint = value; no value holds a joint that has been replaced.
        zeros: what was set to zero, one thing after the other; the implicit equations with the joints replaced.
        in_numbers: whether joints were given values that were found in numbers, so that what is rounding beside the
            largest coefficient is zero.
    """

    trig_ring: TrigRing
    substitutions: tuple[Substitution, ...] = ()
    zeros: tuple[Zero, ...] = ()
    in_numbers: bool = False

    @cached_property
    def implicit(self) -> tuple[IrreducibleFactor, ...]:
        """The irreducible parts that vanish and tie joints together, or lengths."""
        return tuple(zero.part for zero in self.zeros if zero.part is not None)

    @cached_property
    def equations(self) -> tuple[TrigPolynomial, ...]:
        """Polynomials that vanish on the locus, and nowhere else."""
        return tuple(zero.equation for zero in self.zeros)

    @property
    def key(self) -> Hashable:
        """What is the same of two loci with the same joint values and the same implicit equations."""
        values = {(s.symbol, frozenset(s.value.terms.items())) for s in self.substitutions}
        return frozenset(values), frozenset((str(part.numerator), part.degrees) for part in self.implicit)

    def reduced(self, f: TrigPolynomial) -> TrigPolynomial:
        """Return f on the locus, with joints replaced; zero if one of the implicit equations divides it.

        On an irreducible hypersurface a polynomial vanishes only if it is a multiple of the hypersurface's own.
        """
        largest = f.largest if self.in_numbers else 0.0
        for substitution in self.substitutions:
            f = substitution(f)
        if self.in_numbers:
            f = f.without_rounding(ROUNDING * largest)
        return self.trig_ring.constant(0) if any(part.divides(f) for part in self.implicit) else f

    def where(self, zero: Zero) -> "tuple[Locus, list[TrigPolynomial]]":
        """Return the part on which one more polynomial vanishes, and what else must vanish there: implicit
        equations in which a joint was replaced, since they may fall into factors.
        """
        new = zero.substitution
        if new is None:
            return replace(self, zeros=(*self.zeros, zero)), []
        values = [replace(old, value=new(old.value)) for old in self.substitutions]
        changed = [old for old in self.zeros if old.part is not None and new.symbol in old.part.symbols]
        kept = tuple(old for old in self.zeros if old not in changed)
        reopened = [old.part.whole for old in changed if old.part is not None]
        return replace(self, substitutions=(*values, new), zeros=(*kept, zero)), reopened

    @cached_property
    def joints(self) -> tuple[int, ...]:
        """The joints that matter on the locus: those that have a value, or are in one, or in an implicit equation."""
        valued = [{s.symbol, *s.value.symbols} for s in self.substitutions]
        used = set().union(*valued, *(part.symbols for part in self.implicit))
        return tuple(i for i, symbol in enumerate(self.trig_ring.q) if symbol in used)


@dataclass(frozen=True, eq=False)
class Piece:
    """A locus at given lengths, with one value of each joint for which the equations allow several.

    Attributes:
        locus: the equations.
        parameters: the lengths.
        pinned: joint → its value, where the equations allow several and this one is meant.
    """

    locus: Locus
    parameters: Mapping[sympy.Symbol, float]
    pinned: Mapping[int, float]

    @property
    def key(self) -> Hashable:
        """What is the same of two pieces with the same equations and choices."""
        return self.locus.key, frozenset(self.pinned.items())

    @cached_property
    def angles(self) -> npt.NDArray[np.bool_]:
        """(n,) which joints turn."""
        F = self.locus.trig_ring
        return np.array([symbol in F.angles for symbol in F.q])

    @cached_property
    def turns(self) -> Array:
        """(n,) how many turns of each joint bring everything back."""
        F = self.locus.trig_ring
        return np.array([float(F.turns_of(symbol)) for symbol in F.q])

    @property
    def period(self) -> Array:
        """(n,) what may be added to each joint: whole turns of angles [rad]; nothing to slides."""
        return np.where(self.angles, TURN * self.turns, 0.0)

    @cached_property
    def equations(self) -> list[Evaluated]:
        """The implicit equations as functions of q."""
        return [evaluated_factor(part, self.parameters) for part in self.locus.implicit]

    @cached_property
    def _values(self) -> dict[int, tuple[bool, Evaluated]]:
        """Each joint that has a value: whether it is an angle, and the value."""
        q = self.locus.trig_ring.q
        replaced = [s for s in self.locus.substitutions if s.symbol in q]
        return {q.index(s.symbol): (s.is_angle, Evaluated(s.value, self.parameters)) for s in replaced}

    @property
    def valued(self) -> list[int]:
        """The joints that have a value, constant or a function of other joints."""
        return list(self._values)

    @property
    def constant(self) -> tuple[int, ...]:
        """The joints that have one value on all of the piece."""
        q = set(self.locus.trig_ring.q)
        fixed = {i for i, (_, value) in self._values.items() if not value.f.symbols & q}
        return tuple(sorted(fixed | set(self.pinned)))

    @property
    def is_regular(self) -> bool:
        """Whether no equation ties two joints together."""
        return all(len(part.symbols & set(self.locus.trig_ring.q)) < 2 for part in self.locus.implicit)

    def with_pinned(self, q: Array) -> Array:
        """Return a copy of q with the values that are meant."""
        q = q.copy()
        for i, value in self.pinned.items():
            q[i] = value
        return q

    def completed(self, q: Array) -> Array:
        """Return q, in place, with the values of the joints that have one."""
        for i, (is_angle, f) in self._values.items():
            q[i] = self.turns[i] * clean_angle(float(np.angle(f.complex(q)))) if is_angle else f(q)
        return q

    def contains(self, q: Array, tolerance: float = HOLDS) -> bool:
        """Return whether q is on the piece: its equations hold to the tolerance, beside the sum of their terms."""
        equations = [Evaluated(equation, self.parameters) for equation in self.locus.equations]
        pinned = all(abs(np.exp(1j * (q[i] - x) / self.turns[i]) - 1) < 1e-6 for i, x in self.pinned.items())
        return pinned and all(abs(f(q)) <= tolerance * f.size for f in equations)

    def dimension(self, q: Array) -> int:
        """Return the dimension of the piece at one of its points."""
        moving = [i for i in range(len(q)) if i not in self._values and i not in self.pinned]
        gradients = np.array([g.gradient(q)[moving] / max(g.size, 1e-300) for g in self.equations])
        tied = int(np.linalg.matrix_rank(gradients, tol=1e-9)) if len(gradients) else 0
        return len(moving) - tied

    def is_degenerate(self, q: Array, small: float) -> bool:
        """Return whether the gradients of the implicit equations at q are dependent, to `small`."""
        gradients = np.array([g.gradient(q) / g.size for g in self.equations if g.size])
        if len(gradients) > gradients.shape[1]:
            return True
        return bool(np.linalg.svd(gradients, compute_uv=False)[-1] <= small)


def pieces_of(locus: Locus, parameters: Mapping[sympy.Symbol, float]) -> Iterator[Piece]:
    """Yield the locus once for each choice among the values that an equation in one joint allows."""
    q = locus.trig_ring.q
    choices = []
    for part in locus.implicit:
        joints = [i for i, symbol in enumerate(q) if symbol in part.symbols]
        if len(joints) == 1:
            values = evaluated_factor(part, parameters).zeros_in(joints[0], np.zeros(len(q)))
            choices.append([(joints[0], value) for value in values])
    for choice in product(*choices):
        yield Piece(locus, parameters, dict(choice))
