"""Random configurations on a locus."""

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import sympy

from robotics1.angles import TURN, clean_angle
from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.evaluation import Evaluated, evaluated_part
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.singular_sets.locus import Locus

ON_THE_LOCUS = 1e-12  # of an equation, beside the sum of its terms
HOLDS = 1e-10
TRIES = 100  # starts for a configuration in the box; a fifth of them where several equations must be solved
STEPS = 25  # of Newton's method
STARTS = 8  # of least squares
MOST_EVALUATIONS = 80  # of them, from one start


@dataclass(frozen=True, eq=False)
class Configurations:
    """The configurations of a locus at given lengths.

    Attributes:
        locus: the equations.
        parameters: the lengths.
        pinned: joint → the one of several values that the equations allow for it which is meant.
    """

    locus: Locus
    parameters: Mapping[sympy.Symbol, float]
    pinned: Mapping[int, float]

    @property
    def key(self) -> Hashable:
        """What is the same of two pieces with the same equations and choices."""
        return self.locus.key, frozenset(self.pinned.items())

    @cached_property
    def _angles(self) -> npt.NDArray[np.bool_]:
        F = self.locus.frequencies
        return np.array([symbol in F.angles for symbol in F.q])

    @cached_property
    def _turns(self) -> Array:
        """How many turns of each joint, (n,), bring everything back."""
        F = self.locus.frequencies
        return np.array([float(F.turns_of(symbol)) for symbol in F.q])

    @property
    def _period(self) -> Array:
        """What may be added to each joint, (n,): whole turns of angles [rad]; nothing to slides."""
        return np.where(self._angles, TURN * self._turns, 0.0)

    @cached_property
    def _implicit(self) -> list[Evaluated]:
        return [evaluated_part(part, self.parameters) for part in self.locus.implicit]

    @cached_property
    def _values(self) -> list[tuple[int, bool, Evaluated]]:
        """The joints that have a value: place, whether it is an angle, and the value."""
        q = self.locus.frequencies.q
        replaced = [s for s in self.locus.substitutions if s.symbol in q]
        return [(q.index(s.symbol), s.is_angle, Evaluated(s.value, self.parameters)) for s in replaced]

    def random(self, box: JointBox, rng: np.random.Generator) -> Array | None:
        """Return a configuration of the locus inside the box, (n,), or None when there seems to be none.

        Random joint values are completed to one where the box allows it; where it hardly ever does, the distance to
        the locus is made least, from several starts.

        Raises:
            OutOfTime: the time of a limit that is kept is over.
        """
        rare = len(self._implicit) > 1 or self._found.get((*box.lower, *box.upper))
        for start in box.random(rng, TRIES // 5 if rare else TRIES):
            check_time()
            solved = self._solved(self._with_pinned(start), rng)
            inside = None if solved is None else into(box, self._period, self._completed(solved))
            if inside is not None:
                return inside
        if not self._implicit and len(self.constant) == len(self._values) + len(self.pinned):
            return None  # all values are told, and one of them is outside
        return self._rare(box, rng)

    def special(self, rng: np.random.Generator, count: int) -> Iterator[Array | None]:
        """Yield configurations, (n,), most of whose joints are at multiples of π/2, and slides at zero, and half as
        many random ones; None where an equation cannot be solved.
        """
        n = len(self.locus.frequencies.q)
        for number in range(count + count // 2):
            check_time()
            q = np.where(self._angles, self._turns * rng.uniform(-np.pi, np.pi, n), rng.uniform(-1, 1, n))
            if number < count:
                at = np.where(self._angles, self._turns * rng.integers(-1, 3, n) * np.pi / 2, 0.0)
                q = np.where(rng.random(n) < 0.7, at, q)
            solved = self._solved(self._with_pinned(q), rng)
            yield None if solved is None else self._completed(solved)

    def _rare(self, box: JointBox, rng: np.random.Generator) -> Array | None:
        """Return a configuration found by least squares: from anywhere in the box, or near those found before."""
        place = (*box.lower, *box.upper)
        found = self._found.setdefault(place, [])
        if found is None:
            return None
        starts = box.random(rng, STARTS)
        if found:
            known = found[rng.integers(len(found))]
            starts = known + (starts - known) * 10.0 ** rng.uniform(-4, 0, (STARTS, 1))
        for start in starts:
            q = self._nearest(box, self._with_pinned(start))
            if q is not None:
                found.append(q)
                return q
        if found:
            return found[rng.integers(len(found))].copy()
        self._found[place] = None
        return None

    def remember(self, box: JointBox, found: list[Array]) -> None:
        """Let `random` start its least squares from configurations of the locus in the box that were found elsewhere;
        without any, it does not try these.
        """
        self._found[(*box.lower, *box.upper)] = found or None

    @cached_property
    def _found(self) -> dict[tuple[float, ...], list[Array] | None]:
        """What least squares have found in each box; None if nothing."""
        return {}

    def _nearest(self, box: JointBox, start: Array) -> Array | None:
        """Return a configuration of the locus in the box, to which least squares lead from the start."""
        from scipy.optimize import least_squares

        replaced = [i for i, _, _ in self._values]
        free = [i for i in range(len(start)) if i not in replaced and i not in self.pinned]
        if not free:
            return None
        far = 9 * self._turns
        lower, upper = np.where(box.circular, (-far, far), (box.lower, box.upper))[:, free]
        period = np.maximum(self._period, 1e-300)

        def at(x: Array) -> Array:
            q = start.copy()
            q[free] = x
            return self._completed(q)

        def distance(x: Array) -> Array:
            check_time()
            q = at(x)
            turned = np.where(self._angles, q - period * np.round((q - (box.lower + box.upper) / 2) / period), q)
            beyond = np.maximum(box.lower - turned, 0) + np.maximum(turned - box.upper, 0)
            return np.array([*(g(q) / g.size for g in self._implicit), *beyond[replaced]])

        inside = np.clip(start[free], lower + 1e-12, np.maximum(upper - 1e-12, lower + 1e-12))
        x = least_squares(
            distance,
            inside,
            bounds=(lower, upper + 1e-11),
            xtol=1e-15,
            ftol=1e-15,
            gtol=1e-15,
            max_nfev=MOST_EVALUATIONS,
        ).x
        if np.abs(distance(x)).max(initial=0.0) > ON_THE_LOCUS:
            return None
        return into(box, self._period, at(x))

    def _with_pinned(self, start: Array) -> Array:
        q = start.copy()
        for i, value in self.pinned.items():
            q[i] = value
        return q

    def _completed(self, q: Array) -> Array:
        """Return q with the joints that have a value at it."""
        for i, is_angle, f in self._values:
            q[i] = self._turns[i] * clean_angle(float(np.angle(f.complex(q)))) if is_angle else f(q)
        return q

    def contains(self, q: Array, tolerance: float = HOLDS) -> bool:
        """Return whether q is on the locus: its equations hold to the tolerance, beside the sum of their terms."""
        equations = [Evaluated(equation, self.parameters) for equation in self.locus.equations]
        pinned = all(abs(np.exp(1j * (q[i] - x) / self._turns[i]) - 1) < 1e-6 for i, x in self.pinned.items())
        return pinned and all(abs(f(q)) <= tolerance * f.size for f in equations)

    @property
    def constant(self) -> tuple[int, ...]:
        """The joints that have one value on all of the locus."""
        q = set(self.locus.frequencies.q)
        fixed = {i for i, _, value in self._values if not value.f.symbols & q}
        return tuple(sorted(fixed | set(self.pinned)))

    def dimension(self, q: Array) -> int:
        """Return the dimension of the locus at one of its points."""
        replaced = [i for i, _, _ in self._values]
        moving = [i for i in range(len(q)) if i not in replaced and i not in self.pinned]
        gradients = np.array([g.gradient(q)[moving] / max(g.size, 1e-300) for g in self._implicit])
        tied = int(np.linalg.matrix_rank(gradients, tol=1e-9)) if len(gradients) else 0
        return len(moving) - tied

    @property
    def is_regular(self) -> bool:
        """Whether no equation ties two joints together."""
        return all(len(part.symbols & set(self.locus.frequencies.q)) < 2 for part in self.locus.implicit)

    def is_degenerate(self, q: Array, small: float) -> bool:
        """Return whether the gradients of the implicit equations at q are dependent, to `small`."""
        gradients = np.array([g.gradient(q) / g.size for g in self._implicit if g.size])
        if len(gradients) > gradients.shape[1]:
            return True
        return bool(np.linalg.svd(gradients, compute_uv=False)[-1] <= small)

    def near(self, box: JointBox, start: Array) -> Array | None:
        """Return the configuration in the box that Newton's method or least squares lead to, or None."""
        q = self._newton(start.copy()) if len(self._implicit) > 1 else None
        inside = None if q is None else into(box, self._period, self._completed(q))
        return self._nearest(box, start) if inside is None else inside

    def _solved(self, q: Array, rng: np.random.Generator) -> Array | None:
        """Return q with the implicit equations solved, for one joint or by Newton's method."""
        left = [g for g in self._implicit if abs(g(q)) > ON_THE_LOCUS * g.size]
        if not left:
            return q
        if len(left) > 1:
            return self._newton(q)
        (g,) = left
        joints = [i for i, symbol in enumerate(g.q) if symbol in g.f.symbols and i not in self.pinned]
        for i in rng.permutation(joints):
            roots = g.zeros_in(int(i), q)
            if roots:
                q[i] = rng.choice(roots)
                return q
        return None

    def _newton(self, q: Array) -> Array | None:
        """Return a point near q at which all implicit equations hold: Gauss-Newton steps of least norm."""
        moving = [i for i in range(len(q)) if i not in self.pinned]
        for _ in range(STEPS):
            check_time()
            f = np.array([g(q) / g.size for g in self._implicit])
            if np.abs(f).max() <= ON_THE_LOCUS:
                return q
            slope = np.array([g.gradient(q)[moving] / g.size for g in self._implicit])
            step = np.linalg.lstsq(slope, -f, rcond=1e-10)[0]
            q[moving] += step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-300))
        return None


def into(box: JointBox, period: Array, q: Array) -> Array | None:
    """Return q with whole periods, of joints that have one, taken off so that it lies in the box; None if it cannot."""
    turned = np.where(box.circular, box.nearest(q), q)
    periods = np.ceil((box.lower - 1e-9 - turned) / np.where(period > 0, period, np.inf))
    outside = (turned < box.lower - 1e-9) | (turned > box.upper + 1e-9)
    turned = turned + np.where(~box.circular & outside, periods * period, 0.0)
    outside = (turned < box.lower - 1e-9) | (turned > box.upper + 1e-9)
    return None if outside.any() else turned
