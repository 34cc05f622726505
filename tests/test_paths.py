"""Lines, arcs, circles, ellipses, helices, splines, formulas: values, derivatives, lengths, curvature, frames."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from scipy.integrate import quad
from scipy.interpolate import CubicSpline
from scipy.special import ellipe

import robotics1 as r1
from robotics1 import InputError

s = sympy.Symbol("s")
HELIX = r1.curves.helix_path([1, 2, 0], [1.5, 2, 0], pitch=0.4, turns=2.5)
LISSAJOUS = r1.curves.formula_path([sympy.cos(2 * s), sympy.sin(3 * s), s**2 / 3], s, 2.0)
PATHS = {
    "line": r1.line_path([1, 2, 3], [4, 6, 3]),
    "line of joints": r1.line_path([0.1, -0.5, 2.0, 1.0, 0.3], [1.0, 0.5, -1.0, 0.0, 0.3]),
    "arc": r1.curves.arc_path([1, 0, 0], [1, 2, 0], -2.0, normal=[1, 0, 0]),
    "arc in the plane": r1.curves.arc_path([1, 1], [2, 1], 1.2),
    "three points": r1.curves.arc_through([0, 0, 1], [1, 0.2, 2], [1, 1, 1]),
    "three points in five dimensions": r1.curves.arc_through([0, 0, 1, 0, 0], [1, 0.2, 2, 1, 0], [1, 1, 1, 0, 3]),
    "circle": r1.curves.circle_path([0, 0, 2], 0.7, normal=[1, 1, 1]),
    "ellipse": r1.curves.ellipse_path([0, 1], [2, 0], [0, 1]),
    "helix": HELIX,
    "polyline": r1.curves.polyline_path([[0, 0, 0], [1, 0, 0], [1, 2, 1], [0, 2, 2]], blend=0.3),
    "parabolic polyline": r1.curves.polyline_path([[0, 0], [1, 0], [1, 2]], blend=0.4, kind="parabolic"),
    "spline": r1.trajectories.spline_path([[0, 0], [1, 2], [3, 1], [4, 4]]),
    "formula": LISSAJOUS,
    "ellipse by arc length": r1.curves.by_arc_length(r1.curves.ellipse_path([0, 1], [2, 0], [0, 1])),
    "spline by arc length": r1.curves.by_arc_length(r1.trajectories.spline_path([[0, 0], [1, 2], [3, 1], [4, 4]])),
    "stacked": r1.curves.stacked_path((r1.line_path([0, 0], [3, 4]), r1.curves.arc_path([0, 0], [1, 0], 2.0)), 2.0),
}


def inside(path, count=5, clear=0.02):
    """Parameters away from the ends and the breaks."""
    places = np.linspace(0, path.end, count + 2)[1:-1] + 0.00123 * path.end
    ends = np.array(path.ends)
    return np.array([x for x in places if np.abs(ends - x).min() > clear * path.end])


def rate(f, x, h):
    """df/dx, by central differences of fourth order."""
    return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h)


# --- derivatives, arc length


@pytest.mark.parametrize("name", PATHS)
@pytest.mark.parametrize("order", [1, 2, 3])
def test_each_derivative_is_the_difference_of_the_one_before(name, order):
    path = PATHS[name]
    x, h = inside(path), 2e-4 * path.end
    found = path.derivative(x, order)
    assert len(x) >= 3
    assert found == pytest.approx(
        rate(lambda y: path.derivative(y, order - 1), x, h), abs=2e-8 * (1 + abs(found).max())
    )


@pytest.mark.parametrize("name", [name for name, path in PATHS.items() if path.is_unit_speed])
def test_by_the_arc_length_the_speed_is_one_and_p1_is_normal_to_p2(name):
    path = PATHS[name]
    x = inside(path, 20)
    p1, p2 = path.derivative(x, 1), path.derivative(x, 2)
    assert np.linalg.norm(p1, axis=1) == pytest.approx(np.ones(len(x)), abs=1e-12)
    assert np.sum(p1 * p2, axis=1) == pytest.approx(np.zeros(len(x)), abs=1e-9)
    assert path.length == path.end
    assert path.curvature(x) == pytest.approx(np.linalg.norm(p2, axis=1), abs=1e-9)


@pytest.mark.parametrize("name", PATHS)
def test_length_is_the_integral_of_the_speed(name):
    path = PATHS[name]
    parts = zip(path.ends, path.ends[1:], strict=False)
    length = sum(quad(lambda x: np.linalg.norm(path.derivative(x)), a, b, epsabs=1e-12, limit=200)[0] for a, b in parts)
    assert path.length == pytest.approx(length, rel=1e-10)


def test_length_of_an_ellipse_is_the_complete_elliptic_integral():
    assert r1.curves.ellipse_path([0, 0], [3, 0], [0, 1]).length == pytest.approx(4 * 3 * ellipe(1 - 1 / 9), rel=1e-13)


def test_by_arc_length_goes_through_the_same_points():
    path = PATHS["ellipse"]
    whole = r1.curves.by_arc_length(path)
    for place in (0.0, 0.3, 2.0, 5.0, 2 * pi):
        length = quad(lambda x: np.linalg.norm(path.derivative(x)), 0, place, epsabs=1e-13)[0]
        assert whole(min(length, whole.end)) == pytest.approx(path(place), abs=1e-11)
    assert r1.curves.by_arc_length(HELIX) is HELIX


# --- hand formulas


def test_line_is_p0_plus_s_times_the_unit_vector():
    path = PATHS["line"]
    assert path.end == 5
    assert path(2.5) == pytest.approx([2.5, 4, 3])
    assert path.derivative(1.0) == pytest.approx([0.6, 0.8, 0])
    assert path(np.array([0, 5])) == pytest.approx(np.array([[1, 2, 3], [4, 6, 3]]))
    assert path.curvature(1.0) == 0


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.2, 3), st.floats(0, 6.2), st.floats(0.05, 3), st.floats(0.05, 3))
def test_arc_through_three_points_of_a_circle_has_its_radius_and_passes_them_in_order(x, y, r, a, b, c):
    points = [[x + r * cos(u), y + r * sin(u)] for u in (a, a + b, a + b + c)]
    if b + c > 2 * pi - 0.05:
        return
    path = r1.curves.arc_through(*points)
    assert path.end == pytest.approx(r * (b + c), rel=1e-8)
    assert path(r * b) == pytest.approx(points[1], abs=1e-8)
    assert path(path.end) == pytest.approx(points[2], abs=1e-8)
    assert path.curvature(0.5 * path.end) == pytest.approx(1 / r, rel=1e-8)


def test_arc_over_an_opposite_point_goes_the_way_of_the_third():
    path = r1.curves.arc_through([1, 0], [-1, 0], [0, -1])
    assert path.end == pytest.approx(1.5 * pi)
    assert path(pi / 2) == pytest.approx([0, 1], abs=1e-12)
    assert r1.curves.arc_through([1, 0], [0, -1], [-1, 0])(pi / 2) == pytest.approx([0, -1], abs=1e-12)


def test_arc_turns_about_the_normal_counter_clockwise():
    path = PATHS["arc"]  # centre (1, 0, 0), from (1, 2, 0), about −x by 2
    assert path.end == pytest.approx(4)
    assert path(2.0) == pytest.approx([1, 2 * cos(1), -2 * sin(1)])
    assert PATHS["arc in the plane"](0.5) == pytest.approx([1 + cos(0.5), 1 + sin(0.5)])


def test_circle_begins_at_x_and_closes():
    path = r1.curves.circle_path([1, 2], 0.5)
    assert path(0.0) == pytest.approx([1.5, 2])
    assert path(path.end) == pytest.approx([1.5, 2])
    assert path(pi / 4) == pytest.approx([1, 2.5])
    about_x = r1.curves.circle_path([0, 0, 0], 2.0, normal=[1, 0, 0])
    assert about_x(0.0) == pytest.approx([0, 2, 0])
    assert about_x(pi) == pytest.approx([0, 0, 2], abs=1e-12)


def test_ellipse_has_the_curvature_a_over_b_squared_at_the_end_of_its_long_axis():
    path = r1.curves.ellipse_path([0, 0], [3, 0], [0, 1])
    assert path.curvature(np.array([0, pi / 2])) == pytest.approx([3, 1 / 9])
    by_length = r1.curves.by_arc_length(path)
    unit_speed = r1.cubic(0, by_length.end, by_length.end, 1, 1).joint()
    most = r1.trajectories.peak_norm(r1.curves.PathTrajectory(by_length, unit_speed), "normal acceleration")
    assert most.value == pytest.approx(3, rel=1e-12)
    assert most.resolved


def test_helix_curvature_and_torsion_are_r_and_h_over_r2_plus_h2():
    r, h = 0.5, 0.4 / (2 * pi)
    frame = r1.curves.frenet_frame(HELIX, 1.7)
    assert HELIX.end == pytest.approx(2.5 * 2 * pi * sqrt(r * r + h * h))
    assert frame.curvature == pytest.approx(r / (r * r + h * h))
    assert frame.torsion == pytest.approx(h / (r * r + h * h))
    assert frame.radius == pytest.approx(1 / frame.curvature)
    u = 1.7 / sqrt(r * r + h * h)
    assert frame.normal == pytest.approx([-cos(u), -sin(u), 0])
    assert frame.position == pytest.approx([1 + r * cos(u), 2 + r * sin(u), h * u])
    assert r1.curves.helix_path([0, 0, 0], [1, 0, 0], -0.4, 1)(0.1)[2] < 0


@pytest.mark.parametrize("name", ["helix", "formula", "three points", "circle"])
def test_frenet_serret_equations(name):
    path = PATHS[name]
    for place in inside(path, 4):
        frame, speed, h = r1.curves.frenet_frame(path, place), np.linalg.norm(path.derivative(place)), 1e-3 * path.end
        t, n, b = frame.tangent, frame.normal, frame.binormal
        k, tau = frame.curvature, frame.torsion
        assert frame.rotation.T @ frame.rotation == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(frame.rotation) == pytest.approx(1)
        turned = rate(lambda x, path=path: r1.curves.frenet_frame(path, x).rotation, place, h) / speed
        assert turned[:, 0] == pytest.approx(k * n, abs=1e-6 * (1 + k))
        assert turned[:, 1] == pytest.approx(-k * t + tau * b, abs=1e-6 * (1 + k))
        assert turned[:, 2] == pytest.approx(-tau * n, abs=1e-6 * (1 + k))
        assert np.cross(frame.darboux, n) == pytest.approx(turned[:, 1], abs=1e-6 * (1 + k))


def test_a_planar_curve_turns_about_z_and_a_line_has_no_normal():
    frame = r1.curves.frenet_frame(r1.curves.circle_path([0, 0], 2.0), 0.0)
    assert frame.binormal == pytest.approx([0, 0, 1])
    assert frame.torsion == 0
    assert r1.curves.frenet_frame(r1.curves.arc_path([0, 0], [1, 0], -1.0), 0.0).binormal == pytest.approx([0, 0, -1])
    straight = r1.curves.frenet_frame(PATHS["line"], 1.0)
    assert (straight.normal, straight.binormal, straight.torsion, straight.curvature) == (None, None, None, 0.0)
    assert straight.radius == np.inf
    with pytest.raises(InputError, match="straight"):
        straight.rotation  # noqa: B018


def test_formulas_of_the_helix():
    R, h = sympy.symbols("R h", positive=True)
    path = r1.curves.formula_path([R * sympy.cos(s), R * sympy.sin(s), h * s], s, 4.0, values={"R": 0.5, "h": 0.2})
    found = r1.curves.frenet_formulas(path)
    assert sympy.simplify(found.curvature - R / (R**2 + h**2)) == 0
    assert sympy.simplify(found.torsion - h / (R**2 + h**2)) == 0
    assert sympy.simplify(found.speed - sympy.sqrt(R**2 + h**2)) == 0
    x = found.normal.free_symbols - {R, h}
    assert len(x) == 1
    assert sympy.simplify(found.normal.subs(x.pop(), 0) - sympy.Matrix([-1, 0, 0])) == sympy.zeros(3, 1)
    frame = r1.curves.frenet_frame(path, 1.0)
    assert frame.curvature == pytest.approx(0.5 / 0.29)
    assert path.derivative_formula(2)[1] == -R * sympy.sin(s)


def test_formulas_of_a_parabola_agree_with_numbers():
    path = r1.curves.formula_path([s, s**2], "s", 2.0)
    found = r1.curves.frenet_formulas(path)
    (x,) = found.curvature.free_symbols
    for place in (0.0, 0.7, 2.0):
        assert float(found.curvature.subs(x, place)) == pytest.approx(2 / (1 + 4 * place**2) ** 1.5)
        assert path.curvature(place) == pytest.approx(2 / (1 + 4 * place**2) ** 1.5)
        assert found.tangent.subs(x, place).evalf().values()[0] == pytest.approx(1 / sqrt(1 + 4 * place**2))


# --- splines


@pytest.mark.parametrize(
    ("ends", "kind"), [("natural", "natural"), ("not-a-knot", "not-a-knot"), ("clamped", "clamped")]
)
def test_spline_is_scipys_at_the_chords(ends, kind):
    points = np.array([[0, 0, 1], [1, 2, 0], [3, 1, 1], [4, 4, 0], [5, 4, 2.0]])
    path = r1.trajectories.spline_path(points, bc_type=ends)
    knots = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    other = CubicSpline(knots, points, bc_type=kind)
    x = np.linspace(0, path.end, 31)
    assert path.end == pytest.approx(knots[-1])
    assert path.x == pytest.approx(knots)
    assert path.breakpoints == pytest.approx(knots[2:-2] if kind == "not-a-knot" else knots[1:-1])
    for order in (0, 1, 2):
        assert path.derivative(x, order) == pytest.approx(other(x, order), abs=1e-12)
    assert path(knots) == pytest.approx(points, abs=1e-12)


def test_spline_ends_with_the_tangents_that_are_asked_and_is_smooth_at_the_knots():
    path = r1.trajectories.spline_path([[0, 0], [1, 2], [3, 1]], knots=[0, 1, 3], v0=[1, 0], v1=[0, -2])
    assert path.derivative(0.0) == pytest.approx([1, 0])
    assert path.derivative(3.0) == pytest.approx([0, -2])
    for order in (0, 1, 2):
        assert path.derivative(1.0, order, side="left") == pytest.approx(path.derivative(1.0, order), abs=1e-12)
    assert np.abs(path.derivative(1.0, 3, side="left") - path.derivative(1.0, 3)).max() > 0.1
    one = r1.trajectories.spline_path([[0, 0], [1, 2], [3, 1]], v0=[1, 0])
    assert one.derivative(one.end, 2) == pytest.approx([0, 0], abs=1e-12)


def test_spline_ends_with_the_second_derivatives_that_are_asked():
    """p'' is linear in s between the knots, and by Simpson's rule the strain of the points is met."""
    points = [[0, 0], [1, 2], [3, 1]]
    path = r1.trajectories.spline_path(points, knots=[0, 1, 3], a0=[2, -1], a1=[0.5, 4])
    assert path.derivative(0.0, 2) == pytest.approx([2, -1])
    assert path.derivative(3.0, 2) == pytest.approx([0.5, 4])
    assert path([0, 1, 3]) == pytest.approx(np.array(points, dtype=float))
    # (h₀ m₀ + 2 (h₀ + h₁) m₁ + h₁ m₂)/6 = Δ₁/h₁ − Δ₀/h₀
    left = (1 * np.array([2, -1]) + 6 * path.derivative(1.0, 2) + 2 * np.array([0.5, 4])) / 6
    assert left == pytest.approx(np.array([2, -1]) / 2 - np.array([1, 2]))
    mixed = r1.trajectories.spline_path(points, knots=[0, 1, 3], a0=[2, -1], v1=[0, -2])
    assert mixed.derivative(0.0, 2) == pytest.approx([2, -1])
    assert mixed.derivative(3.0) == pytest.approx([0, -2])


