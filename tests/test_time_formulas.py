"""Least times, switching times and rate bounds in symbols, against hand formulas and against the numbers."""

from math import sqrt

import numpy as np
import pytest
import sympy
from sweeps import core_first

import robotics1 as r1
from robotics1.trajectories import bounded_if, polynomial_formula, rate_extremes, time_formula

D, V, A, J, B = sympy.symbols("Delta V A J B", positive=True)
FULL = {"velocity": "V", "acceleration": "A", "jerk": "J"}


def same(a, b):
    return sympy.simplify(a - b) == 0


def test_the_trapezoid_and_the_triangle_with_the_condition_that_decides():
    f = time_formula("trapezoidal", velocity="V", acceleration="A")
    cruise, triangle = f.cases
    assert same(cruise.duration, D / V + V / A)
    assert cruise.conditions == (sympy.Ge(D, V**2 / A),)
    assert [same(a, b) for a, b in zip(cruise.times, (V / A, D / V), strict=True)] == [True, True]
    assert same(triangle.duration, 2 * sympy.sqrt(D / A))
    assert same(triangle.times[0], sympy.sqrt(D / A))
    assert same(triangle.velocity, sympy.sqrt(A * D))
    assert isinstance(f.duration, sympy.Piecewise)
    assert "if Delta >= V**2/A: T = Delta/V + V/A" in f.explain()


def test_another_deceleration_moves_the_switch():
    f = time_formula("trapezoidal", velocity="V", acceleration="A", deceleration="B")
    cruise, triangle = f.cases
    assert same(cruise.duration, D / V + V / (2 * A) + V / (2 * B))
    assert same(cruise.times[1], cruise.duration - V / B)
    assert same(triangle.duration**2, 2 * D * (A + B) / (A * B))
    assert same(cruise.conditions[0].rhs, V**2 * (A + B) / (2 * A * B))


def test_a_bang_bang_law_with_a_bound_on_the_velocity_alone_takes_twice_the_distance_over_it():
    f = time_formula("bang_bang", velocity="V")
    assert f.duration == 2 * D / V
    assert f.cases[0].times == (D / V,)
    assert same(f.cases[0].acceleration, V**2 / D)
    answer = r1.minimum_time([0, 1], [3, 1.5], r1.MotionLimits(velocity=[2, 1]), "bang_bang")
    assert answer.joint_durations == pytest.approx([3, 1])
    both = time_formula("bang_bang", velocity="V", acceleration="A")
    assert both.case_of(Delta=4, V=1, A=1).duration == 8
    assert both.case_of(Delta=1, V=4, A=1).duration == 2


def test_the_cases_of_a_double_s():
    f = time_formula("double_s", **FULL)
    both, smooth, fast, tiny = f.cases
    assert same(both.duration, D / V + V / A + A / J)
    assert both.conditions == (sympy.Ge(V * J, A**2), sympy.Ge(D, V**2 / A + A * V / J))
    assert same(smooth.duration, A / J + sympy.sqrt(A**2 / J**2 + 4 * D / A))
    assert same(fast.duration, D / V + 2 * sympy.sqrt(V / J))
    assert same(tiny.duration, sympy.cbrt(32 * D / J))
    exam = f.case_of(Delta=3, V=2, A=4, J=10)  # the exam of 2010-09-15
    assert exam.duration == pytest.approx(2.4)
    assert exam.times == pytest.approx([0.4, 0.5, 0.9, 1.5, 1.9, 2.0])
    assert [len(case.times) for case in f.cases] == [6, 4, 4, 2]


SHAPES = {
    "cubic": (sympy.Rational(3, 2), 6, 12),
    "quintic": (sympy.Rational(15, 8), 10 / sympy.sqrt(3), 60),
    "septic": (sympy.Rational(35, 16), 84 * sympy.sqrt(5) / 25, sympy.Rational(105, 2)),
    "cosine": (sympy.pi / 2, sympy.pi**2 / 2, sympy.pi**3 / 2),
    "cycloidal": (2, 2 * sympy.pi, 4 * sympy.pi**2),
}


