"""Workspaces with closed forms: areas, volumes, radii, and the reasons of their boundaries."""

from itertools import pairwise
from math import acos, atan2, hypot, pi, radians, sqrt

import numpy as np
import pytest
from closed_forms import (
    annulus_area,
    anthropomorphic_position,
    gauss_between,
    planar_3r_inner_radius,
    spherical_shell_volume,
    two_link_area_both_elbows,
    two_link_area_of_elbow,
    two_link_distance,
    two_link_solutions,
)
from hypothesis import given, strategies as st
from planar_chains import MOUNT, XY, XYZ, chain
from scipy.integrate import quad

import robotics1 as r1
from robotics1.workspaces import workspace

EXACT = 1e-11
SCARA = [("R", 0.4, 0, 0, 0), ("R", 0.3, pi, 0, 0), ("P", 0, 0, 0, 0)]
ELBOW = [("R", 0, pi / 2, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1.0, 0, 0, 0)]


def two_links(l1, l2, lower=None, upper=None):
    return r1.robot_from_dh([("R", l1, 0, 0, 0), ("R", l2, 0, 0, 0)], lower=lower, upper=upper)


def times_solutions(ws):
    """∫ N(p) dp, with N the number of solutions."""
    return sum(region.solutions * region.area for region in ws.regions)


# --- two joints in the plane


@pytest.mark.parametrize(("l1", "l2"), [(0.4, 0.3), (0.3, 0.4), (1.0, 0.25)])
def test_2r_without_limits_is_an_annulus_with_two_solutions(l1, l2):
    ws = workspace(two_links(l1, l2), XY)
    inner, outer = abs(l1 - l2), l1 + l2
    assert ws.area == pytest.approx(annulus_area(inner, outer), rel=EXACT)
    assert (ws.r_min, ws.r_max) == pytest.approx((inner, outer), rel=EXACT)
    assert [region.solutions for region in ws.regions] == [2]
    assert [void.area for void in ws.voids] == [pytest.approx(pi * inner**2, rel=EXACT)]
    assert sorted(curve.radius for curve in ws.boundary) == pytest.approx([inner, outer])
    assert {curve.reason for curve in ws.boundary} == {"q1 and q2 are singular together"}
    assert np.cos([ws.farthest[0, 1], ws.nearest[0, 1]]) == pytest.approx([1, -1])


def test_2r_of_equal_links_is_a_disc_whose_centre_is_reached_by_all_folded_configurations():
    ws = workspace(two_links(0.5, 0.5), XY)
    assert ws.area == pytest.approx(pi, rel=EXACT)
    assert (ws.voids, ws.r_min) == ((), 0)
    assert np.abs(ws.nearest[:, 1]) == pytest.approx(pi)


@pytest.mark.parametrize(
    ("l1", "l2", "first", "second"),
    [(0.4, 0.3, 130, 145), (0.4, 0.3, 20, 145), (0.3, 0.5, 60, 100), (0.3, 0.5, 170, 160), (0.5, 0.5, 90, 60)],
)
def test_2r_with_symmetric_limits_has_the_area_of_the_radial_integral(l1, l2, first, second):
    a, b = radians(first), radians(second)
    ws = workspace(two_links(l1, l2, [-a, -b], [a, b]), XY)
    assert ws.area == pytest.approx(two_link_area_both_elbows(l1, l2, a, b), abs=1e-9)
    assert (ws.r_min, ws.r_max) == pytest.approx((two_link_distance(l1, l2, b), l1 + l2), rel=EXACT)
    assert times_solutions(ws) == pytest.approx(2 * two_link_area_of_elbow(l1, l2, 2 * a, (0, b)), rel=EXACT)


def test_2r_with_one_elbow_has_the_area_of_the_integral_of_det_j():
    ws = workspace(two_links(0.7, 0.4, [-1.0, 0.2], [0.8, 2.5]), XY)
    assert ws.area == pytest.approx(two_link_area_of_elbow(0.7, 0.4, 1.8, (0.2, 2.5)), rel=EXACT)
    assert [region.solutions for region in ws.regions] == [1]
    assert {tuple(curve.limits.items()) for curve in ws.boundary} == {
        (("q1", "lower"),), (("q1", "upper"),), (("q2", "lower"),), (("q2", "upper"),),
    }  # fmt: skip
    assert all(curve.singular == () for curve in ws.boundary)


