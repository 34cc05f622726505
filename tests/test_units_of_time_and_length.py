"""A law of units: q → k q and t → c t scale every answer about motions, by lengths k and times c alone.

Velocities scale by k/c, accelerations by k/c², jerks by k/c³. An absolute tolerance, hidden anywhere, breaks the law.
"""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

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
    readings = {"duration": (T, 0, 1), "switching": (np.asarray(m.breakpoints), 0, 1)}
    for order, f in enumerate((m, m.velocity, m.acceleration, m.jerk)):
        readings[f"order {order}"] = (f(MOMENTS * T), 1, -order)
        if type(m).extremes is not r1.curves.Curve.extremes:  # closed forms; interpolants take long
            times, values = m.extremes(order)
            readings[f"extremes {order}"] = (values, 1, -order)
            if order and hasattr(m, "rate"):  # at rest the position is stationary, so that its instants are rounding
                readings[f"instants {order}"] = (times, 0, 1)
    return readings


def law(m):
    peaks = (m.peak(1), m.peak(2), m.peak(3))
    found = {f"peak {i}": (peak.value, 1, -i) for i, peak in enumerate(peaks, 1)}
    return motion(m) | found | {f"peak time {i}": (peak.time, 0, 1) for i, peak in enumerate(peaks, 1)}


def path(p, order=3):
    """What a path is, with s a length."""
    s = MOMENTS * p.end
    found = {f"order {i}": (p.derivative(s, i), 1 - i, 0) for i in range(order + 1)}
    return found | {
        "end": (p.end, 1, 0),
        "length": (p.length, 1, 0),
        "breaks": (p.breakpoints, 1, 0),
        "curvature": (p.curvature(s), -1, 0),
    }


def numbers(**given):
    return {name: (np.asarray(value), *powers) for name, (value, *powers) in given.items()}


def uses(found):
    orders = {"velocity": 1, "acceleration": 2, "jerk": 3, "deceleration": 2, "normal acceleration": 2}
    return {
        f"{i} {d.joint} {d.quantity}": ([d.value, d.limit], 1, -orders[d.quantity]) for i, d in enumerate(found)
    } | {f"{i} {d.joint} {d.quantity} time": (d.time, 0, 1) for i, d in enumerate(found)}


def fastest(found):
    return motion(found.trajectory) | uses(found.active) | {"each": (found.joint_durations, 0, 1)}


MINIMUM = {
    f"minimum_time, {kind}, {coordination}": lambda k, c, kind=kind, coordination=coordination: fastest(
        r1.minimum_time(
            k * Q0, k * Q1, limits(k, c, kind not in ("trapezoidal", "bang_bang")), kind, coordination=coordination
        )
    )
    for kinds, coordination in (
        (("trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine", "cycloidal"), "synchronized"),
        (("trapezoidal", "double_s"), "straight"),
        (("trapezoidal", "double_s"), "independent"),
    )
    for kind in kinds
} | {
    f"minimum_time with velocities, {kind}": lambda k, c, kind=kind: fastest(
        r1.minimum_time(k * Q0, k * Q1, limits(k, c, kind == "double_s"), kind, v0=k / c * V0, v1=k / c * V1)
    )
    for kind in ("trapezoidal", "double_s", "cubic", "septic")
}

