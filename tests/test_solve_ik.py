"""What `IKSolver` promises: stretched arms, targets at limits and singularities, nearest misses, and proofs."""

from itertools import product
from math import cos, hypot, pi, sin, sqrt

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from scipy.optimize import brentq

from robotics1 import (
    FunctionTask,
    IKSolver,
    NotConverged,
    PoseTask,
    PositionTask,
    forward_kinematics,
    frame_jacobian,
    load_robot,
    solve_ik,
)
from robotics1.ik import IKStatus

XY = PositionTask("xy")
L1, L2 = 1.2, 0.8
ANGLES = (0.0, 0.7, pi / 2, 2.5, pi, -3.0)
ROBOTS = {"ur5": "tool0", "panda": "panda_link8"}


def robot(name):
    return load_robot(name, tool=ROBOTS[name]) if name in ROBOTS else arm(name)


def polar(r, angle):
    return np.array([r * cos(angle), r * sin(angle)])


def reached(robot, task, target, q0=None, **options):
    """Assert that a target is reached, as Pinocchio sees it, inside the limits; return the answer."""
    found = solve_ik(robot, task, target, q0, **options)
    assert found.status is IKStatus.CONVERGED
    assert robot.within_limits(found.q, tolerance=0.0)
    assert np.linalg.norm(task.error(robot, found.q, target)) <= options.get("tolerance", 1e-6) + 1e-13
    return found


# --- stretched, and beyond


@pytest.mark.parametrize("angle", ANGLES)
def test_the_2r_arm_reaches_l1_plus_l2_stretched_and_l1_minus_l2_folded(planar_2r, angle):
    assert reached(planar_2r, XY, polar(L1 + L2, angle)).q[1] == pytest.approx(0, abs=3e-3)
    assert abs(reached(planar_2r, XY, polar(L1 - L2, angle)).q[1]) == pytest.approx(pi, abs=3e-3)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("beyond", [1e-3, 0.5, 100.0])
def test_beyond_l1_plus_l2_the_2r_arm_is_stretched_towards_the_target(planar_2r, angle, beyond):
    target = polar(L1 + L2 + beyond, angle)
    missed = solve_ik(planar_2r, XY, target)
    assert missed.status is IKStatus.UNREACHABLE
    assert missed.error_norm == pytest.approx(beyond, rel=1e-8, abs=1e-8)
    assert np.linalg.norm(XY.error(planar_2r, missed.q, target)) == pytest.approx(missed.error_norm, abs=1e-12)
    assert polar(1, missed.q[0]) == pytest.approx(polar(1, angle), abs=5e-3)
    assert missed.q[1] == pytest.approx(0, abs=5e-3)


@pytest.mark.parametrize("far", [1e10, 1e100, 1e200, 1e300])
def test_targets_that_no_arm_can_reach_are_told_so_without_overflow(planar_2r, far):
    for given, task, target in [
        (planar_2r, XY, [far, far]),
        (arm("redundant"), PoseTask(), pin.SE3(np.eye(3), np.array([0, -far, 0]))),
    ]:
        missed = solve_ik(given, task, target)
        assert missed.status is IKStatus.UNREACHABLE
        assert missed.error_norm == pytest.approx(far * (sqrt(2) if task is XY else 1), rel=1e-9)
        assert given.within_limits(missed.q, tolerance=0.0)


@pytest.mark.parametrize("angle", ANGLES[:3])
@pytest.mark.parametrize("distance", [0.05, 0.1, L1 - L2 - 1e-3])
def test_the_hole_of_the_annulus_is_proven_out_of_reach_and_the_2r_arm_folds_towards_the_target(
    planar_2r, angle, distance
):
    missed = solve_ik(planar_2r, XY, polar(distance, angle), time_limit=0.01)
    assert missed.status is IKStatus.UNREACHABLE
    assert missed.error_norm == pytest.approx(L1 - L2 - distance, abs=1e-6)
    assert polar(1, missed.q[0]) == pytest.approx(polar(1, angle), abs=2e-3)
    assert abs(missed.q[1]) == pytest.approx(pi, abs=2e-3)


