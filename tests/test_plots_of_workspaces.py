"""Plots of workspaces: what is drawn is the workspace, and it can be read without colour."""

from math import pi

import numpy as np
import pytest
from closed_forms import annulus_area
from planar_chains import XY, XYZ, chain

import robotics1 as r1
from robotics1 import plots
from robotics1.workspaces import workspace


def where_of(curve):
    """Why a curve is a boundary, in the few words of a legend."""
    words = [f"{name} at its {limit} limit" for name, limit in curve.limits.items()]
    return "; ".join([*words, *([", ".join(curve.singular) + " singular"] if curve.singular else [])])


def polygon_area(path):
    """The area that a compound path encloses."""
    return sum(0.5 * np.sum(p[:-1, 0] * p[1:, 1] - p[1:, 0] * p[:-1, 1]) for p in path.to_polygons(closed_only=True))


def test_filled_regions_have_the_areas_of_the_regions_but_their_holes():
    ws = workspace(chain("RR", [0.4, 0.3], None, None), XY)
    panel = plots.plot_workspace(ws)
    assert polygon_area(panel.patches[0].get_path()) == pytest.approx(annulus_area(0.1, 0.7), rel=1e-3)


def test_numbers_of_solutions_are_written_and_lines_differ_by_reason():
    ws = workspace(chain("RR", [0.4, 0.3], [-2.0, -1.0], [2.0, 1.0]), XY)
    panel = plots.plot_workspace(ws)
    assert [text.get_text() for text in panel.texts] == [str(region.solutions) for region in ws.regions]
    assert [line.get_label() for line in panel.lines] == list(dict.fromkeys(where_of(curve) for curve in ws.boundary))
    looks = [(line.get_linestyle(), line.get_marker()) for line in panel.lines]
    assert len(set(looks)) == len(looks)
    hatches = {text.get_text(): patch.get_hatch() for text, patch in zip(panel.texts, panel.patches, strict=True)}
    assert len(set(hatches.values())) == len(hatches) > 1


def test_drawn_boundary_points_are_on_the_boundary():
    ws = workspace(chain("PRR", [0.4, 0.3, 0.2], [0, -2.0, -1.0], [0.3, 2.0, 1.0]), XY)
    points = np.vstack([line.get_xydata() for line in plots.plot_workspace(ws).lines])
    assert max(ws.distance(p) for p in points[~np.isnan(points[:, 0])]) < 1e-12


def test_a_section_is_drawn_of_an_arm_in_space_and_written_to_a_file(tmp_path):
    rows = [("R", 0, pi / 2, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1.0, 0, 0, 0)]
    ws = workspace(r1.robot_from_dh(rows), XYZ)
    panel = plots.plot_workspace(ws, file=tmp_path / "section.svg", title="elbow")
    assert panel.get_xlabel() == "ρ [m]"
    assert panel.get_xlim()[0] > -0.2  # no room behind the axis, where nothing is
    assert "axis of the first joint" in [line.get_label() for line in panel.lines]
    assert "elbow" in panel.get_title()
    assert (tmp_path / "section.svg").read_text().startswith("<?xml")


def test_what_is_no_workspace_is_refused():
    with pytest.raises(r1.InputError, match="workspace\\(robot, task\\)"):
        plots.plot_workspace(chain("RR", [0.4, 0.3], None, None))


def test_cusps_are_stars_and_a_sampled_workspace_is_drawn_too():
    arm = r1.robot_from_dh([("R", 1, -pi / 2, 0, 0), ("R", 2, pi / 2, 1, 0), ("R", 1.5, 0, 0, 0)])
    ws = workspace(arm, XYZ)
    panel = plots.plot_workspace(ws)
    stars = next(line for line in panel.lines if line.get_marker() == "*")
    assert stars.get_xydata() == pytest.approx(ws.cusps)
    assert [text.get_text() for text in panel.texts] == ["2", "4"]
    sampled = workspace(arm, XY)
    patch = plots.plot_workspace(sampled).patches[0]
    assert abs(polygon_area(patch.get_path())) == pytest.approx(sampled.area, rel=1e-6)
