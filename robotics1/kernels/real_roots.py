"""The real roots of an equation in one joint coordinate: none is missed, and one that is nearly double is seen."""

import math

from robotics1.inputs import Array
from robotics1.kernels.compilation import compiled

ABSENT = 1e-11  # of coefficients, beside the largest, that are rounding
VANISHES = 1e-9  # of an equation with coefficients of about 1
NEAR = 1e-3  # of a discriminant, beside its terms: roots that nearly meet are looked at
NEARLY_ZERO = 1e-4  # of a polynomial at its extremes, beside its terms
NEARLY_ZERO_AT_0 = 1e-7  # beside the largest coefficient: at t = 0 the constant is the only term
EDGE = 1.0 + 1e-6  # where the middle ends: a root at ±1 is then found from both sides, and not missed by rounding
SETTLED = 1e-10  # a step in a bracket behind which no other is needed: roots are polished by those who ask for them
MANY = 24  # roots that are kept
UNKNOWN = -1  # instead of a number of roots


@compiled(inner=True)
def roots_of_one(slides: float, f0: float, f1: float, f2: float, roots: Array) -> int:
    """Write where f vanishes to roots, (2,), and return how many there are; UNKNOWN where f vanishes everywhere.

    Where a double root is just missed, it is given.
    """
    size = abs(f0) + abs(f1) + abs(f2)
    if f1 * f1 + f2 * f2 <= ABSENT * size * ABSENT * size:
        return UNKNOWN if abs(f0) <= VANISHES else 0
    if slides:
        return roots_of_quadratic(f0, f1, f2, size, roots)
    square = f1 * f1 + f2 * f2
    discriminant = square - f0 * f0
    if discriminant < -NEAR * square:
        return 0
    middle, half = math.atan2(f2, f1), math.atan2(math.sqrt(max(discriminant, 0.0)), -f0)
    roots[0], roots[1] = middle - half, middle + half
    return 2 if discriminant > 0.0 else 1


@compiled(inner=True)
def roots_of_quadratic(f0: float, f1: float, f2: float, size: float, roots: Array) -> int:
    """Do what `roots_of_one` does for f₀ + f₁ d + f₂ d²."""
    if abs(f2) <= ABSENT * size:
        roots[0] = -f0 / f1
        return 1
    discriminant = f1 * f1 - 4.0 * f2 * f0
    if discriminant < -NEAR * (f1 * f1 + 4.0 * abs(f2 * f0)):
        return 0
    if discriminant <= 0.0:
        roots[0] = -0.5 * f1 / f2
        return 1
    larger = -0.5 * (f1 + math.copysign(math.sqrt(discriminant), f1))
    roots[0], roots[1] = larger / f2, f0 / larger
    return 2


@compiled(inner=True)
def value_of(p: Array, degree: int, t: float) -> tuple[float, float, float]:
    """Return p(t), its derivative, and the sum of the sizes of the terms, by Horner's scheme."""
    value, slope, size = p[degree], 0.0, abs(p[degree])
    for i in range(degree - 1, -1, -1):
        slope = slope * t + value
        value = value * t + p[i]
        size = size * abs(t) + abs(p[i])
    return value, slope, size


@compiled(inner=True)
def bracketed_root(p: Array, degree: int, low: float, high: float, at_low: float) -> float:
    """Return the root of p between low and high, where its signs differ: Newton's method kept in the bracket."""
    t = 0.5 * (low + high)
    for _ in range(80):
        value, slope, _ = value_of(p, degree, t)
        step = value / slope if slope != 0.0 else high - low
        if abs(step) <= SETTLED:  # before the bracket is asked, whose end t may be
            return min(max(t - step, low), high)
        if (value < 0.0) == (at_low < 0.0):
            low = t
        else:
            high = t
        ahead = t - step
        if not low < ahead < high:
            ahead = 0.5 * (low + high)
        if abs(ahead - t) <= SETTLED:
            return ahead
        t = ahead
    return t


@compiled(inner=True)
def roots_in_the_middle(p: Array, work: Array, roots: Array) -> int:
    """Write the real roots of p in ±EDGE to roots and return how many there are; extremes near zero count too.

    Between two neighbouring roots of its derivative a polynomial has at most one root: so from the last derivative,
    which is linear, up to p itself none is missed.

    Args:
        p: (degree + 1,) coefficients, the constant first.
        work: (3, 16) or more rows of working space.
        roots: (MANY,).
    """
    derivative, extremes, found = work[0], work[1], work[2]
    degree, count = len(p) - 1, 0
    for order in range(degree - 1, -1, -1):
        factor = 1.0
        for i in range(order, degree + 1):  # i over order, in Pascal's triangle
            derivative[i - order] = p[i] * factor
            factor *= (i + 1.0) / (i + 1.0 - order)
        many = 0
        low, at_low = -EDGE, value_of(derivative, degree - order, -EDGE)[0]
        for i in range(count + 1):
            high = extremes[i] if i < count else EDGE
            at_high = value_of(derivative, degree - order, high)[0]
            if (at_low < 0.0) != (at_high < 0.0):
                found[many] = bracketed_root(derivative, degree - order, low, high, at_low)
                many += 1
            low, at_low = high, at_high
        if order == 0:
            break
        count = many
        for i in range(many):
            extremes[i] = found[i]
    for i in range(many):
        roots[i] = found[i]
    largest = 0.0
    for i in range(degree + 1):
        largest = max(largest, abs(p[i]))
    for i in range(count):
        value, _, size = value_of(p, degree, extremes[i])
        if abs(value) < max(NEARLY_ZERO * size, NEARLY_ZERO_AT_0 * largest):
            roots[many] = extremes[i]
            many += 1
    return many


@compiled(inner=True)
def roots_of_polynomial(slides: float, p: Array, work: Array, roots: Array) -> int:
    """Write to roots, (MANY,), the coordinates at which a polynomial of degree 8 in tan(θ/2), or in d, vanishes."""
    back = work[3, :9]
    for i in range(9):
        back[i] = p[8 - i]
    count = roots_in_the_middle(p, work, roots)
    for i in range(count):
        roots[i] = roots[i] if slides else 2.0 * math.atan(roots[i])
    outer = roots[count:]
    many = roots_in_the_middle(back, work, outer)
    kept = 0
    for i in range(many):
        s = outer[i]
        if not slides:
            outer[kept] = 2.0 * math.atan2(1.0, s)
            kept += 1
        elif abs(s) > ABSENT:
            outer[kept] = 1.0 / s
            kept += 1
    return count + kept
