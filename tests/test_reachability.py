"""Reachability maps: against circles, forward kinematics, brute force and laws."""

from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from math import pi

import numpy as np
import pytest
from arms import ARMS, arm, span
from scipy.spatial.transform import Rotation

import robotics1 as r1
from robotics1.workspaces import PoseStatus, ReachabilityMap

L1, L2 = 0.5, 0.3
PLANE = r1.PositionTask("xy")
FIELDS = ("positions", "orientations", "status", "solutions", "manipulability", "limit_margin", "q", "orientation")


def planar(lower=(None, None), upper=(None, None)):
    return r1.robot_from_dh([("R", L1, 0, 0, 0), ("R", L2, 0, 0, 0)], lower=lower, upper=upper)


def elbows(p):
    """Both q of a planar 2R arm at p, (2, 2); NaN out of reach. c2 = (p² − l1² − l2²)/(2 l1 l2)."""
    c2 = (p @ p - L1**2 - L2**2) / (2 * L1 * L2)
    with np.errstate(invalid="ignore"):
        q2 = np.array([np.arccos(c2), -np.arccos(c2)])
    q1 = np.arctan2(p[1], p[0]) - np.arctan2(L2 * np.sin(q2), L1 + L2 * np.cos(q2))
    return np.column_stack([(q1 + pi) % (2 * pi) - pi, q2])


def same_maps(a, b):
    return all(np.array_equal(getattr(a, name), getattr(b, name), equal_nan=name in FIELDS[4:7]) for name in FIELDS)


def test_a_planar_arm_reaches_a_ring_twice_with_manipulability_l1_l2_sin_q2():
    axis = np.linspace(-0.9, 0.9, 37)
    known = r1.reachability_map(planar(), PLANE, {"x": axis, "y": axis})
    r = np.linalg.norm(known.positions, axis=1)
    inside = (r > L1 - L2 + 1e-9) & (r < L1 + L2 - 1e-9)
    off = (r < L1 - L2 - 1e-9) | (r > L1 + L2 + 1e-9)
    assert known.reached[inside].all()
    assert (known.status[off] == PoseStatus.UNREACHABLE).all()
    assert (known.solutions[inside] == 2).all()
    sine = np.sin([elbows(p)[0, 1] for p in known.positions[inside]])
    assert known.manipulability[inside] == pytest.approx(L1 * L2 * sine, abs=1e-12)
    assert np.isnan(known.manipulability[off]).all()
    assert (known.orientation[off] == -1).all()


def test_joint_limits_take_solutions_away_and_margins_are_relative_to_the_ranges():
    lower, upper = np.array([-2.0, -1.0]), np.array([1.5, 2.5])
    robot, axis = planar(lower, upper), np.linspace(-0.82, 0.82, 42)
    known = r1.reachability_map(robot, PLANE, {"x": axis, "y": axis})
    assert set(np.unique(known.solutions)) == {0, 1, 2}
    for i, p in enumerate(known.positions):
        inside = [q for q in elbows(p) if ((q >= lower) & (q <= upper)).all()]
        assert known.solutions[i, 0] == len(inside)
        assert known.status[i, 0] == (PoseStatus.REACHED if inside else PoseStatus.UNREACHABLE)
        if inside:
            margins = [(2 * np.minimum(q - lower, upper - q) / (upper - lower)).min() for q in inside]
            assert known.limit_margin[i] == pytest.approx(max(margins), abs=1e-9)


def test_the_angles_reached_by_a_planar_3r_are_those_that_leave_its_wrist_in_the_ring():
    robot = r1.textbook_robots.planar_arm("RRR", [L1, L2, 0.2])
    angles = np.linspace(0, 2 * pi, 40, endpoint=False) + 0.01
    points = np.random.default_rng(1).uniform(-1, 1, (50, 2))
    known = r1.reachability_map(robot, r1.PlanarPoseTask(), points, angles)
    wrist = np.linalg.norm(points[:, None] - 0.2 * np.stack([np.cos(angles), np.sin(angles)], axis=1), axis=2)
    expected = (wrist > L1 - L2) & (wrist < L1 + L2)
    assert np.array_equal(known.reached, expected)
    assert known.capability == pytest.approx(expected.mean(axis=1))
    assert (known.solutions[expected] == 2).all()
    assert known.complete


