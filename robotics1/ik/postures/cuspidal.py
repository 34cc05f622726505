"""Cuspidal arms: those that can change their posture without crossing a singularity."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from itertools import combinations

import numpy as np

from robotics1.ik.postures.cusps import Cusps, cusps
from robotics1.ik.postures.determinant import Determinant, determinant
from robotics1.ik.postures.labels import postures
from robotics1.ik.postures.path_between import PostureChange, PostureChangeStatus, path_of, region_of
from robotics1.ik.postures.roadmap import Region
from robotics1.ik.solutions import ik_solutions
from robotics1.inputs import Array, counting_number
from robotics1.notation import count
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.tasks.given import TaskLike, robot_and_task

REGULAR = 1e-3  # |det J|, beside its largest value, of the configurations that are asked about
BESIDE = (0.03, 0.1, 0.2, 0.3, 0.1, 0.2, 0.3)  # [rad] from a cusp, where three solutions are near
APART = 0.1  # of two solutions that are two postures, in units
NONE, NOTHING = np.zeros((0, 2)), np.zeros((0, 0))
Pair = tuple[Array, Array, PostureChange]
RISK = 0.05  # the chance of an error that a search is given


class CuspidalityStatus(Enum):
    """Whether an arm can change its posture without crossing a singularity."""

    CUSPIDAL = "cuspidal: a path without singularities joins two solutions of one target"
    NOT_CUSPIDAL = "not cuspidal: from one solution to another each path crosses a singularity"


@dataclass(frozen=True, eq=False)
class Cuspidality(Frozen):
    """Whether an arm is cuspidal, with an example.

    Attributes:
        status: CUSPIDAL or NOT_CUSPIDAL.
        proven: whether that is proven; NOT_CUSPIDAL by a search is not.
        q_a, q_b: (nq,) two solutions of one target that `path` joins [rad or m]; empty of an arm that is not cuspidal.
        path: (k, nq) samples of a path without singularities between them, with straight lines between the samples.
        least: a value that |det J| never falls below on the path, relative to its largest value at random places.
        cusps: (j, 2) values of joints 2 and 3 at which three solutions of a 3R arm meet [rad].
        targets: the random targets that were asked about, by a search.
        reason: why, in a sentence.
    """

    status: CuspidalityStatus
    proven: bool
    q_a: Array
    q_b: Array
    path: Array
    least: float
    cusps: Array
    targets: int
    reason: str

    def explain(self) -> str:
        """Return the answer with its reason, in sentences."""
        return f"{self.status.value}. {self.reason}{'' if self.proven else ' That is a search, and no proof.'}"


def is_cuspidal(
    robot: RobotLike, task: TaskLike, *, targets: int = 20, samples: int = 600, seed: int = 0
) -> Cuspidality:
    """Return whether a path without singularities joins two solutions of one target, joint limits left aside.

    - An arm whose postures have names has one solution for each of them, and is not cuspidal.
    - A 3R arm that moves a point has a cusp, where three solutions meet, if it is cuspidal; and if it has none, and its
      singular curve does not cross itself, it is not.
    - Otherwise solutions of random targets are joined, as `posture_change` does. A pair that is joined proves it.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q) that as many joints move as it has rows.
        targets: the most random targets of a search.
        samples: the most random configurations of the roadmap between two solutions.
        seed: of these.

    Raises:
        TaskError: the task is moved by more or fewer joints than it has rows.

    Source: Wenger, Cuspidal and noncuspidal robot manipulators, Robotica, 2007; Salunkhe, Spartalis, Capco, Chablat,
    Wenger, Necessary and sufficient condition for a generic 3R serial manipulator to be cuspidal, Mechanism and Machine
    Theory, 2022.
    """
    robot, task = robot_and_task(robot, task)
    seed = counting_number("seed", seed)
    targets, samples = counting_number("targets", targets, least=1), counting_number("samples", samples, least=1)
    det, names = determinant(robot, task), postures(robot, task)
    if names.factors:
        parts = ", ".join(factor.part for factor in names.factors)
        return _not_cuspidal(
            True, f"There is one solution for each pattern of signs of its factors ({parts}).{names.remark}"
        )
    if task.rows == 1:
        return _not_cuspidal(True, "One joint moves the task, and its solutions are apart by its singularities.")
    known = _cusps(det)
    if known is not None and known.complete and known.generic and not len(known.q):
        return _not_cuspidal(True, "It is proven that no three solutions meet: there is no cusp.")
    at = known.q if known is not None and known.complete else NONE
    search, asked = _Search(det, samples, seed), 0
    for q in _starts(det, at, targets, np.random.default_rng(seed)):
        asked += 1
        pair = search.pair_of(q)
        if pair is not None:
            return _cuspidal(pair, at, asked)
    if known is not None and known.generic and len(known.q):
        reason = (
            f"Three solutions meet at {count(len(known.q), 'cusp')}, as for cuspidal arms only; no example is known."
        )
        return Cuspidality(CuspidalityStatus.CUSPIDAL, False, NOTHING, NOTHING, NOTHING, 0.0, known.q, asked, reason)
    share = 1 - RISK ** (1 / max(1, asked))
    return _not_cuspidal(
        False,
        f"No two solutions of {count(asked, 'random target')} were joined: with a confidence of 95 % this search "
        f"would join two of less than {100 * share:.0f} % of the targets.",
        at,
        asked,
    )


def _cusps(det: Determinant) -> Cusps | None:
    """Return the cusps of three revolute joints that move a point; None of other arms."""
    chain = det.chain
    if chain is None or det.rows != (0, 1, 2) or any(chain.prismatic):
        return None
    return cusps(chain)


def _starts(det: Determinant, at: Array, targets: int, rng: np.random.Generator) -> Iterator[Array]:
    """Yield configurations whose tasks' values are the targets: random ones, and then some near the cusps."""
    robot, found = det.problem.robot, 0
    for q in det.problem.random(rng, 20 * targets):
        if abs(det(q[None])[0]) > REGULAR and found < targets:
            found += 1
            yield q
    behind_the_first = np.flatnonzero(det.problem.moving)[1:]
    for cusp in at:
        for distance in BESIDE:
            q = np.zeros(robot.nq)
            q[behind_the_first] = cusp + distance * rng.uniform(-1, 1, 2)
            yield q


