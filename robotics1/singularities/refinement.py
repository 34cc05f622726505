"""From nearly singular configurations to singular ones, and to the branches of the singular set they lie on."""

from collections.abc import Hashable, Mapping, Sequence

import numpy as np

from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.singularities.find import find_singularities
from robotics1.singularities.points import SingularPoints
from robotics1.singularities.result import SingularBranch
from robotics1.singularities.scan_result import RefinedGroup, Refinement

ONE_PLACE = 1e-6  # distance of two configurations that are one [rad, or reach]
NOTHING = "The robot has no joints."
STANDS_STILL = 1e-2  # part of a tangent direction that a constant joint may have


def refine(
    points: SingularPoints, worst: Array, box: Mapping[str, tuple[float, float]] | None, seed: int
) -> Refinement:
    """Move configurations to the singular set, and find which of its branches they are on.

    Args:
        points: the singular set of a robot and a task.
        worst: (k, nq) where to start.
        box: that of `find_singularities`.
        seed: of the random numbers.
    """
    if points.rank == 0:
        return Refinement((), tuple(range(len(worst))), None, NOTHING)
    found, note = None, ""
    try:
        found = find_singularities(points.robot, points.task, method="symbolic", box=box, seed=seed)
    except FormulaError as error:
        note = f"There are no formulas: {error}."
    branches = () if found is None else found.branches
    rng = np.random.default_rng(seed)
    kinds: dict[Hashable, tuple[int | None, dict[str, float]]] = {}
    members: dict[Hashable, list[tuple[int, Array]]] = {}
    unreached = []
    for start, q in enumerate(worst):
        p = points.project(points.box.nearest(q))
        if p is None:
            unreached.append(start)
            continue
        branch = next((i for i, known in enumerate(branches) if _lies_on(points, p, known)), None)
        values = {} if branch is not None else _still(points, p, rng)
        alike = (branch, *((name, round(value, 5)) for name, value in values.items()))
        kinds.setdefault(alike, (branch, values))
        members.setdefault(alike, []).append((start, p))
    ordered = sorted(members, key=lambda alike: -len(members[alike]))
    groups = tuple(_group(points, *kinds[alike], members[alike]) for alike in ordered)
    return Refinement(groups, tuple(unreached), found, note)


def _group(
    points: SingularPoints, branch: int | None, values: Mapping[str, float], members: Sequence[tuple[int, Array]]
) -> RefinedGroup:
    distinct: list[Array] = []
    for _, q in members:
        if all(np.linalg.norm(points.box.difference(q, other)) > ONE_PLACE for other in distinct):
            distinct.append(q)
    sigmas = np.array([points.relative_sigma(q) for q in distinct])
    ranks, starts = tuple(map(points.rank_at, distinct)), tuple(start for start, _ in members)
    return RefinedGroup(branch, np.array(distinct), sigmas, ranks, starts, values)


def _lies_on(points: SingularPoints, q: Array, branch: SingularBranch) -> bool:
    """Whether q is on a branch; of one that was found by numbers, if its constant joints decide it."""
    if branch.formulas is not None:
        return branch.contains(q)
    if branch.tied_joints:
        return False
    places = [points.robot.joint_names.index(name) for name in branch.values]
    apart = points.box.difference(q, branch.q)[places]
    return bool(np.abs(apart).max(initial=0.0) <= ONE_PLACE)


def _still(points: SingularPoints, q: Array, rng: np.random.Generator) -> dict[str, float]:
    """Return joint → value of the joints that stand still on the set near q."""
    still = np.linalg.norm(points.tangent(q, rng), axis=1) < STANDS_STILL
    return {name: float(q[i]) for i, name in enumerate(points.robot.joint_names) if still[i]}
