"""Threads may call anything at once, on shared objects and on their own, and get what one thread gets."""

import copy
import pickle
from functools import partial
from threading import Event, Thread

import numpy as np
import pytest
from arms import arm
from observation import observed
from public_objects import PLANE, TARGET, followed, its_jacobian, squared_distance
from sweeps import some_of
from threads import LONGEST, THREADS, in_threads, unchanged

import robotics1 as r1


def fresh(name):
    """A robot of which nothing has been asked yet."""
    return pickle.loads(pickle.dumps(arm(name)))


def assert_as_in_one_thread(calls_of, threads=THREADS):
    """`calls_of()` makes objects anew, and the calls that share them."""
    wanted = [observed(call()) for call in calls_of()]
    shared = calls_of()
    with unchanged():
        for answers in in_threads(shared, threads):
            assert [observed(answer) for answer in answers] == wanted


@pytest.mark.parametrize("name", ["six_r", "spatial", "redundant"])
def test_kinematics_of_a_shared_robot(name):
    def calls():
        robot = fresh(name)
        q, qdot = np.random.default_rng(0).uniform(-1, 1, (2, 100, robot.nq))
        frames = robot.frame_names[-2:]
        return [
            *(partial(r1.forward_kinematics, robot, x, frame=frame) for x in q for frame in frames),
            *(partial(r1.frame_jacobian, robot, x, reference="tool") for x in q),
            *(partial(r1.frame_jacobian_rate, robot, x, v) for x, v in zip(q, qdot, strict=True)),
            *(partial(r1.PoseTask("ZYZ").value, robot, x) for x in q),
            *(partial(r1.PositionTask().jacobian, robot, x) for x in q),
            *(partial(robot.within_limits, x) for x in q),
            lambda: (robot.reach, robot.revolute, robot.units, robot.frame_names),
        ]

    assert_as_in_one_thread(calls)


def test_planar_tasks_and_functions_of_a_shared_robot():
    def calls():
        robot = fresh("planar_2r")
        task, function = r1.PlanarPoseTask(), r1.FunctionTask(squared_distance, 1, its_jacobian)
        qs = np.random.default_rng(1).uniform(-1, 1, (20, 2))
        tasks = [task, function, r1.FunctionTask(squared_distance, 1)]
        return [
            *(partial(t.jacobian, robot, q) for q in qs for t in tasks),
            *(partial(r1.trajectories.jacobian_rate, robot, PLANE, q, [1, 2]) for q in qs),
            *(partial(r1.joint_velocity, robot, PLANE, [1, 2], q) for q in qs[:5]),
            *(partial(r1.joint_acceleration, robot, PLANE, [0, 1], q, [1, 2]) for q in qs[:5]),
        ]

    assert_as_in_one_thread(calls)


def test_inverse_kinematics_with_shared_solvers():
    def calls():
        robot, planar = fresh("six_r"), fresh("planar_2r")
        solver = r1.IKSolver(robot, r1.PoseTask(), seed=5)
        near = r1.IKSolver(fresh("redundant"), r1.PositionTask(), prefer="near")
        general = r1.IKSolver(planar, r1.FunctionTask(squared_distance, 1), time_limit=20)
        qs = np.random.default_rng(2).uniform(-1, 1, (3, 6))
        targets = [r1.forward_kinematics(robot, q) for q in qs]
        return [
            *(partial(solver, target) for target in targets),
            *(partial(solver, target, np.zeros(6)) for target in targets),
            partial(solver.solve_batch, targets),
            partial(near, [0.4, 0.2, 0.3]),
            partial(near.solve_batch, [[0.4, 0.2, 0.3], [0.3, 0.2, 0.4]]),
            partial(general, [1.5]),
            partial(r1.solve_ik, planar, PLANE, TARGET),
            partial(r1.ik_solutions, planar, PLANE, TARGET),
            partial(r1.iterate_ik, planar, PLANE, TARGET, [0.1, 0.2]),
        ]

    assert_as_in_one_thread(calls)