class _Search:
    """The search for two solutions of one target that a path joins: a roadmap for each sign of det J."""

    def __init__(self, det: Determinant, samples: int, seed: int) -> None:
        self.det, self.samples, self.seed = det, samples, seed
        self.maps: dict[float, Region] = {}

    def pair_of(self, q: Array) -> Pair | None:
        """Return two solutions of the target f(q) that a verified path joins, and the path; None if none are found.

        Solutions that differ by whole turns only, or belong to a family, are no two postures.
        """
        solutions = self._solutions(q)
        values = self.det(solutions) if len(solutions) else np.zeros(0)
        for sign in (1.0, -1.0):
            found = self._joined(solutions[sign * values > REGULAR], sign)
            if found is not None:
                return found
        return None

    def _solutions(self, q: Array) -> Array:
        """Return the solutions of the target f(q), (k, nq)."""
        problem = self.det.problem
        robot, task, box = problem.robot, problem.task, problem.box
        open_slides = ~robot.revolute & problem.moving & ~np.isfinite(robot.upper - robot.lower)
        where = {robot.joint_names[j]: (box.lower[j], box.upper[j]) for j in np.flatnonzero(open_slides)}
        found = ik_solutions(robot, task, task.value(robot, q), box=where or None)
        return np.empty((0, robot.nq)) if found.dimension else np.vstack([found.q, found.outside_limits])

    def _joined(self, solutions: Array, sign: float) -> Pair | None:
        if len(solutions) < 2:
            return None
        if sign not in self.maps:
            region = region_of(self.det, solutions, within_limits=False)
            self.maps[sign] = region.grown(self.samples, np.random.default_rng(self.seed))
        region = self.maps[sign]
        apart = [(a, b) for a, b in combinations(solutions, 2) if np.abs(region.step(a, b)).max() > APART]
        straight = (path_of(region, region.direct(a, b), a, b) for a, b in apart)
        for (a, b), change in zip(apart, straight, strict=True):
            if change.status is PostureChangeStatus.FOUND:
                return a, b, change
        k, region = len(region.nodes), region.with_nodes(solutions)
        parts = region.components()[k:]
        for i, j in combinations(range(len(solutions)), 2):
            a, b = solutions[i], solutions[j]
            if parts[i] == parts[j] and np.abs(region.step(a, b)).max() > APART:
                change = path_of(region, region.path(k + i, k + j), a, b)
                if change.status is PostureChangeStatus.FOUND:
                    return a, b, change
        return None


def _cuspidal(pair: Pair, at: Array, n: int) -> Cuspidality:
    q_a, q_b, change = pair
    reason = f"Two solutions of the {n}. target are joined by a path; {change.reason}."
    return Cuspidality(CuspidalityStatus.CUSPIDAL, change.proven, q_a, q_b, change.path, change.least, at, n, reason)


def _not_cuspidal(proven: bool, reason: str, at: Array = NONE, targets: int = 0) -> Cuspidality:
    status = CuspidalityStatus.NOT_CUSPIDAL
    return Cuspidality(status, proven, NOTHING, NOTHING, NOTHING, 0.0, at, targets, reason)
