"""Newton's method on the missing twist, against a loop written with Pinocchio's log6 and Jacobians."""

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q

import robotics1 as r1
from robotics1.ik import IKStatus, iterate_twist

SIX = arm("six_r")


@pytest.mark.parametrize("kind", ["body", "space"])
def test_every_iterate_is_that_of_a_loop_with_log6(kind):
    q = random_q(SIX, 1)
    goal = r1.forward_kinematics(SIX, q + 0.2)
    found = iterate_twist(SIX, goal, q, kind=kind, angle_tolerance=1e-10, distance_tolerance=1e-10).require()
    for row in found.table:
        T = r1.forward_kinematics(SIX, row.q)
        V = pin.log6(T.actInv(goal)).vector
        J = pin.computeFrameJacobian(SIX.model, SIX.data, row.q, SIX.frame_id(None), pin.ReferenceFrame.LOCAL)
        assert row.twist == pytest.approx(V if kind == "body" else T.toActionMatrix() @ V, abs=1e-9)
        if row.k < found.iterations:
            assert found.table[row.k + 1].q == pytest.approx(row.q + np.linalg.pinv(J) @ V, abs=1e-7)
    assert r1.forward_kinematics(SIX, found.q).isApprox(goal, 1e-8)
    assert found.iterations <= 8
    errors = [row.angle for row in found.table]
    assert errors[-1] < 10 * errors[-2] ** 2 + 1e-14  # of second order


def test_a_planar_2r_arm_of_lynch_and_park_reaches_30_and_90_degrees():
    """Their example: links of 1 m, T_d at (30°, 90°), from (0°, 30°)."""
    robot = r1.textbook_robots.planar_arm("RR", [1.0, 1.0])
    goal = r1.forward_kinematics(robot, np.radians([30, 90]))
    found = iterate_twist(robot, goal, np.radians([0, 30]))
    assert np.degrees(found.table[1].q) == pytest.approx([34.23, 79.18], abs=0.005)
    assert np.degrees(found.table[2].q) == pytest.approx([29.98, 90.22], abs=0.005)
    assert np.degrees(found.q) == pytest.approx([30.0, 90.0], abs=0.005)
    assert found.converged
    assert "|ω|" in str(found)


def test_each_tolerance_counts_alone():
    q = random_q(SIX, 1)
    goal = r1.forward_kinematics(SIX, q + 0.1)
    loose = iterate_twist(SIX, goal, q, angle_tolerance=1.0, distance_tolerance=1e-9)
    angle = iterate_twist(SIX, goal, q, angle_tolerance=1e-9, distance_tolerance=10.0)
    assert loose.table[-1].distance <= 1e-9
    assert angle.table[-1].angle <= 1e-9
    assert iterate_twist(SIX, goal, q, angle_tolerance=4.0, distance_tolerance=100.0).iterations == 0


def test_an_arm_that_cannot_leave_its_plane_stalls_or_uses_its_iterations_up():
    robot = r1.textbook_robots.planar_arm("RR", [1.0, 1.0])
    above = pin.SE3(np.eye(3), np.array([2.0, 0.0, 1.0]))
    found = iterate_twist(robot, above, [0.0, 0.0])
    assert found.status is IKStatus.STALLED
    with pytest.raises(r1.NotConverged):
        found.require()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"kind": "world"}, "kind must be one of 'body', 'space'"),
        ({"angle_tolerance": 0}, "angle_tolerance must be a positive number"),
        ({"distance_tolerance": -1}, "distance_tolerance must be a positive number"),
        ({"max_iterations": 1.5}, "max_iterations must be an integer"),
    ],
)
def test_misuse_says_what_would_be_right(change, words):
    with pytest.raises(r1.InputError, match=words):
        iterate_twist(SIX, np.eye(4), random_q(SIX, 1), **change)


def test_what_is_no_pose_is_refused():
    with pytest.raises(r1.InputError, match="pose"):
        iterate_twist(SIX, [1, 2], random_q(SIX, 1))