def test_formulas_of_a_shared_robot_and_of_shared_formulas():
    def calls():
        robot = fresh("prr")
        f = r1.formulas(fresh("planar_2r"), PLANE, point=["d", 0, 0])
        return [
            lambda: r1.formulas(robot, PLANE).jacobian,
            lambda: r1.formulas(robot, PLANE).minors,
            lambda: (f.determinant, f.jacobian_rate),
            lambda: f.python("jacobian"),
            lambda: r1.orientation.euler_formulas("ZYZ").determinant,
        ]

    assert_as_in_one_thread(calls, threads=3)


def test_singularities_and_scans_of_a_shared_robot():
    def calls():
        robot, planar = fresh("prr"), fresh("planar_2r")
        singular = r1.find_singularities(planar, PLANE)
        scan = partial(r1.scan_singularities, planar, PLANE, samples=2000, measures=("sigma_min", "manipulability"))

        def summary(found):
            return [(b.conditions, b.rank, b.dimension, b.samples) for b in found.branches], found.explain()

        return [
            lambda: summary(r1.find_singularities(robot, PLANE)),
            lambda: summary(r1.find_singularities(planar, PLANE, method="numeric", samples=4, time_limit=900)),
            lambda: (
                r1.singularities.parameter_conditions(singular),
                r1.singularities.find_intersections(singular).branches,
                singular.branches[0].formulas.null,
            ),
            lambda: singular.branches[0].sample(np.random.default_rng(3)),
            lambda: (scan().worst, scan().quantile(0.3)),
            lambda: scan(seed=4).worst_values,
        ]

    assert_as_in_one_thread(calls, threads=3)


def test_shared_trajectories_and_paths():
    def calls():
        motion = copy.deepcopy(followed()[0])
        t = np.linspace(0, motion.duration, 5)
        limits = r1.MotionLimits(1.0, 3.0)
        path = r1.curves.formula_path(["cos(s)", "a*s"], "s", 2.0, values={"a": 0.3})
        blend = r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=0.2)
        stacked = r1.curves.stacked_path([blend, r1.curves.by_arc_length(blend)])
        return [
            lambda: (motion(t), motion.velocity(t)),
            lambda: r1.minimum_time([0, 0], [1, 2], limits).trajectory.breakpoints,
            lambda: (path(0.3), path.derivative(0.3), path.derivative(1.1, 2)),
            lambda: (stacked(0.5), stacked.derivative(0.2), stacked.breakpoints),
            lambda: r1.curves.by_arc_length(path)(0.4),
            lambda: r1.trajectories.time_optimal(blend, limits, grid=30).duration,
        ]

    assert_as_in_one_thread(calls)


def test_robots_from_tables_have_their_own_lengths():
    """The tool of a planar arm at q = 0 is at a + b."""

    def reach(a, b):
        robot = r1.robot_from_dh([("R", "a", 0, 0, 0), ("R", "b", 0, 0, 0)], parameters={"a": a, "b": b})
        longer = robot.with_parameters({"b": b + 1})
        return [r1.forward_kinematics(r, [0, 0]).translation[0] for r in (robot, longer)]

    lengths = [(0.1 * i, 0.01 * j) for i in range(1, 4) for j in range(1, 4)]
    calls = [partial(reach, a, b) for a, b in lengths[::2]]
    with unchanged():
        for answers in in_threads(calls):
            assert np.allclose(answers, [[a + b, a + b + 1] for a, b in lengths[::2]], rtol=0, atol=1e-12)