LAWS = MINIMUM | {
    "cubic": lambda k, c: motion(r1.cubic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4])),
    "cubic law": lambda k, c: law(r1.cubic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4]).joint(1)),
    "quintic": lambda k, c: motion(r1.quintic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:])),
    "septic": lambda k, c: motion(r1.trajectories.septic(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:])),
    "cosine": lambda k, c: motion(r1.trajectories.cosine(k * Q0, k * Q1, 1.7 * c)),
    "cycloidal": lambda k, c: law(r1.trajectories.cycloidal(k * Q0, k * Q1, 1.7 * c).joint(2)),
    "trapezoidal, A": lambda k, c: motion(
        r1.trapezoidal(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4], acceleration=k / c**2 * 9)
    ),
    "trapezoidal, V": lambda k, c: motion(r1.trapezoidal(k * Q0, k * Q1, 1.7 * c, velocity=k / c * abs(Q1 - Q0))),
    "bang_bang": lambda k, c: motion(r1.trajectories.bang_bang(*states(k, c)[:2], 1.7 * c, *states(k, c)[2:4])),
    "double_s": lambda k, c: motion(
        r1.trajectories.double_s(
            *states(k, c)[:2], 2.7 * c, *states(k, c)[2:4], acceleration=k / c**2 * 5, jerk=k / c**3 * 30
        )
    ),
    "cruise_profile": lambda k, c: law(
        r1.trajectories.cruise_profile(
            -1.3 * k / c, 0.4 * c, acceleration=2 * k / c**2, jerk=7 * k / c**3, start=0.2 * k
        )
    ),
    "polynomial_through": lambda k, c: motion(
        r1.trajectories.polynomial_through(
            [(0, 0, k * Q0), (0, 1, k / c * V0), (0.8 * c, 0, k * Q1), (2 * c, 0, k * Q0)]
        )
    ),
    "polynomial_formula": lambda k, c: numbers(
        c=(list(map(float, r1.trajectories.polynomial_formula((0.3 * k, k / c), (k, 0), 1.7 * c).coefficients)), 1, 0)
    ),
    **{
        f"cubic_spline, {ends}": lambda k, c, ends=ends: motion(r1.cubic_spline(c * TIMES, k * POINTS, bc_type=ends))
        for ends in ("clamped", "natural", "not-a-knot")
    },
    "cubic_spline, periodic": lambda k, c: motion(
        r1.cubic_spline(c * np.append(TIMES, 3.3), k * CLOSED, bc_type="periodic")
    ),
    "cubic_spline with velocities": lambda k, c: motion(
        r1.cubic_spline(c * TIMES, k * POINTS, v0=k / c * V0, a1=k / c**2 * A1)
    ),
    "cubic_hermite_spline": lambda k, c: motion(r1.trajectories.cubic_hermite_spline(c * TIMES, k * POINTS)),
    "polynomial_spline": lambda k, c: motion(r1.trajectories.polynomial_spline(c * TIMES, k * POINTS, (4, 3, 4))),
    "virtual_point_spline": lambda k, c: motion(
        r1.trajectories.virtual_point_spline(c * TIMES, k * POINTS, *states(k, c)[2:])
    ),
    "knot_times": lambda k, c: numbers(
        chord=(r1.trajectories.knot_times(k * POINTS, 2.9 * c), 0, 1),
        centripetal=(r1.trajectories.knot_times(k * POINTS, 2.9 * c, "centripetal"), 0, 1),
    ),
    "parabolic_blends": lambda k, c: motion(
        r1.curves.parabolic_blends(k * POINTS, k / c * np.array([1.0, 0.7, 1.2]), 0.3 * c)
    ),
    "stretched": lambda k, c: motion(r1.curves.stretched(r1.curves.parabolic_blends(k * POINTS, k / c, 0.3 * c), 1.7)),
    "line": lambda k, c: path(r1.line_path(k * Q0, k * Q1)),
    "arc": lambda k, c: path(r1.curves.arc_through(*(k * POINTS[:3]))),
    "arc about a centre": lambda k, c: path(r1.curves.arc_path(k * Q0[:2], k * Q1[:2], -2.1)),
    "circle": lambda k, c: path(r1.curves.circle_path(k * Q0, 0.7 * k, normal=[1, 2, 3])),
    "helix": lambda k, c: path(r1.curves.helix_path([0, 0, 0.1 * k], [0.5 * k, 0, 0.1 * k], 0.2 * k, 1.5)),
    "polyline, circular": lambda k, c: path(r1.curves.polyline_path(k * POINTS, blend=0.2 * k)),
    "polyline, radius": lambda k, c: path(r1.curves.polyline_path(k * POINTS, radius=0.1 * k)),
    "polyline, parabolic": lambda k, c: path(r1.curves.polyline_path(k * POINTS, blend=0.2 * k, kind="parabolic")),
    **{
        f"spline_path, {ends}": lambda k, c, ends=ends: path(r1.trajectories.spline_path(k * CLOSED, bc_type=ends))
        for ends in ("natural", "not-a-knot", "periodic")
    },
    "by_arc_length": lambda k, c: path(
        r1.curves.by_arc_length(r1.trajectories.spline_path(k * POINTS, knots=k * np.array([0, 1, 3, 4])))
    ),
    "ellipse by arc length": lambda k, c: path(
        r1.curves.by_arc_length(r1.curves.ellipse_path(k * Q0[:2], [0.9 * k, 0], [0, 0.2 * k]))
    ),
    "formula_path": lambda k, c: path(
        r1.curves.formula_path(["R*cos(s/R)", "s + s**2/R"], "s", 2.1 * k, values={"R": 0.7 * k})
    ),
    "paths in a row": lambda k, c: path(
        r1.curves.CurveSequence(
            (r1.line_path(k * Q0, k * Q1), r1.curves.arc_through(k * Q1, k * POINTS[0], k * POINTS[3]))
        )
    ),
    "frenet_frame": lambda k, c: frenet(r1.curves.frenet_frame(r1.trajectories.spline_path(k * POINTS), 1.7 * k)),
    "frenet_path": lambda k, c: turning(
        r1.curves.frenet_path(r1.curves.helix_path([0, 0, 0], [0.5 * k, 0, 0], 0.2 * k, 1.5))
    ),
    "path and law": lambda k, c: motion(timed(k, c)),
    "path by arc length and law": lambda k, c: motion(
        r1.curves.PathTrajectory(
            p := r1.curves.by_arc_length(r1.trajectories.spline_path(k * POINTS)), r1.quintic(0, p.end, 2 * c).joint()
        )
    ),
    "polyline and law": lambda k, c: motion(blended(k, c)),
    "peak_norm": lambda k, c: {
        name: reading
        for quantity, order in (("velocity", 1), ("acceleration", 2), ("jerk", 3), ("normal acceleration", 2))
        for peak in [r1.trajectories.peak_norm(timed(k, c), quantity)]
        for name, reading in ((quantity, (peak.value, 1, -order)), (quantity + " time", (peak.time, 0, 1)))
    },
    "acceleration_split": lambda k, c: numbers(
        tangential=(r1.trajectories.acceleration_split(timed(k, c), 0.7 * c).tangential, 1, -2),
        normal=(r1.trajectories.acceleration_split(timed(k, c), 0.7 * c).normal, 1, -2),
    ),
    "timing_bounds": lambda k, c: bounds(
        r1.trajectories.timing_bounds(r1.trajectories.spline_path(k * POINTS), 0.5 * k / c, 3 * k / c**2)
    ),
    "scale_to_limits": lambda k, c: scaled(
        r1.trajectories.scale_to_limits(r1.quintic(k * Q0, k * Q1, 1.7 * c), limits(k, c))
    ),
    "scale_to_limits of a norm": lambda k, c: scaled(
        r1.trajectories.scale_to_limits(
            timed(k, c), r1.trajectories.NormLimits(k / c, 2 * k / c**2, 9 * k / c**3, 1.5 * k / c**2)
        )
    ),
    "minimum_duration": lambda k, c: numbers(
        T=(
            r1.trajectories.minimum_duration(
                lambda T: r1.quintic(k * Q0, k * Q1, T, k / c * V0, k / c * V1), limits(k, c)
            ),
            0,
            1,
        )
    ),
    "minimum_duration of a spline": lambda k, c: numbers(
        T=(
            r1.trajectories.minimum_duration(
                lambda T: r1.cubic_spline(T * TIMES / 2.9, k * POINTS, v0=k / c * V0), limits(k, c)
            ),
            0,
            1,
        )
    ),
    "time_optimal": lambda k, c: quickest(k, c, r1.trajectories.spline_path(k * P)),
    "time_optimal by arc length": lambda k, c: quickest(
        k, c, r1.curves.by_arc_length(r1.trajectories.spline_path(k * P))
    ),
    "time_optimal blends": lambda k, c: quickest(
        k, c, r1.curves.polyline_path(k * P[:3], blend=0.3 * k, kind="parabolic")
    ),
    "time_optimal a spline of time": lambda k, c: quickest(
        k, c, r1.cubic_spline(c * TIMES, k * P, v0=k / c, v1=-k / c)
    ),
}


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
    curve = r1.trajectories.spline_path(k * POINTS)
    return r1.curves.PathTrajectory(curve, r1.trapezoidal(0, curve.end, 2 * c, velocity=0.8 * curve.end / c).joint())


