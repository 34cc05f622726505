"""Files that are no meshes, and meshes that nobody should trust: each ends in a sentence."""

import json
import os
import zipfile

import mesh_texts as texts
import pytest
from PIL import Image

from robotics1.errors import InputError
from robotics1.viewer.mesh_formats import files, neighbours
from robotics1.viewer.meshes import read_mesh

JUNK = {
    "nothing": b"",
    "text": b"hello, world",
    "noise": bytes(range(256)) * 20,
    "a page": b"<!-- a --><html><body>404</body></html>",
    "xml": b"<a><b/></a>",
    "json": b'{"asset": {"version": "2.0"}}',
    "a list": b"[1, 2]",
    "nulls": b"\0" * 1000,
    "deep json": b"[" * 100_000,
    "a header of STL": b"\0" * 80 + b"\xff\xff\xff\xff",
    "a header of GLB": b"glTF\x02\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON",
    "a picture": b"\x89PNG\r\n\x1a\n",
    "an empty solid": b"solid a\nendsolid a\n",
    "half a corner": b"solid a\nfacet\nvertex 0 0\nendsolid a\n",
    "corners of words": b"solid a\nvertex a b c\nvertex 1 2 3\nvertex 1 2 3\nendsolid a\n",
    "corners alone": b"v 0 0 0\nv 1 0 0\n",
    "faces without corners": b"v 0 0 0\nf 1 2 3\nf 9 9 9\n",
}


@pytest.mark.parametrize("suffix", ["stl", "obj", "dae", "glb", "gltf"])
@pytest.mark.parametrize("content", JUNK.values(), ids=JUNK)
def test_what_is_no_mesh_is_refused_in_a_sentence_with_its_name(mesh, content, suffix, capfd):
    with pytest.raises(InputError, match=rf"mesh '.*a\.{suffix}' (cannot be read|has no triangle)"):
        mesh(f"a.{suffix}", content)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("name", ["a.zae", "a.ply", "a.3mf", "a", "a.png"])
def test_other_formats_are_refused(mesh, name):
    with pytest.raises(InputError, match=r"none of the suffixes that are read: \.stl, \.obj, \.dae, \.glb, \.gltf"):
        mesh(name, texts.stl_bytes())


def test_what_is_no_file_is_refused(tmp_path):
    (tmp_path / "folder.stl").mkdir()
    os.mkfifo(tmp_path / "pipe.stl")
    (tmp_path / "loop.stl").symlink_to(tmp_path / "loop.stl")
    (tmp_path / "zero.stl").symlink_to("/dev/zero")
    for name in ("missing.stl", "folder.stl", "pipe.stl", "loop.stl", "zero.stl", "a\0.stl", "a" * 5000 + ".stl"):
        with pytest.raises(InputError, match="cannot be read: "):
            read_mesh(tmp_path / name)


def polylist(counts, numbers):
    """A COLLADA file of polygons."""
    polygons = f"<polylist>{texts.VERTEX}<vcount>{counts}</vcount><p>{numbers}</p></polylist>"
    return texts.dae(primitives=polygons)


def test_numbers_beyond_those_of_the_file_are_refused(mesh):
    for content in (
        texts.dae(faces=((0, 1, 4),)),
        texts.dae(faces=((0, 1, -1),)),
        polylist("3", "0 9 1"),
        polylist("3", "0 one 1"),
        texts.dae(primitives=f"<triangles>{texts.VERTEX.replace('#v', '#nowhere')}<p>0 1 2</p></triangles>"),
        texts.dae(nodes='<node><instance_geometry url="#nowhere"/></node>'),
        texts.dae(nodes='<node><instance_geometry url="other.dae#g"/></node>'),
    ):
        with pytest.raises(InputError, match="cannot be read as dae"):
            mesh("a.dae", content)
    with pytest.raises(InputError, match="a corner that is not there"):
        mesh("a.glb", texts.glb(faces=((0, 1, 9),)))


# --- files that nobody should trust

ELSEWHERE = [
    "/etc/{}",
    "../../{}",
    "../{}",
    "file:///etc/{}",
    "http://a.example/{}",
    "C:\\{}",
    "..\\..\\{}",
    "link/{}",
    "%2e%2e/%2e%2e/{}",
]


@pytest.mark.parametrize("name", ELSEWHERE)
def test_a_file_elsewhere_is_not_read(mesh, tmp_path, name, picture):
    (tmp_path / "pkg/meshes").mkdir(parents=True)
    (tmp_path / "pkg/meshes/link").symlink_to(tmp_path)
    tree, data = texts.gltf_tree()
    (tmp_path / "a.bin").write_bytes(data)
    (tmp_path / "a.mtl").write_bytes(b"newmtl a\nKd 1 0 0\n")
    picture("a.png")
    tree["buffers"][0]["uri"] = name.format("a.bin")
    with pytest.raises(InputError, match=r"names the file .*; only files of its own folder are read"):
        mesh("a.gltf", json.dumps(tree).encode())
    for file, content in {
        "a.obj": texts.obj(before=f"mtllib {name.format('a.mtl')}\nusemtl a"),
        "a.dae": texts.dae(effects={"a": name.format("a.png")}),
    }.items():
        (part,) = mesh(file, content)
        assert part.color in (None, (0.8, 0.8, 0.8, 1.0), (0.4, 0.4, 0.4, 1.0))  # drawn, but in no colour from there


