"""Maps and scans on a Dask cluster: the same bits as here, also when a worker is killed in the middle."""

import os
import signal
from pathlib import Path

import numpy as np
import pytest
from arms import arm

import robotics1 as r1

ARRAYS = ("status", "solutions", "manipulability", "limit_margin", "q", "orientation")
distributed = pytest.importorskip("distributed")


@pytest.fixture(scope="module")
def cluster():
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "dashboard_address": ":0"}
    with distributed.LocalCluster(**options, silence_logs=50) as cluster:
        yield cluster


@pytest.fixture(scope="module")
def client(cluster):
    with distributed.Client(cluster, set_as_default=False) as client:
        yield client


def different(a, b):
    """The largest difference of each array that is not equal bit by bit."""
    pairs = {name: (getattr(a, name), getattr(b, name)) for name in ARRAYS}
    return {
        name: np.nanmax(np.abs(np.asarray(x, float) - y))
        for name, (x, y) in pairs.items()
        if not np.array_equal(x, y, equal_nan=True)
    }


def files(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in Path(folder).rglob("*") if p.is_file()}


def asked(**options):
    positions = np.random.default_rng(6).uniform(-1, 1, (6000, 3)) * arm("six_r").reach
    return r1.workspaces.reachability_map(arm("six_r"), r1.PoseTask(), positions, 40, **options)


@pytest.fixture(scope="module")
def alone():
    return asked()


def test_a_scan_by_a_client_and_by_an_address_is_the_scan_of_this_process(client):
    def scan(executor):
        samples = 400_000  # 25 chunks: four answers of workers that have joined those of eight
        return r1.scan_singularities(arm("planar_3r"), r1.PositionTask("xy"), samples=samples, executor=executor)

    here = scan(None)
    for executor in (client, client.scheduler.address):
        there = scan(executor)
        assert np.array_equal(here.worst, there.worst)
        assert np.array_equal(here.worst_values, there.worst_values)
        assert np.array_equal(here.distribution().bins, there.distribution().bins)


def test_a_map_whose_worker_is_killed_in_the_middle_loses_nothing(tmp_path, cluster, client, alone):
    pytest.importorskip("zarr")
    asked(checkpoint=tmp_path / "alone.zarr")
    killed = []

    def kill_one(done, of):
        if not killed:  # a worker that this test has started
            killed.append(next(iter(cluster.workers.values())).process.pid)
            os.kill(killed[0], signal.SIGKILL)

    survived = asked(executor=client, checkpoint=tmp_path / "killed.zarr", progress=kill_one)
    assert killed
    assert different(survived, alone) == {}
    assert files(tmp_path / "killed.zarr") == files(tmp_path / "alone.zarr")


def test_a_map_by_the_cluster_is_the_map_of_this_process(client, alone):
    assert different(asked(executor=client), alone) == {}


def test_an_address_without_a_scheduler_is_told():
    with pytest.raises(r1.InputError, match="no Dask scheduler answers"):
        asked(executor="tcp://127.0.0.1:9")
