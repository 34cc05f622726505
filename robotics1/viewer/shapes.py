"""The shapes to draw, as the page wants them: plain shapes by their sizes, meshes packed."""

import base64
import zlib
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from robotics1.errors import InputError, warn
from robotics1.robot.model import Robot
from robotics1.robot.visuals import MeshFile, Visual, read_visuals
from robotics1.viewer.arm_data import placement
from robotics1.viewer.mesh_parts import MeshPart
from robotics1.viewer.meshes import read_mesh
from robotics1.viewer.skeleton import skeleton

GREY = (0.72, 0.75, 0.78, 1.0)  # of a shape without a colour
STEPS = 65535  # between the least and the largest coordinate of a mesh: a corner is three numbers of 16 bits
NO_SHAPES = "The robot's file has no shapes: a skeleton is drawn."
INSTEAD = "The robot's skeleton is drawn instead."
HOW_TO_FIND = "Its packages are looked for in the folders packages=[...], or --packages."


@dataclass
class Shapes:
    """The shapes of the robots of a page; a mesh that several links have is packed once.

    Attributes:
        meshes: the packed meshes.
        notes: what the page does not show, in sentences.
    """

    meshes: list[dict[str, Any]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    _known: dict[str, list[tuple[int, MeshPart]]] = field(default_factory=dict)

    def of(self, robot: Robot) -> list[dict[str, Any]]:
        """Return the shapes of a robot, with those of its skeleton if some, or all, cannot be drawn.

        Warns:
            RobotWarning: a mesh was not found or cannot be read, and is not drawn.
        """
        visuals = read_visuals(robot)
        shapes = [shape for visual in visuals for shape in self._drawn(visual)]
        unread = any(isinstance(v.shape, MeshFile) and v.shape.found and not self._parts(v.shape) for v in visuals)
        missing = [warning for warning in robot.warnings if warning.startswith("mesh ")]
        if missing:
            more = f" (and {len(missing) - 1} more)" if len(missing) > 1 else ""
            self._warn(f"{missing[0]}{more}. {HOW_TO_FIND} {INSTEAD}")
        elif not shapes and not unread:
            self.note(NO_SHAPES)
        if missing or unread or not shapes:
            shapes += [shape for visual in skeleton(robot) for shape in self._drawn(visual)]
        return shapes

    def _drawn(self, visual: Visual) -> list[dict[str, Any]]:
        """Return a plain shape, or the parts of a mesh: in their own colours, else in that of the robot's file."""
        shape = visual.shape
        if isinstance(shape, MeshFile):
            colored = ((number, part.color or visual.color or GREY) for number, part in self._parts(shape))
            scale = list(shape.scale)
            return [{**_shape(visual, "mesh", color), "mesh": n, "scale": scale} for n, color in colored]
        size = np.ravel(list(vars(shape).values())).tolist()  # its fields: radius and length, or the sides
        return [{**_shape(visual, type(shape).__name__.lower(), visual.color or GREY), "size": size}]

    def _parts(self, mesh: MeshFile) -> list[tuple[int, MeshPart]]:
        """Return the parts of a mesh with their numbers; none of one that cannot be read, which a warning names."""
        if not mesh.found:
            return []
        if mesh.path not in self._known:
            try:
                parts = read_mesh(mesh.path)
            except InputError as error:
                self._warn(f"{error}, so it is not drawn. {INSTEAD}")
                parts = ()
            first = len(self.meshes)
            self.meshes += [packed(part) for part in parts]
            self._known[mesh.path] = list(enumerate(parts, first))
        return self._known[mesh.path]

    def _warn(self, sentence: str) -> None:
        warn(sentence)
        self.note(f"{sentence[0].upper()}{sentence[1:]}")

    def note(self, sentence: str) -> None:
        """Keep a sentence that the page shows, once."""
        if sentence and sentence not in self.notes:
            self.notes.append(sentence)


def packed(part: MeshPart) -> dict[str, Any]:
    """Return corners as 16-bit numbers between least and largest, then triangles, compressed."""
    corners = np.asarray(part.vertices, dtype=float)
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = np.where(high > low, high - low, 1.0)
    near = np.round((corners - low) / size * STEPS).astype("<u2")
    faces = np.ascontiguousarray(part.faces, dtype="<u2" if len(corners) <= STEPS else "<u4")
    start = near.tobytes()
    if faces.itemsize == 4:
        start += b"\0" * (-len(start) % 4)
    return {
        "corners": len(corners),
        "triangles": len(faces),
        "min": low.tolist(),
        "max": (low + size).tolist(),
        "data": base64.b64encode(zlib.compress(start + faces.tobytes(), 9)).decode("ascii"),
    }


def _shape(visual: Visual, kind: str, color: tuple[float, ...]) -> dict[str, Any]:
    return {
        "joint": visual.joint - 1,
        "kind": kind,
        "placement": placement(visual.placement),
        "color": [min(1.0, max(0.0, part)) for part in color],
        "link": visual.link,
    }
