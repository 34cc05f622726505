"""A proof that two configurations are in different aspects, where det J depends on two joints."""

import numpy as np
import numpy.typing as npt
from scipy.ndimage import label

from robotics1.ik.postures.determinant import Determinant
from robotics1.inputs import Array

GRIDS = (64, 192, 576)  # cells along each joint
Bools = npt.NDArray[np.bool_]
BLOCK = 65_536  # cells that are looked at together


def are_apart(determinant: Determinant, a: Array, b: Array, lower: Array, upper: Array, circular: Bools) -> bool:
    """Whether it is proven that no path joins a and b on which det J does not vanish.

    In a cell with the centre q, det J differs from det J(q) by no more than its bounded change on the way to a corner.
    Cells in which it cannot have the sign it has at a are taken away; a and b must then be in different parts of
    the rest. Cells count as neighbours across corners too.

    Args:
        determinant: det J, of a chain of numbers, that depends on two joints.
        a, b: (nq,) two configurations at which it has the same sign [rad or m].
        lower, upper: (nq,) the limits.
        circular: (nq,) the joints that make whole turns.
    """
    joints = np.flatnonzero(determinant.active)
    if len(joints) > 2 or not determinant.has_bound:
        return False
    sign = float(np.sign(determinant(a[None])[0]))
    low, high = np.where(circular, -np.pi, lower)[joints], np.where(circular, np.pi, upper)[joints]
    if not np.isfinite(high - low).all():
        return False
    for cells in GRIDS:
        width = (high - low) / cells
        open_cells = _open_cells(determinant, a, joints, low, width, cells, sign)
        parts = _joined(open_cells, circular[joints])
        places = [tuple(_cell(q[joints], low, width, cells, circular[joints])) for q in (a, b)]
        if parts[places[0]] != parts[places[1]]:
            return True
    return False


def _open_cells(
    determinant: Determinant, at: Array, joints: npt.NDArray[np.intp], low: Array, width: Array, cells: int, sign: float
) -> Bools:
    """Return the cells in which det J may have the sign: (cells, ...) of bools."""
    ranges = [low[i] + width[i] * (np.arange(cells) + 0.5) for i in range(len(joints))]
    centres = np.stack(np.meshgrid(*ranges, indexing="ij"), axis=-1).reshape(-1, len(joints))
    found = []
    for part in np.array_split(centres, max(1, len(centres) // BLOCK)):
        q = np.repeat(at[None], len(part), axis=0)
        q[:, joints] = part
        step = np.zeros_like(q)
        step[:, joints] = 0.5 * width
        change = np.maximum(determinant.change(q, step), determinant.change(q, -step))
        found.append(sign * determinant(q) + change > 0)
    return np.concatenate(found).reshape((cells,) * len(joints))


def _joined(open_cells: Bools, circular: Bools) -> npt.NDArray[np.intp]:
    """Return the number of the part of each cell, across the seams of joints that make whole turns."""
    parts, count = label(open_cells, structure=np.ones((3,) * open_cells.ndim))
    leader = np.arange(count + 1)

    def find(i: int) -> int:
        while leader[i] != i:
            i = int(leader[i])
        return i

    for axis in np.flatnonzero(circular):
        first, last = np.take(parts, 0, axis=axis).ravel(), np.take(parts, -1, axis=axis).ravel()
        for shift in (-1, 0, 1) if open_cells.ndim > 1 else (0,):
            for i, j in set(zip(first.tolist(), np.roll(last, shift).tolist(), strict=True)):
                if i and j:
                    leader[find(i)] = find(j)
    return np.asarray(np.array([find(i) for i in range(count + 1)])[parts])


def _cell(q: Array, low: Array, width: Array, cells: int, circular: Bools) -> list[int]:
    turned = np.where(circular, low + (q - low) % (2 * np.pi), q)
    return [int(k) for k in np.clip((turned - low) / width, 0, cells - 1)]
