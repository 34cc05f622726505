"""From points on the singular set to its pieces: their dimension, constant and free joints, and what hangs together."""

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.singularities.points import NEAR, ON_THE_SET, SingularPoints, note_on_limits
from robotics1.singularities.result import SingularBranch
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit, check_time

AT_ONCE = 1000  # starts that are drawn together
ENOUGH = 50  # samples of a branch
SAME_VALUE = 1e-5  # difference of two values of a constant joint that are one
WALKS = 8  # that fail before two pieces are taken as apart
STRIDE = 0.1  # of a walk on the set, in units
FAR, CLOSE = 3e-3, 3e-4  # from a point, in units: the two radii in which its sheet is measured


@dataclass
class Sheet:
    """The points that look alike: same dimension, same free joints, same joints constant at the same values."""

    dimension: int
    constant: tuple[int, ...]
    free: tuple[int, ...]
    points: list[Array]

    @property
    def tied(self) -> list[int]:
        """The joints that are neither constant nor free."""
        return [i for i in range(len(self.points[0])) if i not in self.constant and i not in self.free]


def numeric_branches(
    points: SingularPoints, count: int, rng: np.random.Generator, limit: TimeLimit
) -> tuple[SingularBranch, ...]:
    """Return the pieces of the singular set that `count` random starts lead to, the larger first; fewer starts and
    walks, and fewer samples of each, when the time is over.
    """
    limits = points.box
    points = replace(points, box=limits.widened(NEAR))
    with limit.kept():
        sheets = _sheets(points, count, rng)
        flat = [sheet for sheet in sheets if not sheet.tied]
        pieces = []
        for sheet in sheets:
            if any(_is_part_of(points, sheet, larger) for larger in flat):
                continue  # where the set is degenerate inside a larger sheet its dimension is measured too low
            pieces += _connected_pieces(points, sheet, flat) if sheet.tied else [sheet]
        branches = [_branch(points, piece, flat, rng, limits) for piece in pieces]
    return tuple(sorted(branches, key=lambda branch: (-branch.dimension, list(branch.values.items()))))


def _sheets(points: SingularPoints, count: int, rng: np.random.Generator) -> list[Sheet]:
    """Return the sheets that the starts lead to before the time is over."""
    sheets: list[Sheet] = []
    try:
        for first in range(0, count, AT_ONCE):
            for start in points.box.random(rng, min(AT_ONCE, count - first)):
                _add_start(points, start, sheets, rng)
    except OutOfTime:
        pass  # what was found stands
    return sheets


def _add_start(points: SingularPoints, start: Array, sheets: list[Sheet], rng: np.random.Generator) -> None:
    """Add the configuration that a start leads to, if it leads to one, to its sheet; or begin a sheet with it."""
    q = points.project(start)
    if q is None:
        return
    known = next((sheet for sheet in sheets if not sheet.tied and _lies_on(points, q, sheet)), None)
    for radius in (FAR, CLOSE):  # what looks new may be close to a crossing of two known sheets
        if known is None:
            here = _sheet_at(points, q, rng, radius)
            known = next((sheet for sheet in sheets if sheet.tied and _alike(points, sheet, here)), None)
    if known is None:
        sheets.append(here)
    else:
        known.points.append(q)


def _sheet_at(points: SingularPoints, q: Array, rng: np.random.Generator, radius: float) -> Sheet:
    """Measure the set around q: its dimension, the joints that stand still on it, and those that do not matter."""
    tangent = points.tangent(q, rng, radius)
    still = np.linalg.norm(tangent, axis=1) < 1e-2
    free = [int(i) for i in np.flatnonzero(~still) if _never_matters(points, q, int(i), rng)]
    if len(free) < np.count_nonzero(~still):
        still &= ~_moves_further_on(points, q, tangent, rng)
    return Sheet(tangent.shape[1], tuple(map(int, np.flatnonzero(still))), tuple(free), [q])


