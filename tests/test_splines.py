"""Splines through points in time: interpolation, continuity, end conditions, mixed degrees, least curvature."""

from math import inf, nan

import numpy as np
import pytest
from hypothesis import given, strategies as st
from motions import assert_derivatives, dense_peak
from scipy.interpolate import CubicHermiteSpline, CubicSpline

import robotics1 as r1

POINTS = np.array([[0.0, 1.0], [1.0, 2.0], [3.0, -1.0], [2.0, 0.0], [2.5, 0.5]])
TIMES = np.array([0.0, 1.0, 2.5, 4.0, 4.7])
values = st.lists(st.tuples(st.floats(-3, 3), st.floats(-3, 3)), min_size=3, max_size=7).map(np.array)
gaps = st.lists(st.floats(0.2, 2), min_size=6, max_size=6)


def jumps(spline):
    """The jumps of position, velocity and acceleration at the inner knots."""
    t = spline.x[1:-1]
    return [f(t) - f(t, side="left") for f in (spline, spline.velocity, spline.acceleration)]


def assert_smooth_through(spline, points, times, tolerance=1e-9):
    assert spline(times) == pytest.approx(points, abs=tolerance)
    for jump in jumps(spline):
        assert np.abs(jump).max(initial=0) <= tolerance * 100


# --- cubic splines


@given(values, gaps, st.floats(-2, 2), st.floats(-2, 2))
def test_cubic_spline_is_the_dense_linear_system_of_its_conditions(points, steps, v0, a1):
    times = np.concatenate([[0], np.cumsum(steps[: len(points) - 1])])
    spline = r1.cubic_spline(times, points, v0=v0, a1=a1)
    assert_smooth_through(spline, points, times)
    dense = r1.trajectories.polynomial_spline(times, points, [3] * (len(points) - 1), [(0, 1, v0), (-1, 2, a1)])
    t = np.linspace(0, times[-1], 23)
    assert spline(t) == pytest.approx(dense(t), abs=1e-9)
    assert spline.velocity(0) == pytest.approx([v0, v0], abs=1e-9)
    assert spline.acceleration(times[-1]) == pytest.approx([a1, a1], abs=1e-9)


@pytest.mark.parametrize("ends", ["clamped", "natural", "not-a-knot"])
def test_ends_that_are_named(ends):
    spline = r1.cubic_spline(TIMES, POINTS, bc_type=ends)
    scipys = CubicSpline(TIMES, POINTS, bc_type=ends)
    t = np.linspace(0, 4.7, 31)
    for order, f in enumerate((spline, spline.velocity, spline.acceleration)):
        assert f(t) == pytest.approx(scipys(t, order), abs=1e-12)
    last = {"clamped": spline.velocity, "natural": spline.acceleration}.get(ends)
    if last:
        assert last([0, 4.7]) == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    else:
        assert spline.breakpoints == pytest.approx(TIMES[2:3])  # at the others even the jerk is continuous
    assert_derivatives(spline)


def test_natural_spline_through_three_points_by_hand():
    """0, 1, 0 at 0, 1, 2: the moments are 0, −3, 0, and q = 1.5 t − 0.5 t³ up to the middle."""
    spline = r1.cubic_spline([0, 1, 2], [0, 1, 0], bc_type="natural")
    assert spline.pieces[0].coefficients[:, 0] == pytest.approx([0, 1.5, 0, -0.5])
    assert spline.acceleration(1) == pytest.approx([-3])
    clamped = r1.cubic_spline([0, 1, 2], [0, 1, 0])
    assert clamped.pieces[0].coefficients[:, 0] == pytest.approx([0, 0, 3, -2])
    assert clamped.velocity(1) == pytest.approx([0])


def test_interior_velocities_solve_the_tridiagonal_system():
    """T₂v₀ + 2(T₁ + T₂)v₁ + T₁v₂ = 3(T₁²Δ₂ + T₂²Δ₁)/T₁T₂ at each inner point."""
    spline = r1.cubic_spline(TIMES, POINTS, v0=0.3, v1=-0.2)
    v, T, d = spline.velocity(TIMES), np.diff(TIMES)[:, None], np.diff(POINTS, axis=0)
    left = T[1:] * v[:-2] + 2 * (T[:-1] + T[1:]) * v[1:-1] + T[:-1] * v[2:]
    right = 3 * (T[:-1] ** 2 * d[1:] + T[1:] ** 2 * d[:-1]) / (T[:-1] * T[1:])
    assert left == pytest.approx(right)


def test_periodic_spline_goes_on_where_it_began():
    points = np.vstack([POINTS[:4], POINTS[0]])
    spline = r1.cubic_spline(TIMES, points, bc_type="periodic")
    assert_smooth_through(spline, points, TIMES)
    for f in (spline, spline.velocity, spline.acceleration):
        assert f(0) == pytest.approx(f(4.7), abs=1e-12)


