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
    path: str | Path,
    commands: Sequence[bytes],
    *,
    title: str,
    caption: str,
    duration: float,
    camera: Array,
    look_at: Array,
) -> Path:
    """Write the page that plays back Meshcat commands, and return its path.

    Args:
        path: the file to write.
        commands: the packed commands, in order.
        title: shown in the corner.
        caption: the lines under it.
        duration: of the motion [s]; with 0 there are no controls.
        camera, look_at: (3,) where the camera is and what it looks at, in world axes [m].

    Raises:
        InputError: the file cannot be written there.
    """
    import meshcat

    library = Path(meshcat.__file__).parent / "viewer" / "dist" / "main.min.js"
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


def _three(p: Array) -> list[float]:
    """Return a world position in the axes of Meshcat's camera, whose y is the world's z."""
    x, y, z = (float(v) for v in np.asarray(p))
    return [x, z, -y]
