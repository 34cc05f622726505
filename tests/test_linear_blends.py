"""Lines with parabolic blends through via points: Craig's numbers, integrated accelerations, and the special cases."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.trajectories import linear_segments_with_blends

T = [0.0, 2.0, 3.0, 6.0]
Q = [10.0, 35.0, 25.0, 10.0]  # degrees: Craig, example 7.4


def test_craigs_example_has_its_velocities_and_blend_times():
    """Durations 2, 1, 3 s and 50°/s²: T₀ = 2 − √(4 − 50/50) = 0.27 s, v₀ = 50 T₀, v₁ = −10, v₂ = −5.1 °/s."""
    law = linear_segments_with_blends(T, Q, acceleration=50.0).laws[0]
    assert law.duration == pytest.approx(6)
    assert law.velocity([1.0, 2.5, 4.0]) == pytest.approx([50 * (2 - np.sqrt(3)), -10.0, -5.1], abs=0.02)
    edges = np.concatenate([[0], law.breakpoints, [6]])
    assert np.diff(edges) == pytest.approx([0.27, 1.50, 0.47, 0.72, 0.098, 2.849, 0.102], abs=0.006)
    assert law.peak(2).value == pytest.approx(50)


@given(st.integers(2, 6), st.integers(1, 3), st.integers(0, 10**6))
def test_the_motion_is_its_integrated_accelerations_and_passes_near_the_points(m, n, seed):
    rng = np.random.default_rng(seed)
    steps, q = rng.uniform(0.5, 2, m - 1), rng.uniform(-2, 2, (m, n))
    t = np.concatenate([[0.0], np.cumsum(steps)])
    A = 60 * np.abs(np.diff(q, axis=0)).max() / steps.min() ** 2
    motion = linear_segments_with_blends(t, q, acceleration=A)
    assert motion(0.0) == pytest.approx(q[0])
    assert motion(t[-1]) == pytest.approx(q[-1])
    assert motion.velocity(0.0) == pytest.approx(np.zeros(n), abs=1e-9)
    assert motion.velocity(t[-1], side="left") == pytest.approx(np.zeros(n), abs=1e-9)
    grid = np.linspace(0, t[-1], 2001)
    accelerations = motion.acceleration(grid)
    assert np.abs(np.abs(accelerations[np.abs(accelerations) > 1e-6 * A]) - A).max() < 1e-6 * A
    for order in (0, 1):
        for at in motion.breakpoints:
            left, right = (motion.derivative(at, order, side=side) for side in ("left", "right"))
            assert left == pytest.approx(right, abs=1e-9 * A)
    for k in range(1, m - 1):
        before, after = motion.velocity(t[k] - 0.25 * steps.min()), motion.velocity(t[k] + 0.25 * steps.min())
        assert np.abs(motion(t[k]) - q[k]) == pytest.approx((after - before) ** 2 / A / 8, rel=1e-6, abs=1e-9)


def test_between_two_points_it_is_the_trapezoidal_law():
    mine, law = (
        linear_segments_with_blends([0, 2], [1.0, 4.0], acceleration=5.0),
        r1.trapezoidal(1, 4, 2.0, acceleration=5),
    )
    grid = np.linspace(0, 2, 33)
    assert mine(grid) == pytest.approx(law(grid).reshape(33, 1))
    triangle = linear_segments_with_blends([0, 2], [1.0, 4.0], acceleration=3.0)
    assert triangle.peak(1).value == pytest.approx(3.0)


def test_given_blend_times_give_the_accelerations():
    motion = linear_segments_with_blends([0, 1, 2], [[0, 0], [1, -1], [1, 3]], blend_times=[0.2, 0.4, 0.2])
    v0, v1 = np.array([1, -1]) / 0.9, np.array([0, 4]) / 0.9
    assert motion.velocity([0.5, 1.5]) == pytest.approx(np.array([v0, v1]))
    assert motion.acceleration([0.1, 1.0, 1.9]) == pytest.approx(np.array([v0 / 0.2, (v1 - v0) / 0.4, -v1 / 0.2]))
    assert motion(1.0) == pytest.approx([1, -1] + (v1 - v0) * 0.4 / 8)


def test_points_in_line_and_points_that_repeat_need_no_blend_there():
    line = linear_segments_with_blends([0, 1, 2, 3], [0, 0.95, 1.95, 2.9], blend_times=0.1)
    assert line(1.0) == pytest.approx([0.95])
    rest = linear_segments_with_blends([0, 1, 2], [[1, 1], [1, 1], [1, 2]], acceleration=20)
    assert rest(0.9) == pytest.approx([1, 1])
    still = linear_segments_with_blends([0, 1, 2], [3, 3, 3], acceleration=1)
    assert still([0.0, 1.3, 2.0]) == pytest.approx(np.full((3, 1), 3))


def test_the_unit_of_time_and_of_length_does_not_matter_and_neither_does_the_way():
    grid, motion = np.linspace(0, 6, 61), linear_segments_with_blends(T, Q, acceleration=50.0)
    small = linear_segments_with_blends(1e-4 * np.array(T), 1e-6 * np.array(Q), acceleration=50 * 1e-6 / 1e-8)
    assert 1e6 * small(1e-4 * grid) == pytest.approx(motion(grid))
    back = linear_segments_with_blends(6 - np.array(T[::-1]), Q[::-1], acceleration=50.0)
    assert back(6 - grid) == pytest.approx(motion(grid))
    later = linear_segments_with_blends(np.array(T) + 2, Q, acceleration=50.0)
    assert later(grid + 2) == pytest.approx(motion(grid))


@pytest.mark.parametrize(
    ("arguments", "options", "words"),
    [
        ((T, Q), {}, "one of them"),
        ((T, Q), {"acceleration": 50, "blend_times": 0.1}, "one of them"),
        ((T, Q), {"acceleration": 5}, "acceleration must be at least 12.5"),
        (([0, 1], [0, 1]), {"acceleration": 3.9}, "at least 4 "),
        ((T, Q), {"acceleration": 13}, "overlap in the segment from t = 0 to 2"),
        ((T, Q), {"blend_times": 1.1}, "overlap"),
        ((T, Q), {"acceleration": 0}, "acceleration"),
        ((T[:3], Q), {"acceleration": 50}, "one for each point"),
        (([0, 1, 1, 2], Q), {"acceleration": 50}, "ascend"),
        ((T, Q), {"acceleration": [1, 2]}, "acceleration"),
    ],
)
def test_what_cannot_be_is_refused_with_what_would_be_right(arguments, options, words):
    with pytest.raises(r1.InputError, match=words):
        linear_segments_with_blends(*arguments, **options)
