"""The pages as a site, which `make docs` builds: Markdown by MyST, the reference from the docstrings."""

import re
import sys
from importlib.metadata import version as version_of
from pathlib import Path

from sphinx.util import logging

sys.path.insert(0, str(Path(__file__).parent))

import api_pages
import gallery

project = "robotics1"
author = "The robotics1 developers"
release = version = version_of("robotics1")

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
myst_enable_extensions = ["colon_fence"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = "robotics1"
html_static_path = ["_made"]
html_show_sourcelink = False
html_show_copyright = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0b7285", "color-brand-content": "#0b7285"},
    "dark_css_variables": {"color-brand-primary": "#66c6d8", "color-brand-content": "#66c6d8"},
}

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the text tells shapes and units; types would be longer than it
autodoc_default_options = {"members": True, "inherited-members": False}
napoleon_custom_sections = [("Source", "notes_style"), ("Warns", "notes_style")]
napoleon_use_ivar = True
default_role = "literal"


def escaped(app: object, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    """Let a docstring be text: |e|, q* and J_ mean nothing to the site, and what a call names is code."""
    for i, line in enumerate(lines):
        parts = re.split(r"(`[^`]*`)", line)
        text = [
            f"`{part}`" if part.startswith("`") else re.sub(r"([*|\\])|(?<=\w)(_)(?!\w)", r"\\\1\2", part)
            for part in parts
        ]
        lines[i] = "".join(text)
    if what in ("property", "attribute"):
        lines[:0] = ["..", ""]  # an empty remark; else Napoleon takes what stands before a colon for a type


def without_links_to_the_sources(app: object, name: str, source: list[str]) -> None:
    """Write a link to a file beside docs/ as its text: the site has the pages of docs/ alone."""
    folder = Path(__file__).parent
    for text, target in re.findall(r"\[([^]]+)\]\((\.\./[^)#]+)\)", source[0]):
        if not (folder / target).exists():
            logging.getLogger(__name__).warning("%s links to %s, which is not there", name, target)
        source[0] = source[0].replace(f"[{text}]({target})", f"{text} (in the sources)")


def setup(app: object) -> None:
    """Make the pages of the reference and the pictures, then read all pages."""
    made = Path(__file__).parent / "_made"
    api_pages.write(Path(__file__).parent / "reference")
    gallery.draw(made)
    app.connect("source-read", without_links_to_the_sources)  # type: ignore[attr-defined]
    app.connect("autodoc-process-docstring", escaped, priority=400)  # type: ignore[attr-defined]
