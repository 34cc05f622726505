"""All solutions by formula: as many as brute force finds, each verified, and families and boundaries told apart."""

from math import pi

import numpy as np
import pytest
from brute_force import all_solutions, apart
from hypothesis import given, settings, strategies as st

from robotics1 import InputError, PoseTask, PositionTask, forward_kinematics, ik_solutions, load_robot, robot_from_dh
from robotics1.ik import IKStatus, SolutionSolver
from robotics1.orientation import nearest_rotation

H = pi / 2
XYZ, POSE = PositionTask(), PoseTask()


def R(a, alpha, d, theta=0.0):
    return ("R", a, alpha, d, theta)


def P(alpha, theta=0.0):
    return ("P", 0, alpha, 0, theta)


WRIST = [R(0, -H, 0), R(0, H, 0), R(0, 0, 0.2)]
UR5 = [R(0, H, 0.0892), R(-0.425, 0, 0), R(-0.39225, 0, 0), R(0, H, 0.10915), R(0, -H, 0.09465), R(0, 0, 0.0823)]
PUMA = [R(0, H, 0), R(0.4318, 0, 0), R(0.0203, -H, 0.15), R(0, H, 0.4318), R(0, -H, 0), R(0, 0, 0.1)]
STANFORD = [R(0, -H, 0.4), R(0, H, 0.15), P(0), *WRIST]
GANTRY = [P(H), P(H, H), P(H, H), *WRIST]
BEHIND_A_SLIDE = [P(0.7), R(0.4, 1.1, 0.2), R(0.3, H, 0.1), R(0, -H, 0.3), *WRIST[1:]]
PARALLEL_FIRST = [R(0.4, 0, 0.1), R(0.3, 0, 0), R(0.2, H, 0.1), R(0.1, -H, 0.2), R(0.1, 1.0, 0), R(0.05, 0, 0.1)]
SKEW = [R(0.1, 1.0, 0.3), R(0.4, 0, 0.1), R(0.35, 0, 0), R(0.05, 1.2, 0.1), R(0.1, -0.8, 0.1), R(0.03, 0.2, 0.1)]
SIX = [UR5, PUMA, STANFORD, GANTRY, BEHIND_A_SLIDE, PARALLEL_FIRST, SKEW]
ANTHROPOMORPHIC = [R(0, H, 0.4), R(0.5, 0, 0), R(0.35, 0, 0)]
ORTHOGONAL = [R(1, -H, 0), R(2, H, 1), R(1.5, 0, 0)]
CYLINDRICAL = [R(0, 0, 0.3), P(-H), P(0)]


def robot_of(rows, slide=50.0):
    turns = [row[0] == "R" for row in rows]
    upper = [None if turning else slide for turning in turns]
    return robot_from_dh(rows, lower=[None if u is None else -u for u in upper], upper=upper)


def drawn_rows(seed, joints):
    rng = np.random.default_rng(seed)

    def length():
        return float(rng.choice([0, 1, rng.uniform(-1, 1), rng.uniform(-1, 1)]))

    def row():
        kind = "R" if rng.random() < 0.65 else "P"
        alpha = float(rng.choice([0, H, -H, pi, rng.uniform(-3, 3), rng.uniform(-3, 3)]))
        return (kind, length(), alpha, length(), float(rng.choice([0, H, rng.uniform(-3, 3)])))

    return [row() for _ in range(joints)]


def assert_as_brute_force(rows, task, q, **options):
    """No solution that many starts lead to is missed, and q is there; each is verified."""
    robot, which = robot_of(rows), {6: range(6), 3: [0, 1, 2], 2: [0, 1]}[task.rows]
    T = forward_kinematics(robot, q)
    target = T if task.rows == 6 else T.translation[: task.rows]
    found = ik_solutions(robot, task, target, starts=5)
    kinds = [row[0] for row in rows]
    assert found.complete
    assert found.status is IKStatus.FINITE
    for p in found.q:
        assert np.abs(task.error(robot, p, target)).max() < 1e-11
    assert apart(kinds, q, found.q).min() < 1e-6
    expected = all_solutions(rows, T.homogeneous, which, seed=3, **options)
    slides = np.array(kinds) == "P"
    for p in expected:
        assert np.abs(p[slides]).max(initial=0.0) > 50 or apart(kinds, p, found.q).min() < 1e-4
    return found, expected