def blended(k, c):
    line = r1.curves.polyline_path(k * POINTS, blend=0.2 * k)
    return r1.curves.PathTrajectory(line, r1.minimum_time(0, line.end, r1.MotionLimits(k / c, 2 * k / c**2)).laws[0])


def bounds(b):
    return numbers(
        velocity=(b.velocity, 1, -1), acceleration=(b.acceleration, 1, -2),
        fastest_at=(b.fastest_at, 1, 0), tightest_at=(b.tightest_at, 1, 0),
    )  # fmt: skip


def scaled(found):
    return motion(found.trajectory) | uses(found.uses) | numbers(factor=(found.factor, 0, 0))


def scaled_by_nature(k, c):
    """A motion of one unit of time, scaled to bounds in another: only the factor takes up the difference."""
    found = r1.trajectories.scale_to_limits(r1.quintic(k * Q0, k * Q1, 1.7), limits(k, c))
    return motion(found.trajectory)


def joins(k, c):
    """Pieces that join with continuous velocities and a jump of the acceleration, and one where nothing jumps."""
    first = r1.cubic(k * Q0, k * Q1, 1.1 * c, 0, k / c * V1)
    second = r1.cubic(k * Q1, k * POINTS[0], 0.9 * c, k / c * V1, 0)
    third = r1.quintic(k * POINTS[0], k * Q0, 1.3 * c, 0, 0, second.acceleration(0.9 * c, side="left"))
    row = r1.curves.CurveSequence((first, second, third))
    found = motion(row) | {"continuity": ([join.continuity for join in row.joins], 0, 0)}
    for i, join in enumerate(row.joins):
        found[f"join {i}"] = (join.time, 0, 1)
        found |= {f"jump {i} {order}": (jump, 1, -order) for order, jump in enumerate(join.jumps)}
    return found