def test_robots_from_files_have_their_own_lengths_and_errors(tmp_path):
    """A xacro with lengths, a plain file, and a file that Pinocchio refuses: each error has its own reason."""
    broken = []
    for i in range(3):
        path = tmp_path / f"broken{i}.urdf"
        joint = f'<joint name="q{i}" type="revolute"><parent link="a"/><child link="b"/></joint>'
        path.write_text(f'<robot name="broken"><link name="a"/><link name="b"/>{joint}</robot>', encoding="utf-8")
        broken.append(path)

    def reach(l1, l2):
        robot = r1.load_robot("planar_2r", parameters={"l1": l1, "l2": l2})
        return r1.forward_kinematics(robot.with_parameters({"l2": 2 * l2}), [0, 0]).translation[0]

    def refused(path):
        with pytest.raises(r1.RobotFileError) as caught:
            r1.load_robot(path)
        return str(caught.value), caught.value.path

    lengths = [(0.1 * i, 0.05 * i) for i in range(1, 4)]
    calls = [*(partial(reach, *pair) for pair in lengths), *(partial(refused, path) for path in broken)]
    calls += [lambda: r1.load_robot(arm("six_r").path).joint_names, lambda: r1.check_robot("prr").fk_difference]
    wanted = [call() for call in calls]
    assert np.allclose(wanted[:3], [2 * l1 for l1, _ in lengths], rtol=0, atol=1e-12)
    with unchanged():
        for answers in in_threads(calls):
            assert answers == wanted


class WaitingLaw:
    """A timing law of a user whose switching times are found only when another thread is done."""

    duration, start, end = 1.0, 0.0, 1.0

    def __init__(self, begun, other_done):
        self.begun, self.other_done = begun, other_done
        self.law = r1.trajectories.cosine(0, 1, 1.0).joint()
        self.switching_calls = 0

    def __getattr__(self, name):
        return getattr(self.law, name)

    def __call__(self, t):
        return self.law(t)

    @property
    def breakpoints(self):
        self.begun.set()
        if not self.other_done.wait(LONGEST):
            raise TimeoutError
        return np.array([])


def test_a_thread_that_finds_a_property_lets_others_find_theirs():
    """One motion waits for its law while the same property of another motion is found."""
    begun, done = Event(), Event()
    slow = r1.curves.JointTrajectory((WaitingLaw(begun, done),))
    thread = Thread(target=lambda: slow.breakpoints, daemon=True)
    thread.start()
    assert begun.wait(60)
    other = Thread(target=lambda: (r1.trajectories.cosine(0, 1, 2.0).breakpoints, done.set()), daemon=True)
    other.start()
    other.join(60)
    assert done.is_set()
    thread.join(60)
    assert not thread.is_alive()


@pytest.mark.parametrize("seed", some_of(range(20), 2))
def test_everything_at_once_in_many_threads(seed):
    """All kinds of calls mixed, from eight threads, again and again."""

    def calls():
        robot, planar = fresh("six_r"), fresh("planar_2r")
        solver = r1.IKSolver(robot, r1.PoseTask(), seed=seed)
        qs = np.random.default_rng(seed).uniform(-1, 1, (4, 6))
        found = [
            *(partial(r1.frame_jacobian_rate, robot, q, q) for q in qs),
            *(partial(solver, r1.forward_kinematics(robot, q)) for q in qs),
            partial(solver.solve_batch, [r1.forward_kinematics(robot, q) for q in qs]),
            lambda: r1.formulas(planar, PLANE).determinant,
            lambda: r1.find_singularities(planar, PLANE).explain(),
            lambda: r1.scan_singularities(planar, PLANE, samples=1000, seed=seed).worst,
            lambda: r1.ik_solutions(planar, PLANE, TARGET),
            lambda: r1.robot_from_dh([("R", "a", 0, 0, 0)], parameters={"a": seed + 1.0}).reach,
            lambda: r1.load_robot("prr", parameters={"l2": 1.0 + seed}).reach,
            lambda: r1.minimum_time([0, 0], [1, 2], r1.MotionLimits(1.0, 3.0 + seed)).duration,
        ]
        return [found[i] for i in np.random.default_rng(seed).permutation(len(found))]

    assert_as_in_one_thread(calls, threads=8)