@pytest.mark.parametrize("rows", SIX, ids=["UR5", "Puma", "Stanford", "gantry", "slide", "parallel", "skew"])
def test_six_joints_have_as_many_solutions_as_brute_force_finds(rows):
    q = np.random.default_rng(5).uniform(-1, 1, 6) * np.where([row[0] == "R" for row in rows], 3, 0.5)
    found, expected = assert_as_brute_force(rows, POSE, q, starts=250, reach=1.0)
    assert len(found) == len(expected)


def test_the_orthogonal_arm_has_four_solutions_and_two():
    robot = robot_of(ORTHOGONAL)
    counts = {len(ik_solutions(robot, XYZ, [x, 0, z])) for x in (2.5, 3.0) for z in (0.0, 0.5, 1.5)}
    assert 4 in counts
    assert_as_brute_force(ORTHOGONAL, XYZ, np.array([0.3, -1.2, 2.0]))


def test_the_orthogonal_arm_has_the_four_solutions_that_wenger_prints():
    """a1 = 1, a2 = 2, a3 = 1.5, d2 = 1 at (2.5, 0, 0.6), in degrees."""
    found = ik_solutions(robot_of(ORTHOGONAL), XYZ, [2.5, 0, 0.6])
    printed = [
        [-164.56, -170.02, -12.89],
        [-101.52, -158.19, 104.88],
        [-50.92, -46.17, 141.16],
        [10.13, -22.33, -106.28],
    ]
    assert np.degrees(found.q) == pytest.approx(np.array(printed), abs=0.02)
    assert (found.complete, found.status) == (True, IKStatus.FINITE)


def test_a_ur5_has_eight_solutions_among_them_the_printed_one():
    """A frame of three digits from the tests of compas_fab, whose x axis is the tool's z axis here."""
    robot, T = load_robot("ur5"), np.eye(4)
    z, x = np.array([0.371, -0.292, -0.882]), -np.array([0.113, 0.956, -0.269])
    T[:3, :3] = nearest_rotation(np.column_stack([x, np.cross(z, x), z]), tolerance=0.01).rotation
    T[:3, 3] = 0.381, 0.093, 0.382
    found = ik_solutions(robot, POSE, T)
    assert (len(found), len(set(found.labels)), found.complete) == (8, 8, True)
    assert apart("RRRRRR", np.array([0.022, 4.827, 1.508, 1.126, 1.876, 3.163]), found.q).min() < 2e-3


@given(st.integers(0, 100_000), st.sampled_from([2, 3]))
@settings(max_examples=10)
def test_drawn_arms_of_two_and_three_joints_have_what_brute_force_finds(seed, joints):
    rows, rng = drawn_rows(seed, joints), np.random.default_rng(seed)
    task = XYZ if joints == 3 else PositionTask("xy")
    q = rng.uniform(-1, 1, joints) * np.where([row[0] == "R" for row in rows], 3, 1)
    if np.linalg.svd(task.jacobian(robot_of(rows), q), compute_uv=False)[-1] > 1e-2:
        assert_as_brute_force(rows, task, q, starts=150)


FOLDED = [R(0.22, -0.72, 0), R(0.65, -H, 0), ("P", 0.37, 0.72, 0, -1.58)]  # at q2 = q3 = 0


@pytest.mark.parametrize("rows", [FOLDED, drawn_rows(6, 2)], ids=["a double root at 0", "a root at a quarter turn"])
def test_roots_at_special_half_tangents_are_not_lost(rows):
    robot, task = robot_of(rows), XYZ if len(rows) == 3 else PositionTask("xy")
    q = np.array([3.0, 0, 0]) if len(rows) == 3 else np.array([-H, pi])
    for found in (SolutionSolver(robot, task)(task.value(robot, q)), ik_solutions(robot, task, task.value(robot, q))):
        assert found.complete
        assert apart([row[0] for row in rows], q, found.q).min() < 1e-6


@given(st.integers(0, 100_000), st.sampled_from([2, 3]))
@settings(max_examples=12)
def test_no_solution_is_missing_at_right_angles_where_they_are_said_to_be_all(seed, joints):
    rows, rng = drawn_rows(seed, joints), np.random.default_rng(seed)
    kinds, robot = [row[0] for row in rows], robot_of(rows)
    task = XYZ if joints == 3 else PositionTask("xy")
    q = np.where(np.array(kinds) == "R", rng.choice([0, H, -H, pi], joints), rng.choice([0, 0.4, 1.0], joints))
    target = task.value(robot, q)
    for found in (SolutionSolver(robot, task)(target), ik_solutions(robot, task, target, starts=3)):
        stays = [name in found.free_joints for name in robot.joint_names]  # it stands anywhere
        assert not found.complete or apart(kinds, np.where(stays, found.closest, q), found.q).min() < 1e-5


