"""The compiled solver of all solutions answers as the careful way and brute force do; what it leaves is looked at."""

import pickle
from dataclasses import fields

import numpy as np
import pinocchio as pin
import pytest
from brute_force import all_solutions, apart
from hypothesis import given, settings, strategies as st
from test_all_solutions import (
    ANTHROPOMORPHIC,
    CYLINDRICAL,
    ORTHOGONAL,
    POSE,
    PUMA,
    SIX,
    UR5,
    WRIST,
    XYZ,
    R,
    drawn_rows,
    robot_of,
)

from robotics1 import (
    FunctionTask,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PositionTask,
    ik_solutions,
    load_robot,
    robot_from_dh,
)
from robotics1.ik import IKStatus, SolutionSolver
from robotics1.ik.boundary_distance import Root, boundary_distance
from robotics1.ik.prepared import prepare
from robotics1.ik.solution_search import SolutionSearch

ARMS = {
    **{f"six {i}": (rows, POSE) for i, rows in enumerate(SIX)},
    "anthropomorphic": (ANTHROPOMORPHIC, XYZ),
    "orthogonal": (ORTHOGONAL, XYZ),
    "cylindrical": (CYLINDRICAL, XYZ),
    "2R": ([R(1.2, 0, 0), R(0.8, 0, 0)], PositionTask("xy")),
    "3R in a plane": ([R(1.2, 0, 0), R(0.8, 0, 0), R(0.3, 0, 0)], PlanarPoseTask()),
    "wrist": (WRIST, OrientationTask()),
}


def random_targets(robot, task, count, seed=0):
    rng = np.random.default_rng(seed)
    lower, upper = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    return [task.value(robot, q) for q in rng.uniform(lower, upper, (count, robot.nq))]


def carefully(robot, task, target):
    return prepare(robot, task).carefully(task.target(target), 5, 0)


def assert_the_same(found, expected):
    for field in fields(found):
        a, b = getattr(found, field.name), getattr(expected, field.name)
        if field.name == "outside_limits":  # where no turn of a joint is inside, either will do
            assert a.shape == b.shape
            assert all(np.abs(np.sin(0.5 * (p - b))).max(axis=1).min() < 1e-7 for p in a)
        elif isinstance(a, np.ndarray) and a.dtype == float:
            assert a == pytest.approx(b, abs=1e-7), field.name
        elif isinstance(a, np.ndarray):
            assert np.array_equal(a, b), field.name
        elif isinstance(a, float):
            assert a == pytest.approx(b, abs=1e-9), field.name
        elif field.name not in ("robot", "task"):  # a copy has its own
            assert a == b, field.name


@pytest.mark.parametrize(("rows", "task"), ARMS.values(), ids=ARMS)
def test_the_kernel_answers_as_the_careful_way_does(rows, task):
    robot = robot_of(rows, slide=2.0)
    solver = SolutionSolver(robot, task)
    for target in random_targets(robot, task, 6):
        assert_the_same(solver(target), carefully(robot, task, target))


def test_limits_sort_solutions_and_keep_those_outside_apart():
    robot = robot_from_dh(PUMA, lower=[-2.5, -4, -1, -3, -1.6, -7], upper=[2.5, 0.8, 4, 3, 1.6, 7])
    solver = SolutionSolver(robot, POSE)
    for target in random_targets(robot, POSE, 8):
        found = solver(target)
        assert_the_same(found, carefully(robot, POSE, target))
        assert len(found) + len(found.outside_limits) == 8


@given(st.integers(0, 100_000))
@settings(max_examples=10)
def test_drawn_arms_of_three_joints_have_what_brute_force_finds(seed):
    rows, rng = drawn_rows(seed, 3), np.random.default_rng(seed)
    robot, kinds = robot_of(rows), [row[0] for row in rows]
    q = rng.uniform(-1, 1, 3) * np.where([kind == "R" for kind in kinds], 3, 1)
    if np.linalg.svd(XYZ.jacobian(robot, q), compute_uv=False)[-1] < 1e-2:
        return
    target = XYZ.value(robot, q)
    found = SolutionSolver(robot, XYZ, starts=5)(target)
    T = np.eye(4)
    T[:3, 3] = target
    assert found.complete
    for p in all_solutions(rows, T, [0, 1, 2], seed=3, starts=100):
        slides = np.array(kinds) == "P"
        assert np.abs(p[slides]).max(initial=0.0) > 50 or apart(kinds, p, found.q).min() < 1e-4


@pytest.mark.parametrize("q", [[0.3, 0.7, 0, 0.5, 1.1, 0.2], [0.3, 0.7, 0.9, 0.5, 0, 0.2]], ids=["elbow", "wrist"])
def test_singular_targets_are_left_to_the_careful_way(q):
    robot = robot_of(UR5)
    target = POSE.value(robot, np.array(q))
    found = SolutionSolver(robot, POSE)(target)
    assert found.status in (IKStatus.BOUNDARY, IKStatus.INFINITE)
    assert_the_same(found, carefully(robot, POSE, target))


