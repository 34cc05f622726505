"""The closed form of the error of a linear law: ė = −K e, or ë = −D ė − K e."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import FormulaError, InputError
from robotics1.inputs import Array, counting_number, real_array, real_number
from robotics1.results import Frozen

COMMUTE = 1e-9  # relative: D K − K D below this is rounding
SEARCHED = 4001  # times at which a decay is looked at, to some time constants after it has ended


@dataclass(frozen=True, eq=False)
class ErrorDecay(Frozen):
    """e(t) of ė = −K e, e(t) = exp(−K t) e₀; or of ë + D ė + K e = 0 from e₀ and ė₀.

    Attributes:
        K: (m, m).
        D: (m, m), or None for first order.
        start: (m,) e₀.
        start_rate: (m,) ė₀, of second order.
    """

    K: Array
    D: Array | None
    start: Array
    start_rate: Array | None

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return e(t), (m,), or (k, m) for (k,) times."""
        from scipy.linalg import expm

        times = real_array("t", np.atleast_1d(np.asarray(t, dtype=float)), (None,), "times [s]")
        m = len(self.start)
        values = np.array([(expm(self._matrix * x) @ self._state)[:m] for x in times]).reshape(len(times), m)
        return values if np.ndim(t) else np.asarray(values[0])

    @property
    def rates(self) -> npt.NDArray[Any]:
        """The eigenvalues of the error equation [1/s]; of first order −kᵢ. The slowest is first."""
        values = np.linalg.eigvals(self._matrix)
        return np.asarray(values[np.argsort(-values.real)])

    @property
    def formula(self) -> Any:
        """e(t), a SymPy column in t: of each mode e^(−λ t), or of second order what its discriminant says.

        Raises:
            FormulaError: the gains have no common, orthogonal modes.
        """
        import sympy

        t = sympy.Symbol("t", nonnegative=True)
        V = self._modes
        start = V.T @ self.start
        rate = np.zeros(len(start)) if self.start_rate is None else V.T @ self.start_rate
        k = np.diag(V.T @ self.K @ V)
        d = [None] * len(k) if self.D is None else np.diag(V.T @ self.D @ V).tolist()
        modes = [_mode(t, *map(_neat, x)) for x in zip(k, d, start, rate, strict=True)]
        columns = [[_neat(entry) for entry in row] for row in V]
        return (sympy.Matrix(columns) * sympy.Matrix(modes)).applyfunc(sympy.collect_const)

    def time_to(self, ratio: float) -> float:
        """Return the last time at which |e(t)| = ratio |e₀|: afterwards it is smaller [s]; 0 where it always is.

        Raises:
            InputError: the ratio is not between 0 and 1.
        """
        from scipy.optimize import brentq

        wanted = real_number("ratio", ratio, positive=True)
        if wanted >= 1:
            raise InputError(f"ratio must be below 1; it is {wanted:g}")
        size = wanted * float(np.linalg.norm(self.start))
        if size == 0:
            return 0.0
        end = (np.log(1 / wanted) + 10) / -float(self.rates[0].real)
        while True:
            times = np.linspace(0.0, end, SEARCHED)
            above = np.flatnonzero(self._sizes(times) > size)
            if not len(above):
                return 0.0
            if (i := above[-1]) < len(times) - 1:
                break
            end *= 2  # a large ė₀ makes e large before it decays
        return float(brentq(lambda x: float(np.linalg.norm(self(x))) - size, times[i], times[i + 1], xtol=1e-14))

    @property
    def largest_step(self) -> float:
        """The sampling time h [s] below which the sampled law converges, its command held constant for h.

        Of first order e_{k+1} = (1 − h K) e_k, and |1 − h λ| < 1 for every eigenvalue λ of K: h < 2 Re λ/|λ|², which is
        2/k for one gain; at h = 1/k the error is zero after one step. Of second order, with the modes k and d of K and
        D: h < 2/d and h < 2d/k. A Cartesian law behaves so near its target.

        Raises:
            FormulaError: of second order, K and D have no common modes.

        Source: Åström, Wittenmark, Computer-Controlled Systems, 1997, sections 2.3 (sampling) and 3.2 (Jury's test).
        """
        if self.D is None:
            values = np.linalg.eigvals(self.K)
            return float((2 * values.real / np.abs(values) ** 2).min(initial=np.inf))
        V = self._modes
        k, d = (np.diag(V.T @ G @ V) for G in (self.K, self.D))
        return float(np.minimum(2 / d, 2 * d / k).min(initial=np.inf))

    def sampled(self, step: float, steps: int) -> Array:
        """Return e at the times 0, h, 2h, ..., (steps + 1, m), with the command held constant in between.

        Args:
            step: h > 0 [s].
            steps: how many.

        Raises:
            InputError: h is not positive, or steps no positive integer.
        """
        h, m = real_number("step", step, positive=True), len(self.start)
        one = np.eye(m)
        A = one - h * self.K
        if self.D is not None:
            A = np.block([[one - h * h / 2 * self.K, h * one - h * h / 2 * self.D], [-h * self.K, one - h * self.D]])
        states = [self._state]
        for _ in range(counting_number("steps", steps, least=1, most=1_000_000)):
            states.append(A @ states[-1])
        return np.array(states)[:, :m]

    def _sizes(self, times: Array) -> Array:
        """Return |e| at equally spaced times, step by step."""
        from scipy.linalg import expm

        step, x, m = expm(self._matrix * times[1]), self._state, len(self.start)
        sizes = []
        for _ in times:
            sizes.append(float(np.linalg.norm(x[:m])))
            x = step @ x
        return np.array(sizes)

    @property
    def _matrix(self) -> Array:
        if self.D is None:
            return -self.K
        zero, one = np.zeros_like(self.K), np.eye(len(self.K))
        return np.block([[zero, one], [-self.K, -self.D]])

    @property
    def _state(self) -> Array:
        return self.start if self.start_rate is None else np.concatenate([self.start, self.start_rate])

    @property
    def _modes(self) -> Array:
        """Orthonormal columns in which the gains are diagonal, (m, m).

        Raises:
            FormulaError: there are none.
        """
        gains = [self.K] if self.D is None else [self.K, self.D]
        diagonal = all(np.array_equal(G, np.diag(np.diag(G))) for G in gains)
        if diagonal:
            return np.eye(len(self.K))
        symmetric = all(np.allclose(G, G.T, rtol=1e-12) for G in gains)
        apart = 0.0 if self.D is None else float(np.abs(self.K @ self.D - self.D @ self.K).max(initial=0.0))
        scale = 1.0 if self.D is None else float(np.linalg.norm(self.K) * np.linalg.norm(self.D))
        if not symmetric or apart > COMMUTE * scale:
            raise FormulaError("the error has no modes that decay alone: K is not symmetric, or K and D do not commute")
        mixed = self.K if self.D is None else self.K + np.pi * self.D
        return np.asarray(np.linalg.eigh(mixed)[1])


def _neat(x: float | None) -> Any:
    """Return a number as a short fraction where it is one, else as it is."""
    import sympy

    if x is None:
        return None
    near = sympy.Rational(x).limit_denominator(1000)
    return near if abs(float(near) - x) <= 1e-12 * max(1.0, abs(x)) else sympy.Float(x)


def _mode(t: Any, k: Any, d: Any, e: Any, rate: Any) -> Any:
    """Return x(t) of ẋ = −k x, or of ẍ + d ẋ + k x = 0, from e and its rate."""
    import sympy

    if d is None:
        return e * sympy.exp(-k * t)
    a, discriminant = d / 2, d**2 / 4 - k
    if discriminant == 0:
        return (e + (rate + a * e) * t) * sympy.exp(-a * t)
    if discriminant > 0:
        b = sympy.sqrt(discriminant)
        first, second = -a + b, -a - b
        return ((rate - second * e) * sympy.exp(first * t) - (rate - first * e) * sympy.exp(second * t)) / (2 * b)
    w = sympy.sqrt(-discriminant)
    return sympy.exp(-a * t) * (e * sympy.cos(w * t) + (rate + a * e) / w * sympy.sin(w * t))
