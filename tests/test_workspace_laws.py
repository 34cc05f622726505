"""Workspaces of arms drawn at random: laws, brute force, the boundary itself; and what is refused."""

import pickle
from itertools import pairwise
from math import inf, nan, pi

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st
from planar_chains import MOUNT, XY, XYZ, chain, drawn_chain
from scipy.integrate import quad
from scipy.optimize import brentq

import robotics1 as r1
from robotics1.workspaces import workspace

SEEDS = st.integers(0, 10_000)
JOINTS = st.sampled_from([2, 2, 3])


def samples(arm, count, seed=0):
    return np.random.default_rng(seed).uniform(arm.lower, arm.upper, (count, arm.nq))


def points_around(ws, count, seed=0):
    """Points in a square around the workspace."""
    ends = np.array([p for region in ws.regions for line in region.outline for p in line])
    low, high = ends.min(axis=0), ends.max(axis=0)
    room = 0.05 * (high - low)
    return np.random.default_rng(seed).uniform(low - room, high + room, (count, 2))


# --- laws


@pytest.mark.parametrize(("seed", "joints"), [(7016, 3), (7028, 4)])
def test_a_boundary_with_a_tiny_arc_or_another_curve_beside_it_is_closed(seed, joints):
    """Of one an arc is 5e-5 long, of the other two edges are 1e-7 apart: their sides must be looked at from near."""
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    q = samples(arm, 400)
    assert all(ws.contains(XY.value(arm, x)) for x in q)
    places = points_around(ws, 2000)
    low, high = places.min(axis=0), places.max(axis=0)
    share = np.mean([ws.contains(p) for p in places])
    assert ws.area == pytest.approx(share * np.prod(high - low), rel=0.15)


@given(SEEDS)
def test_areas_times_solutions_are_the_integral_of_det_j(seed):
    """∫ N(p) dp = ∫ |det J| dq: no area is lost or counted twice. det J does not depend on the first joint."""
    _, arm = drawn_chain(seed, 2)
    ws = workspace(arm, XY)
    (a, c), (b, d) = arm.lower, arm.upper

    def det(q2):
        return np.linalg.det(XY.jacobian(arm, [a, q2]))

    grid = np.linspace(c, d, 40)
    zeros = [brentq(det, s, e, xtol=1e-14) for s, e in pairwise(grid) if det(s) * det(e) < 0]
    ends = [c, *zeros, d]
    whole = sum(abs(quad(det, s, e, epsabs=1e-13)[0]) for s, e in pairwise(ends))
    found = sum(region.solutions * region.area for region in ws.regions)
    assert found == pytest.approx((b - a) * whole, rel=1e-9, abs=1e-10)


@given(SEEDS, JOINTS, st.floats(0.01, 50))
def test_areas_grow_with_the_square_of_lengths(seed, joints, scale):
    one, other = (workspace(drawn_chain(seed, joints, s)[1], XY) for s in (1.0, scale))
    assert other.area == pytest.approx(scale**2 * one.area, rel=1e-9)
    assert (other.r_min, other.r_max) == pytest.approx((scale * one.r_min, scale * one.r_max), rel=1e-9, abs=1e-9)
    assert sorted(r.solutions for r in other.regions) == sorted(r.solutions for r in one.regions)


