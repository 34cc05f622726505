"""The cases of the least time of each timing law over Δ, from rest to rest, in SymPy."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

BOUNDS = ("velocity", "acceleration", "jerk")  # of the orders 1, 2 and 3


@dataclass(frozen=True)
class TimeCase:
    """One case of a law: T and what happens when, in SymPy.

    Attributes:
        name: what the case is.
        conditions: relations that all hold; none where there is no other case.
        duration: T; nan where it has no closed form.
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
        import sympy

        when = f"if {' and '.join(map(str, self.conditions))}: " if self.conditions else ""
        if self.duration == sympy.nan:
            return f"{self.name}: {when or 'else '}T has no closed form"
        switches = f", switching at t = {', '.join(map(str, self.times))}" if self.times else ""
        return f"{self.name}: {when}T = {self.duration}{switches}"


def cases_of(law: str, symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a law.

    Args:
        law: its name.
        symbols: of the distance and the bounds, positive, by what they are: "distance", "velocity", ...
    """
    find = {"trapezoidal": _trapezoidal, "double_s": _double_s, "bang_bang": _bang_bang}
    return find[law](symbols) if law in find else _shape(law, symbols)


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
    return decided([cruise, _when(triangle, sympy.Lt(d, needed))])


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
    return decided([_when(cases[0], sympy.Ge(d, bound)), _when(cases[1], sympy.Lt(d, bound))])


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
    return decided([*cases, _when(tiny, *(sympy.Lt(d, bound) for bound in smallest))])


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
    durations = {name: sympy.root(c[k] * d / symbols[name], k + 1) for k, name in enumerate(BOUNDS) if name in symbols}
    cases = []
    for name, T in durations.items():
        others = [(other, S) for other, S in durations.items() if other != name]
        k = BOUNDS.index(name) + 1
        conditions = tuple(_longer(T, k, S, BOUNDS.index(other) + 1, d) for other, S in others)
        cases.append(TimeCase(f"bounded by the {name}", conditions, T, (), c[0] * d / T, c[1] * d / T**2))
    return decided(cases)


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


def decided(cases: Sequence[TimeCase]) -> list[TimeCase]:
    """Return the cases that numbers do not rule out, up to one without an open condition, which then holds."""
    import sympy

    kept = []
    for case in cases:
        conditions = [sympy.sympify(c) for c in case.conditions]
        if sympy.false not in conditions:
            open_ = tuple(c for c in conditions if c != sympy.true)
            kept.append(replace(case, conditions=open_))
            if not open_:
                break
    return kept
