"""What a robust inverse kinematics returns: for one target, and for many."""

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.errors import NotConverged
from robotics1.ik.status import IKStatus
from robotics1.inputs import Array


class IKResult(NamedTuple):
    """The answer for one target; a tuple, since a frozen dataclass takes longer to make than a tracking step to solve.

    Attributes:
        status: CONVERGED, UNREACHABLE or NOT_FOUND.
        q: (nq,) the solution, inside the joint limits; else the configuration with the least error that was found.
        error: |r_d − f(q)| [m, rad], by forward kinematics at `q`.
        starts: how many starts were tried.
    """

    status: IKStatus
    q: Array
    error: float
    starts: int

    def __eq__(self, other: object) -> bool:
        """Return whether all entries are the same; a plain tuple would ask an array whether it is true."""
        if not isinstance(other, IKResult) or not np.array_equal(self.q, other.q):
            return False
        return (self.status, self.error, self.starts) == (other.status, other.error, other.starts)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(tuple(self))  # which says that an array has none

    @property
    def converged(self) -> bool:
        """Whether `q` is a solution: |e| is within the tolerance, and all joints are inside their limits."""
        return self.status is IKStatus.CONVERGED

    def require(self) -> "IKResult":
        """Return self if it converged.

        Raises:
            NotConverged: it did not; the message says why.
        """
        if not self.converged:
            raise NotConverged(
                f"{self.status.value}; the nearest that was found has |e| = {self.error:.3g} ({self.starts} starts)",
                self,
            )
        return self


@dataclass(frozen=True, eq=False)
class IKBatch:
    """The answers for k targets, in their order.

    Attributes:
        q: (k, nq); each row is what `IKResult.q` is.
        status: (k,) of IKStatus.
        error: (k,) |r_d − f(q)| [m, rad].
        starts: (k,) how many starts were tried.
    """

    q: Array
    status: npt.NDArray[Any]
    error: Array
    starts: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.q)

    def __getitem__(self, i: int) -> IKResult:
        return IKResult(self.status[i], self.q[i], float(self.error[i]), int(self.starts[i]))

    @property
    def converged(self) -> npt.NDArray[np.bool_]:
        """(k,) whether each row of `q` is a solution."""
        return np.array(self.status == IKStatus.CONVERGED, dtype=bool)

    def require(self) -> "IKBatch":
        """Return self if every target was reached.

        Raises:
            NotConverged: one was not; the message says which, and why.
        """
        missed = np.flatnonzero(~self.converged)
        if missed.size:
            first = self[int(missed[0])]
            raise NotConverged(
                f"{missed.size} of {len(self)} targets were not reached; the first is target {missed[0]}: "
                f"{first.status.value}, |e| = {first.error:.3g}",
                self,
            )
        return self
