"""Which solutions are in the same aspect: joined by a path without singularities."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.postures.determinant import determinant
from robotics1.ik.postures.labels import postures
from robotics1.ik.postures.path_between import PostureChangeStatus, by_signs, join
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import counting_number
from robotics1.notation import count


@dataclass(frozen=True)
class Aspects:
    """The solutions of one target in groups: those of a group are joined by paths without singularities.

    Attributes:
        groups: indices of solutions, a tuple for each aspect; singular solutions, which are on the border, are in none.
        proven: whether it is proven that no path joins two groups.
    """

    groups: tuple[tuple[int, ...], ...]
    proven: bool

    def explain(self) -> str:
        """Return the groups, in sentences."""
        if not self.groups:
            return "there is no solution apart from singularities"
        of = "; ".join(", ".join(str(i + 1) for i in group) for group in self.groups)
        sure = "no path without singularities joins them" if self.proven else "no path between them was found"
        return f"{count(len(self.groups), 'aspect')} with solutions {of}" + (
            f": {sure}" if len(self.groups) > 1 else ""
        )


def group_by_aspect(found: IKSolutions, *, samples: int = 600, seed: int = 0) -> Aspects:
    """Return which of the solutions a path without singularities joins, joint limits left aside.

    Args:
        found: what `ik_solutions` has found.
        samples: the most random configurations of the roadmap that looks for a path.
        seed: of these.

    Raises:
        InputError: this is no result of `ik_solutions`.
        TaskError: the task is moved by more or fewer joints than it has rows.

    Source: Borrel and Liégeois, A study of multiple manipulator inverse kinematic solutions with applications to
    trajectory planning and workspace determination, ICRA 1986 (aspects).
    """
    if not isinstance(found, IKSolutions) or found.robot is None or found.task is None:
        raise InputError("give what ik_solutions returns")
    seed, samples = counting_number("seed", seed), counting_number("samples", samples, least=1)
    det, names = determinant(found.robot, found.task), postures(found.robot, found.task)
    regular = np.flatnonzero(~found.singular).tolist()
    leader = {i: i for i in regular}
    doubts = []
    for i, j in combinations(regular, 2):
        if leader[i] == leader[j] or by_signs(det, names, found.q[[i, j]]) is not None:
            continue
        change = join(det, found.q[i], found.q[j], within_limits=False, samples=samples, seed=seed)
        if change.status is PostureChangeStatus.FOUND:
            leader |= {k: leader[i] for k in regular if leader[k] == leader[j]}
        elif not change.proven:
            doubts.append((i, j))
    groups = [tuple(k for k in regular if leader[k] == first) for first in dict.fromkeys(leader.values())]
    return Aspects(tuple(groups), all(leader[i] == leader[j] for i, j in doubts))
