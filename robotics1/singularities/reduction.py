"""What is kept of numbers too many to keep: how a measure is distributed, and where it is worst.

The distribution is a histogram whose bins are of equal relative width. Two chunks of configurations become one.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import reduce
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number, real_number
from robotics1.results import Frozen
from robotics1.singularities.samples import Chunk

if TYPE_CHECKING:
    from robotics1.singularities.measurement import Measurement

LOWEST, HIGHEST = -60, 60  # powers of two; what is smaller or larger goes to the two outer bins
PER_OCTAVE = 128
SHIFT = 52 - 7  # a double is 52 bits of mantissa below its exponent; 7 of them tell which of the 128 bins
FIRST = (1023 + LOWEST) * PER_OCTAVE  # 1023 is the exponent of 1
BINS = (HIGHEST - LOWEST) * PER_OCTAVE + 2
Measure = Literal["sigma_min", "condition", "manipulability"]
WORST_IS_LARGEST = {"sigma_min": False, "condition": True, "manipulability": False}
MEASURES: tuple[Measure, ...] = get_args(Measure)


@dataclass(frozen=True, eq=False)
class MeasureDistribution(Frozen):
    """The values that a measure takes.

    Attributes:
        count: how many there are.
        minimum, maximum: the extreme ones, exactly; NaN if there are none.
        bins: how many are in each bin. There are 128 to an octave, from 2⁻⁶⁰ to 2⁶⁰, and one at each end for what is
            smaller and larger; within an octave they are equally wide.
    """

    count: int
    minimum: float
    maximum: float
    bins: npt.NDArray[np.int64]

    def quantile(self, p: float) -> float:
        """Return the value that a part p of the others do not exceed, 0 ≤ p ≤ 1, to 0.4 %.

        Raises:
            InputError: p is not between 0 and 1, or there are no values.
        """
        p = real_number("p", p, non_negative=True)
        if p > 1:
            raise InputError(f"p must be between 0 and 1; it is {p:g}")
        if self.count == 0:
            raise InputError("there are no values, so there is no quantile")
        if p in (0, 1):
            return self.maximum if p else self.minimum
        place = int(np.searchsorted(np.cumsum(self.bins), max(1, np.ceil(p * self.count))))
        edges = _edges()
        middle = (edges[place] + edges[place + 1]) / 2
        return float(np.clip(middle, self.minimum, self.maximum))

    def histogram(self, per_octave: int = 1) -> tuple[Array, npt.NDArray[np.int64]]:
        """Return the edges (b + 1,) and the counts (b,) of a histogram from the least value to the largest.

        Args:
            per_octave: how many bins there are between a number and its double: 1, 2, 4, ..., 128. The first edge is
                0 if there are values below 2⁻⁶⁰, the last one infinite if there are some above 2⁶⁰.

        Raises:
            InputError: another number of bins.
        """
        if counting_number("per_octave", per_octave, least=1) > PER_OCTAVE or PER_OCTAVE % per_octave:
            raise InputError(f"per_octave must be 1, 2, 4, ... or 128; it is {per_octave}")
        joined = PER_OCTAVE // per_octave
        counts = np.concatenate([self.bins[:1], self.bins[1:-1].reshape(-1, joined).sum(axis=1), self.bins[-1:]])
        edges = np.concatenate([[0.0], _edges()[1:-1:joined], [np.inf]])
        filled = np.flatnonzero(counts)
        if not filled.size:
            return edges[:1], counts[:0]
        return edges[filled[0] : filled[-1] + 2], counts[filled[0] : filled[-1] + 1]

    def joined(self, other: MeasureDistribution) -> MeasureDistribution:
        """Return the distribution of these values and the other's."""
        return MeasureDistribution(
            self.count + other.count,
            float(np.fmin(self.minimum, other.minimum)),
            float(np.fmax(self.maximum, other.maximum)),
            self.bins + other.bins,
        )


def distribution_of(values: Array) -> MeasureDistribution:
    """Return the distribution of values, none negative and none NaN.

    The bits of a positive double, as an integer, grow with it: the leading ones are the number of its bin.
    """
    place = (np.ascontiguousarray(values, dtype=float).view(np.int64) >> SHIFT) - (FIRST - 1)
    bins = np.bincount(np.clip(place, 0, BINS - 1), minlength=BINS)
    least, largest = (float(values.min()), float(values.max())) if values.size else (np.nan, np.nan)
    return MeasureDistribution(values.size, least, largest, bins)


