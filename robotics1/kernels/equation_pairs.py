"""The common roots of two equations in two joint coordinates, each at most quadratic in both: `ik/common_roots.py`,
compiled, for targets at which no two roots meet.

A function of one coordinate is f₀ + f₁ cos θ + f₂ sin θ of a joint that turns, f₀ + f₁ d + f₂ d² of one that slides:
three values determine it. In t = tan(θ/2) the first is (f₀ + f₁) + 2 f₂ t + (f₀ − f₁) t², over 1 + t².
"""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.compilation import compiled
from robotics1.kernels.real_roots import ABSENT, MANY, UNKNOWN, VANISHES, roots_of_one, roots_of_polynomial
from robotics1.kernels.scratch import scratch

ROUNDED = 1e-9  # of coefficients that are the digits of a file
ARBITRARY = 1e-5  # of all coefficients in the second coordinate: any value may solve them
PLAUSIBLE, MISS = 0.02, 1e-4  # residual with which Newton's method begins, and ends
CLEAR = 1e-2  # of a coefficient of an equation of about 1 that is not about to vanish
QUADRATIC = 1e-11  # a step of Newton's method behind which the error is rounding
SAME = 1e-8  # distance of two roots that are one
TWICE = 2 * MANY


@compiled(inline=True, inner=True)
def sample(slides: float, k: int, p: Array, moved: Array) -> None:
    """Write Z(x) p to moved, (3,), at the sample x number k: 0, π/2, π of a joint that turns, −1, 0, 1 of the other."""
    moved[2] = p[2]
    if slides:
        moved[0], moved[1] = p[0], p[1]
        moved[2] += k - 1.0
    elif k == 1:
        moved[0], moved[1] = -p[1], p[0]
    else:
        moved[0], moved[1] = (1.0 - k) * p[0], (1.0 - k) * p[1]


@compiled(inline=True, inner=True)
def function_of_samples(slides: float, a: float, b: float, c: float) -> tuple[float, float, float]:
    """Return f₀, f₁, f₂ from the values at the three samples."""
    if slides:
        return b, 0.5 * (c - a), 0.5 * (a + c) - b
    return 0.5 * (a + c), 0.5 * (a - c), b - 0.5 * (a + c)


@compiled(inner=True)
def functions_of_samples(first: float, second: float, F: Array) -> None:
    """Overwrite values at all samples, (3, 3), with coefficients: the first coordinate's down, the second's across."""
    for i in range(3):
        F[i, 0], F[i, 1], F[i, 2] = function_of_samples(second, F[i, 0], F[i, 1], F[i, 2])
    for j in range(3):
        F[0, j], F[1, j], F[2, j] = function_of_samples(first, F[0, j], F[1, j], F[2, j])


@compiled(inline=True, inner=True)
def basis(slides: float, x: float, b: Array) -> None:
    """Write (1, cos x, sin x), or (1, x, x²), to b, (3,)."""
    b[0] = 1.0
    if slides:
        b[1], b[2] = x, x * x
    else:
        b[1], b[2] = math.cos(x), math.sin(x)


@compiled(inner=True)
def scaled_to_one(F: Array) -> bool:
    """Divide F, (3, 3), by its largest entry; return whether there is one above rounding."""
    largest = 0.0
    for i in range(3):
        for j in range(3):
            largest = max(largest, abs(F[i, j]))
    if largest < ABSENT:
        return False
    for i in range(3):
        for j in range(3):
            F[i, j] /= largest
    return True


@compiled(inner=True)
def lacks_the_second(F: Array, G: Array) -> bool:
    """Add a multiple of F to G so that the second coordinate leaves G, and return True; False if none does so."""
    ff, fg, gg = 0.0, 0.0, 0.0
    for i in range(3):
        for j in range(1, 3):
            ff += F[i, j] * F[i, j]
            fg += F[i, j] * G[i, j]
            gg += G[i, j] * G[i, j]
    if ff <= ABSENT * ABSENT and gg > ABSENT * ABSENT:
        for i in range(3):
            for j in range(3):
                F[i, j], G[i, j] = G[i, j], F[i, j]
        return True
    factor = fg / ff if ff > ABSENT * ABSENT else 0.0
    left = 0.0
    for i in range(3):
        for j in range(1, 3):
            rest = G[i, j] - factor * F[i, j]
            left += rest * rest
    if left > ROUNDED * ROUNDED * gg and gg > ABSENT * ABSENT:
        return False
    for i in range(3):
        for j in range(3):
            G[i, j] = 0.0 if j else G[i, 0] - factor * F[i, 0]
    return True


@compiled(inner=True)
def transpose(F: Array) -> None:
    """Exchange the coordinates of F, (3, 3)."""
    for i in range(3):
        for j in range(i):
            F[i, j], F[j, i] = F[j, i], F[i, j]


