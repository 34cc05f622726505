"""Meshes: each format by hand, and every mesh of example-robot-data beside Pinocchio's reader."""

import itertools
import json
import re
import struct
from xml.sax.saxutils import quoteattr

import mesh_texts as texts
import numpy as np
import pinocchio as pin
import pytest
from sweeps import core_first

from robotics1.robot.sources import example_folder
from robotics1.viewer.mesh_formats.files import read_parts
from robotics1.viewer.meshes import read_mesh

FOLDER = example_folder()
KNOWN = {
    str(path.relative_to(FOLDER)): path
    for path in sorted(FOLDER.rglob("*"))
    if path.suffix.lower() in (".stl", ".obj", ".dae")
}
CORE = [
    "ur_description/meshes/ur5/visual/upperarm.dae",
    "ur_description/meshes/ur5/collision/base.stl",
    "icub_description/meshes/upmc/visual/icub_l_foot.dae",
    "xarm_description/meshes/xarm7/visual/link1.stl",
]
WHOLE = 10**9  # more faces than any mesh has


def box(parts):
    """The corners of the box round all parts, (2, 3)."""
    points = np.vstack([part.vertices for part in parts])
    return np.array([points.min(axis=0), points.max(axis=0)])


def volume(parts):
    """Σ a·(b × c)/6 over the triangles; positive where they are anticlockwise as seen from outside."""
    a, b, c = np.moveaxis(np.vstack([part.vertices[part.faces] for part in parts]), 1, 0)
    return float(np.sum(a * np.cross(b, c))) / 6


def pinocchios(path):
    """The box and the number of triangles of Pinocchio's reader."""
    shape = f"<visual><geometry><mesh filename={quoteattr(str(path))}/></geometry></visual>"
    text = f'<robot name="one"><link name="link">{shape}</link></robot>'
    visuals = pin.buildGeomFromUrdfString(pin.buildModelFromXML(text), text, pin.GeometryType.VISUAL)
    shape = visuals.geometryObjects[0].geometry
    shape.computeLocalAABB()
    return np.array([shape.aabb_local.min_, shape.aabb_local.max_]), shape.num_tris


def counted(path):
    """The number of triangles that a file declares, found with little more than regular expressions."""
    data = path.read_bytes()
    if path.suffix.lower() == ".stl":
        binary = len(data) >= 84 + 50 * struct.unpack_from("<I", data, 80)[0] > 84
        return struct.unpack_from("<I", data, 80)[0] if binary else data.count(b"endfacet")
    text = data.decode("utf-8", errors="replace")
    if path.suffix.lower() == ".obj":
        return sum(len(row.split()) - 3 for row in text.splitlines() if row.startswith("f "))
    total = 0
    for geometry in re.findall(r"<geometry .*?</geometry>", text, re.DOTALL):
        triangles = sum(map(int, re.findall(r'<triangles[^>]*count="(\d+)"', geometry)))
        polygons = re.findall(r"<vcount>([^<]*)</vcount>", geometry)
        triangles += sum(max(int(n) - 2, 0) for counts in polygons for n in counts.split())
        name = re.match(r'<geometry [^>]*?\bid="([^"]*)"', geometry)[1]
        total += triangles * len(re.findall(rf'<instance_geometry[^>]*url="#{re.escape(name)}"', text))
    return total


@pytest.mark.parametrize("name", core_first(KNOWN, CORE, 40))
def test_a_mesh_has_the_box_of_pinocchios_reader_and_the_triangles_of_its_file(name, capfd):
    path = KNOWN[name]
    whole = read_mesh(path, most_faces=WHOLE)
    corners, count = pinocchios(path)
    size = np.ptp(corners, axis=0).max()
    assert box(whole) == pytest.approx(corners, abs=1e-6 * size)
    read = sum(len(piece.faces) for piece in read_parts(path))
    assert read == counted(path)
    assert 0.97 * count <= sum(len(part.faces) for part in whole) <= read
    colors = [part.color for part in whole]
    assert len(set(colors)) == len(colors)
    few = read_mesh(path)
    assert sum(len(part.faces) for part in few) <= 46_000  # a thin mesh keeps 1.5² as many, for its size
    assert box(few) == pytest.approx(corners, abs=1.1e-2 * size)
    assert capfd.readouterr() == ("", "")


def test_every_part_of_a_ur5_has_a_colour():
    parts = [read_mesh(path) for name, path in KNOWN.items() if name.startswith("ur_description/meshes/ur5/visual")]
    assert [len(of_one) for of_one in parts] == [2, 3, 3, 4, 3, 3, 2]  # base, forearm, shoulder, upper arm, wrists
    for part in itertools.chain(*parts):
        assert all(0 <= value <= 1 for value in part.color)


# --- the formats


TETRAHEDRA = {
    "a.stl": texts.stl_text(),
    "a.STL": texts.stl_bytes(),
    "a.obj": texts.obj(),
    "a.dae": texts.dae(),
    "a.glb": texts.glb(),
}


