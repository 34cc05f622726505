"""Maps that are killed, damaged, or of another question: nothing is lost, and they end with the same bytes."""

import json
import os
import signal
import subprocess
import sys
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from sweeps import some_of

import robotics1 as r1
from robotics1.workspaces import reachability_map, read_map, save_map

pytest.importorskip("zarr")

AXIS = np.linspace(-0.9, 0.9, 300)
CHILD = """
import os, signal, sys, time
import numpy as np
import robotics1 as r1
path, doomed = sys.argv[1], int(sys.argv[2])
robot = r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.3, 0, 0, 0)], lower=[-2, -1], upper=[1.5, 2.5])
axis = np.linspace(-0.9, 0.9, 300)
calls = []
def progress(done, of):
    calls.append(done)
    print(done, flush=True)
    if len(calls) == doomed:
        os.kill(os.getpid(), signal.SIGKILL)
r1.reachability_map(robot, r1.PositionTask("xy"), {"x": axis, "y": axis}, checkpoint=path, progress=progress)
"""


def asked(path=None, **options):
    robot = r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.3, 0, 0, 0)], lower=[-2, -1], upper=[1.5, 2.5])
    return reachability_map(robot, r1.PositionTask("xy"), {"x": AXIS, "y": AXIS}, checkpoint=path, **options)


def files(folder):
    """Relative path → content of every file."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("maps") / "whole.zarr"
    asked(path)
    return path


def same(a, b):
    names = ("positions", "status", "solutions", "manipulability", "limit_margin", "q", "orientation", "capability")
    return all(np.array_equal(getattr(a, name), getattr(b, name), equal_nan=True) for name in names)


def child(path, doomed):
    return subprocess.Popen([sys.executable, "-c", CHILD, str(path), str(doomed)], stdout=subprocess.PIPE, text=True)


def test_a_map_with_a_checkpoint_is_the_map_without_and_is_read_again(whole):
    known = asked()
    assert same(known, asked(whole))
    read = read_map(whole)
    assert same(known, read)
    assert read.explain() == known.explain()
    assert all(map(np.array_equal, read.grid, known.grid))


def test_a_map_killed_after_some_parts_goes_on_there_and_ends_with_the_same_bytes(tmp_path, whole):
    path = tmp_path / "killed.zarr"
    with child(path, 3) as killed:
        killed.communicate(timeout=120)
    assert killed.returncode == -signal.SIGKILL
    with pytest.raises(r1.InputError, match=r"is not finished, [1-8] of 11 parts are missing"):
        read_map(path)
    steps = []
    asked(path, progress=lambda done, of: steps.append(done))
    assert 1 <= len(steps) <= 8  # what was done is not done again
    assert steps[-1] == 90000
    assert files(path) == files(whole)


@pytest.mark.parametrize("after", some_of(np.random.default_rng(0).uniform(0, 0.4, 20), 2))
def test_a_map_killed_at_any_moment_ends_with_the_same_bytes(tmp_path, whole, after):
    path = tmp_path / "killed.zarr"
    with child(path, 99) as running:
        running.stdout.readline()  # the first part
        with pytest.raises(subprocess.TimeoutExpired):
            running.wait(after * 0.5)
        running.kill()
    asked(path)
    assert files(path) == files(whole)


def test_a_part_that_is_missing_is_done_again(tmp_path, whole):
    path = tmp_path / "copy.zarr"
    asked(path)
    for name in ("status/c/1/0", "q/c/3/0", "orientation/c/5"):
        (path / name).unlink()
    (path / "status/c/0.1234.partial").write_bytes(b"of a process that was killed")
    asked(path)
    assert files(path) == files(whole)


class Elsewhere(ThreadPoolExecutor):
    """Workers that do not see the folder; some of them see another one of its name."""

    def __init__(self, lost):
        super().__init__(1)
        self.lost = lost

    def submit(self, work, *place):
        kept = len(work.args) == 5  # in a folder
        if kept:
            packed, coordinates, orientations, _, token = work.args
            work = partial(work.func, packed, coordinates, orientations, "/nowhere", token)
        found = super().submit(work, *place).result()
        answer = Future()
        answer.set_result(None if self.lost and kept else found)
        return answer


@pytest.mark.parametrize("lost", [False, True])
def test_workers_that_do_not_see_the_folder_send_what_they_have_found(tmp_path, whole, lost):
    path = tmp_path / "elsewhere.zarr"
    with Elsewhere(lost) as executor:
        asked(path, executor=executor)
    assert files(path) == files(whole)


def test_damage_is_seen_and_told_and_only_its_part_is_lost(tmp_path, whole):
    path = tmp_path / "damaged.zarr"
    asked(path)
    chunk = path / "status/c/2/0"
    content = bytearray(chunk.read_bytes())
    content[len(content) // 2] ^= 1
    chunk.write_bytes(content)
    for call in (lambda: asked(path), lambda: read_map(path)):
        with pytest.raises(r1.InputError, match="is damaged in status/c/2/0; delete these files"):
            call()
    chunk.unlink()
    asked(path)
    assert files(path) == files(whole)
    (path / "zarr.json").write_text("{")
    with pytest.raises(r1.InputError, match="holds no map, or a damaged one"):
        asked(path)


def test_a_checkpoint_of_another_question_is_refused_and_left_alone(whole):
    before = files(whole)
    other = r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.31, 0, 0, 0)], lower=[-2, -1], upper=[1.5, 2.5])
    with pytest.raises(r1.InputError, match=r"of another question: robot, task differ;"):
        reachability_map(other, r1.PositionTask("xy"), {"x": AXIS, "y": AXIS}, checkpoint=whole)
    with pytest.raises(r1.InputError, match="seed differs"):
        asked(whole, seed=1)
    with pytest.raises(r1.InputError, match="starts differs"):
        asked(whole, starts=9)
    robot = r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.3, 0, 0, 0)], lower=[-2, -1], upper=[1.5, 2.5])
    with pytest.raises(r1.InputError, match="positions differs"):
        reachability_map(robot, r1.PositionTask("xy"), [[0.1, 0.2]], checkpoint=whole)
    assert files(whole) == before


def test_a_process_that_dies_ends_the_call_and_nothing_is_lost(tmp_path, whole):
    path, killed = tmp_path / "died.zarr", []

    def kill_one(done, of):
        if not killed:  # a process of the pool that this test has opened
            killed.append(next(iter(pool._processes)))
            os.kill(killed[0], signal.SIGKILL)

    died = pytest.raises(r1.InputError, match=r"a worker of the executor has died .* goes on from there")
    with ProcessPoolExecutor(1) as pool, died:
        asked(path, executor=pool, progress=kill_one)
    asked(path)
    assert files(path) == files(whole)


@pytest.mark.parametrize("name", ["text.zarr", "folder"])
def test_what_is_no_map_is_refused(tmp_path, name):
    path = tmp_path / name
    if name == "folder":
        path.mkdir()
    else:
        path.write_text("no map")
    with pytest.raises(r1.InputError, match=r"no map|no folder"):
        asked(path)
    with pytest.raises(r1.InputError, match=r"no map|no folder"):
        read_map(path)
    with pytest.raises(r1.InputError, match="exists already"):
        save_map(asked(), path)


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    with pytest.raises(r1.InputError, match="there is no folder"):
        asked(tmp_path / "none" / "a.zarr")
    with pytest.raises(r1.InputError, match="path of a folder"):
        asked(7)


FULL = """
import resource, signal, sys
import numpy as np
import robotics1 as r1
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
robot = r1.load_robot(sys.argv[2])
points = np.random.default_rng(0).uniform(-1, 1, (160000, 2))
done = []
def progress(d, of):
    done.append(d)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, resource.RLIM_INFINITY))
