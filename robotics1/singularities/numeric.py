"""From points on the singular set to its pieces: their dimension, constant and free joints, and what hangs together."""

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.singularities.points import NEAR, ON_THE_SET, SingularPoints
from robotics1.singularities.result import SingularBranch
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit, check_time

AT_ONCE = 1000  # starts that are drawn together
ENOUGH = 50  # samples of a branch
SAME_VALUE = 1e-5  # difference of two values of a constant joint that are one
WALKS = 8  # that fail before two pieces are taken as apart
STRIDE = 0.1  # of a walk on the set, in units
UNMEASURED = "The time was over before the set around it was measured: it may lie on a larger piece."
FAR, CLOSE = 3e-3, 3e-4  # from a point, in units: the two radii in which its sheet is measured


@dataclass
class Sheet:
    """The points that look alike: same dimension, same free joints, same joints constant at the same values.

    It is flat if no joint is tied: then its equations are the values of the constant joints. `measured` is False of one
    point around which there was no time to look.
    """

    box: JointBox
    dimension: int
    constant: list[int]
    free: list[int]
    points: list[Array]
    measured: bool = True

    @property
    def tied(self) -> list[int]:
        """The joints that are neither constant nor free."""
        return [i for i in range(len(self.points[0])) if i not in self.constant and i not in self.free]

    def apart(self, q: Array) -> Array:
        """Return how far the constant joints are from their values at q, in the box's units."""
        return self.box.difference(q, self.points[0])[self.constant]

    def contains(self, q: Array) -> bool:
        """Return whether the constant joints have their values at q."""
        return bool(np.abs(self.apart(q)).max(initial=0.0) < SAME_VALUE)

    def is_like(self, other: "Sheet") -> bool:
        """Return whether points of the two sheets look alike."""
        same_kind = (self.dimension, self.constant, self.free) == (other.dimension, other.constant, other.free)
        return same_kind and self.contains(other.points[0])


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
            larger = (other for other in flat if other.dimension > sheet.dimension)
            if any(all(map(other.contains, sheet.points)) for other in larger):
                continue  # where the set is degenerate inside a larger sheet its dimension is measured too low
            pieces += _connected_pieces(points, sheet, flat) if sheet.tied else [sheet]
        branches = [_branch(points, piece, flat, rng, limits) for piece in pieces]
    return tuple(sorted(branches, key=lambda branch: (-branch.dimension, list(branch.values.items()))))


def _sheets(points: SingularPoints, count: int, rng: np.random.Generator) -> list[Sheet]:
    """Return the sheets that the starts lead to before the time is over."""
    sheets: list[Sheet] = []
    q: Array | None = None
    try:
        for first in range(0, count, AT_ONCE):
            for start in points.box.random(rng, min(AT_ONCE, count - first)):
                q = points.project(start)
                if q is not None:
                    _add_point(points, q, sheets, rng)
    except OutOfTime:  # what was found stands
        if q is not None and not sheets:
            sheets.append(Sheet(points.box, 0, list(range(len(q))), [], [q], measured=False))
    return sheets


def _add_point(points: SingularPoints, q: Array, sheets: list[Sheet], rng: np.random.Generator) -> None:
    """Add a point of the set to its sheet; or begin a sheet with it."""
    known = next((sheet for sheet in sheets if not sheet.tied and sheet.contains(q)), None)
    for radius in (FAR, CLOSE):  # what looks new may be close to a crossing of two known sheets
        if known is None:
            here = _sheet_at(points, q, rng, radius)
            known = next((sheet for sheet in sheets if sheet.tied and sheet.is_like(here)), None)
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
    return Sheet(points.box, tangent.shape[1], list(map(int, np.flatnonzero(still))), free, [q])


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
        p = points.neighbour(q, 0.5 * STRIDE * tangent @ direction)
        if p is not None:
            moved |= np.abs(points.box.difference(p, q)) > SAME_VALUE
    return moved


