"""Laws with their command held for a sampling time: e_{k+1} by hand, the longest step, and what lies beyond it."""

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.signal import cont2discrete

import robotics1 as r1
from robotics1.control import cartesian_law, joint_law, simulate_law

TWO = r1.textbook_robots.planar_arm("RR", [1.0, 0.8])
XY = r1.PositionTask("xy")
gain = st.floats(0.05, 20)


@given(gain, gain)
def test_a_law_of_first_order_converges_below_two_over_its_largest_gain(k1, k2):
    decay = joint_law(TWO, [0.0, 0.0], [k1, k2]).decay([-1.0, 0.5])
    h = decay.largest_step
    assert h == pytest.approx(2 / max(k1, k2))
    assert decay.sampled(0.3 * h, 3) == pytest.approx(
        np.array([[(1 - 0.3 * h * k1) ** i, -0.5 * (1 - 0.3 * h * k2) ** i] for i in range(4)])
    )
    assert np.abs(decay.sampled(0.99 * h, 1000)[-1, np.argmax([k1, k2])]) < 1e-8
    assert np.abs(decay.sampled(1.01 * h, 1000)[-1, np.argmax([k1, k2])]) > 1e3


def test_at_one_over_k_the_error_is_zero_after_one_step():
    decay = joint_law(TWO, [1.0, 2.0], 5.0).decay([0.0, 0.0])
    assert decay.sampled(0.2, 2) == pytest.approx(np.array([[1, 2], [0, 0], [0, 0]]), abs=1e-12)


@given(gain, gain, st.floats(0.01, 0.5))
def test_a_law_of_second_order_is_the_double_integrator_held_by_scipy(k, d, h):
    one = r1.textbook_robots.planar_arm("R", [1.0])
    decay = joint_law(one, [0.0], k, d).decay([-1.0], [0.3])
    A, B, *_ = cont2discrete((np.array([[0.0, 1], [0, 0]]), np.array([[0.0], [1]]), np.eye(2), np.zeros((2, 1))), h)
    closed = A - B @ np.array([[k, d]])
    state, errors = np.array([1.0, -0.3]), [1.0]
    for _ in range(5):
        state = closed @ state
        errors.append(state[0])
    assert decay.sampled(h, 5)[:, 0] == pytest.approx(errors)
    radius = np.abs(np.linalg.eigvals(closed)).max()
    assert (radius < 1) == (h < decay.largest_step) or radius == pytest.approx(1, abs=1e-9)


def test_full_gain_matrices_have_the_step_of_their_fastest_mode():
    K = np.array([[4.0, 1.0], [1.0, 3.0]])
    assert joint_law(TWO, [0.0, 0.0], K).decay([1.0, 0.0]).largest_step == pytest.approx(2 / np.linalg.eigvalsh(K)[-1])
    turning = np.array([[2.0, 3.0], [-3.0, 2.0]])  # eigenvalues 2 ± 3i
    decay = joint_law(TWO, [0.0, 0.0], turning).decay([1.0, 0.0])
    assert decay.largest_step == pytest.approx(4 / 13)
    sizes = np.linalg.norm(decay.sampled(4 / 13, 50), axis=1)
    assert sizes == pytest.approx(sizes[0])
    with pytest.raises(r1.FormulaError, match="commute"):
        _ = joint_law(TWO, [0.0, 0.0], K, [[5.0, 1.0], [1.0, 9.0]]).decay([1.0, 0.0], [0.0, 0.0]).largest_step


@pytest.mark.parametrize("order", [1, 2])
def test_a_simulation_in_steps_is_the_sampled_error_of_the_joints(order):
    law = joint_law(TWO, [0.4, -0.2], [3.0, 2.0], None if order == 1 else [4.0, 3.0])
    run = simulate_law(law, [0.0, 0.1], duration=2.0, step=0.1)
    assert run.t == pytest.approx(np.arange(21) / 10)
    assert run.error == pytest.approx(
        law.decay([0.0, 0.1], None if order == 1 else [0.0, 0.0]).sampled(0.1, 20), abs=1e-12
    )
    assert run.complete


def test_a_cartesian_law_in_steps_is_euler_s_method_by_hand():
    target, q = np.array([0.9, 0.9]), np.array([0.3, 0.7])
    run = simulate_law(cartesian_law(TWO, XY, target, 8.0), q, duration=1.0, step=0.05)
    for state in run.q:
        assert state == pytest.approx(q)
        q = q + 0.05 * np.linalg.solve(XY.jacobian(TWO, q), 8.0 * (target - XY.value(TWO, q)))
    assert run.final_error < 1e-3


def test_beyond_the_longest_step_the_joints_run_away_and_it_is_said():
    run = simulate_law(joint_law(TWO, [0.0, 0.0], 10.0), [0.1, 0.1], duration=100.0, step=0.5)
    assert not run.complete
    assert "ran away" in run.explain()
    cut = simulate_law(joint_law(TWO, [0.0, 0.0], 10.0), [0.1, 0.1], duration=100.0, step=0.5, limits=1.0)
    assert cut.complete
    assert np.abs(cut.command).max() <= 1.0


def test_a_motion_is_sampled_at_the_steps_that_fit_into_it():
    law = joint_law(TWO, r1.cubic([0, 0], [1, -1], 1.0), 2.0)
    run = simulate_law(law, [0.0, 0.0], step=0.3)
    assert run.t == pytest.approx([0, 0.3, 0.6, 0.9])
    assert run.command[0] == pytest.approx([0, 0], abs=1e-12)


def test_a_large_rate_at_the_start_makes_the_error_large_before_it_falls():
    """(1 + ωt) e^(−ωt) e₀ + t e^(−ωt) ė₀ with a tiny e₀: the time at which it is below the ratio is late."""
    one = r1.textbook_robots.planar_arm("R", [1.0])
    decay = joint_law(one, [0.0], 4.0, 4.0).decay([1e-9], [1.0])
    T = decay.time_to(0.5)
    assert np.abs(decay(T)) == pytest.approx(0.5e-9, rel=1e-6)
    assert (np.abs(decay(T + np.linspace(0.01, 20, 200))) < 0.5e-9).all()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"step": 0.0}, "step must be a positive number"),
        ({"step": "h"}, "step must be a"),
        ({"step": 1e-9}, "steps at most"),
    ],
)
def test_steps_that_are_none_are_refused(options, words):
    with pytest.raises(r1.InputError, match=words):
        simulate_law(joint_law(TWO, [0.0, 0.0], 1.0), [1.0, 1.0], duration=1.0, **options)
