"""A path with a timing law: derivatives, sides, peaks, bounds; trajectories in a row; passing over points."""

from math import cos, pi, sin, sqrt

import numpy as np
import pinocchio as pin
import pytest
import sympy
from hypothesis import given, strategies as st
from test_paths import PATHS, rate

import robotics1 as r1
from robotics1 import InputError


def law_to(end, duration=2.0, start=0.0):
    """A cubic law from rest to rest."""
    return r1.cubic([start], [end], duration).joint(0)


def pieces_of_tau(*pieces):
    """A law of polynomials of τ = (t − tᵢ)/T, with ascending coefficients, each given with its T."""
    return r1.curves.PiecewisePolynomial.from_pieces(pieces)


def trapezoid(end, ramp, cruise):
    """Accelerate for `ramp`, cruise, decelerate."""
    v = end / (ramp + cruise)
    up, down = v * ramp / 2, v * ramp / 2
    return pieces_of_tau(([0, 0, up], ramp), ([up, v * cruise], cruise), ([end - down, v * ramp, -down], ramp))


def linear(points, times):
    """A law that is straight from value to value: ṡ jumps."""
    return pieces_of_tau(*(([a, b - a], T) for a, b, T in zip(points, points[1:], np.diff(times), strict=False)))


MOTIONS = {name: r1.curves.PathTrajectory(path, law_to(path.end)) for name, path in PATHS.items()}


@pytest.mark.parametrize("name", MOTIONS)
def test_velocity_acceleration_and_jerk_are_the_derivatives(name):
    motion = MOTIONS[name]
    ends = np.array([0, *motion.breakpoints, motion.duration])
    t = np.array([x for x in np.linspace(0.05, 1.95, 9) if np.abs(ends - x).min() > 5e-3])
    for f, g in [(motion, motion.velocity), (motion.velocity, motion.acceleration), (motion.acceleration, motion.jerk)]:
        assert g(t) == pytest.approx(rate(f, t, 4e-4), abs=2e-7 * (1 + np.abs(g(t)).max()))
    assert motion(float(t[0])) == pytest.approx(motion(t)[0])
    assert motion.velocity(float(t[0])) == pytest.approx(motion.velocity(t)[0])
    assert motion(t).shape == (len(t), PATHS[name].dimension)


@given(st.floats(0, 2))
def test_speed_by_the_arc_length_is_the_laws_and_normal_acceleration_is_kappa_v2(t):
    for name in ("circle", "helix", "line"):
        motion, path = MOTIONS[name], PATHS[name]
        sdot, sddot, kappa = motion.law.velocity(t), motion.law.acceleration(t), path.curvature(motion.law(t))
        parts = r1.trajectories.acceleration_split(motion, t)
        assert np.linalg.norm(motion.velocity(t)) == pytest.approx(abs(sdot), abs=1e-12)
        assert np.linalg.norm(parts.normal) == pytest.approx(kappa * sdot**2, abs=1e-9)
        assert np.linalg.norm(parts.tangential) == pytest.approx(abs(sddot), abs=1e-9)
        assert parts.tangential + parts.normal == pytest.approx(motion.acceleration(t), abs=1e-12)


def test_at_rest_the_acceleration_is_tangential():
    parts = r1.trajectories.acceleration_split(MOTIONS["circle"], np.array([0.0, 2.0]))
    assert parts.tangential == pytest.approx(MOTIONS["circle"].acceleration(np.array([0.0, 2.0])))
    assert not parts.normal.any()


# --- sides


def test_at_a_corner_the_velocity_is_told_from_the_side_that_is_asked():
    path = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]])
    motion = r1.curves.PathTrajectory(path, linear([0, 2], [0, 4]))
    assert motion.breakpoints == pytest.approx([2.0])
    assert motion.velocity(2.0) == pytest.approx([0, 0.5])
    assert motion.velocity(2.0, side="left") == pytest.approx([0.5, 0])
    back = r1.curves.PathTrajectory(path, linear([2, 0], [0, 4]))
    assert back.velocity(2.0) == pytest.approx([-0.5, 0])
    assert back.velocity(2.0, side="left") == pytest.approx([0, -0.5])
    several = np.array([1.0, 2.0, 3.0])
    assert back.velocity(several) == pytest.approx(np.array([[0, -0.5], [-0.5, 0], [-0.5, 0]]))