@compiled(inner=True)
def common_roots(F: Array, G: Array, first: float, second: float, pairs: Array) -> int:
    """Write the coordinates at which F = G = 0 to pairs, (MANY, 2), and return how many there are.

    UNKNOWN where they are not finitely many, or the equations do not tell.

    Args:
        F, G: (3, 3) coefficients, which are overwritten.
        first, second: whether each coordinate slides.
        pairs: the result.
    """
    if not (scaled_to_one(F) and scaled_to_one(G)):
        return UNKNOWN
    for flipped in range(2):
        if lacks_the_second(F, G):
            if not scaled_to_one(G):
                return UNKNOWN
            return one_after_the_other(F, G, first, second, flipped, pairs)
        transpose(F)
        transpose(G)
        first, second = second, first
    work, resultant = scratch((4, 16)), scratch(9)
    for flipped in range(2):
        if resultant_of(F, G, first, second, resultant):
            return both_at_once(F, G, first, second, flipped, resultant, work, pairs)
        transpose(F)
        transpose(G)
        first, second = second, first
    return UNKNOWN


@compiled(inner=True)
def one_after_the_other(F: Array, G: Array, first: float, second: float, flipped: int, pairs: Array) -> int:
    """Do what `common_roots` does where G lacks the second coordinate."""
    b, x, y = scratch(3), scratch(2), scratch(2)
    count = 0
    many = roots_of_one(first, G[0, 0], G[1, 0], G[2, 0], x)
    if many == UNKNOWN:
        return UNKNOWN
    for i in range(many):
        basis(first, x[i], b)
        f0 = b[0] * F[0, 0] + b[1] * F[1, 0] + b[2] * F[2, 0]
        f1 = b[0] * F[0, 1] + b[1] * F[1, 1] + b[2] * F[2, 1]
        f2 = b[0] * F[0, 2] + b[1] * F[1, 2] + b[2] * F[2, 2]
        if abs(f0) + abs(f1) + abs(f2) < ARBITRARY:
            return UNKNOWN
        of_second = roots_of_one(second, f0, f1, f2, y)
        if of_second == UNKNOWN:
            return UNKNOWN
        for j in range(of_second):
            pairs[count, flipped], pairs[count, 1 - flipped] = x[i], y[j]
            count += 1
    return count


@compiled(inner=True)
def in_half_tangents(F: Array, first: float, second: float, p: Array) -> None:
    """Write F, (3, 3), as polynomials in the half tangents of joints that turn, times 1 + t² of each, to p, (3, 3).

    Row j of p belongs to the power j of the second coordinate, and column i to the power i of the first.
    """
    for i in range(3):
        for j in range(3):
            p[j, i] = F[i, j]
    if not first:
        for j in range(3):
            f0, f1, f2 = p[j, 0], p[j, 1], p[j, 2]
            p[j, 0], p[j, 1], p[j, 2] = f0 + f1, 2.0 * f2, f0 - f1
    if not second:
        for i in range(3):
            f0, f1, f2 = p[0, i], p[1, i], p[2, i]
            p[0, i], p[1, i], p[2, i] = f0 + f1, 2.0 * f2, f0 - f1


@compiled(inner=True)
def resultant_of(F: Array, G: Array, first: float, second: float, resultant: Array) -> bool:
    """Write the polynomial in the first coordinate that vanishes where F and G share a root in the second, (9,).

    (a₀b₂ − a₂b₀)² − (a₀b₁ − a₁b₀)(a₁b₂ − a₂b₁) of two quadratics; return whether it is above rounding.
    """
    a, b, minors = scratch((3, 3)), scratch((3, 3)), scratch((3, 5))
    in_half_tangents(F, first, second, a)
    in_half_tangents(G, first, second, b)
    for k in range(3):
        i, j = (0 if k < 2 else 1), (2 if k != 1 else 1)  # (0, 2), (0, 1), (1, 2)
        for m in range(5):
            minors[k, m] = 0.0
        for m in range(3):
            for n in range(3):
                minors[k, m + n] += a[i, m] * b[j, n] - a[j, m] * b[i, n]
    for i in range(9):
        resultant[i] = 0.0
    for i in range(5):
        for j in range(5):
            resultant[i + j] += minors[0, i] * minors[0, j] - minors[1, i] * minors[2, j]
    largest = 0.0
    for i in range(9):
        largest = max(largest, abs(resultant[i]))
    if largest < VANISHES:
        return False
    for i in range(9):
        resultant[i] /= largest
    return True


