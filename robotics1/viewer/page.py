"""A scene as one HTML file that needs no server and no network."""

import base64
import html
import json
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

import numpy as np

from robotics1.files import write_file
from robotics1.inputs import Array
from robotics1.names import printable


def write_page(
    path: str | Path, commands: Sequence[bytes], seen: Array, title: str, caption: str, *, duration: float
) -> Path:
    """Write the page that plays back Meshcat commands, and return its path.

    Args:
        path: the file to write.
        commands: the packed commands, in order.
        seen: (k, 3) the points that the camera must see [m].
        title: shown in the corner.
        caption: the lines under it.
        duration: of the motion [s]; with 0 there are no controls.

    Raises:
        InputError: the file cannot be written there.
    """
    import meshcat

    library = Path(meshcat.__file__).parent / "viewer" / "dist" / "main.min.js"
    camera, look_at = point_of_view(seen)
    template = Template(files("robotics1.viewer").joinpath("page.html").read_text(encoding="utf-8"))
    text = template.substitute(
        title=html.escape(printable(title)),
        caption=html.escape(printable(caption, keep="\n")),
        duration=json.dumps(duration),
        controls="flex" if duration > 0 else "none",
        meshcat=library.read_text(encoding="utf-8"),
        commands=json.dumps([base64.b64encode(command).decode() for command in commands]),
        camera=json.dumps(_three(camera)),
        lookat=json.dumps(_three(look_at)),
    )
    return write_file(path, text)


def point_of_view(seen: Array) -> tuple[Array, Array]:
    """Return where to put the camera and what to look at, (3,) each [m], so that the points (k, 3) are seen.

    What happens in a horizontal plane is seen from above, the rest from the side.
    """
    low, high = seen.min(axis=0), seen.max(axis=0)
    centre = (low + high) / 2
    size = max(float(np.linalg.norm(high - low)), 0.5)
    flat = high[2] - low[2] < 0.2 * size
    direction = np.array([0.0, -0.35, 1.0]) if flat else np.array([0.75, -1.0, 0.45])
    return centre + 0.66 * size * direction / np.linalg.norm(direction), centre


def _three(p: Array) -> list[float]:
    """Return a world position in the axes of Meshcat's camera, whose y is the world's z."""
    x, y, z = (float(v) for v in np.asarray(p))
    return [x, z, -y]
