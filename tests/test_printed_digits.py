"""Configurations and matrices given with few digits: within their rounding of a singularity, or not."""

from math import pi

import closed_forms as cf
import numpy as np
import pytest
from arms import arm
from command import answer, run
from differences import outside
from hypothesis import assume, given, settings, strategies as st

import robotics1 as r1

PLANAR, XY, POSE = r1.PlanarPoseTask("xy"), r1.PositionTask("xy"), r1.PoseTask()
NEARLY = r1.trajectories.RateStatus.NEARLY_SINGULAR


def ur5():
    rows = [("R", 0, pi / 2, 0.0892, 0), ("R", -0.425, 0, 0, 0), ("R", -0.392, 0, 0, 0)]
    return r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0.109, 0), ("R", 0, -pi / 2, 0.095, 0), ("R", 0, 0, 0.082, 0)])


def planar_3r():
    return r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0), ("R", 0.5, 0, 0, 0)])


ROBOTS = {"prr": lambda: arm("prr"), "ur5": ur5, "3r": planar_3r, "2r": lambda: arm("planar_2r")}
TASKS = {"prr": PLANAR, "ur5": POSE, "3r": PLANAR, "2r": XY}
# robot, q as printed, the joint whose digits hide the singularity, its value there, the rank there
PRINTED = [
    ("prr", [0.2, 1.5708, 1.0], 1, pi / 2, 2),
    ("prr", [0.2, 1.57, 1.0], 1, pi / 2, 2),
    ("prr", [0.2, -1.571, 0.75], 1, -pi / 2, 2),
    ("prr", [0, 1.57080, 0], 1, pi / 2, 2),
    ("prr", [0.25, 1.570796, 0.3], 1, pi / 2, 2),
    ("prr", [0.25, 4.7124, 0.3], 1, 3 * pi / 2, 2),
    ("2r", [0.5, 3.1416], 1, pi, 1),
    ("2r", [0.5, 3.14], 1, pi, 1),
    ("2r", [0.5, -6.2832], 1, -2 * pi, 1),
    ("2r", [0.5, 3.14159265], 1, pi, 1),
    ("3r", [0.2, 3.1416, 0], 1, pi, 2),
    ("3r", [0.25, -3.142, 1.25], 1, -pi, 2),
    ("ur5", [0.3, -1.2, 0.8, 0.4, 3.1416, 0.2], 4, pi, 5),
    ("ur5", [0.31, -1.22, 0.83, 0.44, -3.142, 0.2], 4, -pi, 5),
    ("ur5", [0.3, -1.2, 3.1416, 0.4, 0.7, 0.2], 2, pi, 5),
]


@pytest.mark.parametrize(("name", "q", "joint", "value", "rank"), PRINTED)
def test_a_printed_configuration_that_rounds_a_singular_one_is_nearly_singular(name, q, joint, value, rank):
    robot, task = ROBOTS[name](), TASKS[name]
    rounded = r1.singularities.singularity_within_rounding(robot, task, q)
    exact = np.array(q, dtype=float)
    exact[joint] = value
    assert rounded.status is r1.singularities.RankStatus.NEARLY_SINGULAR
    assert rounded.singular_q == pytest.approx(exact, abs=1e-9)
    assert np.flatnonzero(rounded.singular_q != q).tolist() == [joint]
    assert rounded.at_singularity.rank == rank == np.linalg.matrix_rank(task.jacobian(robot, exact), tol=1e-9)
    assert f"{robot.joint_names[joint]} = {q[joint]}" in rounded.explain()
    rdot = np.linspace(0.1, 0.3, task.rows)
    found = r1.joint_velocity(robot, task, rdot, q)
    there = r1.joint_velocity(robot, task, rdot, exact)
    assert found.status is NEARLY
    assert found.at_singularity.qdot == pytest.approx(there.qdot, abs=1e-8)
    assert np.abs(found.at_singularity.qdot).max() < 10 < np.abs(found.qdot).max()
    assert found.at_singularity.status is there.status is r1.trajectories.RateStatus.OUT_OF_RANGE
    assert "nearly singular" in found.explain()
    assert "at_singularity" in found.explain()
    second = r1.joint_acceleration(robot, task, rdot, q, np.full(robot.nv, 0.1))
    assert second.status is NEARLY
    expected = r1.joint_acceleration(robot, task, rdot, exact, np.full(robot.nv, 0.1))
    assert second.at_singularity.qddot == pytest.approx(expected.qddot, abs=1e-7)