def test_coefficients_of_the_pieces_in_tau_and_in_t():
    spline = r1.cubic_spline(TIMES, POINTS, bc_type="natural")
    for piece, start in zip(spline.pieces, TIMES, strict=False):
        t = np.linspace(0, piece.duration, 5)
        by_t = sum(c * t[:, None] ** k for k, c in enumerate(piece.coefficients_t))
        by_tau = sum(c * (t[:, None] / piece.duration) ** k for k, c in enumerate(piece.coefficients))
        assert spline(np.minimum(start + t, 4.7)) == pytest.approx(by_t, abs=1e-12)
        assert by_tau == pytest.approx(by_t, abs=1e-12)


def test_the_clamped_spline_bends_least_of_all_motions_through_the_points():
    """∫q̈² of the spline plus any motion that is zero at the points and at rest at the ends is larger."""
    spline = r1.cubic_spline(TIMES, POINTS)
    t = np.linspace(0, 4.7, 20001)
    bend = np.trapezoid(spline.acceleration(t) ** 2, t, axis=0)
    other = r1.trajectories.cubic_hermite_spline(TIMES, POINTS)
    assert (bend < np.trapezoid(other.acceleration(t) ** 2, t, axis=0)).all()
    quartics = r1.trajectories.polynomial_spline(TIMES, POINTS, (4, 3, 3, 4))
    assert (bend < np.trapezoid(quartics.acceleration(t) ** 2, t, axis=0)).all()


def test_two_points_are_a_cubic():
    spline = r1.cubic_spline([0, 3], [[0, 1], [2, 5]], v0=1, v1=[0, -1])
    wanted = r1.cubic([0, 1], [2, 5], 3, 1, [0, -1])
    assert spline.pieces[0].coefficients == pytest.approx(wanted.coefficients)


# --- mixed degrees


@pytest.mark.parametrize(
    ("degrees", "points"), [((4, 3, 4), 4), ((3, 5, 3), 4), ((4, 3, 3, 4), 5), ((4, 4), 3), ((5,), 2)]
)
def test_published_mixed_degrees_are_at_rest_at_both_ends(degrees, points):
    rng = np.random.default_rng(points)
    q, t = rng.uniform(-2, 2, (points, 3)), np.cumsum([0, *rng.uniform(0.5, 2, points - 1)])
    spline = r1.trajectories.polynomial_spline(t, q, degrees)
    assert_smooth_through(spline, q, t)
    assert spline.velocity([0, t[-1]]) == pytest.approx(np.zeros((2, 3)), abs=1e-9)
    assert spline.acceleration([0, t[-1]]) == pytest.approx(np.zeros((2, 3)), abs=1e-9)
    assert [np.flatnonzero(piece.coefficients.any(axis=1))[-1] for piece in spline.pieces] == list(degrees)
    assert_derivatives(spline)


def test_mixed_spline_with_given_velocities_and_accelerations():
    ends = [(0, 1, [1, 2]), (0, 2, -1), (-1, 1, 0.5), (-1, 2, [3, 0])]
    spline = r1.trajectories.polynomial_spline(TIMES[:4], POINTS[:4], (4, 3, 4), ends)
    assert_smooth_through(spline, POINTS[:4], TIMES[:4])
    assert spline.velocity([0, 4]) == pytest.approx(np.array([[1, 2], [0.5, 0.5]]))
    assert spline.acceleration([0, 4]) == pytest.approx(np.array([[-1, -1], [3, 0]]))


def test_mixed_spline_of_one_piece_is_the_quintic():
    spline = r1.trajectories.polynomial_spline([0, 3], [[0], [2]], [5], [(0, 1, 1), (0, 2, 2), (1, 1, -1), (1, 2, 0.5)])
    assert spline.pieces[0].coefficients == pytest.approx(r1.quintic(0, 2, 3, 1, -1, 2, 0.5).coefficients)


def test_a_velocity_at_an_inner_point_takes_the_place_of_a_continuous_acceleration():
    spline = r1.trajectories.polynomial_spline(
        TIMES[:3], POINTS[:3], (3, 3), [(0, 1, 0), (1, 1, [0.7, -0.1]), (2, 1, 0)], continuity=1
    )
    assert spline.velocity(1.0) == pytest.approx([0.7, -0.1])
    wanted = r1.trajectories.cubic_hermite_spline(TIMES[:3], POINTS[:3], [[0, 0], [0.7, -0.1], [0, 0]])
    t = np.linspace(0, 2.5, 9)
    assert spline(t) == pytest.approx(wanted(t))


