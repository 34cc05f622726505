"""The least time of each timing law as a formula of Δ and the bounds, with the condition that decides each case."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import FormulaError, InputError, UnknownNameError
from robotics1.inputs import counting_number, one_of, positive_number, text
from robotics1.trajectories.law_kinds import KINDS
from robotics1.trajectories.least_time_of_joints import minimum_time
from robotics1.trajectories.limits import MotionLimits

BOUNDS = ("velocity", "acceleration", "jerk", "deceleration")
SHAPES = ("cubic", "quintic", "septic", "cosine", "cycloidal")
TRIALS = 8  # random values with which the formulas are compared
AGREES = 1e-9  # relative


@dataclass(frozen=True)
class TimeCase:
    """One case of a law: T and what happens when, in SymPy.

    Attributes:
        name: what the case is.
        conditions: relations that all hold; none where there is no other case.
        duration: T.
        times: the instants, in order, at which the acceleration or the jerk switches, without 0 and T.
        velocity: the largest |q̇|.
        acceleration: the largest |q̈|, while the speed grows.
    """

    name: str
    conditions: tuple[Any, ...]
    duration: Any
    times: tuple[Any, ...]
    velocity: Any
    acceleration: Any

    def explain(self) -> str:
        """Return the case as it is written on paper."""
        when = f"if {' and '.join(map(str, self.conditions))}: " if self.conditions else ""
        switches = f", switching at t = {', '.join(map(str, self.times))}" if self.times else ""
        return f"{self.name}: {when}T = {self.duration}{switches}"


@dataclass(frozen=True)
class TimeFormula:
    """The least time of a timing law from rest to rest, in cases.

    Attributes:
        law: its name.
        symbols: of the distance and the bounds, by what they are: "distance", "velocity", ...
        cases: one of which holds.
    """

    law: str
    symbols: Mapping[str, Any]
    cases: tuple[TimeCase, ...]

    @cached_property
    def duration(self) -> Any:
        """T as one expression: a `sympy.Piecewise`, or that of the only case."""
        import sympy

        pieces = [(case.duration, sympy.And(*case.conditions)) for case in self.cases]
        return pieces[0][0] if len(pieces) == 1 else sympy.Piecewise(*pieces[:-1], (pieces[-1][0], True))

    def of_joints(self, n: int) -> Any:
        """Return T of n joints that arrive together, max(T₁, ..., Tₙ), in Δ₁, V₁, A₁, ... (Delta_1, V_1, A_1, ...).

        Raises:
            InputError: n is no positive integer.
        """
        import sympy

        own = [s for s in self.symbols.values() if isinstance(s, sympy.Symbol)]
        numbered = [
            {s: sympy.Symbol(f"{s.name}_{i}", positive=True) for s in own}
            for i in range(1, counting_number("n", n, least=1) + 1)
        ]
        return sympy.Max(*(self.duration.xreplace(names) for names in numbered), evaluate=False)

    def case_of(self, **values: float) -> TimeCase:
        """Return the case that holds at these values, with numbers in the place of the symbols.

        Args:
            values: of the symbols, by their names: case_of(Delta=1, V=2, A=3).

        Raises:
            UnknownNameError: a value is of no symbol.
            InputError: a symbol has no value, or one that is not positive.
        """
        import sympy

        symbols = {str(s): s for s in self.symbols.values() if isinstance(s, sympy.Symbol)}
        for name in values:
            if name not in symbols:
                raise UnknownNameError("symbol of the formula named", name, symbols)
        missing = [name for name in symbols if name not in values]
        if missing:
            raise InputError(f"give {missing[0]} a value too; the formula has {', '.join(symbols)}")
        known = {symbols[name]: sympy.Float(positive_number(name, value)) for name, value in values.items()}
        for case in self.cases[:-1]:
            if all(_holds(condition, known) for condition in case.conditions):
                return _with_numbers(case, known)
        return _with_numbers(self.cases[-1], known)

    def explain(self) -> str:
        """Return the cases, one a line."""
        return "\n".join(case.explain() for case in self.cases)


def time_formula(
    law: str = "trapezoidal",
    *,
    distance: Any = "Delta",
    velocity: Any = None,
    acceleration: Any = None,
    jerk: Any = None,
    deceleration: Any = None,
) -> TimeFormula:
    """Return the least time of a timing law from rest to rest over |Δ|, in symbols: T and the switching times.

        time_formula("trapezoidal", velocity="V", acceleration="A").duration
        # Δ/V + V/A if Δ ≥ V²/A, else 2√(Δ/A)

    The formulas are compared with `minimum_time` at random values, to 1e-9.

    Args:
        law: "trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine" or "cycloidal".
        distance: |Δ| > 0: a name, a positive SymPy symbol or a number.
        velocity, acceleration, jerk, deceleration: the bounds likewise; None for no bound.

    Raises:
        InputError: an argument is neither a name, a symbol nor a positive number, or the law needs another bound, or
            cannot keep one.
        FormulaError: the formulas do not agree with `minimum_time`.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, chapter 3.
    """
    one_of("law", law, tuple(KINDS))
    given = {
        "distance": distance,
        "velocity": velocity,
        "acceleration": acceleration,
        "jerk": jerk,
        "deceleration": deceleration,
    }
    symbols = {name: _positive(name, value) for name, value in given.items() if value is not None}
    _check_bounds(law, symbols)
    find = {"trapezoidal": _trapezoidal, "double_s": _double_s, "bang_bang": _bang_bang}
    cases = find[law](symbols) if law in find else _shape(law, symbols)
    formula = TimeFormula(law, symbols, tuple(cases))
    _compare(formula)
    return formula


def _positive(name: str, value: Any) -> Any:
    """Return a bound as a positive symbol or number."""
    import sympy

    if isinstance(value, str):
        if not text(name, value).isidentifier():
            raise InputError(f"{name} must be a name such as 'V', a positive symbol or a number; it is {value!r}")
        return sympy.Symbol(value, positive=True)
    if isinstance(value, sympy.Symbol):
        return sympy.Symbol(value.name, positive=True)
    return sympy.nsimplify(positive_number(name, value), rational=True)


def _check_bounds(law: str, symbols: Mapping[str, Any]) -> None:
    """Refuse bounds that a law needs and has not, or has and cannot keep."""
    if law not in ("trapezoidal",) and "deceleration" in symbols:
        raise InputError(f"a {law} law has one bound on the acceleration; 'trapezoidal' brakes with another")
    if law == "trapezoidal" and "acceleration" not in symbols:
        raise InputError("a trapezoidal law needs a bound on the acceleration")
    if law == "double_s" and "jerk" not in symbols:
        raise InputError("a double_s law needs a bound on the jerk")
    if law in ("trapezoidal", "bang_bang") and "jerk" in symbols:
        raise InputError(f"the acceleration of a {law} law jumps, so that no jerk is its bound; 'double_s' has one")
    if not any(name in symbols for name in BOUNDS):
        raise InputError("give a bound: velocity=, acceleration= or jerk=")


def _trapezoidal(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of constant accelerations A and −D, with and without a cruise."""
    import sympy

    d, A = symbols["distance"], symbols["acceleration"]
    D = symbols.get("deceleration", A)
    peak = sympy.simplify(sympy.sqrt(2 * d * A * D / (A + D)))
    short = sympy.simplify(sympy.sqrt(2 * d * (A + D) / (A * D)))
    triangle = TimeCase("triangular", (), short, (sympy.simplify(peak / A),), peak, A)
    if "velocity" not in symbols:
        return [triangle]
    V = symbols["velocity"]
    needed = sympy.simplify(V**2 / (2 * A) + V**2 / (2 * D))
    T = sympy.expand(d / V + V / (2 * A) + V / (2 * D))
    cruise = TimeCase("trapezoidal", (sympy.Ge(d, needed),), T, (V / A, sympy.expand(T - V / D)), V, A)
    return _decided([cruise, _when(triangle, sympy.Lt(d, needed))])


