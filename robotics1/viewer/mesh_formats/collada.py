"""Parts of a COLLADA file, read by pycollada.

As in Pinocchio's own reader, the unit of length and the upward axis that the file declares change nothing: files for
robots are in metres, with the link's own axes, whatever they declare.
"""

import io
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import MissingExtraError, RobotFileError
from robotics1.inputs import Array
from robotics1.robot.markup import Element, decoded, parse_xml, undeclared
from robotics1.robot.visuals import Color
from robotics1.viewer.mesh_formats.colors import INVISIBLE, image_mean, screen_color
from robotics1.viewer.mesh_formats.neighbours import LARGEST_FILE, Neighbours
from robotics1.viewer.mesh_parts import MeshPart, part_at

MOST_INSTANCES = 2000  # of nodes in nodes: pycollada looks for them again and again
NAN = re.compile(r"(?<=[\s>])[-+]?nan(?=[\s<])", re.IGNORECASE)
MATERIAL = re.compile(r'<(?:\w+:)?instance_material\b[^>]*?\btarget="#([^"]*)"')
LUMINANCE = np.array([0.212671, 0.715160, 0.072169])  # of red, green and blue, by the COLLADA specification


def collada_parts(data: bytes, neighbours: Neighbours) -> list[MeshPart]:
    """Return the parts that the scene of a COLLADA file places; where a material is broken, they have no colour.

    Raises:
        ValueError: it is no COLLADA file, or takes too much memory.
        MissingExtraError: pycollada is not installed.
    """
    try:
        text = undeclared(decoded(data, Path()))
        _check(parse_xml(text, Path(), largest=LARGEST_FILE))
    except RobotFileError as error:
        raise ValueError(error.message) from error
    text = NAN.sub("inf", text)  # pycollada would put NaN to 0
    document = _document(text, neighbours)
    if document.errors and (broken := set(MATERIAL.findall(text)) - {material.id for material in document.materials}):
        document = _document(_with_materials(text, broken), neighbours)  # else it leaves out what is made of them
    parts = list(_placed(document.scene.nodes, np.eye(4), {})) if document.scene else []
    if document.errors and not parts:
        raise ValueError(str(document.errors[0]))
    return parts


def _document(text: str, neighbours: Neighbours) -> Any:
    """Return what pycollada reads; what it leaves out is in its `errors`."""
    try:
        from collada import Collada, DaeError
    except ImportError as error:
        raise MissingExtraError("pycollada", "viewer") from error
    return Collada(io.BytesIO(text.encode()), ignore=[DaeError], aux_file_loader=neighbours.get)


def _with_materials(text: str, names: Iterable[str]) -> str:
    """Return the text with a material without colour for each name."""
    before, _, end = text.rpartition("</")
    made = "".join(f'<material id="{name}"><instance_effect url="#_plain"/></material>' for name in names)
    effect = (
        '<effect id="_plain"><profile_COMMON><technique sid="common"><phong/></technique></profile_COMMON></effect>'
    )
    more = f"<library_effects>{effect}</library_effects><library_materials>{made}</library_materials>"
    within = end.partition("COLLADA")[0]
    return before + re.sub("<(/?)(?=[a-z])", rf"<\1{within}", more) + "</" + end


def _placed(nodes: Iterable[Any], T: Array, colors: dict[int, Color | None]) -> Iterator[MeshPart]:
    """Return the parts of nodes that stand at T, and of those below them; `colors` are those of known effects."""
    from collada.polylist import Polylist
    from collada.scene import GeometryNode, Node
    from collada.triangleset import TriangleSet

    for node in nodes:
        if isinstance(node, Node):
            yield from _placed(node.children or (), T @ node.matrix, colors)
        if not isinstance(node, GeometryNode):
            continue
        effects = {material.symbol: material.target.effect for material in node.materials if material.target}
        for primitive in node.geometry.primitives:
            triangles = primitive.triangleset() if isinstance(primitive, Polylist) else primitive
            if isinstance(triangles, TriangleSet) and triangles.vertex is not None:
                effect = effects.get(primitive.material)
                if id(effect) not in colors:
                    colors[id(effect)] = _color(effect)
                color = _of_corners(triangles) if effect is None else colors[id(effect)]
                yield part_at(triangles.vertex, triangles.vertex_index, T, color)


