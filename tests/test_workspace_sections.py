"""Sections of workspaces in space with planes: closed forms, laws, and points asked one by one."""

from math import pi, sqrt

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings, strategies as st
from planar_chains import XY, XYZ
from spatial_arms import drawn_arm

import robotics1 as r1
from robotics1.workspaces import plane_section, workspace

SHELL = [("R", 0, pi / 2, 0.5, 0), ("R", 1.0, 0, 0, 0), ("R", 0.7, 0, 0, 0)]  # between spheres of 0.3 m and 1.7 m


@pytest.mark.parametrize("height", [0.0, 0.2, 1.0, 1.69])
def test_a_shell_is_cut_at_a_height_in_the_ring_between_its_spheres(height):
    ws = workspace(r1.robot_from_dh(SHELL), XYZ)
    found = plane_section(ws, [3, -2, 0.5 + height], [0, 0, -2])
    inner = sqrt(max(0.3**2 - height**2, 0))
    assert found.radii == pytest.approx(np.array([[inner, sqrt(1.7**2 - height**2)]]), abs=1e-7)
    assert found.area == pytest.approx(pi * (1.7**2 - height**2 - inner**2), abs=1e-6)
    assert found.point == pytest.approx([0, 0, 0.5 + height])
    assert (found.area_error, found.resolution) == (0, 0)


@pytest.mark.parametrize("normal", [[1, 0, 0], [1, 2, 0.5]])
def test_a_shell_is_cut_by_any_plane_beside_its_middle_in_a_ring(normal):
    ws, n = workspace(r1.robot_from_dh(SHELL), XYZ), np.array(normal) / np.linalg.norm(normal)
    far = 0.25
    found = plane_section(ws, np.array([0, 0, 0.5]) + far * n, normal)
    assert found.area == pytest.approx(pi * (1.7**2 - 0.3**2), abs=found.area_error)
    assert found.area_error < 2e-3
    inner = sqrt(0.3**2 - far**2)
    radii = [
        np.linalg.norm(line - (np.array([0, 0, 0.5]) - found.point) @ found.axes.T, axis=1) for line in found.outlines
    ]
    assert sorted(float(r.mean()) for r in radii) == pytest.approx([inner, sqrt(1.7**2 - far**2)], abs=1e-4)
    assert all(np.ptp(r) < 1e-4 for r in radii)


def test_a_scara_is_cut_across_its_slide_in_its_plane_and_along_it_in_a_rectangle():
    """At x = 0.6 the ring sector of links 0.4 and 0.3 has the width of the circle of 0.7 m, times the stroke."""
    scara = [("R", 0.4, 0, 0, 0), ("R", 0.3, pi, 0, 0), ("P", 0, 0, 0, 0)]
    arm = r1.robot_from_dh(scara, lower=[-2, -2, 0], upper=[2, 2, 0.2])
    ws = workspace(arm, XYZ)
    flat = plane_section(ws, [0, 0, -0.1], [0, 0, 1])
    assert flat.area == pytest.approx(ws.area, abs=5 * flat.area_error)
    upright = plane_section(ws, [0.6, 0, 0], [1, 0, 0])
    assert upright.area == pytest.approx(0.2 * 2 * sqrt(0.7**2 - 0.6**2), rel=1e-3)
    above = plane_section(ws, [0, 0, 0.01], [0, 0, 1])
    assert (above.area, above.outlines) == (0, ())
    assert "reaches nothing" in above.explain()


def test_a_turn_with_limits_is_cut_at_its_height_in_a_sector():
    """A polar arm that turns by ±1 rad: at the height of its centre a sector of the disc of 2 m."""
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
    ws = workspace(r1.robot_from_dh(rows, lower=[-1, 0.1, 0], upper=[1, pi - 0.1, 2]), XYZ)
    found = plane_section(ws, [0, 0, 0.3], [0, 0, 1])
    foot = 0.3 * np.tan(0.1)  # the cone about the axis
    assert found.area == pytest.approx(4 - 0.3**2 - foot**2, abs=5 * found.area_error)
    assert len(found.outlines) == 1


