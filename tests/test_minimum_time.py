"""Minimum time under bounds: closed forms, bounds respected and touched, and that no shorter time will do."""

from math import cbrt, inf, nan, pi, sqrt

import numpy as np
import pytest
from hypothesis import assume, given, strategies as st
from motions import JERK_FREE, MOVING, bound, distance, limits_of, share
from scipy.optimize import linprog

import robotics1 as r1

near_or_far = distance | st.sampled_from([0.0, 1e-17, -3e-13, 1e-6])
# Of each shape from rest to rest: |q̇| = c₁Δ/T, |q̈| = c₂Δ/T², |d³q/dt³| = c₃Δ/T³.
SHAPES = {
    "cubic": (3 / 2, 6, 12),
    "quintic": (15 / 8, 10 / sqrt(3), 60),
    "septic": (35 / 16, 84 * sqrt(5) / 25, 105 / 2),
    "cosine": (pi / 2, pi**2 / 2, pi**3 / 2),
    "cycloidal": (2, 2 * pi, 4 * pi**2),
}


def ratios(motion, V, A, J):
    """How much of each bound is used."""
    bounds = enumerate((V, A, J), start=1)
    return [np.abs(motion.extremes(order)[1]).max() / bound for order, bound in bounds if bound < inf]


# --- closed forms


@given(distance, bound, bound)
def test_trapezoid_takes_delta_over_v_plus_v_over_a_or_twice_root_delta_over_a(delta, V, A):
    answer = r1.minimum_time(0.3, 0.3 + delta, r1.MotionLimits(V, A))
    d = abs(delta)
    cruises = d >= V**2 / A
    assert answer.duration == pytest.approx(d / V + V / A if cruises else 2 * sqrt(d / A), rel=1e-12)
    law = answer.laws[0]
    assert law.cruise_time == pytest.approx(max(0, d / V - V / A), abs=1e-12)
    assert abs(law.peak(1).value) == pytest.approx(V if cruises else sqrt(d * A), rel=1e-12)
    touches = sqrt(d * A) >= (1 - 1e-6) * V  # also at the tip of a triangle
    assert {demand.quantity for demand in answer.active} == {"acceleration"} | ({"velocity"} if touches else set())


@given(distance, bound, bound, bound)
def test_double_s_takes_delta_over_v_plus_v_over_a_plus_a_over_j(delta, V, A, J):
    answer = r1.minimum_time(0, delta, r1.MotionLimits(V, A, J), "double_s")
    d = abs(delta)
    ramp = V / A + A / J if V >= A**2 / J else 2 * sqrt(V / J)
    if d >= V * ramp:
        wanted = d / V + ramp
    elif d >= 2 * A**3 / J**2:
        wanted = A / J + sqrt((A / J) ** 2 + 4 * d / A)
    else:
        wanted = cbrt(32 * d / J)
    assert answer.duration == pytest.approx(wanted, rel=1e-9)
    assert answer.laws[0](answer.duration) == pytest.approx(delta, abs=1e-9)


@pytest.mark.parametrize("kind", sorted(SHAPES))
@given(d=distance, V=bound, A=bound, J=bound)
def test_a_shape_takes_the_largest_of_the_three_roots(kind, d, V, A, J):
    c1, c2, c3 = (c * abs(d) for c in SHAPES[kind])
    needed = {"velocity": c1 / V, "acceleration": sqrt(c2 / A), "jerk": cbrt(c3 / J)}
    answer = r1.minimum_time(0, d, r1.MotionLimits(V, A, J), kind)
    assert answer.duration == pytest.approx(max(needed.values()), rel=1e-9)
    slowest = max(needed, key=needed.get)
    assert slowest in {demand.quantity for demand in answer.active}
    for demand in answer.active:
        assert needed[demand.quantity] == pytest.approx(answer.duration, rel=1e-5)


def test_bang_bang_takes_twice_root_delta_over_a_or_2_delta_over_v():
    assert r1.minimum_time(0, 1, r1.MotionLimits(acceleration=4), "bang_bang").duration == pytest.approx(1)
    assert r1.minimum_time(0, 1, r1.MotionLimits(1.6, 4), "bang_bang").duration == pytest.approx(2 / 1.6)


