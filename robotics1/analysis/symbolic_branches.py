"""The singular set as branches with formulas, complete wherever the time is enough."""

from collections.abc import Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
import sympy

from robotics1.analysis.exact_rows import exact_rows, verify_rows
from robotics1.analysis.limits import NEAR, note_on_limits
from robotics1.analysis.singular_points import NOTHING_MOVES, SingularPoints, singular_points
from robotics1.analysis.singular_set import SingularBranch
from robotics1.angles import TURN
from robotics1.errors import FormulaError, TaskError
from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.exact import exact_robot
from robotics1.symbolic.kinematics.mid_chain import MidChainJacobian
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.degenerate import POINTS
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.singular_loci import largest_pieces, singular_loci
from robotics1.symbolic.singular_sets.solving import CaseDistinction
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.writing.sums_of_angles import Groups
from robotics1.tasks.task import FrameTask, Task

SAMPLES = 50
BESIDE = 8  # configurations outside of a box from which one inside is looked for
VERIFIED = 1e-9  # σ_ρ of a configuration of a branch, beside the usual σ₁


@dataclass(frozen=True, eq=False)
class SymbolicSearch:
    """The search for the singular set of a task in exact form.

    Attributes:
        points: the same set in numbers, of the robot with exact angles.
        rows: the Jacobian in exact form.
        groups: the angles that are added up in writing.
        cases: the lengths, the time limit, and what had no solution.
        anywhere: a box without the robot's limits.
        cleaned: the largest correction that made an angle of the file exact [rad].
    """

    points: SingularPoints
    rows: MidChainJacobian
    groups: Groups
    cases: CaseDistinction
    anywhere: JointBox
    cleaned: float

    def branches(self, rng: np.random.Generator, limit: TimeLimit) -> "Found":
        """Return the branches: equations until the time of the search is over, and what is drawn of them until
        `limit` is.
        """
        whole = Locus(self.rows.M[0, 0].frequencies)
        loci: list[Locus] = []
        complete = True
        try:
            with self.cases.limit.kept():
                loci.extend(singular_loci(self.rows.M, self.points.rank, whole, self.cases))
        except OutOfTime:
            complete = False
        inside: list[SingularBranch] = []
        outside: list[SingularBranch] = []
        undefined: list[BranchFormulas] = []
        with limit.kept():
            pieces, all_drawn = largest_pieces(loci, replace(self.cases, limit=limit), self.anywhere, rng)
            try:
                for piece in pieces:
                    self._place(piece, rng, inside, outside, undefined)
            except OutOfTime:
                all_drawn = False
        return Found(_sorted(inside), _sorted(outside), tuple(undefined), complete and all_drawn)

    def _place(
        self,
        piece: Configurations,
        rng: np.random.Generator,
        inside: list[SingularBranch],
        outside: list[SingularBranch],
        undefined: list[BranchFormulas],
    ) -> None:
        """Add a piece to those inside the limits, or within 1e-6 of them; to those outside; or to those where the task
        has no Jacobian.
        """
        limits, near = self.points.box, self.points.box.widened(NEAR)
        for box, branches in ((limits, inside), (near, inside), (self.anywhere, outside)):
            if box is near and piece.locus.implicit:
                self._look_beside(piece, box, rng)  # values alone are compared with the box exactly
            if self._samples(piece, box, rng, POINTS):
                branches.append(self._branch(piece, box, rng))
                return
        undefined.append(self._undefined(piece))

    @property
    def almost_everywhere(self) -> BranchFormulas:
        """The bases of J where it is not singular."""
        whole = Configurations(Locus(self.rows.M[0, 0].frequencies), self.cases.parameters, {})
        return BranchFormulas(self.rows, self.groups, whole, self.points.rank, self.anywhere)

    def intersections(self, branches: Sequence[SingularBranch]) -> tuple[tuple[SingularBranch, ...], bool]:
        """Return where two branches meet, and where the rank falls further; and whether they are all. A piece of
        another one is told only if the rank is lower there. The time limit is that of the branches, once more.
        """
        again = replace(self.cases, limit=TimeLimit(self.cases.limit.seconds), excluded=[])
        found: list[SingularBranch] = []
        complete = True
        try:
            with again.limit.kept():
                for pieces in replace(self, cases=again).crossings(branches, np.random.default_rng(0)):
                    found += pieces
        except OutOfTime:
            complete = False
        kept: list[SingularBranch] = []
        for piece in sorted(found, key=lambda part: -part.dimension):
            if not any(other.rank == piece.rank and all(map(other.contains, piece.samples)) for other in kept):
                kept.append(piece)
        return tuple(kept), complete

    def crossings(self, branches: Sequence[SingularBranch], rng: np.random.Generator) -> Iterator[list[SingularBranch]]:
        """Yield the pieces that two branches share, and step by step those of lower rank; some more than once.

        Raises:
            OutOfTime: the time is over.
        """
        known: dict[Hashable, list[Array]] = {}
        exact = [branch for branch in branches if branch.formulas is not None]
        for a, b in combinations(exact, 2):
            loci = self.cases.common_zeros(_locus(b).equations, _locus(a))
            yield self._as_branches(loci, (a, b), rng, known)
        deeper = exact
        while deeper:
            next_level: dict[Hashable, SingularBranch] = {}
            for branch in deeper:
                parts = self._where_rank_falls(branch, rng, known)
                yield parts
                next_level |= {part.require_formulas().configurations.key: part for part in parts}
            deeper = list(next_level.values())

    def _where_rank_falls(
        self, branch: SingularBranch, rng: np.random.Generator, known: dict[Hashable, list[Array]]
    ) -> list[SingularBranch]:
        if branch.rank == 0:
            return []
        loci = singular_loci(self.rows.M, branch.rank, _locus(branch), self.cases)
        return self._as_branches(loci, (branch,), rng, known)

    def _as_branches(
        self,
        loci: Iterable[Locus],
        within: tuple[SingularBranch, ...],
        rng: np.random.Generator,
        known: dict[Hashable, list[Array]],
    ) -> list[SingularBranch]:
        """Return the pieces that are part of all these branches, with samples; `known` as in `largest_pieces`."""
        found = []
        pieces, all_drawn = largest_pieces(loci, self.cases, self.points.box, rng, known)
        for piece in pieces:
            samples = self._samples(piece, self.points.box, rng, POINTS)
            if samples and all(branch.contains(q) for q in samples for branch in within):
                found.append(self._branch(piece, self.points.box, rng))
        if not all_drawn:
            raise OutOfTime
        return found

    def _samples(self, piece: Configurations, box: JointBox, rng: np.random.Generator, count: int) -> list[Array]:
        """Return configurations of the piece at which the task has a Jacobian; none if it has none."""
        drawn = [piece.random(box, rng) for _ in range(count)]
        return [q for q in drawn if q is not None and np.isfinite(self.points.gap(q))]

    def _more_samples(self, piece: Configurations, box: JointBox, rng: np.random.Generator, count: int) -> list[Array]:
        """Return up to `count` configurations of the piece: fewer when the time is over."""
        found: list[Array] = []
        try:
            for _ in range(count):
                found += self._samples(piece, box, rng, 1)
        except OutOfTime:
            pass  # one sample is a branch
        return found

    def _branch(self, piece: Configurations, box: JointBox, rng: np.random.Generator) -> SingularBranch:
        """Return a piece with samples, each of them verified.

        Raises:
            FormulaError: a configuration of the piece is not singular.
        """
        samples = np.array(self._samples(piece, box, rng, POINTS))
        dimension = piece.dimension(samples[0])
        if dimension:
            samples = np.array([*samples, *self._more_samples(piece, box, rng, SAMPLES - len(samples))])
        else:
            samples = samples[:1]
        worst = max(self.points.gap(q) for q in samples)
        if worst > VERIFIED:
            raise FormulaError(f"the formulas of a singularity are not confirmed: σ_min is {worst:.1e} σ₁ there")
        ranks = [self.points.rank_at(q) for q in samples]
        best = int(np.argmax(ranks))
        names = self.points.robot.joint_names
        constant = piece.locus.joints if dimension == 0 else piece.constant
        return SingularBranch(
            points=replace(self.points, box=box),
            dimension=dimension,
            values={names[i]: float(samples[0][i]) for i in constant},
            free_joints=tuple(name for i, name in enumerate(names) if i not in piece.locus.joints),
            samples=samples,
            q=samples[best],
            rank=ranks[best],
            formulas=BranchFormulas(self.rows, self.groups, piece, ranks[best], self.anywhere),
            note=note_on_limits(samples, self.points.box, names),
        )

    def _look_beside(self, piece: Configurations, box: JointBox, rng: np.random.Generator) -> None:
        """Look for configurations of a piece in a box from those outside: moved into it, and then to the set again."""
        points = replace(self.points, box=box)
        outside = self._samples(piece, self.anywhere, rng, BESIDE)
        moved = [points.project(box.nearest(q), iterations=12) for q in outside]
        piece.remember(box, [p for p in moved if p is not None and piece.contains(p)])

    def _undefined(self, piece: Configurations) -> BranchFormulas:
        return BranchFormulas(self.rows, self.groups, piece, self.points.rank, self.anywhere)


