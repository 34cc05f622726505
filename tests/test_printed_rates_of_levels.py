"""Rates given with few digits, of tasks by priority and within limits: realised as far as the digits tell, or not."""

from math import pi

import numpy as np
import pytest
from arms import arm, random_q
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.redundancy import (
    LevelStatus,
    SaturationStatus,
    priority_acceleration,
    priority_velocity,
    saturated_acceleration,
    saturated_priority_acceleration,
    saturated_priority_velocity,
    saturated_velocity,
)

H = pi / 2
POSE, XYZ, TURN = r1.PoseTask(), r1.PositionTask(), r1.OrientationTask()
FOUR = r1.robot_from_dh([("R", 0, H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, H, 1, 0), ("R", 1, 0, 0, 0)])
WITHIN, REALISED = LevelStatus.REALISED_WITHIN_DIGITS, LevelStatus.REALISED
digits, seeds = st.integers(3, 5), st.integers(0, 99)  # with seven, some rates are right to 1e-8


def drawn(seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(-2, 2, 4), rng.uniform(-1, 1, 4)


@given(digits=digits, seed=seeds)
def test_a_twist_of_four_joints_is_realised_with_any_number_of_its_digits(digits, seed):
    q, qdot = drawn(seed)
    printed = np.round(POSE.jacobian(FOUR, q) @ qdot, digits)
    for method in ("levels", "projection", "stacked"):
        one = priority_velocity(FOUR, [(POSE, printed)], q, method=method).require()
        assert one.levels[0].status is WITHIN
        assert one.levels[0].residual == pytest.approx(printed - POSE.jacobian(FOUR, q) @ one.joints, abs=1e-12)
    for method in ("optimal", "sns", "scaled"):
        free = saturated_velocity(FOUR, POSE, printed, q, limits=50, method=method).require()
        assert (free.status, free.within_digits) == (SaturationStatus.WITHIN_LIMITS, True)
        assert "rounding of the given digits" in free.explain()
        assert free.joints == pytest.approx(one.joints, abs=1e-9)
    half = saturated_velocity(FOUR, POSE, printed, q, limits=0.5 * np.abs(one.joints).max())
    assert (half.status, half.scale) == (SaturationStatus.SCALED, pytest.approx(0.5))


@given(digits=digits, seed=seeds)
def test_two_levels_that_agree_but_for_their_digits_are_both_realised(digits, seed):
    """Position and turn of four joints: six numbers, of which two follow from the others."""
    q, qdot = drawn(seed)
    levels = [(task, np.round(task.jacobian(FOUR, q) @ qdot, digits)) for task in (XYZ, TURN)]
    found = priority_velocity(FOUR, levels, q).require()
    assert [level.status for level in found.levels] == [REALISED, WITHIN]
    within = saturated_priority_velocity(FOUR, levels, q, limits=50).require()
    assert (within.scales, within.realised) == ((1, 1), (True, True))
    assert within.joints == pytest.approx(found.joints, abs=1e-6)
    assert within.residuals[1] == pytest.approx(found.levels[1].residual, abs=1e-6)


@given(digits=st.integers(3, 6), seed=seeds)
def test_what_the_digits_do_not_explain_stays_out_of_range_or_in_conflict(digits, seed):
    q, qdot = drawn(seed)
    J = POSE.jacobian(FOUR, q)
    normal = r1.subspaces(J).left_null[:, 0]
    away = 2 * 0.5 * 10.0**-digits * np.abs(normal).sum()  # twice what the digits can make of the part along it
    asked = np.round(J @ qdot + away * normal, digits)
    assert priority_velocity(FOUR, [(POSE, asked)], q).levels[0].status is LevelStatus.OUT_OF_RANGE
    assert saturated_velocity(FOUR, POSE, asked, q, limits=50).status is SaturationStatus.OUT_OF_RANGE
    levels = [(XYZ, asked[:3]), (TURN, asked[3:])]
    statuses = [level.status for level in priority_velocity(FOUR, levels, q).levels]
    assert statuses == [REALISED, LevelStatus.IN_CONFLICT]
    saturated = saturated_priority_velocity(FOUR, levels, q, limits=50)
    assert saturated.realised[0]
    assert not saturated.realised[1]
    with pytest.raises(r1.NotConverged):
        saturated.require()


@given(digits=st.integers(4, 6), seed=seeds)
def test_printed_accelerations_are_realised_too(digits, seed):
    q, qdot = drawn(seed)
    qddot = np.array([0.1, 0.4, -0.3, 0.2])
    asked = [
        np.round(
            r1.joint_acceleration(FOUR, task, np.zeros(task.rows), q, qdot).drift + task.jacobian(FOUR, q) @ qddot,
            digits,
        )
        for task in (POSE, XYZ, TURN)
    ]
    one = priority_acceleration(FOUR, [(POSE, asked[0])], q, qdot).require()
    levels = list(zip((XYZ, TURN), asked[1:], strict=True))
    two = priority_acceleration(FOUR, levels, q, qdot).require()
    assert [level.status for level in (*one.levels, *two.levels)] == [WITHIN, REALISED, WITHIN]
    assert saturated_acceleration(FOUR, POSE, asked[0], q, qdot, limits=90).require().within_digits
    assert saturated_priority_acceleration(FOUR, levels, q, qdot, limits=90).require().realised == (True, True)


def test_the_configuration_may_be_printed_too():
    """Joint 1 of a polar arm must be at π/4 for this velocity at its singularity; 0.7855 does not stand for it."""
    polar = r1.robot_from_dh([("R", 0, H, 1, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)])
    v = [-0.577350269189626, -0.577350269189626, 0.577350269189626]
    for first, status in ((0.7854, WITHIN), (0.7855, LevelStatus.OUT_OF_RANGE)):
        assert priority_velocity(polar, [(XYZ, v)], [first, pi, 1.0]).levels[0].status is status
        assert saturated_velocity(polar, XYZ, v, [first, pi, 1.0], limits=9).within_digits is (status is WITHIN)


@pytest.mark.parametrize("name", ["six_r", "prr", "cylindrical", "planar_3r"])
@pytest.mark.parametrize("size", [1e-9, 1.0, 1e9])
def test_the_verdicts_do_not_depend_on_the_unit_of_the_rates(name, size):
    robot = arm(name)
    q = random_q(robot, 3)
    J = XYZ.jacobian(robot, q)
    inside = J @ np.linspace(0.3, 0.8, robot.nv)
    spaces = r1.subspaces(J)
    found = saturated_priority_velocity(robot, [(XYZ, size * inside)], q, limits=size * 50)
    assert found.require().realised == (True,)
    assert not found.saturated.any()
    for normal in spaces.left_null.T:
        off = saturated_priority_velocity(robot, [(XYZ, size * (inside + 0.1 * normal))], q, limits=size * 50)
        assert off.realised == (False,)
        assert "not in the range" in off.explain()
    least = np.abs(np.linalg.pinv(J) @ inside).max()
    halved = saturated_velocity(robot, XYZ, size * inside, q, limits=size * least / 2, method="scaled")
    assert (halved.status, halved.scale) == (SaturationStatus.SCALED, pytest.approx(0.5))
    assert halved.saturated.any()


PLANAR = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
XY = r1.PositionTask("xy")


@pytest.mark.parametrize("folded", [3.1416, 3.14159, 3.142])
def test_a_configuration_printed_at_a_singularity_is_nearly_singular_and_has_the_answer_there(folded):
    """A folded planar arm: at the printed digits q̇ is 10³ or more, at π the velocity across the arm is realised."""
    q, v = [0.5, folded, 0.0], [np.sin(0.5), -np.cos(0.5)]
    there = [0.5, pi, 0.0]
    J = XY.jacobian(PLANAR, there)
    wanted = np.linalg.pinv(J, rcond=1e-9) @ v
    answers = [
        priority_velocity(PLANAR, [(XY, v)], q),
        priority_acceleration(PLANAR, [(XY, v)], q, [0, 0, 0]),
        saturated_velocity(PLANAR, XY, v, q, limits=1e6),
        saturated_acceleration(PLANAR, XY, v, q, [0, 0, 0], limits=1e6),
        saturated_priority_velocity(PLANAR, [(XY, v)], q, limits=1e6),
        saturated_priority_acceleration(PLANAR, [(XY, v)], q, [0, 0, 0], limits=1e6),
    ]
    for answer in answers:
        assert answer.rounded.singular_q == pytest.approx(there)
        assert answer.at_singularity.joints == pytest.approx(wanted, abs=1e-8)
        assert answer.at_singularity.require()
        assert "nearly singular" in answer.explain()
        with pytest.raises(r1.NotConverged, match="nearly singular"):
            answer.require()


def test_levels_that_meet_at_a_printed_algorithmic_singularity_say_so():
    """Tip and end of link 1: each alone is regular; with the last two links in line both together are singular."""
    tall = r1.textbook_robots.planar_arm("RRR", [1.0, 1.0, 1.0])
    levels = [(XY, [0.1, 0.2]), (r1.PositionTask("y", frame="link2"), [0.3])]
    found = priority_velocity(tall, levels, [0.3, 1.2, 3.1416])
    both = np.vstack([task.jacobian(tall, [0.3, 1.2, pi]) for task, _ in levels])
    assert np.linalg.matrix_rank(both) == 2
    assert found.rounded.singular_q == pytest.approx([0.3, 1.2, pi])
    assert found.at_singularity.levels[0].is_realised


def test_configurations_that_are_computed_or_far_from_a_singularity_are_as_before():
    v = [0.3, -0.2]
    for q in ([0.5, pi - 1e-7, 0.0], [0.5, 1.2, 0.4], [0.5, 1.2345, 0.4]):
        assert priority_velocity(PLANAR, [(XY, v)], q).rounded is None
        assert saturated_velocity(PLANAR, XY, v, q, limits=1e9).rounded is None
