"""Whatever is handed to the public functions: a right answer or a Robotics1Error, never another exception or a crash.

The properties run in one child process, `python tests/test_misuse.py`, so that a crash of the interpreter is a failure
of the test; each says its name when it holds.
"""

import subprocess
import sys
import traceback
from math import inf, nan
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from hypothesis import HealthCheck, Phase, given, settings, strategies as st

import robotics1 as r1

PROPERTIES = {}


def holds(examples=25, **strategies):
    """Register a property of arguments drawn from the strategies."""
    fixed = {"deadline": None, "derandomize": True, "database": None, "suppress_health_check": list(HealthCheck)}
    quick = {"phases": [Phase.generate, Phase.shrink], "report_multiple_bugs": False}
    chosen = settings(max_examples=examples, **fixed, **quick)

    def register(function):
        PROPERTIES[function.__name__] = chosen(given(**strategies)(function))
        return function

    return register


# --- what is handed in

NUMBERS = st.sampled_from([0.0, 1.0, -1.0, 0.5, 2, 1e-300, 1e6, 1e9, -1e9, nan, inf, -inf, 10**400, True])
WORDS = st.sampled_from(["", "tool", "tol", "world", "base", "q1", "xy", "newton", "search", "1", "nan", "\x00", "é"])


def nothing(*_):
    """A function that takes anything; `print` would write where the names of the properties go."""


ODD = st.sampled_from([None, 1j, b"tool", object(), {}, {"q1": 1.0}, {1, 2}, range(3), nothing, Path("x")])
NESTED = st.sampled_from([[[1.0], [1.0, 2.0]], [None], [1, "2"], [1j], [[[]]], [np.zeros(2), 1], [{}]])
KINDS = st.sampled_from([np.array(3), np.array(["a"]), np.array([None, 1]), np.ones((1, 2, 3)), np.datetime64(0, "s")])
LISTS = st.lists(NUMBERS, max_size=5)
ARRAYS = st.builds(np.zeros, st.tuples(st.integers(0, 4), st.integers(0, 4)))
JUNK = st.one_of(NUMBERS, WORDS, ODD, NESTED, KINDS, LISTS, ARRAYS, LISTS.map(tuple))
FEW = st.sampled_from([None, 0, 1, 2, 5, -1, 1.5, True, "3", nan, np.int64(3), np.float64(2), [2], 1j, b"2"])  # counts
BOXES = st.one_of(ODD, NESTED, JUNK.map(lambda value: {"q1": value}))
GOOD = st.integers(-16, 16).map(lambda n: n / 8)  # exact in float32 too
FORMS = (
    *(list, tuple, np.array, np.float32, np.longdouble),
    lambda x: np.array(x, dtype=object),
    lambda x: np.repeat(x, 2)[::2],
    lambda x: [np.float32(value) for value in x],
    lambda x: [int(value) if value == int(value) else value for value in x],
)


def forms(n):
    """Good numbers (n,), and one of the forms in which they may come."""
    values = st.tuples(*[GOOD] * n)
    return st.tuples(values, st.sampled_from(FORMS)).map(lambda drawn: (np.array(drawn[0]), drawn[1](drawn[0])))


def answer(function, *arguments, **options):
    """What a function returns, or None if it refuses."""
    try:
        return function(*arguments, **options)
    except r1.Robotics1Error:
        return None


# --- loading

CHOICES = st.sampled_from(["prr", "planar_2r", "cylindrical"])
OPTIONS = st.sampled_from(["parameters", "base", "tool", "locked", "packages", "trusted"])


@holds(source=JUNK)
def a_source_is_a_robot_or_refused(source):
    robot = answer(r1.load_robot, source)
    assert robot is None or robot.nv >= 1


@holds(150, name=CHOICES, option=OPTIONS, value=JUNK)
def options_of_loading_are_refused_or_do_no_harm(name, option, value):
    robot = answer(r1.load_robot, name, **{option: value})
    assert robot is None or robot.nv <= 3


@holds(150, name=CHOICES, option=st.sampled_from(["parameters", "locked"]), key=WORDS | st.none() | NUMBERS, value=JUNK)
def values_by_name_are_refused_or_do_no_harm(name, option, key, value):
    robot = answer(r1.load_robot, name, **{option: {key: value}})
    assert robot is None or robot.nv <= 3


# --- kinematics


@holds(150, q=JUNK)
def a_configuration_is_refused_or_right(q):
    for function in (r1.forward_kinematics, r1.frame_jacobian, r1.PositionTask().value):
        found = answer(function, arm("spatial"), q)
        if found is not None:
            wanted = function(arm("spatial"), np.array(q, dtype=float))
            assert found == wanted if isinstance(found, pin.SE3) else np.array_equal(found, wanted, equal_nan=True)
    assert answer(arm("spatial").within_limits, q) in (None, True, False)