@given(distance, bound, bound, bound)
def test_unequal_acceleration_and_deceleration(delta, V, A, D):
    """Δ/V + V/2A + V/2D with a cruise, else √(2Δ (A + D)/AD)."""
    answer = r1.minimum_time(0, delta, r1.MotionLimits(V, A, deceleration=D))
    d = abs(delta)
    cruises = d >= V**2 / 2 * (1 / A + 1 / D)
    wanted = d / V + V / (2 * A) + V / (2 * D) if cruises else sqrt(2 * d * (A + D) / (A * D))
    assert answer.duration == pytest.approx(wanted, rel=1e-12)
    active = {demand.quantity: abs(demand.value) for demand in answer.active}
    assert active["acceleration"] == pytest.approx(A)
    assert active["deceleration"] == pytest.approx(D)
    touches = sqrt(2 * d * A * D / (A + D)) >= (1 - 1e-6) * V  # also at the tip of a triangle
    assert ("velocity" in active) == touches


# --- velocities at the ends


def test_a_start_away_from_the_goal_brakes_turns_and_comes_back():
    """v0 = −1, A = 1: half a metre of braking in 1 s, then 1.5 m from rest in 2√1.5 s."""
    answer = r1.minimum_time(0, 1, r1.MotionLimits(acceleration=1), v0=-1)
    assert answer.duration == pytest.approx(1 + 2 * sqrt(1.5), rel=1e-12)
    law = answer.laws[0]
    assert law(1) == pytest.approx(-0.5)
    assert law.velocity(1) == pytest.approx(0, abs=1e-12)
    assert law.breakpoints == pytest.approx([1 + sqrt(1.5)])


@pytest.mark.parametrize("law", ["trapezoidal", "double_s"])
@given(bound, bound, bound, st.sampled_from([-1.0, -0.5, 0.5, 1.0]), st.sampled_from([-1.0, -0.7, 0.7, 1.0]))
def test_a_distance_that_one_ramp_covers_takes_the_time_of_that_ramp(law, V, A, J, x0, x1):
    """Also away from the goal at the largest speed, from where a turn and another have the same distance."""
    limits, v0, v1 = r1.MotionLimits(V, A, J if law == "double_s" else None), x0 * V, x1 * V
    rise, jerk = abs(v1 - v0), J if law == "double_s" else inf
    T = rise / A + A / jerk if rise >= A**2 / jerk else 2 * sqrt(rise / J)
    T = T if rise else 0.0
    q1 = (v0 + v1) / 2 * T
    assume(x0 * x1 > 0)
    assert r1.minimum_time(0.0, q1, limits, law, v0=v0, v1=v1).duration == pytest.approx(T, rel=1e-6, abs=1e-12)


def test_a_bang_bang_from_v_to_v_goes_straight_on():
    answer = r1.minimum_time(0, 2, r1.MotionLimits(0.5, 1), "bang_bang", v0=0.5, v1=0.5)
    assert answer.duration == pytest.approx(4)
    assert [demand.quantity for demand in answer.active] == ["velocity"]


def test_a_start_too_fast_to_stop_passes_the_goal_and_returns():
    """v0 = 2, A = 1: it stops 2 m on, and comes 1 m back."""
    answer = r1.minimum_time(0, 1, r1.MotionLimits(acceleration=1), v0=2)
    assert answer.duration == pytest.approx(2 + 2, rel=1e-12)
    assert answer.trajectory.extremes()[1][:, 0] == pytest.approx([0, 2])


def test_braking_uses_the_deceleration_and_turning_the_acceleration():
    """v0 = −1, D = 2: 0.25 m in 0.5 s; then A = 1 and D = 2 over 1.25 m: √(2·1.25·3/2)."""
    answer = r1.minimum_time(0, 1, r1.MotionLimits(acceleration=1, deceleration=2), v0=-1)
    assert answer.duration == pytest.approx(0.5 + sqrt(3.75), rel=1e-12)
    assert answer.trajectory.acceleration([0.25, 0.75])[:, 0] == pytest.approx([2, 1])
    active = [(demand.quantity, demand.value, demand.time) for demand in answer.active]
    assert active == [("acceleration", pytest.approx(1), pytest.approx(0.5)), ("deceleration", pytest.approx(2), 0.0)]


@given(d=distance, V=bound, A=bound, D=bound, x0=share, x1=share)
def test_unequal_bounds_between_velocities_are_kept(d, V, A, D, x0, x1):
    """No touched bound is passed, not even where a phase has no duration but for rounding."""
    limits = r1.MotionLimits(V, A, deceleration=D)
    answer = r1.minimum_time(0, d, limits, v0=x0 * V, v1=x1 * V)
    assert answer.active
    assert all(abs(demand.value) <= demand.limit * (1 + 1e-9) for demand in answer.active)
    assert answer.trajectory(answer.duration) == pytest.approx([d], abs=1e-9)


