"""The target of a task in symbols: which entries of the frame's pose it gives, and by what names.

The pose is a matrix of trigonometric polynomials. An entry that the task gives, or that is the same at every q, is
known. Any other is a symbol of its own, and an equation in which one is left says nothing.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyRing

from robotics1.caching import cached_property
from robotics1.errors import FormulaError
from robotics1.symbolic.kinematics.chain import Chain, Pose
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, Matrix, TrigPolynomial, TrigRing, gaussian, polynomial
from robotics1.symbolic.tasks.task_map import task_map
from robotics1.symbolic.writing.sums_of_angles import Groups
from robotics1.tasks.task import FrameMap, Task

ROUNDING = 1e-15
MOST_ANGLES = 3  # that a target has
Definitions = dict[sympy.Symbol, sympy.Expr | None]  # of the symbols of a pose; None where nothing is known


@dataclass(frozen=True, eq=False)
class TargetChain(Chain):
    """A chain of joints whose polynomials hold, besides q and the lengths, the pose of a target."""

    @cached_property
    def entries(self) -> Matrix:
        """(3, 4) symbols for the entries of R and p."""
        return np.array([[sympy.Dummy(f"T{i}{j}", real=True) for j in range(4)] for i in range(3)])

    @cached_property
    def angles(self) -> tuple[sympy.Symbol, ...]:
        """The symbols of the target's angles."""
        names = self.named(["phi", *(f"phi{i}" for i in range(2, MOST_ANGLES + 1))])
        return tuple(sympy.Symbol(name, real=True) for name in names)

    @cached_property
    def trig_ring(self) -> TrigRing:
        """The ring of the chain, with the target's angles and entries."""
        F = Chain(self.robot, self.frame, self.joints, self.turns).trig_ring
        lengths = [s for s in F.ring.symbols if str(s) not in ROOTS]
        ring = PolyRing([*lengths, *self.entries.flat, *map(sympy.Symbol, ROOTS)], QQ_I)
        turns = F.turns or (1,) * len(F.angles)
        return TrigRing((*F.angles, *self.angles), ring, F.q, (*turns, *(1 for _ in self.angles)))

    def named(self, names: list[str]) -> list[str]:
        """Return names for the target that no parameter has: with _ behind where one does."""
        taken = {*self.robot.parameters, *(q.name for q in self.q)}
        longest = len(max(taken, key=len, default=""))
        return [next(name + "_" * k for k in range(longest + 2) if name + "_" * k not in taken) for name in names]

    def symbol(self, name: str) -> sympy.Symbol:
        """Return a symbol of the target."""
        return sympy.Symbol(self.named([name])[0], real=True)

    def generator(self, symbol: sympy.Symbol) -> TrigPolynomial:
        """Return an entry of the pose as a polynomial."""
        return self.trig_ring.constant(self.trig_ring.ring(symbol))


@dataclass(frozen=True, eq=False)
class Target:
    """The target of a task.

    Attributes:
        pose: R (3, 3) and p (3,) of the frame.
        definitions: what the symbols in them are.
        symbols: the target in symbols.
        places: where each is in the flat value of the task, and with which sign.
        groups: the places of the angles that are added up, with those of the target.
        identities: (e, f), expressions in the symbols of the pose and their shorter forms.
    """

    pose: Pose
    definitions: Definitions
    symbols: tuple[sympy.Symbol, ...]
    places: tuple[tuple[int, int], ...]
    groups: Groups
    identities: tuple[tuple[sympy.Expr, sympy.Expr], ...] = ()


def is_given(f: TrigPolynomial, definitions: Definitions) -> bool:
    """Whether f holds no entry of the pose that is unknown."""
    return all(definitions.get(symbol, 0) is not None for symbol in f.symbols)


def number_given(M: Matrix, definitions: Definitions) -> int:
    """Return how many entries of a matrix are known."""
    return sum(is_given(f, definitions) for f in M.flat)


