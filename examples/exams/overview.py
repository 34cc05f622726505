"""The first page of a worked exam: the published values, the figures, the answers, and the way to the other pages."""

import base64
import html
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

from robotics1.files import write_file

from .comparison import Check, Comparison


def write_overview(
    path: Path, *, title: str, comparison: Comparison, answers: str, pages: Mapping[str, Path], figures: Sequence[Path]
) -> Path:
    """Write the page, and return its path.

    Args:
        path: the file; the pages are in its folder.
        title: of the exam.
        comparison: the published values beside the computed ones.
        answers: the worked answers as text.
        pages: what a page shows → its file.
        figures: SVG files, which become part of the page.

    Raises:
        InputError: the file cannot be written there.
    """
    template = Template((files(__package__) / "overview.html").read_text(encoding="utf-8"))
    failures = comparison.failures()
    verdict = f"{len(failures)} published values are not" if failures else "Every published value is"
    text = template.substitute(
        title=html.escape(title),
        verdict=f"{verdict} reproduced.",
        links="\n".join(map(_link, pages.items())),
        figures="\n".join(map(_figure, figures)),
        checks="\n".join(map(_row, comparison.checks)),
        answers=html.escape(answers),
    )
    return write_file(path, text)


def _link(page: tuple[str, Path]) -> str:
    name, file = page
    return f'<li><a href="{html.escape(file.name)}">{html.escape(name)}</a></li>'


def _figure(file: Path) -> str:
    data = base64.b64encode(file.read_bytes()).decode("ascii")
    name = html.escape(file.stem.replace("-", " "))
    return f'<figure><img alt="{name}" src="data:image/svg+xml;base64,{data}"><figcaption>{name}</figcaption></figure>'


def _row(check: Check) -> str:
    computed = check.computed if isinstance(check.computed, str) else f"{check.computed:.6g}"
    cells = (check.exercise, check.name, check.printed, computed, check.agreement or "differs")
    kind = "" if check.holds else ' class="differs"'
    return f"<tr{kind}>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>"
