"""Sets of solutions of any dimension: samples of each, and what stays the same on it."""

from collections.abc import Iterable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from robotics1.ik.descent import REACHED
from robotics1.ik.families import Families
from robotics1.ik.joint_relations import joint_relations
from robotics1.ik.result import IKStatus
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array

SAME = 1e-4  # [rad, m] by which what is constant may change: where J loses rank more than once, descents end 1e-5 away
SAMPLES = 64  # of a set
STEP = 0.8  # along a set, in units, before the way back to it


class Surface(NamedTuple):
    """Solutions of one set, q (k, nq), with no regard to limits, and the equations that they satisfy."""

    q: Array
    equations: tuple[str, ...]


def with_surfaces(searched: IKSolutions, dimension: int, families: Families) -> IKSolutions:
    """Return the answer of a search, with more samples of the sets of two or more dimensions, and their equations.

    Args:
        searched: what the search has found.
        dimension: of the sets.
        families: of the target.
    """
    sets = surfaces(families, [*families.on_surfaces, *(searched.q if searched.dimension else ())], SAMPLES)
    inside = [p for surface in sets for p in map(families.within, surface.q) if p is not None]
    if not inside and not len(searched):
        return searched
    q = np.array(sorted([*searched.q, *inside], key=lambda p: [round(float(value), 6) for value in p]))
    return replace(
        searched,
        q=q,
        singular=np.array([families.search.singular(p) for p in q]),
        status=IKStatus.INFINITE,
        closest=q[0],
        error_norm=families.search.error_norm(q[0]),
        dimension=dimension,
        within_limits=np.ones(len(q), dtype=bool),
        boundary_distance=0.0,
        families=tuple(surface.equations for surface in sets),
        tangents=np.zeros((0, 0)),
        hits=np.zeros(0, dtype=np.int64),
        unseen=0.0,
    )


def surfaces(families: Families, starts: Iterable[Array], count: int) -> list[Surface]:
    """Return the sets through some solutions, each once: a start that satisfies the equations of one is on it.

    So all without equations are one.

    Args:
        families: of the target.
        starts: solutions.
        count: of samples of each set.
    """
    rng, problem = np.random.default_rng(0), families.problem
    found: list[Surface] = []
    for start in starts:
        if any(joint_relations(np.vstack([surface.q, start]), problem, SAME) == surface.equations for surface in found):
            continue
        q = _walk(families, start, count, rng)
        found.append(Surface(q, joint_relations(q, problem, SAME)))
    return found


def _walk(families: Families, start: Array, count: int, rng: np.random.Generator) -> Array:
    """Return solutions around one: each is a step away from one before, along a random direction of N(J)."""
    found = [start]
    for _ in range(count):
        ahead = families.step(found[rng.integers(len(found))], rng, STEP)
        if families.search.relative_error(ahead) <= REACHED:
            found.append(families.search.at_the_singularity(ahead))
    return np.array(found)
