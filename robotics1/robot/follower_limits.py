"""A leader moves only as far, and as fast, as the joints that mimic it can follow.

With q_f = a q + b, the limits l ≤ q_f ≤ u and |q̇_f| ≤ v of a follower are limits of its leader:

    a > 0:  (l − b)/a ≤ q ≤ (u − b)/a        a < 0:  (u − b)/a ≤ q ≤ (l − b)/a        |q̇| ≤ v/|a|
"""

import xml.etree.ElementTree as ET

import numpy as np
import pinocchio as pin

from robotics1.robot.rewriting import factor, leader, numbers

Interval = tuple[float, float]
NOWHERE = 1e-9  # rad or m: a narrower interval leaves no room to move


def narrow_leaders(model: pin.Model, root: ET.Element) -> list[str]:
    """Narrow the limits of the model's leaders, and return what in the file contradicts itself, in sentences.

    Followers that would leave their leader no room to move, though it has some of its own, are not kept: their
    numbers cannot be meant. A continuous follower has none.

    Args:
        model: its limits are changed.
        root: the URDF tree, in which no leader mimics another joint.
    """
    followers: dict[str, list[ET.Element]] = {}
    for joint in root.findall("joint"):
        if leader(joint) is not None:
            followers.setdefault(str(leader(joint)), []).append(joint)
    warnings = []
    for name, joints in followers.items():
        own = model.joints[model.getJointId(name)]
        _narrow_velocity(model, own.idx_v, joints)
        i = own.idx_q
        limits = float(model.lowerPositionLimit[i]), float(model.upperPositionLimit[i])
        kept, narrowed = limits, []
        for joint in joints:
            implied = _implied(joint)
            if _room(limits) and not _room(_both(limits, implied)):
                warnings.append(_contradiction(joint, name, limits))
            else:
                kept = _both(kept, implied)
                narrowed.append(str(joint.get("name")))
        if _room(limits) and not _room(kept):
            warnings.append(f"the limits of {', '.join(narrowed)}, which mimic joint {name!r}, exclude each other")
            kept = limits
        model.lowerPositionLimit[i], model.upperPositionLimit[i] = kept if kept[0] <= kept[1] else limits
    return warnings


def _implied(joint: ET.Element) -> Interval:
    """Return the interval of the leader's coordinate inside which a follower keeps its limits."""
    a, b, lower, upper = _numbers(joint)
    if joint.get("type") == "continuous" or (a == 0 and lower <= b <= upper):
        return -np.inf, np.inf
    if a == 0:
        return np.inf, -np.inf
    ends = sorted((end - b) / a for end in (lower, upper))
    return ends[0], ends[1]


def _numbers(joint: ET.Element) -> tuple[float, float, float, float]:
    """Return a, b, l and u of a follower."""
    limit, mimic = joint.find("limit"), joint.find("mimic")
    lower, upper = (numbers(limit, key, "0")[0] for key in ("lower", "upper"))
    return factor(mimic, "multiplier", 1.0), factor(mimic, "offset", 0.0), lower, upper


def _narrow_velocity(model: pin.Model, i: int, joints: list[ET.Element]) -> None:
    """A velocity limit of 0 means none is given: a joint that cannot move would be a fixed one."""
    velocities = [float(model.upperVelocityLimit[i])]
    for joint in joints:
        a, v = factor(joint.find("mimic"), "multiplier", 1.0), numbers(joint.find("limit"), "velocity", "0")[0]
        if a != 0 and v > 0:
            velocities.append(v / abs(a))
    model.upperVelocityLimit[i] = min(velocities)


def _both(one: Interval, other: Interval) -> Interval:
    return max(one[0], other[0]), min(one[1], other[1])


def _room(limits: Interval) -> bool:
    return limits[1] - limits[0] > NOWHERE


def _contradiction(joint: ET.Element, name: str, limits: Interval) -> str:
    a, b, lower, upper = _numbers(joint)
    return (
        f"joint {joint.get('name')!r} has the limits [{lower:g}, {upper:g}] and is {a:g} times joint {name!r} plus "
        f"{b:g}, whose limits are [{limits[0]:g}, {limits[1]:g}]: no motion is inside both; the limits of "
        f"{joint.get('name')!r} are not kept"
    )