def test_a_periodic_spline_closes_with_its_curvature():
    path = r1.trajectories.spline_path([[1, 0], [0, 1], [-1, 0], [0, -1], [1, 0]], bc_type="periodic")
    for order in (0, 1, 2):
        assert path.derivative(0.0, order) == pytest.approx(path.derivative(path.end, order), abs=1e-12)
    assert path.length == pytest.approx(2 * pi, rel=0.02)


@pytest.mark.parametrize(("knots", "end"), [("chord", 5 + 13), ("centripetal", sqrt(5) + sqrt(13)), ("uniform", 2)])
def test_knots_of_a_spline(knots, end):
    assert r1.trajectories.spline_path([[0, 0], [3, 4], [8, 16]], knots=knots).end == pytest.approx(end)


# --- polylines


def test_circular_blend_has_the_radius_d_over_tan_half_the_turn_and_its_clearance():
    d, turn = 0.3, pi / 3
    corner, end = np.array([2.0, 0]), np.array([2 + cos(turn), sin(turn)])
    path = r1.curves.polyline_path([[0, 0], corner, end], blend=d)
    r = d / np.tan(turn / 2)
    assert path.breakpoints == pytest.approx([2 - d, 2 - d + r * turn])
    assert path.curvature(2 - d + r * turn / 2) == pytest.approx(1 / r)
    middle = path(2 - d + r * turn / 2)
    assert np.linalg.norm(middle - corner) == pytest.approx(r * (1 / cos(turn / 2) - 1))
    assert path.length == pytest.approx(3 - 2 * d + r * turn)
    by_radius = r1.curves.polyline_path([[0, 0], corner, end], radius=r)
    assert by_radius(1.9) == pytest.approx(path(1.9), abs=1e-12)
    assert path(path.end) == pytest.approx(end)


