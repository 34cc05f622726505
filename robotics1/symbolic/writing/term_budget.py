"""Sums of products that are multiplied out while they are short, and left as they are where they would be long.

A polynomial of seven angles about different axes has hundreds of terms. A person writes the product of two short
matrices instead, and so is it done here: an entry is a trigonometric polynomial, or an expression in SymPy once it
would have had too many terms.
"""

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy

from robotics1.orientation.elementary import cross_matrix
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial, TrigRing
from robotics1.symbolic.writing.sums_of_angles import Groups, written

MOST_PRODUCTS = 1000  # of terms, that are tried
MOST_TERMS = 64  # of a polynomial that is not left as sum of products

Entry = Any  # a TrigPolynomial, or a sympy.Expr


@dataclass(frozen=True, eq=False)
class TermBudget:
    """How entries are added and multiplied.

    Attributes:
        trig_ring: of the polynomials.
        groups: the angles that are added up where they are written.
        most_products: the most products of terms that are tried.
        most_terms: the longest polynomial that is not left as a sum of products.
    """

    trig_ring: TrigRing
    groups: Groups
    most_products: int = MOST_PRODUCTS
    most_terms: int = MOST_TERMS
    _done: dict[TrigPolynomial, sympy.Expr] = field(default_factory=dict, repr=False)

    def written(self, entry: Entry) -> sympy.Expr:
        """Return an entry in SymPy; each is written once."""
        if not isinstance(entry, TrigPolynomial):
            return entry
        if entry not in self._done:
            self._done[entry] = written(entry, self.groups)
        return self._done[entry]

    def total(self, products: Iterable[tuple[Entry, Entry]], *others: Entry) -> Entry:
        """Return Σ a b + Σ others."""
        check_time()
        pairs = [(a, b) for a, b in products if a and b]
        rest = [entry for entry in others if entry]
        entries = [entry for pair in pairs for entry in pair] + rest
        polynomials = all(isinstance(entry, TrigPolynomial) for entry in entries)
        if polynomials and sum(len(a.terms) * len(b.terms) for a, b in pairs) <= self.most_products:
            found = sum((a * b for a, b in pairs), start=sum(rest, start=self.trig_ring.constant(0)))
            if len(found.terms) <= self.most_terms:
                return found
        parts = [self.written(a) * self.written(b) for a, b in pairs]
        return sympy.Add(*parts, *map(self.written, rest))

    def product(self, A: Matrix, B: Matrix) -> Matrix:
        """Return A B, of a matrix and a matrix or vector."""
        found = np.empty((len(A), *B.shape[1:]), dtype=object)
        for index in np.ndindex(found.shape):
            found[index] = self.total(zip(A[index[0]], B[(slice(None), *index[1:])], strict=True))
        return found

    def sum(self, A: Matrix, B: Matrix) -> Matrix:
        """Return A + B."""
        return np.asarray(np.frompyfunc(lambda a, b: self.total([], a, b), 2, 1)(A, B))

    def cross(self, A: Matrix, p: Matrix) -> Matrix:
        """Return a × p for the columns a of A, (3, n)."""
        return self.product(cross_matrix(-p), A)
