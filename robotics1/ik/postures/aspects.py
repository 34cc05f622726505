"""Which solutions are in the same aspect: joined by a path without singularities."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.postures.determinant import Determinant, determinant
from robotics1.ik.postures.labels import postures
from robotics1.ik.postures.path_between import (
    PostureChangeStatus,
    by_signs,
    growing,
    path_of,
    region_of,
)
from robotics1.ik.postures.separation import are_apart, wall_between
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array, counting_number
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
    if not isinstance(found, IKSolutions):
        raise InputError("give what ik_solutions returns")
    seed, samples = counting_number("seed", seed), counting_number("samples", samples, least=1)
    det, names = determinant(found.robot, found.task), postures(found.robot, found.task)
    regular = np.flatnonzero(~found.singular).tolist()
    leader = {i: i for i in regular}
    proven = True
    for sign in (1.0, -1.0):
        members = [i for i in regular if sign * det(found.q[[i]])[0] > 0]
        pairs = [(i, j) for i, j in combinations(members, 2) if by_signs(det, names, found.q[[i, j]]) is None]
        if pairs:
            proven &= _merge(det, found.q, members, pairs, leader, samples, seed)
    groups = [tuple(k for k in regular if leader[k] == first) for first in dict.fromkeys(leader.values())]
    return Aspects(tuple(groups), proven)


def _merge(
    det: Determinant,
    q: Array,
    members: list[int],
    pairs: list[tuple[int, int]],
    leader: dict[int, int],
    samples: int,
    seed: int,
) -> bool:
    """Give one leader to those of the pairs that a path joins; return whether the others are proven to be apart."""
    for drawn, region in growing(region_of(det, q[members], within_limits=False), samples, seed):
        for i, j in pairs:
            if leader[i] == leader[j]:
                continue
            a, b = members.index(i), members.index(j)
            corners = region.path(a, b) if drawn else region.direct(q[i], q[j])
            if path_of(region, corners, q[i], q[j]).status is PostureChangeStatus.FOUND:
                first, other = leader[i], leader[j]
                leader.update({k: first for k in leader if leader[k] == other})
        if all(leader[i] == leader[j] for i, j in pairs):
            return True
    return det.has_bound and all(
        leader[i] == leader[j] or wall_between(region, q[i], q[j]) != "" or are_apart(region, q[i], q[j])
        for i, j in pairs
    )
