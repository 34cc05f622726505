"""The command reach, and --workers, --scheduler and --checkpoint of scan."""

import json

import numpy as np
import pytest
from arms import arm
from command import run

import robotics1 as r1

REACH = ["reach", "planar_2r", "--task", "position:xy", "--step", "0.2"]


def test_the_answer_is_that_of_the_function():
    known = r1.workspaces.reachability_map(arm("planar_2r"), r1.PositionTask("xy"), 0.2)
    result = run(*REACH)
    assert (result.code, result.stdout.strip()) == (0, known.explain())
    answer = json.loads(run(*REACH, "--json").stdout)
    assert answer["positions"] == known.positions.tolist()
    assert answer["capability"] == known.capability.tolist()
    assert answer["counts"] == {status.name: number for status, number in known.counts().items()}
    assert answer["complete"] is True
    assert [value for value in answer["manipulability"] if value is not None] == [
        value for value in known.manipulability.tolist() if not np.isnan(value)
    ]


def test_the_table_of_shares_counts_every_position_once():
    result = run(
        "reach", "prr", "--task", "planar-pose", "--grid", "x=-1:1:9", "--grid", "y=0.3", "--orientations", "4"
    )
    rows = [line.split("│")[3] for line in result.stdout.splitlines() if line.startswith("│")]
    assert sum(map(int, rows)) == 9
    assert "9 positions with 4 orientations each, 36 poses" in result.stdout


def test_a_checkpoint_is_kept_and_a_figure_written(tmp_path):
    pytest.importorskip("zarr")
    folder, figure = tmp_path / "map.zarr", tmp_path / "map.svg"
    first = run(*REACH, "--checkpoint", folder, "--figure", figure, "--workers", "2")
    assert first.code == 0
    assert figure.read_text().startswith("<?xml")
    assert run(*REACH, "--checkpoint", folder).stdout == first.stdout
    assert len(r1.workspaces.read_map(folder)) > 50


def test_a_page_has_the_cells(tmp_path):
    page = tmp_path / "reach.html"
    assert run(*REACH, "--page", page).code == 0
    assert '"voxels":{"cut":1' in page.read_text()


def test_a_scan_takes_a_checkpoint_and_workers(tmp_path):
    asked = ["scan", "planar_2r", "--task", "position:xy", "--samples", "2e4", "--json"]
    kept = run(*asked, "--checkpoint", tmp_path / "scan.npz", "--workers", "2")
    assert (tmp_path / "scan.npz").exists()
    assert run(*asked).stdout == kept.stdout == run(*asked, "--checkpoint", tmp_path / "scan.npz").stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--grid", "x=0:1:5"], "two ways to say the same"),
        (["--workers", "0"], "--workers must be an integer of at least 1"),
        (["--workers", "2", "--scheduler", "tcp://127.0.0.1:9"], "give one of them"),
    ],
)
def test_misuse_says_what_would_be_right(options, message):
    result = run(*REACH, *options)
    assert result.code == 2
    assert message in result.stderr.replace("\n", " ")


@pytest.mark.parametrize("text", ["x", "x=1:2", "x=0:1:0", "x=0:1:2.5", "x=0:1:2:3"])
def test_a_grid_of_another_form_is_refused(text):
    result = run("reach", "planar_2r", "--task", "position:xy", "--grid", text)
    assert result.code == 2
    assert "is no coordinate of a grid" in result.stderr


def test_the_step_of_a_grid_covers_the_reach_and_no_coordinate_that_stands_still():
    known = r1.workspaces.reachability_map(arm("planar_2r"), r1.PositionTask(), 0.1)
    x, y, z = known.grid
    assert len(z) == 1
    assert x[-1] >= 1.99 > x[-1] - 0.11
    assert -x[0] == pytest.approx(x[-1])
    assert np.diff(y) == pytest.approx(0.1)
    with pytest.raises(r1.InputError, match="poses are too many"):
        r1.workspaces.reachability_map(arm("six_r"), r1.PoseTask(), 1e-6, 5)