def test_a_stop_at_a_corner_accelerates_along_the_next_segment_and_a_return_along_the_same():
    path = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]])
    there = r1.curves.PathTrajectory(path, pieces_of_tau(([0, 2, -1], 1), ([1, 0, 1], 1)))
    assert there.acceleration(1.0) == pytest.approx([0, 2])
    assert there.acceleration(1.0, side="left") == pytest.approx([-2, 0])
    home = r1.curves.PathTrajectory(path, pieces_of_tau(([0, 2, -1], 1), ([1, 0, -1], 1)))
    assert home.acceleration(1.0) == pytest.approx([-2, 0])
    assert home.acceleration(1.0, side="left") == pytest.approx([-2, 0])
    assert home.jerk(1.0) == pytest.approx([0, 0])


def test_at_the_end_of_a_motion_that_ends_on_a_corner_the_values_are_those_before_it():
    path = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]])
    motion = r1.curves.PathTrajectory(path, linear([0, 1], [0, 2]))
    assert motion.velocity(2.0) == pytest.approx([0.5, 0])
    onward = r1.curves.PathTrajectory(path, linear([1, 2], [0, 2]))
    assert onward.velocity(0.0) == pytest.approx([0, 0.5])
    assert onward.velocity(0.0, side="left") == pytest.approx([0, 0.5])


def test_switching_times_are_the_laws_and_where_the_path_has_a_break():
    path = PATHS["polyline"]
    law = trapezoid(path.end, 0.4, 1.2)
    motion = r1.curves.PathTrajectory(path, law)
    times = motion.breakpoints
    assert len(times) == 2 + len(path.breakpoints)
    assert set(law.breakpoints) <= set(times)
    crossing = np.setdiff1d(times, law.breakpoints)
    assert law(crossing) == pytest.approx(path.breakpoints, abs=1e-12)
    jumps = [np.abs(motion.acceleration(t) - motion.acceleration(t, side="left")).max() for t in times]
    assert min(jumps) > 1e-3
    for t in times:
        assert motion.acceleration(t) == pytest.approx(motion.acceleration(t + 1e-9), rel=1e-5, abs=1e-5)
        assert motion.acceleration(t, side="left") == pytest.approx(motion.acceleration(t - 1e-9), rel=1e-5, abs=1e-5)


# --- peaks


@pytest.mark.parametrize("name", MOTIONS)
@pytest.mark.parametrize("quantity", ["velocity", "acceleration", "normal acceleration", "tangential acceleration"])
def test_peak_of_a_norm_is_not_below_any_sample_and_is_reached(name, quantity):
    motion = MOTIONS[name]
    peak = r1.trajectories.peak_norm(motion, quantity)
    t = np.unique(np.concatenate([np.linspace(0, 2, 4001), motion.breakpoints]))

    def norms(side):
        kind, _, of = quantity.rpartition(" ")
        split = r1.trajectories.acceleration_split(motion, t, side=side)
        vectors = getattr(split, kind) if kind else getattr(motion, of)(t, side=side)
        return np.linalg.norm(vectors, axis=1)

    most = max(norms("right").max(), norms("left").max())
    assert peak.value >= most * (1 - 1e-9) - 1e-12
    assert peak.value == pytest.approx(most, rel=1e-4, abs=1e-9)


def test_peaks_on_a_circle_with_a_trapezoid_are_v_v2_over_r_and_their_root_at_the_end_of_the_ramp():
    r, ramp = 0.5, 0.4
    path = r1.curves.circle_path([0, 0, 0], r)
    law = trapezoid(path.end, ramp, 1.2)
    v, a = path.end / 1.6, path.end / 1.6 / ramp
    motion = r1.curves.PathTrajectory(path, law)
    assert r1.trajectories.peak_norm(motion).value == pytest.approx(v)
    assert r1.trajectories.peak_norm(motion, "normal acceleration").value == pytest.approx(v**2 / r)
    assert r1.trajectories.peak_norm(motion, "tangential acceleration").value == pytest.approx(a)
    total = r1.trajectories.peak_norm(motion, "acceleration")
    assert total.value == pytest.approx(sqrt(a**2 + (v**2 / r) ** 2))
    assert total.time == pytest.approx(ramp)
    assert total.resolved


