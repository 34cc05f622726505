"""A path and a timing law make a trajectory: p(s(t))."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, one_of, real_array
from robotics1.paths.course import SAME_PLACE, Course, chain_rule
from robotics1.paths.interpolants import interpolants, largest, roots
from robotics1.trajectories.protocols import Side, TimingLaw, require_law, smooth_ends


@dataclass(frozen=True, eq=False)
class PathTrajectory:
    """p(s(t)), 0 ≤ t ≤ T: ṗ = p' ṡ, p̈ = p'' ṡ² + p' s̈, p⃛ = p''' ṡ³ + 3 p'' ṡ s̈ + p' s⃛.

    Of a path in Rⁿ the values are (n,) for a number and (k, n) for (k,) times. Of a pose they are `pin.SE3`, or a list
    of them, and the velocity is the twist (v, ω), (6,), in world axes; of an orientation (3, 3) and ω.

    At a switching time `side` says from which side a value is taken; "right", the default, is just after it. There the
    path may be at a break, and the law at a switching time of its own.

    Attributes:
        path: p(s), or poses T(s), or orientations R(s).
        law: s(t), in the parameter of the path: the arc length [m] where |p'| = 1.
    """

    path: Course
    law: TimingLaw

    def __post_init__(self) -> None:
        """Refuse a law that leaves the path."""
        if not isinstance(self.path, Course):
            raise InputError(f"path must be a path, such as line_path(...); it is {self.path!r}")
        object.__setattr__(self, "law", require_law("law", self.law))
        high = largest(lambda t, side: np.asarray(self.law(t)), self._law_ends).value
        low = -largest(lambda t, side: -np.asarray(self.law(t)), self._law_ends).value
        slack = SAME_PLACE * self.path.end
        if low < -slack or high > self.path.end + slack:
            raise InputError(
                f"the law must stay on the path, 0 ≤ s ≤ {self.path.end:.10g}; it goes from {low:.10g} to {high:.10g}"
            )

    @property
    def duration(self) -> float:
        """T [s]."""
        return float(self.law.duration)

    @cached_property
    def switching_times(self) -> Array:
        """The instants in (0, T) at which a derivative may jump [s]: the law's own, and where the path has a break."""
        ends = self._law_ends
        pieces = interpolants(lambda t: np.asarray(self.law(t)), ends)[0] if len(self.path.breaks) else []
        passed = [t for place in self.path.breaks for piece in pieces for t in roots(piece - place)]
        times = list(ends)
        for t in passed:
            if min(abs(t - other) for other in times) > SAME_PLACE * self.duration:
                times.append(t)
        return np.sort(times)[1:-1]

    def __call__(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return p(s(t)).

        Raises:
            InputError: a time is outside the trajectory.
        """
        return self.path(self._s(t)[0], side=side)

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return ṗ(t)."""
        return self._rate(t, 1, side)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return p̈(t)."""
        return self._rate(t, 2, side)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of p(t)."""
        return self._rate(t, 3, side)

    def _rate(self, t: npt.ArrayLike, order: int, side: Side) -> Array:
        one_of("side", side, ("right", "left"))
        s, times = self._s(t)
        laws = [self.law.velocity, self.law.acceleration, self.law.jerk]
        rates = tuple(np.atleast_1d(rate(times, side=side)) for rate in laws)
        at = np.atleast_1d(times)
        after = at < self.duration if side == "right" else at <= 0.0  # whether the values are those just after t
        forward = np.where(after, _ahead(*rates), ~_ahead(rates[0], -rates[1], rates[2]))
        place = np.atleast_1d(s)
        p = tuple(self._derivative(place, k, forward) for k in range(1, order + 1))
        values = chain_rule(rates[:order], p)
        return values if np.ndim(s) else values[0]

    def _derivative(self, s: Array, order: int, after: npt.NDArray[np.bool_]) -> Array:
        """Return the derivative of the path on the side of larger s where `after`, else on that of smaller s."""
        right = self.path.derivative(s, order, side="right")
        if after.all() or not len(self.path.breaks):
            return right
        return np.where(after[:, None], right, self.path.derivative(s, order, side="left"))

    def _s(self, t: npt.ArrayLike) -> tuple[Any, Any]:
        """Return s(t), on the path also where the law is rounded, and the times as the law takes them."""
        times = real_array("t", t, (None,) * min(dimensions("t", t), 1), "seconds")
        instants: Any = times if times.ndim else float(times)
        return np.clip(self.law(instants), 0.0, self.path.end), instants

    @property
    def _law_ends(self) -> list[float]:
        return smooth_ends(self.law)


def _ahead(v: Array, a: Array, j: Array) -> npt.NDArray[np.bool_]:
    """Return whether s grows from t on, (k,): s(t + ε) − s(t) = v ε + a ε²/2 + j ε³/6, and the first term decides.

    Just before, s(t) − s(t − ε) = v ε − a ε²/2 + j ε³/6; where that is positive, s came from below.
    """
    return np.asarray(np.where(v != 0, v, np.where(a != 0, a, j)) >= 0)