@settings(max_examples=2)
@given(st.integers(0, 60))
def test_places_inside_the_curves_are_those_that_are_reached(seed):
    arm = drawn_arm(seed, "RRR")
    ws = workspace(arm, XYZ)
    rng = np.random.default_rng(seed)
    point = XYZ.value(arm, rng.uniform(arm.lower, arm.upper))
    found = plane_section(ws, point, rng.normal(size=3))
    z = np.vstack(found.outlines)
    for place in rng.uniform(z.min(axis=0), z.max(axis=0), (40, 2)):
        if np.linalg.norm(z - place, axis=1).min() > 2 * found.resolution:
            turns = sum(_turns_around(line - place) for line in found.outlines)
            assert ws.contains(found.point + place @ found.axes) == (turns > 0)


def _turns_around(line):
    """How often a closed curve goes around the origin."""
    w = np.append(line @ [1, 1j], line[0] @ [1, 1j])
    return round(float(np.angle(w[1:] / w[:-1]).sum()) / (2 * pi))


def test_areas_of_slices_add_up_to_the_volume():
    """Simpson's rule over heights of a shell between whole spheres is exact but where the hole begins and ends."""
    ws = workspace(r1.robot_from_dh(SHELL), XYZ)
    heights, step = np.linspace(-1.7, 1.7, 341, retstep=True)
    areas = [plane_section(ws, [0, 0, 0.5 + h], [0, 0, 1]).area for h in heights[::20]]
    assert np.trapezoid(areas, dx=20 * step) == pytest.approx(ws.volume, rel=1e-2)


@pytest.mark.parametrize("joint", [True, False])
def test_a_moved_base_moves_the_section(joint):
    limits = {"lower": [-1, -1, -2], "upper": [1, 1.5, -0.2]} if joint else {}
    T = pin.SE3(pin.rpy.rpyToMatrix(0.3, -0.2, 0.5), np.array([1.0, -2, 0.3]))
    here = plane_section(workspace(r1.robot_from_dh(SHELL, **limits), XYZ), [0.2, 0, 0.6], [1, 2, 3])
    moved = workspace(r1.robot_from_dh(SHELL, **limits, base_placement=T), XYZ)
    there = plane_section(moved, T * np.array([0.2, 0, 0.6]), T.rotation @ [1, 2, 3])
    assert there.area == pytest.approx(here.area, abs=5 * (here.area_error + there.area_error))


def test_a_sampled_workspace_is_cut_to_its_resolution():
    wrist = [("R", 0, pi / 2, 0, 0), ("R", 0.9, 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, 0.6, 0)]
    arm = r1.robot_from_dh([*wrist, ("R", 0, pi / 2, 0, 0), ("R", 0.2, 0, 0, 0)])
    found = plane_section(workspace(arm, XYZ), [0, 0, 0.5], [0, 0, 1])
    assert found.resolution > 0
    assert found.radii[-1, 1] == pytest.approx(sqrt(1.7**2 - 0.5**2), abs=2 * found.resolution)
    assert "may be missed" in found.explain()


@pytest.mark.parametrize(
    "wrong", [{"ws": None}, {"point": [0, 0]}, {"point": [0, np.nan, 0]}, {"normal": [0, 0, 0]}, {"normal": "z"}]
)
def test_planes_of_another_form_are_refused(wrong):
    good = {"ws": workspace(r1.robot_from_dh(SHELL), XYZ), "point": [0, 0, 0], "normal": [0, 0, 1]}
    with pytest.raises(r1.InputError):
        plane_section(**(good | wrong))


def test_a_workspace_in_a_plane_has_no_section():
    ws = workspace(r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)]), XY)
    with pytest.raises(r1.TaskError, match="one in a plane"):
        plane_section(ws, [0, 0, 0], [0, 0, 1])
