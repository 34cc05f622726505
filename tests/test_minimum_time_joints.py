"""Minimum time of several joints: together, in line, or each by itself; and of nothing to do."""

from math import inf, sqrt

import numpy as np
import pytest
from hypothesis import given, strategies as st
from motions import JERK_FREE, KINDS, MOVING, bound, distance, limits_of

import robotics1 as r1

# --- nothing to do


@pytest.mark.parametrize("kind", KINDS)
def test_no_displacement_takes_no_time_and_can_be_evaluated(kind):
    answer = r1.minimum_time([1, 2], [1, 2], limits_of(kind, 1, 1, 1), kind)
    assert answer.duration == 0
    assert answer.active == ()
    assert answer.trajectory(0).tolist() == [1, 2]
    for rate in (answer.trajectory.velocity, answer.trajectory.acceleration, answer.trajectory.jerk):
        assert rate(0).tolist() == [0, 0]
        assert rate([0.0]).tolist() == [[0, 0]]
    assert answer.trajectory.extremes(2)[1].tolist() == [[0, 0], [0, 0]]
    assert answer.unique
    with pytest.raises(r1.InputError):
        answer.trajectory(0.1)


@pytest.mark.parametrize("kind", MOVING)
def test_a_state_that_is_the_goal_already_keeps_its_velocity(kind):
    answer = r1.minimum_time([1], [1], limits_of(kind, 1, 1, 1), kind, v0=0.5, v1=0.5)
    assert answer.duration == 0
    assert answer.trajectory.velocity(0).tolist() == [0.5]
    assert [part.tolist() for part in answer.trajectory.extremes()] == [[[0], [0]], [[1], [1]]]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("coordination", ["synchronized", "straight", "independent"])
def test_a_joint_that_has_nothing_to_do_rests_while_another_moves(kind, coordination):
    answer = r1.minimum_time([1, 2], [1, 3], limits_of(kind, 1, 1, 1), kind, coordination=coordination)
    t = np.linspace(0, answer.duration, 5)
    assert answer.trajectory(t)[:, 0].tolist() == [1] * 5
    assert answer.trajectory.acceleration(t)[:, 0].tolist() == [0] * 5
    assert answer.trajectory(answer.duration)[1] == pytest.approx(3)


# --- several joints


@pytest.mark.parametrize("kind", KINDS)
def test_slowed_joints_take_the_time_of_the_slowest_with_velocities_divided_by_k(kind):
    q1 = np.array([1.0, -0.4, 0.1])
    together = r1.minimum_time([0] * 3, q1, limits_of(kind, [1, 2, 3], [2, 1, 1], [9, 8, 5]), kind)
    alone = r1.minimum_time(
        [0] * 3, q1, limits_of(kind, [1, 2, 3], [2, 1, 1], [9, 8, 5]), kind, coordination="independent"
    )
    T = together.duration
    assert pytest.approx(alone.joint_durations.max()) == T
    assert together.joint_durations == pytest.approx(alone.joint_durations)
    assert together.slack == pytest.approx(T - alone.joint_durations)
    assert not together.unique
    for fast, slow in zip(alone.laws, together.laws, strict=True):
        k = T / fast.duration
        assert slow.duration == pytest.approx(T)
        assert slow.peak(1).value == pytest.approx(fast.peak(1).value / k)
        assert slow.peak(2).value == pytest.approx(fast.peak(2).value / k**2)
    assert {demand.joint for demand in together.active} == {int(alone.joint_durations.argmax())}
    assert {demand.joint for demand in alone.active} == {0, 1, 2}


@pytest.mark.parametrize("kind", KINDS)
@given(d=st.tuples(distance, distance, distance), V=st.tuples(bound, bound, bound), A=st.tuples(bound, bound, bound))
def test_a_straight_line_has_one_law_for_all_joints_and_keeps_all_bounds(kind, d, V, A):
    answer = r1.minimum_time([0] * 3, d, limits_of(kind, V, A, 9.0), kind, coordination="straight")
    T = answer.duration
    s = answer.trajectory(np.linspace(0, T, 9)) / d
    assert s == pytest.approx(np.repeat(s[:, :1], 3, axis=1), abs=1e-9)
    assert T >= answer.joint_durations.max() * (1 - 1e-9)
    for order, limit in ((1, V), (2, A), (3, 9.0 if kind not in JERK_FREE else inf)):
        used = np.abs(answer.trajectory.extremes(order)[1]).max(axis=0) / limit
        assert (used <= 1 + 1e-8).all()
    assert answer.active


