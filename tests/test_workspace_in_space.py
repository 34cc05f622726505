"""Workspaces of arms with offsets and any twists: closed forms, brute force, inverse kinematics, laws."""

import pickle
from functools import cache
from math import hypot, pi

import numpy as np
import pinocchio as pin
import pytest
from closed_forms import volume_beside_the_axis
from hypothesis import assume, given, settings, strategies as st
from planar_chains import XYZ
from spatial_arms import drawn_arm
from sweeps import some_of

import robotics1 as r1
from robotics1.workspaces import workspace

SEEDS = st.integers(0, 4)
ORTHOGONAL = [("R", 1, -pi / 2, 0, 0), ("R", 2, pi / 2, 1, 0), ("R", 1.5, 0, 0, 0)]


def curved(seed, **kind):
    """The arm of a seed and its workspace, if its critical curves are no arcs."""
    arm, ws = drawn_workspace(seed, **kind)
    assume(ws is not None)
    return arm, ws


@cache
def drawn_workspace(seed, **kind):
    arm = drawn_arm(seed, **kind)
    try:
        ws = workspace(arm, XYZ)
    except r1.TaskError:
        return arm, None
    return arm, ws if any(curve.kind == "curve" for curve in ws.boundary) else None


# --- closed forms


@pytest.mark.parametrize(("l2", "l3", "d"), [(1.0, 1.0, 0.2), (0.9, 0.5, 0.3), (0.4, 0.8, 0.15)])
def test_a_shoulder_offset_moves_the_spherical_shell_away_from_the_axis(l2, l3, d):
    """u² + h² is between (l2 − l3)² and (l2 + l3)², with ρ² = u² + d²: ∫ 2πρ dρ dh = ∫ 2πu du dh."""
    ws = workspace(r1.robot_from_dh([("R", 0, pi / 2, 0, 0), ("R", l2, 0, d, 0), ("R", l3, 0, 0, 0)]), XYZ)
    inner, outer = abs(l2 - l3), l2 + l3
    assert ws.volume == pytest.approx(4 / 3 * pi * (outer**3 - inner**3), rel=1e-9)
    assert (ws.r_min, ws.r_max) == pytest.approx((d, hypot(outer, d)), abs=1e-12)
    assert [region.solutions for region in ws.regions] == [4]
    assert np.cos(ws.farthest[:, 2]) == pytest.approx(1)
    assert len(ws.farthest) == 2  # to both sides of the shoulder


def test_a_tool_that_turns_about_an_axis_beside_the_base_draws_a_torus():
    """The last joint turns the tip in a circle of radius r, and the slide moves it out of the circle's plane."""
    R, r, stroke = 1.0, 0.3, 1e-3
    rows = [("R", R, pi / 2, 0, 0), ("P", 0, 0, 0, 0), ("R", r, 0, 0, 0)]
    arm = r1.robot_from_dh(rows, lower=[-pi, 0, -pi], upper=[pi, stroke, pi])
    ws = workspace(arm, XYZ)
    # the annulus between ρ² = (R + r cos)² and ρ² = (R + r cos)² + stroke², h = r sin: 2 ∫ρ dρ dh = 2 · ½ stroke² ∫ dh
    assert ws.volume == pytest.approx(2 * pi * stroke**2 / 2 * 2 * r * 2, rel=1e-4)
    assert (ws.r_min, ws.r_max) == pytest.approx((R - r, hypot(R + r, stroke)), abs=1e-12)


def test_the_orthogonal_arm_of_the_books_has_four_cusps_and_regions_of_two_and_four_solutions():
    """Wenger, 2007: a1 = 1, a2 = 2, a3 = 1.5, d2 = 1, with twists −90° and 90°."""
    arm = r1.robot_from_dh(ORTHOGONAL)
    ws = workspace(arm, XYZ)
    assert [region.solutions for region in ws.regions] == [2, 4]
    assert len(ws.cusps) == 4
    assert r1.ik.is_cuspidal(arm, XYZ).status.name == "CUSPIDAL"
    for rho, h in ws.cusps:  # three solutions meet there
        found = r1.ik_solutions(arm, XYZ, [rho + 1e-7, 0, h])
        others = r1.ik_solutions(arm, XYZ, [rho, 0, h])
        assert len(found) in (2, 4)
        assert len(others) >= 1
    assert ws.contains([1.0, 2.0, 0.5])
    assert "4 cusps" in ws.explain()


