"""A law of units: q → k q and t → c t scale every answer about motions, by lengths k and times c alone.

Velocities scale by k/c, accelerations by k/c², jerks by k/c³. An absolute tolerance, hidden anywhere, breaks the law.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import robotics1 as r1

P = np.array([[0, 0], [1, -0.5], [2, 0.3], [0.2, 0.1]])
POINTS = np.array([[0.3, -0.2, 0.1], [1.2, 0.4, -0.3], [0.9, 1.3, 0.8], [-0.4, 0.7, 1.1]])
TIMES = np.array([0.0, 0.7, 1.3, 2.9])
CLOSED = np.vstack([POINTS, POINTS[:1]])
Q0, Q1 = np.array([0.3, -1.2, 0.5]), np.array([1.7, 0.4, -0.6])
V0, V1 = np.array([0.2, -0.1, 0.3]), np.array([-0.3, 0.15, 0.1])
A0, A1 = np.array([0.4, 0.0, -0.2]), np.array([0.1, -0.3, 0.0])
VELOCITY, ACCELERATION, JERK = np.array([1.1, 2.0, 1.7]), np.array([2.0, 3.5, 5.0]), np.array([9.0, 20.0, 14.0])
MOMENTS = np.array([0, 0.0371, 0.119, 0.2377, 0.381, 0.4931, 0.6133, 0.7391, 0.8877, 0.9713, 1])  # off switching times

factors = st.sampled_from([1e-6, 1e-5, 1e-3, 1e-2, 0.37, 1.0, 7.3, 1e3, 31_623.0, 1e6])


def states(k, c):
    """q0, q1, v0, v1, a0, a1 in the unit of length k and of time c."""
    return k * Q0, k * Q1, k / c * V0, k / c * V1, k / c**2 * A0, k / c**2 * A1


def limits(k, c, jerk=True):
    return r1.MotionLimits(k / c * VELOCITY, k / c**2 * ACCELERATION, k / c**3 * JERK if jerk else None)


def motion(m):
    """What a motion is: duration, switching times, values and derivatives, with their powers of length and time."""
    T = m.duration
    readings = {"duration": (T, 0, 1), "switching": (np.asarray(getattr(m, "switching_times", ())), 0, 1)}
    for order, f in enumerate((m, m.velocity, m.acceleration, m.jerk)):
        readings[f"order {order}"] = (f(MOMENTS * T), 1, -order)
        if hasattr(m, "extremes"):
            times, values = m.extremes(order)
            readings[f"extremes {order}"] = (values, 1, -order)
            if order and hasattr(m, "rate"):  # at rest the position is stationary, so that its instants are rounding
                readings[f"instants {order}"] = (times, 0, 1)
    return readings


def law(m):
    peaks = (m.peak_velocity, m.peak_acceleration, m.peak_jerk)
    found = {f"peak {i}": (peak.value, 1, -i) for i, peak in enumerate(peaks, 1)}
    return motion(m) | found | {f"peak time {i}": (peak.time, 0, 1) for i, peak in enumerate(peaks, 1)}


def path(p, order=3):
    """What a path is, with s a length."""
    s = MOMENTS * p.end
    found = {f"order {i}": (p.derivative(s, i), 1 - i, 0) for i in range(order + 1)}
    return found | {
        "end": (p.end, 1, 0),
        "length": (p.length, 1, 0),
        "breaks": (p.breaks, 1, 0),
        "curvature": (p.curvature(s), -1, 0),
    }


def numbers(**given):
    return {name: (np.asarray(value), *powers) for name, (value, *powers) in given.items()}


def demands(found):
    orders = {"velocity": 1, "acceleration": 2, "jerk": 3, "deceleration": 2, "normal acceleration": 2}
    return {
        f"{i} {d.joint} {d.quantity}": ([d.value, d.bound], 1, -orders[d.quantity]) for i, d in enumerate(found)
    } | {f"{i} {d.joint} {d.quantity} time": (d.time, 0, 1) for i, d in enumerate(found)}


def fastest(found):
    return motion(found.trajectory) | demands(found.active) | {"each": (found.joint_durations, 0, 1)}


MINIMUM = {
    f"minimum_time, {kind}, {coordination}": lambda k, c, kind=kind, coordination=coordination: fastest(
        r1.minimum_time(k * Q0, k * Q1, limits(k, c, kind not in ("trapezoidal", "bang-bang")), kind,
                        coordination=coordination)
    )
    for kind in ("trapezoidal", "double-S", "bang-bang", "cubic", "quintic", "septic", "cosine", "cycloidal")
    for coordination in ("slowed", "straight", "independent")
} | {
    f"minimum_time with velocities, {kind}": lambda k, c, kind=kind: fastest(
        r1.minimum_time(k * Q0, k * Q1, limits(k, c, kind == "double-S"), kind, v0=k / c * V0, v1=k / c * V1)
    )
    for kind in ("trapezoidal", "double-S", "cubic", "quintic", "septic")
}  # fmt: skip

LAWS = MINIMUM | {
    "cubic": lambda k, c: motion(r1.cubic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4])),
    "cubic law": lambda k, c: law(r1.cubic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4]).joint(1)),
    "quintic": lambda k, c: motion(r1.quintic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:])),
    "septic": lambda k, c: motion(r1.septic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:])),
    "cosine": lambda k, c: motion(r1.cosine(k * Q0, k * Q1, 1.7 * c)),
    "cycloidal": lambda k, c: law(r1.cycloidal(k * Q0, k * Q1, 1.7 * c).joint(2)),
    "trapezoidal, A": lambda k, c: motion(
        r1.trapezoidal(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4], acceleration=k / c**2 * 9)
    ),
    "trapezoidal, V": lambda k, c: motion(r1.trapezoidal(k * Q0, k * Q1, 1.7 * c, velocity=k / c * 1.3 * abs(Q1 - Q0) / 1.7)),
    "bang_bang": lambda k, c: motion(r1.bang_bang(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4])),
    "double_s": lambda k, c: motion(
        r1.double_s(*states(k, c)[:2], 2.7 * c, *states(k, c)[2:4], acceleration=k / c**2 * 5, jerk=k / c**3 * 30)
    ),
    "cruise_profile": lambda k, c: law(
        r1.cruise_profile(-1.3 * k / c, 0.4 * c, acceleration=2 * k / c**2, jerk=7 * k / c**3, start=0.2 * k)
    ),
    "polynomial_through": lambda k, c: motion(
        r1.polynomial_through([(0, 0, k * Q0), (0, 1, k / c * V0), (0.8 * c, 0, k * Q1), (2 * c, 0, k * Q0)])
    ),
    "polynomial_formula": lambda k, c: numbers(
        coefficients=([float(x) for x in r1.polynomial_formula((0.3 * k, 0.2 * k / c), (1.7 * k, 0), 1.7 * c).coefficients], 1, 0)
    ),
    **{
        f"cubic_spline, {ends}": lambda k, c, ends=ends: motion(r1.cubic_spline(k * POINTS, c * TIMES, ends=ends))
        for ends in ("clamped", "natural", "not-a-knot")
    },
    "cubic_spline, periodic": lambda k, c: motion(
        r1.cubic_spline(k * CLOSED, c * np.append(TIMES, 3.3), ends="periodic")
    ),
    "cubic_spline with velocities": lambda k, c: motion(
        r1.cubic_spline(k * POINTS, c * TIMES, v0=k / c * V0, a1=k / c**2 * A1)
    ),
    "cubics_through": lambda k, c: motion(r1.cubics_through(k * POINTS, c * TIMES)),
    "mixed_spline": lambda k, c: motion(r1.mixed_spline(k * POINTS, c * TIMES, (4, 3, 4))),
    "virtual_point_spline": lambda k, c: motion(r1.virtual_point_spline(k * POINTS, c * TIMES, *states(k, c)[2:])),
    "times_of_points": lambda k, c: numbers(
        chord=(r1.times_of_points(k * POINTS, 2.9 * c), 0, 1),
        centripetal=(r1.times_of_points(k * POINTS, 2.9 * c, "centripetal"), 0, 1),
    ),
    "overfly": lambda k, c: motion(r1.overfly(k * POINTS, k / c * np.array([1.0, 0.7, 1.2]), 0.3 * c)),
    "stretched": lambda k, c: motion(r1.stretched(r1.overfly(k * POINTS, k / c, 0.3 * c), 1.7)),
    "line": lambda k, c: path(r1.line_path(k * Q0, k * Q1)),
    "arc": lambda k, c: path(r1.arc_through(*(k * POINTS[:3]))),
    "arc about a centre": lambda k, c: path(r1.arc_path(k * Q0[:2], k * Q1[:2], -2.1)),
    "circle": lambda k, c: path(r1.circle_path(k * Q0, 0.7 * k, normal=[1, 2, 3])),
    "helix": lambda k, c: path(r1.helix_path([0, 0, 0.1 * k], [0.5 * k, 0, 0.1 * k], 0.2 * k, 1.5)),
    "polyline, circular": lambda k, c: path(r1.polyline_path(k * POINTS, blend=0.2 * k)),
    "polyline, radius": lambda k, c: path(r1.polyline_path(k * POINTS, radius=0.1 * k)),
    "polyline, parabolic": lambda k, c: path(r1.polyline_path(k * POINTS, blend=0.2 * k, kind="parabolic")),
    **{
        f"spline_path, {ends}": lambda k, c, ends=ends: path(r1.spline_path(k * CLOSED, ends=ends))
        for ends in ("natural", "not-a-knot", "periodic")
    },
    "by_arc_length": lambda k, c: path(r1.by_arc_length(r1.spline_path(k * POINTS, knots=k * np.array([0, 1, 3, 4])))),
    "ellipse by arc length": lambda k, c: path(
        r1.by_arc_length(r1.ellipse_path(k * Q0[:2], [0.9 * k, 0], [0, 0.2 * k]))
    ),
    "formula_path": lambda k, c: path(r1.formula_path(["R*cos(s/R)", "s + s**2/R"], "s", 2.1 * k, values={"R": 0.7 * k})),
    "paths in a row": lambda k, c: path(
        r1.PathSequence((r1.line_path(k * Q0, k * Q1), r1.arc_through(k * Q1, k * POINTS[0], k * POINTS[3])))
    ),
    "frenet_frame": lambda k, c: frenet(r1.frenet_frame(r1.spline_path(k * POINTS), 1.7 * k)),
    "frenet_path": lambda k, c: turning(r1.frenet_path(r1.helix_path([0, 0, 0], [0.5 * k, 0, 0], 0.2 * k, 1.5))),
    "path and law": lambda k, c: motion(timed(k, c)),
    "path by arc length and law": lambda k, c: motion(
        r1.PathTrajectory(p := r1.by_arc_length(r1.spline_path(k * POINTS)), r1.quintic(0, p.end, 2 * c).joint())
    ),
    "polyline and law": lambda k, c: motion(blended(k, c)),
    "peak_norm": lambda k, c: {
        name: reading
        for quantity, order in (("velocity", 1), ("acceleration", 2), ("jerk", 3), ("normal acceleration", 2))
        for peak in [r1.peak_norm(timed(k, c), quantity)]
        for name, reading in ((quantity, (peak.value, 1, -order)), (quantity + " time", (peak.time, 0, 1)))
    },
    "acceleration_split": lambda k, c: numbers(
        tangential=(r1.acceleration_split(timed(k, c), 0.7 * c).tangential, 1, -2),
        normal=(r1.acceleration_split(timed(k, c), 0.7 * c).normal, 1, -2),
    ),
    "timing_bounds": lambda k, c: bounds(r1.timing_bounds(r1.spline_path(k * POINTS), 0.5 * k / c, 3 * k / c**2)),
    "scale_to_limits": lambda k, c: scaled(r1.scale_to_limits(r1.quintic(k * Q0, k * Q1, 1.7 * c), limits(k, c))),
    "scale_to_limits, other units": lambda k, c: scaled_by_nature(k, c),
    "scale_to_limits of a norm": lambda k, c: scaled(
        r1.scale_to_limits(timed(k, c), r1.NormLimits(k / c, 2 * k / c**2, 9 * k / c**3, 1.5 * k / c**2))
    ),
    "shortest_duration": lambda k, c: numbers(
        T=(r1.shortest_duration(
            lambda T: r1.quintic(k * Q0, k * Q1, T, k / c * V0, k / c * V1), limits(k, c)), 0, 1)
    ),
    "shortest_duration of a spline": lambda k, c: numbers(
        T=(r1.shortest_duration(
            lambda T: r1.cubic_spline(k * POINTS, T * TIMES / 2.9, v0=k / c * V0), limits(k, c)), 0, 1)
    ),
    "joins": lambda k, c: joins(k, c),
    "fastest_along": lambda k, c: quickest(k, c, r1.spline_path(k * P)),
    "fastest_along by arc length": lambda k, c: quickest(k, c, r1.by_arc_length(r1.spline_path(k * P))),
    "fastest_along blends": lambda k, c: quickest(
        k, c, r1.polyline_path(k * P[:3], blend=0.3 * k, kind="parabolic")
    ),
    "fastest_along a spline of time": lambda k, c: quickest(
        k, c, r1.cubic_spline(k * P, c * TIMES, v0=k / c, v1=-k / c).as_path()
    ),
}  # fmt: skip


def frenet(f):
    return numbers(
        position=(f.position, 1, 0),
        rotation=(f.rotation, 0, 0),
        curvature=(f.curvature, -1, 0),
        torsion=(f.torsion, -1, 0),
    )


def turning(rotation):
    s = MOMENTS * rotation.end
    found = {"R": (rotation(s), 0, 0), "end": (rotation.end, 1, 0)}
    return found | {f"order {i}": (rotation.derivative(s, i), -i, 0) for i in (1,)}


def timed(k, c):
    curve = r1.spline_path(k * POINTS)
    return r1.PathTrajectory(curve, r1.trapezoidal(0, curve.end, 2 * c, velocity=0.8 * curve.end / c).joint())


def blended(k, c):
    line = r1.polyline_path(k * POINTS, blend=0.2 * k)
    return r1.PathTrajectory(line, r1.minimum_time(0, line.end, r1.MotionLimits(k / c, 2 * k / c**2)).laws[0])


def bounds(b):
    return numbers(
        velocity=(b.velocity, 1, -1), acceleration=(b.acceleration, 1, -2),
        fastest_at=(b.fastest_at, 1, 0), tightest_at=(b.tightest_at, 1, 0),
    )  # fmt: skip


def scaled(found):
    return motion(found.trajectory) | demands(found.demands) | numbers(factor=(found.factor, 0, 0))


def scaled_by_nature(k, c):
    """A motion of one unit of time, scaled to bounds in another: only the factor takes up the difference."""
    found = r1.scale_to_limits(r1.quintic(k * Q0, k * Q1, 1.7), limits(k, c))
    return motion(found.trajectory)


def joins(k, c):
    """Pieces that join with continuous velocities and a jump of the acceleration, and one where nothing jumps."""
    first = r1.cubic(k * Q0, k * Q1, 1.1 * c, 0, k / c * V1)
    second = r1.cubic(k * Q1, k * POINTS[0], 0.9 * c, k / c * V1, 0)
    third = r1.quintic(k * POINTS[0], k * Q0, 1.3 * c, 0, 0, second.acceleration(0.9 * c, side="left"))
    row = r1.TrajectorySequence((first, second, third))
    found = motion(row) | {"continuity": ([join.continuity for join in row.joins], 0, 0)}
    for i, join in enumerate(row.joins):
        found[f"join {i}"] = (join.time, 0, 1)
        found |= {f"jump {i} {order}": (jump, 1, -order) for order, jump in enumerate(join.jumps)}
    return found


def quickest(k, c, curve):
    pytest.importorskip("toppra")
    found = r1.fastest_along(curve, r1.MotionLimits([2 * k / c] * 2, [5 * k / c**2] * 2), grid=100)
    T = found.duration
    return numbers(
        T=(T, 0, 1), q=(found.trajectory(MOMENTS * T), 1, 0), v=(found.trajectory.velocity(MOMENTS * T), 1, -1)
    )


PLAIN = {}


@pytest.mark.parametrize("name", LAWS)
@given(k=factors, c=factors)
def test_answers_scale_with_the_units_of_length_and_time(name, k, c):
    plain = PLAIN[name] if name in PLAIN else PLAIN.setdefault(name, LAWS[name](1.0, 1.0))
    found = LAWS[name](k, c)
    assert found.keys() == plain.keys()
    for what, (value, length, time) in found.items():
        wanted, scale = np.asarray(plain[what][0], dtype=float), k**length * c**time
        assert np.shape(value) == wanted.shape, what
        assert np.asarray(value) / scale == pytest.approx(wanted, rel=0, abs=1e-9 * np.abs(wanted).max(initial=0)), what
