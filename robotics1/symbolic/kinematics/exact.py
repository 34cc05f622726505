"""Numbers of a file, as the exact ones that are meant; and a robot with the angles of its file made exact."""

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from math import isqrt

import numpy as np
import pinocchio as pin

from robotics1.angles import MEANT, clean_angle
from robotics1.inputs import Array
from robotics1.robot.building import build_model
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Parameters

FINE = 10**8  # largest denominator of a half-angle tangent that stands for an angle: 1e-16
SHORT = 1000  # a length within 1e-12 of a fraction with a denominator up to this is that fraction


def exact_robot(robot: Robot, parameters: Mapping[str, float] | None = None) -> tuple[Robot, float]:
    """Return the robot with the angles that are nearly multiples of π/12 made so, and the largest correction [rad].

    It has no inertias and no named parameters. The robot itself is returned when there is nothing to correct.

    Args:
        robot: any robot.
        parameters: other values of its named parameters; a placement that is no polynomial in these stays.
    """
    joints = robot.joints if parameters is None else tuple(_placed(robot, joint, parameters) for joint in robot.joints)
    cleaned = tuple(_cleaned(joint) for joint in joints)
    changes = [np.abs(np.subtract(a.rpy, b.rpy)).max() for a, b in zip(joints, cleaned, strict=True)]
    largest = float(max(changes, default=0.0))
    if largest < 1e-12:
        cleaned, largest = joints, 0.0
        if parameters is None:
            return robot, 0.0
    model = build_model(robot.name, dict.fromkeys(robot.frame_names, pin.Inertia.Zero()), cleaned)
    return replace(robot, own_model=model, joints=cleaned, parameters=Parameters(), source=None), largest


def _cleaned(joint: Joint) -> Joint:
    roll, pitch, yaw = (clean_angle(angle, MEANT) for angle in joint.rpy)
    return replace(joint, rpy=(roll, pitch, yaw))


def _placed(robot: Robot, joint: Joint, parameters: Mapping[str, float]) -> Joint:
    """Return a joint with its placement at these values of the parameters."""
    placement = robot.placements[joint.name]
    if isinstance(placement, str):
        return joint
    x, y, z, roll, pitch, yaw = map(float, placement.at(parameters))
    return replace(joint, xyz=(x, y, z), rpy=(roll, pitch, yaw))


def exact_length(value: float, size: float = 1.0) -> Fraction:
    """Return a length [m] as a short fraction where it is one, else as its decimal digits; what is rounding beside the
    size of the arm [m], or beside 1 m, is left out.
    """
    short = Fraction(value).limit_denominator(SHORT)
    return short if abs(float(short) - value) <= 1e-12 * min(1.0, size) else Fraction(repr(float(value)))


def exact_axis(axis: Array, *, rational: bool = False) -> tuple[tuple[Fraction, ...], int]:
    """Return (v, k) with v √k the unit axis exactly, k = 1, 2, 3 or 6; only 1 where it must be rational.

    An axis along small whole numbers, such as (1, 0, −1), is that; another is the rational point of the unit sphere
    next to it, to 1e-16: the stereographic image of rational coordinates.
    """
    largest = int(np.abs(axis).argmax())
    v = [Fraction(x / abs(axis[largest])).limit_denominator(12) for x in axis]
    length = sum((x * x for x in v), Fraction(0))
    if np.abs(np.array(v, dtype=float) / np.sqrt(float(length)) - axis).max() < 1e-9:
        for k in (1,) if rational else (1, 2, 3, 6):
            root = _rational_root(length * k)
            if root is not None:
                return tuple(x / root for x in v), k
    sign = 1 if axis[largest] > 0 else -1
    plane = [Fraction(x / (1 + abs(axis[largest]))).limit_denominator(FINE) for x in axis]
    plane[largest] = Fraction(0)
    square = sum((x * x for x in plane), Fraction(0))
    point = [2 * x / (1 + square) for x in plane]
    point[largest] = sign * (1 - square) / (1 + square)
    return tuple(point), 1


def _rational_root(x: Fraction) -> Fraction | None:
    p, q = isqrt(x.numerator), isqrt(x.denominator)
    return Fraction(p, q) if p * p == x.numerator and q * q == x.denominator else None