def _connected_pieces(points: SingularPoints, sheet: Sheet, flat: list[Sheet]) -> list[Sheet]:
    """Split a curved sheet into what walks on the set connect: union-find over the pairs, the nearest first. When the
    time is over, it stays whole.
    """

    def distance(q: Array) -> float:
        return min((float(np.linalg.norm(other.apart(q))) for other in flat), default=np.inf)

    members = sheet.points[:200]
    aside = max(members, key=distance)[sheet.free].copy()  # near a flat sheet a walk would change to it
    for q in members:
        q[sheet.free] = aside
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
    return [replace(sheet, points=group) for group in groups]


def _walk(points: SingularPoints, start: Array, goal: Array, flat: list[Sheet]) -> bool:
    """Whether steps towards the goal, each projected on the set, arrive there without changing to a flat sheet."""
    q = start
    ahead = points.box.difference(goal, q)
    left = float(np.linalg.norm(ahead))
    on_flat = 0
    for _ in range(int(4 * left / STRIDE) + 4):
        p = _next_point(points, q, ahead * min(1.0, STRIDE / max(left, 1e-300)))
        if p is None:
            return False
        q, before = p, left
        ahead = points.box.difference(goal, q)
        left = float(np.linalg.norm(ahead))
        on_flat = on_flat + 1 if any(sheet.contains(q) for sheet in flat) else 0
        if left < 1e-6:
            return True
        if on_flat > 1 or left > before - 0.05 * STRIDE:
            return False
    return False


def _next_point(points: SingularPoints, q: Array, step: Array) -> Array | None:
    """Return the point of the set that a step from q leads to; None if it leads elsewhere, or nowhere."""
    p = points.neighbour(q, step)
    return None if p is None or np.linalg.norm(points.box.difference(p, q)) > 2 * STRIDE else p


def _branch(
    points: SingularPoints, piece: Sheet, flat: list[Sheet], rng: np.random.Generator, limits: JointBox
) -> SingularBranch:
    """Complete the samples of a piece. They lie inside the joint limits, unless all that was found is outside by less
    than 1e-6.
    """
    found = [points.box.nearest(q) for q in piece.points]
    values = _constant_values(points, piece, found)
    for q in found:
        q[piece.constant] = values
    samples = [q for q in found if limits.contains(q)]
    if samples:
        points = replace(points, box=limits)
    else:
        samples = found
    if piece.dimension == 0:
        samples = samples[:1]
    else:
        _complete(points, piece, flat, rng, samples)
    constant = dict(zip(piece.constant, values, strict=True))
    branch = points.branch(samples, piece.dimension, constant, piece.free, limits)
    return branch if piece.measured else replace(branch, note=f"{UNMEASURED} {branch.note}".strip())


def _complete(
    points: SingularPoints, piece: Sheet, flat: list[Sheet], rng: np.random.Generator, samples: list[Array]
) -> None:
    """Add samples until there are enough, or the time is over."""
    try:
        while len(samples) < ENOUGH:
            check_time()
            q = samples[rng.integers(len(samples))].copy()
            if piece.tied:
                step = np.zeros_like(q)
                step[piece.tied] = rng.uniform(-STRIDE, STRIDE, len(piece.tied))
                p = _next_point(points, q, step)
                if p is not None and piece.contains(p):
                    p[piece.constant] = q[piece.constant]
                    q = p
                if any(sheet.contains(q) for sheet in flat):
                    continue  # it has changed to another piece, where the two cross
            q[piece.free] = points.box.random(rng, 1)[0, piece.free]
            samples.append(q)
    except OutOfTime:
        pass  # one sample is a branch


def _constant_values(points: SingularPoints, piece: Sheet, samples: list[Array]) -> Array:
    """Return the values of the constant joints: those of the most singular sample, or the multiples of π/12
    (for a prismatic joint, zero) next to them, if the samples stay singular with these.

    A double root is found only to 1e-8, and rounding makes 4e-16 of a zero.
    """
    values = min(samples, key=points.relative_sigma)[piece.constant]
    grid = np.where(points.robot.revolute[piece.constant], np.pi / 12 * np.round(values * 12 / np.pi), 0.0)
    round_values = np.where(np.abs(grid - values) < 1e-6, grid, values) + 0.0  # never −0
    moved = np.array(samples[:8])
    moved[:, piece.constant] = round_values
    return round_values if all(points.relative_sigma(q) <= ON_THE_SET for q in moved) else values