def test_peak_acceleration_of_a_cubic_on_a_circle_is_a_root_of_a_polynomial():
    r, T, L = 0.5, 2.0, 3.0
    motion = r1.curves.PathTrajectory(r1.curves.arc_path([0, 0], [r, 0], L / r), law_to(L, T))
    v = np.polynomial.Polynomial([0, 6 * L / T**2, -6 * L / T**3])  # ṡ; |p̈|² = s̈² + ṡ⁴/r²
    square = v.deriv() ** 2 + v**4 / r**2
    roots = [x.real for x in square.deriv().roots() if abs(x.imag) < 1e-9 and 0 <= x.real <= T]
    best = max([0.0, T, *roots], key=square)
    peak = r1.trajectories.peak_norm(motion, "acceleration")
    assert peak.value == pytest.approx(sqrt(square(best)), rel=1e-12)
    assert square(peak.time) == pytest.approx(square(best), rel=1e-12)


def test_peak_of_some_rows_and_of_joints():
    T0, T1 = np.eye(4), np.eye(4)
    T1[:3, 3] = [3, 4, 0]
    T1[:3, :3] = pin.exp3(np.array([0, 0, 1.0]))
    motion = r1.curves.PathTrajectory(r1.curves.pose_line(T0, T1), law_to(5.0, 3.0))
    assert r1.trajectories.peak_norm(motion, rows=slice(0, 3)).value == pytest.approx(1.5 * 5 / 3)
    assert r1.trajectories.peak_norm(motion, rows=slice(3, 6)).value == pytest.approx(1.5 * 1 / 3)
    joints = r1.cubic([0, 0], [3, 4], 2.0)
    assert r1.trajectories.peak_norm(joints).value == pytest.approx(1.5 * 5 / 2)
    assert r1.trajectories.peak_norm(joints, "acceleration").value == pytest.approx(6 * 5 / 4)
    assert r1.trajectories.peak_norm(joints, "jerk").value == pytest.approx(12 * 5 / 8)


# --- bounds of the law from bounds of the motion


@given(st.floats(0.1, 3), st.floats(-1, 1), st.floats(0.1, 2), st.floats(1.05, 5))
def test_timing_bounds_of_a_helix_are_v_and_the_root_of_a2_minus_kappa2_v4(r, h, V, excess):
    kappa = r / (r * r + h * h)
    A = excess * kappa * V**2
    path = r1.curves.helix_path([0, 0, 0], [r, 0, 0], 2 * pi * h, 1.5)
    bounds = r1.trajectories.timing_bounds(path, V, A)
    assert bounds.velocity == pytest.approx(V)
    assert bounds.acceleration == pytest.approx(sqrt(A**2 - (kappa * V**2) ** 2), rel=1e-6)


def test_timing_bounds_keep_the_motion_bounded_and_are_reached_on_any_path():
    for name in ("ellipse", "formula", "spline", "parabolic polyline"):
        path = PATHS[name]
        V = 0.7
        most = max(path.curvature(np.linspace(0, path.end, 20001)))
        A = 1.5 * most * V**2
        bounds = r1.trajectories.timing_bounds(path, V, A)
        places = np.linspace(0, path.end, 20001)
        p1, p2 = path.derivative(places), path.derivative(places, 2)
        v, a = bounds.velocity, bounds.acceleration
        assert np.linalg.norm(p1 * v, axis=1).max() == pytest.approx(V, rel=1e-6)
        worst = max(np.linalg.norm(p2 * v**2 + sign * p1 * a, axis=1).max() for sign in (-1, 1))
        assert worst == pytest.approx(A, rel=1e-4)
        assert worst <= A * (1 + 1e-9)


def test_a_velocity_whose_normal_acceleration_is_too_large_is_refused_with_the_largest_that_is_not():
    path = r1.curves.circle_path([0, 0], 0.5)
    with pytest.raises(InputError, match=r"the normal acceleration is 8 at s = 0, more than 2: .* at most 1"):
        r1.trajectories.timing_bounds(path, 2.0, 2.0)
    assert r1.trajectories.timing_bounds(path, 1.0, 2.0).acceleration == pytest.approx(0, abs=1e-6)


# --- in a row


