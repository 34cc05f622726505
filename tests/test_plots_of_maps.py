"""Slices of maps: the cells that are drawn are those of the map."""

import numpy as np
import pytest
from arms import arm

import robotics1 as r1
from robotics1.plots import plot_reachability
from robotics1.workspaces import reachability_map


@pytest.fixture(scope="module")
def flat():
    return reachability_map(
        arm("planar_2r"), r1.PositionTask("xy"), {"x": np.linspace(-2, 2, 11), "y": np.linspace(0, 2, 7)}
    )


@pytest.fixture(scope="module")
def spatial():
    grid = {"x": np.linspace(-1, 1, 5), "y": np.linspace(-1, 1, 6), "z": np.linspace(0, 1, 7)}
    return reachability_map(arm("six_r"), r1.PoseTask(), grid, 6)


@pytest.mark.parametrize("value", ["capability", "solutions", "manipulability", "limit_margin"])
def test_the_cells_of_a_plane_are_the_values_of_the_map(flat, value):
    ax = plot_reachability(flat, value)
    cells = ax.collections[0].get_array()
    reached = flat.on_grid(flat.reached[:, 0]).T
    assert np.array_equal(~np.ma.getmaskarray(cells), reached)
    values = flat.most_solutions if value == "solutions" else getattr(flat, value)
    assert cells.filled(0)[reached].tolist() == flat.on_grid(values).T[reached].tolist()
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x [m]", "y [m]")


def test_a_slice_is_the_nearest_one_of_the_grid(spatial):
    ax = plot_reachability(spatial, at={"y": 0.25})
    cells = np.ma.filled(ax.collections[0].get_array(), 0)
    assert np.array_equal(cells, spatial.on_grid(spatial.capability)[:, 3, :].T)
    assert ax.get_title() == "y = 0.2 m"
    assert plot_reachability(spatial).get_title() == "z = 0.5 m"


def test_a_file_is_written_with_the_same_bytes(flat, tmp_path):
    for name in ("a.svg", "b.svg"):
        plot_reachability(flat, file=tmp_path / name, title="planar 2R")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_what_cannot_be_drawn_is_told(spatial, flat):
    with pytest.raises(r1.InputError, match="must be a map of a grid"):
        plot_reachability(reachability_map(arm("planar_2r"), r1.PositionTask("xy"), [[0.1, 0.2]]))
    with pytest.raises(r1.InputError, match="there are 1 left"):
        plot_reachability(spatial, at={"y": 0.0, "z": 0.1})
    with pytest.raises(r1.InputError, match="a letter in at"):
        plot_reachability(spatial, at={"q": 0.0})
    with pytest.raises(r1.InputError, match="value must be one of"):
        plot_reachability(flat, "reach")
    grid = {"x": [0.1, 0.2], "y": [0.1, 0.2], "z": 0.3}
    with pytest.raises(r1.InputError, match="not counted"):
        plot_reachability(reachability_map(arm("redundant"), r1.PositionTask(), grid), "solutions")
