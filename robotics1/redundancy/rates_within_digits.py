"""Rates and configurations given with few digits: what is realised, or singular, as far as the digits tell."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse, rank_of
from robotics1.printed_digits import shared_half_units
from robotics1.redundancy.given_levels import AskedLevels
from robotics1.redundancy.hierarchy import by_levels
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.rounding import printed_half_units, rounded_configuration
from robotics1.trajectories.following.open_digits import realised_within_digits

Answer = TypeVar("Answer", bound=Any)


def rates_within_digits(levels: AskedLevels, q: ConfigurationLike) -> list[Array]:
    """Return what the rates that are asked of the levels mean, (m,) each: what can be realised if the digits allow it.

    x solves level by level, so that cᵢ = Jᵢ x + J̇ᵢ q̇ is the best for ṙᵢ. If velocities and a configuration that round
    to the given ones agree with the levels 1 to i, then ṙᵢ − cᵢ is not more than rounding, and cᵢ is what is meant.
    A level before i that is not realised stays at its cⱼ, as a number without rounding.
    """
    here = levels.robot.configuration(q)
    rows = levels.rows(here)
    x = by_levels([row.equation(b) for row, b in zip(rows, levels.asked, strict=True)], levels.robot.nv).x
    best = [row.J @ x + row.drift for row in rows]
    digits = printed_half_units(levels.robot, q)
    stands: list[Array] = []  # the rates of the levels before, and half a unit of their last digits
    halves: list[Array] = []
    meant: list[Array] = []
    for i, (b, c) in enumerate(zip(levels.asked, best, strict=True), 1):
        stands, halves = [*stands, b], [*halves, shared_half_units(b)]
        row = rows[i - 1]
        realised = row.size(b - c) <= 10 * RANK_TOLERANCE * row.size(b, row.drift)
        if not realised and (halves[-1].any() or digits.any()):
            units = np.concatenate([row.units for row in rows[:i]])
            J, scale = (np.vstack([level[k] for level in rows[:i]]) for k in (0, 2))
            normal = generalized_inverse(units[:, None] * J, rank=rank_of(J, scale)).left_null
            outside = units * (np.concatenate(stands) - np.concatenate(best[:i]))

            def made(near: Array, level: int = i) -> Array:
                return np.concatenate([row.units * (row.J @ x + row.drift) for row in levels.rows(near)[:level]])

            given, half = rows[i - 1].units * b, units * np.concatenate(halves)
            realised = realised_within_digits(normal, (given, half), outside, made, (here, digits))
            meant.append(c if realised else b)
        else:
            meant.append(b)
        if not realised:
            stands[-1], halves[-1] = c, 0 * c
    return meant


def with_singularity(at: Callable[[Any], Answer], levels: AskedLevels, q: ConfigurationLike) -> Answer:
    """Return at(q); and with it, where a singular configuration of the levels 1, ..., i rounds to q, the answer there.

    There [J₁; ...; Jᵢ] has a lower rank, while at q itself its inverse asks for rates that only the rounding makes.
    """
    answer = at(q)
    if not printed_half_units(levels.robot, q).any():
        return answer
    scales = [row.scale for row in levels.rows(levels.robot.configuration(q))]
    for i in range(1, len(scales) + 1):

        def stacked(x: Array, level: int = i) -> Array:
            return np.vstack([row.J for row in levels.rows(x)[:level]])

        found = rounded_configuration(stacked, levels.robot, q, np.vstack(scales[:i]))
        if found.singular_q is not None:
            return replace(answer, rounded=found, at_singularity=at(found.singular_q))
    return answer