def _bang_bang(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return T = max(2Δ/V, 2√(Δ/A)), with one switch in the middle."""
    import sympy

    d = symbols["distance"]
    durations = {}
    if "velocity" in symbols:
        durations["velocity"] = 2 * d / symbols["velocity"]
    if "acceleration" in symbols:
        durations["acceleration"] = 2 * sympy.sqrt(d / symbols["acceleration"])
    cases = [
        TimeCase(f"bounded by the {name}", (), T, (sympy.simplify(T / 2),), 2 * d / T, sympy.simplify(4 * d / T**2))
        for name, T in durations.items()
    ]
    if len(cases) == 1:
        return cases
    bound = symbols["velocity"] ** 2 / symbols["acceleration"]
    return _decided([_when(cases[0], sympy.Ge(d, bound)), _when(cases[1], sympy.Lt(d, bound))])


def _double_s(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a double-S: with or without a cruise, with or without constant acceleration."""
    import sympy

    d, J = symbols["distance"], symbols["jerk"]
    V, A = symbols.get("velocity"), symbols.get("acceleration")
    root = sympy.cbrt(d / (2 * J))
    tiny = _phases("neither bound is reached", (), root, root, sympy.S.Zero, J)
    cases = []
    if V is not None and A is not None:
        reached, needed = sympy.Ge(V * J, A**2), sympy.expand(V**2 / A + V * A / J)
        ramp = sympy.expand(V / A + A / J)
        conditions: tuple[Any, ...] = (reached, sympy.Ge(d, needed))
        cases.append(_phases("both bounds are reached", conditions, A / J, V / A, d / V - ramp, J))
    if A is not None:
        v = (-(A**2) / J + sympy.sqrt(A**4 / J**2 + 4 * A * d)) / 2
        conditions = (sympy.Ge(d, 2 * A**3 / J**2),)
        if V is not None:
            conditions += (reached, sympy.Lt(d, needed))
        cases.append(_phases("the acceleration alone is reached", conditions, A / J, v / A, sympy.S.Zero, J))
    if V is not None:
        tj = sympy.sqrt(V / J)
        conditions = (sympy.Ge(d, 2 * V * tj),)
        if A is not None:
            conditions += (sympy.Lt(V * J, A**2),)
        cases.append(_phases("the velocity alone is reached", conditions, tj, tj, d / V - 2 * tj, J))
    smallest = [] if A is None else [2 * A**3 / J**2]
    smallest += [] if V is None else [2 * V * sympy.sqrt(V / J)]
    return _decided([*cases, _when(tiny, *(sympy.Lt(d, bound) for bound in smallest))])


def _phases(name: str, conditions: tuple[Any, ...], tj: Any, ta: Any, tc: Any, J: Any) -> TimeCase:
    """Return the case with jerks for tj, a velocity that is reached after ta + tj, and a cruise for tc."""
    import sympy

    ramp = sympy.expand(ta + tj)
    end = sympy.expand(2 * ramp + tc)
    cruise = [ramp, ramp + tc] if tc != 0 else []  # without one, the jerk is −J before and after the middle
    instants = [tj, ta, *cruise, ramp + tc + tj, ramp + tc + ta]
    times = tuple(dict.fromkeys(sympy.expand(t) for t in instants))
    return TimeCase(name, conditions, end, times, sympy.simplify(J * tj * ta), sympy.simplify(J * tj))


def _shape(law: str, symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return T = max(c₁Δ/V, √(c₂Δ/A), ∛(c₃Δ/J)), with cₖ the largest |dᵏs/dτᵏ| of the shape s(τ)."""
    import sympy

    d = symbols["distance"]
    c = [_largest(law, k) for k in (1, 2, 3)]
    durations = {
        name: sympy.root(c[k] * d / symbols[name], k + 1) for k, name in enumerate(BOUNDS[:3]) if name in symbols
    }
    cases = []
    for name, T in durations.items():
        others = [(other, S) for other, S in durations.items() if other != name]
        k = BOUNDS.index(name) + 1
        conditions = tuple(_longer(T, k, S, BOUNDS.index(other) + 1, d) for other, S in others)
        cases.append(TimeCase(f"bounded by the {name}", conditions, T, (), c[0] * d / T, c[1] * d / T**2))
    return _decided(cases)


def _longer(T: Any, k: int, S: Any, j: int, d: Any) -> Any:
    """Return the condition T ≥ S of T = (c Δ)^(1/k) and S = (b Δ)^(1/j), as one on Δ."""
    import sympy

    c, b = sympy.simplify(T**k / d), sympy.simplify(S**j / d)
    bound = sympy.simplify(sympy.root(b**k / c**j, abs(j - k)))
    return sympy.Ge(d, bound) if j > k else sympy.Le(d, 1 / bound)


@lru_cache
def _largest(law: str, order: int) -> Any:
    """Return the largest |dᵏs/dτᵏ| of a shape from 0 to 1, exactly."""
    import sympy

    tau = sympy.Symbol("tau", real=True)
    shapes: dict[str, Any] = {
        "cubic": 3 * tau**2 - 2 * tau**3,
        "quintic": 10 * tau**3 - 15 * tau**4 + 6 * tau**5,
        "septic": 35 * tau**4 - 84 * tau**5 + 70 * tau**6 - 20 * tau**7,
        "cosine": (1 - sympy.cos(sympy.pi * tau)) / 2,
        "cycloidal": tau - sympy.sin(2 * sympy.pi * tau) / (2 * sympy.pi),
    }
    f = shapes[law].diff(tau, order)
    if law in ("cosine", "cycloidal"):
        places = [sympy.Rational(i, 4) for i in range(5)]
    else:
        slope = f.diff(tau)
        places = [sympy.S.Zero, sympy.S.One, *(sympy.real_roots(sympy.Poly(slope, tau)) if slope != 0 else [])]
    values = [sympy.nsimplify(sympy.Abs(f.subs(tau, place))) for place in places if 0 <= place <= 1]
    return sympy.sqrtdenest(sympy.simplify(max(values, key=float)))


def _when(case: TimeCase, *conditions: Any) -> TimeCase:
    return replace(case, conditions=(*case.conditions, *conditions))


def _decided(cases: Sequence[TimeCase]) -> list[TimeCase]:
    """Return the cases that numbers do not rule out; one alone has no condition left."""
    import sympy

    kept = []
    for case in cases:
        conditions = [sympy.sympify(c) for c in case.conditions]
        if sympy.false not in conditions:
            open_ = tuple(c for c in conditions if c != sympy.true)
            kept.append(replace(case, conditions=open_))
    return kept


def _holds(condition: Any, known: Mapping[Any, Any]) -> bool:
    """Return whether an inequality holds in numbers."""
    left, right = (float(side.evalf(subs=known)) for side in (condition.lhs, condition.rhs))
    return {">=": left >= right, "<=": left <= right, ">": left > right, "<": left < right}[condition.rel_op]


def _with_numbers(case: TimeCase, known: Mapping[Any, Any]) -> TimeCase:
    def number(expression: Any) -> float:
        return float(expression.evalf(subs=known))

    times = tuple(sorted({round(number(t), 15) for t in case.times}))
    return TimeCase(
        case.name, case.conditions, number(case.duration), times, number(case.velocity), number(case.acceleration)
    )


def _compare(formula: TimeFormula) -> None:
    """Compare T, the switching times and the peaks with `minimum_time` at random values.

    Raises:
        FormulaError: they differ.
    """
    rng = np.random.default_rng(0)
    names = [str(s) for s in formula.symbols.values() if s.is_Symbol]
    for _ in range(TRIALS if names else 1):
        values = {name: float(np.exp(rng.uniform(-2, 2))) for name in names}
        found = formula.case_of(**values)
        known = {name: float(values.get(str(s), s if s.is_number else 0)) for name, s in formula.symbols.items()}
        distance = known.pop("distance")
        law = minimum_time(0.0, distance, MotionLimits(**known), formula.law).laws[0]
        first = law.acceleration(0.0) if formula.law == "trapezoidal" else abs(law.peak(2).value)
        theirs = [law.duration, abs(law.peak(1).value), first]
        ours = [found.duration, found.velocity, found.acceleration]
        if not np.allclose(ours, theirs, rtol=AGREES, atol=0):
            raise FormulaError(f"T, |q̇| and |q̈| of the {found.name} case are {ours}, but the fastest law has {theirs}")
        breaks = law.breakpoints
        if len(breaks) != len(found.times) or np.abs(breaks - found.times).max(initial=0.0) > 1e-7 * found.duration:
            raise FormulaError(f"the switching times {found.times} are not those of the fastest law, {breaks.tolist()}")
