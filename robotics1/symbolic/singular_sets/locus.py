"""A set of configurations given by equations: joints that have a value, and equations that tie joints together."""

from collections.abc import Hashable
from dataclasses import dataclass, replace

from robotics1.caching import cached_property
from robotics1.symbolic.polynomials.factoring import Part
from robotics1.symbolic.polynomials.laurent import Frequencies, Laurent
from robotics1.symbolic.polynomials.substitution import Substitution
from robotics1.symbolic.singular_sets.zeros import Zero

ROUNDING = 1e-14  # of a coefficient, beside the largest


@dataclass(frozen=True, eq=False)
class Locus:
    """The configurations at which some joints are functions of the others, and some polynomials vanish.

    Attributes:
        frequencies: of the polynomials.
        substitutions: joint = value; no value holds a joint that has been replaced.
        zeros: what was set to zero, one thing after the other; the implicit equations with the joints replaced.
        in_numbers: whether joints were given values that were found in numbers, so that what is rounding beside the
            largest coefficient is zero.
    """

    frequencies: Frequencies
    substitutions: tuple[Substitution, ...] = ()
    zeros: tuple[Zero, ...] = ()
    in_numbers: bool = False

    @cached_property
    def implicit(self) -> tuple[Part, ...]:
        """The irreducible parts that vanish and tie joints together, or lengths."""
        return tuple(zero.part for zero in self.zeros if zero.part is not None)

    @cached_property
    def equations(self) -> tuple[Laurent, ...]:
        """Polynomials that vanish on the locus, and nowhere else."""
        return tuple(zero.equation for zero in self.zeros)

    @property
    def key(self) -> Hashable:
        """What is the same of two loci with the same joint values and the same implicit equations."""
        values = {(s.symbol, frozenset(s.value.terms.items())) for s in self.substitutions}
        return frozenset(values), frozenset((str(part.numerator), part.degrees) for part in self.implicit)

    def reduced(self, f: Laurent) -> Laurent:
        """Return f on the locus, with joints replaced; zero if one of the implicit equations divides it.

        On an irreducible hypersurface a polynomial vanishes only if it is a multiple of the hypersurface's own.
        """
        largest = f.largest if self.in_numbers else 0.0
        for substitution in self.substitutions:
            f = substitution(f)
        if self.in_numbers:
            f = f.without_rounding(ROUNDING * largest)
        return self.frequencies.constant(0) if any(part.divides(f) for part in self.implicit) else f

    def where(self, zero: Zero) -> "tuple[Locus, list[Laurent]]":
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

    def rounded(self) -> "Locus":
        """Return the locus, on which coefficients that are rounding are zero."""
        return replace(self, in_numbers=True)

    @cached_property
    def joints(self) -> tuple[int, ...]:
        """The joints that matter on the locus: those that have a value, or are in one, or in an implicit equation."""
        valued = [{s.symbol, *s.value.symbols} for s in self.substitutions]
        used = set().union(*valued, *(part.symbols for part in self.implicit))
        return tuple(i for i, symbol in enumerate(self.frequencies.q) if symbol in used)
