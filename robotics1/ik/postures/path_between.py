"""From one posture to another without crossing a singularity."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.postures.determinant import Determinant, determinant
from robotics1.ik.postures.labels import NO_POSTURE, Postures, postures
from robotics1.ik.postures.roadmap import Region, least_along
from robotics1.ik.postures.separation import are_apart, wall_between
from robotics1.inputs import Array, counting_number, true_or_false
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task

SINGULAR = 1e-9  # |det J|, beside its largest value, of a configuration that is singular
GROWTH = (50, 150, 600, 2400)  # configurations of the roadmap, one after the other


class PostureChangeStatus(Enum):
    """Whether two configurations are joined by a path without singularities."""

    FOUND = "a path without singularities joins them"
    IMPOSSIBLE = "every path between them crosses a singularity"
    NOT_FOUND = "no path without singularities was found; that proves nothing"


@dataclass(frozen=True, eq=False)
class PostureChange(Frozen):
    """A path from one configuration to another on which det J does not vanish, or why there is none.

    Attributes:
        status: FOUND, IMPOSSIBLE or NOT_FOUND.
        path: (k, nq) samples, with straight lines between them [rad or m]: from q_a to q_b, or to what is whole turns
            from it; empty if there is none.
        least: a value that |det J| never falls below on the path, relative to the largest |det J| at 200 random
            configurations; 0 without a path.
        proven: whether the answer is proven: that |det J| ≥ `least` also between the samples, or that there is no path.
        reason: why, in a sentence.
    """

    status: PostureChangeStatus
    path: Array
    least: float
    proven: bool
    reason: str

    def explain(self) -> str:
        """Return the answer with its reason, in sentences."""
        return f"{self.status.value}: {self.reason}"

    def require(self) -> PostureChange:
        """Return self if there is a path.

        Raises:
            NotConverged: there is none, or none was found.
        """
        return require(self, self.status is PostureChangeStatus.FOUND)


def posture_change(
    robot: RobotLike,
    task: TaskLike,
    q_a: ConfigurationLike,
    q_b: ConfigurationLike,
    *,
    within_limits: bool = False,
    samples: int = 2400,
    seed: int = 0,
) -> PostureChange:
    """Return a joint path from q_a to q_b on which det J(q) ≠ 0, or why there is none.

    On a path without singularities det J keeps its sign, and so does each of its factors. Where a sign differs, there
    is no path; nor where det J vanishes at values of one joint between them, whatever the others do. Otherwise straight
    lines are tried, both ways round each joint, and then a roadmap of random configurations. Where det J depends on two
    joints only, as for a 3R arm, a grid can prove that there is no path.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q) that as many joints move as it has rows.
        q_a, q_b: (nq,) two configurations, such as two solutions of `ik_solutions` [rad or m].
        within_limits: whether the path keeps the joint limits; otherwise revolute joints turn as far as they need to.
        samples: the most random configurations of the roadmap.
        seed: of these.

    Raises:
        InputError: q_a or q_b is singular, or outside the limits that the path is to keep.
        TaskError: the task is moved by more or fewer joints than it has rows.

    Source: Wenger, A new general formalism for the kinematic analysis of all nonredundant manipulators, ICRA 1992.
    """
    robot, task = robot_and_task(robot, task)
    seed, samples = counting_number("seed", seed), counting_number("samples", samples, least=1)
    within_limits = true_or_false("within_limits", within_limits)
    det = determinant(robot, task)
    ends = [robot.configuration(q, name) for name, q in (("q_a", q_a), ("q_b", q_b))]
    for name, q in zip(("q_a", "q_b"), ends, strict=True):
        if abs(det(q[None])[0]) < SINGULAR:
            raise InputError(f"{name} is singular: it is on the border of two postures")
        if within_limits and not robot.within_limits(q):
            raise InputError(f"{name} is outside the joint limits; leave within_limits out, or give another one")
    found = by_signs(det, postures(robot, task), np.array(ends))
    return found or _join(det, ends[0], ends[1], within_limits=within_limits, samples=samples, seed=seed)


def _join(det: Determinant, a: Array, b: Array, *, within_limits: bool, samples: int, seed: int) -> PostureChange:
    """Return a path between configurations (nq,) at which det J has the same sign, or why there is none."""
    for drawn, region in growing(region_of(det, np.array([a, b]), within_limits=within_limits), samples, seed):
        corners = region.path(0, 1) if drawn else region.direct(a, b)
        if corners is not None:
            return path_of(region, corners, a, b)
        reason = wall_between(region, a, b) if det.has_bound and not drawn else ""
        if drawn == min(GROWTH[1], samples) and are_apart(region, a, b):
            reason = "a grid over the joints that det J depends on separates them"
        if reason:
            return _impossible(reason)
    return _not_found(region)


def growing(region: Region, samples: int, seed: int) -> Iterator[tuple[int, Region]]:
    """Yield the region as it is, and then with more and more random configurations on its roadmap, and their number."""
    yield 0, region
    rng, asked = np.random.default_rng(seed), len(region.nodes)
    for count in (*(n for n in GROWTH if n < samples), samples):
        region = region.grown(count - (len(region.nodes) - asked), rng)
        yield count, region


def path_of(region: Region, corners: Array | None, a: Array, b: Array) -> PostureChange:
    """Return the path with these corners (k, nq) from a to b if det J keeps its sign on it; else what was looked at."""
    det = region.determinant
    if corners is None:
        return _not_found(region)
    if not det.active.all():  # the other joints go along
        others = np.where(det.active, 0.0, region.step(corners[-1], b))
        corners = corners + np.linspace(0, 1, len(corners))[:, None] * others
    checked = least_along(det, corners, region.sign)
    if checked is None:
        return _not_found(region)
    path, least = checked
    word = "never" if det.has_bound else "by measured slopes never"
    reason = f"|det J| {word} falls below {least:.2g} of its largest value"
    return PostureChange(PostureChangeStatus.FOUND, path, least, det.has_bound, reason)


def region_of(det: Determinant, q: Array, *, within_limits: bool) -> Region:
    """Return the region of configurations (k, nq) at which det J has the same sign."""
    robot, box = det.problem.robot, det.problem.box
    circular = robot.revolute & (np.isinf(robot.lower) & np.isinf(robot.upper) if within_limits else True)
    slides = ~robot.revolute
    lower = np.where(slides & ~np.isfinite(robot.lower), np.minimum(box.lower, q.min(axis=0)), robot.lower)
    upper = np.where(slides & ~np.isfinite(robot.upper), np.maximum(box.upper, q.max(axis=0)), robot.upper)
    if not within_limits:
        lower = np.where(slides, np.minimum(lower, q.min(axis=0)), lower)
        upper = np.where(slides, np.maximum(upper, q.max(axis=0)), upper)
    return Region(det, float(np.sign(det(q[:1])[0])), lower, upper, circular, q)


def by_signs(det: Determinant, names: Postures, ends: Array) -> PostureChange | None:
    """Return the proof that there is no path, if det J or a factor of it has another sign at the other end."""
    values, factors = det(ends), names.values(ends)
    for factor, (a, b) in zip(names.factors, factors.T, strict=True):
        if a * b < 0 and min(abs(a), abs(b)) > NO_POSTURE:
            words = [factor.positive if value > 0 else factor.negative for value in (a, b)]
            return _impossible(
                f"the factor of det J for the {factor.part} changes its sign: {words[0]}, then {words[1]}."
                + names.remark
            )
    if values[0] * values[1] < 0:
        return _impossible("det J has different signs at the two, so that it vanishes on the way")
    return None


def _impossible(reason: str) -> PostureChange:
    return PostureChange(PostureChangeStatus.IMPOSSIBLE, np.zeros((0, 0)), 0.0, True, reason)


def _not_found(region: Region) -> PostureChange:
    parts = region.components()
    n, of_a, of_b = len(parts) - 2, int((parts == parts[0]).sum()) - 1, int((parts == parts[1]).sum()) - 1
    reason = (
        f"of {n} random configurations with the sign of det J, {of_a} were joined to q_a, {of_b} to q_b, none to both"
    )
    return PostureChange(PostureChangeStatus.NOT_FOUND, np.zeros((0, 0)), 0.0, False, reason)