def test_a_sequence_tells_what_jumps_at_its_joins():
    first, second = r1.cubic([0, 0], [1, 2], 1.0), r1.cubic([1, 2], [0, 0], 2.0)
    moving = r1.cubic([0, 0], [1, 1], 1.0, v0=[0.5, 0])
    motion = r1.curves.CurveSequence((first, second, moving))
    assert motion.duration == 4
    assert motion.breakpoints == pytest.approx([1, 3])
    a, b = motion.joins
    assert a.continuity == 1
    assert a.jumps[2] == pytest.approx(second.acceleration(0.0) - first.acceleration(1.0))
    assert b.continuity == 0
    assert b.jumps[1] == pytest.approx([0.5, 0])
    assert str(b) == "at t = 3 s the velocity jumps by 0.5"
    assert motion.continuity == 0
    t = np.array([0.3, 1.0, 2.5, 3.0, 4.0])
    expected = [first(0.3), second(0.0), second(1.5), moving(0.0), moving(1.0)]
    assert motion(t) == pytest.approx(np.array(expected))
    assert motion.velocity(3.0) == pytest.approx([0.5, 0])
    assert motion.velocity(3.0, side="left") == pytest.approx([0, 0])
    assert motion.acceleration(1.0, side="left") == pytest.approx(first.acceleration(1.0))
    assert motion.jerk(1.0) == pytest.approx(second.jerk(0.0))
    gap = r1.curves.CurveSequence((first, moving), jumps=True)
    assert gap.continuity == -1
    assert gap.joins[0].jumps[0] == pytest.approx([-1, -2])


def test_a_sequence_of_one_law_cut_in_two_is_smooth():
    whole = law_to(3.0)
    halves = []
    for a in (0.0, 1.0):
        c = [[whole(a)], [whole.velocity(a)], [whole.acceleration(a) / 2], [whole.jerk(a) / 6]]
        halves.append(r1.curves.PiecewisePolynomial.from_pieces([(c, 1.0)]))
    motion = r1.curves.CurveSequence(halves)
    assert motion.continuity == 3
    assert str(motion.joins[0]) == "at t = 1 s nothing jumps, up to the jerk"
    t = np.linspace(0, 2, 9)
    assert motion(t)[:, 0] == pytest.approx(whole(t))


def test_poses_in_a_row():
    T = [pin.SE3(pin.exp3(np.array([0, 0, a])), np.array([x, 0, 0])) for a, x in ((0, 0), (1, 1), (1, 2))]
    paths = [r1.curves.pose_line(T[0], T[1]), r1.curves.pose_line(T[1], T[2])]
    motion = r1.curves.CurveSequence([r1.curves.PathTrajectory(path, law_to(path.end)) for path in paths])
    assert motion.continuity == 1
    assert motion(3.0).isApprox(paths[1](0.5), 1e-12)
    assert len(motion([0.0, 4.0])) == 2
    apart = r1.curves.CurveSequence(
        [r1.curves.PathTrajectory(path, law_to(path.end)) for path in (paths[0], paths[0])], jumps=True
    )
    assert apart.joins[0].jumps[0] == pytest.approx([-1, 0, 0, 0, 0, -1])


# --- over points


def test_overfly_leaves_at_v1_t_over_2_before_the_corner_and_accelerates_by_the_difference_over_t():
    A, B, C = np.array([0.0, 0, 0]), np.array([2.0, 0, 0]), np.array([2.0, 3, 0])
    v1, v2, T = 0.5, 1.0, 0.8
    motion = r1.curves.parabolic_blends([A, B, C], [v1, v2], T)
    leaves = 2 / v1 - T / 2
    assert motion.duration == pytest.approx(2 / v1 + 3 / v2)
    assert motion.breakpoints == pytest.approx([leaves, leaves + T])
    assert motion(leaves) == pytest.approx(B - [v1 * T / 2, 0, 0])
    assert motion(leaves + T) == pytest.approx(B + np.array([0, v2 * T / 2, 0]))
    assert motion.velocity(leaves + T / 2) == pytest.approx([v1 / 2, v2 / 2, 0])
    assert motion.acceleration(leaves + 0.1) == pytest.approx([-v1 / T, v2 / T, 0])
    assert motion(motion.duration) == pytest.approx(C)
    middle = motion(leaves + T / 2)
    assert middle - B == pytest.approx([-v1 * T / 8, v2 * T / 8, 0])


