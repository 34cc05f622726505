"""Trigonometric polynomials for the tests: read from SymPy, and evaluated by SymPy."""

import numpy as np
import sympy
from formula_values import real
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyRing

from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, TrigRing
from robotics1.symbolic.tasks.normal_form import NormalForm
from robotics1.symbolic.writing.sums_of_angles import written
from robotics1.symbolic.writing.term_budget import TermBudget

q1, q2, q3, q4 = Q = real("q1:5")  # three angles and a slide
a, b, c = LENGTHS = real("a b c")
VALUES = {a: 0.5, b: 0.4, c: 0.3}
F = TrigRing((q1, q2, q3), PolyRing([q4, *LENGTHS, *map(sympy.Symbol, ROOTS)], QQ_I), Q)
GROUPS = ((0, 1, 2),)
_normal = NormalForm(TermBudget(F, GROUPS, most_products=10**6, most_terms=10**6), {})


def poly(expression):
    """An expression as a trigonometric polynomial."""
    found = _normal.polynomial(sympy.sympify(expression))
    assert found is not None
    return found


def sympy_of(f):
    return written(f, GROUPS)


def equal(f, g):
    """Whether two polynomials are the same."""
    return not f - g


def value(f, q, lengths=VALUES):
    """f at numbers, evaluated by SymPy from its terms, not as the package evaluates it."""
    at = {**dict(zip(Q, map(sympy.Float, q), strict=True)), **{k: sympy.Float(x) for k, x in lengths.items()}}
    total = sympy.S.Zero
    for k, coefficient in f.terms.items():
        wave = sympy.exp(sympy.I * sum(m * at[angle] for m, angle in zip(k, F.angles, strict=True)))
        roots = {sympy.Symbol(name): sympy.sqrt(square) for name, square in ROOTS.items()}
        total += coefficient.as_expr().subs({**at, **roots}) * wave
    return complex(total.evalf())


def random_q(rng):
    return np.array([*rng.uniform(-np.pi, np.pi, 3), rng.uniform(-1, 1)])
