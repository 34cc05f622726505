from math import exp, inf, log, nan, sqrt

import numpy as np
import pytest

import robotics1 as r1
from robotics1 import InputError, cubic, simulate_tracking
from robotics1.control import GainStatus, smallest_gain

TRAJECTORY = cubic([0, 0], [1.0294, 1.4250], 1.38, v1=[-0.7359, -0.6278])
T = TRAJECTORY.duration


# --- without saturation the error decays as exp(−k t)


@pytest.mark.parametrize("gain", [0.0, 1.0, 5.0, [2.0, 7.0], [0.0, 3.0]])
@pytest.mark.parametrize("q0", [[0.1, -0.2], [-1.0, 0.5]])
def test_error_of_each_joint_is_e0_exp_minus_k_t(gain, q0):
    run = simulate_tracking(TRAJECTORY, q0, gain)
    k, e0 = np.broadcast_to(gain, 2), -np.array(q0)
    decay = e0 * np.exp(-np.outer(run.t, k))
    assert run.error == pytest.approx(decay, abs=1e-8)
    assert run.q == pytest.approx(TRAJECTORY(run.t) - decay, abs=1e-8)
    assert run.command == pytest.approx(TRAJECTORY.velocity(run.t) + k * decay, abs=1e-7)
    assert run.final_error == pytest.approx(np.linalg.norm(e0 * np.exp(-k * T)), abs=1e-8)
    assert not run.saturated.any()


def test_from_the_planned_start_feedback_does_nothing():
    run = simulate_tracking(TRAJECTORY, [0, 0], 10.0)
    assert run.q == pytest.approx(TRAJECTORY(run.t), abs=1e-9)
    assert run.final_error == pytest.approx(0, abs=1e-9)


def test_times_go_from_0_to_the_duration_and_shapes_agree():
    run = simulate_tracking(TRAJECTORY, [0.1, 0], 2.0, samples=33)
    assert run.t == pytest.approx(np.linspace(0, T, 33), abs=1e-15)
    assert run.q.shape == run.command.shape == run.error.shape == (33, 2)
    assert run.q[0] == pytest.approx([0.1, 0], abs=1e-15)


# --- saturation


def test_a_standing_target_is_approached_at_the_rate_limit_and_then_exponentially():
    """q_d = 0, q0 = 1, k = 4, limit 0.5: q = 1 − t/2 until k q = 0.5 at t* = 1.75, then (1/8) exp(−4 (t − t*))."""
    run = simulate_tracking(cubic([0], [0], 3), [1.0], 4.0, rate_limits=0.5)
    q = np.where(run.t <= 1.75, 1 - 0.5 * run.t, 0.125 * np.exp(-4 * (run.t - 1.75)))
    assert run.q[:, 0] == pytest.approx(q, abs=1e-6)
    assert np.abs(run.command).max() == 0.5
    assert run.saturated.tolist() == [True]
    assert run.final_error == pytest.approx(0.125 * exp(-5), abs=1e-6)


def test_only_the_joint_beyond_its_limit_saturates():
    run = simulate_tracking(cubic([0, 0], [0, 0], 1), [1.0, 0.1], 4.0, rate_limits=[0.5, 0.5])
    assert run.saturated.tolist() == [True, False]
    assert run.error[:, 1] == pytest.approx(-0.1 * np.exp(-4 * run.t), abs=1e-9)


def test_a_zero_rate_limit_stops_the_joint():
    run = simulate_tracking(TRAJECTORY, [0.3, 0], 5.0, rate_limits=[0, 10])
    assert run.q[:, 0] == pytest.approx(np.full(len(run.t), 0.3), abs=1e-15)


# --- the smallest gain


@pytest.mark.parametrize(("q0", "wanted"), [([0.1, -0.1], 1e-3), ([0.3, 0.4], 1e-4), ([1, 0], 0.5)])
def test_smallest_gain_is_log_of_e0_over_epsilon_over_T(q0, wanted):
    choice = smallest_gain(TRAJECTORY, q0, wanted)
    k = log(np.linalg.norm(q0) / wanted) / T
    assert choice.gain == pytest.approx([k, k], rel=1e-12)
    assert choice.run.final_error == pytest.approx(wanted, rel=1e-5)
    assert choice.status is GainStatus.FEEDBACK


@pytest.mark.parametrize("q0", [[0, 0], [1e-4, 0], [0.0006, 0.0008]])
def test_an_error_that_is_small_enough_needs_no_gain(q0):
    choice = smallest_gain(TRAJECTORY, q0, 1e-3)
    assert choice.gain == pytest.approx([0, 0], abs=1e-12)
    assert choice.status is GainStatus.FEEDBACK


def test_the_verdict_is_feedback_while_the_command_stays_inside_the_limits():
    """The command is largest at the start: k |e_i(0)| with k = ln(√2 · 100)/T."""
    q0, still = [0.1, 0.1], cubic([0, 0], [0, 0], 2)
    peak = log(sqrt(2) * 100) / 2 * 0.1
    assert smallest_gain(still, q0, 1e-3, rate_limits=1.001 * peak).status is GainStatus.FEEDBACK
    assert smallest_gain(still, q0, 1e-3, rate_limits=0.999 * peak).status is not GainStatus.FEEDBACK