def test_overfly_of_many_points_is_c1_and_passes_where_the_blends_do_not_reach():
    points = np.random.default_rng(7).normal(size=(6, 2))
    motion = r1.curves.parabolic_blends(points, 1.0, [0.2, 0.1, 0.15, 0.2])
    for t in motion.breakpoints:
        assert motion(t, side="left") == pytest.approx(motion(t), abs=1e-12)
        assert motion.velocity(t, side="left") == pytest.approx(motion.velocity(t), abs=1e-12)
    assert r1.trajectories.peak_norm(motion).value == pytest.approx(1.0)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert motion.duration == pytest.approx(lengths.sum())
    assert motion(0.9 * lengths[0] - 0.1) == pytest.approx(
        points[0] + (0.9 - 0.1 / lengths[0]) * (points[1] - points[0])
    )


MISUSE = [
    (
        lambda: r1.curves.PathTrajectory(PATHS["line"], law_to(5.1)),
        "stay on the path, 0 ≤ s ≤ 5; it goes from 0 to 5.1",
    ),
    (lambda: r1.curves.PathTrajectory(PATHS["line"], law_to(4, start=-0.5)), "it goes from -0.5 to 4"),
    (lambda: r1.curves.PathTrajectory(PATHS["line"], r1.cubic([0], [4.9], 1.0, v1=-9.0).joint(0)), "stay on the path"),
    (lambda: r1.curves.PathTrajectory(3, law_to(1)), "path must be a path"),
    (lambda: r1.curves.PathTrajectory(PATHS["line"], lambda t: t), "law must be a motion"),
    (lambda: MOTIONS["line"](2.1), r"the parameter must be in \[0, 2\]"),
    (lambda: MOTIONS["line"].velocity(-0.1), r"the parameter must be in \[0, 2\]"),
    (lambda: MOTIONS["line"].velocity(np.nan), "the parameter must be finite"),
    (lambda: MOTIONS["line"].velocity(1.0, side="both"), "side must be one of"),
    (lambda: r1.trajectories.peak_norm(MOTIONS["line"], "speed"), "quantity must be one of"),
    (lambda: r1.trajectories.peak_norm(MOTIONS["line"], rows=3), "rows must be a slice"),
    (lambda: r1.trajectories.timing_bounds(PATHS["line"], 0, 1), "velocity must be a positive number"),
    (lambda: r1.trajectories.timing_bounds("line", 1, 1), "path must be a path"),
    (lambda: r1.curves.CurveSequence(()), "pieces must be one curve or several"),
    (lambda: r1.curves.CurveSequence((MOTIONS["line"], MOTIONS["ellipse"])), "the same coordinates"),
    (lambda: r1.curves.CurveSequence((MOTIONS["line"],))(2.5), r"the parameter must be in \[0, 2\]"),
    (lambda: r1.curves.parabolic_blends([[0, 0], [1, 0]], 1.0, 0.1), "three points at least"),
    (lambda: r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 0]], 1.0, 0.1), "points 1 and 2 are both"),
    (lambda: r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 1]], 1.0, 2.1), "point 1 there is 1, and they need 1.05"),
    (lambda: r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 1]], [1, 0], 0.1), "speeds must be positive"),
    (lambda: r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 1]], 1.0, 0.0), "blend_times must be positive"),
]


@pytest.mark.parametrize(("call", "message"), MISUSE, ids=range(len(MISUSE)))
def test_misuse_of_paths_in_time_is_an_input_error(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_a_path_of_joints_by_a_formula_is_retraced_by_a_law():
    lam = sympy.Symbol("lam")
    A, T = np.array([0.3, -0.5]), 2.0
    path = r1.curves.formula_path([a * (1 - sympy.cos(2 * sympy.pi * lam)) for a in A], lam, 1.0)
    motion = r1.curves.PathTrajectory(path, law_to(1.0, T))
    for t in (0.3, 1.0, 1.6):
        x, v, a = motion.law(t), motion.law.velocity(t), motion.law.acceleration(t)
        assert motion.velocity(t) == pytest.approx(2 * pi * A * sin(2 * pi * x) * v)
        expected = 2 * pi * A * sin(2 * pi * x) * a + 4 * pi**2 * A * cos(2 * pi * x) * v**2
        assert motion.acceleration(t) == pytest.approx(expected)