def _never_matters(points: SingularPoints, q: Array, i: int, rng: np.random.Generator) -> bool:
    moved = np.repeat(q[None], 4, axis=0)
    moved[:, i] = points.box.random(rng, 4)[:, i]
    return all(points.relative_sigma(p) < 1e-9 for p in moved)


def _moves_further_on(
    points: SingularPoints, q: Array, tangent: Array, rng: np.random.Generator
) -> npt.NDArray[np.bool_]:
    """Which joints change a little further along a curved sheet: at an extreme they only seem to stand still."""
    moved = np.zeros(len(q), dtype=bool)
    for direction in rng.standard_normal((6, tangent.shape[1])):
        aside = q + points.box.unit * (0.5 * STRIDE * tangent @ direction)
        p = points.project(points.box.nearest(aside), iterations=12)
        if p is not None:
            moved |= np.abs(points.box.difference(p, q)) > SAME_VALUE
    return moved


def _lies_on(points: SingularPoints, q: Array, sheet: Sheet) -> bool:
    """Whether the constant joints of the sheet have its values at q."""
    apart = points.box.difference(q, sheet.points[0])
    return bool(np.abs(apart[list(sheet.constant)]).max(initial=0.0) < SAME_VALUE)


def _distance(points: SingularPoints, q: Array, sheets: list[Sheet]) -> float:
    """Return how far q is from the nearest of the flat sheets, in the box's units."""
    apart = (points.box.difference(q, sheet.points[0])[list(sheet.constant)] for sheet in sheets)
    return min((float(np.linalg.norm(d)) for d in apart), default=np.inf)


def _alike(points: SingularPoints, sheet: Sheet, other: Sheet) -> bool:
    same_kind = (sheet.dimension, sheet.constant, sheet.free) == (other.dimension, other.constant, other.free)
    return same_kind and _lies_on(points, other.points[0], sheet)


def _is_part_of(points: SingularPoints, sheet: Sheet, larger: Sheet) -> bool:
    return larger.dimension > sheet.dimension and all(_lies_on(points, q, larger) for q in sheet.points)


def _connected_pieces(points: SingularPoints, sheet: Sheet, flat: list[Sheet]) -> list[Sheet]:
    """Split a curved sheet into what walks on the set connect: union-find over the pairs, the nearest first. When the
    time is over, it stays whole.
    """
    members = sheet.points[:200]
    free = list(sheet.free)
    aside = max(members, key=lambda q: _distance(points, q, flat))[free].copy()  # else a walk changes to a flat sheet
    for q in members:
        q[free] = aside
    apart = np.array([np.linalg.norm(points.box.difference(np.array(members), b), axis=1) for b in members])
    piece = list(range(len(members)))
    failures: Counter[tuple[int, int]] = Counter()
    for _, i, j in sorted((apart[a, b], a, b) for a in range(len(members)) for b in range(a)):
        old, new = piece[i], piece[j]
        if old == new or failures[old, new] + failures[new, old] == WALKS:
            continue
        try:
            connected = _walk(points, members[i], members[j], flat)
        except OutOfTime:
            return [sheet]
        if connected:
            piece = [new if label == old else label for label in piece]
        else:
            failures[old, new] += 1
    groups = [[q for q, label in zip(members, piece, strict=True) if label == name] for name in sorted(set(piece))]
    return [Sheet(sheet.dimension, sheet.constant, sheet.free, group) for group in groups]


def _walk(points: SingularPoints, start: Array, goal: Array, flat: list[Sheet]) -> bool:
    """Whether steps towards the goal, each projected on the set, arrive there without changing to a flat sheet."""
    q = start
    left = float(np.linalg.norm(points.box.difference(goal, q)))
    on_flat = 0
    for _ in range(int(4 * left / STRIDE) + 4):
        ahead = points.box.difference(goal, q)
        step = ahead * min(1.0, STRIDE / max(left, 1e-300))
        p = points.project(points.box.nearest(q + points.box.unit * step), iterations=12)
        if p is None or np.linalg.norm(points.box.difference(p, q)) > 2 * STRIDE:
            return False
        q, before = p, left
        left = float(np.linalg.norm(points.box.difference(goal, q)))
        on_flat = on_flat + 1 if any(_lies_on(points, q, sheet) for sheet in flat) else 0
        if left < 1e-6:
            return True
        if on_flat > 1 or left > before - 0.05 * STRIDE:
            return False
    return False


