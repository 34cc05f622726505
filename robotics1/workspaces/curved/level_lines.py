"""Where a function of two variables changes its sign: marching squares, with points that are exact.

Source: Lorensen, Cline, Marching cubes, SIGGRAPH 1987, in two dimensions.
"""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array

Function = Callable[[Array], Array]
Grid = tuple[Array, Array]
Zeros = Callable[[Function, Array, Array], Array]
MOST_STEPS = 60  # of regula falsi; about ten are usual
SMALL = 1e-15  # a step that ends it


def points_of(grid: Grid) -> Array:
    """Return all points (k, 2) of a grid, the second variable the faster."""
    return np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 2)


def level_lines(
    f: Function, grid: Grid, values: Array, circular: tuple[bool, bool], zeros: Zeros | None = None
) -> list[tuple[Array, bool]]:
    """Return the lines f = 0, each with its points (k, 2), which lie on lines of the grid, and whether it is closed.

    Args:
        f: the function of (k, 2).
        grid: the values of the two variables; the last of a circular one is the first, a turn later.
        values: of f on the grid, none of them zero.
        circular: whether the last value of a variable is the first again.
        zeros: finds a zero between each two points at which f has different signs; by default `zeros_between`.
    """
    points, number_x, number_y = _zeros_on_edges(f, grid, values, circular, zeros or zeros_between)
    neighbours: dict[int, list[int]] = {}
    positive = values > 0
    n, m = values.shape[0] - 1, values.shape[1] - 1
    mixed = positive[:-1, :-1].astype(int) + positive[1:, :-1] + positive[:-1, 1:] + positive[1:, 1:]
    for i, j in np.argwhere((mixed > 0) & (mixed < 4)):
        below, above = number_x[i, j], number_x[i, (j + 1) % m if circular[1] else j + 1]
        left, right = number_y[i, j], number_y[(i + 1) % n if circular[0] else i + 1, j]
        crossed = [k for k in (below, right, above, left) if k >= 0]
        if len(crossed) == 4:
            centre = np.array([[(grid[0][i] + grid[0][i + 1]) / 2, (grid[1][j] + grid[1][j + 1]) / 2]])
            with_first = (f(centre)[0] > 0) == positive[i, j]
            pairs = [(below, right), (above, left)] if with_first else [(below, left), (above, right)]
        else:
            pairs = [(crossed[0], crossed[1])]
        for a, b in pairs:
            neighbours.setdefault(a, []).append(b)
            neighbours.setdefault(b, []).append(a)
    return [(_unrolled(points[line], grid, circular), closed) for line, closed in _lines(neighbours)]


def _zeros_on_edges(
    f: Function, grid: Grid, values: Array, circular: tuple[bool, bool], zeros: Zeros
) -> tuple[Array, npt.NDArray[np.intp], npt.NDArray[np.intp]]:
    """Return the zeros (k, 2) on the grid's edges, and their numbers, or −1, by the edges along x and along y."""
    n, m = values.shape[0] - 1, values.shape[1] - 1
    positive = values > 0
    along_x = np.argwhere(positive[:-1, : m if circular[1] else m + 1] != positive[1:, : m if circular[1] else m + 1])
    along_y = np.argwhere(positive[: n if circular[0] else n + 1, :-1] != positive[: n if circular[0] else n + 1, 1:])
    x, y = grid
    a = np.concatenate([np.column_stack([x[e[:, 0]], y[e[:, 1]]]) for e in (along_x, along_y)])
    b = np.concatenate(
        [
            np.column_stack([x[along_x[:, 0] + 1], y[along_x[:, 1]]]),
            np.column_stack([x[along_y[:, 0]], y[along_y[:, 1] + 1]]),
        ]
    )
    numbers = (np.full((n, m + 1), -1), np.full((n + 1, m), -1))
    numbers[0][tuple(along_x.T)] = np.arange(len(along_x))
    numbers[1][tuple(along_y.T)] = len(along_x) + np.arange(len(along_y))
    return zeros(f, a, b), *numbers


def zeros_between(f: Function, a: Array, b: Array) -> Array:
    """Return a zero between each two points (k, n) at which f has different signs, by regula falsi.

    Source: the Illinois rule; Dowell and Jarratt, BIT 11, 1971.
    """
    if not len(a):
        return a
    fa, fb = f(a), f(b)
    for _ in range(MOST_STEPS):
        share = np.clip(fb / np.where(fb == fa, 1.0, fb - fa), 0.0, 1.0)[:, None]
        c = b - share * (b - a)
        fc = f(c)
        moved = np.abs(c - b).max()
        other = ((fc > 0) != (fb > 0))[:, None]
        a, fa = np.where(other, b, a), np.where(other[:, 0], fb, fa / 2)
        b, fb = c, fc
        if moved < SMALL or not fb.any():
            break
    return b


def _lines(neighbours: dict[int, list[int]]) -> list[tuple[list[int], bool]]:
    """Return the paths through a graph whose nodes have one or two neighbours; those with one begin or end a path."""
    found, left = [], set(neighbours)
    for start in [k for k, near in neighbours.items() if len(near) == 1] + list(neighbours):
        if start not in left:
            continue
        closed = len(neighbours[start]) == 2
        line, here = [start], start
        left.discard(start)
        while True:
            after = [k for k in neighbours[here] if k in left]
            if not after:
                break
            here = after[0]
            left.discard(here)
            line.append(here)
        found.append(([*line, start] if closed else line, closed))
    return found


def _unrolled(points: Array, grid: Grid, circular: tuple[bool, bool]) -> Array:
    """Return points without the jumps of a turn between them."""
    steps = np.diff(points, axis=0)
    for k in range(2):
        if circular[k]:
            turn = grid[k][-1] - grid[k][0]
            steps[:, k] -= turn * np.round(steps[:, k] / turn)
    return np.asarray(points[0] + np.vstack([np.zeros((1, 2)), np.cumsum(steps, axis=0)]))
