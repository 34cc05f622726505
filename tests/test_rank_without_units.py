"""Metres beside radians: what joints do for a task does not depend on the unit of length.

A planar arm with its lengths in the unit k has J = diag(k, k, 1) J₁: the same q̇ realises (k ẋ, k ẏ, φ̇). A rank that
compares singular values of metres with those of radians breaks this law for a k far from 1.
"""

import numpy as np
import pytest

import robotics1 as r1

UNITS = (1e-10, 1e-6, 1e-3, 1e3, 1e6, 1e10)
Q3, Q4 = [0.3, 0.9, -0.4], [0.3, 0.9, -0.4, 0.7]
RATE = np.sqrt([0.011, 0.05, 0.07]) * [1, -1, 1]  # with all digits: rounded ones have a tolerance
POSE = r1.PlanarPoseTask("xy")


def off(k):
    """The rounding of singular values, 1e-16 σ₁, as a part of the least of them."""
    return 1e-8 + 1e-14 * max(k, 1 / k)


def arm(k, n):
    return r1.robot_from_dh([("R", k * a, 0, 0, 0) for a in (1.0, 0.8, 0.6, 0.4)[:n]])


def rate(k):
    return np.array([k, k, 1]) * RATE


def beside(k, angle):
    """A pose near that at Q3."""
    return POSE.value(arm(k, 3), Q3) + np.array([0.05 * k, 0.02 * k, angle])


def turning(k, n):
    """The angle of the first link, one row without metres."""
    return r1.FunctionTask(lambda p, R, q: q[:1], 1, lambda p, R, q: np.eye(n)[:1], frame=arm(k, n).frame_names[0])


@pytest.mark.parametrize("k", UNITS)
@pytest.mark.parametrize("q", [Q3, [0.3, 0.0, -0.4], [0.3, 0.005, -0.4]], ids=["regular", "singular", "near"])
def test_q_dot_is_J_inverse_r_dot(k, q):
    here, one = (r1.joint_velocity(arm(u, 3), POSE, rate(u), q) for u in (k, 1.0))
    assert (here.rank, here.status, here.near_singular) == (one.rank, one.status, one.near_singular)
    assert here.relative_sigma == pytest.approx(one.relative_sigma, rel=1e-8, abs=1e-14)
    if one.rank == 3:
        np.testing.assert_allclose(here.qdot, one.qdot, rtol=off(k))
        np.testing.assert_allclose(POSE.jacobian(arm(k, 3), q) @ here.qdot, rate(k), rtol=off(k))


@pytest.mark.parametrize("k", UNITS)
def test_q_ddot_is_J_inverse_r_ddot_less_drift(k):
    here, one = (r1.joint_acceleration(arm(u, 3), POSE, rate(u), Q3, [0.5, -0.2, 0.1]) for u in (k, 1.0))
    assert (here.rank, here.status) == (3, one.status)
    np.testing.assert_allclose(here.qddot, one.qddot, rtol=off(k))


@pytest.mark.parametrize("k", UNITS)
@pytest.mark.parametrize("method", ["levels", "projection"])
def test_levels_by_priority(k, method):
    found = []
    for u in (k, 1.0):
        levels = [(POSE, rate(u)), (turning(u, 4), [0.2])]
        found.append(r1.redundancy.priority_velocity(arm(u, 4), levels, Q4, method=method))
    here, one = found
    np.testing.assert_allclose(here.joints, one.joints, rtol=off(k))
    for ours, theirs in zip(here.levels, one.levels, strict=True):
        assert (ours.rank, ours.free_rank, ours.status) == (theirs.rank, theirs.free_rank, theirs.status)


@pytest.mark.parametrize("k", UNITS)
@pytest.mark.parametrize("method", ["optimal", "sns", "scaled"])
@pytest.mark.parametrize("limit", [10.0, 0.45, 0.2])
def test_rates_within_limits(k, method, limit):
    here, one = (
        r1.redundancy.saturated_velocity(arm(u, 4), POSE, rate(u), Q4, limits=limit, method=method) for u in (k, 1.0)
    )
    assert here.status is one.status
    assert here.scale == pytest.approx(one.scale, rel=off(k))
    np.testing.assert_allclose(here.joints, one.joints, rtol=off(k), atol=off(k))


@pytest.mark.parametrize("k", UNITS)
def test_levels_within_limits(k):
    found = []
    for u in (k, 1.0):
        levels = [(POSE, rate(u)), (turning(u, 4), [0.2])]
        found.append(r1.redundancy.saturated_priority_velocity(arm(u, 4), levels, Q4, limits=1.0))
    here, one = found
    assert here.scales == pytest.approx(one.scales, rel=off(k))
    assert here.realised == one.realised
    np.testing.assert_allclose(here.joints, one.joints, rtol=off(k), atol=off(k))


@pytest.mark.parametrize("k", UNITS)
def test_largest_gains(k):
    here, one = (
        r1.control.largest_gains(arm(u, 3), POSE, beside(u, 0.1), Q3, limits=1.0, criterion="common") for u in (k, 1.0)
    )
    np.testing.assert_allclose(here, one, rtol=off(k))


@pytest.mark.parametrize("k", UNITS)
def test_the_newton_law_is_not_stuck(k):
    target = beside(k, 0.0)
    found = r1.control.lyapunov_rate(arm(k, 3), POSE, target, Q3, method="newton")
    assert found.status.name == "DECREASES"
    np.testing.assert_allclose(POSE.jacobian(arm(k, 3), Q3) @ found.qdot, found.error, rtol=off(k), atol=1e-15)