def test_virtual_points_give_a_cubic_spline_velocity_and_acceleration_at_both_ends():
    for points, times in ((POINTS, TIMES), (POINTS[:2], TIMES[:2])):
        spline = r1.trajectories.virtual_point_spline(times, points, [1, 0], -1, 2, [0, -3])
        assert_smooth_through(spline, points, times)
        T = times[-1]
        assert spline.velocity([0, T]) == pytest.approx(np.array([[1, 0], [-1, -1]]))
        assert spline.acceleration([0, T]) == pytest.approx(np.array([[2, 2], [0, -3]]), abs=1e-9)
        assert all(len(piece.coefficients) == 4 for piece in spline.pieces)
        assert len(spline.pieces) == len(points) + 1


# --- cubics with given velocities


def test_cubics_through_points_with_given_velocities_are_hermites():
    v = np.array([[0, 1], [1, 0.3], [-1, 0], [0.2, 0], [0, 0]])
    motion = r1.trajectories.cubic_hermite_spline(TIMES, POINTS, v)
    hermite = CubicHermiteSpline(TIMES, POINTS, v)
    t = np.linspace(0, 4.7, 31)
    assert motion(t) == pytest.approx(hermite(t))
    assert motion.velocity(t) == pytest.approx(hermite(t, 1))
    assert np.abs(jumps(motion)[2]).min() > 0.1


def test_velocities_left_out_are_mean_slopes_or_zero_at_a_turn():
    motion = r1.trajectories.cubic_hermite_spline([0, 1, 2, 3, 5], [0, 1, 3, 2, 1.5])
    assert motion.velocity([0, 1, 2, 3, 5])[:, 0] == pytest.approx([0, 1.5, 0, -0.625, 0])


# --- times


def test_times_of_points_are_in_proportion_to_powers_of_the_chords():
    points = [[0, 0], [3, 4], [3, 5], [12, 5]]  # chords 5, 1, 9
    assert r1.trajectories.knot_times(points, 3, "chord") == pytest.approx([0, 1, 1.2, 3])
    assert r1.trajectories.knot_times(points, 3, "uniform") == pytest.approx([0, 1, 2, 3])
    assert r1.trajectories.knot_times([0, 4, 5], 3, "centripetal") == pytest.approx([0, 2, 3])
    assert r1.trajectories.knot_times([[1], [1], [2]], 4, "uniform") == pytest.approx([0, 2, 4])


# --- extremes and bounds


@given(values, gaps)
def test_no_sample_passes_the_extremes_of_a_spline(points, steps):
    times = np.concatenate([[0], np.cumsum(steps[: len(points) - 1])])
    spline = r1.cubic_spline(times, points)
    for order in (1, 2, 3):
        largest = np.abs(spline.extremes(order)[1]).max()
        dense = dense_peak(spline, order)
        assert dense <= largest + 1e-9
        assert dense >= 0.999 * largest - 1e-9


def test_a_spline_is_scaled_to_its_bounds_and_no_further():
    spline = r1.cubic_spline(TIMES, POINTS)
    scaled = r1.trajectories.scale_to_limits(spline, r1.MotionLimits([1.5, 2], [4, 3]))
    assert scaled.duration == pytest.approx(scaled.factor * 4.7)
    used = [np.abs(scaled.trajectory.extremes(k)[1]).max(axis=0) / b for k, b in ((1, [1.5, 2]), (2, [4, 3]))]
    assert np.max(used) == pytest.approx(1)
    (active,) = scaled.active
    assert abs(active.value) == pytest.approx(active.limit)
    assert isinstance(scaled.trajectory, r1.curves.PiecewisePolynomial)
    assert scaled.trajectory.x == pytest.approx(scaled.factor * TIMES)


def test_the_shortest_duration_of_a_spline_keeps_its_velocities_at_the_ends():
    shares, limits = TIMES / TIMES[-1], r1.MotionLimits(2.5, 6)

    def spline(T):
        return r1.cubic_spline(T * shares, POINTS, v0=[1, -2], v1=0.5)

    T = r1.trajectories.minimum_duration(spline, limits)

    def used(T):
        return max(np.abs(spline(T).extremes(k)[1]).max() / bound for k, bound in ((1, 2.5), (2, 6)))

    assert used(T) == pytest.approx(1, abs=1e-9)
    assert min(used(x) for x in np.linspace(0.05, 0.999, 60) * T) > 1
    assert spline(T).velocity(0) == pytest.approx([1, -2])


