"""A page: one HTML file that needs no server and no network."""

import html
import json
from dataclasses import dataclass, field
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path
from string import Template
from typing import Any

from robotics1.errors import InputError, MissingExtraError
from robotics1.files import write_file
from robotics1.names import printable
from robotics1.other_words import names_what_is_meant

SCRIPTS = (
    *("linear", "kinematics", "inverse", "stage", "drawing", "motion"),
    *("panel", "gizmo", "drags", "handle", "abilities", "solutions", "voxels", "plots", "main"),
)
OTHER_KINDS = (".png", ".jpg", ".jpeg", ".svg", ".pdf", ".gif", ".mp4", ".urdf", ".xacro", ".py", ".csv", ".json")
HEIGHT = 620  # of a page in a notebook [px]


@names_what_is_meant
@dataclass(frozen=True)
class Page:
    """A page that shows a robot.

    A notebook shows it inline.

    Attributes:
        file: where it is written; None if it is not.
        title: its title.
        html: its text.
    """

    file: Path | None
    title: str
    html: str = field(repr=False)

    def save(self, file: str | Path) -> "Page":
        """Write the page, one offline HTML file, and return it with its file.

        Raises:
            InputError: the file has the suffix of another kind, or cannot be written there.
        """
        if isinstance(file, str | Path) and Path(file).suffix.lower() in OTHER_KINDS:
            raise InputError(f"a page is written as .html; the file is {str(file)!r}")
        return Page(write_file(file, self.html), self.title, self.html)

    def _repr_html_(self) -> str:
        """Return the page in a frame of its own, for a notebook."""
        return f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="{HEIGHT}" style="border:0"></iframe>'


def page_of(data: dict[str, Any], *, title: str, caption: str, notes: str, file: str | Path | None) -> Page:
    """Return a page of what `main.js` draws, and write it if there is a file.

    Raises:
        MissingExtraError: Meshcat, whose Three.js draws the scene, is not installed.
        InputError: the file cannot be written there.
    """
    folder = files("robotics1.viewer") / "page"
    text = Template((folder / "page.html").read_text(encoding="utf-8")).substitute(
        title=html.escape(printable(title)),
        caption=html.escape(printable(caption, keep="\n")),
        notes=html.escape(printable(notes, keep="\n")),
        style=(folder / "style.css").read_text(encoding="utf-8"),
        script="\n".join((folder / f"{name}.js").read_text(encoding="utf-8") for name in SCRIPTS),
        meshcat=_meshcat(),
        data=_json(data),
    )
    page = Page(None, title, text)
    return page if file is None else page.save(file)


def _meshcat() -> str:
    """Return Meshcat's script: the file is read without an import, which would start ZeroMQ and Tornado."""
    package = find_spec("meshcat")
    if package is None or package.origin is None:
        raise MissingExtraError("meshcat", "viewer")
    return (Path(package.origin).parent / "viewer" / "dist" / "main.min.js").read_text(encoding="utf-8")


def _json(data: dict[str, Any]) -> str:
    """Return data as JSON in which no name can end the element that it stands in."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("&", "\\u0026").replace("<", "\\u003c").replace(">", "\\u003e")