def quickest(k, c, curve):
    pytest.importorskip("toppra")
    found = r1.trajectories.time_optimal(curve, r1.MotionLimits([2 * k / c] * 2, [5 * k / c**2] * 2), grid=100)
    T = found.duration
    return numbers(
        T=(T, 0, 1), q=(found.trajectory(MOMENTS * T), 1, 0), v=(found.trajectory.velocity(MOMENTS * T), 1, -1)
    )


def arm(k):
    """R P in the plane, with lengths in the unit k."""
    rows = [("R", 0, np.pi / 2, 0.1 * k, 0), ("P", 0, 0, 0, 0)]
    return r1.robot_from_dh(rows, lower=[-3, 0.2 * k], upper=[3, 0.9 * k])


def units(k):
    """What counts as one of each joint of that arm."""
    return np.array([1, k])


def beyond(k, c):
    """A motion that passes the limits of a prismatic joint by a thousandth, and one that touches them."""
    robot, start = arm(k), units(k) * [0, 0.3]
    found = {}
    for name, end in (("beyond", 0.9009), ("touching", 0.9)):
        violations = r1.trajectories.limit_violations(robot, r1.quintic(start, units(k) * [1, end], c))
        found[name] = (len(violations), 0, 0)
        found |= {f"{name} {v.quantity}": ([v.value, v.limit], 1, 0) for v in violations}
    return found