@pytest.mark.parametrize(
    ("d", "V", "A", "D", "v0"), [(0.9, 0.7, 0.8, 2.4, 0), (-1, 1.1, 1.6, 2.7, 0), (-0.2, 2.9, 0.6, 1.5, 1.2)]
)
def test_a_phase_that_passes_rest_only_by_rounding_is_no_acceleration(d, V, A, D, v0):
    answer = r1.minimum_time(0, d, r1.MotionLimits(V, A, deceleration=D), v0=v0)
    used = {demand.quantity: abs(demand.value) for demand in answer.active if demand.quantity != "velocity"}
    assert used == pytest.approx({"acceleration": A, "deceleration": D})


@pytest.mark.parametrize("kind", MOVING)
@given(d=near_or_far, V=bound, A=bound, J=bound, x0=share, x1=share)
def test_bounds_are_kept_and_one_is_touched(kind, d, V, A, J, x0, x1):
    v0, v1 = x0 * V, x1 * V
    assume(d != 0 or v0 != v1)
    if kind == "septic":  # from V to V, and far from V T, it would have to reach −19/16 V
        v0, v1 = v0 / 2, v1 / 2
    answer = r1.minimum_time(0, d, limits_of(kind, V, A, J), kind, v0=v0, v1=v1)
    motion, T = answer.trajectory, answer.duration
    used = ratios(motion, V, A, inf if kind in JERK_FREE else J)
    assert max(used) <= 1 + 1e-8
    if abs(d) > 1e-3:  # else a rounding of T or of the velocity may be more than the bounds leave
        assert max(used) >= 1 - 1e-8
        assert answer.active
    assert motion([0, T])[:, 0] == pytest.approx([0, d], abs=1e-9)
    assert motion.velocity([0, T])[:, 0] == pytest.approx([v0, v1], abs=1e-9)


@pytest.mark.parametrize("kind", ["trapezoidal", "double_s"])
@given(size=st.floats(-16, -3), V=bound, A=bound, J=bound, x=share)
def test_a_distance_for_which_the_velocity_hardly_changes_is_not_missed(kind, size, V, A, J, x):
    """From v to the same v: a double-S over 1e-6 m changes v by 1e-14, where rounding v is 1 % of it."""
    d = 10**size
    answer = r1.minimum_time(0, d, limits_of(kind, V, A, J), kind, v0=x * V, v1=x * V)
    assert answer.trajectory(answer.duration) == pytest.approx([d], rel=1e-6, abs=1e-14 * answer.duration)


@pytest.mark.parametrize("kind", ["cubic", "quintic", "bang_bang"])
@given(d=distance, V=bound, A=bound, J=bound, x0=share.filter(lambda x: abs(x) < 1), x1=share)
def test_a_shorter_polynomial_or_bang_bang_violates_a_bound(kind, d, V, A, J, x0, x1):
    v0, v1 = x0 * V, x1 * V
    J = inf if kind in JERK_FREE else J
    T = r1.minimum_time(0, d, r1.MotionLimits(V, A, J), kind, v0=v0, v1=v1).duration
    motion_of = {"cubic": r1.cubic, "quintic": r1.quintic, "bang_bang": r1.trajectories.bang_bang}[kind]
    for shorter in T * np.concatenate([np.linspace(0.02, 0.98, 25), 1 - np.geomspace(1e-6, 1e-2, 5)]):
        assert max(ratios(motion_of([0], [d], shorter, v0, v1), V, A, J)) > 1


@pytest.mark.parametrize(("limits", "v0", "v1"), [((1.5, 1, 1), 0.75, 0), ((1, 1, 0.5), 0.5, 0.25)])
def test_a_bound_that_is_met_at_one_duration_alone_asks_for_no_longer_one(limits, v0, v1):
    """On the way to the least T the jerk at an end is ±J at one T, and inside for longer ones."""
    T = r1.minimum_time(0, 0.5, r1.MotionLimits(*limits), "quintic", v0=v0, v1=v1).duration
    J0, J1 = ((60 * 0.5 - 36 * a * T - 24 * b * T) / T**3 for a, b in ((v0, v1), (v1, v0)))
    assert max(abs(J0), abs(J1)) == pytest.approx(limits[2], rel=1e-9)


def test_no_bang_bang_comes_back_at_the_bound_it_went_away_with():
    """From V to V over −Δ: the velocity at the switch is −V − 2Δ/T, beyond −V for any T."""
    with pytest.raises(r1.InputError, match="'trapezoidal' does"):
        r1.minimum_time(0, -1, r1.MotionLimits(1, 1), "bang_bang", v0=1, v1=1)


