"""Named formulas as one HTML page that needs no network and no script."""

import html
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path
from string import Template

from robotics1.errors import InputError
from robotics1.report.named_formulas import FormulaSection, NamedFormula
from robotics1.symbolic.writing.printing import mathml_text


def write_formula_page(path: str | Path, sections: Sequence[FormulaSection], *, title: str) -> Path:
    """Write the sections, their formulas as MathML, and return the page's path.

    Raises:
        InputError: the folder does not exist.
    """
    path = Path(path)
    if not path.parent.is_dir():
        raise InputError(f"there is no folder {path.parent}, so {path.name} cannot be written there")
    template = Template(files("robotics1.report").joinpath("formulas.html").read_text(encoding="utf-8"))
    text = template.substitute(title=html.escape(title), body="\n".join(map(_section, sections)))
    unfinished = path.with_name(path.name + ".part")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(path)
    return path


def _section(section: FormulaSection) -> str:
    return "\n".join(
        [
            "<section>",
            f"<h2>{html.escape(section.title)}</h2>",
            *_paragraphs([section.given] if section.given else []),
            "<dl>",
            *map(_entry, section.formulas),
            "</dl>",
            *_paragraphs(section.numbers),
            "</section>",
        ]
    )


def _entry(formula: NamedFormula) -> str:
    number = f'<p class="number">= {html.escape(formula.number)}</p>' if formula.number else ""
    return f"<div><dt>{html.escape(formula.name)}</dt><dd>{mathml_text(formula.equation)}{number}</dd></div>"


def _paragraphs(lines: Sequence[str]) -> list[str]:
    return [f"<p>{html.escape(line)}</p>" for line in lines]