def task_of(robot):
    return {"planar_2r": PLANE, "prr": r1.PlanarPoseTask(), "vertical_2r": r1.PositionTask("xz")}.get(
        robot, r1.PoseTask()
    )


@pytest.mark.parametrize("name", [name for name in ARMS if name not in ("two_tips", "planar_3r")])
def test_no_pose_of_a_configuration_inside_the_limits_is_called_unreachable(name):
    """Random configurations, multiples of π/4, and those at limits."""
    robot, task, rng = arm(name), task_of(name), np.random.default_rng(3)
    lower, upper = (np.where(np.isfinite(end), end, 0) for end in span(robot))
    q = rng.uniform(lower, upper, (300, robot.nq))
    q[100:200] = np.clip(np.round(q[100:200] / (pi / 4)) * pi / 4, lower, upper)
    q[200:] = np.where(rng.random((100, robot.nq)) < 0.5, lower, q[200:])
    for x in q[::3]:
        T, r = r1.forward_kinematics(robot, x), task.value(robot, x)
        if isinstance(task, r1.PoseTask):
            asked = T.translation[None], T.rotation
        else:
            asked = (r[None], None) if isinstance(task, r1.PositionTask) else (r[None, :2], r[2:])
        assert r1.reachability_map(robot, task, *asked).status[0, 0] != PoseStatus.UNREACHABLE


RPR = [("R", 0.12, pi / 2, -0.29, 0), ("P", 0.4, pi / 2, 0, -1.41), ("R", 0.12, 0.08, 0.05, 0)]
RP = [("R", 0.36, 1.55, 0.22, 0), ("P", 0, 0, 0, 2.41)]
LIMITED = {
    "RPR": (RPR, [-0.8, 0, -2.3], [1.8, 0.7, 2.3], r1.PositionTask()),
    "RP": (RP, [-3, 0], [1.2, 0.7], PLANE),
    "RRP": ([("R", 0.22, -0.72, 0, 0), ("R", 0.65, -pi / 2, 0, 0), ("P", 0.37, 0.72, 0, -1.58)],
            [-2.4, -2.3, 0], [3, 1.9, 0.7], r1.PositionTask()),
}  # fmt: skip


@pytest.mark.parametrize("name", LIMITED)
def test_folds_at_joint_limits_are_not_called_unreachable(name):
    """There rounding hides double solutions from the formulas, or moves them beyond the limit."""
    rows, lower, upper, task = LIMITED[name]
    robot, rng = r1.robot_from_dh(rows, lower=lower, upper=upper), np.random.default_rng(4)
    q = rng.uniform(lower, upper, (90, len(rows)))
    q[:60] = np.clip(np.round(q[:60] / (pi / 2)) * pi / 2, lower, upper)
    q[30:60, 0] = upper[0]
    known = r1.reachability_map(robot, task, [task.value(robot, x) for x in q])
    assert (known.status != PoseStatus.UNREACHABLE).all()
    assert known.reached.mean() > 0.95


@pytest.fixture(scope="module")
def six():
    return arm("six_r")


@pytest.fixture(scope="module")
def cloud(six):
    return np.random.default_rng(5).uniform(-1, 1, (400, 3)) * six.reach


@pytest.fixture(scope="module")
def map_of_six(six, cloud):
    return r1.reachability_map(six, r1.PoseTask(), cloud, 30)


def test_what_is_reached_is_reached_by_pinocchio_too(six, map_of_six):
    known, task = map_of_six, r1.PoseTask()
    some = np.flatnonzero(known.reached.any(axis=1))
    assert 20 < len(some) < 390
    for i in some:
        q, T = known.q[i], r1.forward_kinematics(six, known.q[i])
        assert six.within_limits(q)
        assert T.translation == pytest.approx(known.positions[i], abs=1e-6)
        assert T.rotation == pytest.approx(known.orientations[known.orientation[i]], abs=1e-6)
        assert known.reached[i, known.orientation[i]]
        J = task.jacobian(six, q)
        assert known.manipulability[i] == pytest.approx(np.sqrt(np.linalg.det(J @ J.T)), abs=1e-9)


def test_what_is_out_of_reach_is_not_found_by_a_search_and_counts_are_those_of_all_solutions(six, map_of_six):
    known, rng = map_of_six, np.random.default_rng(0)
    solver = r1.IKSolver(six, r1.PoseTask(), time_limit=0.02)
    for i, j in zip(rng.integers(0, 400, 40), rng.integers(0, 30, 40), strict=True):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = known.orientations[j], known.positions[i]
        assert solver(r1.PoseTask().target(T)).converged == known.reached[i, j]
        if known.reached[i, j]:
            assert len(r1.ik_solutions(six, r1.PoseTask(), T)) == known.solutions[i, j]