@holds(q=forms(5))
def every_form_of_a_configuration_gives_the_float64_answer(q):
    plain, formed = q
    robot = arm("spatial")
    assert r1.forward_kinematics(robot, formed) == r1.forward_kinematics(robot, plain)
    assert np.array_equal(r1.frame_jacobian(robot, formed), r1.frame_jacobian(robot, plain))
    for task in (r1.PositionTask("xz"), r1.OrientationTask()):
        assert np.array_equal(task.value(robot, formed), task.value(robot, plain))
        assert np.array_equal(task.jacobian(robot, formed), task.jacobian(robot, plain))


@holds(name=st.sampled_from(["prr", "planar_2r", "one_joint", "six_r", "redundant"]), other=st.integers(1, 8))
def another_robots_configuration_is_refused(name, other):
    robot = arm(name)
    found = answer(r1.frame_jacobian, robot, np.zeros(other), frame=robot.frame_names[-1])
    assert (found is None) == (other != robot.nv)
    assert found is None or found.shape == (6, robot.nv)


@holds(150, frame=JUNK, reference=JUNK)
def a_frame_is_one_of_the_robots_or_refused(frame, reference):
    robot, q = arm("spatial"), np.zeros(5)
    known = (None, *robot.frame_names, *robot.model.names)
    for function in (r1.forward_kinematics, r1.frame_jacobian):
        found = answer(function, robot, q, frame=frame)
        assert (found is not None) == (frame is None or (isinstance(frame, str) and frame in known))
    J = answer(r1.frame_jacobian, robot, q, reference=reference)
    assert J is None or reference is None or (isinstance(reference, str) and reference in (*known, "world", "tool"))


# --- tasks

TASKS = {
    "position": r1.PositionTask(),
    "plane": r1.PlanarPoseTask(),
    "orientation": r1.OrientationTask(),
    "pose": r1.PoseTask(),
    "function": r1.FunctionTask(lambda p, R, q: p[:2], rows=2),
}


@holds(150, kind=st.sampled_from([r1.PositionTask, r1.PlanarPoseTask, r1.OrientationTask, r1.PoseTask]), junk=JUNK)
def a_task_of_odd_options_is_refused_when_made_or_used(kind, junk):
    options = ["frame", "reference", *[name for name in ("axes", "plane") if name in kind.__dataclass_fields__]]
    for option in options:
        task = answer(kind, **{option: junk})
        if task is not None:
            J = answer(task.jacobian, arm("planar_2r"), [0.1, 0.2])
            assert J is None or (J.shape == (task.rows, 2) and np.isfinite(J).all())
            answer(task.check_integrable, arm("planar_2r"))


@holds(150, name=st.sampled_from(sorted(TASKS)), target=JUNK)
def a_target_is_refused_or_gives_a_finite_error(name, target):
    e = answer(TASKS[name].error, arm("planar_2r"), [0.1, 0.2], target)
    assert e is None or (e.shape == (TASKS[name].rows,) and not np.isnan(e).any())


@holds(rows=st.one_of(FEW, JUNK), returned=JUNK)
def a_function_task_is_refused_or_returns_what_its_function_does(rows, returned):
    task = answer(r1.FunctionTask, lambda *_: returned, rows)
    if task is not None:
        value = answer(task.value, arm("planar_2r"), [0, 0])
        assert value is None or np.array_equal(value, np.array(returned, dtype=float))
        answer(task.jacobian, arm("planar_2r"), [0, 0])


@holds(150, J=JUNK, f=JUNK)
def a_matrix_is_refused_or_has_subspaces_and_torques(J, f):
    s = answer(r1.subspaces, J)
    if s is not None:
        m, n = np.shape(J)
        assert (s.range.shape, s.null.shape) == ((m, s.rank), (n, n - s.rank))
        answer(s.contains, f)
    tau = answer(r1.balancing_torque, J, f)
    assert tau is None or np.array_equal(tau, -np.array(J, dtype=float).T @ np.array(f, dtype=float))


@holds(J=forms(2), f=forms(1))
def every_form_of_a_force_gives_the_float64_torque(J, f):
    assert np.array_equal(r1.balancing_torque([J[1]], f[1]), -J[0] * f[0])


@holds(25, samples=FEW, seed=FEW, box=BOXES, method=JUNK)
def singularities_are_found_or_refused(samples, seed, box, method):
    found = answer(r1.find_singularities, arm("planar_2r"), TASKS["position"], samples=samples, seed=seed)
    assert found is None or found.generic_rank == 2
    for options in ({"box": box}, {"method": method}):
        answer(r1.find_singularities, arm("planar_2r"), r1.PositionTask("xy"), samples=2, **options)


# --- inverse kinematics


def iterated(task, **changed):
    options = {"target": [1.0, 0.5][: task.rows], "q0": [0.1, 0.4], "max_iterations": 5} | changed
    return answer(r1.iterate_ik, arm("planar_2r"), task, options.pop("target"), options.pop("q0"), **options)