def test_less_than_a_micrometre_inside_the_boundary_is_the_boundary():
    robot = robot_of([R(1.2, 0, 0), R(0.8, 0, 0)])
    for inside, status in ((5e-7, IKStatus.BOUNDARY), (2e-6, IKStatus.FINITE)):
        found = SolutionSolver(robot, PositionTask("xy"))([2 - inside, 0])
        assert found.status is status
        assert (len(found), found.complete) == (2, True)
        assert found.boundary_distance == pytest.approx(inside if inside < 1e-6 else np.inf, rel=1e-2)


def test_a_batch_is_the_answers_of_its_targets():
    robot = load_robot("ur5")
    solver = SolutionSolver(robot, POSE)
    targets = random_targets(robot, POSE, 20)
    targets[3] = POSE.value(robot, np.array([0.3, 0.7, 0, 0.5, 1.1, 0.2]))  # stretched
    targets[7] = pin.SE3(np.eye(3), np.array([9.0, 0, 0]))
    batch = solver.solve_batch(targets)
    assert (len(batch), batch.counts[7], batch.status[7]) == (20, 0, IKStatus.UNREACHABLE)
    assert len(batch.q) == batch.counts.sum()
    for i, target in enumerate(targets):
        assert_the_same(batch[i], solver(target))
        assert batch.counts[i] == len(batch[i])
        assert batch.q[batch.ends[i] : batch.ends[i + 1]] == pytest.approx(batch[i].q, abs=1e-12)
    assert "1 of 20 targets have no solution; the first is target 7" in batch.explain()
    with pytest.raises(IndexError):
        batch[20]


SEVEN = [R(0, np.pi / 2, 0.3), *PUMA]  # the first joint turns the base, about an axis across that of the second


@pytest.mark.parametrize(
    ("rows", "joint"), [(SEVEN, "q1"), (SEVEN, "q2"), (None, "panda_joint7")], ids=["first", "second", "last"]
)
def test_samples_of_a_joint_are_the_answers_with_it_locked(rows, joint):
    robot = load_robot("panda", tool="panda_hand_tcp") if rows is None else robot_of(rows)
    q = np.zeros(robot.nq)  # a finger of the Panda stays at 0
    q[:7] = 0.2, -0.4, 0.3, -2.1, 0.1, 1.9, 0.6
    number = robot.joint_names.index(joint)
    target, values = POSE.value(robot, q), [q[number], q[number] + 0.4, q[number] - 1.1]
    batch = SolutionSolver(robot, POSE, locked={joint: 0.0}).solve_at(target, joint, values)
    for i, value in enumerate(values):
        expected = SolutionSolver(robot, POSE, locked={joint: value})(target)
        assert batch.status[i] is expected.status
        assert_the_same(batch[i], expected)
        assert batch.q[batch.ends[i] : batch.ends[i + 1]] == pytest.approx(expected.q, abs=1e-7)
    assert np.abs(batch[0].q[:, :7] - q[:7]).max(axis=1).min() < 1e-7


def test_a_sample_without_a_solution_is_unreachable_and_its_nearest_miss_is_found_when_it_is_read():
    robot = load_robot("panda", tool="panda_hand_tcp")
    solver = SolutionSolver(robot, POSE, locked={"panda_joint7": 0.0})
    target = pin.SE3(np.eye(3), np.array([3.0, 0, 0]))
    batch = solver.solve_at(target, "panda_joint7", [0.0, 1.0])
    assert (batch.status.tolist(), batch.counts.tolist()) == ([IKStatus.UNREACHABLE] * 2, [0, 0])
    assert np.isinf(batch.error_norm).all()
    assert 2.0 < batch[1].error_norm < 3.5  # 3 m, less the reach of less than 1 m, and angles of at most π/2 or so
    assert len(pickle.loads(pickle.dumps(batch)).careful) == 2


def test_samples_are_refused_of_a_joint_that_moves_and_of_values_that_are_none():
    robot = load_robot("panda", tool="panda_hand_tcp")
    solver, target = SolutionSolver(robot, POSE, locked={"panda_joint7": 0.0}), pin.SE3.Identity()
    with pytest.raises(InputError, match="'panda_joint6' is not locked"):
        solver.solve_at(target, "panda_joint6", [0.0])
    with pytest.raises(InputError, match="values must be finite"):
        solver.solve_at(target, "panda_joint7", [np.nan])
    with pytest.raises(InputError, match="must lie in its limits"):
        solver.solve_at(target, "panda_joint7", [0.0, 5.0])
    with pytest.raises(InputError, match="the target"):
        solver.solve_at(np.diag([1, 1, -1, 1]), "panda_joint7", [0.0])


