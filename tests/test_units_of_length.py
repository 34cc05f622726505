"""No verdict depends on the unit of length, where metres stand beside radians."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.singularities import (
    RankStatus,
    largest_force,
    manipulability,
    singularity_within_rounding,
    wrenches_without_torque,
)

SIZES = (1e-9, 1e-6, 1e-3, 1e3, 1e4, 1e6, 1e9)
# Rows (type, a, alpha, d, theta) with lengths in metres, and the task.
ARMS = {
    "planar 3R": ([("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "planar"),
    "planar RPR": ([("R", 0, -np.pi / 2, 0, 0), ("P", 0, np.pi / 2, 0, 0), ("R", 0.4, 0, 0, 0)], r1.PlanarPoseTask()),
    "spatial 3R": ([("R", 0, np.pi / 2, 0.5, 0), ("R", 0.6, 0, 0, 0), ("R", 0.4, 0, 0, 0)], "pose"),
    "SCARA": ([("R", 0.5, 0, 0.3, 0), ("R", 0.3, np.pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0.1, 0)], "pose"),
}


def arm(name, k):
    """The arm with its lengths times k, and its task."""
    rows, task = ARMS[name]
    return r1.robot_from_dh([(kind, a * k, alpha, d * k, theta) for kind, a, alpha, d, theta in rows]), task


def configuration(name, k, x):
    return np.array([value * (k if row[0] == "P" else 1) for value, row in zip(x, ARMS[name][0], strict=False)])


@pytest.mark.parametrize("name", ARMS)
@given(x=st.lists(st.floats(0.3, 1.2), min_size=4, max_size=4), k=st.sampled_from(SIZES))
def test_rank_and_status_are_those_of_the_arm_in_metres(name, x, k):
    (one, task), (other, _) = arm(name, 1.0), arm(name, k)
    a, b = (manipulability(r, task, configuration(name, size, x)) for r, size in ((one, 1.0), (other, k)))
    assert b.spaces.rank == a.spaces.rank
    assert b.status is a.status
    assert np.isinf(b.force_ellipsoid.lengths).sum() == np.isinf(a.force_ellipsoid.lengths).sum()
    free = [wrenches_without_torque(r, configuration(name, size, x)) for r, size in ((one, 1.0), (other, k))]
    assert free[1].wrenches.shape == free[0].wrenches.shape == (6, 6 - len(ARMS[name][0]))


@pytest.mark.parametrize("k", SIZES)
def test_a_stretched_planar_3r_has_rank_2_in_every_unit(k):
    robot, task = arm("planar 3R", k)
    for q in ([0.3, 0.0, 0.5], [0.3, np.pi, 0.5]):
        assert manipulability(robot, task, q).spaces.rank == 2
    assert singularity_within_rounding(robot, task, [0.3, 3.1416, 0.5]).status is RankStatus.NEARLY_SINGULAR
    assert singularity_within_rounding(robot, task, [0.3, 3.1316, 0.5]).status is RankStatus.FULL_RANK


@pytest.mark.parametrize("k", SIZES)
def test_the_largest_moment_is_that_of_the_motors_and_the_largest_force_that_over_the_length(k):
    robot, task = arm("planar 3R", k)
    q = [0.3, 0.9, -0.7]
    assert largest_force(robot, task, q, [0, 0, 1], torque=2.0).magnitude == pytest.approx(2.0)
    # a force along x at the tool: τ₁ = −y, with y the height of the tool above the first joint
    heights = np.cumsum(np.array([1, 0.7, 0.4])[::-1] * np.sin(np.cumsum(q))[::-1])
    assert largest_force(robot, task, q, [1, 0, 0], torque=2.0).magnitude * k == pytest.approx(
        2 / np.abs(heights).max()
    )


@pytest.mark.parametrize("k", SIZES)
def test_a_force_through_all_axes_needs_no_torque_in_every_unit(k):
    robot, task = arm("planar 3R", k)
    pull = largest_force(robot, task, [0.0, 0.0, 0.0], [1, 0, 0], torque=2.0)
    assert pull.magnitude == np.inf
    assert pull.joints == ()