def following(k, c):
    """The tool of the arm goes along a line; its joints are compared in their own units."""
    robot, q0 = arm(k), units(k) * [0.2, 0.5]
    task = r1.PositionTask("xy")
    start = task.value(robot, q0)
    line = r1.line_path(start, start + k * np.array([0.05, 0.1]))
    motion = r1.curves.PathTrajectory(line, r1.quintic(0, line.end, 2 * c).joint())
    found = r1.follow_trajectory(robot, task, motion, q0, gain=3 / c)
    t = MOMENTS * 2 * c
    return {
        "q": (found(t) / units(k), 0, 0),
        "v": (found.velocity(t) / units(k), 0, -1),
        "verdict": (found.status.name == "FOLLOWS", 0, 0),
    }


def meeting(k, c):
    """A target that moves along a line is met when it crosses x = 0.3."""
    robot = r1.robot_from_dh([("R", 0.5 * k, 0, 0, 0), ("R", 0.4 * k, 0, 0, 0)])
    target = r1.LinearMotion(k * np.array([0.1, 0.5]), k / c * np.array([0.2, 0.05]))
    found = r1.rendezvous(robot, r1.PositionTask("xy"), target, [0.1, 0.4], lambda t, p: p[0] - 0.3 * k, horizon=3 * c)
    order = sorted(found.branches, key=lambda branch: branch.q[1])
    return {
        "time": (found.time, 0, 1),
        "position": (found.position, 1, 0),
        "q": ([branch.q for branch in order], 0, 0),
        "qdot": ([branch.qdot for branch in order], 0, -1),
    }


def tracking(k, c):
    wanted = r1.quintic(k * Q0, k * Q1, 1.7 * c)
    run = r1.simulate_tracking(wanted, k * (Q0 + 0.1), 2 / c, rate_limits=1.2 * k / c, samples=31)
    choice = r1.control.smallest_gain(wanted, k * (Q0 + 0.1), 1e-3 * k)
    return {
        "t": (run.t, 0, 1),
        "q": (run.q, 1, 0),
        "command": (run.command, 1, -1),
        "gain": (choice.gain, 0, -1),
        "verdict": (choice.status.name == "FEEDBACK", 0, 0),
    }


LAWS |= {
    "scale_to_limits, other units": scaled_by_nature,
    "joins": joins,
    "limit_violations": beyond,
    "follow_trajectory": following,
    "rendezvous": meeting,
    "simulate_tracking, smallest_gain": tracking,
}
INTEGRATED = ("follow_trajectory", "simulate_tracking, smallest_gain")  # to 1e-10 a step
PLAIN = {}


def assert_law_of_units(name, k, c):
    plain = PLAIN[name] if name in PLAIN else PLAIN.setdefault(name, LAWS[name](1.0, 1.0))
    found = LAWS[name](k, c)
    assert found.keys() == plain.keys()
    precision = 1e-8 if name in INTEGRATED else 1e-9
    for what, (value, length, time) in found.items():
        wanted, scale = np.asarray(plain[what][0], dtype=float), k**length * c**time
        near = pytest.approx(wanted, rel=0, abs=precision * np.abs(wanted).max(initial=0))
        assert np.shape(value) == wanted.shape, what
        assert np.asarray(value) / scale == near, what


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize(("k", "c"), [(1e-6, 7.3), pytest.param(31_623.0, 1e-6, marks=pytest.mark.sweep)])
def test_answers_scale_with_the_units_of_length_and_time(name, k, c):
    assert_law_of_units(name, k, c)


@pytest.mark.fuzz
@pytest.mark.parametrize("name", LAWS)
@settings(max_examples=20)
@given(k=factors, c=factors)
def test_answers_scale_with_any_units(name, k, c):
    assert_law_of_units(name, k, c)