@compiled(inner=True)
def both_at_once(
    F: Array, G: Array, first: float, second: float, flipped: int, resultant: Array, work: Array, pairs: Array
) -> int:
    """Do what `common_roots` does from the roots of the resultant: the second coordinate solves either equation.

    It solves F; G is asked as well where F hardly depends on it, or its roots lead to no common one.
    """
    xs, y, b, pair = scratch(TWICE), scratch(2), scratch(3), scratch(2)
    count = int(np.int64(0))  # a literal 0 is a type of its own, for which Numba would compile `added` anew
    for k in range(roots_of_polynomial(first, resultant, work, xs)):
        basis(first, xs[k], b)
        largest, led = 0.0, False
        for equation in range(2):
            if led and largest > CLEAR:
                break
            E = F if equation == 0 else G
            f0 = b[0] * E[0, 0] + b[1] * E[1, 0] + b[2] * E[2, 0]
            f1 = b[0] * E[0, 1] + b[1] * E[1, 1] + b[2] * E[2, 1]
            f2 = b[0] * E[0, 2] + b[1] * E[1, 2] + b[2] * E[2, 2]
            largest = max(largest, abs(f0), abs(f1), abs(f2))
            for j in range(roots_of_one(second, f0, f1, f2, y)):
                pair[0], pair[1] = xs[k], y[j]
                if count < len(pairs) and led_to_a_root(F, G, first, second, pair):
                    led = True
                    count = added(pair, first, second, flipped, pairs, count)
        if largest < ARBITRARY or count == len(pairs):
            return UNKNOWN
    return count


@compiled(inner=True)
def added(pair: Array, first: float, second: float, flipped: int, pairs: Array, count: int) -> int:
    """Write a pair behind the others unless it is one of them; return how many there are."""
    for i in range(count):
        dx, dy = pairs[i, flipped] - pair[0], pairs[i, 1 - flipped] - pair[1]
        dx -= 0.0 if first else 2 * math.pi * math.floor(dx / (2 * math.pi) + 0.5)
        dy -= 0.0 if second else 2 * math.pi * math.floor(dy / (2 * math.pi) + 0.5)
        if max(abs(dx), abs(dy)) < SAME:
            return count
    pairs[count, flipped], pairs[count, 1 - flipped] = pair[0], pair[1]
    return count + 1


@compiled(inner=True)
def led_to_a_root(F: Array, G: Array, first: float, second: float, pair: Array) -> bool:
    """Move a pair, (2,), by Newton's method, and return whether it is then near a common root."""
    f = g = 0.0
    for step in range(8):
        x, y = pair[0], pair[1]
        a1, a2 = (x, x * x) if first else (math.cos(x), math.sin(x))
        b1, b2 = (y, y * y) if second else (math.cos(y), math.sin(y))
        da1, da2 = (1.0, 2.0 * x) if first else (-a2, a1)
        db1, db2 = (1.0, 2.0 * y) if second else (-b2, b1)
        f, fx, fy = with_slopes(F, a1, a2, da1, da2, b1, b2, db1, db2)
        g, gx, gy = with_slopes(G, a1, a2, da1, da2, b1, b2, db1, db2)
        if step == 0 and max(abs(f), abs(g)) > PLAUSIBLE * max(1.0, a2 if first else 1.0, b2 if second else 1.0):
            return False
        det = fx * gy - fy * gx
        if abs(det) < 1e-14 or max(abs(f), abs(g)) < 1e-15:
            break
        dx, dy = (f * gy - g * fy) / det, (g * fx - f * gx) / det
        longest = max(1.0, 4.0 * max(abs(dx), abs(dy)))
        pair[0] -= dx / longest
        pair[1] -= dy / longest
        if max(abs(dx), abs(dy)) < QUADRATIC:
            break
    return max(abs(f), abs(g)) < MISS


@compiled(inline=True, inner=True)
def with_slopes(
    F: Array, a1: float, a2: float, da1: float, da2: float, b1: float, b2: float, db1: float, db2: float
) -> tuple[float, float, float]:
    """Return aᵀ F b with a = (1, a₁, a₂), b = (1, b₁, b₂), and its derivatives: aᵀ' F b and aᵀ F b'."""
    r0, r1, r2 = (F[0, 0] + F[0, 1] * b1 + F[0, 2] * b2, F[1, 0] + F[1, 1] * b1 + F[1, 2] * b2,
                  F[2, 0] + F[2, 1] * b1 + F[2, 2] * b2)  # fmt: skip
    s0, s1, s2 = F[0, 1] * db1 + F[0, 2] * db2, F[1, 1] * db1 + F[1, 2] * db2, F[2, 1] * db1 + F[2, 2] * db2
    return r0 + a1 * r1 + a2 * r2, da1 * r1 + da2 * r2, s0 + a1 * s1 + a2 * s2