def _branch(
    points: SingularPoints, piece: Sheet, flat: list[Sheet], rng: np.random.Generator, limits: JointBox
) -> SingularBranch:
    """Complete the samples of a piece and choose the configuration of its numeric bases. They lie inside the
    joint limits, unless all that was found is outside by less than 1e-6.
    """
    found = [points.box.nearest(q) for q in piece.points]
    values = _constant_values(points, piece, found)
    for q in found:
        q[list(piece.constant)] = values
    samples = [q for q in found if limits.contains(q)]
    if samples:
        points = replace(points, box=limits)
    else:
        samples = found
    if piece.dimension == 0:
        samples = samples[:1]
    else:
        _complete(points, piece, flat, rng, samples)
    ranks = [points.rank_at(q) for q in samples]
    best = int(np.argmax(ranks))
    names = points.robot.joint_names
    return SingularBranch(
        robot=points.robot,
        task=points.task,
        box=points.box,
        generic_rank=points.rank,
        dimension=piece.dimension,
        values={names[i]: float(value) for i, value in zip(piece.constant, values, strict=True)},
        free_joints=tuple(names[i] for i in piece.free),
        samples=np.array(samples),
        q=samples[best],
        rank=ranks[best],
        note=note_on_limits(np.array(samples), limits, names),
    )


def _complete(
    points: SingularPoints, piece: Sheet, flat: list[Sheet], rng: np.random.Generator, samples: list[Array]
) -> None:
    """Add samples until there are enough, or the time is over."""
    free = list(piece.free)
    try:
        while len(samples) < ENOUGH:
            check_time()
            q = samples[rng.integers(len(samples))].copy()
            if piece.tied:
                values = q[list(piece.constant)]
                q = _neighbour(points, piece, q, rng)
                q[list(piece.constant)] = values
                if any(_lies_on(points, q, sheet) for sheet in flat):
                    continue  # it has changed to another piece, where the two cross
            q[free] = points.box.random(rng, 1)[0, free]
            samples.append(q)
    except OutOfTime:
        pass  # one sample is a branch


def _constant_values(points: SingularPoints, piece: Sheet, samples: list[Array]) -> Array:
    """Return the values of the constant joints: those of the most singular sample, or the multiples of π/12
    (for a prismatic joint, zero) next to them, if the samples stay singular with these.

    A double root is found only to 1e-8, and rounding makes 4e-16 of a zero.
    """
    constant = list(piece.constant)
    values = min(samples, key=points.relative_sigma)[constant]
    grid = np.where(points.robot.revolute[constant], np.pi / 12 * np.round(values * 12 / np.pi), 0.0)
    round_values = np.where(np.abs(grid - values) < 1e-6, grid, values) + 0.0  # never −0
    moved = np.array(samples[:8])
    moved[:, constant] = round_values
    return round_values if all(points.relative_sigma(q) <= ON_THE_SET for q in moved) else values


def _neighbour(points: SingularPoints, piece: Sheet, q: Array, rng: np.random.Generator) -> Array:
    """Return a point of the same curved piece near q, or q itself when the step leaves the piece."""
    step = np.zeros_like(q)
    step[piece.tied] = rng.uniform(-STRIDE, STRIDE, len(piece.tied))
    p = points.project(points.box.nearest(q + points.box.unit * step), iterations=12)
    if p is None or np.linalg.norm(points.box.difference(p, q)) > 2 * STRIDE:
        return q
    return p if _lies_on(points, p, piece) else q
