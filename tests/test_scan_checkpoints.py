"""Scans that are killed, or whose file is damaged or of another question: nothing is lost."""

import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from arms import arm

import robotics1 as r1

CHILD = """
import os, signal, sys
from arms import arm
import robotics1 as r1
from robotics1.chunks import state
state.EVERY = 0.0
calls = []
def progress(done, of):
    calls.append(done)
    if len(calls) == 3:
        os.kill(os.getpid(), signal.SIGKILL)
r1.scan_singularities(arm("planar_3r"), r1.PositionTask("xy"), samples=90_000, method=sys.argv[2],
                      measures=("sigma_min", "condition"), checkpoint=sys.argv[1], progress=progress)
"""


def scan(path, robot=None, **options):
    given = {"samples": 90_000, "measures": ("sigma_min", "condition"), "checkpoint": path} | options
    return r1.scan_singularities(robot or arm("planar_3r"), r1.PositionTask("xy"), **given)


def same(a, b):
    assert a.count == b.count
    assert np.array_equal(a.worst, b.worst)
    assert np.array_equal(a.worst_values, b.worst_values)
    for measure in a.measures:
        one, other = a.distribution(measure), b.distribution(measure)
        assert (one.count, one.minimum, one.maximum) == (other.count, other.minimum, other.maximum)
        assert np.array_equal(one.bins, other.bins)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("scans") / "whole.npz"
    scan(path)
    return path


@pytest.mark.parametrize("method", ["random", "sobol", "grid"])
def test_a_killed_scan_goes_on_where_it_was_and_ends_with_the_same_bytes(tmp_path, method):
    path, other = tmp_path / "killed.npz", tmp_path / "whole.npz"
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    child = subprocess.run([sys.executable, "-c", CHILD, path, method], env=environment, check=False)
    assert child.returncode == -signal.SIGKILL
    steps = []
    resumed = scan(path, method=method, progress=lambda done, of: steps.append(done))
    assert len(steps) == 3  # of six chunks; the file was last written after the third
    same(resumed, scan(other, method=method))
    same(resumed, scan(None, method=method))
    assert path.read_bytes() == other.read_bytes()


def test_a_finished_scan_is_read_and_other_workers_write_the_same_file(tmp_path, whole):
    steps = []
    same(scan(whole, progress=lambda *n: steps.append(n)), scan(None))
    assert steps == []
    with ThreadPoolExecutor(3) as executor:
        scan(tmp_path / "three.npz", executor=executor)
    assert (tmp_path / "three.npz").read_bytes() == whole.read_bytes()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"seed": 1}, "seed differs"),
        ({"samples": 90_001}, "samples differs"),
        ({"method": "grid"}, "method, samples, grid differ;"),
        ({"measures": ("condition", "sigma_min")}, "measures differs"),
        ({"box": {"q1": (0, 1)}}, "box differs"),
        ({"length": 2.0}, "length differs"),
        ({"refine": 20}, "worst differs"),
        ({"robot": "redundant"}, "robot, task, box differ"),
    ],
)
def test_a_checkpoint_of_another_question_is_refused_and_left_alone(whole, options, message):
    before = whole.read_bytes()
    given = dict(options)
    robot = arm(given.pop("robot")) if "robot" in given else None
    with pytest.raises(r1.InputError, match=message):
        scan(whole, robot, **given)
    assert whole.read_bytes() == before


def test_a_damaged_file_is_seen_at_every_byte(tmp_path, whole):
    content, path = whole.read_bytes(), tmp_path / "damaged.npz"
    kept, told = scan(None), []
    for place in np.random.default_rng(0).integers(0, len(content), 30):
        damaged = bytearray(content)
        damaged[place] ^= 0x10
        path.write_bytes(damaged)
        try:
            same(scan(path), kept)  # nothing is read from some bytes, as from those of a date
        except r1.InputError as error:
            told.append(str(error))
    assert len(told) > 20
    assert all("damaged" in message or "another question" in message for message in told)
    path.write_bytes(content[: len(content) // 2])
    with pytest.raises(r1.InputError, match="damaged"):
        scan(path)
    path.write_text("q1, q2, q3")
    with pytest.raises(r1.InputError, match="damaged"):
        scan(path)


def test_a_file_that_cannot_be_written_is_told(tmp_path):
    with pytest.raises(r1.InputError, match="there is no folder"):
        scan(tmp_path / "none" / "a.npz")
    with pytest.raises(r1.InputError, match="no checkpoint"):
        scan(tmp_path)