@pytest.mark.parametrize(
    ("rows", "task", "q", "status", "count"),
    [
        (ANTHROPOMORPHIC, XYZ, [0.3, 0.7, 0], IKStatus.BOUNDARY, 2),  # stretched, and over the shoulder
        (ANTHROPOMORPHIC, XYZ, [0.3, 0.7, pi], IKStatus.BOUNDARY, 2),
        (ANTHROPOMORPHIC, XYZ, [0.3, H, 0], IKStatus.INFINITE, None),  # on the first axis
        (CYLINDRICAL, XYZ, [0.3, 0.4, 0], IKStatus.INFINITE, None),
        (PUMA, POSE, [0.3, 0.7, -0.4, 0.5, 0, 0.2], IKStatus.INFINITE, None),  # of the wrist
        (UR5, POSE, [0.3, 0.7, 0, 0.5, 1.1, 0.2], IKStatus.BOUNDARY, None),
        (UR5, POSE, [0.3, 0.7, 0.9, 0.5, 0, 0.2], IKStatus.INFINITE, None),
    ],
)
def test_boundaries_and_families_are_told_apart(rows, task, q, status, count):
    robot = robot_of(rows)
    target = task.value(robot, np.array(q))
    found = ik_solutions(robot, task, target, starts=5)
    assert found.status is status
    assert found.dimension == (1 if status is IKStatus.INFINITE else 0)
    crossing = rows is ANTHROPOMORPHIC and status is IKStatus.INFINITE  # it is stretched too
    hidden = found.dimension == 0 and len(q) == 6  # rounding may hide one beside a double one
    assert found.complete == (not crossing and not hidden)
    assert found.singular.any()
    for p in found.q:
        assert np.abs(task.error(robot, p, target)).max() < 1e-9
    if count is not None:
        assert len(found) == count
        assert apart("RRR", np.array(q), found.q).min() < 1e-6


@pytest.mark.parametrize(
    ("rows", "task", "q", "equations"),
    [
        (PUMA, POSE, [0.3, 0.7, -0.4, 0.5, 0, 0.2], "q1 = 0.3000, q2 = 0.7000, q3 = -0.4000, q5 = 0, q4 + q6 = 0.7000"),
        (PUMA, POSE, [0.3, 0.7, -0.4, 0.5, pi, 0.2], "q3 = -0.4000, q5 = π, q4 − q6 = 0.3000"),
        (UR5, POSE, [0.3, 0.7, 0.9, 0.5, 0, 0.2], "q1 = 0.3000, q5 = 0, q2 + q3 + q4 + q6 = 2.3000"),
        (ANTHROPOMORPHIC, XYZ, [0.3, 1.2, -2.4], None),
        (CYLINDRICAL, XYZ, [0.3, 0.4, 0], "q2 = 0.4000, q3 = 0"),
    ],
)
def test_equations_of_a_family_are_sums_of_joints_that_stay_the_same(rows, task, q, equations):
    robot = robot_of(rows)
    found = ik_solutions(robot, task, task.value(robot, np.array(q)), starts=5)
    if equations is None:
        assert found.families == ()
    else:
        assert equations in found.explain()


def test_beyond_the_boundary_by_less_than_a_micrometre_is_the_boundary():
    robot = robot_of([R(1.2, 0, 0), R(0.8, 0, 0)])
    found = ik_solutions(robot, PositionTask("xy"), [2 + 5e-7, 0])
    assert found.status is IKStatus.BOUNDARY
    assert found.q == pytest.approx(np.zeros((1, 2)), abs=1e-3)
    assert found.boundary_distance == pytest.approx(5e-7, rel=1e-2)
    assert "a boundary is 5e-07 away" in found.explain()


