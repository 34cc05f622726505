"""The solutions of redundant arms: as many curves as the four-bar linkage has, even samples, the best of them."""

from math import pi

import numpy as np
import pytest
from arms import arm
from hypothesis import given, settings, strategies as st
from test_all_solutions import P, R, robot_of

import robotics1 as r1
from robotics1.ik import IKStatus, self_motion

H = pi / 2
XY = r1.PositionTask("xy")
ARM = [R(0.4, 0, 0), R(0.3, 0, 0), R(0.2, 0, 0)]


def assert_even_solutions(robot, task, target, curve):
    """All are solutions, and neighbours are equally far apart to 2 %."""
    for q in curve.q:
        assert np.abs(task.error(robot, q, target)).max() < 1e-9
        assert robot.within_limits(q)
    d = np.diff(np.vstack([curve.q, curve.q[:1]]) if curve.closed else curve.q, axis=0)
    d = np.where(robot.revolute, np.angle(np.exp(1j * d)), d / robot.units)
    steps = np.linalg.norm(d, axis=1)
    assert np.ptp(steps) < 0.02 * steps.max()


@given(st.integers(0, 10_000))
@settings(max_examples=8)
def test_a_planar_3r_has_two_curves_where_grashofs_linkage_cannot_turn_over(seed):
    """Links l1, l2, l3 and the distance r close a four-bar: two curves if the shortest and the longest of the four are
    together shorter than the other two, and one if they are longer (Grashof)."""
    rng = np.random.default_rng(seed)
    links = rng.uniform(0.2, 1, 3)
    target = rng.uniform(0.2, 1) * links.sum() * np.array([np.cos(seed), np.sin(seed)])
    bars = np.sort([*links, np.linalg.norm(target)])
    gap = bars[0] + bars[3] - bars[1] - bars[2]
    if abs(gap) < 0.05 or bars[3] > 0.97 * bars[:3].sum():
        return
    robot = robot_of([R(a, 0, 0) for a in links])
    found = self_motion(robot, XY, target, samples=200)
    assert (found.status, found.dimension) == (IKStatus.INFINITE, 1)
    assert len(found.curves) == (2 if gap < 0 else 1)
    for curve in found.curves:
        assert curve.closed
        assert_even_solutions(robot, XY, target, curve)


@pytest.mark.parametrize("criterion", ["manipulability", "middle", "near"])
def test_the_best_on_a_curve_is_that_of_brute_force(criterion):
    robot = r1.robot_from_dh(ARM, lower=[-3, -2.9, -2.8], upper=[3, 2.9, 2.9])
    q0 = np.array([0.2, 0.4, -0.3])
    value = {
        "manipulability": lambda q: np.prod(np.linalg.svd(XY.jacobian(robot, q), compute_uv=False)),
        "middle": lambda q: -0.5 * sum(((q - [0, 0, 0.05]) / [6, 5.8, 5.7]) ** 2),
        "near": lambda q: -np.linalg.norm(q - q0),
    }[criterion]
    target = [0.5, 0.3]
    found = self_motion(robot, XY, target, criterion=criterion, q0=q0 if criterion == "near" else None)
    dense = self_motion(robot, XY, target, samples=2000)
    brute = max(value(q) for curve in dense.curves for q in curve.q)
    assert value(found.best) >= brute - 1e-6
    assert found.value == pytest.approx(value(found.best))
    assert np.abs(XY.error(robot, found.best, target)).max() < 1e-9


def test_curves_of_a_7r_arm_end_at_its_limits():
    robot = r1.load_robot("panda")
    task = r1.PoseTask(frame="panda_link8")
    q = np.array([0.1, 0.3, 0.2, -1.8, 0.4, 1.7, 0.5, 0.02])
    target = task.value(robot, q)
    found = self_motion(robot, task, target)
    assert (found.dimension, len(found.curves) > 0) == (1, True)
    nearest = min(np.linalg.norm(curve.q - q, axis=1).min() for curve in found.curves)
    assert nearest < 0.1  # half of the samples' distance
    for curve in found.curves:
        assert_even_solutions(robot, task, target, curve)
        assert not curve.closed
        for end, at in zip(curve.ends, (curve.q[0], curve.q[-1]), strict=True):
            j = robot.joint_names.index(end)
            assert min(abs(at[j] - robot.lower[j]), abs(at[j] - robot.upper[j])) < 1e-9


