"""Where a search serves: a target at a fold is a boundary with its distance; sets of dimension n − m with tangents."""

import numpy as np
import pytest

from robotics1 import FunctionTask, PositionTask, ik_solutions, load_robot, robot_from_dh
from robotics1.ik import IKStatus

XY = PositionTask("xy")
DIRECTION = np.array([0.6, 0.8])


def planar(*lengths, lower=None, upper=None):
    return robot_from_dh([("R", a, 0, 0, 0) for a in lengths], lower=lower, upper=upper)


def followed(multiplier):
    """Three links of 1 m; the third joint turns with the second."""
    turns = "".join(
        f"<joint name='j{i}' type='continuous'><parent link='l{i}'/><child link='l{i + 1}'/>"
        f"<origin xyz='{float(i > 0)} 0 0'/><axis xyz='0 0 1'/>{extra}</joint>"
        for i, extra in enumerate(("", "", f"<mimic joint='j1' multiplier='{multiplier}'/>"))
    )
    end = "<joint name='end' type='fixed'><parent link='l3'/><child link='l4'/><origin xyz='1 0 0'/></joint>"
    links = "".join(f"<link name='l{i}'/>" for i in range(5))
    return load_robot(f"<robot name='r'>{links}{turns}{end}</robot>")


def own_function(p, R, q):
    return [p[0] + p[1], p[0] - p[1]]


STRETCHED = {  # robot, task, options, reach
    "method": (planar(1.2, 0.8), XY, {"method": "search"}, 2.0),
    "follower": (followed(1), XY, {}, 3.0),
    "follower the other way": (followed(-1), XY, {"box": {"j1": (-1, 1)}}, 3.0),
    "function": (planar(1.2, 0.8), FunctionTask(own_function, 2, units=("m", "m")), {}, 2.0),
    "redundant": (planar(1, 0.7, 0.3), XY, {}, 2.0),
    "more redundant": (planar(0.8, 0.6, 0.4, 0.2), XY, {}, 2.0),
}


def asked(case, radius):
    robot, task, options, _ = STRETCHED[case]
    p = radius * DIRECTION
    return ik_solutions(robot, task, p if task is XY else own_function(p, None, None), starts=20, **options)


@pytest.mark.parametrize("case", STRETCHED)
def test_a_stretched_arm_is_at_the_boundary_and_says_how_far(case):
    reach = STRETCHED[case][3]
    at, beyond, far = (asked(case, reach + gap) for gap in (0, 5e-7, 1e-3))
    assert [found.status for found in (at, beyond)] == [IKStatus.BOUNDARY] * 2
    assert [len(found) for found in (at, beyond, far)] == [1, 1, 0]
    factor = np.sqrt(2) if case == "function" else 1.0
    assert [at.boundary_distance, beyond.boundary_distance] == pytest.approx([0, 5e-7 * factor], abs=1e-9)
    assert (at.singular.all(), at.complete) == (True, False)
    assert far.status in (IKStatus.UNREACHABLE, IKStatus.NOT_FOUND)


@pytest.mark.parametrize("case", STRETCHED)
def test_within_a_micrometre_it_is_at_hand_and_further_inside_it_is_not(case):
    reach = STRETCHED[case][3]
    near, inside = (asked(case, reach - gap) for gap in (5e-7, 1e-5))
    redundant = "redundant" in case
    assert near.status is (IKStatus.INFINITE if redundant else IKStatus.BOUNDARY)
    assert inside.status is (IKStatus.INFINITE if redundant else IKStatus.FINITE)
    assert near.boundary_distance == pytest.approx(5e-7 * (np.sqrt(2) if case == "function" else 1.0), rel=1e-3)
    assert inside.boundary_distance == np.inf


def test_a_joint_at_its_limit_is_no_boundary_where_j_keeps_its_rank():
    arm = planar(1.2, 0.8, lower=[-1, 0.5], upper=[1, 2])
    p = XY.value(arm, [0.3, 0.5])
    found = ik_solutions(arm, XY, p * (1 + 3e-7), method="search")
    assert (found.status, len(found)) == (IKStatus.UNREACHABLE, 0)
    assert ik_solutions(arm, XY, p, method="search").status is IKStatus.FINITE


@pytest.mark.parametrize("joints", [3, 4, 5])
@pytest.mark.parametrize("gap", [1e-5, 1e-3, 0.3])
def test_n_joints_leave_n_minus_2_dimensions_however_small_the_set_is(joints, gap):
    arm = planar(*np.full(joints, 1.0))
    found = ik_solutions(arm, XY, (joints - gap) * DIRECTION, starts=30)
    assert (found.status, found.dimension, found.complete) == (IKStatus.INFINITE, joints - 2, False)
    assert len(found) >= 1


def test_tangents_of_a_redundant_arm_are_unit_vectors_that_j_takes_to_zero():
    arm = planar(1, 0.7, 0.3)
    found = ik_solutions(arm, XY, [0.9, 0.5])
    assert found.tangents.shape == found.q.shape
    assert np.linalg.norm(found.tangents, axis=1) == pytest.approx(1.0)
    for q, t in zip(found.q, found.tangents, strict=True):
        assert np.abs(XY.jacobian(arm, q) @ t).max() < 1e-9
