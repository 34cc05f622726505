"""Tables and sentences as a terminal and a notebook show them."""

from collections.abc import Callable, Iterable, Sequence
from html import escape
from typing import Any, NamedTuple

MORE: dict[str, list[Callable[[Any], str]]] = {}  # class → HTML of its objects that is made by rows above it
CELL = 'style="padding: 0.1em 0.8em; text-align: right"'


class Table(NamedTuple):
    """A table of texts.

    Attributes:
        headings: one for each column.
        rows: the texts below them.
        title: what stands above, or nothing.
    """

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    title: str = ""

    def text(self) -> str:
        """Return the table in columns, each as wide as its longest text."""
        lines = [self.headings, *self.rows]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        drawn = ["  ".join(cell.rjust(width) for cell, width in zip(line, widths, strict=True)) for line in lines]
        return "\n".join([*([self.title] if self.title else []), *drawn])

    def html(self) -> str:
        """Return the table as HTML. Texts from a file are escaped, so that nothing in them is markup."""
        head = "".join(f"<th {CELL}>{escape(heading)}</th>" for heading in self.headings)
        rows = ["".join(f"<td {CELL}>{escape(cell)}</td>" for cell in row) for row in self.rows]
        title = f"<caption>{escape(self.title)}</caption>" if self.title else ""
        body = "".join(f"<tr>{row}</tr>" for row in rows)
        return f"<table>{title}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def table_of(headings: Iterable[str], rows: Iterable[Iterable[str]], title: str = "") -> Table:
    """Return a table of any texts in order."""
    return Table(tuple(headings), tuple(map(tuple, rows)), title)


def in_text(sentences: str, tables: Sequence[Table]) -> str:
    """Return sentences and the tables below them."""
    return "\n\n".join([*([sentences] if sentences else []), *(table.text() for table in tables)])


def in_html(sentences: str, tables: Sequence[Table], *others: str) -> str:
    """Return sentences, which are escaped, the tables below them, and what is HTML already."""
    said = [f'<pre style="white-space: pre-wrap">{escape(sentences)}</pre>'] if sentences else []
    return "\n".join([*said, *(table.html() for table in tables), *others])
