"""Equations that hold at single values of their joints only, such as the common zeros of two curves: the values.

Where these touch each other, no factor of theirs says so, and
with √2 and √3 rounded there may be no exact common zero at all. The values are then found in numbers, and are exact
where they are multiples of π/12 for angles, and zero for slides.
"""

from itertools import product

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.evaluation import evaluated_part
from robotics1.symbolic.polynomials.laurent import Frequencies
from robotics1.symbolic.polynomials.substitution import Substitution
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.zeros import Zero, angle_zero

ROUNDED = 1e-14  # of an equation, beside the sum of its terms: zero but for √2 and √3, which are fractions to 1e-16
MOST_JOINTS = 3  # that the equations tie together
DRAWN = 12  # configurations, none of which may be elsewhere
BESIDE = 0.02  # from a zero, where σ is rounding already, in rad and reaches


def at_single_values(piece: Configurations, box: JointBox, rng: np.random.Generator) -> list[Configurations]:
    """Return the pieces at which the joints of all implicit equations have a value, if these are all configurations of
    the piece; nothing if the equations hold elsewhere too, or at other values.
    """
    locus = piece.locus
    joints = [i for i, symbol in enumerate(locus.frequencies.q) if any(symbol in p.symbols for p in locus.implicit)]
    if not 1 < len(joints) <= min(MOST_JOINTS, len(locus.implicit)) or piece.pinned:
        return []
    values = _special_zeros(piece, joints)
    if not len(values):
        return []
    drawn = [q for q in (piece.near(box, start) for start in box.random(rng, DRAWN)) if q is not None]
    unit = box.unit[joints]
    angles = np.array([locus.frequencies.q[i] in locus.frequencies.angles for i in joints])
    for q in drawn:
        apart = q[joints] - values
        apart = np.where(angles, np.angle(np.exp(1j * apart)), apart / unit)
        if np.abs(apart).max(axis=1).min() > BESIDE:
            return []
    return [Configurations(_with_values(locus, joints, value), piece.parameters, {}) for value in values]


def _special_zeros(piece: Configurations, joints: list[int]) -> Array:
    """Return the multiples of π/12, and zeros of slides, at which all implicit equations hold, (k, joints)."""
    F = piece.locus.frequencies
    choices = [range(-11, 13) if F.q[i] in F.angles else (0,) for i in joints]
    values = np.array(list(product(*choices))) * np.pi / 12
    q = np.zeros((len(values), len(F.q)))
    q[:, joints] = values
    for part in piece.locus.implicit:
        f = evaluated_part(part, piece.parameters)
        q = q[np.abs(f.at_many(q)) <= ROUNDED * f.size]
    return q[:, joints]


def _with_values(locus: Locus, joints: list[int], values: Array) -> Locus:
    for i, value in zip(joints, values, strict=True):
        locus, _ = locus.where(_zero_at(locus.frequencies, i, value))  # the equations hold, but for rounding
    return locus.rounded()


def _zero_at(F: Frequencies, i: int, value: float) -> Zero:
    symbol = F.q[i]
    if symbol in F.angles:
        return angle_zero(symbol, F.turn(round(value * 12 / np.pi)))
    return Zero(F.constant(F.ring(symbol)), Substitution(symbol, F.constant(0)))