@pytest.mark.parametrize("law", core_first(SHAPES, ["cubic", "cycloidal"]))
def test_shapes_take_the_largest_of_three_times(law):
    f = time_formula(law, **FULL)
    c1, c2, c3 = SHAPES[law]
    durations = [c1 * D / V, sympy.sqrt(c2 * D / A), sympy.cbrt(c3 * D / J)]
    for case, expected in zip(f.cases, durations, strict=True):
        assert float(abs((case.duration / expected).subs({D: 2, V: 3, A: 5, J: 7}).evalf() - 1)) < 1e-14
    rng = np.random.default_rng(1)
    for _ in range(12):
        values = dict(zip(("Delta", "V", "A", "J"), rng.uniform(0.2, 5, 4).tolist(), strict=True))
        numbers = [float(T.subs(dict(zip((D, V, A, J), values.values(), strict=True)))) for T in durations]
        assert f.case_of(**values).duration == pytest.approx(max(numbers), rel=1e-12)


@pytest.mark.parametrize(
    "law", core_first(["trapezoidal", "double_s", "bang_bang", "cubic", "quintic"], ["trapezoidal", "double_s"])
)
def test_the_formula_is_the_least_time_in_numbers(law):
    bounds = FULL if law not in ("trapezoidal", "bang_bang") else {"velocity": "V", "acceleration": "A"}
    f = time_formula(law, **bounds)
    for seed in range(4):
        rng = np.random.default_rng(seed)
        values = {name: float(np.exp(rng.uniform(-2, 2))) for name in ("Delta", *bounds.values())}
        limits = r1.MotionLimits(**{name: values[symbol] for name, symbol in bounds.items()})
        expected = r1.minimum_time(0, values["Delta"], limits, law)
        case = f.case_of(**values)
        assert case.duration == pytest.approx(expected.duration, rel=1e-10)
        assert expected.laws[0].breakpoints == pytest.approx(case.times, rel=1e-7)
        symbols = {s: values[s.name] for s in (D, V, A, J) if s.name in values}
        assert float(f.duration.subs(symbols)) == pytest.approx(expected.duration, rel=1e-10)


def test_numbers_in_the_place_of_symbols_leave_the_cases_that_can_be():
    f = time_formula("trapezoidal", distance=3, velocity=1, acceleration=2)
    assert [case.name for case in f.cases] == ["trapezoidal"]
    assert f.duration == sympy.Rational(7, 2)
    assert len(time_formula("trapezoidal", distance=3, velocity="V", acceleration=2).cases) == 2


def test_joints_that_arrive_together_take_the_largest_time():
    together = time_formula("trapezoidal", acceleration="A").of_joints(2)
    D1, D2, A1, A2 = sympy.symbols("Delta_1 Delta_2 A_1 A_2", positive=True)
    assert together.has(D1, D2, A1, A2)
    values = {D1: 1, D2: 4, A1: 4, A2: 1}
    assert float(together.subs(values)) == pytest.approx(max(2 * sqrt(1 / 4), 2 * sqrt(4)))


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda: time_formula("triangular"), r1.InputError, "one of"),
        (lambda: time_formula("trapezoidal", velocity="V"), r1.InputError, "needs a bound on the acceleration"),
        (lambda: time_formula("double_s", velocity="V"), r1.InputError, "jerk"),
        (lambda: time_formula("trapezoidal", acceleration="A", jerk="J"), r1.InputError, "jumps"),
        (lambda: time_formula("cubic"), r1.InputError, "give a bound"),
        (lambda: time_formula("cubic", velocity="2V"), r1.InputError, "name such as"),
        (lambda: time_formula("cubic", velocity=-1), r1.InputError, "positive"),
        (lambda: time_formula("cubic", velocity="V", deceleration="B"), r1.InputError, "brakes with another"),
        (lambda: time_formula("cubic", velocity="V").case_of(Delta=1, W=2), r1.UnknownNameError, "Delta"),
        (lambda: time_formula("cubic", velocity="V").case_of(Delta=1), r1.InputError, "V a value"),
        (lambda: time_formula("cubic", velocity="V").of_joints(0), r1.InputError, "at least 1"),
    ],
)
def test_misuse_says_what_would_be_right(call, error, words):
    with pytest.raises(error, match=words):
        call()