def test_the_answer_at_the_singularity_of_a_prr_is_the_exams():
    rounded = r1.singularities.singularity_within_rounding(arm("prr"), PLANAR, [0.3, 1.5708, 0.7])
    there = rounded.at_singularity
    assert outside(there.null, cf.prr_null(1, 0.6)) == pytest.approx(np.zeros(3), abs=1e-9)
    assert outside(there.left_null, cf.prr_left_null(1, 0.7, 0.4)) == pytest.approx(np.zeros(3), abs=1e-9)


def test_a_velocity_in_the_range_at_the_singularity_is_realised_there():
    robot, q = arm("planar_2r", l1=1.0, l2=0.5), [0.0, 3.1416]
    found = r1.joint_velocity(robot, XY, [0.0, 0.4], q)
    assert found.status is NEARLY
    assert found.at_singularity.status is r1.trajectories.RateStatus.REALISED_ALL_THE_SAME
    J = XY.jacobian(robot, [0.0, pi])
    assert J @ found.at_singularity.qdot == pytest.approx([0, 0.4], abs=1e-9)


NEAR_MISSES = [
    ("2r", [0.5, 0.02]),
    ("2r", [0.5, 0.001]),
    ("2r", [0.5, 0.0001]),
    ("2r", [0.5, 3.12]),
    ("2r", [0.5, 3.1415]),  # 3.1416 is nearer
    ("2r", [0.5, 3]),
    ("2r", [0.5, pi + 1e-6]),
    ("prr", [0.2, 1.56, 1.0]),
    ("prr", [0.2, 1.5707, 1.0]),
    ("prr", [0.2, 1.5, 1.0]),
    ("prr", [0.2, 2, 1]),
    ("prr", [0.2, pi / 2 + 3e-6, 1.0]),
    ("ur5", [0.3, -1.2, 0.8, 0.4, 0.0001, 0.2]),
    ("ur5", [0.3, -1.2, 0.8, 0.4, 3.13, 0.2]),
    ("3r", [0.2, 3.1, 0.0]),
]


@pytest.mark.parametrize(("name", "q"), NEAR_MISSES)
def test_a_singularity_beyond_half_a_unit_of_the_last_digit_is_not_within_rounding(name, q):
    robot, task = ROBOTS[name](), TASKS[name]
    assert r1.singularities.singularity_within_rounding(robot, task, q).status is r1.singularities.RankStatus.FULL_RANK
    found = r1.joint_velocity(robot, task, np.ones(task.rows), q)
    assert found.status is r1.trajectories.RateStatus.REALISED
    assert found.at_singularity is None


@pytest.mark.parametrize(("name", "q"), [("2r", [0.5, 0.0]), ("2r", [0.5, pi]), ("prr", [0.2, pi / 2, 1.0])])
def test_a_configuration_that_is_singular_itself_is_no_near_miss(name, q):
    robot, task = ROBOTS[name](), TASKS[name]
    rounded = r1.singularities.singularity_within_rounding(robot, task, q)
    assert rounded.status is r1.singularities.RankStatus.RANK_DEFICIENT
    assert rounded.at_singularity is None


@given(st.integers(0, 10**6), st.sampled_from(["prr", "2r", "3r"]), st.sampled_from([2, 3, 4, 5, 6, None]))
@settings(max_examples=60)
def test_random_configurations_away_from_singularities_are_not_nearly_singular(seed, name, decimals):
    robot, task = ROBOTS[name](), TASKS[name]
    q = np.random.default_rng(seed).uniform(-3, 3, robot.nv)
    q = q if decimals is None else q.round(decimals)
    away = np.abs(np.cos(q[1]) if name == "prr" else np.sin(q[1]))
    assume(decimals is None or away > 0.6 * 10.0**-decimals)
    assert r1.singularities.singularity_within_rounding(robot, task, q).status is r1.singularities.RankStatus.FULL_RANK


