"""Joint after joint from the equations of a chain, until all are known.

A joint that is known at either end of the chain goes to the side of the target, and the pose of what is left gets new
symbols: so equations stay as short as at the beginning.

Source: Paul, Robot Manipulators, 1981, chapter 3; Pieper, The kinematics of manipulators under computer control, 1968.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import sympy

from robotics1.ik.closed_form.equations import SIDES, PartOfChain
from robotics1.ik.closed_form.links import from_the_first_joint
from robotics1.ik.closed_form.one_polynomial import NoEquation, least_polynomial, shortest_two
from robotics1.ik.closed_form.one_unknown import (
    ROUNDING,
    JointFormula,
    OneUnknown,
    read,
    solve_one,
    solve_pair,
    turned,
)
from robotics1.ik.closed_form.target import Definitions, Target, TargetChain, is_given, number_given
from robotics1.ik.closed_form.trial_point import TrialPoint
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial
from robotics1.symbolic.writing.sums_of_angles import without_long_fractions, written

VANISHES = 1e-9  # a coefficient at the trial point
Equations = tuple[OneUnknown, ...]
Numbers = dict[sympy.Symbol, float]


@dataclass(eq=False)
class Peeling:
    """The joints that are still unknown, and the formulas of the others.

    Attributes:
        part: the joints that are left, and the pose between their ends.
        definitions: of the symbols in that pose, by the target and the joints that are known.
        unknown: the symbols of the joints that are not known.
        trial: where equations are tried.
        thorough: whether longer equations are tried where shorter ones leave two solutions.
        found: the formulas of the known ones.
    """

    chain: TargetChain
    target: Target
    part: PartOfChain
    definitions: Definitions
    unknown: set[sympy.Symbol]
    trial: TrialPoint
    thorough: bool = False
    found: list[JointFormula] = field(default_factory=list)

    def begin(self, R: Matrix) -> None:
        """Begin with these axes of the last link in the first."""
        R, p = self._named(R, self.part.p)
        first, one = self.part.links.steps[0], self.chain.trig_ring.constant(1)
        if any(f * f - one for f in first.R.flat if f):  # at an angle, where each entry would be a sum of three
            turned, moved = first.R.T @ R, first.R.T @ (p - first.p)
            if self._known(turned, moved) == self._known(R, p):
                R, p = self._named(turned, moved)
                self.part = replace(self.part, links=from_the_first_joint(self.chain, self.part.links))
        self.part = replace(self.part, R=R, p=p)

    def solve(self) -> tuple[JointFormula, ...]:
        """Return the formulas of all joints, in an order in which each needs only those before it.

        Raises:
            NoEquation: no equation with one unknown joint is left.
        """
        self._peel()
        while self.unknown:
            q, options, *conditions = self._next()
            self.found.append(JointFormula(q, tuple(map(self._defined, options)), *map(self._defined, conditions)))
            self.unknown.discard(q)
            self._peel()
        return tuple(self.found)

    def constraints(self) -> tuple[sympy.Expr, ...]:
        """Return what must vanish of the target alone, of a task with more rows than joints."""
        found = self._without_unknowns()
        if not found:  # joints that do not move the task may stand before the first axis that does
            self._peel()
            found = self._without_unknowns()
        distinct = {min(e, -e, key=lambda f: (len(str(f)), str(f))) for e in found if not e.is_number}
        return tuple(sorted(distinct, key=str))

    def _without_unknowns(self) -> set[sympy.Expr]:
        equations = (f.without_rounding(ROUNDING * f.largest) for f in self.part.equations(0, 0))
        of_the_target = (f for f in equations if f and self._is_given(f) and not f.symbols & self.unknown)
        return {self._defined(self.write(f)) for f in of_the_target}

    def write(self, f: TrigPolynomial) -> sympy.Expr:
        """Return a polynomial as an expression, with the symbols of the pose."""
        return without_long_fractions(written(f, self.target.groups))

    def _next(self) -> JointFormula:
        """Return the solution of the joint that has the fewest and shortest."""
        equations: dict[sympy.Symbol, list[OneUnknown]] = {}
        pose = self._trial_pose()
        best = None
        for sides in SIDES:
            if best is not None and (best[0] == 1 or (sum(sides) > 1 and not self.thorough)):
                break
            for f in self.part.equations(*sides):
                found = read(f, self._angles, self._lengths, self._nothing)
                if found is not None and self._counts(found, pose):
                    equations.setdefault(found.q, []).append(found)
            best = self._best(equations, pose)
        if best is None:
            raise self._nothing_left()
        _, chosen = best
        return solve_pair(*chosen, self.write) if len(chosen) == 2 else solve_one(chosen[0], self.write)

    def _nothing_left(self) -> NoEquation:
        """Return the exception for no equation in one unknown, with a polynomial if two equations have the same two."""
        names = ", ".join(sorted(q.name for q in self.unknown))
        text = (
            f"no closed formula is found: every equation that is left holds at least two of {names}, or a polynomial "
            f"of a higher degree"
        )
        slides = self.unknown & set(self.chain.trig_ring.ring.symbols)
        found = least_polynomial(self._pairs_of_equations(), slides) if self.thorough else None
        return NoEquation(text) if found is None else NoEquation(text, found, slides=found[0] in slides)

    def _pairs_of_equations(self) -> list[tuple[set[sympy.Symbol], tuple[sympy.Expr, sympy.Expr]]]:
        """Return two joints and the two shortest different equations in them, of all pairs of joints that have them."""
        pairs: dict[tuple[str, ...], tuple[set[sympy.Symbol], set[sympy.Expr]]] = {}
        for sides in SIDES:
            for f in self.part.equations(*sides):
                left = f.symbols & self.unknown
                if len(left) == 2 and self._is_given(f):
                    key = tuple(sorted(symbol.name for symbol in left))
                    pairs.setdefault(key, (left, set()))[1].add(self._defined(self.write(f)))
        return [(left, shortest_two(found)) for left, found in pairs.values() if len(found) > 1]

    def _best(self, equations: dict[sympy.Symbol, list[OneUnknown]], pose: Numbers) -> tuple[int, Equations] | None:
        """Return the number of solutions and the equation, or the pair, that gives the fewest and is the shortest."""
        choices: list[tuple[int, int, Equations]] = []
        for found in equations.values():
            ordered = sorted(found, key=lambda equation: equation.terms)
            pair = self._pair(ordered, pose) if ordered[0].is_angle else None
            if pair is not None:
                choices.append((1, pair[0].terms + pair[1].terms, pair))
            else:
                chosen = next((e for e in ordered if e.is_linear), ordered[0])
                choices.append((1 if chosen.is_linear else 2, chosen.terms, (chosen,)))
        if not choices:
            return None
        best = min(choices, key=lambda choice: choice[:2])
        return best[0], best[2]

    def _pair(self, ordered: Sequence[OneUnknown], pose: Numbers) -> Equations | None:
        """Return the shortest two equations in one angle that are independent, those of a turned frame first."""
        at = self.trial.at
        rows = [(at(e.coefficients[0], pose), at(e.coefficients[1], pose)) for e in ordered]
        independent = [
            (ordered[m], ordered[n])
            for n, other in enumerate(rows)
            for m, one in enumerate(rows[:n])
            if abs(one[0] * other[1] - one[1] * other[0]) > VANISHES
        ]
        return next((pair for pair in independent if turned(*pair)), independent[0] if independent else None)

    def _counts(self, equation: OneUnknown, pose: Numbers) -> bool:
        """Whether an equation says anything of its unknown at the trial point."""
        first, second, third = equation.coefficients
        moving = (first, second) if equation.is_angle else (second, third)
        return any(f and abs(self.trial.at(f, pose)) > VANISHES for f in moving)

    def _trial_pose(self) -> Numbers:
        part = self.part
        return self.trial.pose(self.chain.entries, part.links, part.i, part.j, part.point)

    def _is_given(self, f: TrigPolynomial) -> bool:
        return is_given(f, self.definitions)

    @property
    def _angles(self) -> set[int]:
        return {j for j, angle in enumerate(self.chain.trig_ring.angles) if angle in self.unknown}

    @property
    def _lengths(self) -> set[int]:
        return {j for j, symbol in enumerate(self.chain.trig_ring.ring.symbols) if symbol in self.unknown}

    @property
    def _nothing(self) -> set[int]:
        symbols = self.chain.trig_ring.ring.symbols
        return {j for j, symbol in enumerate(symbols) if self.definitions.get(symbol, 0) is None}

    def _defined(self, e: Any) -> Any:
        for whole, shorter in self.target.identities:
            e = e.subs(whole, shorter)
        return e.xreplace({symbol: value for symbol, value in self.definitions.items() if value is not None})

    def _peel(self) -> None:
        """Move the known joints at both ends of what is left to the side of the target."""
        part, links = self.part, self.part.links
        while part.i < part.j and not self._moves_unknown(part.i):
            step = links.steps[part.i]
            turned, moved = step.direction_behind(part.R), step.point_behind(part.p)
            if self._known(turned, moved) < self._known(part.R, part.p):
                break  # less would be left of a point if not all of its coordinates are given
            R, p = self._named(turned, moved)
            part = replace(part, i=part.i + 1, R=R, p=p)
        while part.i < part.j and not self._moves_unknown(part.j - 1):
            step = links.steps[part.j - 1]
            turned = part.R @ step.direction_behind(part.chain.still[0])
            if self._known(turned) < self._known(part.R):
                break  # of a direction alone less would be left
            R, p = self._named(turned, part.p)
            part = replace(part, j=part.j - 1, R=R, p=p, point=step.point(part.point))
        self.part = self._with_what_is_the_same(self._at_a_better_point(part))

    def _with_what_is_the_same(self, part: PartOfChain) -> PartOfChain:
        """Return the part with those entries of its pose that no unknown joint changes as what they are."""
        R, p = part.chain.still[0], part.point
        for step in reversed(part.links.steps[part.i : part.j]):
            R, p = step.direction(R), step.point(p)
        M, T = np.column_stack([*R.T, p]), np.column_stack([*part.R.T, part.p])
        for place, f in np.ndenumerate(M):
            if not f.symbols & self.unknown:
                T[place] = f
        return replace(part, R=T[:, :3], p=T[:, 3])

    def _known(self, *parts: Matrix) -> int:
        """Return how many entries of a pose are known."""
        return sum(number_given(M, self.definitions) for M in parts)

    def _moves_unknown(self, k: int) -> bool:
        step = self.part.links.steps[k]
        used = {symbol for f in (*step.turn.flat, *step.slide) for symbol in f.symbols}
        return bool(used & self.unknown)

    def _at_a_better_point(self, part: PartOfChain) -> PartOfChain:
        """Return the part with the position of the point that most joints before the last link leave where it is."""
        if part.i == part.j:
            return part

        def joints_behind(point: Matrix) -> int:
            used = set()
            for k in range(part.j - 1, part.i - 1, -1):
                point = part.links.steps[k].point(point)
                used |= {s for f in point for s in f.symbols}
            return len(used & self.unknown)

        def is_known(point: Matrix) -> bool:
            return all(map(self._is_given, part.p + part.R @ (point - part.point)))

        points = filter(is_known, part.links.points[part.j])
        point = min(points, key=joints_behind, default=part.point)
        if joints_behind(point) >= joints_behind(part.point):
            return part
        R, p = self._named(part.R, part.p + part.R @ (point - part.point))
        return replace(part, R=R, p=p, point=point)

    def _named(self, R: Matrix, p: Matrix) -> tuple[Matrix, Matrix]:
        """Return a pose with new symbols for the entries that hold such symbols."""
        definitions: Definitions = {}
        T = np.column_stack([*R.T, p])
        named = np.array(T)
        symbols = set(self.chain.entries.flat)
        for place, f in np.ndenumerate(T):
            if f.symbols & symbols:
                symbol = self.chain.entries[place]
                definitions[symbol] = self._defined(self.write(f)) if self._is_given(f) else None
                named[place] = self.chain.generator(symbol)
        self.definitions = definitions
        return named[:, :3], named[:, 3]