def test_parabolic_blend_passes_at_half_d_sine_of_half_the_turn_and_slows_to_its_cosine():
    d, turn = 0.4, 2 * pi / 3
    corner = np.array([2.0, 0, 1])
    path = r1.curves.polyline_path(
        [[0, 0, 1], corner, corner + np.array([cos(turn), sin(turn), 0])], blend=d, kind="parabolic"
    )
    assert path.breakpoints == pytest.approx([2 - d, 2 + d])
    assert np.linalg.norm(path(2.0) - corner) == pytest.approx(d / 2 * sin(turn / 2))
    assert np.linalg.norm(path.derivative(2.0)) == pytest.approx(cos(turn / 2))
    assert path.end == pytest.approx(3)


@pytest.mark.parametrize("kind", ["circular", "parabolic"])
def test_a_blended_polyline_has_a_continuous_tangent_and_touches_its_lines(kind):
    rng = np.random.default_rng(4)
    points = rng.normal(size=(6, 3))
    path = r1.curves.polyline_path(points, blend=0.2, kind=kind)
    assert len(path.breakpoints) == 8
    for place in path.breakpoints:
        assert path.derivative(place, side="left") == pytest.approx(path.derivative(place), abs=1e-12)
        assert path.derivative(place, 0, side="left") == pytest.approx(path(place), abs=1e-12)
    assert path(path.breakpoints[0]) == pytest.approx(points[1] - 0.2 * path.derivative(0.0))


