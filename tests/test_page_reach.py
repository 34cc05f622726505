"""The cells of a reachability map in a page: where they are, what colours them, and how a slider cuts them."""

import numpy as np
import pytest
from arms import arm
from pages import OpenPage

import robotics1 as r1
from robotics1.workspaces import reachability_map

GRID = {"x": np.linspace(-0.9, 0.9, 10), "y": np.linspace(-0.8, 0.8, 9), "z": np.linspace(-0.3, 1.1, 8)}


@pytest.fixture(scope="module")
def known():
    return reachability_map(arm("six_r"), r1.PoseTask(), GRID, 12)


@pytest.fixture(scope="module")
def page(browser, known, tmp_path_factory):
    path = tmp_path_factory.mktemp("reach") / "reach.html"
    opened = OpenPage(browser, r1.view(arm("six_r"), None, path, reach=known, caption=known.explain()).file)
    yield opened
    opened.tab.close()


def cells(page):
    """The position and the colour of every cell."""
    positions = np.array(page.ask("Array.from(app.voxels.mesh.instanceMatrix.array)")).reshape(-1, 16)[:, 12:15]
    return positions, np.array(page.ask("Array.from(app.voxels.mesh.instanceColor.array)")).reshape(-1, 3)


def test_a_box_stands_at_every_position_that_is_reached(page, known):
    reached = known.positions[known.reached.any(axis=1)]
    positions, _ = cells(page)
    assert len(positions) == len(reached) > 50
    order, expected = (np.lexsort(np.round(points, 3).T) for points in (positions, reached))
    assert positions[order] == pytest.approx(reached[expected], abs=1e-4)
    assert page.faults == []


def test_the_colour_grows_with_the_value_from_violet_to_yellow(page, known):
    positions, colors = cells(page)
    assert page.tab.inner_text("#most") == f"{known.capability.max():.4g}"
    best = colors[np.linalg.norm(positions - known.positions[np.argmax(known.capability)], axis=1).argmin()]
    assert best == pytest.approx([0.993, 0.906, 0.144], abs=1e-3)
    page.tab.select_option("#measure", label="manipulability")
    _, others = cells(page)
    assert np.abs(others - colors).max() > 0.1
    assert float(page.tab.inner_text("#most")) == pytest.approx(np.nanmax(known.manipulability), rel=1e-3)
    page.tab.select_option("#measure", index=0)


def test_the_slider_cuts_away_what_lies_before_it(page, known):
    page.picture("reach")
    page.tab.locator("#cut").evaluate("(s) => { s.value = 0.1; s.dispatchEvent(new Event('input')); }")
    reached = known.positions[known.reached.any(axis=1)]
    assert page.ask("app.voxels.mesh.count") == np.count_nonzero(reached[:, 1] >= 0.1)
    assert page.tab.inner_text("#from") == "y ≥ 0.10 m"
    page.picture("reach_cut")
    page.tab.locator("#cut").evaluate("(s) => { s.value = s.min; s.dispatchEvent(new Event('input')); }")
    assert page.ask("app.voxels.mesh.count") == len(reached)


def test_a_page_without_a_map_has_no_such_controls(browser, tmp_path):
    opened = OpenPage(browser, r1.view(arm("planar_2r"), None, tmp_path / "plain.html").file)
    assert not opened.tab.is_visible("#reach")
    opened.tab.close()


def test_what_is_no_map_of_a_grid_or_has_no_cell_is_refused():
    robot, task = arm("planar_2r"), r1.PositionTask("xy")
    for reach in (3, reachability_map(robot, task, [[0.5, 0.5]])):
        with pytest.raises(r1.InputError, match="must be a map of a grid"):
            r1.view(robot, reach=reach)
    with pytest.raises(r1.InputError, match="up to 200000; of this map that are 0 cells"):
        r1.view(robot, reach=reachability_map(robot, task, {"x": [9, 10], "y": [0, 1]}))