def test_a_locked_joint_leaves_finitely_many_solutions():
    robot = r1.load_robot("panda")
    task = r1.PoseTask(frame="panda_link8")
    q = np.array([0.1, 0.3, 0.2, -1.8, 0.4, 1.7, 0.5, 0.02])
    found = r1.ik_solutions(robot, task, task.value(robot, q), locked={"panda_joint7": 0.5})
    assert (found.status, found.complete, found.free_joints) == (IKStatus.FINITE, True, ("panda_finger_joint1",))
    assert np.abs(found.q - q).max(axis=1).min() < 1e-9
    assert (found.q[:, 6] == 0.5).all()
    three = robot_of(ARM)
    fixed = r1.ik_solutions(three, XY, [0.5, 0.3], locked={"q1": 0.4})
    assert [len(fixed), fixed.complete] == [2, True]
    assert fixed.q[:, 0] == pytest.approx([0.4, 0.4])
    with pytest.raises(r1.UnknownNameError, match="q9"):
        r1.ik_solutions(three, XY, [0.5, 0.3], locked={"q9": 0.4})
    with pytest.raises(r1.InputError, match="the locked 'q1' must be"):
        r1.ik_solutions(three, XY, [0.5, 0.3], locked={"q1": "a"})
    with pytest.raises(r1.InputError, match="locked"):
        r1.ik_solutions(three, XY, [0.5, 0.3], locked=[0.4])


def test_a_slide_that_makes_an_arm_redundant_is_followed_to_its_ends():
    robot = r1.robot_from_dh([P(H), R(0.5, 0, 0, H), R(0.4, 0, 0)], lower=[-0.3, None, None], upper=[0.3, None, None])
    task = r1.PositionTask("xz")
    value = task.value(robot, [0.1, 0.4, 0.9])
    found = self_motion(robot, task, value)
    assert found.dimension == 1
    for curve in found.curves:
        assert_even_solutions(robot, task, value, curve)
        assert set(curve.ends) <= {"q1", ""}


def test_a_family_of_two_dimensions_is_sampled_and_an_unreachable_target_has_none():
    four = robot_of([*ARM, R(0.1, 0, 0)])
    found = self_motion(four, XY, [0.5, 0.3])
    assert (found.dimension, found.curves) == (2, ())
    assert len(found.q) > 10
    assert np.abs(XY.error(four, found.best, [0.5, 0.3])).max() < 1e-9
    none = self_motion(four, XY, [2.0, 0.3])
    assert (none.status, len(none.q), none.curves) == (IKStatus.UNREACHABLE, 0, ())
    with pytest.raises(r1.NotConverged):
        none.require()


def test_a_4r_arm_with_a_planar_pose_has_two_closed_curves():
    robot = robot_of([*ARM, R(0.1, 0, 0)])
    task = r1.PlanarPoseTask()
    found = self_motion(robot, task, [0.5, 0.3, 0.2], samples=200)
    wrist = np.hypot(0.5 - 0.1 * np.cos(0.2), 0.3 - 0.1 * np.sin(0.2))
    bars = np.sort([0.4, 0.3, 0.2, wrist])
    assert len(found.curves) == (2 if bars[0] + bars[3] < bars[1] + bars[2] else 1)
    for curve in found.curves:
        assert_even_solutions(robot, task, [0.5, 0.3, 0.2], curve)


def test_what_is_not_redundant_or_asked_wrongly_is_refused_by_a_sentence():
    robot = robot_of(ARM)
    with pytest.raises(r1.TaskError, match="ik_solutions has the single ones"):
        self_motion(arm("planar_2r"), XY, [1, 0])
    with pytest.raises(r1.InputError, match="give q0 with criterion='near'"):
        self_motion(robot, XY, [0.5, 0], criterion="near")
    with pytest.raises(r1.InputError, match="criterion must be one of"):
        self_motion(robot, XY, [0.5, 0], criterion="best")
    with pytest.raises(r1.InputError):
        self_motion(robot, XY, [np.nan, 0])
