"""The page that a sheet or a worked exam is laid out on: a title, what matters at a glance, and parts with links."""

from collections.abc import Sequence
from importlib.resources import files
from string import Template
from typing import NamedTuple

from robotics1.data_sheet.markup import escaped


class Part(NamedTuple):
    """A part of a page: its name in addresses, its title, its HTML, and a sentence for the table at the top."""

    name: str
    title: str
    html: str
    fact: str = ""


def laid_out(title: str, subtitle: str, parts: Sequence[Part]) -> str:
    """Return the page; titles, the subtitle and facts are texts, and are escaped here."""
    folder = files("robotics1.data_sheet") / "page"
    links = [(part, f'<a href="#{part.name}">{escaped(part.title)}</a>') for part in parts]
    return Template((folder / "sheet.html").read_text(encoding="utf-8")).substitute(
        title=escaped(title),
        style=(folder / "sheet.css").read_text(encoding="utf-8"),
        subtitle=escaped(subtitle),
        links="".join(f"<li>{link}</li>" for _, link in links),
        facts="".join(
            f'<tr><th scope="row">{link}</th><td>{escaped(part.fact)}</td></tr>' for part, link in links if part.fact
        ),
        sections="\n".join(
            f'<section id="{part.name}"><h2>{escaped(part.title)}</h2>{part.html}</section>' for part in parts
        ),
    )