def test_in_line_one_joint_may_bound_the_velocity_and_another_the_acceleration():
    """Alone they take 2/1 + 1/100 s and 2√2 s; one law with V = 1 and A = 1 takes 2/1 + 1/1 s."""
    limits = r1.MotionLimits([1, 100], [100, 1])
    answer = r1.minimum_time([0, 0], [2, 2], limits, coordination="straight")
    assert answer.joint_durations == pytest.approx([2.01, 2 * sqrt(2)])
    assert answer.duration == pytest.approx(2 / 1 + 1 / 1)
    assert {(demand.joint, demand.quantity) for demand in answer.active} == {(0, "velocity"), (1, "acceleration")}


@pytest.mark.parametrize("kind", ["trapezoidal", "double_s", "cubic", "quintic"])
@pytest.mark.parametrize("seed", range(15))
def test_joints_with_velocities_at_the_ends_arrive_together_within_their_bounds(kind, seed):
    rng = np.random.default_rng(seed)
    V, A, J = rng.uniform(0.5, 2, (3, 3))
    v0, v1, q1 = rng.uniform(-0.9, 0.9, 3) * V, rng.uniform(-0.9, 0.9, 3) * V, rng.uniform(-1, 1, 3)
    answer = r1.minimum_time([0] * 3, q1, limits_of(kind, V, A, J), kind, v0=v0, v1=v1)
    T, motion = answer.duration, answer.trajectory
    assert answer.joint_durations.max() * (1 - 1e-12) <= T
    assert motion(T) == pytest.approx(q1, abs=1e-9)
    assert motion.velocity(T) == pytest.approx(v1, abs=1e-9)
    assert [law.duration for law in answer.laws] == pytest.approx([T] * 3)
    for order, limit in ((1, V), (2, A), (3, J if kind not in JERK_FREE else np.full(3, inf))):
        assert (np.abs(motion.extremes(order)[1]).max(axis=0) <= limit * (1 + 1e-8)).all()


def test_a_joint_that_cannot_wait_makes_all_wait_for_its_next_chance():
    """Joint 0 goes 0.1 m from 1 m/s to 1 m/s: in 2(√1.1 − 1) s, or, with A = 1, over −p with 1 − p² = 0.1 and back.

    Joint 1 alone takes 1 s, which is too late for the first and too early for the second.
    """
    limits = r1.MotionLimits(acceleration=1)
    answer = r1.minimum_time([0, 0], [0.1, 0.25], limits, v0=[1, 0], v1=[1, 0])
    turn = sqrt(1 - 0.1)  # the velocity back: 1 − p² = Δ
    assert answer.duration == pytest.approx(2 * (1 + turn), rel=1e-9)
    assert answer.trajectory.extremes(1)[1][0, 0] == pytest.approx(-turn)
    alone = r1.minimum_time(
        [0, 0], [0.1, 0.25], limits, v0=[1, 0], v1=[1, 0], coordination="synchronized"
    ).joint_durations
    assert alone == pytest.approx([2 * (sqrt(1.1) - 1), 1])


def test_a_wait_for_one_joint_may_be_too_short_for_another():
    """Joint 0 cannot do with the 0.76 s of the slowest; with the 2.00 s that it can, another cannot."""
    limits = r1.MotionLimits(acceleration=[0.773, 0.673, 0.952])
    q1, v0, v1 = [0.518, 0.748, 0.201], [0.494, 0.8, 0.602], [0.873, 0.922, 0.553]
    answer = r1.minimum_time([0] * 3, q1, limits, v0=v0, v1=v1)
    assert answer.joint_durations.max() == pytest.approx(0.762, abs=2e-3)
    assert answer.duration == pytest.approx(4.02, abs=2e-2)
    assert answer.trajectory(answer.duration) == pytest.approx(q1, abs=1e-9)
    for shorter in np.linspace(0.77, 0.999 * answer.duration, 50):
        with pytest.raises(r1.InputError, match="the next possible duration"):
            r1.trapezoidal([0] * 3, q1, shorter, v0, v1, acceleration=[0.773, 0.673, 0.952])


def test_switching_times_that_are_one_but_for_rounding_are_told_once():
    limits = r1.MotionLimits([0.3, 0.1], [0.7, 0.7 / 3], deceleration=[0.9, 0.3])
    answer = r1.minimum_time([0, 0], [1.1, 1.1 / 3], limits)
    assert len(answer.trajectory.breakpoints) == 2
    assert [demand.quantity for demand in answer.active].count("deceleration") == 2


def test_str_of_an_active_bound_says_who_what_and_when():
    answer = r1.minimum_time([0, 0], [0.1, 2], r1.MotionLimits(1, 4))
    assert [str(demand) for demand in answer.active] == [
        "joint 1's velocity is 1 at t = 0.25 s, its limit 1",
        "joint 1's acceleration is 4 at t = 0 s, its limit 4",
    ]
