"""Trigonometric polynomials written as a person writes them.

Angles of joints with parallel axes are added up, cos(q2 + q3); those of others stand beside each other,
cos(q1) cos(q2 + q3). What all terms share stands in front.
"""

from itertools import product
from typing import NamedTuple

import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyElement

from robotics1.symbolic.laurent import Laurent, polynomial

Groups = tuple[tuple[int, ...], ...]  # the places of angles that are added up


class Wave(NamedTuple):
    """cos(m·φ) or sin(m·φ), with the first multiple that is not zero positive."""

    multiples: tuple[int, ...]
    sine: bool


def written(f: Laurent, groups: Groups) -> sympy.Expr:
    """Return a real trigonometric polynomial in SymPy, angles added up within the groups."""
    terms = _in_waves(f, groups)
    if not terms:
        return sympy.S.Zero
    waves = [set(key) for key in terms]
    shared = set.intersection(*waves)
    lengths = _shared_monomial(list(terms.values()))
    total = sympy.Add(
        *(
            polynomial(c.quo(lengths)) * sympy.Mul(*(_wave(wave, f) for wave in key if wave not in shared))
            for key, c in sorted(terms.items(), key=lambda item: str(item[0]), reverse=True)
        )
    )
    return polynomial(lengths) * sympy.Mul(*(_wave(wave, f) for wave in shared)) * total


def _in_waves(f: Laurent, groups: Groups) -> dict[tuple[Wave, ...], PolyElement]:
    """Return f as a sum of products of waves, one of each group at most."""
    i = f.frequencies.ring(QQ_I(0, 1))
    terms: dict[tuple[Wave, ...], PolyElement] = {}
    for k, c in f.terms.items():
        choices = []
        for group in groups:
            m = tuple(k[j] if j in group else 0 for j in range(len(k)))
            first = next((value for value in m if value), 0)
            if first == 0:
                continue
            positive = m if first > 0 else tuple(-value for value in m)
            # exp(i m·φ) = cos ± i sin
            choices.append(((Wave(positive, False), 1), (Wave(positive, True), i if first > 0 else -i)))
        for combination in product(*choices):
            key = tuple(wave for wave, _ in combination)
            value = c
            for _, factor in combination:
                value = value * factor
            terms[key] = terms.get(key, f.frequencies.ring.zero) + value
    return {key: c for key, c in terms.items() if c}


def _shared_monomial(coefficients: list[PolyElement]) -> PolyElement:
    """Return the product of lengths that divides all coefficients."""
    ring = coefficients[0].ring
    powers = [min(powers) for powers in zip(*(m for c in coefficients for m in c.itermonoms()), strict=True)]
    return ring.from_dict({tuple(powers): ring.domain.one})


def _wave(wave: Wave, f: Laurent) -> sympy.Expr:
    angle = sum(m * phi for m, phi in zip(wave.multiples, f.frequencies.angles, strict=True))
    return sympy.sin(angle) if wave.sine else sympy.cos(angle)


def written_product(factors: tuple[Laurent, ...], groups: Groups) -> sympy.Expr:
    """Return a product of trigonometric polynomials in SymPy: one number in front, and each factor without its own."""
    number: sympy.Expr = sympy.S.One
    parts = []
    for factor in factors:
        content, part = written(factor, groups).as_content_primitive()
        if part.could_extract_minus_sign():
            content, part = -content, -part
        number *= content
        parts.append(part)
    return number * sympy.Mul(*parts)