def test_rp_with_an_offset_reaches_from_the_offset_which_alone_is_singular():
    arm = r1.robot_from_dh([("R", 0.5, -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], lower=[-pi / 2, -0.8], upper=[pi / 2, 0.8])
    ws = workspace(arm, XY)
    assert (ws.r_min, ws.r_max) == pytest.approx((0.5, hypot(0.5, 0.8)), rel=EXACT)
    assert times_solutions(ws) == pytest.approx(pi * 0.8**2, rel=EXACT)  # ∫ |q2| dq1 dq2
    assert all(curve.radius == pytest.approx(0.5) for curve in ws.boundary if curve.singular)
    assert any(curve.singular for curve in ws.boundary)
    assert np.abs(ws.farthest[:, 1]) == pytest.approx([0.8, 0.8])


def test_rp_without_an_offset_is_a_sector_of_an_annulus():
    arm = chain("RP", [0.0, 0.0], [-1.0, 0.2], [2.0, 0.9])
    ws = workspace(arm, XY)
    assert ws.area == pytest.approx(annulus_area(0.2, 0.9, 3.0), rel=EXACT)
    assert {(curve.joint, tuple(curve.limits)) for curve in ws.boundary} == {("q2", ("q1",)), ("q1", ("q2",))}


def test_pr_is_a_disc_along_a_slide():
    ws = workspace(chain("PR", [0.1, 0.3], [0, -pi], [1.1, pi]), XY)
    assert ws.area == pytest.approx(2 * 0.3 * 1.1 + pi * 0.3**2, rel=EXACT)
    assert times_solutions(ws) == pytest.approx(4 * 0.3 * 1.1, rel=EXACT)  # ∫ |l cos q2| dq1 dq2
    assert sorted(region.solutions for region in ws.regions) == [1, 1, 2]


def test_pr_with_a_short_slide_has_two_discs_and_a_void_between_them():
    r, s = 0.5, 0.2
    ws = workspace(chain("PR", [0.1, r], [0, -pi], [s, pi]), XY)
    lens = 2 * r**2 * acos(s / (2 * r)) - s / 2 * (4 * r**2 - s**2) ** 0.5
    assert ws.area == pytest.approx(2 * r * s + pi * r**2 - lens, rel=EXACT)
    assert [void.area for void in ws.voids] == [pytest.approx(lens, rel=EXACT)]


def test_pp_is_a_parallelogram():
    arm = chain("PP", [0.2, 0.3], [-0.4, 0.1], [0.6, 0.8], turns=[0.3, 1.1])
    ws = workspace(arm, XY)
    assert ws.area == pytest.approx(1.0 * 0.7 * np.sin(1.1), rel=EXACT)
    assert len(ws.boundary) == 4
    assert all(curve.center is None for curve in ws.boundary)


# --- three joints in the plane


@pytest.mark.parametrize("lengths", [(1, 0.5, 0.25), (0.25, 0.5, 1), (0.5, 1, 0.25), (0.5, 0.4, 0.3)])
def test_3r_without_limits_has_the_radii_of_the_links_in_line(lengths):
    ws = workspace(r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths]), XY)
    inner, outer = planar_3r_inner_radius(*lengths), sum(lengths)
    assert ws.area == pytest.approx(annulus_area(inner, outer), rel=EXACT)
    assert (ws.r_min, ws.r_max) == pytest.approx((inner, outer), abs=1e-12)
    assert ws.redundant


def test_prr_is_an_annulus_along_a_slide():
    l2, l3, s = 0.5, 0.2, 0.4
    ws = workspace(chain("PRR", [0.0, l2, l3], [-s / 2, -pi, -pi], [s / 2, pi, pi]), XY)
    outer, inner = l2 + l3, l2 - l3
    lens = 2 * inner**2 * acos(s / (2 * inner)) - s / 2 * (4 * inner**2 - s**2) ** 0.5
    assert ws.area == pytest.approx(2 * outer * s + pi * outer**2 - lens, rel=EXACT)
    assert [void.area for void in ws.voids] == [pytest.approx(lens, rel=EXACT)]


def test_ppr_is_a_rectangle_with_round_corners():
    ws = workspace(chain("PPR", [0.0, 0.0, 0.3], [0, 0, -pi], [1.0, 0.7, pi], turns=[0, pi / 2, 0]), XY)
    assert ws.area == pytest.approx(0.7 + 2 * 0.3 * 1.7 + pi * 0.3**2, rel=EXACT)


# --- in space