def test_the_verdict_is_replan_when_the_start_is_too_far():
    choice = smallest_gain(TRAJECTORY, [-3, 3], 1e-3, rate_limits=4)
    assert choice.status is GainStatus.REPLAN
    assert choice.run.final_error > 1e-3
    assert choice.run.saturated.any()


def test_what_a_cut_command_loses_is_missing_at_the_end():
    """q_d runs ahead at speed 1, so the command is 1 + k e; its start is cut by 0.1."""
    ahead, k = cubic([0], [2], 2, 1, 1), log(1000) / 2
    choice = smallest_gain(ahead, [-1], 1e-3, rate_limits=k + 0.9)
    assert choice.gain == pytest.approx([k])
    assert choice.status is GainStatus.REPLAN
    assert 1e-3 < choice.run.final_error < 1.1e-3


def test_the_verdict_is_saturates_when_the_cut_helps():
    """q_d comes back towards the robot at 5, faster than its 4.9: the error falls faster than by feedback."""
    choice = smallest_gain(cubic([0], [-3], 2, -5, 0), [-0.01], 1e-3, rate_limits=4.9)
    assert choice.status is GainStatus.SATURATES
    assert choice.run.saturated.all()
    assert 0.8e-3 < choice.run.final_error < 1e-3


# --- misuse


@pytest.mark.parametrize(
    ("q0", "gain", "limits"),
    [
        ([0, 0, 0], 1, None),
        ([0, nan], 1, None),
        ([0, 0], -1, None),
        ([0, 0], [1, -1], None),
        ([0, 0], [1, 2, 3], None),
        ([0, 0], inf, None),
        ([0, 0], "high", None),
        ([0, 0], 1, -2),
        ([0, 0], 1, [1, 2, 3]),
        ([0, 0], 1, nan),
        (None, 1, None),
    ],
)
def test_wrong_shapes_and_signs_are_input_errors(q0, gain, limits):
    with pytest.raises(InputError):
        simulate_tracking(TRAJECTORY, q0, gain, rate_limits=limits)


@pytest.mark.parametrize("samples", [0, 1, -5, 2.5, "many"])
def test_too_few_samples_are_an_input_error(samples):
    with pytest.raises(InputError):
        simulate_tracking(TRAJECTORY, [0, 0], 1, samples=samples)


@pytest.mark.parametrize("wanted", [0, -1e-3, nan, inf, "small"])
def test_the_wanted_error_is_positive(wanted):
    with pytest.raises(InputError, match="final_error"):
        smallest_gain(TRAJECTORY, [0.1, 0], wanted)


def test_unlimited_joints_of_a_robot_may_be_handed_over_as_rate_limits():
    run = simulate_tracking(TRAJECTORY, [0.1, 0], 2.0, rate_limits=[inf, 4])
    assert not run.saturated.any()


# --- any trajectory of joints


def trajectories():
    limits = r1.MotionLimits([1, 0.5], [2, 1])
    path = r1.curves.PathTrajectory(
        r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]]), r1.trapezoidal(0, 2, 3, velocity=1).joint()
    )
    return {
        "profiles": r1.minimum_time([0, 0], [1, -1], limits).trajectory,
        "bang_bang": r1.trajectories.bang_bang([0, 0], [1, -1], 2),
        "spline": r1.cubic_spline([0, 1, 2.5], [[0, 0], [1, -1], [0.5, 0]]),
        "path": path,
        "sequence": r1.curves.CurveSequence((cubic([0, 0], [1, 1], 1, v1=[2, 0]), cubic([1, 1], [0, 1], 1))),
        "stretched": r1.curves.stretched(path, 2.0),
    }


@pytest.mark.parametrize("kind", sorted(trajectories()))
def test_the_error_along_any_trajectory_decays_as_exp_minus_k_t_also_where_the_velocity_jumps(kind):
    motion = trajectories()[kind]
    run = simulate_tracking(motion, motion(0.0) + np.array([0.1, -0.2]), 3.0, samples=77)
    assert run.error == pytest.approx(np.array([-0.1, 0.2]) * np.exp(-3 * run.t)[:, None], abs=1e-7)
    choice = smallest_gain(motion, motion(0.0) + np.array([0.3, 0.4]), 1e-3)
    assert choice.gain == pytest.approx(np.full(2, log(0.5 / 1e-3) / motion.duration))
    assert choice.run.final_error == pytest.approx(1e-3, rel=1e-4)


@pytest.mark.parametrize(
    "motion",
    [
        3,
        None,
        cubic,
        r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0),
        r1.LinearMotion([0, 0], [1, 1]),
        r1.trajectories.bang_bang(0, 1, 1).joint(),
    ],
)
def test_what_is_no_trajectory_of_joints_is_an_input_error(motion):
    with pytest.raises(InputError, match="trajectory must be"):
        simulate_tracking(motion, [0, 0], 1)
    with pytest.raises(InputError, match="trajectory must be"):
        smallest_gain(motion, [0, 0], 1)