@pytest.mark.parametrize("kind", ["cubic", "quintic", "septic"])
def test_a_velocity_that_is_a_rounding_asks_for_no_time_below_1e_30_s(kind):
    assert r1.minimum_time(0, 0, r1.MotionLimits(1, 1, 1), kind, v1=1e-281).duration == pytest.approx(1e-30)


@pytest.mark.parametrize(("d", "v"), [(-3e-13, -0.125), (1e-6, 1.5)])
def test_a_jerk_that_is_rounding_alone_is_no_cubic_but_no_error_either(d, v):
    """From v to v over v T the motion is steady, and the jerk of the septic is rounding divided by T³."""
    answer = r1.minimum_time(0, d, r1.MotionLimits(3, 1, 1), "septic", v0=v, v1=v)
    assert max(ratios(answer.trajectory, 3, 1, 1)) <= 1 + 1e-8


def test_phases_shorter_than_the_rounding_of_t_pass_no_bound():
    """V/D = 4e-12 s at the end of 6.7e5 s: no velocity is told that the piece has not inside its own duration."""
    V, A, D = 1.6574e-06, 222280.0, 42.2
    answer = r1.minimum_time(0, -1.1185, r1.MotionLimits(V, A, deceleration=D), v0=V, v1=V / 2)
    law = answer.laws[0]
    t = np.concatenate([np.linspace(0, answer.duration, 101), law.breakpoints])
    assert np.abs(law.velocity(t)).max() <= V * (1 + 1e-9)


def test_a_small_jump_beside_a_large_one_is_a_switching_time():
    """A/D = 1e-11: the acceleration ends by a jump of its own size, not of the deceleration's."""
    V, A, D = 0.1, 1e-6, 1e5
    answer = r1.minimum_time(0, 25000, r1.MotionLimits(V, A, deceleration=D))
    assert answer.laws[0].breakpoints[0] == pytest.approx(V / A)
    assert {demand.quantity for demand in answer.active} >= {"velocity", "acceleration"}


def least_use(T, d, ends, bounds, steps=40):
    """The least k for which a motion of duration T has |q̇| ≤ V, |q̈| ≤ A and |d³q/dt³| ≤ k J (or |q̈| ≤ k A, if J is
    infinite), as a linear program in a piecewise constant control: at rest in acceleration at both ends."""
    (v0, v1), (V, A, J) = ends, bounds
    h, order = T / steps, 2 if J == inf else 3
    state, rows = np.zeros((order, steps)), []
    for i in range(steps):
        control = np.eye(steps)[i]
        if order == 2:
            state = np.array([state[0] + h * state[1] + h**2 / 2 * control, state[1] + h * control])
        else:
            q, v, a = state
            state = np.array(
                [q + h * v + h**2 / 2 * a + h**3 / 6 * control, v + h * a + h**2 / 2 * control, a + h * control]
            )
        rows.append(state)
    limited = [(row[1], V - v0, V + v0) for row in rows] + [(row[2], A, A) for row in rows if order == 3]
    upper = [(np.append(f, 0), most) for f, most, _ in limited] + [(np.append(-f, 0), most) for f, _, most in limited]
    strongest = A if order == 2 else J
    upper += [(np.append(sign * u, -strongest), 0) for u in np.eye(steps) for sign in (1, -1)]
    A_ub, b_ub = (np.array(part) for part in zip(*upper, strict=True))
    b_eq = [d - v0 * T, v1 - v0, 0][:order]
    A_eq = np.hstack([rows[-1], np.zeros((order, 1))])
    cost = np.append(np.zeros(steps), 1.0)
    found = linprog(cost, A_ub, b_ub, A_eq, b_eq, bounds=[(None, None)] * steps + [(0, None)])
    return found.fun if found.success else inf


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("kind", ["trapezoidal", "double_s"])
def test_no_motion_at_all_is_faster_than_the_profiles(kind, seed):
    """With 5 % less time the linear program over all motions needs more than the bound, with 6 % more it does not."""
    rng = np.random.default_rng(seed)
    V, A, J = rng.uniform(0.5, 2), rng.uniform(0.5, 3), rng.uniform(1, 8) if kind == "double_s" else inf
    ends = rng.uniform(-0.95, 0.95, 2) * V
    d = rng.uniform(-3, 3)
    T = r1.minimum_time(0, d, limits_of(kind, V, A, J), kind, v0=ends[0], v1=ends[1]).duration
    assert least_use(0.95 * T, d, ends, (V, A, J)) > 1
    assert least_use(1.06 * T, d, ends, (V, A, J)) <= 1