@pytest.mark.parametrize("k", [1e-6, 1e-5, 1e-3, 1e-2, 1.0, 1e4, 1e6])
def test_the_least_time_along_a_spline_does_not_depend_on_the_unit_of_length(k):
    pytest.importorskip("toppra")
    found = r1.trajectories.time_optimal(
        r1.trajectories.spline_path(P * k), r1.MotionLimits(velocity=[2 * k] * 2, acceleration=[5 * k] * 2)
    )
    assert found.duration == pytest.approx(2.7330, abs=5e-5)


@pytest.mark.parametrize("length", [1e-5, 1.0, 1e5])
def test_a_line_takes_two_roots_of_its_length_over_the_acceleration(length):
    """2 √(L/A), where the velocity is hardly bounded."""
    pytest.importorskip("toppra")
    limits = r1.MotionLimits(velocity=[1e3 * length] * 2, acceleration=[length] * 2)
    found = r1.trajectories.time_optimal(r1.line_path([0, 0], [length, 0]), limits)
    assert found.duration == pytest.approx(2.0, rel=1e-4)


def test_the_least_time_along_a_path_does_not_depend_on_the_units_of_single_joints():
    """With knots that do not depend on lengths, one joint may be in micrometres and another in kilometres."""
    pytest.importorskip("toppra")
    k = np.array([1e-6, 1e3])
    found = [
        r1.trajectories.time_optimal(
            r1.trajectories.spline_path(P * unit, knots="uniform"), r1.MotionLimits(2 * unit, 5 * unit)
        ).duration
        for unit in (np.ones(2), k)
    ]
    assert found[1] == pytest.approx(found[0], rel=1e-9)


@pytest.mark.parametrize("k", [1e-12, 1e-6, 1.0, 1e6])
def test_a_periodic_spline_that_is_open_by_a_hundredth_is_refused_in_any_unit(k):
    points = k * np.array([[0.3, 0.1], [1.2, 0.4], [0.3, 0.101]])
    with pytest.raises(r1.InputError, match="ends where it begins"):
        r1.cubic_spline([0, 1, 2], points, bc_type="periodic")


def test_the_joints_may_be_permuted_and_time_reversed():
    """Least times are those of the permuted joints, and from rest to rest those of the way back."""
    order = [2, 0, 1]
    bounds = r1.MotionLimits(VELOCITY, ACCELERATION)
    there = r1.minimum_time(Q0, Q1, bounds)
    swapped = r1.minimum_time(Q0[order], Q1[order], r1.MotionLimits(VELOCITY[order], ACCELERATION[order]))
    back = r1.minimum_time(Q1, Q0, bounds)
    t = MOMENTS * there.duration
    assert swapped.trajectory(t) == pytest.approx(there.trajectory(t)[:, order], abs=1e-12)
    assert back.trajectory(there.duration - t) == pytest.approx(there.trajectory(t), abs=1e-12)


@pytest.mark.parametrize("b", [-1e3, 1e-3, 7.3, 1e6])
def test_a_motion_elsewhere_is_the_same_motion_moved(b):
    """q → q + b: times and velocities stay, but for the rounding of q + b."""
    for moved, plain in (
        (r1.minimum_time(Q0 + b, Q1 + b, limits(1, 1), "double_s"), r1.minimum_time(Q0, Q1, limits(1, 1), "double_s")),
        (r1.quintic(Q0 + b, Q1 + b, 1.7, V0, V1), r1.quintic(Q0, Q1, 1.7, V0, V1)),
        (r1.cubic_spline(TIMES, POINTS + b), r1.cubic_spline(TIMES, POINTS)),
        (r1.curves.parabolic_blends(POINTS + b, 1.0, 0.3), r1.curves.parabolic_blends(POINTS, 1.0, 0.3)),
    ):
        m, p = (getattr(found, "trajectory", found) for found in (moved, plain))
        rounding = 1e-13 * (1 + abs(b))
        assert m.duration == pytest.approx(p.duration, abs=100 * rounding)
        t = MOMENTS * min(m.duration, p.duration)
        assert m(t) - b == pytest.approx(p(t), abs=100 * rounding)
        assert m.velocity(t) == pytest.approx(p.velocity(t), abs=1000 * rounding)
