"""Tables of the terminal: of texts, of a matrix, of an iteration as on paper."""

from collections.abc import Iterable, Sequence

from rich.table import Table

from robotics1.ik.iterate import IKIteration
from robotics1.inputs import Array
from robotics1.notation import number


def table(
    headings: Sequence[str], rows: Iterable[Sequence[str]], title: str = "", *, left: Sequence[str] = ("",)
) -> Table:
    """Return a table of texts; the columns whose headings are in `left` are aligned there, the others right."""
    made = Table(title=title or None, title_justify="left", show_header=any(map(str.strip, headings)))
    for heading in headings:
        made.add_column(heading, justify="left" if heading in left else "right")
    for row in rows:
        made.add_row(*row)
    return made


def matrix_table(values: Array, rows: tuple[str, ...] = (), columns: tuple[str, ...] = (), title: str = "") -> Table:
    """Return a matrix as a table with named rows and columns."""
    numbers = [[number(float(value)) for value in row] for row in values]
    headings = columns or (" ",) * values.shape[1]
    if not rows:
        return table(headings, numbers, title)
    return table(("", *headings), [(name, *row) for name, row in zip(rows, numbers, strict=True)], title)


def iteration_table(run: IKIteration, title: str = "") -> Table:
    """Return the iterates as the exam prints them: k, q, r, |e|, and det J or σ_min."""
    (iterates,) = run._tables()
    return table(iterates.headings, iterates.rows, title)
