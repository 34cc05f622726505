"""Meshes of more triangles than a page shows, and files of more bytes than are read."""

import json
import os
import struct
from pathlib import Path

import mesh_texts as texts
import numpy as np
import pytest

from robotics1.errors import InputError
from robotics1.viewer.clusters import FINE, clustered
from robotics1.viewer.mesh_parts import MeshPart
from robotics1.viewer.meshes import read_mesh

WHOLE = 10**9  # more faces than any mesh has
TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def stl(corners):
    """A binary STL file of triangles (n, 3, 3)."""
    data = np.zeros(len(corners), TRIANGLE)
    data["corners"] = corners
    return b"triangles".ljust(80) + struct.pack("<I", len(data)) + data.tobytes()


def ball(rows):
    """A ball of radius one, with 2 · rows · 2 rows triangles, some of them without area at the poles."""
    u, v = np.meshgrid(np.linspace(0, np.pi, rows + 1), np.linspace(0, 2 * np.pi, 2 * rows + 1), indexing="ij")
    points = np.stack([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)], axis=-1).reshape(-1, 3)
    i = (np.arange(rows)[:, None] * (2 * rows + 1) + np.arange(2 * rows)).ravel()
    across = 2 * rows + 1
    return np.vstack([np.c_[i, i + across, i + 1], np.c_[i + 1, i + across, i + across + 1]]), points


def box(parts):
    points = np.vstack([part.vertices[part.faces].reshape(-1, 3) for part in parts])
    return np.array([points.min(axis=0), points.max(axis=0)])


def volume(part):
    """Σ a·(b × c)/6 over the triangles; positive where they are anticlockwise as seen from outside."""
    a, b, c = np.moveaxis(part.vertices[part.faces], 1, 0)
    return float(np.sum(a * np.cross(b, c))) / 6


def test_a_mesh_of_many_triangles_is_decimated_and_keeps_its_size(mesh):
    faces, points = ball(120)
    content = stl(points[faces])
    (whole,) = mesh("a.stl", content, most_faces=WHOLE)
    assert len(whole.faces) == 4 * 120 * 120 - 4 * 120  # at the poles half of the triangles have no area
    assert np.ptp(whole.faces) + 1 == len(whole.vertices) == 119 * 240 + 2
    for most in (20_000, 1000):
        (part,) = mesh("a.stl", content, most_faces=most)
        assert 0.9 * most <= len(part.faces) <= most
        assert volume(part) == pytest.approx(4 / 3 * np.pi, rel=2e-2)
        assert np.linalg.norm(part.vertices, axis=1) == pytest.approx(1, abs=1e-2)


def test_decimation_keeps_the_parts_and_their_colours(mesh):
    faces, points = ball(40)
    effects = {name: f"<diffuse><color>{color} 1</color></diffuse>" for name, color in (("a", "1 0 0"), ("b", "0 1 0"))}
    parts = mesh("a.dae", texts.dae(faces.tolist(), points.tolist(), effects=effects), most_faces=1000)
    assert [part.color for part in parts] == [(1, 0, 0, 1), (0, 1, 0, 1)]
    assert 900 <= sum(len(part.faces) for part in parts) <= 1010
    assert box(parts) == pytest.approx(np.array([[-1] * 3, [1] * 3]), abs=2e-2)


def test_a_surface_of_more_triangles_than_decimation_takes_keeps_its_place_its_outside_and_its_box(mesh):
    faces, points = ball(340)
    assert len(faces) > FINE
    (part,) = mesh("a.stl", stl(points[faces]))
    assert 18_000 <= len(part.faces) <= 20_000
    assert np.linalg.norm(part.vertices, axis=1) == pytest.approx(1, abs=1e-2)
    assert volume(part) == pytest.approx(4 / 3 * np.pi, rel=1e-2)
    assert np.abs(box([part]) - [[-1] * 3, [1] * 3]).max() <= 0.01 * 2


def test_triangles_at_random_which_no_cell_joins_keep_their_box(mesh):
    corners = np.random.default_rng(0).random((FINE + 50_000, 3, 3))
    (part,) = mesh("a.stl", stl(corners))
    assert 10_000 <= len(part.faces) <= 20_000
    flat = corners.reshape(-1, 3)
    assert np.abs(box([part]) - [flat.min(axis=0), flat.max(axis=0)]).max() <= 0.01


def test_clusters_keep_the_colour_and_the_box_of_each_part_also_of_one_in_a_single_cell():
    faces, points = ball(240)
    parts = [
        MeshPart(points, faces.astype(np.int32), (1, 0, 0, 1)),
        MeshPart(0.01 * points + [3.0, 0, 0], faces.astype(np.int32), (0, 1, 0, 1)),  # of a cell or two
    ]
    found = clustered(parts)
    assert [part.color for part in found] == [(1, 0, 0, 1), (0, 1, 0, 1)]
    assert box(found) == pytest.approx(box(parts), abs=1e-12)
    assert sum(len(part.faces) for part in found) < FINE
    assert np.abs(box(found[:1]) - [[-1] * 3, [1] * 3]).max() < 1e-12
    assert np.linalg.norm(found[0].vertices, axis=1) == pytest.approx(1, abs=4 / 128)
    keys = np.sort(found[0].faces, axis=1)
    assert len(np.unique(keys, axis=0)) == len(keys)


def test_a_surface_of_many_triangles_may_have_corners_that_are_no_numbers(mesh):
    faces, points = ball(340)
    corners = points[faces].copy()
    corners[::1000, 1] = np.nan
    corners[7, 0] = 1e30
    (part,) = mesh("a.stl", stl(corners))
    assert np.abs(box([part]) - [[-1] * 3, [1] * 3]).max() <= 0.01 * 2


def test_a_speck_far_from_a_surface_stays_in_the_box(mesh):
    faces, points = ball(340)
    small, corners = ball(6)
    speck = [3.0, 0, 0] + 0.004 * corners[small]  # all of it in one cell or two
    (part,) = mesh("a.stl", stl(np.concatenate([points[faces], speck])))
    assert len(part.faces) <= FINE
    assert np.abs(box([part]) - [[-1] * 3, [3.004, 1, 1]]).max() <= 0.01 * 4


@pytest.mark.parametrize("suffix", ["stl", "obj", "dae", "glb", "gltf"])
def test_a_file_of_more_than_200_mb_is_refused_before_it_is_read(tmp_path, monkeypatch, suffix):
    path = tmp_path / f"a.{suffix}"
    path.touch()
    os.truncate(path, 200_000_001)  # without a byte on the disk
    monkeypatch.setattr(Path, "open", lambda *_: pytest.fail("it is opened"))
    with pytest.raises(InputError, match=rf"mesh '.*a\.{suffix}' cannot be read: it has more than 200 MB"):
        read_mesh(path)


def test_a_buffer_of_more_than_200_mb_beside_a_mesh_is_refused(mesh, tmp_path):
    tree, data = texts.gltf_tree()
    tree["buffers"][0]["uri"] = "a.bin"
    folder = tmp_path / "pkg/meshes"
    folder.mkdir(parents=True)
    (folder / "a.bin").write_bytes(data)
    os.truncate(folder / "a.bin", 200_000_001)
    with pytest.raises(InputError, match="it has more than 200 MB"):
        mesh("a.gltf", json.dumps(tree).encode())