@pytest.mark.parametrize(("name", "content"), TETRAHEDRA.items(), ids=TETRAHEDRA)
def test_a_tetrahedron_has_four_corners_four_triangles_and_the_volume_one_sixth(mesh, name, content):
    (part,) = mesh(name, content)
    assert (part.vertices.shape, part.faces.shape, part.color) == ((4, 3), (4, 3), None)
    assert volume([part]) == pytest.approx(1 / 6)
    with pytest.raises(ValueError, match="read-only"):
        part.vertices[0] = 0


def test_a_gltf_file_has_its_buffer_beside_it_or_inside(mesh):
    import base64

    tree, data = texts.gltf_tree()
    for uri in ("a.bin", "data/a%20b.bin", f"data:application/octet-stream;base64,{base64.b64encode(data).decode()}"):
        tree["buffers"][0]["uri"] = uri
        beside = {"a.bin": data, "data/a b.bin": data}
        assert volume(mesh("a.gltf", json.dumps(tree).encode(), beside)) == pytest.approx(1 / 6)


MIRRORED = (
    "<node><translate>1 2 3</translate><rotate>0 0 1 90</rotate><scale>-2 1 1</scale><node>GEOMETRY</node></node>"
)


def test_a_mirrored_node_keeps_the_outside_outside(mesh, tmp_path):
    parts = mesh("a.dae", texts.dae(nodes=MIRRORED))
    assert volume(parts) == pytest.approx(2 / 6)
    assert box(parts) == pytest.approx(pinocchios(tmp_path / "pkg/meshes/a.dae")[0], abs=1e-6)
    parts = mesh("a.glb", texts.glb(nodes=[{"mesh": 0, "translation": [1, 2, 3], "scale": [1, 2, -1]}]))
    assert volume(parts) == pytest.approx(2 / 6)
    assert box(parts) == pytest.approx(np.array([[1, 2, 2], [2, 4, 3]]))


@pytest.mark.parametrize("up", ["X_UP", "Y_UP", "Z_UP"])
def test_unit_and_upward_axis_of_a_dae_change_nothing_as_in_pinocchios_reader(mesh, tmp_path, up):
    parts = mesh("a.dae", texts.dae(unit=0.01, up=up))
    assert box(parts) == pytest.approx(np.array([[0, 0, 0], [1, 1, 1]]))
    assert box(parts) == pytest.approx(pinocchios(tmp_path / "pkg/meshes/a.dae")[0], abs=1e-6)


def test_nodes_of_a_library_are_placed_as_often_as_they_are_named(mesh):
    library = (
        '<library_nodes><node id="n"><instance_geometry url="#g"/></node>'
        '<node id="two"><instance_node url="#n"/><node><translate>0 0 5</translate><instance_node url="#n"/></node>'
        "</node></library_nodes>"
    )
    twice = '<node><instance_node url="#two"/></node><node><translate>3 0 0</translate><instance_node url="#n"/></node>'
    parts = mesh("a.dae", texts.dae(head=library, nodes=twice))
    assert volume(parts) == pytest.approx(3 / 6)
    assert box(parts) == pytest.approx(np.array([[0, 0, 0], [4, 1, 6]]))


def test_polygons_become_fans_of_triangles(mesh):
    square = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
    kinds = {
        "polylist": "<vcount>4 3</vcount><p>0 1 2 3 0 2 3</p>",
        "polygons": "<p>0 1 2 3</p><p>0 2 3</p>",
        "tristrips": "<p>0 1 3 2</p>",
        "trifans": "<p>0 1 2 3</p>",
    }
    for kind, numbers in kinds.items():
        primitives = f'<{kind} count="2"><input semantic="VERTEX" source="#v" offset="0"/>{numbers}</{kind}>'
        (part,) = mesh("a.dae", texts.dae(corners=square, primitives=primitives))
        assert len(part.faces) == (3 if kind.startswith("poly") else 2)
    (part,) = mesh("a.obj", b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf -4 -3 -2\n")
    assert len(part.faces) == 3


# --- colours

RED = "<diffuse><color>1 0 0 1</color></diffuse>"
SEEN = "<transparent {}><color>{}</color></transparent><transparency><float>{}</float></transparency>"
EFFECTS = {
    "diffuse": (RED, (1, 0, 0, 1)),
    "half transparent": (RED + SEEN.format("", "1 1 1 1", 0.5), (1, 0, 0, 0.502)),
    "by A_ONE": (RED + SEEN.format('opaque="A_ONE"', "0 0 0 0.8", 0.5), (1, 0, 0, 0.4)),
    "by RGB_ZERO": (RED + SEEN.format('opaque="RGB_ZERO"', "0.5 0.5 0.5 1", 0.8), (1, 0, 0, 0.6)),
    "unseen, as some programs write": (RED + SEEN.format("", "0 0 0 0", 0), (1, 0, 0, 1)),
    "light alone": ("<emission><color>0 0 1 1</color></emission>", (0, 0, 1, 1)),
    "none": ("<specular><color>1 1 1 1</color></specular>", None),
    "junk": ("<diffuse><color>nan 7 x</color></diffuse>", None),
}


@pytest.mark.parametrize(("effect", "color"), EFFECTS.values(), ids=EFFECTS)
def test_an_effect_of_a_dae_is_a_colour(mesh, effect, color):
    (part,) = mesh("a.dae", texts.dae(effects={"a": effect}))
    assert part.color == (color if color is None else pytest.approx(color, abs=1e-4))


def test_two_materials_of_one_geometry_are_two_parts_and_equal_ones_one(mesh):
    green = RED.replace("1 0 0", "0 1 0")
    parts = mesh("a.dae", texts.dae(effects={"a": RED, "b": green}))
    assert [(part.color, len(part.faces)) for part in parts] == [((1, 0, 0, 1), 2), ((0, 1, 0, 1), 2)]
    assert volume(parts) == pytest.approx(1 / 6)
    (part,) = mesh("a.dae", texts.dae(effects={"a": RED, "b": RED}))
    assert len(part.faces) == 4


def test_materials_of_an_obj_come_from_its_mtl(mesh):
    mtl = b"newmtl red\nKd 1 0 0\nnewmtl glass\nKd 0 0 1\nd 0.4\n"
    content = texts.obj(before="mtllib a.mtl\nusemtl red", between="usemtl glass")
    parts = mesh("a.obj", content, {"a.mtl": mtl})
    assert {part.color for part in parts} == {(1, 0, 0, 1), (0, 0, 1, 0.4)}
    (part,) = mesh("b.obj", content.replace(b"a.mtl", b"missing.mtl"))
    assert (part.color, len(part.faces)) == (None, 4)


def test_colours_of_gltf_are_light_and_the_screens_are_not(mesh):
    materials = [{"pbrMetallicRoughness": {"baseColorFactor": [0.2140411, 1, 0, 0.6]}}]
    meshes = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]
    (part,) = mesh("a.glb", texts.glb(meshes=meshes, materials=materials))
    assert part.color == pytest.approx((0.5, 1, 0, 0.6), abs=3e-3)


