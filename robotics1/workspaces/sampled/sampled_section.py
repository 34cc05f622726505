"""The section of any arm, by cells: a cell is reached where inverse kinematics finds a configuration for its middle.

Random configurations reach the first cells. From each reached cell Newton's method, kept inside the limits, goes on to
the cells beside it, until no cell is added. So what is reached is proven by configurations; what is not, is not proven.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.chain import Chain
from robotics1.workspaces.placed_section import in_section

Cells = npt.NDArray[Any]  # (k, 2) whole numbers, or (k, 3) of cells in space
FIRST = 60_000  # random configurations
STEPS = 20
REACHED = 1e-6  # of a cell's side
AGAIN = 4  # how often a cell that is beside reached ones is tried, from one of them at random
FEW, ENCLOSED, FARTHER = 12, 20, 4  # cells in a group that is tried again, how often, and from how many cells away
DAMPING = 1e-9  # of the square of the arm's size


@dataclass(frozen=True, eq=False)
class SampledSection:
    """Cells of a section, or of space, and a configuration that reaches each.

    Attributes:
        chain: the joints that move the point in the section's frame; without the first one, if that moves the section.
        about_axis: whether the section is (ρ, h), or else the first two coordinates, or all three.
        corner: (2,) or (3,) of the grid [m].
        side: of a cell [m].
        reached: (n, m) or (n, m, l) whether a cell is.
        q: (..., joints) the configurations.
    """

    chain: Chain
    about_axis: bool
    corner: Array
    side: float
    reached: npt.NDArray[np.bool_]
    q: Array

    def middle(self, cells: Cells) -> Array:
        """Return the middles of cells, (k, 2) or (k, 3)."""
        return np.asarray(self.corner + (cells + 0.5) * self.side)


def sampled_section(chain: Chain, about_axis: bool, cells: int, seed: int, coordinates: int = 2) -> SampledSection:
    """Return the reached cells, with as many cells along the longest side, of a section or of space."""
    q = chain.drawn(np.random.default_rng(seed), FIRST)
    z = shown(chain.point(q), coordinates, about_axis)
    low, high = z.min(axis=0), z.max(axis=0)
    side = float((high - low).max()) / cells
    corner = low - 3 * side
    if about_axis:
        corner[0] = max(corner[0], 0.0)
    shape = tuple(np.ceil((high + 3 * side - corner) / side).astype(int))
    known = np.zeros((*shape, q.shape[1]))
    at = tuple(np.floor((z - corner) / side).astype(int).T)
    known[at] = q
    seen = np.zeros(shape, dtype=bool)
    seen[at] = True
    section = SampledSection(chain, about_axis, corner, side, np.zeros(shape, dtype=bool), known)
    _try(section, np.argwhere(seen), known[seen])
    _grow(section, np.random.default_rng(seed + 1))
    return section


def _try(section: SampledSection, cells: Cells, q: Array) -> None:
    """Mark the cells whose middles Newton's method reaches from q (k, n)."""
    found, good = descend(section.chain, section.about_axis, q, section.middle(cells), section.side)
    at = tuple(cells[good].T)
    section.reached[at] = True
    section.q[at] = found[good]


def _grow(section: SampledSection, rng: np.random.Generator) -> None:
    """Try the cells beside reached ones from these, until none is added; those that are enclosed also from farther."""
    tries = np.zeros(section.reached.shape, dtype=int)
    while _step(section, rng, np.argwhere(~section.reached & (tries < AGAIN)), tries, 1):
        pass
    for _ in range(ENCLOSED):
        holes = _enclosed(section)
        if not len(holes):
            return
        _step(section, rng, holes, tries, FARTHER)


def _step(section: SampledSection, rng: np.random.Generator, cells: Cells, tries: Cells, far: int) -> bool:
    """Try cells, each from a reached one at most so many cells away; return whether one was tried."""
    from scipy.ndimage import maximum_filter

    cells = cells[maximum_filter(section.reached, 2 * far + 1, mode="constant")[tuple(cells.T)]]
    starts = []
    for cell in cells:
        low = np.maximum(cell - far, 0)
        near = np.argwhere(section.reached[tuple(map(slice, low, cell + far + 1))])
        starts.append(section.q[tuple(near[rng.integers(len(near))] + low)])
    if starts:
        tries[tuple(cells.T)] += 1
        _try(section, cells, np.array(starts))
    return bool(starts)


def _enclosed(section: SampledSection) -> Cells:
    """Return the cells that are not reached, in small groups with reached ones all around."""
    from scipy.ndimage import label

    groups, _ = label(~section.reached)
    sizes = np.bincount(groups.ravel())
    return np.argwhere((groups > 0) & (sizes[groups] <= FEW))


def descend(chain: Chain, about_axis: bool, q: Array, z: Array, side: float) -> tuple[Array, npt.NDArray[np.bool_]]:
    """Return where damped Newton steps inside the limits lead from q (k, n), and which end at z (k, 2), or (k, 3)."""
    q = q.copy()
    lower, upper, circular = chain.lower, chain.upper, chain.circular
    size, rows = max(float(np.abs(z).max()), side), z.shape[1]
    for _ in range(STEPS):
        p, J = chain.jacobian(q)
        e = z - shown(p, rows, about_axis)
        if np.abs(e).max() < REACHED * side:
            break
        S = _rows(p, J, rows, about_axis)
        pull = np.einsum("kri,kr->ki", S, e)
        blocked = ~circular & (((q <= lower) & (pull < 0)) | ((q >= upper) & (pull > 0)))
        S = np.where(blocked[:, None, :], 0.0, S)
        H = np.einsum("kri,ksi->krs", S, S) + DAMPING * size**2 * np.eye(rows)
        step = np.einsum("kri,kr->ki", S, np.linalg.solve(H, e[..., None])[..., 0])
        step *= np.minimum(1.0, 0.5 / np.maximum(np.abs(step).max(axis=1), 1e-12))[:, None]
        q = np.where(circular, q + step, np.clip(q + step, lower, upper))
    e = z - shown(chain.point(q), rows, about_axis)
    return q, np.asarray(np.linalg.norm(e, axis=1) < REACHED * side)


def shown(p: Array, rows: int, about_axis: bool) -> Array:
    """Return the point (k, 3) itself, or its place in the section."""
    return p if rows == 3 else in_section(p, about_axis)


def _rows(p: Array, J: Array, rows: int, about_axis: bool) -> Array:
    if rows == 3 or not about_axis:
        return J[:, :rows]
    rho = np.maximum(np.hypot(p[:, 0], p[:, 1]), 1e-12)
    radial = (p[:, 0, None] * J[:, 0] + p[:, 1, None] * J[:, 1]) / rho[:, None]
    return np.stack([radial, J[:, 2]], axis=1)
