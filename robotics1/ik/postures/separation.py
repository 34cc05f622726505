"""Proofs that two configurations are in different aspects: what every path between them must cross.

det J may vanish at values of one joint whatever the others do, as sin q₅ does: these are walls. Where det J depends on
two joints, a grid over these shows what is apart.
"""

import numpy as np
import numpy.typing as npt
from scipy.ndimage import label

from robotics1.angles import TURN
from robotics1.ik.postures.determinant import Determinant
from robotics1.ik.postures.roadmap import Region
from robotics1.inputs import Array
from robotics1.notation import joint_value, number

OTHERS = 16  # random values of the other joints
TICKS = 360  # values of the joint, in its range
VANISHES = 1e-9  # |det J|, beside its largest value
STEPS, SLOPE = 30, 1e-5  # of Newton's method: a double zero takes many; the difference that gives the slope
SAME = 1e-6  # distance of two walls that are one
GRIDS = (64, 192, 576)  # cells along each joint
BLOCK = 65_536  # cells that are looked at together
Bools = npt.NDArray[np.bool_]


def wall_between(region: Region, a: Array, b: Array) -> str:
    """Return at which values of a joint every path from a to b, (nq,) each, meets a singularity; "" if at none.

    On a circle one wall can be gone around the other way.
    """
    robot = region.determinant.problem.robot
    for j, values in walls(region).items():
        if region.circular[j]:
            places = np.unique(np.round(values % TURN, 6))
            here, there = (int(np.searchsorted(places, x % TURN)) % len(places) for x in (a[j], b[j]))
            crossed = len(places) > 1 and here != there
        elif robot.revolute[j]:
            crossed = any(np.floor((a[j] - v) / TURN) != np.floor((b[j] - v) / TURN) for v in values)
        else:
            crossed = any((a[j] - v) * (b[j] - v) < 0 for v in values)
        if crossed:
            shown = ", ".join(map(joint_value if robot.revolute[j] else number, values.tolist()))
            return f"det J vanishes at {robot.joint_names[j]} = {shown}, whatever the other joints do"
    return ""


def walls(region: Region) -> dict[int, Array]:
    """Return joint → the values, (k,), at which det J vanishes at all of 16 random values of the other joints."""
    determinant = region.determinant
    q = determinant.problem.random(np.random.default_rng(2), OTHERS)
    found = {}
    for j, low, high in zip(range(q.shape[1]), *region.ranges, strict=True):
        if not determinant.active[j]:
            continue
        values = _common_zeros(determinant, q, j, low, high)
        if len(values):
            found[j] = values
    return found


def _common_zeros(determinant: Determinant, q: Array, j: int, low: float, high: float) -> Array:
    """Return the values of joint j in a range at which det J vanishes at all configurations (k, nq)."""

    def values(x: Array) -> Array:
        """Return det J with joint j at x (i,): (i, k)."""
        at = np.repeat(q[None], len(x), axis=0)
        at[:, :, j] = x[:, None]
        return np.asarray(determinant(at.reshape(-1, q.shape[1])).reshape(len(x), -1))

    ticks = np.linspace(low, high, TICKS + 1)
    size = np.abs(values(ticks)).max(axis=1)
    before, after = np.append(np.inf, size[:-1]), np.append(size[1:], np.inf)
    found: list[float] = []
    for x in ticks[(size <= before) & (size <= after)]:
        value = float(x)
        for _ in range(STEPS):  # Newton's method for all k at once
            d = values(value + np.array([-SLOPE, 0.0, SLOPE]))
            slope = (d[2] - d[0]) / (2 * SLOPE)
            value -= float(d[1] @ slope / max(float(slope @ slope), 1e-300))
        inside = low - SAME <= value <= high + SAME and np.abs(values(np.array([value]))).max() < VANISHES
        if inside and all(abs(value - other) > SAME for other in found):
            found.append(value)
    return np.array(found)


def are_apart(region: Region, a: Array, b: Array) -> bool:
    """Whether it is proven that no path joins a and b, (nq,), in a region whose det J depends on two joints at most.

    In a cell with the centre q, det J differs from det J(q) by no more than its bounded change on the way to a corner.
    Cells in which it cannot have the sign of the region are taken away; a and b must then be in different parts of
    the rest. Cells count as neighbours across corners too.
    """
    determinant, circular = region.determinant, region.circular
    joints = np.flatnonzero(determinant.active)
    if len(joints) > 2 or not determinant.has_bound:
        return False
    low, high = np.where(circular, -np.pi, region.lower)[joints], np.where(circular, np.pi, region.upper)[joints]
    if not np.isfinite(high - low).all():
        return False
    for cells in GRIDS:
        width = (high - low) / cells
        open_cells = _open_cells(determinant, a, joints, low, width, cells, region.sign)
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
