"""Least times of laws from one velocity to another in symbols, against hand formulas and brute force over T."""

from contextlib import suppress
from itertools import pairwise

import numpy as np
import pytest
import sympy
from sweeps import core_first

import robotics1 as r1
from robotics1.trajectories import time_formula

D, V, A, J = sympy.symbols("Delta V A J", positive=True)
V0, V1, v = sympy.symbols("v0 v1 v", real=True)
BOUNDS = {"velocity": "V", "acceleration": "A"}
ENDS = {"v0": "v0", "v1": "v1"}
SEEDS = core_first(range(6), [0], 1)


def same(a, b):
    return sympy.simplify(a - b) == 0


def drawn(seed, names):
    """Values of the symbols by name, with the velocities at the ends within ±V."""
    rng = np.random.default_rng(seed)
    for _ in range(40):
        values = {name: float(np.exp(rng.uniform(-1.5, 1.5))) for name in names if name not in ("v0", "v1", "v")}
        for name in ("v0", "v1", "v"):
            if name in names:
                values[name] = float(values.get("V", 2.0) * rng.uniform(-1, 1))
        yield values


def least_of_a_polynomial(coefficients, values):
    """The least T at which |q̇| ≤ V and |q̈| ≤ A, by a fine scan; `coefficients` of q(τ), τ = t/T, at a T."""
    tau = np.linspace(0, 1, 201)
    scale = values["Delta"] / values.get("V", 2.0) + np.sqrt(values["Delta"] / values.get("A", 2.0))
    for T in np.geomspace(scale / 30, 40 * scale, 3000):
        q = np.polynomial.Polynomial(coefficients(T))
        fast = np.abs(q.deriv(1)(tau)).max() / T > values.get("V", np.inf) * (1 + 1e-9)
        if not fast and np.abs(q.deriv(2)(tau)).max() / T**2 <= values.get("A", np.inf) * (1 + 1e-9):
            return T
    raise AssertionError("no T")


def cubic_coefficients(d, v0, v1):
    return lambda T: [0, v0 * T, 3 * d - (2 * v0 + v1) * T, -2 * d + (v0 + v1) * T]


def quintic_coefficients(d, v):
    return lambda T: [0, v * T, 0, 10 * (d - v * T), -15 * (d - v * T), 6 * (d - v * T)]


def test_a_cubic_that_touches_the_velocity_bound_by_hand():
    """V − q̇ is a square: from √(V − v0) to √(V − v1) over zero, with the mean V − Δ/T."""
    f = time_formula("cubic", velocity="V", **ENDS)
    assert same(f.duration, 3 * D / (V + V0 + V1 + sympy.sqrt((V - V0) * (V - V1))))
    assert same(time_formula("cubic", velocity="V", v0="v", v1="v").duration.subs(v, V), D / V)
    assert f.case_of(Delta=2, V=3, v0=0, v1=0).duration == pytest.approx(3 / 2 * 2 / 3)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("bounds", [BOUNDS, {"velocity": "V"}, {"acceleration": "A"}])
def test_the_time_of_a_cubic_is_the_least_that_a_scan_finds(seed, bounds):
    f, seen = time_formula("cubic", **bounds, **ENDS), set()
    for values in list(drawn(seed, ["Delta", *bounds.values(), "v0", "v1"]))[:6]:
        case = f.case_of(**values)
        expected = least_of_a_polynomial(cubic_coefficients(values["Delta"], values["v0"], values["v1"]), values)
        assert case.duration == pytest.approx(expected, rel=4e-3)
        seen.add(case.name)
    assert len(seen) >= len(f.cases) - 1


def test_a_cubic_from_a_high_speed_may_have_to_take_the_larger_root():
    """A T² + 6.4 T ≥ 6 from T = 0.82, but with b = 12.2 A T² − bT + 6 ≥ 0 only before T = 0.51 and after 11.7."""
    late = time_formula("cubic", acceleration="A", **ENDS).case_of(Delta=1, A=1, v0=3, v1=0.1)
    assert late.name.endswith("the larger root")
    assert late.duration == pytest.approx(
        least_of_a_polynomial(cubic_coefficients(1, 3, 0.1), {"Delta": 1, "A": 1}), rel=4e-3
    )


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("bounds", [BOUNDS, {"velocity": "V"}, {"acceleration": "A"}])
def test_a_quintic_between_equal_velocities_is_one_at_rest_on_a_moving_floor(seed, bounds):
    f = time_formula("quintic", **bounds, v0="v", v1="v")
    for values in list(drawn(seed, ["Delta", *bounds.values(), "v"]))[:6]:
        expected = least_of_a_polynomial(quintic_coefficients(values["Delta"], values["v"]), values)
        assert f.case_of(**values).duration == pytest.approx(expected, rel=4e-3)
    if "acceleration" not in bounds:
        assert same(f.duration, 15 * D / (8 * V + 7 * v))


