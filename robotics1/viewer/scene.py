"""A Meshcat scene made in this process: every call to Meshcat is here.

Meshcat's stock server listens on all interfaces and runs as a second process. A scene needs neither: its window
only collects the commands, in order, and a page plays them back.
"""

from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import pinocchio as pin

from robotics1.errors import MissingExtraError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.viewer.visuals import drawable_visuals

Color = tuple[float, float, float]


class Command(Protocol):
    """A Meshcat command."""

    def lower(self) -> dict[str, Any]:
        """Return the command as plain data."""


class Window:
    """Stands where Meshcat expects its server: keeps the commands, packed."""

    def __init__(self) -> None:
        self.commands: list[bytes] = []

    def send(self, command: Command) -> None:
        """Keep a command."""
        import umsgpack

        self.commands.append(umsgpack.packb(command.lower()))


@dataclass
class Scene:
    """A robot, balls and rods, and how they move.

    Attributes:
        robot: drawn from its URDF's visuals.
        frame_rate: frames of the animation a second.
    """

    robot: Robot
    frame_rate: float = 60.0
    window: Window = field(default_factory=Window)

    def __post_init__(self) -> None:
        """Draw the robot."""
        try:
            import meshcat
            from meshcat.animation import Animation
            from pinocchio.visualize import MeshcatVisualizer
        except ImportError as error:
            raise MissingExtraError("meshcat", "viewer") from error
        self._viewer = meshcat.Visualizer(window=self.window)
        self._animation = Animation(default_framerate=self.frame_rate)
        self._display = MeshcatVisualizer(self.robot.model, None, drawable_visuals(self.robot))
        self._display.initViewer(viewer=self._viewer)
        self._display.loadViewerModel("robot")
        self._viewer["/Grid"].set_property("visible", False)
        self._viewer["/Background"].set_property("top_color", [0.97, 0.98, 1.0])
        self._viewer["/Background"].set_property("bottom_color", [0.82, 0.86, 0.91])

    def pose(self, q: Array, frame: int | None = None) -> None:
        """Put the robot at q: at once, or at a frame of the animation."""
        display = self._display
        pin.forwardKinematics(display.model, display.data, q)
        pin.updateGeometryPlacements(display.model, display.data, display.visual_model, display.visual_data)
        for visual, placement in zip(display.visual_model.geometryObjects, display.visual_data.oMg, strict=True):
            matrix = placement.homogeneous @ np.diag([*visual.meshScale, 1.0])
            self._place(display.getViewerNodeName(visual, pin.GeometryType.VISUAL), matrix, frame)

    def ball(self, name: str, radius: float, color: Color) -> None:
        """Add a ball at the origin."""
        from meshcat.geometry import MeshPhongMaterial, Sphere

        self._viewer[name].set_object(Sphere(radius), MeshPhongMaterial(color=_hexadecimal(color)))

    def move(self, name: str, position: Array, frame: int | None = None) -> None:
        """Put an object at a position (3,) [m]: at once, or at a frame of the animation."""
        matrix = np.eye(4)
        matrix[:3, 3] = position
        self._place(name, matrix, frame)

    def dots(self, name: str, points: Array, radius: float, color: Color) -> None:
        """Add a row of small balls at the points (k, 3) [m]."""
        for number, point in enumerate(points):
            self.ball(f"{name}/{number}", radius, color)
            self.move(f"{name}/{number}", point)

    def rod(self, name: str, start: Array, end: Array, radius: float, color: Color) -> None:
        """Add a rod between two points (3,) [m]: WebGL draws lines one pixel wide, which are hard to see."""
        from meshcat.geometry import Cylinder, MeshPhongMaterial

        along = end - start
        length = max(float(np.linalg.norm(along)), 1e-9)
        turn = pin.Quaternion.FromTwoVectors(np.array([0.0, 1.0, 0.0]), along / length).toRotationMatrix()
        self._viewer[name].set_object(Cylinder(length, radius), MeshPhongMaterial(color=_hexadecimal(color)))
        self._viewer[name].set_transform(pin.SE3(turn, (start + end) / 2).homogeneous)

    def corners(self) -> Array:
        """Return the corners (k, 3) [m] of the boxes round the robot's visuals, where it was last put."""
        found = [np.zeros((1, 3))]
        for visual, placement in zip(
            self._display.visual_model.geometryObjects, self._display.visual_data.oMg, strict=True
        ):
            visual.geometry.computeLocalAABB()
            box = visual.geometry.aabb_local
            sides = np.array([box.min_, box.max_]) * visual.meshScale
            corners = np.array(np.meshgrid(*sides.T)).reshape(3, -1)
            found.append((placement.rotation @ corners).T + placement.translation)
        return np.vstack(found)

    def appear(self, name: str, frame: int, last: int) -> None:
        """Let an object be invisible before a frame of the animation, and visible from it to the last."""
        keys = {0: frame == 0, frame: True, last: True}
        for number, visible in keys.items():
            at = self._animation.at_frame(self._viewer, number)
            at[name].set_property("visible", "boolean", visible)
        self._viewer[name].set_property("visible", frame == 0)

    def animate(self) -> None:
        """Send the animation, to be played over and over."""
        self._viewer.set_animation(self._animation, play=True, repetitions=10**6)

    def _place(self, name: str, matrix: Array, frame: int | None) -> None:
        if frame is None:
            self._viewer[name].set_transform(matrix)
        else:
            self._animation.at_frame(self._viewer, frame)[name].set_transform(matrix)


def _hexadecimal(color: Color) -> int:
    red, green, blue = (round(255 * part) for part in color)
    return red << 16 | green << 8 | blue
