"""The tangent half-angle substitution: a real trigonometric polynomial as a polynomial with rational coefficients.

With tⱼ = tan(φⱼ/2) is exp(i φⱼ) = (1 + i tⱼ)/(1 − i tⱼ), and

f(φ) = N(t) / Πⱼ (1 + tⱼ²)^dⱼ,   N ∈ ℚ[lengths, t₁, t₂, ...],

where dⱼ is the highest multiple of φⱼ in f. N has at most the degree 2dⱼ in tⱼ; what is missing is a zero at
tⱼ = ∞, which is φⱼ = π. N is what can be divided and factored. A factor of degree eⱼ in tⱼ stands for
N(t) / Πⱼ (1 + tⱼ²)^(eⱼ/2), a polynomial in the half angles φⱼ/2, and in the angles themselves when all eⱼ are even.
"""

from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import Any

from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyElement, ring

from robotics1.symbolic.polynomials.time_limit import check_time, check_time_to_divide
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, Exponents, TrigPolynomial, TrigRing, gaussian

Degrees = tuple[int, ...]  # dⱼ, one for each angle
_, Y = ring("y", QQ_I)


def highest_multiples(f: TrigPolynomial) -> Degrees:
    """Return dⱼ, the highest multiple of each angle."""
    return tuple(max((abs(k[j]) for k in f.terms), default=0) for j in range(len(f.trig_ring.angles)))


def highest_powers(F: TrigRing, row: Sequence[fmpq_mpoly]) -> Degrees:
    """Return the highest power of each tⱼ among numerators; () where all are zero."""
    lengths = len(F.ring.symbols)
    powers = [map(int, N.degrees()[lengths:]) for N in row if not N.is_zero()]
    return tuple(map(max, zip(*powers, strict=True)))


@lru_cache(maxsize=4096)
def numerator(f: TrigPolynomial) -> fmpq_mpoly:
    """Return N(t) of a real f."""
    terms = _change_exponents(f.terms, highest_multiples(f), _half_tangent_powers)
    numbers: dict[tuple[int, ...], fmpq] = {}
    for t, c in terms.items():
        for m, a in c.terms():
            numbers[m + t] = fmpq(int(a.x.numerator), int(a.x.denominator))
    return context(f.trig_ring).from_dict(numbers)


def in_half_angles(F: TrigRing, N: fmpq_mpoly, e: Degrees) -> TrigPolynomial:
    """Return N(t) / Πⱼ (1 + tⱼ²)^(eⱼ/2) as a polynomial in the exponentials exp(i φⱼ/2) of the half angles."""
    lengths = len(F.ring.symbols)
    terms: dict[Exponents, dict[tuple[int, ...], Any]] = {}
    for powers, a in N.to_dict().items():
        m = tuple(map(int, powers))
        terms.setdefault(m[lengths:], {})[m[:lengths]] = gaussian(a)
    polynomials = {t: F.ring.from_dict(c) for t, c in terms.items()}
    return TrigPolynomial(F, _change_exponents(polynomials, e, _half_angle_powers))


def from_numerator(F: TrigRing, N: fmpq_mpoly, d: Degrees) -> TrigPolynomial:
    """Return f = N(t) / Πⱼ (1 + tⱼ²)^dⱼ."""
    halves = in_half_angles(F, N, tuple(2 * dj for dj in d))
    return TrigPolynomial(F, {tuple(k // 2 for k in half): c for half, c in halves.terms.items()})


@cache
def context(F: TrigRing) -> fmpq_mpoly_ctx:
    """Return the ring ℚ[lengths, t₁, t₂, ...]: the generators of F.ring, then one for each angle."""
    names = [f"x{i}" for i in range(len(F.ring.symbols) + len(F.angles))]
    return fmpq_mpoly_ctx.get(names, Ordering.degrevlex)


def without_squares(F: TrigRing, N: fmpq_mpoly) -> fmpq_mpoly:
    """Return N with the squares of the generators √2 and √3 replaced by 2 and 3; zero if N is zero."""
    for root, square in roots(F):
        if N.degrees()[int(root.degrees().index(1))] > 1:
            N = N % (root**2 - square)
    return N


def is_multiple(F: TrigRing, f: fmpq_mpoly, g: fmpq_mpoly) -> bool:
    """Return whether g divides f over ℚ(√2, √3): f/g = f g' / (g g') with the other conjugates g', and g g' over ℚ."""
    others = context(F).constant(1)
    norm = g
    for root, _ in roots(F):
        conjugated = _with_opposite(norm, root)
        if conjugated != norm:
            others = without_squares(F, others * conjugated)
            norm = without_squares(F, norm * conjugated)
    check_time_to_divide(f, norm)
    return (without_squares(F, f * others) % norm).is_zero()


def roots(F: TrigRing) -> list[tuple[fmpq_mpoly, int]]:
    """Return the generators √2 and √3, with their squares."""
    generators = context(F).gens()
    return [(generators[i], ROOTS[str(s)]) for i, s in enumerate(F.ring.symbols) if str(s) in ROOTS]


def _with_opposite(N: fmpq_mpoly, root: fmpq_mpoly) -> fmpq_mpoly:
    """Return N with −√k in the place of √k."""
    i = int(root.degrees().index(1))
    return N.context().from_dict({m: -a if int(m[i]) % 2 else a for m, a in N.to_dict().items()})


def _change_exponents(
    terms: dict[Exponents, PolyElement], d: Degrees, expansion: Callable[[int, int], dict[int, Any]]
) -> dict[Exponents, PolyElement]:
    """Replace the power k of each variable, one after the other, by the sum Σ c yᵐ of `expansion(k, dⱼ)`."""
    for j, dj in enumerate(d):
        if dj == 0:
            continue
        changed: dict[Exponents, PolyElement] = {}
        for k, c in terms.items():
            check_time()
            for power, factor in expansion(k[j], dj).items():
                key = (*k[:j], power, *k[j + 1 :])
                value = c * factor
                changed[key] = changed[key] + value if key in changed else value
        terms = changed
    return {k: c for k, c in terms.items() if c}


@cache
def _half_tangent_powers(k: int, d: int) -> dict[int, Any]:
    """Return the coefficients of (1 + it)^(d+k) (1 − it)^(d−k): those of exp(i k φ) (1 + t²)^d."""
    return _binomial_product(QQ_I(0, 1), QQ_I(0, -1), d + k, d - k)


@cache
def _half_angle_powers(m: int, e: int) -> dict[int, Any]:
    """Return the coefficients of tᵐ / (1 + t²)^(e/2) = (−i (w − 1/w))ᵐ (w + 1/w)^(e−m) / 2^e, with w = exp(i φ/2)."""
    product = _binomial_product(QQ_I(-1, 0), QQ_I(1, 0), m, e - m)  # (1 − w²)ᵐ (1 + w²)^(e−m)
    front = QQ_I(0, 1) ** m / QQ_I(2, 0) ** e  # −i (w − 1/w) = i (1 − w²) / w
    return {2 * power - e: front * c for power, c in product.items()}


def _binomial_product(a: Any, b: Any, p: int, q: int) -> dict[int, Any]:
    """Return the coefficients of (1 + a y)ᵖ (1 + b y)^q."""
    product = (1 + a * Y) ** p * (1 + b * Y) ** q
    return {power: c for (power,), c in product.terms()}