@given(st.integers(0, 10**6), st.integers(2, 9), st.sampled_from([-pi, 0.0, pi, 2 * pi]))
@settings(max_examples=40)
def test_any_rounding_of_a_singular_configuration_is_nearly_singular_or_singular(seed, decimals, value):
    robot = ur5()
    q = np.random.default_rng(seed).uniform(-2.5, 2.5, 6)
    assume(min(abs(np.sin(q[2])), abs(np.cos(q[1] + q[2] + q[3]))) > 0.2)
    q[4] = value
    rounded = r1.singularities.singularity_within_rounding(robot, POSE, q.round(decimals))
    assert rounded.status is not r1.singularities.RankStatus.FULL_RANK


@pytest.mark.parametrize("q", [np.float32([0.2, 1.5708, 1.0]), (0.2, 1.5708, 1), np.array([0.2, 1.5708, 1.0])])
def test_the_digits_of_any_kind_of_number_count(q):
    assert r1.joint_velocity(arm("prr"), PLANAR, [0.1, 0.2, 0.3], q).status is NEARLY


def test_with_an_input_matrix_the_rank_of_j_times_g_counts():
    robot = arm("planar_2r", l1=1.0, l2=1.0)
    coupled = r1.trajectories.Resolution(input_matrix=[[1, 0], [-1, 1]])
    found = r1.joint_velocity(robot, XY, [1, 1], [0.4, 3.1416], resolution=coupled)
    assert found.status is NEARLY
    assert np.abs(found.at_singularity.inputs).max() < 10


def test_a_redundant_arm_is_nearly_singular_where_all_its_minors_vanish():
    found = r1.joint_velocity(planar_3r(), XY, [0.1, 0.1], [0.2, 3.1416, 3.1416])
    assert found.status is NEARLY
    assert found.rounded.singular_q == pytest.approx([0.2, pi, pi])
    assert (
        r1.joint_velocity(planar_3r(), XY, [0.1, 0.1], [0.25, 3.1416, 0.41]).status
        is r1.trajectories.RateStatus.REALISED
    )


def half_units(q):
    robot = r1.robot_from_dh([("R", 1, 0, 0, 0)] * len(q))
    return r1.singularities.singularity_within_rounding(robot, XY, q).half_units


def test_half_units_are_those_of_the_last_digit():
    assert half_units([1.5708, 0.25, -3.142]) == pytest.approx([5e-5, 5e-3, 5e-4])
    assert half_units([1.5708, 1, 0.5]) == pytest.approx([5e-5] * 3)  # 1.0000 and 0.5000
    assert half_units([1, 0, -2, 0.5, 7.0]).tolist() == [0] * 5
    assert half_units([pi, 1 / 3, 0.1 + 0.2]).tolist() == [0] * 3
    assert half_units([0.0001, 1e-6]) == pytest.approx([5e-5, 5e-7])


@pytest.mark.parametrize(("name", "q", "joint", "value", "rank"), PRINTED)
def test_the_manipulability_at_printed_digits_names_the_joint_and_is_zero_at_the_singularity(
    name, q, joint, value, rank
):
    robot, task = ROBOTS[name](), TASKS[name]
    exact = np.array(q, dtype=float)
    exact[joint] = value
    found = r1.singularities.manipulability(robot, task, q)
    there, expected = found.at_singularity, r1.singularities.manipulability(robot, task, exact)
    assert found.status is r1.singularities.RankStatus.NEARLY_SINGULAR
    assert f"{robot.joint_names[joint]} = {q[joint]}" in found.explain()
    assert found.measure > there.measure == expected.measure == 0
    assert there.velocity_ellipsoid.lengths == pytest.approx(expected.velocity_ellipsoid.lengths, abs=1e-8)
    assert np.isinf(there.force_ellipsoid.lengths).sum() == task.rows - rank
    assert found.rounded.singular_q == pytest.approx(exact, abs=1e-9)