def symbolic_target(chain: TargetChain, task: Task, form: FrameMap, pose: Pose) -> Target:
    """Return the target of a task whose frame has this pose, of polynomials in q.

    Raises:
        FormulaError: the task has the angles of a sequence, or a row that is no entry of the pose, and no angle of the
            frame.
    """
    if hasattr(task, "representation") and hasattr(task.representation, "sequence"):
        raise FormulaError("inverse formulas are written for the rotation itself; leave out angles=")
    value = task_map(form, task.rows, chain.q)
    here = {s: (i, j) for (i, j), s in np.ndenumerate(np.column_stack([value.R, value.p]))}
    M = np.column_stack([*pose[0].T, pose[1]])
    T = np.array([[chain.generator(s) for s in row] for row in chain.entries], dtype=object)
    definitions: Definitions = dict.fromkeys(chain.entries.flat)
    symbols: list[sympy.Symbol] = []
    groups: list[tuple[int, ...]] = list(chain.groups)
    angles = iter(chain.angles)
    flat: list[tuple[int, int]] = []
    polar, identities = _polar_coordinates(chain, list(value.value.flat), here, definitions)
    for n, row in enumerate(value.value.flat):
        if row.is_number:
            continue
        if row in polar:
            symbols.append(polar[row])
            flat.append((n, 1))
        elif row.func is sympy.atan2 and all(entry in here for entry in row.args):
            phi = next(angles)
            places = [here[entry] for entry in row.args]
            _set_angle(chain, T, M, places, phi, groups)
            symbols.append(phi)
            flat.append((n, 1))
        else:
            (i, j), sign = _place(row, here)
            symbol = chain.symbol("xyz"[i] if j == 3 else f"r{i + 1}{j + 1}")
            definitions[chain.entries[i, j]] = symbol
            symbols.append(symbol)
            flat.append((n, sign))
    for (i, j), f in np.ndenumerate(M):
        if definitions[chain.entries[i, j]] is None and not f.symbols & set(chain.q):
            T[i, j] = f
    return Target((T[:, :3], T[:, 3]), definitions, tuple(symbols), tuple(flat), tuple(groups), identities)


def _polar_coordinates(
    chain: TargetChain,
    rows: list[sympy.Expr],
    here: dict[sympy.Symbol, tuple[int, int]],
    definitions: Definitions,
) -> tuple[dict[sympy.Expr, sympy.Symbol], tuple[tuple[sympy.Expr, sympy.Expr], ...]]:
    """Define a = ρ cos θ and b = ρ sin θ of rows √(a² + b²) and atan2(b, a); return row → symbol, and a² + b² = ρ²."""
    for angle in rows:
        if angle.func is sympy.atan2 and all(here.get(entry, (0, 0))[1] == 3 for entry in angle.args):
            y, x = angle.args
            distance = sympy.sqrt(x**2 + y**2)
            if distance in rows:
                a, b = (chain.entries[here[entry]] for entry in (x, y))
                rho, theta = chain.symbol("rho"), chain.symbol("theta")
                definitions |= {a: rho * sympy.cos(theta), b: rho * sympy.sin(theta)}
                return {distance: rho, angle: theta}, ((a**2 + b**2, rho**2),)
    return {}, ()


def _place(row: sympy.Expr, here: dict[sympy.Symbol, tuple[int, int]]) -> tuple[tuple[int, int], int]:
    for sign in (1, -1):
        if sign * row in here:
            return here[sign * row], sign
    raise FormulaError(
        "inverse formulas are written for tasks whose rows are coordinates of the frame, entries of its rotation or "
        f"its angle in a plane; a row is {row.xreplace({s: sympy.Symbol(s.name) for s in row.free_symbols})}"
    )


def _set_angle(
    chain: TargetChain,
    T: Matrix,
    M: Matrix,
    places: list[tuple[int, int]],
    phi: sympy.Symbol,
    groups: list[tuple[int, ...]],
) -> None:
    """Write the entries of the pose with the angle φ, of a frame that turns in a plane: w = c + i s = κ exp(i k·q)."""
    F = chain.trig_ring
    (sine, cosine), i = places, F.constant(F.ring(QQ_I(0, 1)))
    w: TrigPolynomial = M[cosine] + i * M[sine]
    square = w * w.conjugate
    if len(w.terms) != 1 or set(square.terms) != {F.zero} or square.symbols:
        raise FormulaError(f"the frame does not turn in a plane, so {phi.name} gives no entry of its rotation")
    [(k, kappa)] = w.terms.items()
    turn = F.exponential({phi: 1}) * TrigPolynomial(F, {F.zero: kappa}).conjugate  # |κ| exp(i k·q)
    length = float(polynomial(square.terms[F.zero])) ** 0.5  # of the x axis in the plane
    if abs(length - 1) > ROUNDING:
        turn = turn * F.constant(F.ring(gaussian(Fraction(1 / length))))
    for place in np.ndindex(3, 3):
        known = F.constant(0)
        entry: Any = M[place]
        for n, c in entry.terms.items():
            factor = {k: turn, tuple(-m for m in k): turn.conjugate, F.zero: F.constant(1)}.get(n)
            if factor is None:
                break
            known = known + TrigPolynomial(F, {F.zero: c}) * factor
        else:
            T[place] = known
    own = {j for j, m in enumerate(k) if m}
    place_of_phi = F.angles.index(phi)
    joined = [group for group in groups if own & set(group) or place_of_phi in group]
    groups[:] = [group for group in groups if group not in joined] + [tuple(sorted({j for g in joined for j in g}))]
