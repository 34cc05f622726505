"""The polynomials of a chain at one random configuration, which shows whether an equation says anything there.

An equation of a target that can be reached may vanish with all its coefficients, though not by its form: the distance
of a wrist's centre from where it is known to be.
"""

from dataclasses import dataclass

import numpy as np
import sympy

from robotics1.ik.closed_form.links import Links
from robotics1.inputs import Array
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, Matrix, TrigPolynomial

SEED = 5


@dataclass(frozen=True, eq=False)
class TrialPoint:
    """Numbers for q, the parameters and the target's angles; those of a pose follow from q.

    Attributes:
        values: symbol → number.
    """

    values: dict[sympy.Symbol, float]

    def at(self, f: TrigPolynomial, pose: dict[sympy.Symbol, float]) -> float:
        """Return f, with these numbers for the entries of the pose."""
        F, values = f.trig_ring, {**self.values, **pose}
        angles = np.array([values[angle] / F.turns_of(angle) for angle in F.angles])
        total = 0j
        for k, c in f.terms.items():
            turn = np.exp(1j * float(np.dot(k, angles)))
            for m, a in c.terms():
                number = complex(float(a.x), float(a.y))
                for symbol, e in zip(F.ring.symbols, m, strict=True):
                    if e:
                        number *= values[symbol] ** e
                total += number * turn
        return float(total.real)

    def pose(self, entries: Matrix, links: Links, i: int, j: int, point: Matrix) -> dict[sympy.Symbol, float]:
        """Return the numbers of the symbols (3, 4) of the pose of link j in link i, with the position of a point."""
        R, p = np.eye(3), self.numbers(point)
        for step in reversed(links.steps[i:j]):
            R_step, turn = self.numbers(step.R), self.numbers(step.turn)
            R, p = R_step @ turn @ R, self.numbers(step.p) + R_step @ (self.numbers(step.slide) + turn @ p)
        return dict(zip(entries.flat, map(float, np.column_stack([R, p]).flat), strict=True))

    def numbers(self, M: Matrix) -> Array:
        """Return a matrix of polynomials without entries of a pose, in numbers."""
        return np.array([self.at(f, {}) for f in M.flat]).reshape(M.shape)


def trial_point(symbols: set[sympy.Symbol], parameters: dict[str, float]) -> TrialPoint:
    """Return random numbers for the symbols, those of parameters near their values."""
    rng = np.random.default_rng(SEED)
    values = {s: float(rng.uniform(0.3, 1.2) * rng.choice([-1, 1])) for s in sorted(symbols, key=str)}
    near = {sympy.Symbol(n, real=True): v * float(rng.uniform(0.8, 1.2)) for n, v in parameters.items()}
    roots = {sympy.Symbol(name): float(np.sqrt(square)) for name, square in ROOTS.items()}
    return TrialPoint({**values, **near, **roots})