@given(st.floats(-pi, pi), st.floats(-9, 9), st.floats(-9, 9))
def test_a_moved_base_moves_the_workspace(angle, x, y):
    rows = [("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
    limits = {"lower": [-1, -0.5], "upper": [0.7, 2]}
    T = pin.SE3(pin.rpy.rpyToMatrix(0, 0, angle), np.array([x, y, 0.0]))
    here = workspace(r1.robot_from_dh(rows, **limits), XY)
    there = workspace(r1.robot_from_dh(rows, **limits, base_placement=T), XY)
    assert there.area == pytest.approx(here.area, rel=1e-10)
    for p in points_around(here, 20):
        moved = (T * np.array([*p, 0]))[:2]
        assert there.contains(moved) == here.contains(p)
        assert there.distance(moved) == pytest.approx(here.distance(p), abs=1e-9)


def test_a_plane_that_is_seen_from_behind_has_the_same_workspace():
    arm = drawn_chain(3, 2)[1]
    one, other = workspace(arm, XY), workspace(arm, r1.PositionTask("yx"))
    assert other.area == pytest.approx(one.area, rel=1e-12)
    p = one.regions[0].point
    assert other.contains(p[::-1])


def test_an_arm_in_the_plane_xz_has_the_workspace_of_the_same_arm_in_xy():
    rows, limits = [("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)], {"lower": [-1, -0.5], "upper": [0.7, 2]}
    upright = pin.SE3(pin.rpy.rpyToMatrix(pi / 2, 0, 0), np.zeros(3))
    one = workspace(r1.robot_from_dh(rows, **limits), XY)
    other = workspace(r1.robot_from_dh(rows, **limits, base_placement=upright), r1.PositionTask("xz"))
    assert other.area == pytest.approx(one.area, rel=1e-12)
    with pytest.raises(r1.TaskError, match="surface or a curve"):
        workspace(r1.robot_from_dh(rows, **limits, base_placement=upright), XY)


# --- brute force


@given(SEEDS, JOINTS)
def test_no_configuration_is_outside(seed, joints):
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    for q in samples(arm, 100):
        p = XY.value(arm, q)
        assert ws.contains(p)
        distance = np.linalg.norm(p - (MOUNT if arm.revolute[0] else (0, 0)))
        assert ws.r_min - 1e-9 <= distance <= ws.r_max + 1e-9
    corners = np.where(np.random.default_rng(1).random((20, joints)) < 0.5, arm.lower, arm.upper)
    assert all(ws.contains(XY.value(arm, q)) for q in corners)


@pytest.mark.sweep
@pytest.mark.parametrize("joints", [2, 3])
def test_no_configuration_of_a_hundred_arms_is_outside(joints):
    for seed in range(50):
        _, arm = drawn_chain(seed, joints)
        ws = workspace(arm, XY)
        assert all(ws.contains(XY.value(arm, q)) for q in samples(arm, 1000, seed))


@given(SEEDS)
def test_solutions_in_a_region_are_those_of_inverse_kinematics(seed):
    _, arm = drawn_chain(seed, 2)
    ws = workspace(arm, XY)
    for region in (*ws.regions, *ws.voids):
        found = r1.ik_solutions(arm, XY, region.point)
        assert (len(found), found.complete) == (region.solutions, True)
    for p in points_around(ws, 2):
        if ws.distance(p) > 1e-6:
            assert ws.contains(p) == (len(r1.ik_solutions(arm, XY, p)) > 0)


@given(SEEDS)
def test_a_redundant_arm_reaches_its_regions_and_not_its_voids(seed):
    _, arm = drawn_chain(seed, 3)
    ws = workspace(arm, XY)
    for region in ws.regions:
        q = r1.solve_ik(arm, XY, region.point).require().q
        assert arm.within_limits(q)
    reached = np.array([XY.value(arm, q) for q in samples(arm, 400)])
    for p in points_around(ws, 30):
        if not ws.contains(p):
            assert np.linalg.norm(reached - p, axis=1).min() > ws.distance(p) - 1e-9


@given(SEEDS, JOINTS)
def test_areas_are_those_of_points_in_a_square(seed, joints):
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    points = points_around(ws, 400, seed=2)
    square = np.prod(points.max(axis=0) - points.min(axis=0)) * (401 / 399) ** 2
    share = np.mean([ws.contains(p) for p in points])
    assert ws.area / square == pytest.approx(share, abs=0.15)


# --- the boundary


@given(SEEDS, JOINTS)
def test_the_boundary_is_attained_by_its_configurations_and_has_the_workspace_on_one_side(seed, joints):
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    for curve in ws.boundary:
        moving = arm.joint_names.index(curve.joint)
        for share in (0.0, 0.3, 0.5, 1.0):
            q = curve.q_start + share * (curve.q_end - curve.q_start)
            assert arm.within_limits(q, tolerance=1e-8)
            p = XY.value(arm, q)
            assert p == pytest.approx(_on(curve, share), abs=1e-9)
        assert np.delete(curve.q_start - curve.q_end, moving) == pytest.approx(0)
        for name, limit in curve.limits.items():
            i = arm.joint_names.index(name)
            assert curve.q_start[i] == pytest.approx(getattr(arm, limit)[i], abs=1e-9)
        if curve.singular:
            free = [arm.joint_names.index(name) for name in curve.singular]
            sigma = np.linalg.svd(XY.jacobian(arm, (curve.q_start + curve.q_end) / 2)[:, free])[1]
            assert sigma[1] < 1e-7
        _has_one_side(ws, curve)


def _on(curve, share):
    """The point of a boundary curve in which its joint has made a share of its way."""
    if curve.center is None:
        return curve.start + share * (curve.end - curve.start)
    a, b = curve.start - curve.center, share * curve.angle
    return curve.center + np.array([np.cos(b) * a[0] - np.sin(b) * a[1], np.sin(b) * a[0] + np.cos(b) * a[1]])


def _has_one_side(ws, curve):
    middle, before = _on(curve, 0.5), _on(curve, 0.4999)
    along = (middle - before) / np.linalg.norm(middle - before)
    across = 1e-5 * np.array([-along[1], along[0]])
    if np.linalg.norm(curve.end - curve.start) > 0.05:
        assert ws.contains(middle + across) != ws.contains(middle - across)
        assert ws.distance(middle) == pytest.approx(0, abs=1e-9)


@given(SEEDS, JOINTS)
def test_distance_is_that_of_the_nearest_point_of_the_boundary(seed, joints):
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    fine = np.array([_on(curve, share) for curve in ws.boundary for share in np.linspace(0, 1, 300)])
    for p in points_around(ws, 10):
        nearest = np.linalg.norm(fine - p, axis=1).min()
        assert ws.distance(p) <= nearest + 1e-9
        assert ws.distance(p) == pytest.approx(nearest, abs=0.02)


@given(SEEDS, JOINTS)
def test_smallest_and_largest_reach_are_attained(seed, joints):
    _, arm = drawn_chain(seed, joints)
    ws = workspace(arm, XY)
    centre = MOUNT if arm.revolute[0] else (0, 0)
    for radius, found in ((ws.r_min, ws.nearest), (ws.r_max, ws.farthest)):
        assert len(found)
        for q in found:
            assert np.linalg.norm(XY.value(arm, q) - centre) == pytest.approx(radius, abs=1e-9)
            assert arm.within_limits(q, tolerance=1e-8)


# --- results and refusals


def test_a_result_says_what_it_is():
    ws = workspace(chain("RR", [0.4, 0.3], [-2.0, -1.0], [2.0, 1.0]), XY)
    assert repr(ws).startswith("Workspace('chain', area=")
    assert len(repr(ws)) < 100
    assert "q2 is at its lower limit" in ws.explain()
    again = pickle.loads(pickle.dumps(ws))
    assert again.contains(ws.regions[0].point)
    assert ws.cusps.shape == (0, 2)
    with pytest.raises(ValueError, match="read-only"):
        ws.regions[0].point[0] = 1


def test_a_box_narrows_the_limits_and_is_needed_where_a_slide_has_none():
    arm = r1.robot_from_dh([("R", 0, -pi / 2, 0, 0), ("P", 0, 0, 0, 0)])
    with pytest.raises(r1.InputError, match=r"joint 'q2' has no limits: .* box=\{'q2'"):
        workspace(arm, XY)
    ws = workspace(arm, XY, box={"q2": (0.5, 1.0), "q1": (0, 1)})
    assert ws.area == pytest.approx((1 - 0.25) / 2)
    with pytest.raises(r1.UnknownNameError, match="q9"):
        workspace(arm, XY, box={"q9": (0, 1)})
    for wrong in ((0, nan), (0, inf), (1, 0), (0,), "ab"):
        with pytest.raises(r1.InputError, match="q2"):
            workspace(arm, XY, box={"q2": wrong})


def test_a_joint_without_room_stands_still_where_it_is():
    arm = chain("RRR", [0.4, 0.3, 0.2], [-1.0, 0.5, -2.0], [1.0, 0.5, -0.1])
    ws = workspace(arm, XY)
    assert not ws.redundant
    assert [curve.q_start[1] for curve in ws.boundary] == pytest.approx([0.5] * len(ws.boundary))
    for curve in ws.boundary:
        assert XY.value(arm, curve.q_start) == pytest.approx(curve.start)


def test_joints_beside_the_arm_and_at_the_tip_do_not_matter():
    ws = workspace(chain("RRR", [0.4, 0.3, 0.0], [-1.0, 0.5, -2.0], [1.0, 1.5, 2.0]), XY)
    other = workspace(chain("RR", [0.4, 0.3], [-1.0, 0.5], [1.0, 1.5]), XY)
    assert ws.area == pytest.approx(other.area, rel=1e-12)


@pytest.mark.parametrize(
    ("task", "words"),
    [
        (r1.PlanarPoseTask(), "PositionTask"),
        (r1.PositionTask("x"), "PositionTask"),
        (r1.PositionTask("xy", reference="tool"), "world axes"),
        (r1.FunctionTask(lambda p, R, q: [p[0], p[1]], 2), "PositionTask"),
        (r1.OrientationTask(), "PositionTask"),
        (XYZ, "2 joints"),
    ],
)
def test_tasks_of_another_kind_are_refused(task, words):
    with pytest.raises(r1.TaskError, match=words):
        workspace(chain("RR", [0.4, 0.3], [-1.0, 0.5], [1.0, 1.5]), task)


def test_arms_of_another_kind_are_refused():
    with pytest.raises(r1.TaskError, match="two joints"):
        workspace(chain("R", [0.4], [-1.0], [1.0]), XY)
    with pytest.raises(r1.TaskError, match="move the tip alike"):
        workspace(chain("RRR", [0.0, 0.3, 0.2], [-1.0] * 3, [1.0] * 3), XY)
    flat = [("R", 0, pi / 2, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1.0, 0, 0, 0)]
    with pytest.raises(r1.TaskError, match="no room to move"):
        workspace(r1.robot_from_dh(flat, lower=[0, -1, -1], upper=[0, 1, 1]), XYZ)


def test_points_of_another_form_are_refused():
    ws = workspace(chain("RR", [0.4, 0.3], [-1.0, 0.5], [1.0, 1.5]), XY)
    for ask in (ws.contains, ws.distance):
        for wrong in ([nan, 0], [inf, 0], [1, 2, 3], "ab", None):
            with pytest.raises(r1.InputError):
                ask(wrong)


@pytest.mark.parametrize("lengths", [(1, 1e-7), (1e-7, 1), (1, 1e-12), (0, 0)])
def test_an_annulus_too_thin_to_be_told_from_a_circle_is_refused(lengths):
    with pytest.raises(r1.TaskError, match=r"too thin|needs two joints|move the tip alike|no joint moves"):
        workspace(r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths]), XY)


def test_a_planar_arm_asked_in_space_is_told_to_ask_in_its_plane():
    with pytest.raises(r1.TaskError, match="ask two, as PositionTask"):
        workspace(chain("RR", [0.4, 0.3], None, None), XYZ)
