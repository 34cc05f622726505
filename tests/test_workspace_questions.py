"""What is asked of a workspace: every orientation, crossings, circles that fit, joint ranges, the largest reach."""

from itertools import product
from math import acos, atan2, hypot, inf, nan, pi, sqrt

import numpy as np
import pytest
from closed_forms import spherical_shell_volume
from hypothesis import given, settings, strategies as st
from planar_chains import XY, XYZ, drawn_chain

import robotics1 as r1
from robotics1.workspaces import (
    crossings,
    dexterous_workspace,
    extreme_reach,
    is_reached,
    joint_ranges,
    largest_circle,
    workspace,
)

WRIST = [("R", 0, -pi / 2, 0.7, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.15, 0)]
SHOULDER = [("R", 0.1, pi / 2, 0.4, 0), ("R", 0.9, 0, 0, 0), ("R", 0, pi / 2, 0, 0)]


def links(*lengths, lower=None, upper=None):
    return r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths], lower=lower, upper=upper)


# --- every orientation


@pytest.mark.parametrize(
    ("lengths", "radii"),
    [
        ((1, 0.5, 0.25), [(0.75, 1.25)]),  # the exam of 12.01.11
        ((0.5, 0.5, 0.2), [(0, 0.8)]),
        ((0.5, 0.4, 0.3), [(0, 0.2), (0.4, 0.6)]),  # the circle about the point goes around the hole
        ((0.25, 0.5, 1), []),
    ],
)
def test_radii_with_every_orientation_are_those_whose_circles_are_in_the_annulus_of_two_links(lengths, radii):
    found = dexterous_workspace(links(*lengths), XY)
    assert found.radii == pytest.approx(np.array(radii).reshape(-1, 2), abs=1e-12)
    assert found.area == pytest.approx(sum(pi * (b**2 - a**2) for a, b in radii), rel=1e-9)
    assert found.last_link == pytest.approx(lengths[-1])


@settings(max_examples=6)
@given(st.integers(0, 200))
def test_a_point_counts_if_all_points_of_its_circle_are_reached_by_the_joints_before(seed):
    kinds, arm = drawn_chain(seed, 2)
    del kinds
    rng = np.random.default_rng(seed)
    lower, upper = [*rng.uniform(-2, 0, 2), -pi], [*rng.uniform(0.5, 2.5, 2), pi]
    found = dexterous_workspace(links(1, 0.6, 0.25, lower=lower, upper=upper), XY)
    inner = workspace(links(1, 0.6, lower=lower[:2], upper=upper[:2]), XY)
    angles = np.linspace(0, 2 * pi, 60)
    circle = 0.25 * np.column_stack([np.cos(angles), np.sin(angles)])
    for p in rng.uniform(-1.6, 1.6, (25, 2)):
        if found.contains(p):
            assert all(inner.contains(p + c) for c in circle)
        elif all(inner.contains(p + c) for c in circle):
            assert min(inner.distance(p + c) for c in circle) < 1e-3
    for region in found.regions:
        assert found.contains(region.point)
    assert arm.nq == 2


def test_a_last_joint_with_limits_and_arms_of_another_kind_are_told():
    with pytest.raises(r1.TaskError, match="'q3' cannot make a full turn"):
        dexterous_workspace(links(1, 1, 1, lower=[-1] * 3, upper=[1] * 3), XY)
    with pytest.raises(r1.TaskError, match="three joints or more"):
        dexterous_workspace(links(1, 1), XY)
    with pytest.raises(r1.TaskError, match="no spherical wrist"):
        dexterous_workspace(r1.robot_from_dh(SHOULDER), XYZ)


def test_a_wrist_reaches_every_orientation_where_its_sphere_is_in_the_workspace_of_its_centre():
    arm = r1.robot_from_dh(SHOULDER + WRIST)
    found = dexterous_workspace(arm, XYZ)
    assert found.offset == pytest.approx(0.15)
    rng = np.random.default_rng(0)
    points = rng.uniform([0, 0, -1.5], [1.8, 0.3, 2.3], (60, 3))
    inside = [p for p in points if found.contains(p)]
    assert 10 < len(inside) < 50
    pose = r1.PoseTask()
    for p in inside[:6]:
        for _ in range(3):
            target = r1.forward_kinematics(arm, rng.uniform(-pi, pi, 6))
            target.translation = p
            assert len(r1.ik_solutions(arm, pose, target))
    for p in [p for p in points if not found.contains(p)][:20]:
        directions = rng.normal(size=(400, 3))
        sphere = p + 0.15 * directions / np.linalg.norm(directions, axis=1)[:, None]
        near = [abs(found.wrist.distance(s)) for s in sphere]
        assert not all(found.wrist.contains(s) for s in sphere) or min(near) < 0.02
    assert "sphere of radius 0.15" in found.explain()


