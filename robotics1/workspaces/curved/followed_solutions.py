"""The solutions of two joints along lines of a section, followed from one place to the next: faster than one by one."""

from itertools import permutations

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.curved.curved_section import ON_BOUNDARY, SAME, CurvedSection


def solutions_along(section: CurvedSection, z: Array, count: int) -> Array:
    """Return N solutions q (k, s, N, 2) at places z (k, s, 2) along k lines that pass no singularity.

    In the middle of each line they are looked for, and followed from there.
    """
    k, s, _ = z.shape
    q = np.zeros((k, s, count, 2))
    q[:, s // 2] = _looked_for(section, z[:, s // 2], count)
    _follow(section, q, z, np.arange(s, dtype=float))
    lost = _lost(section, q, z)
    q[lost] = _looked_for(section, z[lost], count)
    return q


def solutions_one_by_one(section: CurvedSection, z: Array, count: int) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Return the same as `solutions_across` where nothing is known: each is looked for; the nearest one is the next."""
    k, n, _ = z.shape
    q = _looked_for(section, z.reshape(-1, 2), count).reshape(k, n, count, 2)
    orders = np.array(list(permutations(range(count))))
    for i in range(1, n):
        far = section.arm.domain.difference(q[:, i, None], q[:, i - 1, :, None])  # (k, before, after, 2)
        cost = (far**2).sum(axis=-1)
        total = np.array([cost[:, range(count), order].sum(axis=1) for order in orders])
        q[:, i] = np.take_along_axis(q[:, i], orders[np.argmin(total, axis=0)][..., None], axis=1)
    return q, np.asarray(_lost(section, q, z).any(axis=1))


def _looked_for(section: CurvedSection, z: Array, count: int) -> Array:
    """Return N solutions (k, N, 2) at places (k, 2); zeros where fewer are found."""
    q = np.zeros((len(z), count, 2))
    for one, found in zip(q, section.solutions_each(z, np.full(len(z), count)), strict=True):
        one[: min(count, len(found))] = found[:count]
    return q


def solutions_across(section: CurvedSection, middle: Array, z: Array, at: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Return solutions q (k, n, N, 2) at places z (k, n, 2), and on which lines one is missing, (k,).

    Args:
        section: the section of the arm.
        middle: (k, N, 2) the solutions in the middles of the lines.
        z: the places.
        at: (n,) what the solutions are smooth in.
    """
    q = np.zeros((*z.shape[:2], *middle.shape[1:]))
    q[:, z.shape[1] // 2] = middle
    _follow(section, q, z, at)
    return q, np.asarray(_lost(section, q, z).any(axis=1))


def _follow(section: CurvedSection, q: Array, z: Array, at: Array) -> None:
    """Write solutions q (k, n, N, 2) at places z (k, n, 2) by Newton's method; those in the middle are known."""
    n, domain = q.shape[1], section.arm.domain
    middle = n // 2
    for i in (*range(middle + 1, n), *range(middle - 1, -1, -1)):
        side = 1 if i > middle else -1
        start = q[:, i - side].copy()
        if i != middle + 1:
            ratio = (at[i] - at[i - side]) / (at[i - side] - at[i - 2 * side])
            start += domain.difference(start, q[:, i - 2 * side]) * ratio
        start = np.where(domain.circular, start, np.clip(start, domain.lower, domain.upper))
        places = np.repeat(z[:, i], q.shape[2], axis=0)
        q[:, i] = section.newton_at(start.reshape(-1, 2), places).reshape(start.shape)


def _lost(section: CurvedSection, q: Array, z: Array) -> npt.NDArray[np.bool_]:
    """Return at which places a solution does not lead there, or two are one, (k, n)."""
    images = section.arm.mapped.image(q.reshape(-1, 2)).reshape(q.shape)
    off = np.linalg.norm(images - z[:, :, None], axis=-1) > ON_BOUNDARY
    far = np.abs(section.arm.domain.difference(q[:, :, :, None], q[:, :, None])).max(axis=-1)
    return np.asarray(off.any(axis=2) | (far + np.eye(q.shape[2]) < SAME).any(axis=(2, 3)))
