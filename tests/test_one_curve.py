"""One notion of a curve: what makes a motion and what takes one go together, and every order of derivative is known."""

import pickle

import numpy as np
import pytest
import sympy
from arms import arm
from scipy.interpolate import BPoly, CubicSpline, PPoly

import robotics1 as r1

ROBOT, XY = arm("planar_2r"), r1.PositionTask("xy")
LIMITS = r1.MotionLimits([1, 2], [3, 5])
START, END = [0.1, 1.2], [0.5, 0.7]


class Swing:
    """A motion of the user's own class."""

    duration = 2.0

    def __call__(self, t):
        return np.stack([np.sin(t), 1.2 + 0.1 * np.asarray(t)], axis=-1)

    def velocity(self, t, *, side="right"):
        return np.stack([np.cos(t), 0.1 + 0 * np.asarray(t)], axis=-1)

    def acceleration(self, t, *, side="right"):
        return np.stack([-np.sin(t), 0 * np.asarray(t)], axis=-1)

    def jerk(self, t, *, side="right"):
        return np.stack([-np.cos(t), 0 * np.asarray(t)], axis=-1)


def followed():
    line = r1.line_path(XY.value(ROBOT, START), XY.value(ROBOT, END))
    return r1.follow_trajectory(
        ROBOT, XY, r1.curves.PathTrajectory(line, r1.minimum_time(0, line.end, r1.MotionLimits(1, 2))), START
    )


MAKERS = {
    "cubic": lambda: r1.cubic(START, END, 1.5),
    "cosine": lambda: r1.trajectories.cosine(START, END, 1.5),
    "trapezoidal": lambda: r1.trapezoidal(START, END, 1.5, acceleration=2),
    "minimum_time": lambda: r1.minimum_time(START, END, LIMITS),
    "time_optimal": lambda: r1.trajectories.time_optimal(
        r1.trajectories.spline_path([START, [0.2, 0.9], END]), LIMITS, grid=20
    ),
    "scale_to_limits": lambda: r1.trajectories.scale_to_limits(r1.quintic(START, END, 1.5), LIMITS),
    "spline": lambda: r1.cubic_spline([0, 1, 2], [START, [0.2, 0.9], END]),
    "blends": lambda: r1.curves.parabolic_blends([START, [0.2, 0.9], END], 0.5, 0.1),
    "segments": lambda: r1.trajectories.linear_segments_with_blends(
        [0, 1, 2], [START, [0.2, 0.9], END], acceleration=9
    ),
    "path": lambda: r1.line_path(START, END),
    "sequence": lambda: r1.curves.CurveSequence((r1.cubic(START, END, 1.0), r1.cubic(END, START, 1.0))),
    "stack": lambda: r1.curves.JointTrajectory((r1.cubic(0.1, 0.5, 1.5), r1.trajectories.bang_bang(1.2, 0.7, 1.5))),
    "rendezvous": lambda: r1.rendezvous(ROBOT, XY, r1.LinearMotion([1.0, 1.0], [0.1, 0]), START, 1.0),
    "follow_trajectory": followed,
    "own class": Swing,
}
TAKERS = {
    "PathTrajectory": lambda motion, folder: r1.curves.PathTrajectory(
        r1.curves.by_arc_length(r1.line_path([0, 0], [9, 0])), motion
    ),
    "stretched": lambda motion, folder: r1.curves.stretched(motion, 2.0).velocity(0.3),
    "scale_to_limits": lambda motion, folder: r1.trajectories.scale_to_limits(motion, LIMITS),
    "limit_violations": lambda motion, folder: r1.trajectories.limit_violations(ROBOT, motion),
    "peak_norm": lambda motion, folder: r1.trajectories.peak_norm(motion),
    "simulate_tracking": lambda motion, folder: r1.simulate_tracking(motion, START, 2.0, samples=5),
    "TaskTrajectory": lambda motion, folder: r1.trajectories.TaskTrajectory(ROBOT, XY, motion).acceleration(0.3),
    "CurveSequence": lambda motion, folder: r1.curves.CurveSequence((motion, motion), jumps=True).joins,
    "plot_trajectory": lambda motion, folder: r1.plot_trajectory(motion, file=folder / "a.svg", robot=ROBOT),
    "plot_path": lambda motion, folder: r1.plot_path(motion, file=folder / "b.svg"),
    "animate": lambda motion, folder: r1.animate(ROBOT, motion, folder / "c.html"),
}


@pytest.mark.parametrize("maker", MAKERS)
def test_whatever_takes_a_motion_takes_every_motion(maker, tmp_path):
    motion = MAKERS[maker]()
    for name, take in TAKERS.items():
        if name == "PathTrajectory":
            with pytest.raises(r1.InputError, match="law must be a timing law"):  # it has two coordinates
                take(motion, tmp_path)
        else:
            take(motion, tmp_path)


