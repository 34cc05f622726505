"""Where to put the base, and unions and differences of maps: against geometry, brute force, and set laws."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
from arms import arm

import robotics1 as r1
from robotics1.workspaces import PoseStatus, best_placements, map_difference, map_union, reachability_map

L1, L2 = 0.5, 0.3
PLANE = r1.PositionTask("xy")
AXIS = np.linspace(-1, 1, 21)


@pytest.fixture(scope="module")
def planar():
    return r1.robot_from_dh([("R", L1, 0, 0, 0), ("R", L2, 0, 0, 0)])


def test_a_planar_arm_serves_all_points_whose_distances_from_its_base_are_in_the_ring(planar):
    points = np.array([[0.513, 0.117], [0.231, 0.642], [-0.103, 0.219]])  # none at the edge of the ring
    found = best_placements(planar, PLANE, points, {"x": AXIS, "y": AXIS})
    distance = np.linalg.norm(points - found.places[:, None, :2, 3], axis=2)
    expected = (distance > L1 - L2) & (distance < L1 + L2)
    assert np.array_equal(found.status == PoseStatus.REACHED, expected)
    assert np.array_equal(found.reached, expected.sum(axis=1))
    c2 = (distance**2 - L1**2 - L2**2) / (2 * L1 * L2)
    every = expected.all(axis=1)
    assert every.any()
    assert found.manipulability[every] == pytest.approx(L1 * L2 * np.sqrt(1 - c2[every] ** 2).min(axis=1), abs=1e-12)
    assert np.isnan(found.manipulability[~every]).all()
    assert found.manipulability[found.best] == np.nanmax(found.manipulability)
    assert found.require() is found
    assert f"{every.sum()} of 441 places" in found.explain()


def test_the_best_base_is_checked_by_forward_kinematics_of_a_robot_standing_there():
    robot, rng = arm("six_r"), np.random.default_rng(2)
    poses = [r1.forward_kinematics(robot, rng.uniform(-1, 1, robot.nq)) for _ in range(4)]
    found = best_placements(robot, r1.PoseTask(), poses, {"x": [-0.1, 0, 0.1], "y": [0, 0.1], "turn": [0, 0.4, pi]})
    stay = int(np.flatnonzero((np.abs(found.places - np.eye(4)) < 1e-12).all(axis=(1, 2)))[0])
    assert found.reached[stay] == 4
    B = pin.SE3(found.places[found.best])
    for pose in poses:
        q = r1.solve_ik(robot, r1.PoseTask(), B.inverse() * pose).require().q
        assert B.act(r1.forward_kinematics(robot, q)).isApprox(pose, 1e-5)


def test_moving_the_base_is_moving_the_poses_the_other_way():
    robot, rng = arm("six_r"), np.random.default_rng(3)
    poses = [r1.forward_kinematics(robot, rng.uniform(-1, 1, robot.nq)) for _ in range(5)]
    places = [pin.SE3(pin.exp3(rng.uniform(-0.3, 0.3, 3)), rng.uniform(-0.2, 0.2, 3)) for _ in range(20)]
    base = best_placements(robot, r1.PoseTask(), poses, places)
    path = best_placements(robot, r1.PoseTask(), poses, [place.inverse() for place in places], moves="poses")
    assert np.array_equal(base.status, path.status)
    assert base.manipulability == pytest.approx(path.manipulability, nan_ok=True)


def test_a_map_is_where_a_single_pose_can_be_moved_to(planar):
    found = best_placements(planar, PLANE, [[0, 0]], {"x": AXIS, "y": AXIS}, moves="poses")
    known = reachability_map(planar, PLANE, {"x": AXIS, "y": AXIS})
    assert np.array_equal(found.status, known.status)
    assert found.manipulability == pytest.approx(known.manipulability, nan_ok=True)


def test_no_place_serves_points_farther_apart_than_twice_the_reach(planar):
    found = best_placements(planar, PLANE, [[0, 0], [2, 0]], {"x": AXIS, "y": AXIS})
    assert found.reached.max() == 1
    with pytest.raises(r1.NotConverged, match="0 of 441 places"):
        found.require()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([], {"x": 0}), "no target"),
        (([[0, 0, 0]], {"x": 0}), "target 0 of the batch"),
        (([[0, 0]], []), r"no target|no place"),
        (([[0, 0]], {"X": 0}), "some of x, y, z, turn"),
        (([[0, 0]], {"x": []}), "no place"),
        (([[0, 0]], [pin.SE3(pin.utils.rotate("x", 1.0), np.zeros(3))]), "out of the coordinates x, y"),
    ],
)
def test_misuse_says_what_would_be_right(planar, arguments, message):
    with pytest.raises(r1.InputError, match=message):
        best_placements(planar, PLANE, *arguments)


def test_union_and_difference_are_those_of_the_sets_of_poses():
    short, long = arm("planar_2r"), arm("planar_2r", l2=0.4)
    grid = {"x": np.linspace(-2.2, 2.2, 45), "y": np.linspace(-2.2, 2.2, 45)}
    a, b = (reachability_map(robot, PLANE, grid) for robot in (short, long))
    either, only = map_union(a, b), map_difference(a, b)
    assert np.array_equal(either.reached, a.reached | b.reached)
    assert np.array_equal(only.reached, a.reached & ~b.reached)
    assert only.reached.any()
    assert np.array_equal(map_union(a, a).reached, a.reached)
    assert not map_difference(a, a).reached.any()
    assert np.array_equal(map_union(only, b).reached, either.reached)
    counted = (a.solutions < 255) & (b.solutions < 255)  # at an edge two solutions meet
    assert counted.mean() > 0.9
    assert np.array_equal(either.solutions[counted], (a.solutions + b.solutions)[counted])
    assert (either.solutions[~counted] == 255).all()
    assert np.array_equal(either.manipulability, np.fmax(a.manipulability, b.manipulability), equal_nan=True)
    assert np.isnan(only.manipulability[~only.reached[:, 0]]).all()
    better = np.flatnonzero(either.manipulability > np.nan_to_num(a.manipulability, nan=-1))
    for i in better[:5]:
        assert r1.forward_kinematics(long, either.q[i]).translation[:2] == pytest.approx(either.positions[i], abs=1e-6)


def test_maps_of_different_poses_are_not_compared(planar):
    a, b = reachability_map(planar, PLANE, [[0.1, 0.2]]), reachability_map(planar, PLANE, [[0.1, 0.3]])
    with pytest.raises(r1.InputError, match="the same positions and orientations"):
        map_union(a, b)
    with pytest.raises(r1.InputError, match="a map is what"):
        map_difference(a, 3)