@pytest.mark.parametrize("beside", [0.0, 0.2])
def test_a_wrist_behind_a_shell_reaches_every_orientation_at_its_own_length_from_both_spheres(beside):
    """The centre reaches |l2 − l3| ≤ r ≤ l2 + l3 about the shoulder, moved away from the axis by the offset."""
    rows = [("R", 0, pi / 2, 0.5, 0), ("R", 0.9, 0, beside, 0), ("R", 0, pi / 2, 0, 0)]
    found = dexterous_workspace(r1.robot_from_dh(rows + WRIST), XYZ)
    outer, inner, offset = 0.9 + 0.7, 0.9 - 0.7, found.offset
    assert offset == pytest.approx(0.15)
    far = hypot(outer, beside) - offset
    assert found.contains([far - 1e-6, 0, 0.5])
    assert not found.contains([far + 1e-6, 0, 0.5])
    if not beside:
        assert found.contains([0, 0, 0.5 + inner + offset + 1e-6])
        assert not found.contains([0, 0, 0.5 + inner + offset - 1e-6])


# --- one point


@pytest.mark.parametrize("kind", ["planar", "slide", "turn", "curved", "redundant", "sampled"])
def test_a_point_that_is_reached_has_configurations_that_reach_it(kind):
    elbow = [("R", 0, pi / 2, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1.0, 0, 0, 0)]
    curved = [("R", 0.2, pi / 3, 0.5, 0), ("R", 1.0, 0.4, 0.1, 0), ("R", 0.8, 0, 0, 0)]
    rows = {
        "planar": [("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0)],
        "slide": [("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0), ("P", 0, 0, 0, 0)],
        "turn": elbow,
        "curved": curved,
        "redundant": [("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0), ("R", 0.4, 0, 0, 0)],
        "sampled": [*curved, ("R", 0.3, 0.3, 0, 0)],
    }[kind]
    lower, upper = np.full(len(rows), -2.0), np.full(len(rows), 2.5)
    arm = r1.robot_from_dh(rows, lower=lower, upper=upper)
    task = XY if kind in ("planar", "redundant") else XYZ
    ws = workspace(arm, task)
    rng = np.random.default_rng(5)
    for q in rng.uniform(lower, upper, (8, len(rows))):
        p = task.value(arm, q)
        found = is_reached(ws, p)
        assert found.inside
        assert found.proven
        for one in found.q:
            assert task.value(arm, one) == pytest.approx(p, abs=1e-6 if kind == "sampled" else 1e-9)
            assert arm.within_limits(one, tolerance=1e-8)
        if kind not in ("redundant", "sampled"):
            assert len(found.q) == len(r1.ik_solutions(arm, task, p))
            assert "as with q" in found.explain()
    outside = is_reached(ws, [9, 0, 0][: len(p)])
    assert (outside.inside, outside.proven, len(outside.q)) == (False, kind != "sampled", 0)
    assert "not reached" in outside.explain()


# --- crossings


def test_a_line_crosses_the_circles_of_an_annulus():
    ws = workspace(links(0.4, 0.3), XY)
    found = crossings(ws, r1.LinearMotion([-1, 0.05], [0.5, 0]), 0, 4)
    out, hole = sqrt(0.7**2 - 0.05**2), sqrt(0.1**2 - 0.05**2)
    assert found.times == pytest.approx([2 - 2 * out, 2 - 2 * hole, 2 + 2 * hole, 2 + 2 * out], abs=1e-8)
    assert found.entering.tolist() == [True, False, True, False]
    assert found.points[:, 0] == pytest.approx([-out, -hole, hole, out], abs=1e-8)
    assert np.diff(found.longest) == pytest.approx([2 * (out - hole)])
    assert "It enters at t" in found.explain()


def test_a_motion_that_starts_inside_and_one_that_never_enters():
    ws = workspace(links(0.5, 0.5), XY)
    found = crossings(ws, [[0.5, 0], [2, 0]])
    assert found.times == pytest.approx([1 / 3])
    assert found.intervals == pytest.approx(np.array([[0, 1 / 3]]))
    never = crossings(ws, [[2, -1], [2, 1]])
    assert (len(never.times), len(never.intervals), len(never.longest)) == (0, 0, 0)
    assert never.explain() == "The point is never inside."
    always = crossings(ws, [[0.5, 0], [0, 0.3]])
    assert always.intervals.tolist() == [[0, 1]]


def test_a_circle_crosses_where_two_circles_meet():
    ws = workspace(links(0.5, 0.5), XY)
    found = crossings(ws, lambda t: [0.9 + 0.4 * np.cos(t), 0.4 * np.sin(t)], 0, 2 * pi)
    angle = acos((1 - 0.9**2 - 0.4**2) / (2 * 0.9 * 0.4))
    assert found.times == pytest.approx([angle, 2 * pi - angle], abs=1e-8)


def test_crossings_of_an_arm_with_offsets_are_on_its_boundary():
    arm = r1.robot_from_dh([("R", 1, -pi / 2, 0, 0), ("R", 2, pi / 2, 1, 0), ("R", 1.5, 0, 0, 0)])
    ws = workspace(arm, XYZ)
    found = crossings(ws, [[-6, 0.05, 0.2], [5, 1, 0]])
    assert found.entering.tolist() == [True, False]
    for p in found.points:
        assert ws.distance(p) < 1e-8
        assert r1.ik_solutions(arm, XYZ, p).singular.any() or len(r1.ik_solutions(arm, XYZ, p)) == 0


def test_crossings_of_an_arm_with_offsets_and_limits_are_on_its_boundary():
    rows = [("R", 0, pi / 2, 0, 0), ("R", 1, 0, 0.2, 0), ("R", 1, 0, 0, 0)]
    ws = workspace(r1.robot_from_dh(rows, lower=[-1, -3, 0], upper=[1, 3, 3]), XYZ)
    found = crossings(ws, [[1, -3, 0.1], [1, 3, 0.1]])
    assert len(found.times) == 2
    assert found.resolution < 1e-4
    assert [ws.distance(p) for p in found.points] == pytest.approx([0, 0], abs=1e-7)  # `contains` takes in 1e-9 / |D|


@pytest.mark.parametrize("wrong", [{"motion": [[0, 0, 0], [1, 1, 1]]}, {"motion": 3}, {"end": -1}, {"ws": None}])
def test_motions_of_another_form_are_refused(wrong):
    good = {"ws": workspace(links(0.5, 0.5), XY), "motion": [[0, 0], [1, 1]], "start": 0, "end": 1}
    with pytest.raises(r1.InputError):
        crossings(**(good | wrong))


@pytest.mark.parametrize("wrong", [{"tolerance": "a"}, {"tolerance": 0}, {"tolerance": nan}, {"ws": 3}])
def test_circles_of_another_form_are_refused(wrong):
    with pytest.raises(r1.InputError):
        largest_circle(**({"ws": workspace(links(0.5, 0.5), XY)} | wrong))


# --- circles that fit


def test_the_largest_circle_in_an_annulus_touches_both_circles():
    found = largest_circle(workspace(links(0.4, 0.3), XY), tolerance=1e-4)
    assert found.radius == pytest.approx(0.3, rel=1e-4)
    assert found.bound >= 0.3 - 1e-9
    assert hypot(*found.center) == pytest.approx(0.4, abs=1e-3)


def test_the_largest_circle_in_a_parallelogram_is_half_its_height():
    arm = r1.robot_from_dh([("P", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)], lower=[0, 0], upper=[2, 0.6])
    plane = r1.PositionTask("yz")
    found = largest_circle(workspace(arm, plane), tolerance=1e-3)
    assert found.radius == pytest.approx(0.3, rel=2e-3)
    with pytest.raises(r1.InputError, match="tolerance"):
        largest_circle(workspace(arm, plane), tolerance=0)


# --- joint ranges


def test_joint_ranges_are_those_of_the_elbow_that_needs_less_room():
    arm = links(1, 1)
    targets = [[1.5, 0.2], [1.2, 0.8], [0.9, 1.1]]
    found = joint_ranges(arm, XY, targets)
    assert found.smallest
    for q, p in zip(found.q, targets, strict=True):
        assert XY.value(arm, q) == pytest.approx(p, abs=1e-9)
    every = [r1.ik_solutions(arm, XY, p).q for p in targets]
    rooms = [np.ptp(np.array(pick), axis=0).sum() for pick in product(*every)]
    assert np.sum(found.upper - found.lower) == pytest.approx(min(rooms))
    assert "q1 needs from" in found.explain()


def test_joint_ranges_of_targets_with_infinitely_many_solutions_are_not_called_the_smallest():
    folded = joint_ranges(links(0.4, 0.4), XY, [[0, 0], [0.5, 0]])  # q1 is free where the arm is folded
    assert not folded.smallest
    assert "smaller ranges may exist" in folded.explain()
    assert not joint_ranges(links(0.4, 0.3, 0.2), XY, [[0.5, 0.1]]).smallest


def test_joint_ranges_go_the_short_way_round_and_name_what_is_not_reached():
    arm = links(1, 1)
    targets = [[-1.5, 0.1], [-1.5, -0.1], [5, 5]]
    found = joint_ranges(arm, XY, targets)
    assert found.unreachable == (2,)
    assert found.upper[0] - found.lower[0] < 1
    with pytest.raises(r1.InputError, match="none of the targets"):
        joint_ranges(arm, XY, [[5, 5]])
    with pytest.raises(r1.InputError, match="no target"):
        joint_ranges(arm, XY, [])


# --- the largest reach


def crx(upper_arm):
    """A cobot of six joints, by its maker's table (modified)."""
    rows = [
        ("R", 0, 0, 0, 0), ("R", 0, -pi / 2, 0, 0), ("R", upper_arm, pi, 0, 0),
        ("R", 0, -pi / 2, -0.54, 0), ("R", 0, pi / 2, 0.15, 0), ("R", 0, -pi / 2, -0.16, 0),
    ]  # fmt: skip
    return r1.robot_from_dh(rows, convention="modified")


@pytest.mark.parametrize("upper_arm", [0.54, 0.71])
def test_a_cobot_reaches_farther_than_with_its_arm_straight(upper_arm):
    """Straight it is hypot(a + 0.54 + 0.16, 0.15), but the wrist turns aside: a + hypot(0.7, 0.15)."""
    found = extreme_reach(crx(upper_arm), XYZ)
    assert found.value == pytest.approx(upper_arm + hypot(0.7, 0.15), abs=1e-9)
    assert found.value > hypot(upper_arm + 0.7, 0.15)
    assert np.linalg.norm(XYZ.value(crx(upper_arm), found.q)) == pytest.approx(found.value)
    assert found.proven
    assert "is proven" in found.explain()


def test_reach_of_two_links_is_the_bound_of_their_lengths_and_in_a_direction_too():
    arm = links(0.4, 0.3)
    far = extreme_reach(arm, XY)
    assert (far.value, far.proven) == (pytest.approx(0.7), True)
    near = extreme_reach(arm, XY, smallest=True)
    assert near.value == pytest.approx(0.1)
    along = extreme_reach(arm, XY, direction=[3, 4, 0])
    assert along.value == pytest.approx(0.7)
    assert along.point == pytest.approx([0.42, 0.56, 0], abs=1e-6)
    assert extreme_reach(arm, XY, origin=[1, 0, 0]).value == pytest.approx(1.7)


@settings(max_examples=3)
@given(st.integers(0, 1000))
def test_the_largest_reach_of_planar_arms_is_that_of_their_boundary(seed):
    _, arm = drawn_chain(seed, 3)
    ws = workspace(arm, XY)
    points = np.vstack([curve.points for curve in ws.boundary])
    far = extreme_reach(arm, XY)
    assert far.value >= np.linalg.norm(points, axis=1).max() - 1e-9
    assert far.value == pytest.approx(np.linalg.norm(points, axis=1).max(), abs=1e-3)
    assert arm.within_limits(far.q, tolerance=1e-9)
    for q in np.random.default_rng(seed).uniform(arm.lower, arm.upper, (200, 3)):
        assert np.linalg.norm(XY.value(arm, q)) <= far.value + 1e-9


@pytest.mark.parametrize("wrong", [{"direction": [0, 0, 0]}, {"origin": [0, 0]}, {"direction": [1, inf, 0]}])
def test_directions_and_origins_of_another_form_are_refused(wrong):
    with pytest.raises(r1.InputError):
        extreme_reach(links(1, 1), XY, **wrong)


# --- arms whose boundary is not known


@pytest.fixture(scope="module")
def with_tool():
    """The wrist's centre fills a shell from 0.3 to 1.5; with a tool of 0.2 the point fills it from 0.1 to 1.7."""
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0.9, 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, 0.6, 0)]
    arm = r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0, 0), ("R", 0.2, 0, 0, 0)])
    return arm, workspace(arm, XYZ)


def test_a_shell_with_a_tool_is_sampled_to_its_resolution(with_tool):
    _, ws = with_tool
    assert ws.resolution == pytest.approx(3.4 / 120, rel=0.05)
    assert abs(ws.volume - spherical_shell_volume(0.1, 1.7)) < ws.volume_error
    assert ws.volume_error < 0.1 * ws.volume
    assert ws.r_max == pytest.approx(1.7, abs=1e-8)
    assert ws.r_min == 0
    assert ws.r_bounds[0] == 0
    assert 0 <= ws.r_bounds[1] - ws.r_max < 1e-5
    assert f"none farther than {ws.r_bounds[1]:.9g} m: that is proven" in ws.explain()
    assert len(ws.regions) == 1
    assert [void.area for void in ws.voids] == [pytest.approx(pi * 0.1**2 / 2, rel=0.3)]
    assert "not proven" in ws.explain()
    assert ws.boundary == ()


def test_points_of_a_sampled_workspace_are_reached_by_a_configuration(with_tool):
    arm, ws = with_tool
    rng = np.random.default_rng(1)
    for q in rng.uniform(-pi, pi, (40, 6)):
        assert ws.contains(XYZ.value(arm, q))
    assert not ws.contains([0, 0, 0])
    assert not ws.contains([0, 0, 1.75])
    assert ws.distance([0.9, 0, 0]) == pytest.approx(0.8, abs=1.5 * ws.resolution)
    found = crossings(ws, [[-2, 0.05, 0.2], [2, 0.05, 0.2]])
    out = sqrt(1.7**2 - 0.05**2 - 0.2**2)
    assert found.times == pytest.approx([0.5 - out / 4, 0.5 + out / 4], abs=ws.resolution / 4)


def test_a_first_joint_with_limits_takes_its_share_of_a_sampled_volume():
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0.9, 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, 0.6, 0)]
    lower, upper = np.full(6, -pi), np.full(6, pi)
    lower[:3], upper[:3] = [-0.5, 0, 0.3], [0.5, 1, 1.5]
    arm = r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0, 0), ("R", 0.2, 0, 0, 0)], lower=lower, upper=upper)
    ws = workspace(arm, XYZ)
    rng = np.random.default_rng(0)
    reached = np.array([XYZ.value(arm, q) for q in rng.uniform(lower, upper, (3000, 6))])
    low, high = reached.min(axis=0), reached.max(axis=0)
    share = np.mean([ws.contains(p) for p in rng.uniform(low, high, (150, 3))])
    assert ws.volume == pytest.approx(share * np.prod(high - low), rel=0.3)
    assert np.mean([ws.contains(p) for p in reached[:100]]) > 0.99
    side = float(np.ptp(reached, axis=0).max()) / 48
    away = reached[np.argmax(reached[:, 0])] + np.array([0.5, 0, 0])
    nearest = np.linalg.norm(reached - away, axis=1).min()
    assert nearest - 2 * side < ws.distance(away) < nearest + side
    assert ws.distance(reached[0]) < np.linalg.norm(reached[0] - away)
    found = crossings(ws, [away, reached.mean(axis=0)])
    assert found.entering.tolist() == [True]


def test_a_spatial_arm_seen_in_two_coordinates_is_its_shadow():
    ws = workspace(r1.robot_from_dh([("R", 0, pi / 2, 0, 0), ("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)]), XY)
    assert ws.area == pytest.approx(pi * 1.5**2, rel=0.03)
    assert ws.coordinates == ("x", "y")
    assert atan2(*ws.regions[0].point) is not None
