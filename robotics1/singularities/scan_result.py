"""The answer of a scan, and its sentences."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import cast

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, one_of
from robotics1.names import printable
from robotics1.notation import count, enumeration, joint_value, vector
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.singularities.explain import place
from robotics1.singularities.reduction import Measure, MeasureDistribution
from robotics1.singularities.result import SingularBranch, SingularSet
from robotics1.tables import Table, table_of
from robotics1.tasks.task import Task

CHOSEN = {"random": "random configurations", "sobol": "configurations of Sobol's sequence", "grid": "points of a grid"}
SHOWN = 3  # configurations of a group that are written out


@dataclass(frozen=True, eq=False)
class RefinedGroup(Frozen):
    """Singular configurations that belong together: on one branch, or alike if they are on none.

    Attributes:
        branch: the number of their branch in `Refinement.branches`, from 0; None if they are on none.
        configurations: (k, nq) the distinct ones, σ_ρ ≤ 1e-10 σ₁ without units.
        relative_sigmas: (k,) σ_ρ / σ₁ there.
        ranks: (k,) the rank of J there.
        starts: which of the worst configurations led to them; at least k.
        values: of those on no branch, joint → value of the joints that stand still on the set near them.
    """

    branch: int | None
    configurations: Array
    relative_sigmas: Array
    ranks: tuple[int, ...]
    starts: tuple[int, ...]
    values: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Refinement:
    """The worst configurations of a scan, moved to the singular set by Newton's method.

    Attributes:
        groups: the configurations that were reached; the group with most starts first.
        unreached: which of the worst led to no singular configuration inside the box.
        singular_set: the answer of `find_singularities`, with which they are compared; None if there are no formulas.
        note: why there are none.
    """

    groups: tuple[RefinedGroup, ...]
    unreached: tuple[int, ...]
    singular_set: SingularSet | None = field(repr=False)
    note: str = ""

    @property
    def branches(self) -> tuple[SingularBranch, ...]:
        """The branches of `find_singularities`; none if there are no formulas."""
        return () if self.singular_set is None else self.singular_set.branches

    @property
    def missed(self) -> tuple[int, ...]:
        """The branches, from 0, that none of the worst configurations led to."""
        met = {group.branch for group in self.groups}
        return tuple(number for number in range(len(self.branches)) if number not in met)


FEW = 5  # configurations in a table


@dataclass(frozen=True, eq=False)
class SingularityScan(Frozen):
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

    def _tables(self) -> tuple[Table, ...]:
        if not len(self.worst):
            return ()
        name = symbols(self)[self.measures[0]]
        rows = [(f"{value:.4g}", vector(q)) for value, q in zip(self.worst_values[:FEW], self.worst, strict=False)]
        return (table_of((name, "q"), rows, "nearest to singular"),)

    @property
    def measures(self) -> tuple[Measure, ...]:
        """The measures; the first decides what is worst."""
        return cast("tuple[Measure, ...]", tuple(self.distributions))

    def distribution(self, measure: Measure | None = None) -> MeasureDistribution:
        """Return the distribution of a measure, by default the first.

        Raises:
            InputError: the measure was not asked for.
        """
        return self.distributions[one_of("measure", measure or self.measures[0], self.measures)]

    def minimum(self, measure: Measure | None = None) -> float:
        """Return the least value of a measure."""
        return self.distribution(measure).minimum

    def maximum(self, measure: Measure | None = None) -> float:
        """Return the largest value of a measure."""
        return self.distribution(measure).maximum

    def quantile(self, p: float, measure: Measure | None = None) -> float:
        """Return the value that a part p of the configurations do not exceed, to 0.4 %."""
        return self.distribution(measure).quantile(p)

    def histogram(self, measure: Measure | None = None, *, per_octave: int = 1) -> tuple[Array, npt.NDArray[np.int64]]:
        """Return edges (b + 1,) and counts (b,) of a histogram with 1, 2, 4, ... or 128 bins from x to 2x."""
        return self.distribution(measure).histogram(per_octave)

    def explain(self) -> str:
        """Return the answer in sentences."""
        return printable(_sentences(self), keep="\n")


def _sentences(scan: SingularityScan) -> str:
    """Return what was scanned, each measure in a line, the nearest configuration, and what was refined."""
    rows = ", ".join(scan.task.row_names)
    if scan.robot.nv == 0:
        return f"{scan.robot.name}, task ({rows}): the robot has no joints, so that J has no σ that could vanish."
    lines = [f"{scan.robot.name}, task ({rows}): {scan.count} {CHOSEN[scan.method]}; {_units(scan)}."]
    if scan.rank < min(scan.task.rows, scan.robot.nv):
        lines.append(f"The rank of J is {scan.rank} almost everywhere, so the measures count {scan.rank} σ only.")
    if scan.undefined:
        lines.append(f"At {scan.undefined} of them the task has no Jacobian.")
    lines += [_measure(scan, measure) for measure in scan.measures]
    first = symbols(scan)[scan.measures[0]]
    lines.append(f"The nearest to singular is q = {vector(scan.worst[0])}, with {first} = {scan.worst_values[0]:.4g}.")
    if scan.refined is not None:
        lines += _refinement(scan.refined, scan.robot.joint_names)
    return "\n".join(lines)


def symbols(scan: SingularityScan) -> dict[str, str]:
    """Return measure → its symbol."""
    last = "σ_min" if scan.rank == min(scan.task.rows, scan.robot.nv) else f"σ_{scan.rank}"
    return {"sigma_min": last, "condition": f"σ_max/{last}", "manipulability": "the product of the σ"}


def _units(scan: SingularityScan) -> str:
    """Say in which units J is."""
    if scan.length == 1:
        return "J in SI units"
    reach = ", the arm's reach" if scan.length == scan.robot.reach else ""
    return f"J with lengths in units of {scan.length:.4g} m{reach}"


def _measure(scan: SingularityScan, measure: str) -> str:
    known = scan.distributions[measure]
    parts = [f"{known.quantile(p):.4g} at {name}" for p, name in ((0.01, "1 %"), (0.5, "half"), (0.99, "99 %"))]
    return (
        f"{symbols(scan)[measure]} is between {known.minimum:.4g} and {known.maximum:.4g}; it is at most "
        f"{enumeration(parts)} of them."
    )


def _refinement(refined: Refinement, joints: tuple[str, ...]) -> list[str]:
    starts = sum(len(group.starts) for group in refined.groups)
    total = starts + len(refined.unreached)
    if not refined.groups:
        return [f"None of the {total} worst is next to a singular configuration inside the limits."]
    order = (
        "" if joints == tuple(f"q{i + 1}" for i in range(len(joints))) else f" (q1, q2, ... are {', '.join(joints)})"
    )
    lines = [refined.note] if refined.note else []
    lines.append(f"Of the {total} worst, {starts} lead to singular configurations{order}:")
    lines += [f"- {_group(refined, group)}" for group in refined.groups]
    if refined.unreached:
        lines.append(f"The other {len(refined.unreached)} are next to no singular configuration inside the limits.")
    if refined.missed:
        names = enumeration(str(number + 1) for number in refined.missed)
        what = "Branch" if len(refined.missed) == 1 else "Branches"
        lines.append(f"{what} {names} of `find_singularities` met none of them.")
    return lines


def _group(refined: Refinement, group: RefinedGroup) -> str:
    if group.branch is not None:
        where = f"on branch {group.branch + 1}, {place(refined.branches[group.branch])}"
    else:
        none = "on none of the branches of `find_singularities`" if refined.branches else "alike"
        where = f"{none}{_still(group)}"
    shown = "; ".join(vector(q) for q in group.configurations[:SHOWN])
    more = ", ..." if len(group.configurations) > SHOWN else ""
    distinct = count(len(group.configurations), "distinct configuration")
    return f"{len(group.starts)} {where}: {distinct}, of rank {min(group.ranks)}, q = {shown}{more}"


def _still(group: RefinedGroup) -> str:
    values = [f"{name} = {joint_value(value)}" for name, value in group.values.items()]
    return f", with {enumeration(values)}" if values else ""
