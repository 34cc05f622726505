"""The answer of a scan."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of
from robotics1.names import printable
from robotics1.robot.model import Robot
from robotics1.singularities.distribution import MeasureDistribution
from robotics1.singularities.refinement import Refinement
from robotics1.tasks.task import Task


@dataclass(frozen=True, eq=False)
class SingularityScan:
    """How near to singular a task is, at many configurations of a robot.

    Attributes:
        robot, task: what was scanned.
        method: how the configurations were chosen: "random", "sobol" or "grid".
        seed: of the random numbers.
        count: how many configurations there were.
        undefined: at how many of them the task has no Jacobian; they are in `count`, and nowhere else.
        rank: ρ, the rank of J almost everywhere, and how many singular values the measures count.
        length: the length that counts as one in J [m].
        distributions: measure → its values, in the order in which the measures were asked for.
        worst: (k, nq) the configurations nearest to singular by the first measure, the nearest first.
        worst_values: (k,) the first measure there.
        refined: the worst, moved to singular configurations, if `refine` asked for it.
    """

    robot: Robot = field(repr=False)
    task: Task = field(repr=False)
    method: str
    seed: int
    count: int
    undefined: int
    rank: int
    length: float
    distributions: Mapping[str, MeasureDistribution]
    worst: Array
    worst_values: Array
    refined: Refinement | None = None

    @property
    def measures(self) -> tuple[str, ...]:
        """The measures, the one that tells what is worst first."""
        return tuple(self.distributions)

    def distribution(self, measure: str | None = None) -> MeasureDistribution:
        """Return the distribution of a measure, by default the first.

        Raises:
            InputError: the measure was not asked for.
        """
        return self.distributions[one_of("measure", measure or self.measures[0], self.measures)]

    def minimum(self, measure: str | None = None) -> float:
        """Return the least value of a measure."""
        return self.distribution(measure).minimum

    def maximum(self, measure: str | None = None) -> float:
        """Return the largest value of a measure."""
        return self.distribution(measure).maximum

    def quantile(self, p: float, measure: str | None = None) -> float:
        """Return the value that a part p of the configurations do not exceed, to 0.4 %."""
        return self.distribution(measure).quantile(p)

    def histogram(self, measure: str | None = None, *, per_octave: int = 1) -> tuple[Array, npt.NDArray[np.int64]]:
        """Return edges (b + 1,) and counts (b,) of a histogram with 1, 2, 4, ... or 128 bins from x to 2x."""
        return self.distribution(measure).histogram(per_octave)

    def require_refined(self) -> Refinement:
        """Return the refinement.

        Raises:
            InputError: the scan was not asked to refine.
        """
        if self.refined is None:
            raise InputError("nothing was refined; ask for it with refine=10")
        return self.refined

    def explain(self) -> str:
        """Return the answer in sentences."""
        from robotics1.singularities.scan_words import scan_sentences

        return printable(scan_sentences(self), keep="\n")
