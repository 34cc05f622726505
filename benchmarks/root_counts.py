"""How many counts of solutions are those of all 16 roots of a general six-joint arm."""

import numpy as np
import numpy.typing as npt

from benchmarks.every_root import Rows, every_root

AGAINST = """\
The same counts beside those of `benchmarks/every_root.py`: all 16 complex roots by Newton's method from complex starts,
the real ones told apart in 40 digits. A pose counts where all 16 were found; solvers differ where one of them has
another count than ours."""
HEADER = ["solver", "poses", "right", "where solvers differ", "right there"]


def against_the_roots(
    rows: Rows, q: npt.NDArray[np.float64], counts: dict[str, dict[int, int]], ours: str
) -> tuple[list[list[str]], dict[str, float | None]]:
    """Return the rows of the table, and of each solver how many percent of its counts are right.

    Args:
        rows: a, α, d of the arm.
        q: (k, 6) the configurations that made the poses.
        counts: solver → number of a pose → its count.
        ours: the solver that the others are compared with.
    """
    roots = {i: every_root(rows, p) for i, p in enumerate(q)}
    certain = {i: len(found.real) for i, found in roots.items() if found.certain}
    differing = {i for found in counts.values() for i in found if found[i] != counts[ours][i]}
    lines, figures = [], {}
    for solver, found in counts.items():
        asked = [i for i in found if i in certain]
        right = {i for i in asked if found[i] == certain[i]}
        there = [i for i in asked if i in differing]
        lines.append([solver, str(len(asked)), str(len(right)), str(len(there)), str(len(right.intersection(there)))])
        figures[solver] = 100.0 * len(right) / len(asked) if asked else None
    return lines, figures