@pytest.mark.parametrize(
    "law", [r1.cubic(0, 2, 3), r1.minimum_time(0, 2, r1.MotionLimits(1, 2)), r1.trajectories.cosine(0, 2, 1)]
)
def test_a_path_takes_the_law_of_one_joint_whatever_has_made_it(law):
    motion = r1.curves.PathTrajectory(r1.line_path([0, 0], [2, 0]), law)
    t = np.linspace(0, motion.duration, 9)
    found = getattr(law, "trajectory", law)
    assert motion(t)[:, 0] == pytest.approx(found(t)[:, 0], abs=1e-12)


# --- SciPy


def test_a_spline_is_scipys_there_and_back():
    x, y = [0, 0.7, 2.0, 2.5], np.random.default_rng(3).normal(size=(4, 2))
    scipys = CubicSpline(x, y)
    spline = r1.curves.PiecewisePolynomial.from_ppoly(scipys)
    back = spline.to_ppoly()
    assert isinstance(back, PPoly)
    assert back.c == pytest.approx(scipys.c)
    assert back.x == pytest.approx(scipys.x)
    t = np.linspace(0, 2.5, 17)
    for order in range(5):
        assert spline.derivative(t, order) == pytest.approx(scipys(t, order), abs=1e-12)
    law = r1.curves.PiecewisePolynomial.from_ppoly(
        PPoly.from_bernstein_basis(BPoly.from_derivatives([0, 2], [[0, 1], [3, 0]]))
    )
    assert law(1.0) == pytest.approx(r1.cubic(0, 3, 2, 1, 0)(1.0)[0])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: r1.curves.PiecewisePolynomial.from_ppoly(CubicSpline([1, 2, 3], [0, 1, 0])), "begins at x = 0"),
        (lambda: r1.curves.PiecewisePolynomial.from_ppoly("spline"), "must be a PPoly"),
        (lambda: r1.minimum_time(0, 0, r1.MotionLimits(1, 1)).trajectory.joint().to_ppoly(), "without duration"),
        (lambda: r1.curves.PiecewisePolynomial(np.ones((2, 2)), [1.0]), r"durations must have shape \(2,"),
        (lambda: r1.curves.PiecewisePolynomial(np.ones((2, 2)), [1.0, 0.0]), "durations must be positive"),
        (lambda: r1.cubic_spline([0, 1, 2], [0, 1, 0]).coefficients, "several polynomials"),
        (lambda: r1.curves.CurveSequence((r1.cubic(0, 1, 1), r1.cubic(2, 1, 1))), "begins 1 from there"),
        (lambda: r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0).extremes(), "no least and no largest value"),
        (lambda: r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0).curvature(0.5), "have no curvature"),
    ],
    ids=range(9),
)
def test_what_is_no_curve_is_an_input_error(call, message):
    with pytest.raises(r1.InputError, match=message):
        call()


# --- any order


@pytest.mark.parametrize("order", range(1, 7))
def test_derivatives_of_a_composition_of_any_order_are_sympys(order):
    """p(s) = (cos 2s, s³) with the quintic s(t)."""
    s, t = sympy.symbols("s t")
    path = r1.curves.formula_path([sympy.cos(2 * s), s**3], s, 2.0)
    law = r1.quintic(0.1, 1.9, 3.0, 0.2, 0.1)
    motion = r1.curves.PathTrajectory(path, law)
    inner = sum(float(c) * t**k for k, c in enumerate(law.coefficients_t[:, 0]))
    for instant in (0.4, 1.7):
        wanted = [float(f.subs(s, inner).diff(t, order).subs(t, instant)) for f in path.formula]
        assert motion.derivative(instant, order) == pytest.approx(wanted, rel=1e-10, abs=1e-10)


@pytest.mark.parametrize("order", range(4))
def test_extremes_of_a_harmonic_curve_are_those_of_dense_samples(order):
    curve = r1.curves.ellipse_path([0.3, -0.2], [2, 0.5], [-0.25, 1], angle=5.0)
    times, values = curve.extremes(order)
    dense = curve.derivative(np.linspace(0, 5, 200_001), order)
    assert values == pytest.approx(np.array([dense.min(axis=0), dense.max(axis=0)]), abs=1e-9)
    for row in range(2):
        assert [curve.derivative(times[row, j], order)[j] for j in range(2)] == pytest.approx(values[row])


def test_the_numbers_of_a_curve_cannot_be_written():
    for array in (r1.cubic([0, 1], [1, 2], 1.0).c, r1.curves.circle_path([0, 0], 1.0).a):
        with pytest.raises(ValueError, match="read-only"):
            array[:] = 0.0


def test_a_motion_of_the_users_class_keeps_its_breakpoints_when_it_is_wrapped_and_pickled():
    slow = r1.curves.stretched(Swing(), 2.0)
    assert slow.breakpoints.size == 0
    assert pickle.loads(pickle.dumps(slow)).velocity(1.0) == pytest.approx(Swing().velocity(0.5) / 2)