try:
    r1.reachability_map(robot, r1.PositionTask("xy"), points, checkpoint=sys.argv[1], progress=progress)
except r1.InputError as error:
    sys.stderr.write(f"{len(done)} {error}")
    sys.exit(3)
"""


def test_a_full_disk_is_told_and_what_was_done_is_kept(tmp_path):
    """Files that may not grow beyond 1000 bytes fail like those of a full disk, in the same place."""
    path = tmp_path / "full.zarr"
    full = subprocess.run(
        [sys.executable, "-c", FULL, str(path), "planar_2r"], capture_output=True, text=True, check=False
    )
    assert full.returncode == 3, full.stderr
    done = int(full.stderr.split()[0])
    assert "the checkpoint" in full.stderr
    assert "cannot be written" in full.stderr
    assert "kept" in full.stderr
    points = np.random.default_rng(0).uniform(-1, 1, (160000, 2))
    steps = []
    robot, task = r1.load_robot("planar_2r"), r1.PositionTask("xy")
    known = reachability_map(robot, task, points, checkpoint=path, progress=lambda done, of: steps.append(done))
    assert steps[-1] == 160000
    assert len(steps) <= 20 - done  # of 20 parts, those that were done are kept
    assert same(known, reachability_map(robot, task, points))


def test_a_map_is_saved_and_read_again_and_is_plain_zarr(tmp_path):
    import zarr

    known = asked()
    assert same(read_map(save_map(known, tmp_path / "saved.zarr")), known)
    assert np.array_equal(zarr.open_group(tmp_path / "saved.zarr", mode="r")["status"][:], known.status)
    assert os.listdir(tmp_path) == ["saved.zarr"]
    kept = json.loads((tmp_path / "saved.zarr" / "zarr.json").read_text())["attributes"]["robotics1"]
    assert kept["coordinates"] == "xy"