def _color(effect: Any) -> Color | None:
    """Return the colour of an effect: of its diffuse light, else of what it emits."""
    for light in () if effect is None else (effect.diffuse, effect.emission):
        if hasattr(light, "sampler"):
            if (mean := _texture(light)) is not None:
                return screen_color(np.r_[mean, _opacity(effect)])
        elif np.size(light) in (3, 4) and (light is effect.diffuse or max(light[:3]) > 0):
            return screen_color(np.r_[light[:3], _opacity(effect)])
    return None


def _texture(light: Any) -> Array | None:
    """Return the mean colour (3,) of a texture, or None where it cannot be read."""
    from PIL import Image

    try:
        with Image.open(io.BytesIO(light.sampler.surface.image.data)) as image:
            return image_mean(image)
    except Exception:  # of a missing, refused or broken image, of whatever kind
        return None


def _opacity(effect: Any) -> float:
    """Return the opacity, by the mode that the file declares (COLLADA 1.4.1, chapter 7, "transparent")."""
    factor, light = effect.transparency, effect.transparent
    factor = float(factor) if isinstance(factor, float | int) else 1.0
    if np.size(light) != 4:
        return 1.0
    if effect.opaque_mode == "RGB_ZERO":
        opacity = 1 - factor * float(LUMINANCE @ np.array(light[:3]))
    else:
        opacity = factor * float(light[3])
    return opacity if opacity > INVISIBLE else 1.0


def _of_corners(triangles: Any) -> Color | None:
    """Return the mean of the colours of corners, where there are some."""
    for *_, source in triangles.sources.get("COLOR", ()):
        if np.ndim(source.data) == 2 and len(source.data) and source.data.shape[1] >= 3:
            return screen_color(np.r_[source.data[:, :3].mean(axis=0), 1.0])
    return None


# --- before pycollada sees it


def _check(root: Element) -> None:
    """Refuse a file whose nodes, placed one in another, would fill the memory.

    Raises:
        ValueError: they would, or it is no COLLADA file.
    """
    if not root.tag.endswith("COLLADA"):
        raise ValueError("its root is no <COLLADA>")
    within = root.tag[: -len("COLLADA")]
    if sum(1 for _ in root.iter(f"{within}instance_node")) > MOST_INSTANCES:
        raise ValueError(f"it has more than {MOST_INSTANCES} nodes in nodes")
    lengths = {geometry.get("id", ""): _length(geometry, within) for geometry in root.iter(f"{within}geometry")}
    nodes = {node.get("id", ""): node for node in root.iter(f"{within}node")}
    found: dict[int, int] = {}

    def length(node: Any) -> int:
        if id(node) not in found:
            found[id(node)] = LARGEST_FILE + 1  # of a node inside itself
            total = 1
            for child in node:
                kind, target = child.tag.removeprefix(within), child.get("url", "#")[1:]
                if kind == "node" or (kind == "instance_node" and target in nodes):
                    total += length(child if kind == "node" else nodes[target])
                elif kind == "instance_geometry":
                    total += 1 + lengths.get(target, 0)
            found[id(node)] = total
        return found[id(node)]

    if sum(length(scene) for scene in root.iter(f"{within}visual_scene")) > LARGEST_FILE:
        raise ValueError("its nodes place its geometries too often")


def _length(geometry: Any, within: str) -> int:
    """Return the length of the text of a geometry's triangles and polygons.

    Raises:
        ValueError: its polygons have more corners than are listed.
    """
    length = sum(len(p.text or "") for p in geometry.iter(f"{within}p"))
    corners = [int(count) for counts in geometry.iter(f"{within}vcount") for count in (counts.text or "").split()]
    if sum(corners) > length or min(corners, default=0) < 0:
        raise ValueError("its polygons have more corners than it lists")
    return length