def test_a_path_of_a_spline_takes_a_timing_law():
    spline = r1.trajectories.polynomial_spline(TIMES, POINTS, (4, 3, 3, 4))
    motion = r1.curves.PathTrajectory(spline, r1.quintic(0, 4.7, 6).joint())
    law = r1.quintic(0, 4.7, 6).joint()
    assert motion(2.2) == pytest.approx(spline(law(2.2)))
    assert motion.velocity(2.2) == pytest.approx(spline.velocity(law(2.2)) * law.velocity(2.2))


# --- misuse


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: r1.cubic_spline(TIMES[:4], POINTS), r"shape \(5,"),
        (lambda: r1.cubic_spline(TIMES + 1, POINTS)(0.5), r"\[1, 5.7\]"),
        (lambda: r1.cubic_spline([0, 1, 1, 2, 3], POINTS), "ascend; 1 follows 1"),
        (lambda: r1.cubic_spline([0, 1, 3, 2, 4], POINTS), "ascend; 2 follows 3"),
        (lambda: r1.cubic_spline([0, 1, 2, 3, nan], POINTS), "finite"),
        (lambda: r1.cubic_spline(TIMES, POINTS, v0=1, a0=0), "polynomial_spline"),
        (lambda: r1.cubic_spline(TIMES, POINTS, v1=[1, 2, 3]), "shape"),
        (lambda: r1.cubic_spline(TIMES, POINTS, bc_type="open"), "one of 'clamped'"),
        (lambda: r1.cubic_spline(TIMES, POINTS, bc_type="periodic"), "repeat the first"),
        (lambda: r1.cubic_spline([0, 1, 2], [0, 1, 0], bc_type="periodic", v0=1), "no ends"),
        (lambda: r1.cubic_spline([0, 1], [0, 0], bc_type="periodic"), "three points"),
        (lambda: r1.cubic_spline([0], [[1, 2]]), "two at least"),
        (lambda: r1.cubic_spline([0, 1], [[], []]), "two at least"),
        (lambda: r1.cubic_spline([0, 1, 2], "abc"), "array of real numbers"),
        (lambda: r1.cubic_spline([0, 1], [[0], [inf]]), "finite"),
        (
            lambda: r1.trajectories.polynomial_spline(TIMES, POINTS, (3, 3, 3, 3)),
            "leave 2 conditions to be given; there are 4",
        ),
        (lambda: r1.trajectories.polynomial_spline(TIMES, POINTS, (3, 3)), "there are 4 pieces"),
        (lambda: r1.trajectories.polynomial_spline(TIMES, POINTS, (3, 3, 3, 0)), "at least 1"),
        (
            lambda: r1.trajectories.polynomial_spline(TIMES[:3], POINTS[:3], (3, 3), [(0, 1, 0), (0, 1, 0)]),
            "contradict or repeat",
        ),
        (
            lambda: r1.trajectories.polynomial_spline(TIMES[:3], POINTS[:3], (3, 3), [(0, 1, 0), (5, 1, 0)]),
            "one of the 3 points",
        ),
        (
            lambda: r1.trajectories.polynomial_spline(TIMES[:3], POINTS[:3], (3, 3), [(0, 1, 0), (2, 0, 0)]),
            "at least 1",
        ),
        (lambda: r1.trajectories.polynomial_spline(TIMES[:3], POINTS[:3], (3, 3), 5), r"\(point, order, value\)"),
        (lambda: r1.trajectories.cubic_hermite_spline(TIMES, POINTS, POINTS[:4]), "one velocity for each point"),
        (lambda: r1.trajectories.knot_times([[0], [0], [1]], 3), "points 0 and 1 are the same"),
        (lambda: r1.trajectories.knot_times(POINTS, 0), "positive"),
        (lambda: r1.trajectories.knot_times(POINTS, 1, "even"), "one of 'uniform'"),
        (lambda: r1.cubic_spline(TIMES, POINTS)(4.8), r"\[0, 4.7\]"),
        (lambda: r1.cubic_spline(TIMES, POINTS).velocity(-0.1), r"\[0, 4.7\]"),
    ],
)
def test_misuse_of_splines_is_an_input_error_that_says_what_would_be_right(call, message):
    with pytest.raises(r1.InputError, match=message):
        call()


def test_extremes_of_a_parabola_whose_cubic_term_is_rounding():
    """Not-a-knot through three points is one parabola q = L₀ + ...; a cubic term of 1e-13 spoils no root."""
    t, q = np.array([0, 20.38572613, 21.85966451]), np.array([0.00823793, -0.05816937, -0.29441894])
    spline = r1.cubic_spline(t, q, bc_type="not-a-knot")
    c2, c1, c0 = np.polyfit(t, q, 2)
    times, values = spline.extremes()
    assert values[1, 0] == pytest.approx(c0 - c1**2 / (4 * c2), abs=1e-12)
    assert times[1, 0] == pytest.approx(-c1 / (2 * c2), abs=1e-6)