def test_samples_of_a_task_that_leaves_turns_free_are_the_answers_with_the_joint_locked():
    robot = robot_of([*ANTHROPOMORPHIC, R(0.1, 0, 0)])  # its last joint moves the point, and no goal says how it turns
    target, values = XYZ.value(robot, np.array([0.3, 0.7, 1.1, 0.4])), [0.4, -0.9]
    batch = SolutionSolver(robot, XYZ, locked={"q4": 0.0}).solve_at(target, "q4", values)
    for i, value in enumerate(values):
        assert_the_same(batch[i], SolutionSolver(robot, XYZ, locked={"q4": value})(target))


def test_solutions_of_a_function_are_searched():
    robot = robot_of([R(1.2, 0, 0), R(0.8, 0, 0)])
    task = FunctionTask(lambda p, R, q: [p[0], p[1]], 2)
    solver = SolutionSolver(robot, task, starts=10)
    assert len(solver([0.5, 1.1])) == 2
    assert solver.solve_batch([[0.5, 1.1], [0.4, 0.9]]).counts.tolist() == [2, 2]


@pytest.mark.parametrize("bad", [np.diag([1, 1, -1, 1]), np.full((4, 4), np.nan), "pose", None])
def test_what_is_no_pose_is_refused_and_a_batch_says_which(bad):
    robot = load_robot("ur5")
    solver = SolutionSolver(robot, POSE)
    with pytest.raises(InputError, match="the target"):
        solver(bad)
    with pytest.raises(InputError, match="target 1 of the batch"):
        solver.solve_batch([POSE.value(robot, np.zeros(6)), bad])


def test_a_pose_that_is_damaged_is_refused():
    robot = load_robot("ur5")
    T = POSE.value(robot, np.full(6, 0.3))
    T.rotation = 1.1 * T.rotation
    with pytest.raises(InputError):
        SolutionSolver(robot, POSE)(T)


def test_a_solver_can_be_pickled():
    robot = load_robot("ur5")
    solver, target = SolutionSolver(robot, POSE), POSE.value(robot, np.full(6, 0.3))
    assert_the_same(pickle.loads(pickle.dumps(solver))(target), solver(target))


def test_the_function_and_the_solver_agree_and_results_are_read_only():
    robot = load_robot("ur5")
    target = POSE.value(robot, np.array([0.3, -0.7, 1.1, 0.5, 1.2, 0.2]))
    found = SolutionSolver(robot, POSE)(target)
    assert_the_same(found, ik_solutions(robot, POSE, target))
    assert not any(a.flags.writeable for a in vars(found).values() if isinstance(a, np.ndarray))


def test_the_distance_to_a_fold_is_taken_along_the_singular_set_where_the_other_solution_is_not_known():
    """By the law of cosines l1 l2 δ²/(2 (l1 + l2)); the stretched arm with the same q1 is 0.8 δ aside."""
    robot, task, bend = robot_from_dh([("R", 1.2, 0, 0, 0), ("R", 0.8, 0, 0, 0)]), PositionTask("xy"), 8e-6
    prepared, q = prepare(robot, task), np.array([0.3, bend])
    search = SolutionSearch(prepared.problem, task.value(robot, q), points=prepared.exact.points)
    distance = boundary_distance([Root(q, 4e-6, False)], [], search, prepared.exact.points)
    assert distance == pytest.approx(1.2 * 0.8 * bend**2 / (2 * 2.0), abs=1e-13)


def changed(T, entry, value):
    T = T.copy()
    T[entry] = value
    return T


def test_targets_as_matrices_have_the_solutions_of_the_same_poses():
    robot = load_robot("ur5")
    solver, poses = SolutionSolver(robot, POSE), random_targets(robot, POSE, 20)
    matrices = np.array([T.homogeneous for T in poses])
    fixed = matrices.copy()
    fixed.flags.writeable = False
    wanted = solver.solve_batch(poses)
    mixed = [T if i % 2 else T.homogeneous.tolist() for i, T in enumerate(poses)]
    for targets in (matrices, fixed, list(matrices), np.asfortranarray(matrices), mixed):
        found = solver.solve_batch(targets)
        for i, (a, b) in enumerate(zip(found, wanted, strict=True)):
            assert np.array_equal(a.q, b.q)
            assert np.array_equal(solver(targets[i]).q, b.q)


@pytest.mark.parametrize(("entry", "value"), [((3, 0), 1e-3), ((3, 3), 1.1), ((0, 0), 2.0), ((1, 3), np.nan)])
def test_a_matrix_that_is_no_pose_is_refused_with_its_number(entry, value):
    robot = load_robot("ur5")
    solver = SolutionSolver(robot, POSE)
    matrices = np.array([T.homogeneous for T in random_targets(robot, POSE, 3)])
    matrices[1] = changed(matrices[1], entry, value)
    with pytest.raises(InputError, match="target 1 of the batch"):
        solver.solve_batch(matrices)
    with pytest.raises(InputError):
        solver(matrices[1])
