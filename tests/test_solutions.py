from math import nan, pi, sqrt

import closed_forms as cf
import numpy as np
import pytest
from arms import ARMS, arm, random_q
from differences import same_rows
from hypothesis import given, settings, strategies as st

from robotics1 import (
    InputError,
    NotConverged,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    UnknownNameError,
    ik_solutions,
)
from robotics1.ik import IKStatus

SPACE, POINT, POSE = PositionTask("xyz"), PositionTask("xy"), PlanarPoseTask("xy")


def assert_solutions(robot, task, target, found):
    """Each one reaches the target, inside the limits, and differs from the others."""
    for i, q in enumerate(found.q):
        assert np.linalg.norm(task.error(robot, q, target)) <= 2e-9 * max(1.0, robot.reach)
        assert robot.within_limits(q)
        for other in found.q[:i]:
            assert np.abs(np.exp(1j * q[robot.revolute]) - np.exp(1j * other[robot.revolute])).max() > 1e-7 or (
                np.abs(q - other)[~robot.revolute].max() > 1e-7
            )
    assert found.singular.shape == (len(found),)


# --- closed forms


@given(st.floats(0.45, 1.95), st.floats(-pi, pi))
@settings(max_examples=15)
def test_planar_2r_has_the_right_and_the_left_arm(radius, angle):
    p = [radius * np.cos(angle), radius * np.sin(angle)]
    found = ik_solutions(arm("planar_2r"), POINT, p, starts=30)
    assert found.status is IKStatus.FINITE
    same_rows(found.q, cf.two_link_solutions(p, 1.2, 0.8), np.array([True, True]), atol=1e-8)
    assert not found.singular.any()


@pytest.mark.parametrize(
    ("p", "q"),
    [
        ([2, 0], [0, 0]),
        ([0, -2], [-pi / 2, 0]),
        ([sqrt(2), sqrt(2)], [pi / 4, 0]),
        ([0.4, 0], [0, pi]),
        ([-0.4, 0], [pi, pi]),
    ],
)
def test_planar_2r_stretched_or_folded_has_one_singular_solution(planar_2r, p, q):
    found = ik_solutions(planar_2r, POINT, p)
    assert found.status is IKStatus.BOUNDARY
    same_rows(found.q, q, planar_2r.revolute, atol=1e-7)
    assert found.singular.tolist() == [True]


@pytest.mark.parametrize("gap", [1e-3, 1e-5, 1e-7])
def test_planar_2r_nearly_stretched_has_two_close_solutions(planar_2r, gap):
    """q2 = ±acos(...) ≈ ±2 sqrt(gap/...): apart by much more than the gap."""
    found = ik_solutions(planar_2r, POINT, [2 - gap, 0])
    same_rows(found.q, cf.two_link_solutions([2 - gap, 0], 1.2, 0.8), planar_2r.revolute, atol=1e-6)
    assert found.singular.tolist() == [False, False]


@pytest.mark.parametrize(("p", "miss"), [([2.1, 0], 0.1), ([0, 3], 1.0), ([0.1, 0], 0.3), ([2 + 1e-6, 0], 1e-6)])
def test_planar_2r_out_of_reach_misses_by_the_distance_to_the_ring(planar_2r, p, miss):
    found = ik_solutions(planar_2r, POINT, p, starts=200)
    assert (found.status, len(found), found.q.shape) == (IKStatus.UNREACHABLE, 0, (0, 2))
    assert found.error_norm == pytest.approx(miss, abs=1e-7)
    with pytest.raises(NotConverged, match="nearest miss") as caught:
        found.require()
    assert caught.value.result is found


def test_planar_2r_with_equal_links_reaches_its_base_in_every_direction():
    found = ik_solutions(arm("planar_2r", l1=0.5, l2=0.5), POINT, [0, 0])
    assert found.status is IKStatus.INFINITE
    assert found.q[:, 1] == pytest.approx(np.full(len(found), pi), abs=1e-7)
    assert found.singular.all()


@pytest.mark.parametrize("p", [(1, -1, 3), (-0.5, 2, -1), (0.01, 0.02, 0)])
def test_cylindrical_reaches_a_point_forwards_and_backwards(cylindrical, p):
    found = ik_solutions(cylindrical, SPACE, p)
    assert found.status is IKStatus.FINITE
    same_rows(found.q, cf.cylindrical_solutions(p), cylindrical.revolute, atol=1e-7)


