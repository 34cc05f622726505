"""Named formulas as one HTML page that needs no network and no script."""

import html
from collections.abc import Sequence
from pathlib import Path
from string import Template

from robotics1.files import write_file
from robotics1.names import printable
from robotics1.symbolic.writing.printing import mathml_text

from .named_formulas import FormulaSection, NamedFormula


def write_formula_page(path: str | Path, sections: Sequence[FormulaSection], *, title: str) -> Path:
    """Write the sections, their formulas as MathML, and return the page's path.

    Raises:
        InputError: the file cannot be written there.
    """
    template = Template(Path(__file__).with_name("formulas.html").read_text(encoding="utf-8"))
    text = template.substitute(title=_escaped(title), body="\n".join(map(_section, sections)))
    return write_file(path, text)


def _section(section: FormulaSection) -> str:
    return "\n".join(
        [
            "<section>",
            f"<h2>{_escaped(section.title)}</h2>",
            *_paragraphs([section.given] if section.given else []),
            "<dl>",
            *map(_entry, section.formulas),
            "</dl>",
            *_paragraphs(section.numbers),
            "</section>",
        ]
    )


def _entry(formula: NamedFormula) -> str:
    number = f'<p class="number">= {_escaped(formula.number)}</p>' if formula.number else ""
    return f"<div><dt>{_escaped(formula.name)}</dt><dd>{mathml_text(formula.equation)}{number}</dd></div>"


def _escaped(text: str) -> str:
    return html.escape(printable(text))


def _paragraphs(lines: Sequence[str]) -> list[str]:
    return [f"<p>{_escaped(line)}</p>" for line in lines]
