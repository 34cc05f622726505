"""The singular set as branches with formulas, complete wherever the time is enough."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
import sympy

from robotics1.angles import TURN
from robotics1.errors import FormulaError
from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.singularities.points import NEAR, SingularPoints, singular_points
from robotics1.singularities.result import SingularBranch
from robotics1.singularities.spaces import subspaces
from robotics1.symbolic.kinematics.exact import exact_robot
from robotics1.symbolic.kinematics.mid_chain import MidChainJacobian
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.branch_formulas import BranchFormulas, SymbolicJacobian
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros, singular_loci
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.locus_sampler import LocusSampler
from robotics1.symbolic.singular_sets.pieces import POINTS, largest_pieces
from robotics1.symbolic.singular_sets.zeros import Zero
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.tasks.task import Task

SAMPLES = 50
BESIDE = 8  # configurations outside of a box from which one inside is looked for
CONFIRMED = 1e-9  # σ_ρ of a configuration of a branch, beside the usual σ₁
VERIFIED = 1e-9  # of the formula of J, relative to its largest entry


@dataclass
class Found:
    """What the search has found.

    Attributes:
        points: the singular set in numbers, of the robot with exact angles.
        jacobian: in exact form.
        inside, outside: the branches inside the joint limits, or within 1e-6 of them, and those outside.
        undefined: where minors vanish, but the task has no Jacobian, such as an Euler angle's singularities.
        without_solution: equations that were met and have no solution at the robot's lengths.
        complete: whether these are all.
        unproven: how many sets of equations may hold at configurations that were not found.
        cleaned: the largest correction that made an angle of the file exact [rad].
    """

    points: SingularPoints
    jacobian: SymbolicJacobian
    inside: list[SingularBranch] = field(default_factory=list)
    outside: list[SingularBranch] = field(default_factory=list)
    undefined: list[BranchFormulas] = field(default_factory=list)
    without_solution: list[Zero] = field(default_factory=list)
    complete: bool = True
    unproven: int = 0
    cleaned: float = 0.0


def symbolic_branches(
    robot: Robot, task: Task, box: JointBox, rng: np.random.Generator, exact: TimeLimit, limit: TimeLimit
) -> Found:
    """Return the branches: equations until the time `exact` is over, and what is drawn of them until `limit` is.

    Raises:
        OutOfTime: the time is over before there is a Jacobian in exact form.
        FormulaError: there are no formulas of the robot or the task.
    """
    with exact.kept():
        found = _with_exact_jacobian(robot, task, box, rng)
    J = found.jacobian
    cases = CommonZeros(J.parameters, found.without_solution)
    loci: list[Locus] = []
    try:
        with exact.kept():
            loci.extend(singular_loci(J.rows.M, found.points.rank, J.everywhere, cases))
    except OutOfTime:
        found.complete = False
    with limit.kept():
        pieces, all_drawn = largest_pieces(loci, cases, J.box, rng)
        try:
            for sampler in pieces:
                _place(found, sampler, rng)
        except OutOfTime:
            all_drawn = False
    found.unproven = len(cases.unproven)
    found.complete &= all_drawn and not found.unproven
    for branches in (found.inside, found.outside):
        # the larger first, then by the values of joints; those without values last
        branches.sort(key=lambda branch: (-branch.dimension, not branch.values, list(branch.values.items())))
    return found


def _with_exact_jacobian(robot: Robot, task: Task, box: JointBox, rng: np.random.Generator) -> Found:
    """Return what is known before the search: the Jacobian in exact form, verified, and ρ."""
    formula = formulas(robot, task)
    exact, _ = exact_robot(robot)
    points = singular_points(exact, task, box, rng).require_motion()
    form = task.frame_map()
    rows = _rows(formula, in_world=form is not None and form.reference == "world")
    parameters = {sympy.Symbol(name, real=True): value for name, value in robot.parameters.items()}
    _verify(rows, points, parameters, rng)
    turns = np.array(formula.chain.turns, dtype=float)
    far = np.where(robot.revolute, np.pi * turns, 2 * robot.reach)
    lower = np.where(robot.revolute, -far, np.minimum(-far, box.lower))
    upper = np.where(robot.revolute, far, np.maximum(far, box.upper))
    anywhere = JointBox(lower, upper, robot.revolute, box.unit, TURN * turns)
    jacobian = SymbolicJacobian(exact, rows, formula.chain.groups, parameters, anywhere)
    return Found(points, jacobian, cleaned=formula.cleaned)


def _rows(formula: Formulas, *, in_world: bool) -> MidChainJacobian:
    """Return J as X M, with M seen from the middle of the chain where the task's axes are the world's, and with
    fractions for √2 and √3.
    """
    reading = formula.symbolic_task
    rows = reading.mid_chain if in_world else MidChainJacobian(reading.rows)
    if any(entry.has_roots for entry in rows.M.flat):
        reading = replace(reading, chain=replace(reading.chain, rational=True))
        rows = reading.mid_chain if in_world else MidChainJacobian(reading.rows)
    return replace(rows, leads_back=reading.factored.is_plain)


def _verify(
    rows: MidChainJacobian, points: SingularPoints, parameters: Mapping[sympy.Symbol, float], rng: np.random.Generator
) -> None:
    """Compare J = X M, or of a task with quotients the null space of M, with Pinocchio.

    Raises:
        FormulaError: they differ.
    """
    for q in points.box.random(rng, 3):
        J = points.task.jacobian(points.robot, q)
        ours = rows.numbers(q, parameters)
        error = ours - J if rows.leads_back else J @ subspaces(ours).null
        if np.abs(error).max(initial=0.0) > VERIFIED * np.abs(J).max():
            raise FormulaError(f"the formula of J differs from Pinocchio by {np.abs(error).max():.1e}")


def _place(found: Found, anywhere: LocusSampler, rng: np.random.Generator) -> None:
    """Add a piece to those inside the limits, or within 1e-6 of them; to those outside; or to those where the task has
    no Jacobian.
    """
    points, piece = found.points, anywhere.piece
    limits, near = points.box, points.box.widened(NEAR)
    for box, branches in ((limits, found.inside), (near, found.inside), (None, found.outside)):
        if box is None:
            sampler = anywhere
        elif box is near and piece.locus.implicit:
            sampler = _sampler_beside(points, anywhere, near, rng)
        else:
            sampler = LocusSampler(piece, box)  # values alone are compared with the box exactly
        if samples_of(points, sampler, rng, POINTS):
            branches.append(branch_of(points, found.jacobian, sampler, rng))
            return
    found.undefined.append(BranchFormulas(found.jacobian, piece, points.rank))


def _sampler_beside(
    points: SingularPoints, anywhere: LocusSampler, box: JointBox, rng: np.random.Generator
) -> LocusSampler:
    """Return the sampler of a piece in a box that knows the configurations to which those outside of the box lead:
    moved into it, and then to the set again.
    """
    inside = replace(points, box=box)
    outside = samples_of(points, anywhere, rng, BESIDE)
    moved = [inside.project(box.nearest(q), iterations=12) for q in outside]
    return LocusSampler(anywhere.piece, box, [p for p in moved if p is not None and anywhere.piece.contains(p)])


def samples_of(points: SingularPoints, sampler: LocusSampler, rng: np.random.Generator, count: int) -> list[Array]:
    """Return configurations of a piece at which the task has a Jacobian; none if it has none."""
    drawn = [sampler.draw(rng) for _ in range(count)]
    return [q for q in drawn if q is not None and np.isfinite(points.relative_sigma(q))]


def branch_of(
    points: SingularPoints, jacobian: SymbolicJacobian, sampler: LocusSampler, rng: np.random.Generator
) -> SingularBranch:
    """Return a piece with samples, each of them verified; fewer samples when the time is over.

    Raises:
        FormulaError: a configuration of the piece is not singular.
    """
    piece = sampler.piece
    samples = samples_of(points, sampler, rng, POINTS)
    dimension = piece.dimension(samples[0])
    if dimension:
        try:
            for _ in range(SAMPLES - len(samples)):
                samples += samples_of(points, sampler, rng, 1)
        except OutOfTime:
            pass  # one sample is a branch
    else:
        samples = samples[:1]
    worst = max(map(points.relative_sigma, samples))
    if worst > CONFIRMED:
        raise FormulaError(f"the formulas of a singularity are not confirmed: σ_min is {worst:.1e} σ₁ there")
    values = {i: samples[0][i] for i in (piece.constant if dimension else piece.locus.joints)}
    free = [i for i in range(points.robot.nq) if i not in piece.locus.joints]
    branch = replace(points, box=sampler.box).branch(samples, dimension, values, free, points.box)
    return replace(branch, formulas=BranchFormulas(jacobian, piece, branch.rank))
