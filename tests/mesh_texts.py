"""Tiny mesh files, each written by hand: a tetrahedron with corners 0, x, y, z of length one, in every format."""

import json
import struct

CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))  # anticlockwise from outside: the volume is +1/6
VERTEX = '<input semantic="VERTEX" source="#v" offset="0"/>'


def stl_text(faces=FACES, corners=CORNERS):
    loops = "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*corners[corner]) for corner in face)
        + "endloop\nendfacet\n"
        for face in faces
    )
    return f"solid tetrahedron\n{loops}endsolid tetrahedron\n".encode()


def stl_bytes(faces=FACES, corners=CORNERS):
    rows = b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for corner in face for x in corners[corner]), 0) for face in faces
    )
    return b"a binary file".ljust(80) + struct.pack("<I", len(faces)) + rows


def obj(faces=FACES, corners=CORNERS, before="", between=""):
    """An OBJ file; `between` stands before the last two faces."""
    rows = [f"f {' '.join(str(corner + 1) for corner in face)}" for face in faces]
    points = [f"v {x} {y} {z}" for x, y, z in corners]
    return "\n".join([before, *points, *rows[:-2], between, *rows[-2:], ""]).encode()


def dae(
    faces=FACES, corners=CORNERS, *, nodes=None, head="", effects=None, unit=1, up="Z_UP", primitives="", doctype=""
):
    """A COLLADA file with the geometry g; `effects` are name → what stands in <phong>, one for half of the faces."""
    effects = effects or {}
    symbols = list(effects) or [None]
    half = len(faces) // len(symbols)
    numbers = " ".join(str(x) for corner in corners for x in corner)
    primitives = primitives or "".join(
        triangles(faces[i * half : (i + 1) * half], symbol) for i, symbol in enumerate(symbols)
    )
    bound = "".join(f'<instance_material symbol="{s}" target="#{s}-m"/>' for s in effects)
    bound = f"<bind_material><technique_common>{bound}</technique_common></bind_material>" if effects else ""
    placed = f'<instance_geometry url="#g">{bound}</instance_geometry>'
    nodes = f"<node>{placed}</node>" if nodes is None else nodes.replace("GEOMETRY", placed)
    drawn = "".join(f'<effect id="{s}-e">{_effect(text)}</effect>' for s, text in effects.items())
    made = "".join(f'<material id="{s}-m"><instance_effect url="#{s}-e"/></material>' for s in effects)
    params = "".join(f'<param name="{axis}" type="float"/>' for axis in "XYZ")
    return f"""<?xml version="1.0" encoding="utf-8"?>{doctype}
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="{unit}" name="u"/><up_axis>{up}</up_axis></asset>{head}
  <library_effects>{drawn}</library_effects>
  <library_materials>{made}</library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="a" count="{3 * len(corners)}">{numbers}</float_array><technique_common>
      <accessor source="#a" count="{len(corners)}" stride="3">{params}</accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    {primitives}
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>""".encode()


def triangles(faces, symbol=None):
    material = f'material="{symbol}"' if symbol else ""
    numbers = " ".join(str(corner) for face in faces for corner in face)
    return f'<triangles {material} count="{len(faces)}">{VERTEX}<p>{numbers}</p></triangles>'


def _effect(text):
    """A technique; of a texture, with the image that it shows."""
    texture = ""
    if text.endswith((".png", ".jpg", ".tga", ".eps")):
        texture = (
            f'<image id="i"><init_from>{text}</init_from></image>'
            '<newparam sid="surface"><surface type="2D"><init_from>i</init_from></surface></newparam>'
            '<newparam sid="sampler"><sampler2D><source>surface</source></sampler2D></newparam>'
        )
        text = '<diffuse><texture texture="sampler" texcoord="t"/></diffuse>'
    return f'<profile_COMMON>{texture}<technique sid="common"><phong>{text}</phong></technique></profile_COMMON>'


def gltf_tree(faces=FACES, corners=CORNERS, **changes):
    """The JSON of a glTF file, and the bytes of its buffer."""
    points = b"".join(struct.pack("<3f", *corner) for corner in corners)
    numbers = b"".join(struct.pack("<3I", *face) for face in faces)
    tree = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3 * len(faces), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
            {"buffer": 0, "byteOffset": len(points), "byteLength": len(numbers)},
        ],
        "buffers": [{"byteLength": len(points) + len(numbers)}],
    }
    return tree | changes, points + numbers


def glb(*args, **changes):
    tree, data = gltf_tree(*args, **changes)
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks
