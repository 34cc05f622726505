"""Singular configurations beside the joint limits: a limit such as 3.14159265 is meant to be π."""

from collections.abc import Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.notation import enumeration
from robotics1.robot.box import JointBox

NEAR = 1e-6  # from a limit, in units: rad, or reaches of the arm
ROUNDING = 1e-9  # outside of a limit by less than this is at the limit, in units


def note_on_limits(samples: Array, limits: JointBox, names: Sequence[str]) -> str:
    """Return which joints have all samples (k, n) at a limit, or outside of it by less than 1e-6; "" if none has."""
    below, above = samples - limits.lower, limits.upper - samples  # negative outside
    at: list[str] = []
    outside: list[str] = []
    for word, inside in (("lower", below), ("upper", above)):
        inside = inside / limits.unit
        near = (np.abs(inside).max(axis=0) <= NEAR) & ~limits.circular
        beyond = inside.max(axis=0) < -ROUNDING
        at += [f"the {word} limit of {names[i]}" for i in np.flatnonzero(near & ~beyond)]
        outside += [f"the {word} limit of {names[i]}" for i in np.flatnonzero(near & beyond)]
    said = [f"It lies at {enumeration(at)}."] if at else []
    if outside:
        said.append(f"It lies outside {enumeration(outside)} by less than {NEAR:g}, so that the arm can come to it.")
    return " ".join(said)
