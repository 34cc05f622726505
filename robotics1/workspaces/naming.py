"""Critical curves in metres, with the names of joints and the reason why they are a boundary."""

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.reading import ReadArm
from robotics1.workspaces.result import BoundaryCurve

STEP = 0.03  # rad between drawn points of an arc


def coordinates(arm: ReadArm, z: complex) -> Array:
    """Return the coordinates (2,) of a point of the section [m]; see `Workspace`."""
    point = arm.in_world(z)
    return np.array([point @ arm.first if arm.base is None else arm.size * z.real, point @ arm.second])


def names_of_coordinates(arm: ReadArm) -> tuple[str, str]:
    """Return names of the coordinates of the section: letters of world axes, ρ and h, or u and v."""
    if arm.base is not None:
        return "ρ", "h"
    letters = ["xyz"[int(np.argmax(axis))] if np.max(axis) > 1 - 1e-9 else "" for axis in (arm.first, arm.second)]
    return (letters[0], letters[1]) if all(letters) else ("u", "v")


def configuration_in_units(arm: ReadArm, q: tuple[float, ...]) -> Array:
    """Return q (nq,) [rad or m] of a chain of unit size; the slide is in the middle of its range."""
    values = np.array(q)
    for joint in arm.joints:
        if not joint.revolute:
            values[joint.number] *= arm.size
    if arm.slide is not None:
        values[arm.slide.number] = (arm.slide.lower + arm.slide.upper) / 2
    return values


def boundary_curve(robot: Robot, arm: ReadArm, curve: CriticalCurve) -> BoundaryCurve:
    """Return a critical curve as a part of the boundary."""
    names = robot.joint_names
    limits = {names[number]: limit for number, limit in sorted(curve.limits)}
    free = [joint.name for joint in arm.joints if joint.name not in limits]
    singular = tuple(free) if len(free) > 1 else ()
    end = curve.point(curve.length)
    count = 2 if curve.centre is None else 2 + int(curve.length / STEP)
    return BoundaryCurve(
        points=np.array([coordinates(arm, curve.point(float(t))) for t in np.linspace(0, curve.length, count)]),
        start=coordinates(arm, curve.start),
        end=coordinates(arm, end),
        center=None if curve.centre is None else coordinates(arm, curve.centre),
        radius=curve.radius * arm.size,
        angle=0.0 if curve.centre is None else curve.length,
        q_start=configuration_in_units(arm, curve.q),
        q_end=configuration_in_units(arm, curve.configuration(curve.length)),
        joint=names[curve.joint],
        limits=limits,
        singular=singular,
        reason=reason_of(limits, singular),
    )


def reason_of(limits: dict[str, str], singular: tuple[str, ...]) -> str:
    """Return in words which joints are at a limit, and which are singular together."""
    parts = [f"{name} is at its {limit} limit" for name, limit in limits.items()]
    if singular:
        parts.append(f"{', '.join(singular[:-1])} and {singular[-1]} are singular together")
    return " and ".join(parts)