def test_cylindrical_reaches_its_axis_with_any_q2(cylindrical):
    found = ik_solutions(cylindrical, SPACE, [0, 0, 3])
    assert found.status is IKStatus.INFINITE
    assert found.q[:, 0] == pytest.approx(np.full(len(found), 3), abs=1e-8)
    assert found.q[:, 2] == pytest.approx(np.zeros(len(found)), abs=1e-8)
    assert np.ptp(found.q[:, 1]) > pi
    assert found.singular.all()


def test_prr_planar_pose_has_two_solutions_q2_and_pi_minus_q2():
    """l2 sin q2 = y − l3 sin φ leaves q2 and π − q2; then q1 = x − l2 c2 − l3 cos φ and q3 = φ − q2."""
    robot, (x, y, phi) = arm("prr"), (0.3, 0.5, 0.9)
    s2 = (y - 0.4 * np.sin(phi)) / 0.6
    wanted = [[x - 0.6 * np.cos(q2) - 0.4 * np.cos(phi), q2, phi - q2] for q2 in (np.arcsin(s2), pi - np.arcsin(s2))]
    found = ik_solutions(robot, POSE, [x, y, phi])
    same_rows(found.q, wanted, robot.revolute, atol=1e-8)


def test_anthropomorphic_has_four_solutions_shoulder_and_elbow():
    """Shoulder: (q1, q2, q3) → (q1 + π, π − q2, −q3); elbow: as the planar 2R."""
    robot, q = arm("anthropomorphic"), np.array([0.3, 0.7, -1.1])
    out, up = cf.anthropomorphic_position([0, q[1], q[2]], 0, 0.5, 0.35)[[0, 2]]
    elbows = [[q[0], *pair] for pair in cf.two_link_solutions([out, up], 0.5, 0.35)]
    wanted = elbows + [[a + pi, pi - b, -c] for a, b, c in elbows]
    found = ik_solutions(robot, SPACE, cf.anthropomorphic_position(q, 0.4, 0.5, 0.35))
    assert found.status is IKStatus.FINITE
    same_rows(found.q, wanted, robot.revolute, atol=1e-8)


@pytest.mark.parametrize("seed", range(3))
def test_six_r_with_a_spherical_wrist_has_eight_solutions_in_pairs_of_wrist_flips(seed):
    robot = arm("six_r")
    q = random_q(robot, seed)
    target = PoseTask().value(robot, q)
    found = ik_solutions(robot, PoseTask(), target)
    assert (found.status, len(found)) == (IKStatus.FINITE, 8)
    assert_solutions(robot, PoseTask(), target, found)
    flipped = found.q * [1, 1, 1, 1, -1, 1] + [0, 0, 0, pi, 0, pi]
    same_rows(found.q, flipped, robot.revolute, atol=1e-7)
    assert np.abs(np.exp(1j * found.q) - np.exp(1j * q)).max(axis=1).min() < 1e-7


# --- families


@pytest.mark.parametrize(
    ("name", "task"),
    [
        ("planar_3r", POINT),
        ("redundant", PoseTask()),
        ("spatial", SPACE),
        ("prr", POINT),
        ("six_r", SPACE),
        ("planar_2r", PositionTask("x")),
        ("redundant", OrientationTask()),
    ],
)
def test_more_joints_than_rows_leave_infinitely_many_solutions(name, task):
    robot = arm(name)
    target = task.value(robot, 0.5 * random_q(robot, 1))
    found = ik_solutions(robot, task, target, starts=20)
    assert found.status is IKStatus.INFINITE
    assert len(found) >= 2
    assert_solutions(robot, task, target, found)


def test_a_stretched_redundant_arm_has_one_solution():
    found = ik_solutions(arm("planar_3r"), POINT, [1.2, 0])
    assert found.status is IKStatus.BOUNDARY
    assert found.q == pytest.approx(np.zeros((1, 3)), abs=1e-6)
    assert found.singular.tolist() == [True]


# --- laws


@pytest.mark.parametrize("name", [name for name in ARMS if name not in ("two_tips", "redundant")])
@pytest.mark.parametrize("seed", range(2))
def test_the_configuration_that_made_the_target_is_among_finitely_many_solutions(name, seed):
    robot = arm(name)
    q = 0.95 * random_q(robot, seed)
    target = PoseTask().value(robot, q)
    found = ik_solutions(robot, PoseTask(), target, starts=60).require()
    assert found.status is IKStatus.FINITE
    assert_solutions(robot, PoseTask(), target, found)
    apart = np.where(robot.revolute, np.abs(np.exp(1j * found.q) - np.exp(1j * q)), np.abs(found.q - q))
    assert apart.max(axis=1).min() < 1e-7
    assert found.error_norm <= 1e-8


