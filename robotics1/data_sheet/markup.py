"""A page and its pieces: paragraphs, tables, formulas, figures. Texts come from files, so that each is escaped here."""

import base64
import html
import re
from collections.abc import Callable, Iterable, Sequence
from importlib.resources import files
from string import Template
from typing import Any, NamedTuple

from robotics1.errors import MissingExtraError
from robotics1.names import printable

READABLE = 400  # operations of a formula that is shown at once; a longer one is folded
MINUS = re.compile(r"(?<![\w.)-])-(?=\.?\d)")
DOT = "\N{COMBINING DOT ABOVE}"
LONGEST = 6000  # operations of a formula that is shown at all


def escaped(text: object) -> str:
    """Return a text that a page only shows, whatever it holds, with a minus sign before negative numbers."""
    return html.escape(MINUS.sub("−", printable(str(text), keep="\n")))


def paragraphs(*lines: str) -> str:
    """Return a paragraph for each line that is not empty."""
    return "\n".join(f"<p>{escaped(line)}</p>" for line in lines if line)


def sentences(text: str) -> str:
    """Return what an `explain()` says, a paragraph for each line, as far to the right as it is indented."""
    return f'<div class="sentences">{"".join(map(_sentence, text.splitlines()))}</div>'


def _sentence(line: str) -> str:
    words = line.strip()
    depth = (len(line) - len(line.lstrip()) + 2) // 3
    if words.startswith("- "):
        return f'<p class="item in-{depth}">{escaped(words[2:])}</p>'
    return f'<p class="in-{depth}">{escaped(words)}</p>' if words else ""


def note(text: str) -> str:
    """Return a remark about how sure an answer is, or what could not be done."""
    return f'<p class="note">{escaped(text)}</p>'


def table(headings: Sequence[str], rows: Iterable[Sequence[object]], caption: str = "") -> str:
    """Return a table of texts, which scrolls on a narrow screen; its first column names the row."""
    head = "".join(f'<th scope="col">{escaped(heading)}</th>' for heading in headings)
    body = "\n".join(_row(row) for row in rows)
    title = f"<caption>{escaped(caption)}</caption>" if caption else ""
    return f'<div class="wide"><table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _row(cells: Sequence[object]) -> str:
    first, *others = (escaped(cell) for cell in cells)
    return f'<tr><th scope="row">{first}</th>' + "".join(f"<td>{cell}</td>" for cell in others) + "</tr>"


def equation(symbol: str, formula: Any) -> str:
    """Return symbol = formula as MathML, with cᵢ and sᵢ for cos qᵢ and sin qᵢ; a longer formula is folded."""
    import sympy

    from robotics1.symbolic.writing.printing import mathml_text

    length = int(sympy.count_ops(formula))
    if length > LONGEST:
        return note(f"{symbol} has {length} operations: too long to be read.")
    left = f'<p class="symbol">{_subscripted(symbol)} =</p>' if symbol else ""
    shown = f'<div class="equation">{left}<div class="wide">{mathml_text(formula, short=True)}</div></div>'
    return shown if length <= READABLE else folded(f"{symbol}, {length} operations", shown)


def _subscripted(symbol: str) -> str:
    """Return q1 as q with the index 1, q_next as q with the index next, qdot as q with a dot, tau as τ."""
    simple = re.fullmatch(r"([A-Za-z]+?)(?:_?(\d+)|_(\w+))?", symbol)
    if simple is None:
        return re.sub(r"^([A-Za-z])(\d+)", r"\1<sub>\2</sub>", escaped(symbol))
    name, number, word = simple.groups(default="")
    name = {"tau": "τ"}.get(name, name[0] + DOT if name.endswith("dot") and len(name) == 4 else name)
    return f"{escaped(name)}<sub>{escaped(number + word)}</sub>" if number + word else escaped(name)


def folded(summary: str, content: str) -> str:
    """Return content that opens with a click on its summary."""
    return f"<details><summary>{escaped(summary)}</summary>{content}</details>"


def figure(draw: Callable[[], Any], caption: str) -> str:
    """Return the figure of the axes that are drawn, as a picture that is part of the page; or what it needs."""
    from robotics1.plots.figures import picture

    try:
        axes = draw()
    except MissingExtraError as error:
        return note(f"There is no figure: {error}.")
    data = base64.b64encode(picture(axes, ".svg")).decode("ascii")
    text = escaped(caption)
    image = f'<div class="wide"><img alt="{text}" src="data:image/svg+xml;base64,{data}"></div>'
    return f"<figure>{image}<figcaption>{text}</figcaption></figure>"


# --- the page that a sheet or a worked exam is laid out on: a title, what matters at a glance, and parts with links


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