def test_scara_is_the_area_of_its_2r_times_the_stroke():
    a, b = radians(130), radians(145)
    ws = workspace(r1.robot_from_dh(SCARA, lower=[-a, -b, 0], upper=[a, b, 0.2]), XYZ)
    assert ws.volume == pytest.approx(0.2 * two_link_area_both_elbows(0.4, 0.3, a, b), abs=1e-9)
    assert ws.contains([0.5, 0.1, -0.1])
    assert not ws.contains([0.5, 0.1, 0.1])
    assert ws.distance([0.5, 0.0, -0.03]) == pytest.approx(0.03)
    assert ws.distance([0.8, 0.0, 0.05]) == pytest.approx(hypot(0.1, 0.05))


def test_cylindrical_arm_is_a_hollow_cylinder():
    arm = r1.robot_from_dh(
        [("R", 0, 0, 0, 0), ("P", 0, -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], lower=[-1, 0, 0.3], upper=[2, 1.2, 0.9]
    )
    ws = workspace(arm, XYZ)
    assert ws.volume == pytest.approx(1.2 * annulus_area(0.3, 0.9, 3.0), rel=EXACT)


def test_gantry_is_a_box():
    rows = [("P", 0, pi / 2, 0, 0), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)]
    ws = workspace(r1.robot_from_dh(rows, lower=[0, -1, 2], upper=[0.5, 1, 2.4]), XYZ)
    assert ws.volume == pytest.approx(0.5 * 2 * 0.4, rel=EXACT)


def test_anthropomorphic_arm_without_limits_is_a_spherical_shell_with_four_solutions():
    ws = workspace(r1.robot_from_dh(ELBOW), XYZ)
    assert ws.volume == pytest.approx(spherical_shell_volume(0.5, 2.5), rel=EXACT)
    assert [region.solutions for region in ws.regions] == [4]
    assert (ws.r_min, ws.r_max) == pytest.approx((0, 2.5))
    assert ws.contains([0, 0, 0.5 + 2.5])
    assert not ws.contains([0, 0.3, 0.5])
    assert ws.distance([0, 0.3, 0.5]) == pytest.approx(0.2)


@pytest.mark.parametrize("turn", [(-1.0, 2.0), (-0.3, 0.4), (-1.5, 1.6)])
@pytest.mark.parametrize("shoulder", [(-0.5, 1.0), (0.3, 2.9), (1.8, 2.6)])
def test_anthropomorphic_arm_with_one_elbow_has_the_volume_of_the_integral_of_det_j(turn, shoulder):
    q3 = (0.4, 1.5)
    ws = workspace(
        r1.robot_from_dh(ELBOW, lower=[turn[0], shoulder[0], q3[0]], upper=[turn[1], shoulder[1], q3[1]]), XYZ
    )
    outer, weight = gauss_between(*q3, [])
    total = 0.0
    for angle, w in zip(outer, weight, strict=True):
        shift = np.arctan2(np.sin(angle), 1.5 + np.cos(angle))  # ρ = R cos(q2 + shift)
        ends = np.array(shoulder) + shift
        total += w * 1.5 * np.sin(angle) * two_link_distance(1.5, 1.0, angle) * _integral_of_cosine(*ends)
    assert turn[1] - turn[0] < pi or turn == (-1.5, 1.6)
    overlap = max(0.0, turn[1] - turn[0] - pi)
    assert overlap < 1e-12
    assert ws.volume == pytest.approx((turn[1] - turn[0]) * total, rel=1e-9)


def _integral_of_cosine(a, b):
    """∫ |cos| from a to b."""
    bends = [a, *[k * pi + pi / 2 for k in range(-4, 5) if a < k * pi + pi / 2 < b], b]
    return sum(abs(np.sin(d) - np.sin(c)) for c, d in pairwise(bends))


@pytest.mark.parametrize("turn", [(-1.0, 2.0), (-2.5, 2.5), (-pi, pi)])
def test_volume_of_an_arm_that_reaches_over_its_base_is_that_of_samples(turn):
    lower, upper = [turn[0], 0.3, 0.4], [turn[1], 2.9, 1.5]
    arm = r1.robot_from_dh(ELBOW, lower=lower, upper=upper)
    ws = workspace(arm, XYZ)
    rng = np.random.default_rng(0)
    points = rng.uniform([-2.5, -2.5, -2], [2.5, 2.5, 3], (2000, 3))
    inside = np.array([ws.contains(p) for p in points])
    share = inside.mean()
    assert ws.volume == pytest.approx(125 * share, abs=5 * 125 * (share * (1 - share) / 2000) ** 0.5)
    assert [_elbow_solutions(p, lower, upper) > 0 for p in points] == inside.tolist()
    for region in ws.regions if turn == (-pi, pi) else ():
        rho, height = region.point
        assert _elbow_solutions([rho, 0, height], lower, upper) == region.solutions
    for q in rng.uniform(lower, upper, (200, 3)):
        assert ws.contains(anthropomorphic_position(q, 0.5, 1.5, 1.0))


