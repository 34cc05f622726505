"""The least time of each timing law as a formula of Δ and the bounds, with the condition that decides each case."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import FormulaError, InputError, UnknownNameError, shown
from robotics1.inputs import counting_number, one_of, positive_number, real_number
from robotics1.trajectories.law_kinds import KINDS
from robotics1.trajectories.least_time_of_joints import Law, minimum_time
from robotics1.trajectories.limits import MotionLimits
from robotics1.trajectories.time_cases import BOUNDS, TimeCase, cases_of
from robotics1.trajectories.time_cases_between_velocities import cases_between_velocities

TRIALS = 8  # random values with which the formulas are compared
AGREES = 1e-9  # relative
STEADY = 1e-14  # relative: a change of velocity that is rounding
DIGITS = 30  # of the numbers that formulas are evaluated with


@dataclass(frozen=True)
class TimeFormula:
    """The least time of a timing law, in cases.

    Attributes:
        law: its name.
        symbols: of the distance and the bounds, by what they are: "distance", "velocity", ..., "v0" and "v1" if one of
            these is not zero.
        cases: one of them holds.
    """

    law: Law
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
            {s: _symbol(f"{s.name}_{i}", signed=not s.is_positive) for s in own}
            for i in range(1, counting_number("n", n, least=1) + 1)
        ]
        return sympy.Max(*(self.duration.xreplace(names) for names in numbered), evaluate=False)

    def case_of(self, **values: float) -> TimeCase:
        """Return the case that holds at these values, with numbers in the place of the symbols.

        Args:
            values: of the symbols, by their names: case_of(Delta=1, V=2, A=3).

        Raises:
            UnknownNameError: a value is of no symbol.
            InputError: a symbol has no value, one that is not positive, or v0 or v1 is beyond the bound V.
            FormulaError: the case that holds has no closed form.
        """
        import sympy

        symbols = {str(s): s for s in self.symbols.values() if isinstance(s, sympy.Symbol)}
        for name in values:
            if name not in symbols:
                raise UnknownNameError("symbol of the formula named", name, symbols)
        missing = [name for name in symbols if name not in values]
        if missing:
            raise InputError(f"give {missing[0]} a value too; the formula has {', '.join(symbols)}")
        known = {symbols[name]: sympy.Float(_number(symbols[name], value), DIGITS) for name, value in values.items()}
        self._check_ends(known)
        case = self._case_at(known)
        if case.duration == sympy.nan:
            raise FormulaError(
                f"here T has no closed form: {case.name}, and T is a root of a quartic; minimum_time(q0, q1, limits, "
                f"{self.law!r}, v0=v0, v1=v1) has it in numbers"
            )
        return _with_numbers(case, known)

    def _case_at(self, known: Mapping[Any, Any]) -> TimeCase:
        for case in self.cases[:-1]:
            if all(_holds(condition, known) for condition in case.conditions):
                return case
        return self.cases[-1]

    def _check_ends(self, known: Mapping[Any, Any]) -> None:
        """Raise InputError where a velocity at an end is beyond its bound."""
        v, V = (
            [self.symbols[name] for name in names if name in self.symbols] for names in (("v0", "v1"), ("velocity",))
        )
        ends = [abs(_in_numbers(symbol, known)) for symbol in v]
        if ends and V and max(ends) > _in_numbers(V[0], known):
            raise InputError(f"v0 and v1 must be within ±{V[0]}, the bound of the velocity; one is {max(ends):g}")

    def explain(self) -> str:
        """Return the cases, one a line."""
        return "\n".join(case.explain() for case in self.cases)


def time_formula(
    law: Law = "trapezoidal",
    *,
    distance: Any = "Delta",
    velocity: Any = None,
    acceleration: Any = None,
    jerk: Any = None,
    deceleration: Any = None,
    v0: Any = 0,
    v1: Any = 0,
) -> TimeFormula:
    """Return the least time of a timing law over |Δ|, in symbols: T and the switching times.

        time_formula("trapezoidal", velocity="V", acceleration="A").duration
        # Δ/V + V/A if Δ ≥ V²/A, else 2√(Δ/A)

    From rest to rest; or from v0 to v1: for a trapezoidal and a bang-bang law, a cubic with bounds on the velocity and
    the acceleration, a quintic with v0 = v1, and a double-S where both ramps reach A or the cruise reaches V. In the
    other cases T is a root of a polynomial of degree four or more, which the explanation says. For a trapezoidal law
    one condition decides whether the goal is passed: Δ < |v1 − v0| (v0 + v1)/(2A).

    The formulas are compared with `minimum_time` at random values, to 1e-9.

    Args:
        law: "trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine" or "cycloidal".
        distance: |Δ| > 0: a name, a positive SymPy symbol or a number.
        velocity, acceleration, jerk, deceleration: the bounds likewise; None for no bound.
        v0, v1: the velocities at the start and at the end, positive towards the goal: names, SymPy symbols or numbers.

    Raises:
        InputError: an argument is neither a name, a symbol nor a positive number, or the law needs another bound, or
            cannot keep one.
        FormulaError: the least time has no closed form, or the formulas do not agree with `minimum_time`.

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
    bounds = {name: value for name, value in given.items() if value is not None or name == "distance"}
    symbols = {name: _positive(name, value) for name, value in bounds.items()}
    ends = {name: _signed(name, value) for name, value in (("v0", v0), ("v1", v1))}
    if any(end != 0 for end in ends.values()):
        for end in ends.values():
            if end.is_Symbol and end.name in {str(s) for s in symbols.values()}:
                raise InputError(f"{end.name!r} names a velocity at an end and another quantity; give it another name")
        symbols |= ends
    _check_bounds(law, symbols)
    find = cases_between_velocities if "v0" in symbols else cases_of
    formula = TimeFormula(law, symbols, tuple(find(law, symbols)))
    _compare(formula)
    return formula