def test_the_answer_is_the_same_on_one_thread_two_threads_and_in_other_processes(six):
    asked = (six, r1.PoseTask(), np.random.default_rng(6).uniform(-1, 1, (900, 3)) * six.reach, 20)
    progress = []
    with ThreadPoolExecutor(1) as one, ProcessPoolExecutor(2) as processes:
        alone = r1.reachability_map(*asked, executor=one, progress=lambda *numbers: progress.append(numbers))
        assert same_maps(alone, r1.reachability_map(*asked))
        assert same_maps(alone, r1.reachability_map(*asked, executor=processes))
    assert progress[-1] == (18000, 18000)
    assert len(progress) == 3


def best_of_self_motion(lengths, p):
    """The largest √det(J Jᵀ) of a planar 3R arm at p, over the direction φ of its last link and both elbows."""
    l1, l2, l3 = lengths
    best = 0.0
    for phi in np.linspace(-pi, pi, 1441):
        w = p - l3 * np.array([np.cos(phi), np.sin(phi)])
        c2 = (w @ w - l1**2 - l2**2) / (2 * l1 * l2)
        if abs(c2) > 1:
            continue
        for q2 in (np.arccos(c2), -np.arccos(c2)):
            q1 = np.arctan2(w[1], w[0]) - np.arctan2(l2 * np.sin(q2), l1 + l2 * np.cos(q2))
            from_joints = p - np.array([[0, 0], [l1 * np.cos(q1), l1 * np.sin(q1)], w])
            J = np.array([-from_joints[:, 1], from_joints[:, 0]])
            best = max(best, np.sqrt(np.linalg.det(J @ J.T)))
    return best


def test_more_configurations_of_a_redundant_arm_come_near_the_best_of_its_self_motion():
    lengths = (0.5, 0.4, 0.3)
    robot = r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths])
    positions = np.random.default_rng(4).uniform(-0.8, 0.8, (12, 2))
    best = np.array([best_of_self_motion(lengths, p) for p in positions])
    one, few, many = (r1.reachability_map(robot, PLANE, positions, configurations=c) for c in (1, 8, 64))
    assert (many.manipulability <= best * (1 + 1e-4)).all()
    assert (many.manipulability > 0.97 * best).all()
    assert (one.manipulability <= few.manipulability).all()
    assert (few.manipulability <= many.manipulability).all()
    assert (one.manipulability < 0.9 * best).any()
    assert (one.limit_margin <= many.limit_margin).all()
    for q, p, w in zip(many.q, positions, many.manipulability, strict=True):
        J = PLANE.jacobian(robot, q)
        assert PLANE.value(robot, q) == pytest.approx(p, abs=1e-6)
        assert np.sqrt(np.linalg.det(J @ J.T)) == pytest.approx(w, abs=1e-9)


def test_more_configurations_change_nothing_where_a_formula_gives_all():
    axis = np.linspace(-0.9, 0.9, 7)
    one, many = (r1.reachability_map(planar(), PLANE, {"x": axis, "y": axis}, configurations=c) for c in (1, 5))
    assert same_maps(one, many)


@pytest.mark.parametrize("wrong", [0, -1, 1.5, "all", 10**6])
def test_numbers_of_configurations_that_are_none_are_refused(wrong):
    with pytest.raises(r1.InputError, match="configurations"):
        r1.reachability_map(planar(), PLANE, [[0.3, 0.2]], configurations=wrong)


def test_a_redundant_arm_is_not_counted_and_what_is_not_found_is_not_called_unreachable():
    robot = arm("redundant")
    q = np.random.default_rng(0).uniform(*span(robot), (200, robot.nq))
    points = np.array([r1.forward_kinematics(robot, x).translation for x in q])
    far = points * 50
    known = r1.reachability_map(robot, r1.PositionTask(), np.vstack([points, far]))
    assert known.solutions is None
    assert known.reached[:200].mean() == 1
    assert (known.status[200:][np.linalg.norm(far, axis=1) > 3 * robot.reach] == PoseStatus.UNREACHABLE).all()