def test_without_a_blend_the_tangent_jumps_and_a_straight_corner_has_none():
    path = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]])
    assert path.derivative(1.0, side="left") == pytest.approx([1, 0])
    assert path.derivative(1.0) == pytest.approx([0, 1])
    assert path.length == 2
    straight = r1.curves.polyline_path([[0, 0], [1, 0], [3, 0]], blend=0.5)
    assert straight.length == pytest.approx(3)
    assert straight.curvature(1.0) == 0
    whole = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=1.0)  # the blend takes both segments
    assert whole.length == pytest.approx(pi / 2)


def test_paths_in_a_row_must_meet():
    line, arc = r1.line_path([0, 0], [1, 0]), r1.curves.arc_path([1, 1], [1, 0], pi / 2)
    path = r1.curves.CurveSequence((line, arc))
    assert path.length == pytest.approx(1 + pi / 2)
    assert path(path.end) == pytest.approx([2, 1])
    assert path.is_unit_speed
    assert path.curvature(1.0) == pytest.approx(1)
    assert path.curvature(1.0, side="left") == 0
    with pytest.raises(InputError, match=r"piece 1 must begin where piece 0 ends; it begins 1\.414 from there"):
        r1.curves.CurveSequence((arc, arc))


def test_stacked_paths_go_from_start_to_end_together():
    path = PATHS["stacked"]
    assert path(1.0) == pytest.approx([1.5, 2, cos(1), sin(1)])
    assert path.derivative(0.0) == pytest.approx([1.5, 2, 0, 1])
    assert r1.curves.stacked_path((HELIX,)).end == HELIX.end