angles = st.tuples(st.floats(-3, 3), st.floats(0.2, 6)).map(lambda pair: (pair[0], pair[0] + pair[1]))


@given(angles, angles)
def test_solutions_of_an_arm_that_turns_fully_are_counted_on_both_sides_of_its_base(shoulder, elbow):
    """∫ N dV = ∫ |det J| dq, and N at a point of each region is the number of closed-form solutions."""
    lower, upper = [-pi, shoulder[0], elbow[0]], [pi, shoulder[1], elbow[1]]
    ws = workspace(r1.robot_from_dh(ELBOW, lower=lower, upper=upper), XYZ)
    for region in (*ws.regions, *ws.voids):
        assert _elbow_solutions([region.point[0], 0, region.point[1]], lower, upper) == region.solutions

    def swept(q3):
        shift = np.arctan2(np.sin(q3), 1.5 + np.cos(q3))
        ends = np.array(shoulder) + shift
        return 1.5 * abs(np.sin(q3)) * two_link_distance(1.5, 1.0, q3) * _integral_of_cosine(*ends)

    bends = sorted({*elbow, *(k * pi for k in range(-3, 4) if elbow[0] < k * pi < elbow[1])})
    whole = sum(quad(swept, a, b, epsabs=1e-10, limit=200)[0] for a, b in pairwise(bends))
    assert sum(r.solutions * r.volume for r in ws.regions) == pytest.approx(2 * pi * whole, rel=1e-6)
    assert sum(r.volume for r in ws.regions) == pytest.approx(ws.volume)


def _elbow_solutions(p, lower, upper):
    """The number of solutions of the arm inside limits: from each side of its base, with each elbow."""
    count, distance = 0, hypot(*p[:2], p[2] - 0.5)
    if not 0.5 <= distance <= 2.5:
        return 0
    for side in (1, -1):
        q1 = atan2(side * p[1], side * p[0])
        for q2, q3 in two_link_solutions((side * hypot(p[0], p[1]), p[2] - 0.5), 1.5, 1.0):
            beyond = [(q - a) % (2 * pi) <= b - a for q, a, b in zip((q1, q2, q3), lower, upper, strict=True)]
            count += all(beyond)
    return count


def test_polar_arm_is_a_spherical_shell():
    arm = r1.robot_from_dh(
        [("R", 0, pi / 2, 0.4, 0), ("R", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)],
        lower=[-pi, -pi, 0.3],
        upper=[pi, pi, 1],
    )
    ws = workspace(arm, XYZ)
    assert ws.volume == pytest.approx(spherical_shell_volume(0.3, 1.0), rel=EXACT)
    assert [region.solutions for region in ws.regions] == [2]


def test_radii_are_distances_from_the_first_axis_wherever_it_is():
    ws = workspace(chain("RR", [0.4, 0.3], [-2.0, -1.0], [2.0, 1.0]), XY)
    assert ws.r_max == pytest.approx(0.7)
    assert ws.farthest[:, 1] == pytest.approx([0], abs=1e-7)
    p = XY.value(chain("RR", [0.4, 0.3], [-2.0, -1.0], [2.0, 1.0]), ws.nearest[0])
    assert hypot(*(p - MOUNT)) == pytest.approx(ws.r_min)
    assert sorted(ws.nearest[:, 1]) == pytest.approx([-1, 1])


def test_singular_curves_cross_where_the_inner_circle_of_one_side_meets_the_outer_one_of_the_other():
    """About ρ = a and ρ = −a: (ρ − a)² + h² = (l2 − l3)² and (ρ + a)² + h² = (l2 + l3)² give 4 a ρ = 4 l2 l3."""
    a, l2, l3 = 0.5, 1.0, 0.3
    ws = workspace(r1.robot_from_dh([("R", a, pi / 2, 0, 0), ("R", l2, 0, 0, 0), ("R", l3, 0, 0, 0)]), XYZ)
    rho = l2 * l3 / a
    h = sqrt((l2 - l3) ** 2 - (rho - a) ** 2)
    assert sorted(map(tuple, ws.nodes)) == [pytest.approx((rho, -h)), pytest.approx((rho, h))]
    assert "Singular curves cross" in ws.explain()
