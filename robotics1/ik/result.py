"""How an inverse kinematics ends, and what the robust one returns: for one target, and for many."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import Enum
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.notation import vector
from robotics1.other_words import names_what_is_meant
from robotics1.results import Frozen, require, tuple_with_arrays
from robotics1.tables import in_html


class IKStatus(Enum):
    """How an inverse kinematics ended: one solution, all solutions, or none and why."""

    CONVERGED = "the error is within the tolerance"
    FINITE = "finitely many solutions"
    BOUNDARY = "finitely many solutions, at a boundary of the reach or a singularity: two or more meet"
    INFINITE = "infinitely many solutions"
    SINGULAR = "J is singular, so Newton's step does not exist; 'pseudoinverse' or 'damped' go on from here"
    STALLED = "Jᵀe = 0 with e ≠ 0: no step along J reduces the error; start elsewhere"
    MAX_ITERATIONS = "the number of iterations is used up"
    DIVERGED = "the iterates grow without bound; a smaller gain or 'damped' would not"
    UNREACHABLE = "it is proven that no q inside the limits reaches the target"
    NOT_FOUND = (
        "no start led to the target within the time limit or the number of starts; that proves nothing, but it is "
        "likely out of reach"
    )


@names_what_is_meant
@tuple_with_arrays
class IKResult(NamedTuple):
    """The answer for one target; a tuple, since a frozen dataclass takes longer to make than a tracking step to solve.

    Attributes:
        status: CONVERGED, UNREACHABLE or NOT_FOUND.
        q: (nq,) the solution, inside the joint limits; else the configuration with the least error that was found.
        error_norm: |r_d − f(q)| [m, rad], by forward kinematics at `q`.
        starts: how many starts were tried.
    """

    status: IKStatus
    q: Array
    error_norm: float
    starts: int

    @property
    def converged(self) -> bool:
        """Whether `q` is a solution: |e| is within the tolerance, and all joints are inside their limits."""
        return self.status is IKStatus.CONVERGED

    def __str__(self) -> str:
        return f"{self.explain()}\nq = {vector(self.q)}"

    def _repr_html_(self) -> str:
        return in_html(str(self), ())

    def explain(self) -> str:
        """Return the status with |e| and the number of starts, in a sentence."""
        where = "|e| =" if self.converged else "the nearest that was found has |e| ="
        return f"{self.status.value}; {where} {self.error_norm:.3g} ({self.starts} starts)"

    def require(self) -> IKResult:
        """Return self if it converged.

        Raises:
            NotConverged: it did not; the message says why.
        """
        return require(self, self.converged)


@dataclass(frozen=True, eq=False)
class IKBatch(Frozen):
    """The answers for k targets, in their order.

    Attributes:
        q: (k, nq); each row is what `IKResult.q` is.
        status: (k,) of IKStatus.
        error_norm: (k,) |r_d − f(q)| [m, rad].
        starts: (k,) how many starts were tried.
    """

    q: Array
    status: npt.NDArray[Any]
    error_norm: Array
    starts: npt.NDArray[np.int64]

    @classmethod
    def of(cls, parts: Sequence[IKBatch]) -> IKBatch:
        """Return the batches one after the other as one."""
        return cls(*(np.concatenate([getattr(part, f.name) for part in parts]) for f in fields(cls)))

    def __len__(self) -> int:
        return len(self.q)

    def __getitem__(self, i: int) -> IKResult:
        return IKResult(self.status[i], self.q[i], float(self.error_norm[i]), int(self.starts[i]))

    @property
    def converged(self) -> npt.NDArray[np.bool_]:
        """(k,) whether each row of `q` is a solution."""
        return np.array(self.status == IKStatus.CONVERGED, dtype=bool)

    def explain(self) -> str:
        """Return how many targets were reached, and why the first of the others was not."""
        missed = np.flatnonzero(~self.converged)
        if not missed.size:
            return f"all of {len(self)} targets were reached"
        first = self[int(missed[0])]
        return (
            f"{missed.size} of {len(self)} targets were not reached; the first is target {missed[0]}: "
            f"{first.status.value}, |e| = {first.error_norm:.3g}"
        )

    def require(self) -> IKBatch:
        """Return self if every target was reached.

        Raises:
            NotConverged: one was not; the message says which, and why.
        """
        return require(self, bool(self.converged.all()))