@pytest.mark.parametrize("a1", [0.0, 0.5])
def test_a_wrist_that_does_not_move_its_centre_and_a_gripper_leave_the_workspace_as_it_is(a1):
    rows = [("R", a1, pi / 2, 0, 0), ("R", 0.9, 0, 0.2, 0), ("R", 0, pi / 2, 0, 0)]
    wrist = [("R", 0, -pi / 2, 0.7, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0, 0)]
    whole = workspace(r1.robot_from_dh(rows + wrist), XYZ)
    tool = r1.forward_kinematics(r1.robot_from_dh(rows + wrist[:1]), np.zeros(4)).translation
    assert r1.robot_from_dh(rows + wrist).nq == 6
    assert tool.shape == (3,)
    elbow = [rows[0], rows[1], ("R", 0.7, 0, 0, 0)]
    assert whole.volume == pytest.approx(workspace(r1.robot_from_dh(elbow), XYZ).volume, rel=1e-8)


def test_branches_that_cross_at_a_small_angle_are_told_apart():
    """Two branches of D = 0 that leave a crossing three degrees apart, nearer to each other than the grid is fine."""
    ws = drawn_workspace(1061, kinds="RRR")[1]
    section = ws.section
    q = np.random.default_rng(1061).uniform(section.arm.domain.lower, section.arm.domain.upper, (10_000, 2))
    assert (section.counts(section.arm.mapped.image(q)) > 0).all()
    assert [region.solutions for region in ws.regions] == [4]


@pytest.mark.parametrize("seed", [161, 185])
def test_branches_that_cross_at_a_limit_of_a_joint_are_told_apart(seed):
    """∇D = 0 at q2 = −π/2, the lower limit, or π/2, the upper one: only half of each branch is inside."""
    section = drawn_workspace(seed, wide=True)[1].section
    q = np.random.default_rng(seed).uniform(section.arm.domain.lower, section.arm.domain.upper, (20_000, 2))
    assert (section.counts(section.arm.mapped.image(q)) > 0).all()


# --- brute force


@given(SEEDS)
def test_no_configuration_is_outside(seed):
    arm, ws = curved(seed)
    rng = np.random.default_rng(seed)
    for q in rng.uniform(arm.lower, arm.upper, (30, 3)):
        assert ws.contains(XYZ.value(arm, q))
    corners = np.where(rng.random((4, 3)) < 0.5, arm.lower, arm.upper)
    assert all(ws.contains(XYZ.value(arm, q)) for q in corners)


@given(SEEDS)
def test_solutions_in_a_region_are_those_of_inverse_kinematics(seed):
    arm, ws = curved(seed, wide=True)
    for region in (*ws.regions, *ws.voids):
        p = _in_world(arm, ws, region.point)
        if ws.section.distance_in_section(region.point / ws.section.arm.size) > 1e-6:
            assert len(r1.ik_solutions(arm, XYZ, p)) == region.solutions


def _in_world(arm, ws, place):
    """A point of the world that is at a place of the section; of a slide at the height of a solution, or at 0."""
    section = ws.section
    if section.arm.mapped.about_axis:
        local = np.array([place[0], 0, place[1]])
    else:
        found = section.solutions(place / section.arm.size)
        local = np.array([*place, section.arm.mapped.point(found)[0, 2] * section.arm.size if len(found) else 0.0])
    return section.place.frame.T @ local + section.place.origin