def test_limits_leave_one_of_the_two_arms():
    robot = arm("elbow_limited")
    right, _ = cf.two_link_solutions([0.6, 0.7], 0.7, 0.4)
    found = ik_solutions(robot, POINT, [0.6, 0.7])
    assert found.q == pytest.approx(right[None], abs=1e-8)
    assert ik_solutions(robot, POINT, [1.1, 0]).status is IKStatus.UNREACHABLE


def test_a_target_beyond_a_slide_is_unreachable(cylindrical):
    found = ik_solutions(cylindrical, SPACE, [1, 0, 5])
    assert found.status is IKStatus.UNREACHABLE
    assert found.error_norm == pytest.approx(1, abs=1e-9)
    assert found.closest[0] == pytest.approx(4, abs=1e-9)


def test_a_box_narrows_the_search(planar_2r):
    right, left = cf.two_link_solutions([0.5, 1.1], 1.2, 0.8)
    for interval, q in (((0, 3), right), ((-3, 0), left)):
        found = ik_solutions(planar_2r, POINT, [0.5, 1.1], box={"q2": interval})
        assert found.q == pytest.approx(q[None], abs=1e-8)


def test_the_same_seed_gives_the_same_solutions(spatial):
    target = SPACE.value(spatial, random_q(spatial, 3))
    a, b = (ik_solutions(spatial, SPACE, target, starts=20, seed=5) for _ in range(2))
    assert np.array_equal(a.q, b.q)


def test_a_search_does_not_claim_to_be_complete(planar_2r):
    assert not ik_solutions(planar_2r, POINT, [0.5, 1.1], method="search", starts=10).complete


# --- misuse


@pytest.mark.parametrize(
    ("target", "options"),
    [
        ([1, 2, 3], {}),
        ([1, nan], {}),
        (None, {}),
        ([1, 0], {"method": "guess"}),
        ([1, 0], {"starts": 0}),
        ([1, 0], {"seed": 0.5}),
        ([1, 0], {"box": {"q1": (2, 1)}}),
        ([1, 0], {"box": {"q1": (-9, 9)}}),
    ],
)
def test_bad_targets_and_options_are_input_errors(planar_2r, target, options):
    with pytest.raises(InputError):
        ik_solutions(planar_2r, POINT, target, **options)


def test_a_box_of_an_unknown_joint_lists_the_joints(planar_2r):
    with pytest.raises(UnknownNameError, match="'q1', 'q2'"):
        ik_solutions(planar_2r, POINT, [1, 0], box={"elbow": (0, 1)})


def test_axes_that_move_are_a_task_error(spatial):
    with pytest.raises(TaskError, match="move with the robot"):
        ik_solutions(spatial, PositionTask("xyz", reference="tool"), [1, 0, 0])


# --- how sure a search is


def test_a_search_goes_on_until_half_a_solution_is_to_be_expected():
    robot = arm("six_r")
    q = random_q(robot, np.random.default_rng(2))
    found = ik_solutions(robot, PoseTask(), PoseTask().value(robot, q), method="search")
    w, reached = len(found), found.hits.sum()
    assert found.hits.shape == (w,)
    assert (found.hits > 0).all()
    assert 2 * w**2 + 3 * w + 2 <= reached <= 1000
    assert found.unseen == pytest.approx(w * (w + 1) / (reached * (reached - 1)))
    assert f"{reached} starts led to these" in found.explain()


def test_few_starts_leave_much_unseen_and_a_formula_nothing():
    p = [0.9, 0.7]
    few = ik_solutions(arm("planar_2r"), POINT, p, method="search", starts=1)
    assert (list(few.hits), few.unseen) == ([1], 1.0)
    exact = ik_solutions(arm("planar_2r"), POINT, p)
    assert (len(exact.hits), exact.unseen) == (0, 0.0)


def test_of_infinitely_many_solutions_no_hits_are_counted():
    found = ik_solutions(arm("planar_3r"), POINT, [1.0, 0.5])
    assert found.status is IKStatus.INFINITE
    assert len(found.hits) == 0