@pytest.mark.parametrize("at", ["a.png", "textures/a.png", "../textures/a.png", "a.jpg", "a.tga"])
def test_a_texture_becomes_its_mean_colour(mesh, picture, at):
    data = {at: picture(at.rpartition("/")[2])}
    mean = pytest.approx((0.5, 0, 0.5, 1), abs=0.02)
    (part,) = mesh("a.dae", texts.dae(effects={"a": at}), data)
    assert part.color == mean
    mtl = f"newmtl a\nKd 1 1 1\nmap_Kd {at}\n".encode()
    (part,) = mesh("a.obj", texts.obj(before="mtllib a.mtl\nusemtl a"), {"a.mtl": mtl, **data})
    assert part.color == mean
    tree, buffer = texts.gltf_tree(
        images=[{"uri": at}],
        textures=[{"source": 0}],
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    )
    tree["meshes"][0]["primitives"][0]["material"] = 0
    tree["buffers"][0]["uri"] = "a.bin"
    (part,) = mesh("a.gltf", json.dumps(tree).encode(), {"a.bin": buffer, **data})
    assert part.color == mean


@pytest.mark.parametrize("data", [None, b"", b"no picture", b"\x89PNG\r\n\x1a\n" + b"\0" * 40])
def test_a_picture_that_is_missing_or_none_leaves_the_mesh_without_colour(mesh, data, capfd):
    beside = {} if data is None else {"a.png": data}
    (part,) = mesh("a.dae", texts.dae(effects={"a": "a.png"}), beside)
    assert (part.color, len(part.faces)) == (None, 4)
    assert capfd.readouterr() == ("", "")


# --- what is left out, and what is made fewer


def test_triangles_without_area_or_with_corners_that_are_no_numbers_are_left_out(mesh):
    corners = (*texts.CORNERS, (np.nan, 0, 0), (np.inf, 0, 0), (1e30, 0, 0), (0, 0, 0))
    faces = ((0, 2, 1), (0, 1, 4), (0, 5, 1), (0, 6, 2), (1, 1, 2), (0, 7, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
    for name, content in {
        "a.stl": texts.stl_text(faces, corners),
        "b.stl": texts.stl_bytes(faces, corners),
        "a.obj": texts.obj(faces, corners),
        "a.dae": texts.dae(faces, corners),
        "a.glb": texts.glb(faces, corners),
    }.items():
        (part,) = mesh(name, content)
        assert (part.vertices.shape, part.faces.shape) == ((4, 3), (4, 3)), name
        assert volume([part]) == pytest.approx(1 / 6)


def test_triangles_that_draco_compresses_are_those_of_the_plain_file(mesh):
    """Draco rounds to 14 bits of the longest side."""
    pytest.importorskip("DracoPy")
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=2, radius=0.3)
    plain, packed = (
        mesh(f"{kind}.glb", ball.export(file_type="glb", extension_draco=kind == "packed"))[0]
        for kind in ("plain", "packed")
    )
    assert len(packed.faces) == len(plain.faces) == len(ball.faces)
    assert np.linalg.norm(packed.vertices, axis=1) == pytest.approx(np.full(len(packed.vertices), 0.3), abs=1e-4)
    assert volume([packed]) == pytest.approx(volume([plain]), rel=1e-3)