def test_beyond_a_limit_of_the_elbow_is_proven_out_of_reach_and_the_elbow_is_at_its_limit():
    """|p|² = l1² + l2² + 2 l1 l2 cos q2 is greatest at the lower limit, q2 = 0.3."""
    elbow, l1, l2, limit = arm("elbow_limited"), 0.7, 0.4, 0.3
    farthest = sqrt(l1**2 + l2**2 + 2 * l1 * l2 * cos(limit))
    for angle in (-1.0, 0.2, 1.5):
        assert reached(elbow, XY, polar(farthest, angle)).q[1] == pytest.approx(limit, abs=2e-5)
        missed = solve_ik(elbow, XY, polar(farthest + 5e-3, angle), time_limit=0.01)
        assert missed.status is IKStatus.UNREACHABLE
        assert missed.error_norm == pytest.approx(5e-3, abs=1e-8)
        assert missed.q[1] == pytest.approx(limit, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "q"),
    [
        ("ur5", [0.3, -pi / 2, 0, -pi / 2, 0.4, 0]),
        ("ur5", [0.3, -pi / 2, 0, 0.5, 1.2, 0.7]),
        ("redundant", [0.3, 0, 0, 0, 0, 0, 0]),
        ("redundant", [0.3, 0.9, 0.2, 0, 0.4, 0.8, 1]),
        ("panda", [0.3, 0.2, 0.1, -0.0698, 0.4, 1.0, 0.2, 0]),
        ("panda", [0.3, 0.2, 0.1, -0.0698, 0.4, 0.0, 0.2, 0]),
    ],
)
def test_stretched_arms_reach_their_pose_and_position(name, q):
    stretched = robot(name)
    for task in (PoseTask(), PositionTask()):
        reached(stretched, task, task.value(stretched, q))


@pytest.mark.parametrize("beyond", [1e-3, 1.0])
def test_a_stretched_7r_arm_is_0_946_long_above_its_shoulder_and_a_farther_target_is_proven_out_of_reach(beyond):
    redundant, shoulder = arm("redundant"), np.array([0, 0, 0.36])
    direction = np.array([0.48, 0.6, 0.64])
    missed = solve_ik(redundant, PositionTask(), shoulder + (0.42 + 0.4 + 0.126 + beyond) * direction)
    assert missed.status is IKStatus.UNREACHABLE
    assert missed.error_norm == pytest.approx(beyond, abs=1e-6)


# --- at the limits, and at singularities


@pytest.mark.parametrize("name", ["elbow_limited", "prr", "cylindrical", "spatial", "six_r", "redundant", "ur5"])
def test_targets_with_joints_exactly_at_their_limits_are_reached(name):
    limited, rng = robot(name), np.random.default_rng(3)
    lower, upper = limited.lower, limited.upper
    every = list(product([0, 0.5, 1], repeat=limited.nq))
    corners = np.array(every if len(every) < 60 else rng.choice(every, 60))
    configurations = [lower + corner * (upper - lower) for corner in corners]
    for task in (PoseTask(), PositionTask()):
        targets = [task.value(limited, q) for q in configurations]
        batch = IKSolver(limited, task).solve_batch(targets)
        assert batch.converged.all()
        assert np.all((batch.q >= lower) & (batch.q <= upper))


def at_the_shoulder_singularities(ur5, q):
    """The q2 ∈ (−2.9, −0.1) with det J = 0: q3 and q5 are regular there, so the wrist is above the shoulder."""

    def determinant(q2):
        return float(np.linalg.det(frame_jacobian(ur5, [q[0], q2, *q[2:]])))

    if determinant(-2.9) * determinant(-0.1) < 0:
        yield [q[0], brentq(determinant, -2.9, -0.1, xtol=1e-15), *q[2:]]