def test_of_the_folders_beside_only_pictures_and_materials_are_read(mesh):
    tree, data = texts.gltf_tree()
    tree["buffers"][0]["uri"] = "../other/a.bin"
    with pytest.raises(InputError, match=r"names the file '\.\./other/a\.bin'"):
        mesh("a.gltf", json.dumps(tree).encode(), {"../other/a.bin": data})
    content = texts.obj(before="mtllib ../other/a.mtl\nusemtl a")
    (part,) = mesh("a.obj", content, {"../other/a.mtl": b"newmtl a\nKd 1 0 0\n"})
    assert part.color == (1, 0, 0, 1)


ENTITIES = {
    "many times itself": '<!DOCTYPE a [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;">]>',
    "a file": '<!DOCTYPE a [<!ENTITY a SYSTEM "file:///etc/hostname">]>',
    "an address": '<!DOCTYPE a SYSTEM "http://a.example/a.dtd">',
}


@pytest.mark.parametrize("doctype", ENTITIES.values(), ids=ENTITIES)
def test_entities_are_refused(mesh, doctype):
    with pytest.raises(InputError, match="it has a DOCTYPE"):
        mesh("a.dae", texts.dae(doctype=doctype))


def test_a_zip_file_is_no_dae(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.dae", "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("a.dae", texts.dae())
    with pytest.raises(InputError, match="not well-formed XML"):
        read_mesh(tmp_path / "a.dae")


def holding(name, *others):
    """A node with others in it."""
    inside = "".join(f'<instance_node url="#{other}"/>' for other in others)
    return f'<node id="{name}">{inside}</node>'


def test_nodes_that_hold_each_other_many_times_are_counted_before_they_are_placed(mesh):
    tens = "".join(holding(f"n{i}", *[f"n{i - 1}"] * 10) for i in range(1, 12))
    library = f'<library_nodes><node id="n0"><instance_geometry url="#g"/></node>{tens}</library_nodes>'
    with pytest.raises(InputError, match="its nodes place its geometries too often"):
        mesh("a.dae", texts.dae(head=library, nodes='<node><instance_node url="#n11"/></node>'))
    circle = f"<library_nodes>{holding('a', 'b')}{holding('b', 'a')}</library_nodes>"
    with pytest.raises(InputError, match="cannot be read as dae"):
        mesh("a.dae", texts.dae(head=circle, nodes='<node><instance_node url="#a"/></node>'))
    chain = "".join(holding(f"n{i}", f"n{i + 1}") for i in range(3000))
    with pytest.raises(InputError, match="more than 2000 nodes in nodes"):
        mesh("a.dae", texts.dae(head=f"<library_nodes>{chain}</library_nodes>"))


def test_polygons_with_more_corners_than_there_are_take_no_memory(mesh):
    for counts in ("4000000000", "3 2000000000", "-3 6"):
        with pytest.raises(InputError, match="its polygons have more corners than it lists"):
            mesh("a.dae", polylist(counts, "0 1 2"))


def test_buffers_of_gltf_that_are_used_too_often_take_no_memory(mesh):
    many = [{"componentType": 5126, "count": 10**12, "type": "VEC3"}]
    tree, _ = texts.gltf_tree()
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 90_000_000}] * 10
    for changes in ({"accessors": tree["accessors"] + many}, {"bufferViews": views}):
        with pytest.raises(InputError, match="its buffers are used too often"):
            mesh("a.glb", texts.glb(**changes))


@pytest.mark.parametrize(
    ("name", "sentence"),
    [("KHR_draco_mesh_compression", "pip install 'robotics1.draco.'"), ("EXT_meshopt_compression", "is not read")],
)
def test_compression_that_nothing_here_reads_is_refused_in_a_sentence(mesh, monkeypatch, name, sentence):
    monkeypatch.setattr(files, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=f"compressed by {name}.*{sentence}"):
        mesh("a.glb", texts.glb(extensionsUsed=[name]))


def test_what_is_not_compressed_as_it_says_is_refused(mesh):
    pytest.importorskip("DracoPy")
    import trimesh

    data = trimesh.creation.icosphere().export(file_type="glb", extension_draco=True)
    begin = data.index(b"DRACO")
    for broken in (
        data[:begin] + b"OCARD" + data[begin + 5 :],
        data[: begin + 40] + b"\xff" * (len(data) - begin - 40),
    ):
        with pytest.raises(InputError, match=r"a\.glb"):
            mesh("a.glb", broken)


def test_a_picture_of_many_pixels_is_not_unpacked(mesh, tmp_path, capfd):
    for side in (9000, 20_000):
        Image.new("1", (side, side)).save(tmp_path / "a.png")
        assert (tmp_path / "a.png").stat().st_size < 100_000
        (part,) = mesh("a.dae", texts.dae(effects={"a": "a.png"}), {"a.png": (tmp_path / "a.png").read_bytes()})
        assert part.color is None
    assert capfd.readouterr() == ("", "")


def test_a_program_in_place_of_a_picture_is_not_run(mesh):
    page = b"%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 10 10\n%%EndComments\n(x) print\n%%EOF\n"
    (part,) = mesh("a.dae", texts.dae(effects={"a": "a.eps"}), {"a.eps": page})
    assert part.color is None


def test_the_files_that_a_mesh_names_may_have_200_mb_together(mesh, monkeypatch):
    monkeypatch.setattr(neighbours, "LARGEST_FILE", 5000)
    mtl = b"newmtl a\nKd 1 0 0\n".ljust(5000)
    (part,) = mesh("a.obj", texts.obj(before="mtllib a.mtl\nusemtl a"), {"a.mtl": mtl})
    assert part.color is None
