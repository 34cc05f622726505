"""The cases of the least time of each timing law over Δ, from the velocity v0 to v1, in SymPy."""

from collections.abc import Mapping
from itertools import product
from typing import Any

from robotics1.errors import FormulaError
from robotics1.trajectories.time_cases import TimeCase, decided


def cases_between_velocities(law: str, symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a law.

    Args:
        law: its name.
        symbols: of the distance and the bounds, positive, by what they are, and of "v0" and "v1", real.

    Raises:
        FormulaError: the least time of the law has no closed form.
    """
    find = {
        "trapezoidal": _trapezoidal,
        "bang_bang": _bang_bang,
        "cubic": _cubic,
        "quintic": _quintic,
        "double_s": _double_s,
    }
    if law not in find:
        raise FormulaError(
            f"with velocities at the ends the least time of a {law} law is a root of a polynomial of high degree: "
            f"minimum_time(q0, q1, limits, {law!r}, v0=v0, v1=v1) has it in numbers"
        )
    return decided(find[law](symbols))


def _trapezoidal(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of accelerations ±A from v0 to v1, which are positive towards the goal and within ±V.

    A ramp straight from v0 to v1 takes Δ₀ = |v1 − v0| (v0 + v1)/(2A). If Δ ≥ Δ₀, the velocity first rises, to
    c = √(AΔ + (v0² + v1²)/2) or to V. Else the joint passes its goal, turns, and comes back with the velocity −c of
    c = √((v0² + v1²)/2 − AΔ), which is less than V.
    """
    import sympy

    d, A, v0, v1 = (symbols[name] for name in ("distance", "acceleration", "v0", "v1"))
    if "velocity" not in symbols:
        return _one_switch(symbols, ())
    V, squares = symbols["velocity"], (v0**2 + v1**2) / 2
    needed = (V**2 - squares) / A
    T = sympy.expand(d / V + (V + squares / V - v0 - v1) / A)
    cruise = TimeCase("trapezoidal", (sympy.Ge(d, needed),), T, ((V - v0) / A, T - (V - v1) / A), V, A)
    return [cruise, *_one_switch(symbols, (sympy.Lt(d, needed),))]


def _one_switch(symbols: Mapping[str, Any], short: tuple[Any, ...]) -> list[TimeCase]:
    """Return the cases of A, then −A, where the distance is short enough, and of −A, then A."""
    import sympy

    d, A, v0, v1 = (symbols[name] for name in ("distance", "acceleration", "v0", "v1"))
    squares, straight = (v0**2 + v1**2) / 2, sympy.Abs(v1 - v0) * (v0 + v1) / (2 * A)
    fastest = [sympy.Abs(v0), sympy.Abs(v1)]
    c, back = sympy.sqrt(A * d + squares), sympy.sqrt(squares - A * d)
    rising = (sympy.Ge(d, straight), *short)
    turned = (sympy.Lt(d, straight),)
    return [
        TimeCase(
            "triangular", rising, (2 * c - v0 - v1) / A, ((c - v0) / A,), sympy.Max(c, *fastest, evaluate=False), A
        ),
        TimeCase(
            "past the goal and back",
            turned,
            (2 * back + v0 + v1) / A,
            ((back + v0) / A,),
            sympy.Max(back, *fastest, evaluate=False),
            A,
        ),
    ]


def _bang_bang(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of one switch: at the acceleration A, or less where the velocity at the switch would exceed V.

    With V there, the mean velocities of both parts give T = Δ (2V − v0 − v1)/(V² − e), e = (v0² + v1²)/2. Of
    numbers with v0 = v1 = V, where that is 0/0, the velocity stays.
    """
    import sympy

    d, v0, v1 = (symbols[name] for name in ("distance", "v0", "v1"))
    if "velocity" not in symbols:
        return _one_switch(symbols, ())
    V, squares = symbols["velocity"], (v0**2 + v1**2) / 2
    if v0 == v1 == V:
        return [TimeCase("bounded by the velocity", (), d / V, (), V, sympy.S.Zero)]
    T, a = d * (2 * V - v0 - v1) / (V**2 - squares), (V**2 - squares) / d
    conditions: tuple[Any, ...] = ()
    others = []
    if "acceleration" in symbols:
        needed = (V**2 - squares) / symbols["acceleration"]
        conditions, others = (sympy.Ge(d, needed),), _one_switch(symbols, (sympy.Lt(d, needed),))
    return [TimeCase("bounded by the velocity", conditions, T, ((V - v0) / a,), V, a), *others]


def _cubic(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a cubic.

    Its velocity is a parabola of the mean Δ/T. If it touches V, V − q̇ is a square, and Δ/T = (V + v0 + v1 + √((V − v0)
    (V − v1)))/3. Its acceleration is largest at an end, ±(6Δ − bT)/T² with b = 4v0 + 2v1 or 2v0 + 4v1: within A if
    AT² + bT ≥ 6Δ for the smaller b, and AT² − bT + 6Δ ≥ 0 for the larger, which a T between two roots is not.
    """
    import sympy

    d, v0, v1 = (symbols[name] for name in ("distance", "v0", "v1"))
    least = []  # the least times of the two bounds, where T alone does not exceed them
    if "velocity" in symbols:
        V = symbols["velocity"]
        least.append(("velocity", 3 * d / (V + v0 + v1 + sympy.sqrt((V - v0) * (V - v1)))))
    if "acceleration" not in symbols:
        return [_of_cubic("bounded by the velocity", (), least[0][1], symbols)]
    A = symbols["acceleration"]
    return _with_a_gap(least, (6 * d, 3 * (v0 + v1), sympy.Abs(v0 - v1), A), symbols, _of_cubic)


def _with_a_gap(least: list[tuple[str, Any]], terms: Any, symbols: Mapping[str, Any], case: Any) -> list[TimeCase]:
    """Return the cases of A T² ≥ |D − bT| for all b from B − s to B + s, with least times of other bounds."""
    import sympy

    D, B, s, A = terms
    rising = (sympy.sqrt((B - s) ** 2 + 4 * A * D) - (B - s)) / (2 * A)
    falling = (B + s + sympy.sqrt((B + s) ** 2 - 4 * A * D)) / (2 * A)
    times = [*least, ("acceleration", rising)]
    cases = []
    for i, (name, T) in enumerate(times):
        longest = tuple(sympy.Ge(T, other) for j, (_, other) in enumerate(times) if j != i)
        allowed = sympy.Ge(D, B * T) if name == "acceleration" else sympy.Ge(A * T**2 + D, (B + s) * T)
        cases.append(case(f"bounded by the {name}", (*longest, allowed), T, symbols))
    return [*cases, case("bounded by the acceleration, the larger root", (), falling, symbols)]


def _of_cubic(name: str, conditions: tuple[Any, ...], T: Any, symbols: Mapping[str, Any]) -> TimeCase:
    """Return a case with the largest |q̇|, at an end or where q̈ = 0, and |q̈|, at an end."""
    import sympy

    d, v0, v1 = (symbols[name] for name in ("distance", "v0", "v1"))
    first, last = (6 * d / T - 4 * v0 - 2 * v1) / T, (2 * v0 + 4 * v1 - 6 * d / T) / T
    ends = [sympy.Abs(v0), sympy.Abs(v1)]
    middle = sympy.Abs(v0 + first**2 * T / (2 * (first - last)))
    between = sympy.Piecewise((middle, first * last < 0), (0, True))
    fastest = sympy.Max(between, *ends, evaluate=False)
    return TimeCase(name, conditions, T, (), fastest, sympy.Max(sympy.Abs(first), sympy.Abs(last), evaluate=False))


def _quintic(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a quintic with v0 = v1 = v: q = v t + the law from rest to rest over Δ − vT.

    Then |q̇| ≤ v + 15/8 (Δ/T − v), and |q̈| ≤ 10/√3 |Δ − vT|/T².
    """
    import sympy

    d, v = symbols["distance"], symbols["v0"]
    if v != symbols["v1"]:
        raise FormulaError(
            "between two different velocities the least time of a quintic is a root of a polynomial of high degree: "
            "minimum_time(q0, q1, limits, 'quintic', v0=v0, v1=v1) has it in numbers; v0 = v1 has a formula"
        )
    c = 10 / sympy.sqrt(3)

    def case(name: str, conditions: tuple[Any, ...], T: Any, _: Mapping[str, Any]) -> TimeCase:
        middle = sympy.Abs(v + sympy.Rational(15, 8) * (d / T - v))
        fastest = sympy.Max(sympy.Abs(v), middle, evaluate=False)
        return TimeCase(name, conditions, T, (), fastest, c * sympy.Abs(d - v * T) / T**2)

    least = []
    if "velocity" in symbols:
        least.append(("velocity", 15 * d / (8 * symbols["velocity"] + 7 * v)))
    if "acceleration" not in symbols:
        return [case("bounded by the velocity", (), least[0][1], symbols)]
    return _with_a_gap(least, (c * d, c * v, sympy.S.Zero, symbols["acceleration"]), symbols, case)


def _double_s(symbols: Mapping[str, Any]) -> list[TimeCase]:
    """Return the cases of a double-S that have a closed form: those with a cruise at V, or with A in both ramps.

    A ramp from v to p takes 2√((p − v)/J), or A/J + (p − v)/A if (p − v) J ≥ A², with the mean velocity (v + p)/2.
    Where the ramps meet at a p that is not V, and A is not reached in one of them, p is a root of a quartic.
    """
    import sympy

    d, v0, v1, J = (symbols[name] for name in ("distance", "v0", "v1", "jerk"))
    A, V = symbols.get("acceleration"), symbols.get("velocity")
    cases = []
    for full in product((True, False), repeat=2) if V is not None else ():
        if any(full) and A is None:
            continue
        ramps, conditions = [], []
        for v, reached in zip((v0, v1), full, strict=True):
            ramps.append(_ramp(V - v, A if reached else None, J))
            if A is not None:
                conditions.append((sympy.Ge if reached else sympy.Lt)((V - v) * J, A**2))
        needed = sum(t * (v + V) / 2 for v, (t, _) in zip((v0, v1), ramps, strict=True))
        name = {2: "both bounds are reached", 0: "the velocity alone is reached"}
        ramp = "first" if full[0] else "last"
        words = name.get(sum(full), f"both bounds are reached, the acceleration only in the {ramp} ramp")
        cases.append(_meeting(words, (*conditions, sympy.Ge(d, needed)), V, ramps, symbols))
    if A is not None:
        for way, words in ((1, ""), (-1, ", past the goal and back")):
            cases.append(_without_cruise(f"the acceleration alone is reached{words}", way, symbols))
    if not cases:
        raise FormulaError(
            "with a bound of the jerk alone T is a root of a quartic: minimum_time(q0, q1, limits, 'double_s', v0=v0, "
            "v1=v1) has it in numbers"
        )
    nan = sympy.nan
    return [*cases, TimeCase("the acceleration is not reached in each ramp", (), nan, (), nan, nan)]


def _ramp(rise: Any, A: Any, J: Any) -> tuple[Any, Any]:
    """Return how long a ramp takes, and how long each of its jerks; the acceleration reaches A, or None."""
    import sympy

    if A is None:
        return 2 * sympy.sqrt(rise / J), sympy.sqrt(rise / J)
    return A / J + rise / A, A / J


def _without_cruise(name: str, way: int, symbols: Mapping[str, Any]) -> TimeCase:
    """Return the case of two ramps that reach A and meet at p > v0, v1; of way −1 the mirror image."""
    import sympy

    d, v0, v1 = (way * symbols[name] for name in ("distance", "v0", "v1"))
    A, J = symbols["acceleration"], symbols["jerk"]

    def distance(p: Any) -> Any:
        return (p**2 - (v0**2 + v1**2) / 2) / A + A / J * (p + (v0 + v1) / 2)

    p = (sympy.sqrt((A**2 / J) ** 2 + 4 * A * d + 2 * (v0**2 + v1**2) - 2 * A**2 / J * (v0 + v1)) - A**2 / J) / 2
    conditions: tuple[Any, ...] = (sympy.Ge(d, distance(sympy.Max(v0, v1) + A**2 / J)),)
    if "velocity" in symbols and way > 0:
        conditions += (sympy.Lt(d, distance(symbols["velocity"])),)
    if way < 0:  # a ramp straight from v0 to v1 passes the goal
        rise = sympy.Abs(v0 - v1)
        straight = sympy.Piecewise((_ramp(rise, A, J)[0], rise * J >= A**2), (_ramp(rise, None, J)[0], True))
        conditions += (sympy.Gt(d, (v0 + v1) / 2 * straight),)
    mirrored = {**symbols, "distance": d, "v0": v0, "v1": v1}
    return _meeting(name, conditions, p, [_ramp(p - v, A, J) for v in (v0, v1)], mirrored)


def _meeting(
    name: str, conditions: tuple[Any, ...], p: Any, ramps: list[tuple[Any, Any]], symbols: Mapping[str, Any]
) -> TimeCase:
    """Return the case of two ramps over the velocity p, with a cruise if their distance is less than Δ."""
    import sympy

    d, v0, v1, J = (symbols[name] for name in ("distance", "v0", "v1", "jerk"))
    (t0, j0), (t1, j1) = ramps
    cruises = p == symbols.get("velocity")
    T = sympy.expand(d / p + t0 * (p - v0) / (2 * p) + t1 * (p - v1) / (2 * p)) if cruises else sympy.expand(t0 + t1)
    instants = [j0, t0 - j0, t0, T - t1, T - t1 + j1, T - j1] if cruises else [j0, t0 - j0, t0 + j1, T - j1]
    times = tuple(t for t in dict.fromkeys(sympy.expand(t) for t in instants) if t not in (0, T))
    fastest = p if cruises else sympy.Max(p, sympy.Abs(v0), sympy.Abs(v1), evaluate=False)
    return TimeCase(name, conditions, T, times, fastest, J * sympy.Max(j0, j1, evaluate=False))
