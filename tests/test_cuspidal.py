"""Cuspidal arms are found with an example, and the others by a proof or a search that says how sure it is."""

from math import pi

import numpy as np
import pytest
from arms import arm
from hypothesis import given, settings, strategies as st
from test_all_solutions import ANTHROPOMORPHIC, CYLINDRICAL, ORTHOGONAL, POSE, PUMA, STANFORD, UR5, XYZ, P, R, robot_of
from test_postures import SCARA, XY, assert_free_of_singularities, det_of_the_orthogonal_arm

import robotics1 as r1
from robotics1.ik import CuspidalityStatus as Is, is_cuspidal

H = pi / 2
OFFSET = 0.0741 / (2 * np.cos(pi / 6))  # of a wrist with two bends of 60°
JACO = [R(0, H, 0.2755), R(0.41, pi, 0), R(0, H, -0.0098), R(0, pi / 3, -0.2073 - OFFSET), R(0, pi / 3, -2 * OFFSET)]
JACO = [*JACO, R(0, pi, -0.16 - OFFSET)]
COBOT = [R(0, -H, 0.265), R(0.444, 0, 0), R(0.11, -H, 0), R(0, H, 0.47), R(0.08, -H, 0), R(0, 0, 0.101)]


def assert_example(robot, task, found):
    """Its two solutions have one value, are no whole turns apart, and are joined without a singularity."""
    assert (found.status, found.proven) == (Is.CUSPIDAL, True)
    assert np.abs(task.error(robot, found.q_b, task.value(robot, found.q_a))).max() < 1e-9
    assert np.abs(np.exp(1j * found.q_a) - np.exp(1j * found.q_b)).max() > 0.1
    assert_free_of_singularities(robot, task, found, found.q_a, found.q_b)


def test_the_classical_orthogonal_arm_is_cuspidal_with_four_cusps():
    """At a cusp the null vector of J is tangent to det J = 0: the third derivative is what first moves the tool."""
    robot = robot_of(ORTHOGONAL)
    found = is_cuspidal(robot, XYZ)
    assert_example(robot, XYZ, found)
    assert len(found.cusps) == 4
    for q2, q3 in found.cusps:
        assert det_of_the_orthogonal_arm(q2, q3) == pytest.approx(0, abs=1e-9)
        v = np.linalg.svd(XYZ.jacobian(robot, [0, q2, q3]))[2][-1]
        h = 1e-5
        slope = det_of_the_orthogonal_arm(q2 + h * v[1], q3 + h * v[2]) - det_of_the_orthogonal_arm(
            q2 - h * v[1], q3 - h * v[2]
        )
        assert slope / (2 * h) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize(
    ("rows", "task"),
    [
        (ANTHROPOMORPHIC, XYZ),
        (CYLINDRICAL, XYZ),
        (SCARA[:3], XYZ),
        ([R(0.4, 0, 0), R(0.3, 0, 0)], XY),
        (UR5, POSE),
        (PUMA, POSE),
        (STANFORD, POSE),
    ],
    ids=["anthropomorphic", "cylindrical", "SCARA", "2R", "UR5", "Puma", "Stanford"],
)
def test_arms_whose_postures_have_names_are_not_cuspidal(rows, task):
    found = is_cuspidal(robot_of(rows), task)
    assert (found.status, found.proven) == (Is.NOT_CUSPIDAL, True)
    assert "one solution for each pattern of signs" in found.explain()


def test_an_orthogonal_arm_with_a_short_last_link_has_no_cusp():
    """Where no target has four solutions no three can meet: so with a3 small beside a1 and a2 (Wenger's type 1)."""
    rows = [R(1, -H, 0), R(0.5, H, 0.2), R(0.3, 0, 0)]
    robot, rng = robot_of(rows), np.random.default_rng(1)
    found = is_cuspidal(robot, XYZ)
    assert (found.status, found.proven, len(found.cusps)) == (Is.NOT_CUSPIDAL, True, 0)
    values = (XYZ.value(robot, q) for q in rng.uniform(-3, 3, (100, 3)))
    assert {len(r1.ik_solutions(robot, XYZ, p)) for p in values} == {2}


@given(st.integers(0, 10_000))
@settings(max_examples=6)
def test_a_3r_arm_with_a_cusp_is_cuspidal_and_one_without_is_not(seed):
    """The theorem of Salunkhe and others on drawn arms: examples come from a search, cusps from polynomials."""
    rng = np.random.default_rng(seed)
    rows = [R(*rng.uniform(0.2, 1, 1), *rng.uniform(0.4, 1.5, 1), *rng.uniform(-0.5, 0.5, 1)) for _ in range(3)]
    robot = robot_of(rows)
    found = is_cuspidal(robot, XYZ)
    if not found.proven:  # a search of 20 targets; it says so
        assert "no proof" in found.explain()
        return
    assert (found.status is Is.CUSPIDAL) == (len(found.cusps) > 0)
    if len(found.cusps):
        assert_example(robot, XYZ, found)


def test_an_arm_that_no_theorem_decides_is_searched_with_a_stated_confidence():
    """With a1 = 0 the first two axes meet; such arms are not cuspidal (Wenger), but here only 5 targets say so."""
    found = is_cuspidal(robot_of([R(0, -H, 0), R(0.5, H, 0.2), R(0.7, 0, 0)]), XYZ, targets=5)
    assert (found.status, found.proven, found.targets) == (Is.NOT_CUSPIDAL, False, 5)
    assert "less than 45 % of the targets" in found.explain()  # 1 − 0.05^(1/5)


def test_a_cobot_with_an_offset_wrist_is_cuspidal():
    robot = robot_of(COBOT)
    assert_example(robot, POSE, is_cuspidal(robot, POSE))


@pytest.mark.sweep
def test_a_jaco_arm_is_cuspidal():
    robot = robot_of(JACO)
    assert_example(robot, POSE, is_cuspidal(robot, POSE))


def test_a_redundant_arm_is_refused_and_one_joint_is_not_cuspidal():
    with pytest.raises(r1.TaskError, match="3 joints and 2 rows of the task"):
        is_cuspidal(arm("planar_3r"), XY)
    found = is_cuspidal(robot_of([R(0.4, H, 0)]), r1.PositionTask("x"))
    assert (found.status, found.proven) == (Is.NOT_CUSPIDAL, True)
    slides = robot_of([P(H), P(H, H), P(H, H)])
    assert is_cuspidal(slides, XYZ).status is Is.NOT_CUSPIDAL
