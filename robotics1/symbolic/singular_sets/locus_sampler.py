"""Random configurations on a piece of a locus."""

from collections.abc import Iterator, Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.singular_sets.locus import Piece

ON_THE_LOCUS = 1e-12  # of an equation, beside the sum of its terms
TRIES = 100  # starts for a configuration in the box; a fifth of them where these hardly ever lead to one
NEWTON_STEPS = 25
STARTS = 8  # of least squares
MOST_EVALUATIONS = 80  # of them, from one start


class LocusSampler:
    """It draws configurations of a piece inside a box.

    Random joint values are completed to a configuration where the box allows it. Where it hardly ever does, the
    distance to the piece is made least, from random starts or near those configurations that were found so before.
    """

    def __init__(self, piece: Piece, box: JointBox, known: Sequence[Array] | None = None) -> None:
        """Sample a piece in a box. With `known`, configurations that were found elsewhere, least squares start near
        these; an empty `known` means that least squares find nothing.
        """
        self.piece = piece
        self.box = box
        self._known = list(known or ())
        self._hopeless = known is not None and not known

    def draw(self, rng: np.random.Generator) -> Array | None:
        """Return a configuration of the piece inside the box, (n,), or None when there seems to be none.

        Raises:
            OutOfTime: the time of a limit that is kept is over.
        """
        piece = self.piece
        seldom = len(piece.equations) > 1 or self._known
        for start in self.box.random(rng, TRIES // 5 if seldom else TRIES):
            check_time()
            solved = _solved(piece, piece.with_pinned(start), rng)
            inside = None if solved is None else self._into_box(piece.completed(solved))
            if inside is not None:
                return inside
        if not piece.equations and len(piece.constant) == len(piece.valued) + len(piece.pinned):
            return None  # all values are known, and one of them is outside
        return None if self._hopeless else self._by_least_squares(rng)

    def nearest(self, start: Array) -> Array | None:
        """Return the configuration in the box that Newton's method or least squares lead to, or None."""
        q = _newton(self.piece, start.copy()) if len(self.piece.equations) > 1 else None
        inside = None if q is None else self._into_box(self.piece.completed(q))
        return self._least_squares(start) if inside is None else inside

    def _by_least_squares(self, rng: np.random.Generator) -> Array | None:
        starts = self.box.random(rng, STARTS)
        if self._known:
            known = self._known[rng.integers(len(self._known))]
            starts = known + (starts - known) * 10.0 ** rng.uniform(-4, 0, (STARTS, 1))
        for start in starts:
            q = self._least_squares(self.piece.with_pinned(start))
            if q is not None:
                self._known.append(q)
                return q
        self._hopeless = not self._known
        return None if self._hopeless else self._known[rng.integers(len(self._known))].copy()

    def _least_squares(self, start: Array) -> Array | None:
        """Return the configuration in the box to which least squares lead from the start, or None."""
        from scipy.optimize import least_squares

        piece, box = self.piece, self.box
        valued = piece.valued
        free = [i for i in range(len(start)) if i not in valued and i not in piece.pinned]
        if not free:
            return None
        far = 9 * piece.turns
        lower, upper = np.where(box.circular, (-far, far), (box.lower, box.upper))[:, free]
        period = np.maximum(piece.period, 1e-300)

        def at(x: Array) -> Array:
            q = start.copy()
            q[free] = x
            return piece.completed(q)

        def distance(x: Array) -> Array:
            check_time()
            q = at(x)
            turned = np.where(piece.angles, q - period * np.round((q - (box.lower + box.upper) / 2) / period), q)
            beyond = np.maximum(box.lower - turned, 0) + np.maximum(turned - box.upper, 0)
            return np.array([*(g(q) / g.size for g in piece.equations), *beyond[valued]])

        inside = np.clip(start[free], lower + 1e-12, np.maximum(upper - 1e-12, lower + 1e-12))
        tolerances = {"xtol": 1e-15, "ftol": 1e-15, "gtol": 1e-15, "max_nfev": MOST_EVALUATIONS}
        x = least_squares(distance, inside, bounds=(lower, upper + 1e-11), **tolerances).x
        return self._into_box(at(x)) if np.abs(distance(x)).max(initial=0.0) <= ON_THE_LOCUS else None

    def _into_box(self, q: Array) -> Array | None:
        """Return q with whole periods, of joints that have one, taken off so that it lies in the box; None if it
        cannot.
        """
        box, period = self.box, self.piece.period
        turned = np.where(box.circular, box.nearest(q), q)
        periods = np.ceil((box.lower - 1e-9 - turned) / np.where(period > 0, period, np.inf))
        outside = (turned < box.lower - 1e-9) | (turned > box.upper + 1e-9)
        turned = turned + np.where(~box.circular & outside, periods * period, 0.0)
        outside = (turned < box.lower - 1e-9) | (turned > box.upper + 1e-9)
        return None if outside.any() else turned


def special_configurations(piece: Piece, rng: np.random.Generator, count: int) -> Iterator[Array]:
    """Yield configurations, (n,), from at most `count` starts with most joints at multiples of π/2 and slides at zero,
    and from half as many random ones; those from which an equation can be solved.
    """
    n = len(piece.locus.trig_ring.q)
    for number in range(count + count // 2):
        check_time()
        q = np.where(piece.angles, piece.turns * rng.uniform(-np.pi, np.pi, n), rng.uniform(-1, 1, n))
        if number < count:
            at = np.where(piece.angles, piece.turns * rng.integers(-1, 3, n) * np.pi / 2, 0.0)
            q = np.where(rng.random(n) < 0.7, at, q)
        solved = _solved(piece, piece.with_pinned(q), rng)
        if solved is not None:
            yield piece.completed(solved)


def _solved(piece: Piece, q: Array, rng: np.random.Generator) -> Array | None:
    """Return q with the implicit equations solved, for one joint or by Newton's method."""
    left = [g for g in piece.equations if abs(g(q)) > ON_THE_LOCUS * g.size]
    if not left:
        return q
    if len(left) > 1:
        return _newton(piece, q)
    (g,) = left
    joints = [i for i, symbol in enumerate(g.q) if symbol in g.f.symbols and i not in piece.pinned]
    for i in rng.permutation(joints):
        roots = g.zeros_in(int(i), q)
        if roots:
            q[i] = rng.choice(roots)
            return q
    return None


def _newton(piece: Piece, q: Array) -> Array | None:
    """Return a point near q at which all implicit equations hold: Gauss-Newton steps of least norm."""
    moving = [i for i in range(len(q)) if i not in piece.pinned]
    for _ in range(NEWTON_STEPS):
        check_time()
        f = np.array([g(q) / g.size for g in piece.equations])
        if np.abs(f).max() <= ON_THE_LOCUS:
            return q
        slope = np.array([g.gradient(q)[moving] / g.size for g in piece.equations])
        step = np.linalg.lstsq(slope, -f, rcond=1e-10)[0]
        q[moving] += step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-300))
    return None
