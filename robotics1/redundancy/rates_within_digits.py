"""Rates and configurations given with few digits: what is realised, or singular, as far as the digits tell."""

from collections.abc import Callable, Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.printed_digits import shared_half_units
from robotics1.redundancy.hierarchy import by_levels
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.rounding import RoundedConfiguration, printed_half_units, rounded_configuration
from robotics1.singularities.spaces import subspaces
from robotics1.trajectories.following.open_digits import realised_within_digits

RowsAt = Callable[[Array], Sequence[tuple[Array, Array]]]  # q → J and J̇ q̇ of each level


def rates_within_digits(robot: Robot, rows_at: RowsAt, asked: Sequence[Array], q: ConfigurationLike) -> list[Array]:
    """Return what the rates that are asked of the levels mean, (m,) each: what can be realised if the digits allow it.

    x solves level by level, so that cᵢ = Jᵢ x + J̇ᵢ q̇ is the best for ṙᵢ. If velocities and a configuration that round
    to the given ones agree with the levels 1 to i, then ṙᵢ − cᵢ is not more than rounding, and cᵢ is what is meant.
    A level before i that is not realised stays at its cⱼ, as a number without rounding.
    """
    here = robot.configuration(q)
    rows = rows_at(here)
    x = by_levels([(J, b - d) for (J, d), b in zip(rows, asked, strict=True)], robot.nv).x
    best = [J @ x + d for J, d in rows]
    units = printed_half_units(robot, q)
    stands: list[Array] = []  # the rates of the levels before, and half a unit of their last digits
    halves: list[Array] = []
    meant: list[Array] = []
    for i, (b, c) in enumerate(zip(asked, best, strict=True), 1):
        rounding = 10 * RANK_TOLERANCE * float(np.linalg.norm(b) + np.linalg.norm(rows[i - 1][1]))
        stands, halves = [*stands, b], [*halves, shared_half_units(b)]
        realised = bool(np.linalg.norm(b - c) <= rounding)
        if not realised and (halves[-1].any() or units.any()):
            normal = subspaces(np.vstack([J for J, _ in rows[:i]])).left_null
            outside = normal @ (normal.T @ (np.concatenate(stands) - np.concatenate(best[:i])))

            def made(near: Array, level: int = i) -> Array:
                return np.concatenate([J @ x + d for J, d in rows_at(near)[:level]])

            realised = realised_within_digits(normal, (b, np.concatenate(halves)), outside, made, (here, units))
            meant.append(c if realised else b)
        else:
            meant.append(b)
        if not realised:
            stands[-1], halves[-1] = c, 0 * c
    return meant


def singularity_of_levels(robot: Robot, rows_at: RowsAt, q: ConfigurationLike) -> RoundedConfiguration | None:
    """Return q with the singular configuration that rounds to it, of the first level 1, ..., i that has one; else None.

    There [J₁; ...; Jᵢ] has a lower rank, while at q itself its inverse asks for rates that only the rounding makes.
    """
    if not printed_half_units(robot, q).any():
        return None
    for i in range(1, len(rows_at(robot.configuration(q))) + 1):

        def stacked(x: Array, level: int = i) -> Array:
            return np.vstack([J for J, _ in rows_at(x)[:level]])

        found = rounded_configuration(stacked, robot, q)
        if found.singular_q is not None:
            return found
    return None