def _positive(name: str, value: Any) -> Any:
    """Return a bound as a positive symbol or number."""
    import sympy

    if isinstance(value, str | sympy.Symbol):
        return _symbol(value, name)
    return sympy.nsimplify(positive_number(name, value), rational=True)


def _signed(name: str, value: Any) -> Any:
    """Return a velocity at an end as a real symbol or number."""
    import sympy

    if isinstance(value, str | sympy.Symbol):
        return _symbol(value, name, signed=True)
    return sympy.nsimplify(real_number(name, value), rational=True)


def _symbol(value: Any, name: str = "", *, signed: bool = False) -> Any:
    import sympy

    if not str(value).isidentifier():
        raise InputError(f"{name} must be a name such as 'V', a symbol or a number; it is {shown(value)}")
    return sympy.Symbol(str(value), real=True) if signed else sympy.Symbol(str(value), positive=True)


def _number(symbol: Any, value: Any) -> float:
    return positive_number(symbol.name, value) if symbol.is_positive else real_number(symbol.name, value)


def _check_bounds(law: str, symbols: Mapping[str, Any]) -> None:
    """Refuse bounds that a law needs and has not, or has and cannot keep."""
    if law not in ("trapezoidal",) and "deceleration" in symbols:
        raise InputError(f"a {law} law has one bound on the acceleration; 'trapezoidal' brakes with another")
    if "v0" in symbols:
        _check_bounds_between_velocities(law, symbols)
    if law == "trapezoidal" and "acceleration" not in symbols:
        raise InputError("a trapezoidal law needs a bound on the acceleration")
    if law == "double_s" and "jerk" not in symbols:
        raise InputError("a double_s law needs a bound on the jerk")
    if law in ("trapezoidal", "bang_bang") and "jerk" in symbols:
        raise InputError(f"the acceleration of a {law} law jumps, so that no jerk is its bound; 'double_s' has one")
    if not any(name in symbols for name in BOUNDS):
        raise InputError("give a bound: velocity=, acceleration= or jerk=")


def _check_bounds_between_velocities(law: str, symbols: Mapping[str, Any]) -> None:
    if law in ("cosine", "cycloidal"):
        raise InputError(f"a {law} law begins and ends at rest; with velocities at the ends take 'cubic'")
    if "deceleration" in symbols:
        raise InputError("with v0 or v1 there is one bound of the acceleration: leave out deceleration=")
    if law in ("cubic", "quintic") and "jerk" in symbols:
        raise FormulaError(
            f"with velocities at the ends a bound of the jerk of a {law} has no short formula: minimum_time(q0, q1, "
            f"limits, {law!r}, v0=v0, v1=v1) has the time in numbers"
        )
    v0, v1 = symbols["v0"], symbols["v1"]
    if "velocity" in symbols and any(v.is_number and (abs(v) - symbols["velocity"]).is_positive for v in (v0, v1)):
        raise InputError(f"v0 and v1 must be within ±{symbols['velocity']}; they are {v0} and {v1}")