@dataclass(frozen=True, eq=False)
class Found:
    """What the search has found.

    Attributes:
        inside, outside: the branches inside the box, and those outside.
        undefined: where minors vanish, but the task has no Jacobian, such as an Euler angle's singularities.
        complete: whether these are all.
    """

    inside: tuple[SingularBranch, ...]
    outside: tuple[SingularBranch, ...]
    undefined: tuple[BranchFormulas, ...]
    complete: bool


def _locus(branch: SingularBranch) -> Locus:
    return branch.require_formulas().configurations.locus


def _sorted(branches: Iterable[SingularBranch]) -> tuple[SingularBranch, ...]:
    """The larger first, then by the values of joints; those without values last."""
    order = sorted(branches, key=lambda branch: (-branch.dimension, not branch.values, list(branch.values.items())))
    return tuple(order)


def symbolic_search(
    robot: Robot, task: Task, box: JointBox, rng: np.random.Generator, limit: TimeLimit
) -> SymbolicSearch:
    """Prepare the search: the Jacobian in exact form, and in numbers of the robot with exact angles.

    Raises:
        OutOfTime: the time of a limit that is kept is over.
        FormulaError: there are no formulas of the robot or the task.
    """
    found = formulas(robot, task)
    points = singular_points(exact_robot(robot)[0], task, box, rng)
    if points.rank == 0:
        raise TaskError(NOTHING_MOVES)
    in_world = isinstance(task, FrameTask) and task.reference == "world"
    rows = exact_rows(found.reading, in_world)
    if any(entry.has_roots for entry in rows.M.flat):
        rows = exact_rows(replace(found.reading, chain=replace(found.reading.chain, rational=True)), in_world)
    parameters = {sympy.Symbol(name, real=True): value for name, value in robot.parameters.items()}
    verify_rows(rows, points, parameters, rng)
    turns = np.array(found.chain.turns, dtype=float)
    far = np.where(robot.revolute, np.pi * turns, 2 * robot.reach)
    lower = np.where(robot.revolute, -far, np.minimum(-far, box.lower))
    upper = np.where(robot.revolute, far, np.maximum(far, box.upper))
    anywhere = JointBox(lower, upper, robot.revolute, box.unit, TURN * turns)
    return SymbolicSearch(points, rows, found.groups, CaseDistinction(parameters, limit), anywhere, found.cleaned)