@given(SEEDS)
def test_volumes_times_solutions_are_the_integral_of_det_j(seed):
    """∫ N dV = ∫ |det J| dq, by the midpoint rule; det J does not depend on a first joint that turns."""
    arm, ws = curved(seed, kinds="R" + "RP"[seed % 2] + "RP"[seed // 2 % 2], wide=True)
    n = 60
    axes = [
        low + (np.arange(n) + 0.5) / n * (high - low) for low, high in zip(arm.lower[1:], arm.upper[1:], strict=True)
    ]
    values = [abs(np.linalg.det(XYZ.jacobian(arm, [0.0, x, y]))) for x in axes[0] for y in axes[1]]
    whole = np.mean(values) * np.prod(arm.upper - arm.lower)
    assert sum(r.solutions * r.volume for r in ws.regions) == pytest.approx(whole, rel=0.01)


@given(SEEDS)
def test_a_first_joint_with_limits_reaches_what_inverse_kinematics_reaches(seed):
    arm, ws = curved(seed)
    rng = np.random.default_rng(seed)
    q = rng.uniform(arm.lower, arm.upper, (200, 3))
    reached = np.array([XYZ.value(arm, one) for one in q])
    for p in rng.uniform(reached.min(axis=0), reached.max(axis=0), (3, 3)):
        assert ws.contains(p) == (len(r1.ik_solutions(arm, XYZ, p)) > 0)


@given(SEEDS)
def test_a_volume_with_limits_is_that_of_points_in_a_box(seed):
    arm, ws = curved(seed)
    rng = np.random.default_rng(seed)
    reached = np.array([XYZ.value(arm, q) for q in rng.uniform(arm.lower, arm.upper, (2000, 3))])
    low, high = reached.min(axis=0), reached.max(axis=0)
    room = 0.03 * (high - low)
    points = rng.uniform(low - room, high + room, (100, 3))
    share = np.mean([ws.contains(p) for p in points])
    box = np.prod(high - low + 2 * room)
    assert ws.volume / box == pytest.approx(share, abs=0.2)  # four standard deviations
    assert ws.volume_error < 0.005 * ws.volume


@pytest.mark.parametrize("turn", [0.3, 1.0, 2.5])
def test_a_plane_beside_the_axis_has_the_volume_of_two_ranges_that_overlap(turn):
    """V = ∫∫ u (S + min(S, 2 atan(u/d))) du dh over the half annulus |l2 − l3| < r < l2 + l3, with the offset d."""
    rows = [("R", 0, pi / 2, 0.4, 0), ("R", 0.9, 0, 0.3, 0), ("R", 0.5, 0, 0, 0)]
    lower, upper = np.array([[-0.2, -pi, -pi], [turn - 0.2, pi, pi]])
    ws = workspace(r1.robot_from_dh(rows, lower=lower, upper=upper), XYZ)
    assert ws.volume == pytest.approx(volume_beside_the_axis(0.4, 1.4, 0.3, turn), rel=2e-6)
    assert ws.volume_error < 1e-4 * ws.volume


@pytest.mark.parametrize(("kinds", "seed"), [("RRP", 2), ("PRR", 6), ("RRR", 6)])
def test_a_range_that_grows_to_a_turn_sweeps_what_is_reached_and_never_more_than_each_solution_alone(kinds, seed):
    """V(s) is concave, V(s)/s falls, and it is at most ∫ |det J| dq: what all solutions sweep one by one."""
    arm = drawn_arm(seed, kinds)
    low, high = arm.lower[0], arm.upper[0]
    shares = (0.25, 0.5, 1.0)
    found = [workspace(arm, XYZ, box={"q1": (low, low + share * (high - low))}) for share in shares]
    V = np.array([ws.volume for ws in found])
    room = 3 * sum(ws.volume_error for ws in found) + 1e-9
    assert (np.diff(V) > 0).all()
    assert (np.diff(V / shares) < room / min(shares)).all()
    assert (V[2] - V[1]) / 0.5 < (V[1] - V[0]) / 0.25 + room / 0.25
    share = (np.arange(60) + 0.5)[:, None] / 60
    x, y = (arm.lower + share * (arm.upper - arm.lower))[:, 1:].T
    alone = np.mean([abs(np.linalg.det(XYZ.jacobian(arm, [low, a, b]))) for a in x for b in y])
    assert V[0] < 1.02 * alone * np.prod(arm.upper - arm.lower) * shares[0]


# --- the boundary


@given(SEEDS)
def test_the_boundary_is_attained_and_singular_or_at_a_limit(seed):
    arm, ws = curved(seed)
    names = list(arm.joint_names)
    for curve in ws.boundary:
        for q, place in ((curve.q_start, curve.start), (curve.q_end, curve.end)):
            p = XYZ.value(arm, q)
            assert ws.section.place.coordinates(p) == pytest.approx(place, abs=1e-7)
        if curve.singular:
            J = XYZ.jacobian(arm, curve.q_start)
            assert np.linalg.svd(J)[1][2] < 1e-6 * np.linalg.svd(J)[1][0]
        for name, limit in curve.limits.items():
            assert curve.q_start[names.index(name)] == pytest.approx(getattr(arm, limit)[names.index(name)], abs=1e-9)


@given(SEEDS)
def test_the_boundary_has_the_workspace_on_one_side(seed):
    _, ws = curved(seed, wide=True)
    for curve in ws.boundary:
        k = len(curve.points) // 2
        middle, along = curve.points[k], curve.points[k + 1] - curve.points[k - 1]
        if np.linalg.norm(curve.points[0] - curve.points[-1]) < 0.05 or np.linalg.norm(along) < 1e-4:
            continue
        across = 1e-4 * ws.section.arm.size * np.array([-along[1], along[0]]) / np.linalg.norm(along)
        sides = ws.section.counts(np.array([middle + across, middle - across]) / ws.section.arm.size) > 0
        assert sides[0] != sides[1]
        assert ws.section.distance_in_section(middle / ws.section.arm.size) < 1e-9


@given(SEEDS)
def test_smallest_and_largest_reach_are_attained_and_nothing_is_beyond(seed):
    arm, ws = curved(seed)
    section = ws.section

    def radius(q):
        return np.linalg.norm(section.place.local(XYZ.value(arm, q))[:2])

    for value, found in ((ws.r_min, ws.nearest), (ws.r_max, ws.farthest)):
        assert len(found)
        for q in found:
            assert radius(q) == pytest.approx(value, abs=1e-7)
            assert arm.within_limits(q, tolerance=1e-8)
    for q in np.random.default_rng(seed).uniform(arm.lower, arm.upper, (200, 3)):
        assert ws.r_min - 1e-9 <= radius(q) <= ws.r_max + 1e-9


@given(SEEDS)
def test_distance_is_that_of_the_nearest_point_of_the_boundary(seed):
    arm, ws = curved(seed, kinds="RRR", wide=True)
    fine = np.vstack([curve.points for curve in ws.boundary])
    for q in np.random.default_rng(seed).uniform(arm.lower, arm.upper, (6, 3)):
        p = XYZ.value(arm, q)
        nearest = np.linalg.norm(fine - ws.section.place.coordinates(p), axis=1).min()
        assert ws.distance(p) <= nearest + 1e-9
        assert ws.distance(p) == pytest.approx(nearest, abs=0.03 * ws.section.arm.size)


# --- laws


@settings(max_examples=3)
@given(st.integers(0, 500), st.floats(0.01, 50))
def test_volumes_grow_with_the_cube_of_lengths(seed, scale):
    rng = np.random.default_rng(seed)
    shape = [(*rng.uniform(0.1, 1, 2), rng.uniform(-2, 2)) for _ in range(3)]
    one, other = (
        workspace(r1.robot_from_dh([("R", s * a, twist, s * d, 0) for a, d, twist in shape]), XYZ) for s in (1.0, scale)
    )
    assert other.volume == pytest.approx(scale**3 * one.volume, rel=1e-8)
    assert sorted(r.solutions for r in other.regions) == sorted(r.solutions for r in one.regions)
    assert len(other.cusps) == len(one.cusps)


@settings(max_examples=2)
@given(SEEDS)
def test_a_moved_base_moves_the_workspace_in_space(seed):
    """The rows of a table with a fixed motion before them."""
    rng = np.random.default_rng(seed)
    rows = [("R", *rng.uniform(0.2, 1, 1), 1.2, 0.3, 0), ("R", 0.8, -0.7, 0.2, 0), ("R", 0.5, 0, 0, 0)]
    limits = {"lower": [-1, -2, 0.2], "upper": [1.5, 1, 2]} if seed % 2 else {}
    T = pin.SE3(pin.rpy.rpyToMatrix(*rng.uniform(-1, 1, 3)), rng.uniform(-2, 2, 3))
    one, other = (r1.robot_from_dh(rows, **limits, **base) for base in ({}, {"base_placement": T}))
    here, there = workspace(one, XYZ), workspace(other, XYZ)
    assert there.volume == pytest.approx(here.volume, rel=1e-8, abs=2 * here.volume_error)
    assert there.area == pytest.approx(here.area, rel=1e-8)
    for p in rng.uniform(-1.5, 1.5, (12, 3)):
        assert there.contains(T * p) == here.contains(p)


def test_a_result_survives_pickling_and_cannot_be_changed():
    ws = workspace(r1.robot_from_dh(ORTHOGONAL), XYZ)
    again = pickle.loads(pickle.dumps(ws))
    assert again.contains([1.0, 2.0, 0.5])
    assert again.distance([1.0, 2.0, 0.5]) == ws.distance([1.0, 2.0, 0.5])
    with pytest.raises(ValueError, match="read-only"):
        ws.cusps[0] = 1


def test_an_arm_that_moves_the_point_on_a_surface_is_told():
    with pytest.raises(r1.TaskError, match="surface or a curve"):
        workspace(r1.robot_from_dh([("R", 0, pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 1, 0, 0, 0)]), XYZ)


@pytest.mark.parametrize("seed", some_of(range(100, 200), 10))
def test_solutions_in_regions_of_a_hundred_arms_are_those_of_inverse_kinematics(seed):
    arm, ws = drawn_workspace(seed, wide=True)
    if ws is None:
        pytest.skip("made of arcs, or a surface")
    section = ws.section
    for region in (*ws.regions, *ws.voids):
        if section.distance_in_section(region.point / section.arm.size) > 1e-6:
            assert len(r1.ik_solutions(arm, XYZ, _in_world(arm, ws, region.point))) == region.solutions
    q = np.random.default_rng(seed).uniform(section.arm.domain.lower, section.arm.domain.upper, (10_000, 2))
    places = section.arm.mapped.image(q)
    outside = places[section.counts(places) == 0]
    assert all(section.distance_in_section(z) < 1e-8 for z in outside)


@pytest.mark.parametrize("seed", some_of([2000, 2001, *range(2003, 2011)], 2))  # the arm 2002 moves in a plane
def test_none_of_a_million_configurations_of_a_3r_is_outside(seed):
    section = drawn_workspace(seed, kinds="RRR", wide=True)[1].section
    rng = np.random.default_rng(seed)
    for _ in range(20):
        z = section.arm.mapped.image(rng.uniform(section.arm.domain.lower, section.arm.domain.upper, (50_000, 2)))
        assert all(section.distance_in_section(p) < 1e-8 for p in z[section.counts(z) == 0])


def test_branches_that_nearly_meet_make_no_cusps():
    """A Puma's elbow and shoulder lines cross at an angle of 1e-3: det J is a product, so that it is not cuspidal."""
    last = [("R", 0.4318, 0, 0, 0), ("R", 0.0203, -pi / 2, 0.15005, 0), ("R", 0, pi / 2, 0.4318, 0)]
    rows = [("R", 0, pi / 2, 0, 0), *last]
    assert len(r1.workspaces.workspace(r1.robot_from_dh(rows), "position").cusps) == 0


@pytest.mark.parametrize("end", [-1.0, 1.3])
def test_configurations_at_the_end_of_the_first_joints_range_are_inside_it(end):
    """Rounding puts the angle of the point beyond the limit as often as before it: never a whole turn away."""
    rows = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0)]
    arm = r1.robot_from_dh(rows, lower=[-1.0, 0.1, 0.2], upper=[1.3, 1.2, 1.5])
    ws = workspace(arm, XYZ)
    for q2, q3 in np.random.default_rng(0).uniform([0.1, 0.2], [1.2, 1.5], (20, 2)):
        p = XYZ.value(arm, [end, q2, q3])
        found = ws.configurations(p)
        assert len(found)
        assert (np.abs(found[:, 0] - end) < 1e-9).all()
        assert np.array([XYZ.value(arm, q) for q in found]) == pytest.approx(np.tile(p, (len(found), 1)), abs=1e-9)
