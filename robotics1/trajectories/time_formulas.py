"""The least time of each timing law as a formula of Δ and the bounds, with the condition that decides each case."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import FormulaError, InputError, UnknownNameError
from robotics1.inputs import counting_number, one_of, positive_number, text
from robotics1.trajectories.law_kinds import KINDS
from robotics1.trajectories.least_time_of_joints import Law, minimum_time
from robotics1.trajectories.limits import MotionLimits
from robotics1.trajectories.time_cases import BOUNDS, TimeCase, cases_of

TRIALS = 8  # random values with which the formulas are compared
AGREES = 1e-9  # relative


@dataclass(frozen=True)
class TimeFormula:
    """The least time of a timing law from rest to rest, in cases.

    Attributes:
        law: its name.
        symbols: of the distance and the bounds, by what they are: "distance", "velocity", ...
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
    law: Law = "trapezoidal",
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
    bounds = {name: value for name, value in given.items() if value is not None or name == "distance"}
    symbols = {name: _positive(name, value) for name, value in bounds.items()}
    _check_bounds(law, symbols)
    formula = TimeFormula(law, symbols, tuple(cases_of(law, symbols)))
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