# --- conditions on the data of a polynomial

q0, q1, v0, v1 = sympy.symbols("q0 q1 v0 v1", real=True)
T = sympy.Symbol("T", positive=True)


def test_the_velocity_of_a_cubic_is_largest_at_an_end_or_at_one_instant_between():
    first, last, middle = rate_extremes(polynomial_formula((q0, v0), (q1, v1), T))
    assert (first.value, last.value) == (v0, v1)
    c2, c3 = 3 * (q1 - q0) - T * (2 * v0 + v1), 2 * (q0 - q1) + T * (v0 + v1)
    assert same(middle.tau, -c2 / (3 * c3))
    assert same(middle.value, (v0 * T - c2**2 / (3 * c3)) / T)
    assert "if" in middle.explain()


def test_from_rest_to_rest_the_bound_is_a_condition_on_the_duration():
    f = polynomial_formula((0, 0), (D, 0), T)
    condition = bounded_if(f, "V")
    assert bool(condition.subs({D: 2, V: 3, T: 1.0}))  # 3/2 Δ/T = 3
    assert not bool(condition.subs({D: 2, V: 2.9, T: 1.0}))
    assert bool(bounded_if(f, A, order=2).subs({D: 2, A: 12, T: 1.0}))


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("order", [1, 2])
def test_the_condition_holds_where_the_numbers_keep_the_bound(seed, order):
    rng = np.random.default_rng(seed)
    data = dict(zip((q0, q1, v0, v1), rng.uniform(-2, 2, 4).tolist(), strict=True)) | {T: float(rng.uniform(0.5, 3))}
    peak = abs(r1.cubic(data[q0], data[q1], data[T], data[v0], data[v1]).peak(order).value)
    condition = bounded_if(polynomial_formula((q0, v0), (q1, v1), T), "V", order)
    assert bool(condition.subs({**data, V: peak * 1.0001}))
    assert not bool(condition.subs({**data, V: peak * 0.9999}))


def test_a_polynomial_of_high_degree_with_free_data_is_refused_and_a_quintic_at_rest_is_not():
    found = rate_extremes(polynomial_formula((0, 0, 0), (D, 0, 0), T))
    assert max(float(abs(e.value).subs({D: 1, T: 1})) for e in found) == pytest.approx(15 / 8)
    a0, a1 = sympy.symbols("a0 a1", real=True)
    with pytest.raises(r1.FormulaError, match="degree 3"):
        rate_extremes(polynomial_formula((q0, v0, a0), (q1, v1, a1), T))
    with pytest.raises(r1.InputError, match="polynomial_formula"):
        rate_extremes(3)


@pytest.mark.parametrize(
    "call",
    [
        lambda: time_formula("cubic", distance=None, velocity="V"),
        lambda: rate_extremes(polynomial_formula((q0, v0), (q1, v1), T), 10**9),
        lambda: bounded_if(polynomial_formula((q0, v0), (q1, v1), T), [1, 2]),
        lambda: bounded_if(polynomial_formula((q0, v0), (q1, v1), T), "2V"),
        lambda: r1.trajectories.motion_of_accelerations(0, [[1, 2], [3]], [1, 2]),
        lambda: r1.trajectories.motion_of_jerks(0, [], []),
        lambda: r1.textbook_robots.joint_map(["q1"], joints="two"),
        lambda: r1.orientation.recognise_sequence(r1.orientation.euler_formulas("ZYZ").rotation, angles=3),
    ],
)
def test_junk_is_an_input_error(call):
    with pytest.raises(r1.InputError):
        call()