def _edges() -> Array:
    """Return the edges of the bins, (BINS + 1,): 0, 2⁻⁶⁰, ..., 2⁶⁰, ∞."""
    octaves = np.ldexp(1.0, np.arange(LOWEST, HIGHEST))
    inner = np.outer(octaves, 1 + np.arange(PER_OCTAVE) / PER_OCTAVE).ravel()
    return np.concatenate([[0.0], inner, [np.ldexp(1.0, HIGHEST), np.inf]])


@dataclass(frozen=True, eq=False)
class Reduction:
    """Counts, distributions, and the worst configurations by the first measure, the worst first.

    Attributes:
        count: how many configurations there are.
        undefined: at how many of them the task has no Jacobian; the rest holds for the others.
        distributions: measure → its distribution.
        worst: (k, n) configurations.
        worst_values: (k,) the first measure there.
    """

    count: int
    undefined: int
    distributions: Mapping[str, MeasureDistribution]
    worst: Array
    worst_values: Array

    def joined(self, other: Reduction, keep: int) -> Reduction:
        """Return the reduction of this chunk and the next; of equal values the earlier is the worse."""
        values = np.concatenate([self.worst_values, other.worst_values])
        chosen = _worst(values, next(iter(self.distributions)), keep)
        return Reduction(
            self.count + other.count,
            self.undefined + other.undefined,
            {name: known.joined(other.distributions[name]) for name, known in self.distributions.items()},
            np.concatenate([self.worst, other.worst])[chosen],
            values[chosen],
        )

    def as_arrays(self) -> dict[str, npt.NDArray[Any]]:
        """Return what `reduction_from` takes."""
        arrays = {
            "counts": np.array([self.count, self.undefined]),
            "worst": self.worst,
            "worst_values": self.worst_values,
        }
        for name, known in self.distributions.items():
            arrays[f"{name}_count"] = np.array(known.count)
            arrays[f"{name}_extremes"] = np.array([known.minimum, known.maximum])
            arrays[f"{name}_bins"] = known.bins
        return arrays


def reduction_from(arrays: Mapping[str, npt.NDArray[Any]], measures: tuple[str, ...]) -> Reduction:
    """Return the reduction whose `as_arrays` these are."""
    count, undefined = arrays["counts"].tolist()
    distributions = {}
    for name in measures:
        least, largest = arrays[f"{name}_extremes"].tolist()
        bins = arrays[f"{name}_bins"]
        distributions[name] = MeasureDistribution(int(arrays[f"{name}_count"]), least, largest, bins)
    return Reduction(count, undefined, distributions, arrays["worst"], arrays["worst_values"])


def joined_together(keep: int, parts: Iterable[Reduction]) -> Reduction:
    """Return the reduction of all chunks of some reductions, in their order; one at a time is in memory."""
    return reduce(lambda total, part: total.joined(part, keep), parts)


def reduced_together(
    measurement: Measurement, measures: tuple[str, ...], keep: int, chunks: tuple[Chunk, ...]
) -> Reduction:
    """Return what is kept of some chunks, joined where they were measured: this runs in the workers."""
    return joined_together(keep, (reduced(measurement, measures, keep, chunk) for chunk in chunks))


def reduced(measurement: Measurement, measures: tuple[str, ...], keep: int, chunk: Chunk) -> Reduction:
    """Return what is kept of a chunk."""
    q = chunk()
    values = measurement.measures(q, measures)
    defined = ~np.isnan(values[measures[0]])
    if not defined.all():
        q, values = q[:, defined], {name: value[defined] for name, value in values.items()}
    first = values[measures[0]]
    chosen = _worst(first, measures[0], keep)
    distributions = {name: distribution_of(value) for name, value in values.items()}
    undefined = int(np.count_nonzero(~defined))
    return Reduction(len(defined), undefined, distributions, q[:, chosen].T.copy(), first[chosen])


def _worst(values: Array, measure: str, keep: int) -> npt.NDArray[np.intp]:
    """Return the places of the worst values, the worst first; of equal ones the earlier first."""
    order = -values if WORST_IS_LARGEST[measure] else values
    if len(order) > keep:
        limit = np.partition(order, keep - 1)[keep - 1]
        places = np.flatnonzero(order <= limit)
        return places[np.argsort(order[places], kind="stable")][:keep]
    return np.argsort(order, kind="stable")