def test_without_orientations_a_pose_task_asks_for_the_position_alone(six, cloud):
    known = r1.reachability_map(six, r1.PoseTask(), cloud[:50])
    assert known.solutions is None
    assert np.array_equal(known.status, r1.reachability_map(six, r1.PositionTask(), cloud[:50]).status)
    assert known.orientations.shape == (1, 3, 3)


def test_spread_rotations_are_even_and_a_larger_tool_turn_changes_nothing_but_their_numbers(six, cloud):
    spread = r1.reachability_map(six, r1.PoseTask(), cloud[:1], 500).orientations
    angles = Rotation.from_matrix(spread)
    nearest = [np.sort((angles[i].inv() * angles).magnitude())[1] for i in range(0, 500, 25)]
    assert max(nearest) < 1.6 * min(nearest)  # random ones differ by more than ten
    order = np.random.default_rng(0).permutation(500)
    known = r1.reachability_map(six, r1.PoseTask(), cloud[:5], spread)
    moved = r1.reachability_map(six, r1.PoseTask(), cloud[:5], Rotation.from_matrix(spread[order]))
    assert np.array_equal(known.status[:, order], moved.status)
    assert known.manipulability == pytest.approx(moved.manipulability, nan_ok=True)


def test_the_volume_of_a_fine_grid_is_that_of_the_ring():
    axis = np.linspace(-0.85, 0.85, 341)
    known = r1.reachability_map(planar(), PLANE, {"x": axis, "y": axis})
    assert known.volume == pytest.approx(pi * ((L1 + L2) ** 2 - (L1 - L2) ** 2), rel=2e-3)
    assert known.on_grid(known.capability).shape == (341, 341)
    assert "m²" in known.explain()


def test_a_map_cannot_be_changed(map_of_six):
    with pytest.raises(ValueError, match="read-only"):
        map_of_six.status[0, 0] = 1
    assert isinstance(map_of_six, ReachabilityMap)
    assert "0 were not found" in map_of_six.explain()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((np.zeros((0, 3)), 3), "no position"),
        ((np.zeros((2, 2)), 3), r"positions must have shape \(any, 3\)"),
        (({"x": [0, 1]}, 3), "a grid names the coordinates x, y, z"),
        (({"x": [1, 0], "y": 0, "z": 0}, 3), "ascending"),
        (({"x": [], "y": 0, "z": 0}, 3), "one value or more"),
        ((np.zeros((2, 3)), 0), "orientations must be an integer of at least 1"),
        ((np.zeros((2, 3)), np.zeros((0, 3, 3))), "no orientation"),
        ((np.zeros((2, 3)), np.ones((1, 3, 3))), "rotation matrices"),
        ((dict.fromkeys("xyz", np.arange(10000.0)), 3), r"3e\+12 poses are too many.* GiB .* days"),
    ],
)
def test_misuse_says_what_would_be_right(six, arguments, message):
    with pytest.raises(r1.InputError, match=message):
        r1.reachability_map(six, r1.PoseTask(), *arguments)


def test_tasks_without_a_position_or_a_frame_are_refused(six):
    with pytest.raises(r1.TaskError, match="orientation only"):
        r1.reachability_map(six, r1.OrientationTask(), np.zeros((1, 3)), 2)
    with pytest.raises(r1.TaskError, match="pose of one frame"):
        r1.reachability_map(six, r1.FunctionTask(lambda p, R, q: [p @ p], 1), np.zeros((1, 3)))
    with pytest.raises(r1.InputError, match="no orientation"):
        r1.reachability_map(six, r1.PositionTask(), np.zeros((1, 3)), 4)
    with pytest.raises(r1.InputError, match="executor must be"):
        r1.reachability_map(six, r1.PositionTask(), np.zeros((1, 3)), executor=4)
    with pytest.raises(r1.InputError, match="progress must be a function"):
        r1.reachability_map(six, r1.PositionTask(), np.zeros((1, 3)), progress=4)
    with pytest.raises(r1.InputError, match="progress must be a function"):
        r1.workspaces.best_placements(six, r1.PoseTask(), [np.eye(4)], {"x": [0.0]}, progress=4)


def test_an_unlimited_prismatic_joint_is_refused():
    sliding = r1.robot_from_dh([("P", 0, 0, 0, 0), ("R", 0.3, 0, 0, 0)])
    with pytest.raises(r1.InputError, match="limits"):
        r1.reachability_map(sliding, r1.PositionTask("xz"), [[0.3, 0.1]])