@pytest.mark.parametrize("size", [1.0, 1e-3])
@pytest.mark.parametrize(
    ("rows", "task", "folded"),
    [
        ([R(1.2, 0, 0), R(0.8, 0, 0)], PositionTask("xy"), [0.3, 0]),
        (ANTHROPOMORPHIC, XYZ, [0.3, 0.7, 0]),
        (UR5, POSE, [0.3, 0.7, 0, 0.5, 1.1, 0.2]),
    ],
    ids=["2R", "anthropomorphic", "UR5"],
)
def test_within_a_micrometre_of_the_boundary_both_ways_to_all_solutions_say_so(rows, task, folded, size):
    robot = robot_of([(kind, a * size, alpha, d * size, theta) for kind, a, alpha, d, theta in rows])
    solver = SolutionSolver(robot, task)
    fold, moved = np.array(folded, dtype=float), np.zeros(len(rows))
    moved[2 if len(rows) == 6 else -1] = 1.0
    moved[3:4] = -1.0  # the wrist keeps its direction beside the forearm
    links = np.array([abs(row[1]) for row in rows if row[1]][-2:]) * size
    for shortened, status in [(5e-7, IKStatus.BOUNDARY), (9e-7, IKStatus.BOUNDARY), (1.2e-6, IKStatus.FINITE)]:
        chord = links.sum() - shortened  # the law of cosines
        bent = np.arccos((chord**2 - links @ links) / (2 * links.prod()))
        target = task.value(robot, fold + bent * moved)
        for found in (solver(target), ik_solutions(robot, task, target)):
            assert found.status is status
            if status is IKStatus.BOUNDARY:
                least = 0.1 if task.rows == 6 else 1.0  # a pose may turn on its way to the boundary
                assert least - 1e-3 < found.boundary_distance / shortened < 1 + 1e-3


@pytest.mark.parametrize("lowest", [0.0, 1e-4])
def test_near_a_fold_it_is_the_boundary_too_where_the_other_solution_is_outside_the_limits(lowest):
    rows, task = ANTHROPOMORPHIC, XYZ
    robot = robot_from_dh(rows, lower=[None, None, lowest], upper=[None, None, 3])
    a, b = rows[1][1], rows[2][1]
    for shortened, status in [(5e-7, IKStatus.BOUNDARY), (1.2e-6, IKStatus.FINITE)]:
        bent = np.arccos(((a + b - shortened) ** 2 - a**2 - b**2) / (2 * a * b))
        target = task.value(robot, [0.3, 0.7, bent])
        for found in (SolutionSolver(robot, task)(target), ik_solutions(robot, task, target)):
            assert (found.status, found.complete) == (status, True)
            assert (len(found), len(found.outside_limits)) == (2, 2)
            if status is IKStatus.BOUNDARY:
                assert found.boundary_distance == pytest.approx(shortened, rel=1e-2)


def test_solutions_outside_the_limits_are_kept_apart_and_whole_turns_are_listed_on_request():
    robot = robot_from_dh([R(1.2, 0, 0), R(0.8, 0, 0)], lower=[-2 * pi, 0], upper=[2 * pi, 3])
    found = ik_solutions(robot, PositionTask("xy"), [0.5, 1.1])
    assert (len(found), found.outside_limits.shape, found.complete) == (1, (1, 2), True)
    every = ik_solutions(robot, PositionTask("xy"), [0.5, 1.1], windings=True)
    assert len(every) == 2
    assert np.ptp(every.q[:, 0]) == pytest.approx(2 * pi)


@pytest.mark.parametrize("limit", [1e6, 1e17])
def test_more_whole_turns_than_anybody_reads_are_refused(limit):
    robot = robot_from_dh([R(1.2, 0, 0), R(0.8, 0, 0)], lower=[-limit] * 2, upper=[limit] * 2)
    with pytest.raises(InputError, match=r"copies by whole turns.*: narrow the limits with box="):
        ik_solutions(robot, PositionTask("xy"), [0.5, 1.1], windings=True)


def test_axes_rounded_as_in_files_are_found_and_polished():
    rounded = [(kind, a, round(alpha, 4), d, theta) for kind, a, alpha, d, theta in UR5]
    robot, q = robot_of(rounded), np.array([0.3, -0.7, 1.1, 0.5, 1.2, 0.2])
    found = ik_solutions(robot, POSE, POSE.value(robot, q))
    assert (len(found), found.complete) == (8, True)
    assert apart("RRRRRR", q, found.q).min() < 1e-9


def test_an_arm_whose_joints_depend_on_each_other_is_searched():
    four_through_a_point = [
        R(0, H, 0.3),
        R(0, H, 0),
        R(0, -1.2, 0),
        R(0.4, -0.7, 0.1),
        R(0.3, H, 0.2),
        R(0.2, 0.3, 0.1),
    ]
    robot = robot_of(four_through_a_point)
    found = ik_solutions(robot, POSE, POSE.value(robot, np.full(6, 0.4)), starts=3)
    assert not found.complete
    assert found.method == "search"
