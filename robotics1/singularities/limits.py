"""Singular configurations beside the joint limits: a limit such as 3.14159265 is meant to be π."""

from collections.abc import Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.notation import enumeration
from robotics1.robot.box import JointBox

NEAR = 1e-6  # from a limit, in units: rad, or reaches of the arm
ROUNDING = 1e-9  # outside of a limit by less than this is at the limit, in units


def note_on_limits(samples: Array, limits: JointBox, names: Sequence[str]) -> str:
    """Return which limits all samples (k, n) are at; or, if none of them is inside, which they are outside of, by less
    than 1e-6. "" if neither.
    """
    sides = (("lower", samples - limits.lower), ("upper", limits.upper - samples))
    at: list[str] = []
    outside: list[str] = []
    none_inside = not any(limits.contains(q, ROUNDING) for q in samples)
    for word, distances in sides:
        inside = distances / limits.unit
        beyond = (inside < -ROUNDING).any(axis=0) & ~limits.circular & none_inside
        near = (np.abs(inside).max(axis=0) <= NEAR) & ~limits.circular & ~beyond
        at += [f"the {word} limit of {names[int(i)]}" for i in np.flatnonzero(near)]
        outside += [f"the {word} limit of {names[int(i)]}" for i in np.flatnonzero(beyond)]
    said = [f"It lies at {enumeration(at)}."] if at else []
    if outside:
        said.append(f"It lies outside {enumeration(outside)} by less than {NEAR:g}, so that the arm can come to it.")
    return " ".join(said)