@pytest.mark.parametrize(("name", "q"), NEAR_MISSES)
def test_the_manipulability_beyond_the_rounding_is_its_own_answer(name, q):
    found = r1.singularities.manipulability(ROBOTS[name](), TASKS[name], q)
    assert found.at_singularity is found
    assert found.rounded.singular_q is None


# --- matrices


def test_a_printed_matrix_is_nearly_singular_where_a_singular_one_rounds_to_it():
    J = np.array([[0.7071, 0.7071], [0.5, 0.5001]])
    s = r1.subspaces(J)
    assert (s.rank, s.status, s.nearly_singular) == (2, r1.singularities.RankStatus.NEARLY_SINGULAR, True)
    assert s.rounding == pytest.approx(1e-4)
    there = s.at_singularity
    assert (there.rank, there.null.shape, there.left_null.shape) == (1, (2, 1), (2, 1))
    assert np.abs(there.null[:, 0]) == pytest.approx([np.sqrt(0.5)] * 2, abs=1e-4)
    assert np.linalg.norm(there.J - J) == pytest.approx(s.singular_values[1])
    assert "rank 2 of 2" in s.explain()
    assert "without it the rank is 1" in s.explain()


@pytest.mark.parametrize(
    "J",
    [
        np.eye(3),
        [[0.5, 0.3], [1.0, 0.61]],
        [[0.5, 0.3], [0.2, 0.4]],
        [[1, 2], [3, 4]],
        [[0.7071, 0.7071], [0.5, 0.51]],
        [[1, 0], [0, 2e-9]],
        np.diag([1.0, 1e-3]) @ [[np.cos(1), np.sin(1)], [-np.sin(1), np.cos(1)]],
        np.zeros((0, 3)),
        np.zeros((2, 0)),
    ],
)
def test_a_matrix_away_from_singular_ones_has_a_certain_rank(J):
    s = r1.subspaces(J)
    assert s.status is r1.singularities.RankStatus.FULL_RANK
    assert s.at_singularity is s


def test_a_jacobian_at_a_printed_configuration_is_nearly_singular_and_its_rank_stays():
    s = r1.subspaces(PLANAR.jacobian(arm("prr"), [0.2, 1.5708, 1.0]))
    assert (s.rank, s.status, s.at_singularity.rank) == (3, r1.singularities.RankStatus.NEARLY_SINGULAR, 2)
    assert outside(s.at_singularity.null, cf.prr_null(1, 0.6)) == pytest.approx(np.zeros(3), abs=1e-4)
    assert r1.subspaces(s.J, rounding=0).status is r1.singularities.RankStatus.FULL_RANK
    assert r1.subspaces(np.diag([1, 0.1, 0]), rounding=0.2).at_singularity.rank == 1
    assert r1.subspaces(np.diag([1, 0.1, 0])).status is r1.singularities.RankStatus.RANK_DEFICIENT
    with pytest.raises(r1.InputError, match="rounding"):
        r1.subspaces(np.eye(2), rounding=-1)


# --- the command


def test_the_commands_jacobian_and_statics_print_the_singularity_within_the_digits():
    at = ["prr", "--q", "0.2,1.5708,1", "--task", "planar-pose"]
    shown = run("jacobian", *at).stdout
    assert "nearly singular" in shown
    assert "π/2" in shown
    found = answer("jacobian", *at)
    assert (found["rank"], found["status"], found["at_singularity"]["rank"]) == (3, "NEARLY_SINGULAR", 2)
    assert found["at_singularity"]["q"] == pytest.approx([0.2, pi / 2, 1])
    assert "need no torque" in run("statics", *at, "--force", "1,0,0").stdout
    found = answer("statics", *at, "--force", "1,0,0")
    assert (found["status"], len(found["at_singularity"]["left_null"])) == ("NEARLY_SINGULAR", 1)
    found = answer("jacobian", "prr", "--q", "0.2,1.5,1", "--task", "planar-pose")
    assert (found["status"], found["at_singularity"]) == ("FULL_RANK", None)