def _holds(condition: Any, known: Mapping[Any, Any]) -> bool:
    """Return whether an inequality holds in numbers."""
    left, right = (_in_numbers(side, known) for side in (condition.lhs, condition.rhs))
    return {">=": left >= right, "<=": left <= right, ">": left > right, "<": left < right}[condition.rel_op]


def _with_numbers(case: TimeCase, known: Mapping[Any, Any]) -> TimeCase:
    import sympy

    ends = [symbol for symbol in known if not symbol.is_positive]
    if case.duration.xreplace(known) == sympy.nan and len(ends) == 2:  # 0/0 at v0 = v1 = V; for v1 = v0 it cancels
        T, a, *instants = (
            sympy.cancel(x.xreplace({ends[1]: ends[0]})) for x in (case.duration, case.acceleration, *case.times)
        )
        case = replace(case, duration=T, acceleration=a, times=tuple(instants))
    T, velocity, acceleration = (_in_numbers(x, known) for x in (case.duration, case.velocity, case.acceleration))
    parts = {round(_in_numbers(t / case.duration, known), 15) for t in case.times}
    switches = parts - {0.0, 1.0} if acceleration * T > STEADY * velocity else set()
    times = tuple(T * part for part in sorted(switches))  # a ramp of no time switches nothing
    return TimeCase(case.name, case.conditions, T, times, velocity, acceleration)


def _in_numbers(expression: Any, known: Mapping[Any, Any]) -> float:
    value = expression.xreplace(known).evalf()
    if not value.is_real:
        raise InputError("the formula has no value at these numbers: no such motion keeps the bounds")
    return float(value)


def _compare(formula: TimeFormula) -> None:
    """Compare T, the switching times and the peaks with `minimum_time` at random values.

    Raises:
        FormulaError: they differ.
    """
    rng = np.random.default_rng(0)
    names = [str(s) for s in formula.symbols.values() if s.is_Symbol]
    for _ in range((3 if "v0" in formula.symbols else 1) * TRIALS if names else 1):
        values = _drawn(formula, rng)
        try:
            found = formula.case_of(**values)
        except FormulaError:  # the case without a closed form
            continue
        known = {name: float(values.get(str(s), s if s.is_number else 0)) for name, s in formula.symbols.items()}
        distance, v0, v1 = known.pop("distance"), known.pop("v0", 0.0), known.pop("v1", 0.0)
        law = minimum_time(0.0, distance, MotionLimits(**known), formula.law, v0=v0, v1=v1).laws[0]
        first = abs(law.acceleration(0.0) if formula.law == "trapezoidal" else law.peak(2).value)
        theirs, ours = [law.duration, abs(law.peak(1).value)], [found.duration, found.velocity]
        same = np.allclose(ours, theirs, rtol=AGREES, atol=0)
        rounding = AGREES * (found.acceleration + found.velocity / found.duration)
        if not same or (first and abs(first - found.acceleration) > rounding):  # at v0 = V there is no first ramp
            ours, theirs = [*ours, found.acceleration], [*theirs, first]
            raise FormulaError(f"T, |q̇| and |q̈| of the {found.name} case are {ours}, but the fastest law has {theirs}")
        breaks = law.breakpoints
        if len(breaks) != len(found.times) or np.abs(breaks - found.times).max(initial=0.0) > 1e-7 * found.duration:
            raise FormulaError(f"the switching times {found.times} are not those of the fastest law, {breaks.tolist()}")


def _drawn(formula: TimeFormula, rng: np.random.Generator) -> dict[str, float]:
    """Return random values of the symbols; the velocities at the ends within their bound."""
    values = {str(s): float(np.exp(rng.uniform(-2, 2))) for s in formula.symbols.values() if s.is_Symbol}
    bound = formula.symbols.get("velocity", 3)
    ends = [formula.symbols[name] for name in ("v0", "v1") if name in formula.symbols]
    if str(bound) in values:
        values[str(bound)] += max((abs(float(v)) for v in ends if v.is_number), default=0.0)
    most = values.get(str(bound), bound)
    for end in (symbol for symbol in ends if symbol.is_Symbol):
        values[str(end)] = float(most) * float(rng.uniform(-1, 1))
    return values