def singular_configurations(ur5):
    rng = np.random.default_rng(5)
    for _ in range(40):
        q = rng.uniform(-3, 3, 6)
        yield [*q[:4], 0.0, q[5]]  # wrist
        yield [*q[:4], pi, q[5]]
        yield [*q[:2], 0.0, *q[3:]]  # elbow
        yield [*q[:2], 0.0, q[3], 0.0, q[5]]
        q[2], q[4] = rng.uniform(0.8, 1.2), rng.uniform(0.5, 1.5)
        yield from at_the_shoulder_singularities(ur5, q)


def test_targets_exactly_at_singular_configurations_are_reached():
    ur5 = robot("ur5")
    configurations = list(singular_configurations(ur5))
    for q in configurations:
        sigma = np.linalg.svd(frame_jacobian(ur5, q), compute_uv=False)
        assert sigma[-1] < 1e-10 * sigma[0]
    batch = IKSolver(ur5, PoseTask()).solve_batch([forward_kinematics(ur5, q) for q in configurations])
    assert len(configurations) > 170
    assert batch.converged.all()


def test_from_a_stretched_start_an_arm_moves_to_any_target_along_its_radius(planar_2r):
    """At q2 = 0, Jᵀe = 0 for targets on the line through the arm: the start itself leads nowhere."""
    for r in (0.5, 1.0, 1.9, L1 + L2):
        reached(planar_2r, XY, polar(r, 0.4), [0.4, 0.0])


# --- answers


def test_require_returns_a_solution_and_raises_with_the_reason_otherwise(planar_2r):
    found = solve_ik(planar_2r, XY, [1, 1])
    assert found.require() is found
    with pytest.raises(NotConverged, match=r"proven.*\|e\| = 0\.5.*starts") as raised:
        solve_ik(planar_2r, XY, [2.5, 0]).require()
    assert raised.value.result.status is IKStatus.UNREACHABLE
    same = FunctionTask(lambda p, R, q: p[:2], 2)  # of which nothing can be proven
    with pytest.raises(NotConverged, match=r"no start led to the target within the time limit.*\|e\| = 0\.3"):
        solve_ik(planar_2r, same, [0.1, 0], time_limit=0.2).require()


def test_a_function_of_the_user_is_solved_by_the_general_search(planar_2r):
    """|p|² = l1² + l2² + 2 l1 l2 cos q2, and the direction of the first link."""
    task = FunctionTask(lambda p, R, q: [hypot(p[0], p[1]), sin(q[0])], 2)
    found = reached(planar_2r, task, [1.5, 0.6])
    assert abs(cos(found.q[1])) == pytest.approx(abs((1.5**2 - L1**2 - L2**2) / (2 * L1 * L2)), abs=1e-5)
    assert sin(found.q[0]) == pytest.approx(0.6, abs=1e-6)
    missed = solve_ik(planar_2r, task, [2.5, 0.6], time_limit=0.4)
    assert missed.status is IKStatus.NOT_FOUND
    assert missed.error_norm == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("beyond", [2e-6, 1e-5, 1e-4])
def test_the_general_search_tells_no_success_just_beyond_the_tolerance(planar_2r, beyond):
    task = FunctionTask(lambda p, R, q: p[:2], 2)
    missed = solve_ik(planar_2r, task, polar(L1 + L2 + beyond, 0.4), time_limit=1.0)
    assert missed.status is IKStatus.NOT_FOUND
    assert missed.error_norm == pytest.approx(beyond, rel=1e-3)
    assert solve_ik(planar_2r, task, polar(L1 + L2 + beyond, 0.4), tolerance=2 * beyond).converged


def test_both_searches_agree_on_what_is_reached_and_on_the_nearest_miss(planar_2r):
    same = FunctionTask(lambda p, R, q: p[:2], 2)
    for target in ([1.2, 0.5], [0.1, 0.05], [2.2, 1.0], [-0.4, 0]):
        one, other = (solve_ik(planar_2r, task, target, time_limit=1.5) for task in (XY, same))
        assert one.converged == other.converged
        if not one.converged:
            assert one.error_norm == pytest.approx(other.error_norm, abs=1e-6)