# --- misuse


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((0, 1, r1.MotionLimits(1)), {}, "needs a bound on the acceleration"),
        ((0, 1, r1.MotionLimits(1, 1, 1)), {}, "'double_s' has one"),
        ((0, 1, r1.MotionLimits(1, 1, 1), "bang_bang"), {}, "'double_s' has one"),
        ((0, 1, r1.MotionLimits(1, 1)), {"law": "double_s"}, "needs a bound on the jerk"),
        ((0, 1, r1.MotionLimits(1, 1, 1, 2)), {"law": "double_s"}, "same bound"),
        ((0, 1, r1.MotionLimits(1, 1, deceleration=2)), {"law": "cubic"}, "'trapezoidal' brakes with another"),
        ((0, 1, r1.MotionLimits(1, 1, deceleration=2)), {"law": "bang_bang"}, "'trapezoidal' brakes with another"),
        ((0, 1, r1.MotionLimits()), {"law": "cubic"}, "bound"),
        ((0, 1, r1.MotionLimits(1, 1)), {"v0": 1.5}, "v0 of joint 0 is 1.5, beyond its bound 1"),
        (([0, 0], [1, 1], r1.MotionLimits([1, 2], 1)), {"v1": [0, -2.5]}, "v1 of joint 1 is -2.5"),
        ((0, 1, r1.MotionLimits(1, 1)), {"law": "cosine", "v0": 0.5}, "begins and ends at rest"),
        ((0, 1, r1.MotionLimits(1, 1)), {"coordination": "straight", "v0": 0.5}, "from rest to rest"),
        ((0, 1, r1.MotionLimits(1, 1)), {"law": "linear"}, "one of 'trapezoidal'"),
        ((0, 1, r1.MotionLimits(1, 1)), {"coordination": "fast"}, "one of 'synchronized'"),
        (([0, 0], [1], r1.MotionLimits(1, 1)), {}, "shape"),
        (([0, 0], [1, 1], r1.MotionLimits([1, 1, 1], 1)), {}, "shape"),
        ((0, 1, (1, 1)), {}, "must be MotionLimits"),
        ((0, nan, r1.MotionLimits(1, 1)), {}, "finite"),
        (([], [], r1.MotionLimits(1, 1)), {}, "joint"),
    ],
)
def test_misuse_of_minimum_time_is_an_input_error_that_says_what_would_be_right(arguments, options, message):
    with pytest.raises(r1.InputError, match=message):
        r1.minimum_time(*arguments, **options)


@pytest.mark.parametrize("value", [0, -1, nan, -inf, "fast", [1, 0], [[1]], [], 1j, {}])
@pytest.mark.parametrize("name", ["velocity", "acceleration", "jerk", "deceleration"])
def test_bounds_that_are_not_positive_are_input_errors(name, value):
    with pytest.raises(r1.InputError, match=f"the bound on the {name}"):
        r1.MotionLimits(**{"acceleration": 1, name: value})


def test_a_deceleration_alone_is_an_input_error():
    with pytest.raises(r1.InputError, match="needs one on the acceleration"):
        r1.MotionLimits(deceleration=1)


@pytest.mark.parametrize(
    ("law", "a", "c", "b"), [("cubic", 3, 2, 1), ("quintic", 5, 3, 2), ("septic", 7, 4, 3)], ids=["3", "5", "7"]
)
@given(share=st.floats(-0.5, 0.99), V=st.floats(0.01, 100), d=st.floats(0.01, 100), mirrored=st.booleans())
def test_from_the_bound_V_the_first_derivative_that_is_not_zero_must_lead_back(law, a, c, b, share, V, d, mirrored):
    """At v0 = V the velocity may only touch V: q̈(0) = 0 gives a cubic 6Δ = (4V + 2v1) T, d³q/dt³(0) = 0 a quintic
    60Δ = (36V + 24v1) T, and d⁴q/dt⁴(0) = 0 a septic 35Δ = (20V + 15v1) T.
    """
    ends = {"v0": share * V, "v1": V} if mirrored else {"v0": V, "v1": share * V}
    found = r1.minimum_time(0, d, r1.MotionLimits(velocity=V), law, **ends)
    assert found.duration == pytest.approx(a * d / ((c + b * share) * V), rel=1e-10)
