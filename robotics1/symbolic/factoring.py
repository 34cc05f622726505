"""Factors of a trigonometric polynomial that depend on one angle alone, such as sin(q3) and sin(q5).

Seen as a polynomial in zⱼ = exp(i φⱼ), with the other exponentials in its coefficients, the greatest common divisor
of these coefficients is the factor in φⱼ; one such division an angle, and one for the lengths, instead of a
factorization of the whole.
"""

from collections.abc import Iterable
from functools import reduce
from typing import Any

import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyElement, PolyRing

from robotics1.symbolic.laurent import Frequencies, Laurent, conjugate


def factors(f: Laurent) -> tuple[Laurent, ...]:
    """Return factors whose product is f: the lengths first, then one for each angle that can be split off, then
    the rest. A factor that is 1 is left out, unless f is 1.
    """
    found = []
    F = f.frequencies
    lengths = _gcd(f.terms.values())
    if lengths != F.ring.one:
        f = Laurent(F, {k: c.exquo(lengths) for k, c in f.terms.items()})
        found.append(F.constant(lengths))
    for j in range(len(F.angles)):
        alone = len({k[j] for k in f.terms}) > 1 and any(k[i] for k in f.terms for i in range(len(k)) if i != j)
        split = _split(f, j) if alone else None
        if split is not None:
            factor, f = split
            found.append(factor)
    one = len(f.terms) == 1 and f.terms.get(F.zero) == F.ring.one
    return tuple(found if one and found else [*found, f])


def _split(f: Laurent, j: int) -> tuple[Laurent, Laurent] | None:
    """Return (factor in angle j, rest), or None when there is none but a constant."""
    F = f.frequencies
    ring = PolyRing([sympy.Symbol("z"), *F.ring.symbols], QQ_I)
    low = min(k[j] for k in f.terms)
    coefficients: dict[tuple[int, ...], PolyElement] = {}
    for k, c in f.terms.items():
        others = (*k[:j], 0, *k[j + 1 :])
        lifted = ring.from_dict({(k[j] - low, *m): a for m, a in c.terms()})
        coefficients[others] = coefficients.get(others, ring.zero) + lifted
    divisor = _gcd(coefficients.values())
    degree = divisor.degree(ring.gens[0])
    if degree == 0 or degree % 2:
        return None
    factor = _real(_lowered(F, divisor, j, -degree // 2))
    if factor is None:
        return None
    phase = _phase(factor, divisor, j, degree)
    terms: dict[tuple[int, ...], PolyElement] = {}
    for others, c in coefficients.items():
        for k, value in _lowered(F, c.exquo(divisor) * (1 / phase), j, low + degree // 2).terms.items():
            full = tuple(a + b for a, b in zip(others, k, strict=True))
            terms[full] = terms.get(full, F.ring.zero) + value
    return factor, Laurent(F, terms)


def _phase(factor: Laurent, divisor: PolyElement, j: int, degree: int) -> Any:
    """Return the number by which the divisor was multiplied to become the real factor."""
    m, b = divisor.terms()[0]
    k = tuple(m[0] - degree // 2 if i == j else 0 for i in range(len(factor.frequencies.angles)))
    return factor.terms[k][m[1:]] / b


def _lowered(F: Frequencies, c: PolyElement, j: int, shift: int) -> Laurent:
    """Return a polynomial in z and the lengths as a Laurent polynomial in angle j, times z^shift."""
    terms: dict[tuple[int, ...], PolyElement] = {}
    for m, a in c.terms():
        k = tuple(m[0] + shift if i == j else 0 for i in range(len(F.angles)))
        terms[k] = terms.get(k, F.ring.zero) + F.ring.from_dict({m[1:]: a})
    return Laurent(F, terms)


def _real(f: Laurent) -> Laurent | None:
    """Return f times a power of i (or 1 ± i) that makes it real, c₋ₖ = conj(cₖ), or None."""
    F = f.frequencies
    for phase in (QQ_I(1, 0), QQ_I(0, 1), QQ_I(1, 1), QQ_I(1, -1)):
        g = Laurent(F, {k: c * phase for k, c in f.terms.items()})
        if all(g.terms.get(tuple(-n for n in k), F.ring.zero) == conjugate(c) for k, c in g.terms.items()):
            return g
    return None


def _gcd(polynomials: Iterable[PolyElement]) -> PolyElement:
    return reduce(lambda a, b: a.gcd(b), polynomials)