@holds(150, option=st.sampled_from(["target", "q0", "method", "tolerance", "gain", "damping"]), junk=JUNK, count=FEW)
def an_iteration_runs_or_is_refused(option, junk, count):
    for axes in ("xy", "x"):
        for method in ("damped", "newton", "gradient", "pseudoinverse"):
            run = iterated(r1.PositionTask(axes), **{"method": method, option: junk})
            assert run is None or (run.iterations <= 5 and np.isfinite(run.q).all())
    run = iterated(r1.PositionTask("xy"), method="damped", max_iterations=count)
    assert run is None or run.iterations <= count


@holds(q0=forms(2), target=forms(2))
def every_form_of_a_start_and_a_target_gives_the_float64_iteration(q0, target):
    a, b = (iterated(r1.PositionTask("xy"), q0=q0[i], target=target[i], method="damped") for i in (0, 1))
    assert np.array_equal([*a.q, a.iterations], [*b.q, b.iterations])


@holds(target=JUNK, starts=FEW, seed=FEW, box=BOXES)
def solutions_are_found_or_the_question_is_refused(target, starts, seed, box):
    task = r1.PositionTask("xy")
    for wanted, options in ((target, {}), ([1, 1], {"starts": starts, "seed": seed}), ([1, 1], {"box": box})):
        found = answer(r1.ik_solutions, arm("planar_2r"), task, wanted, **{"starts": 2} | options)
        for q in () if found is None else found.q:
            assert task.value(arm("planar_2r"), q) == pytest.approx(wanted, abs=1e-6)


# --- motion


@holds(150, q0=JUNK, q1=JUNK, duration=JUNK, v=JUNK, t=JUNK)
def a_cubic_is_refused_or_goes_from_start_to_end(q0, q1, duration, v, t):
    for arguments in ((q0, q1, 1), ([0, 1], [1, 2], duration), ([0, 1], [1, 2], 2, v, v), (q0, q0, 2, 0, v)):
        trajectory = answer(r1.cubic, *arguments)
        if trajectory is not None:
            assert np.array_equal(trajectory(0), np.atleast_1d(np.array(arguments[0], dtype=float)))
            answer(trajectory, t)


@holds(q0=forms(3), q1=forms(3), v=forms(3))
def every_form_of_states_gives_the_float64_cubic(q0, q1, v):
    a, b = (r1.cubic(q0[i], q1[i], 2, v[i], v[i]) for i in (0, 1))
    assert np.array_equal(a.coefficients, b.coefficients)


@holds(8, p0=JUNK, v=JUNK, q0=JUNK, meet=JUNK, qdot0=JUNK, horizon=JUNK)
def a_rendezvous_is_found_or_refused(p0, v, q0, meet, qdot0, horizon):
    robot, task, straight = arm("planar_2r"), r1.PositionTask("xy"), r1.LinearMotion([1, 0.5], [0.1, 0])
    motion = answer(r1.LinearMotion, p0, v)
    for arguments in ((motion, [0, 0], 1), (straight, q0, 1), (straight, [0, 0], meet), (p0, [0, 0], 1)):
        found = answer(r1.rendezvous, robot, task, *arguments)
        assert found is None or found.time > 0
    answer(r1.rendezvous, robot, task, straight, [0, 0], 1, qdot0=qdot0)
    answer(r1.rendezvous, robot, task, straight, [0, 0], lambda t, p: p[0] - 1.05, horizon=horizon)
    answer(r1.rendezvous, robot, task, straight, [0, 0], lambda t, p: meet)
    answer(r1.rendezvous, robot, task, r1.trajectories.FunctionMotion(lambda t: p0, lambda t: v), [0, 0], 1)


@holds(option=st.sampled_from(["q0", "gain", "rate_limits", "samples"]), junk=JUNK, samples=FEW, error=JUNK)
def tracking_runs_or_is_refused(option, junk, samples, error):
    trajectory = r1.cubic([0, 1], [1, 2], 2)
    options = {"q0": [0.1, 1], "gain": 2, "samples": 11} | {option: samples if option == "samples" else junk}
    run = answer(r1.simulate_tracking, trajectory, options.pop("q0"), options.pop("gain"), **options)
    assert run is None or run.q.shape == (options["samples"], 2)
    choice = answer(r1.control.smallest_gain, trajectory, [0.1, 1], error)
    assert choice is None or (choice.gain >= 0).all()
    answer(r1.control.smallest_gain, trajectory, junk, 0.01)
    answer(r1.control.smallest_gain, trajectory, [0.1, 1], 0.01, rate_limits=junk)


def main():
    failed = False
    for name, prop in PROPERTIES.items():
        try:
            prop()
        except Exception:
            failed = True
            sys.stdout.write(traceback.format_exc())
        else:
            sys.stdout.write(f"{name}\n")
        sys.stdout.flush()
    return int(failed)


def test_misuse_raises_nothing_but_our_errors_and_never_crashes():
    command = [sys.executable, "-X", "faulthandler", "-W", "error", __file__]
    child = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert child.returncode == 0, child.stdout + child.stderr
    assert (child.stdout.split(), child.stderr) == (list(PROPERTIES), "")


if __name__ == "__main__":
    sys.exit(main())
