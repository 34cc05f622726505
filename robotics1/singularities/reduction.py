"""What is kept of a chunk of configurations, and how two chunks become one."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.singularities.distribution import MeasureDistribution, distribution_of
from robotics1.singularities.samples import Chunk

if TYPE_CHECKING:
    from robotics1.singularities.measurement import Measurement

WORST_IS_LARGEST = {"sigma_min": False, "condition": True, "manipulability": False}
MEASURES = tuple(WORST_IS_LARGEST)


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

    def joined(self, other: "Reduction", keep: int) -> "Reduction":
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


def reduced(measurement: "Measurement", chunk: Chunk, measures: tuple[str, ...], keep: int) -> Reduction:
    """Return what is kept of a chunk: this runs in the worker processes."""
    q = chunk.points()
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
