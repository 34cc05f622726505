"""Work of hours is announced: how long it takes, by the pace of its first chunks."""

import subprocess
import sys

import numpy as np
import pytest

import robotics1 as r1
from robotics1.chunks import pace

DAY = 86400.0


class StoppedError(Exception):
    """What the caller's progress raises."""


@pytest.fixture
def clock(monkeypatch):
    """A clock that the test moves."""
    now = [0.0]
    monkeypatch.setattr(pace, "monotonic", lambda: now[0])
    return now


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(2 * 3600, "2 hours"), (3 * DAY, "3 days"), (29 * 365.25 * DAY, "29 years"), (3700, "1 hour")],
)
def test_the_time_is_what_is_left_over_the_pace(clock, seconds, words):
    """The first chunk may wait for a compiler: 10 more in 2 s make 5 a second, and what is left is 5 s."""
    seen = []
    told = pace.Pace("poses", "fewer", lambda *counts: seen.append(counts))
    total = 11 + round(5 * seconds)
    clock[0] = 100.0
    told(1, total)
    clock[0] = 102.0
    with pytest.warns(
        r1.RobotWarning, match=rf"poses will take about {words} at the present 5 a second: ask for fewer"
    ):
        told(11, total)
    told(12, total)  # once
    assert seen == [(1, total), (11, total), (12, total)]


@pytest.mark.parametrize("left", [0, 5 * 3599])
def test_less_than_an_hour_is_not_announced(clock, left):
    told = pace.Pace("poses", "fewer", None)
    told(1, 11 + left)
    clock[0] = 2.0
    told(11, 11 + left)


def test_a_scan_of_years_says_so_and_goes_on(clock, monkeypatch):
    """Each chunk takes ten seconds by the clock of the test; the caller's own error ends the scan after the third."""
    monkeypatch.setattr("robotics1.singularities.scan.TOGETHER", 1)
    seen = []

    def progress(done, total):
        clock[0] += 10
        seen.append(done)
        if len(seen) == 3:
            raise StoppedError

    with (
        pytest.raises(StoppedError),
        pytest.warns(r1.RobotWarning, match=r"1e\+15 configurations will take about [\d,]+ years"),
    ):
        r1.scan_singularities("planar_2r", r1.PositionTask("xy"), samples=1e15, progress=progress)
    assert seen == [2**14, 2**15, 3 * 2**14]


@pytest.mark.parametrize("question", ["map", "places"])
def test_maps_and_places_of_hours_say_so(monkeypatch, question):
    monkeypatch.setattr(pace, "LONG", -1.0)  # as if no time were short
    monkeypatch.setattr(pace, "AFTER", -1.0)
    grid = {"x": np.linspace(-1, 1, 200), "y": np.linspace(-1, 1, 200)}
    ask = {
        "map": lambda: r1.workspaces.reachability_map("planar_2r", r1.PositionTask("xy"), grid),
        "places": lambda: r1.workspaces.best_placements("planar_2r", r1.PositionTask("xy"), [[0.5, 0.5]], grid),
    }
    with pytest.warns(r1.RobotWarning, match=r"4e\+04 poses will take about .* (a coarser grid|fewer places)"):
        ask[question]()


@pytest.mark.sweep
def test_the_command_says_how_long_a_scan_takes_without_a_terminal():
    """Bad input of the issue: 10¹² asked at once are streamed, with the estimate."""
    words = [sys.executable, "-m", "robotics1", "scan", "planar_2r", "--task", "position:xy", "--samples", "1e15"]
    with subprocess.Popen(words, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as running:
        try:
            line = running.stderr.readline()
        finally:
            running.kill()
    assert line.startswith("warning: 1e+15 configurations will take about")
    assert "years" in line