def test_a_bang_bang_law_that_may_not_exceed_v_accelerates_less():
    f = time_formula("bang_bang", **BOUNDS, **ENDS)
    slow, rising, back = f.cases
    e = (V0**2 + V1**2) / 2
    assert same(
        slow.duration, D / ((V + V0) / 2) * (V**2 - V0**2) / (2 * V**2 - V0**2 - V1**2) + (V - V1) * D / (V**2 - e)
    )
    assert same(rising.duration, time_formula("trapezoidal", acceleration="A", **ENDS).cases[0].duration)
    assert back.conditions == (sympy.Lt(D, sympy.Abs(V0 - V1) * (V0 + V1) / (2 * A)),)


@pytest.mark.parametrize("bounds", [{}, {"acceleration": "A"}], ids=["V", "V, A"])
def test_a_bang_bang_law_from_V_to_V_keeps_it(bounds):
    """Δ (2V − v0 − v1)/(V² − (v0² + v1²)/2) is 0/0 there; T = Δ/V."""
    formula = time_formula("bang_bang", velocity="V", v0="v0", v1="v1", **bounds)
    for V in (0.3, 1.0, 7.0):
        found = formula.case_of(Delta=2, V=V, v0=V, v1=V, **dict.fromkeys(bounds.values(), 3))
        assert (found.duration, found.velocity, found.acceleration) == pytest.approx((2 / V, V, 0))
        assert found.times == ()
    numbers = time_formula("bang_bang", velocity=0.7, v0=0.7, v1=0.7, **bounds)
    assert [str(case.duration) for case in numbers.cases] == ["10*Delta/7"]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_bang_bang_law_arrives_with_its_velocity_and_one_bound_is_reached(seed):
    f = time_formula("bang_bang", **BOUNDS, **ENDS)
    for values in drawn(seed, ["Delta", "V", "A", "v0", "v1"]):
        case = f.case_of(**values)
        (t,), a = case.times, case.acceleration * (-1 if case.name.startswith("past") else 1)
        top, rest = values["v0"] + a * t, case.duration - t
        assert top - a * rest == pytest.approx(values["v1"], abs=1e-9)
        assert (values["v0"] + top) / 2 * t + (top + values["v1"]) / 2 * rest == pytest.approx(values["Delta"])
        assert t >= 0
        assert rest >= 0
        use = max(abs(top) / values["V"], abs(a) / values["A"])
        assert use == pytest.approx(1)


def state_after(jerks, times, start):
    """The velocity and distance after pieces of constant jerk, by hand."""
    s, speed, a = 0.0, start, 0.0
    peaks = []
    for jerk, (t0, t1) in zip(jerks, pairwise(times), strict=True):
        h = t1 - t0
        s += speed * h + a * h**2 / 2 + jerk * h**3 / 6
        speed += a * h + jerk * h**2 / 2
        a += jerk * h
        peaks.append((abs(speed), abs(a)))
    return s, speed, a, np.max(peaks, axis=0)


PATTERNS = {6: [1, 0, -1, 0, -1, 0, 1], 4: [1, 0, -1, 0, 1]}