# --- with velocities at the ends

ENDS = {"velocity": "V", "acceleration": "A", "v0": "v0", "v1": "v1"}
V0, V1 = sympy.symbols("v0 v1", real=True)


def test_with_velocities_at_the_ends_one_condition_decides_whether_the_goal_is_passed():
    f = time_formula("trapezoidal", **ENDS)
    cruise, triangle, back = f.cases
    assert same(cruise.duration, (V - V0) / A + (V - V1) / A + (D - (2 * V**2 - V0**2 - V1**2) / (2 * A)) / V)
    assert same(cruise.conditions[0].rhs, (2 * V**2 - V0**2 - V1**2) / (2 * A))
    peak = sympy.sqrt(A * D + (V0**2 + V1**2) / 2)
    assert same(triangle.duration, (2 * peak - V0 - V1) / A)
    assert same(triangle.times[0], (peak - V0) / A)
    assert back.conditions == (sympy.Lt(D, sympy.Abs(V1 - V0) * (V0 + V1) / (2 * A)),)
    assert same(back.duration, (2 * sympy.sqrt((V0**2 + V1**2) / 2 - A * D) + V0 + V1) / A)
    assert [f"{s}" for s in f.of_joints(2).free_symbols if "v0" in str(s)] != []


@pytest.mark.parametrize("seed", core_first(range(6), [0], 1))
def test_the_formula_with_velocities_at_the_ends_is_the_least_time_in_numbers(seed):
    rng = np.random.default_rng(seed)
    f = time_formula("trapezoidal", **ENDS)
    seen = set()
    for _ in range(40):
        d, v, a = np.exp(rng.uniform(-2, 2, 3))
        v0, v1 = v * rng.uniform(-1, 1, 2)
        case = f.case_of(Delta=d, V=v, A=a, v0=v0, v1=v1)
        law = r1.minimum_time([0], [d], r1.MotionLimits(velocity=v, acceleration=a), v0=v0, v1=v1)
        assert case.duration == pytest.approx(law.duration, rel=1e-9)
        assert law.laws[0].breakpoints == pytest.approx(np.array(case.times), abs=1e-6 * case.duration)
        seen.add(case.name)
    assert seen == {"trapezoidal", "triangular", "past the goal and back"}


def test_a_joint_that_is_too_fast_to_stop_by_hand():
    """From 2 m/s with 1 m/s²: it stands after 2 m, 1 m beyond the goal, and comes back in 2 s: T = 4 s."""
    f = time_formula("trapezoidal", acceleration="A", v0="v0")
    assert f.case_of(Delta=1, A=1, v0=2).duration == pytest.approx(2 + 2)
    assert f.case_of(Delta=1, A=1, v0=2).name == "past the goal and back"
    assert same(time_formula("trapezoidal", acceleration="A", v0=0, v1=0).duration, 2 * sympy.sqrt(D / A))


@pytest.mark.parametrize(
    ("law", "options", "words"),
    [
        ("trapezoidal", {"acceleration": "A", "deceleration": "B", "v0": 1}, "one bound of the acceleration"),
        ("trapezoidal", {"acceleration": "A", "velocity": 1, "v0": 2}, "must be within ±1"),
        ("trapezoidal", {"acceleration": "A", "velocity": "V", "v0": "V"}, "give it another name"),
        ("trapezoidal", {"acceleration": "A", "v0": [1]}, "v0 must be a finite number"),
        ("trapezoidal", {"acceleration": "A", "v0": "2x"}, "v0 must be a name"),
    ],
)
def test_velocities_that_are_none_say_what_would_be_right(law, options, words):
    with pytest.raises(r1.InputError, match=words):
        time_formula(law, **options)
