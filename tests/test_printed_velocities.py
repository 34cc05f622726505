"""Velocities given with few digits: in the range of a Jacobian as far as these tell, or not."""

from math import pi

import numpy as np
import pytest
from arms import ARMS, arm, random_q
from hypothesis import assume, given, strategies as st
from scipy.optimize import linprog

import robotics1 as r1
from robotics1.trajectories import RateStatus

H = pi / 2
POSE, XYZ = r1.PoseTask(), r1.PositionTask()
FOUR = r1.robot_from_dh([("R", 0, H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, H, 1, 0), ("R", 1, 0, 0, 0)])
SCARA = r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
POLAR = r1.robot_from_dh([("R", 0, H, 1, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)])
WITHIN = RateStatus.REALISED_WITHIN_DIGITS
WITH_A_TOOL = [name for name in ARMS if arm(name).tool]


@given(digits=st.integers(3, 7), seed=st.integers(0, 99))
def test_a_twist_of_four_joints_is_realised_with_any_number_of_its_digits(digits, seed):
    """Six rows of four joints: rounding alone takes almost every twist out of the range."""
    rng = np.random.default_rng(seed)
    q, qdot = rng.uniform(-2, 2, 4), rng.uniform(-1, 1, 4)
    J = POSE.jacobian(FOUR, q)
    printed = np.round(J @ qdot, digits)
    found = r1.joint_velocity(FOUR, POSE, printed, q)
    assert (found.status, found.feasible) == (WITHIN, True)
    assert found.require() is found
    assert J @ found.qdot + found.residual == pytest.approx(printed, abs=1e-12)
    assert np.abs(found.residual).max() < 10 * 0.5 * 10.0**-digits  # what is left is of the size of the rounding
    assert r1.subspaces(J).contains(printed)


def test_a_printed_twist_of_a_scara_is_realised_where_its_arm_is_stretched():
    q = [0.3, 0.0, 1.0, 0.2]
    printed = np.round(POSE.jacobian(SCARA, q) @ [0.3, 0.7, 0.2, 0.1], 4)
    found = r1.joint_velocity(SCARA, POSE, printed, q)
    assert (found.rank, found.status) == (3, WITHIN)


@given(digits=st.integers(3, 6), seed=st.integers(0, 99))
def test_a_twist_that_its_digits_do_not_take_into_the_range_is_out_of_range(digits, seed):
    rng = np.random.default_rng(seed)
    q, qdot = rng.uniform(-2, 2, 4), rng.uniform(-1, 1, 4)
    J = POSE.jacobian(FOUR, q)
    normal = r1.subspaces(J).left_null[:, 0]
    away = 2 * 0.5 * 10.0**-digits * np.abs(normal).sum()  # twice what the digits can make of the part along it
    asked = np.round(J @ qdot + away * normal, digits)
    assert r1.joint_velocity(FOUR, POSE, asked, q).status is RateStatus.OUT_OF_RANGE
    assert not r1.subspaces(J).contains(asked)


def test_the_configuration_may_be_printed_too():
    """Joint 1 of the polar arm must be at π/4 for this velocity at its singularity; 0.7855 does not stand for it."""
    v = [-0.577350269189626, -0.577350269189626, 0.577350269189626]
    assert r1.joint_velocity(POLAR, XYZ, v, [0.7854, pi, 1.0]).status is WITHIN
    assert r1.joint_velocity(POLAR, XYZ, v, [0.785398, pi, 1.0]).status is WITHIN
    assert r1.joint_velocity(POLAR, XYZ, v, [0.7855, pi, 1.0]).status is RateStatus.OUT_OF_RANGE
    assert r1.joint_velocity(POLAR, XYZ, v, [0.785398163397448 + 1e-5, pi, 1.0]).status is RateStatus.OUT_OF_RANGE


def test_at_printed_digits_of_a_singularity_the_answer_there_knows_the_digits_of_the_velocity():
    found = r1.joint_velocity(POLAR, XYZ, [-0.5774, -0.5774, 0.5774], [0.7854, 3.1416, 1.0])
    assert found.status is RateStatus.NEARLY_SINGULAR
    assert found.at_singularity.status is WITHIN
    assert found.at_singularity.qdot == pytest.approx([0, 0.8166, 0.5774], abs=1e-4)


def test_numbers_of_one_or_two_decimals_are_exact():
    J = np.array([[1.0, 0], [1.0, 0]])
    assert not r1.subspaces(J).contains([0.57, 0.58])
    assert r1.subspaces(J).contains([0.577, 0.578])  # of 0.5775
    assert not r1.subspaces(J).contains([0.577, 0.579])
    assert not r1.subspaces(J).contains([0.577, 0.5784])  # the zero after 0.577 was left out


@pytest.mark.parametrize("digits", [4, 6])
def test_a_printed_acceleration_is_realised_too(digits):
    q, qdot, qddot = np.array([0.3, 1.1, 0.4, -0.7]), np.array([0.5, -0.2, 0.3, 0.8]), np.array([0.1, 0.4, -0.3, 0.2])
    drift = r1.joint_acceleration(FOUR, POSE, np.zeros(6), q, qdot).drift
    asked = np.round(POSE.jacobian(FOUR, q) @ qddot + drift, digits)
    found = r1.joint_acceleration(FOUR, POSE, asked, q, qdot)
    assert found.status is WITHIN
    assert found.qddot == pytest.approx(qddot, abs=20 * 10.0**-digits)
    other = r1.joint_acceleration(FOUR, POSE, asked + 0.01 * np.eye(6)[5], q, qdot)
    assert other.status is RateStatus.OUT_OF_RANGE


@pytest.mark.parametrize("name", WITH_A_TOOL)
def test_a_velocity_in_the_range_is_realised_whatever_its_digits(name):
    """Of computed numbers, and where J has full row rank, the digits play no part."""
    robot = arm(name)
    q = random_q(robot, 4)
    J = XYZ.jacobian(robot, q)
    v = J @ np.linspace(0.2, 0.9, robot.nv)
    exact, rounded = (r1.joint_velocity(robot, XYZ, x, q) for x in (v, np.round(v, 4)))
    assert exact.status in (RateStatus.REALISED, RateStatus.REALISED_ALL_THE_SAME)
    assert rounded.feasible


@given(m=st.integers(2, 4), digits=st.integers(3, 6), seed=st.integers(0, 999))
def test_a_printed_velocity_is_in_the_range_where_a_linear_program_finds_one_that_rounds_to_it(m, digits, seed):
    """|J x − ṙ| ≤ h in each entry, with h half a unit of the last digit of ṙ."""
    rng, unit = np.random.default_rng(seed), 10.0**-digits
    J = rng.uniform(-1, 1, (m, m - 1))
    asked = np.round(J @ rng.uniform(-1, 1, m - 1) + unit * rng.uniform(-1.5, 1.5, m), digits)
    assume((np.round(asked, digits - 1) != asked).all())  # every entry has all digits
    room = np.concatenate([asked / unit + 0.5, 0.5 - asked / unit])
    program = linprog(np.zeros(m - 1), A_ub=np.vstack([J, -J]), b_ub=room, bounds=(None, None))
    assert r1.subspaces(J).contains(asked) == (program.status == 0)