@pytest.mark.parametrize("seed", SEEDS)
def test_a_double_s_arrives_by_its_switching_times_with_its_bounds_reached(seed):
    f, seen = time_formula("double_s", **BOUNDS, jerk="J", **ENDS), set()
    for values in drawn(seed, ["Delta", "V", "A", "J", "v0", "v1"]):
        limits = r1.MotionLimits(velocity=values["V"], acceleration=values["A"], jerk=values["J"])
        case = None
        least = r1.minimum_time(0, values["Delta"], limits, "double_s", v0=values["v0"], v1=values["v1"]).duration
        with suppress(r1.FormulaError):
            case = f.case_of(**values)
            seen.add(case.name)
        if case is None:
            continue
        assert case.duration == pytest.approx(least, rel=1e-9)
        way = -1 if "past the goal" in case.name else 1
        first, last = ((values["V"] - values[name]) * values["J"] >= values["A"] ** 2 for name in ("v0", "v1"))
        alone = case.name.startswith("the acceleration alone")
        start = [1, 0, -1] if alone or first else [1, -1]
        end = [-1, 0, 1] if alone or last else [-1, 1]
        jerks = [*start, *end[1:]] if alone else [*start, 0, *end]
        s, speed, a, peaks = state_after(
            way * values["J"] * np.array(jerks), [0, *case.times, case.duration], values["v0"]
        )
        assert [s, speed] == pytest.approx([values["Delta"], values["v1"]], abs=1e-8)
        assert a == pytest.approx(0, abs=1e-8)
        assert peaks[0] <= values["V"] * (1 + 1e-9)
        assert peaks[1] <= values["A"] * (1 + 1e-9)
    assert len(seen) >= 3


def test_numbers_and_symbols_may_be_mixed():
    """A number at an end, and V by name: V is at least that number."""
    f = time_formula("trapezoidal", **BOUNDS, v0=50)
    assert f.case_of(Delta=3000, V=60, A=10).duration == pytest.approx(1 + (3000 - 55 - 180) / 60 + 6)


@pytest.mark.parametrize("law", ["trapezoidal", "bang_bang", "cubic", "quintic", "double_s"])
@pytest.mark.parametrize("distance", [0.05, 0.3, 3])
@pytest.mark.parametrize("ends", [(0.5, 0.5), (0, 1), (-1, 0), (2, 0), (2, 2), (-2, -2)])
def test_numbers_alone_leave_the_case_that_holds(law, distance, ends):
    """What does not hold has roots of negative numbers, which nobody may compare."""
    if law == "quintic" and ends[0] != ends[1]:
        return
    bounds = {"velocity": 2, "acceleration": 4} | ({"jerk": 10} if law == "double_s" else {})
    if law == "bang_bang" and ends == (-2, -2):
        with pytest.raises(r1.InputError, match="no such motion keeps the bounds"):
            time_formula(law, distance=distance, **bounds, v0=-2, v1=-2)
        with pytest.raises(r1.InputError, match="no such motion"):
            time_formula(law, **BOUNDS, **ENDS).case_of(Delta=distance, V=2, A=4, v0=-2, v1=-2)
        return
    least = r1.minimum_time(0, distance, r1.MotionLimits(**bounds), law, v0=ends[0], v1=ends[1]).duration
    f = time_formula(law, distance=distance, **bounds, v0=ends[0], v1=ends[1])
    if f.cases[0].duration == sympy.nan:
        assert "no closed form" in f.explain()
        return
    assert [case.conditions for case in f.cases] == [()]
    assert float(f.duration) == pytest.approx(least, rel=1e-5)  # a bound that is only touched has a double root
    assert f.case_of().duration == pytest.approx(float(f.duration), rel=1e-12)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: time_formula("septic", velocity="V", v0="v0"), "polynomial of high degree: minimum_time"),
        (lambda: time_formula("quintic", velocity="V", v0="v0"), "v0 = v1 has a formula"),
        (lambda: time_formula("cubic", velocity="V", jerk="J", v0="v0"), "no short formula: minimum_time"),
        (lambda: time_formula("double_s", jerk="J", v0="v0"), "root of a quartic: minimum_time"),
        (lambda: time_formula("double_s", velocity="V", jerk="J", v0=1).case_of(Delta=0.1, V=2, J=1), "no closed form"),
    ],
)
def test_where_no_closed_form_exists_the_sentence_names_what_has_the_number(call, words):
    with pytest.raises(r1.FormulaError, match=words):
        call()
    assert "T has no closed form" in time_formula("double_s", velocity="V", jerk="J", v0=1).explain()


@pytest.mark.parametrize(
    ("law", "options", "words"),
    [
        ("cosine", {"velocity": "V", "v0": 1}, "begins and ends at rest"),
        ("cubic", {"velocity": 1, "v0": 2}, "within ±1"),
        ("trapezoidal", {"acceleration": "A", "deceleration": "B", "v0": 1}, "one bound of the acceleration"),
    ],
)
def test_velocities_that_a_law_cannot_have_are_refused(law, options, words):
    with pytest.raises(r1.InputError, match=words):
        time_formula(law, **options)