# --- extremes of smooth functions


class Moving:
    """A motion of somebody else; only its velocity is asked."""

    def __init__(self, velocity, duration, breakpoints=()):
        self.duration, self.breakpoints, self._velocity = duration, breakpoints, velocity

    def __call__(self, t):
        return np.zeros(np.shape(t))

    def velocity(self, t, *, side="right"):
        return self._velocity(t, side)

    acceleration = jerk = velocity


def largest_velocity(*moving):
    times, values = r1.curves.stretched(Moving(*moving), 1.0).extremes(1)
    return times[1], values[1]


def test_the_largest_of_many_narrow_peaks_is_found():
    def f(x, side="right"):
        return np.sin(200 * x) * np.exp(-((x - 2.003) ** 2))

    time, value = largest_velocity(f, 5.0)
    x = np.linspace(1.9, 2.1, 2_000_001)
    assert value == pytest.approx(f(x).max(), abs=1e-10)
    assert time == pytest.approx(x[f(x).argmax()], abs=1e-6)


def test_a_jump_is_seen_from_its_larger_side_and_the_first_of_equals_counts():
    def step(x, side):
        return np.where(x < 1, x, 0.0) if side == "right" else np.where(x <= 1, x, 0.0)

    assert largest_velocity(step, 3.0, [1.0]) == (1.0, 1.0)
    assert largest_velocity(lambda x, side: np.cos(x) ** 2, 7.0)[0] == 0
    with pytest.raises(InputError, match="too quickly for its extremes to be found"):
        largest_velocity(lambda x, side: np.sqrt(np.abs(x - 1 / pi)), 1.0)


def test_formulas_may_be_typed():
    path = r1.curves.formula_path(
        ["-R*cos(2*s) + 1", "sqrt(s**2 + 1)/h", "pi*atan2(s, 2)", 3], "s", 2.0, values={"R": 2, "h": 4}
    )
    both = r1.curves.formula_path(["s", sympy.Symbol("s", real=True) ** 2, s**3], "s", 2.0)
    assert both(1.5) == pytest.approx([1.5, 2.25, 3.375])
    x = 0.7
    assert path(x) == pytest.approx([1 - 2 * cos(2 * x), sqrt(x * x + 1) / 4, pi * np.arctan2(x, 2), 3])
    assert path.derivative(x)[0] == pytest.approx(4 * sin(2 * x))
