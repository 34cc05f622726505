"""The polynomial in one joint that two equations in two joints leave, where no closed formula is found.

Of the other joint cos θ and sin θ enter linearly, A cos θ + B sin θ + C = 0 twice. Cramer's rule and the sum 1 of the
squares give (B₁C₂ − B₂C₁)² + (A₂C₁ − A₁C₂)² = (A₁B₂ − A₂B₁)². An equation that is linear in a slide gives that slide.
The joint that is left is t = tan(q/2) of one that turns.

Source: Pieper, The kinematics of manipulators under computer control, 1968.
"""

from collections.abc import Collection

import sympy

t = sympy.Symbol("t", real=True)
Pair = tuple[set[sympy.Symbol], tuple[sympy.Expr, sympy.Expr]]  # two joints, and equations in them
LONGEST, FEW = 700, 4  # letters of a pair whose polynomial is written in seconds, and a degree that is not undercut
SHOWN = 600  # letters of a polynomial in a message
HIGHEST = 8  # degree of a polynomial that is given
SMALL = 1e-12  # a coefficient beside the largest number in it that is rounding


class NoEquation(Exception):  # noqa: N818 (`ik_formulas` makes a FormulaError of it)
    """Every equation that is left holds several unknown joints.

    Attributes:
        polynomial, joint: as a `FormulaError` has them.
        remains: the polynomial in a sentence.
    """

    def __init__(self, text: str, left: tuple[sympy.Symbol, sympy.Poly] | None = None, *, slides: bool = False) -> None:
        super().__init__(text)
        self.polynomial, self.joint, self.remains = None, "", ""
        if left is not None:
            q, P = left
            unknown = f"{q.name} solves" if slides else f"t = tan({q.name}/2) solves"
            shown = f"{P.as_expr()} = 0" if len(str(P)) < SHOWN else "the polynomial of this error"
            self.polynomial, self.joint = P, q.name
            self.remains = f". What is left: {unknown} {shown}, of degree {P.degree()}"


def shortest_two(found: Collection[sympy.Expr]) -> tuple[sympy.Expr, sympy.Expr]:
    """Return the shortest two of several expressions."""
    one, other, *_ = sorted(found, key=lambda e: (len(str(e)), str(e)))
    return one, other


def least_polynomial(
    pairs: Collection[Pair], slides: Collection[sympy.Symbol]
) -> tuple[sympy.Symbol, sympy.Poly] | None:
    """Return a joint and its polynomial, of a low degree, from pairs of equations, the shorter ones first."""
    best = None
    for joints, (f, g) in sorted(pairs, key=lambda pair: len(str(pair[1]))):
        if len(str((f, g))) > LONGEST:
            break
        found = polynomial_in_one(f, g, joints, slides)
        if found is not None and (best is None or found[1].degree() < best[1].degree()):
            best = found
        if best is not None and best[1].degree() <= FEW:
            break
    return best


def polynomial_in_one(
    f: sympy.Expr, g: sympy.Expr, joints: Collection[sympy.Symbol], slides: Collection[sympy.Symbol]
) -> tuple[sympy.Symbol, sympy.Poly] | None:
    """Return the joint and its polynomial, of the lowest degree, from equations f = 0 and g = 0 in two joints."""
    found = []
    for v in joints:
        (u,) = set(joints) - {v}
        e = _without_a_slide(f, g, v) if v in slides else _without_an_angle(f, g, v)
        P = None if e is None else _in_the_half_tangent(e, u, turns=u not in slides)
        if P is not None and 0 < P.degree() <= HIGHEST:
            found.append((u, P))
    return min(found, key=lambda pair: (pair[1].degree(), pair[0].name), default=None)


def _without_a_slide(f: sympy.Expr, g: sympy.Expr, d: sympy.Symbol) -> sympy.Expr | None:
    for one, other in ((f, g), (g, f)):
        P = sympy.Poly(sympy.expand(one), d)
        if P.degree() == 1 and P.nth(1).is_number:
            return sympy.expand(other.subs(d, -P.nth(0) / P.nth(1)))
    return None


def _without_an_angle(f: sympy.Expr, g: sympy.Expr, q: sympy.Symbol) -> sympy.Expr | None:
    c, s = sympy.Dummy("c"), sympy.Dummy("s")
    rows = []
    for e in (f, g):
        P = sympy.Poly(sympy.expand_trig(e).subs({sympy.cos(q): c, sympy.sin(q): s}), c, s)
        if P.total_degree() > 1:
            return None
        rows.append((P.nth(1, 0), P.nth(0, 1), P.nth(0, 0)))
    (a1, b1, c1), (a2, b2, c2) = rows
    return (b1 * c2 - b2 * c1) ** 2 + (a2 * c1 - a1 * c2) ** 2 - (a1 * b2 - a2 * b1) ** 2


def _in_the_half_tangent(e: sympy.Expr, q: sympy.Symbol, *, turns: bool) -> sympy.Poly | None:
    """Return a polynomial in t, whose coefficients are polynomials in the target."""
    if not turns:
        return sympy.Poly(sympy.expand(e.subs(q, t)), t)
    c, s = sympy.Dummy("c"), sympy.Dummy("s")
    P = sympy.Poly(sympy.expand_trig(sympy.expand(e)).subs({sympy.cos(q): c, sympy.sin(q): s}), c, s)
    degree = P.total_degree()
    if degree > HIGHEST // 2 or P.has(q):
        return None
    terms = [a * (1 - t**2) ** m * (2 * t) ** n * (1 + t**2) ** (degree - m - n) for (m, n), a in P.as_dict().items()]
    return _without_rounding(sympy.Poly(sympy.expand(sympy.Add(*terms)), t))


def _without_rounding(P: sympy.Poly) -> sympy.Poly:
    largest = max((abs(float(n)) for a in P.coeffs() for n in sympy.sympify(a).atoms(sympy.Number)), default=1.0)
    small = {n: 0 for a in P.coeffs() for n in a.atoms(sympy.Float) if abs(n) < SMALL * largest}
    return sympy.Poly(P.as_expr().xreplace(small), t)
