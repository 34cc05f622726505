"""Joints that mimic another one: a follower has no coordinate of its own, q_f = a q + b with that of its leader.

A leader moves only as far, and as fast, as its followers can. The limits l ≤ q_f ≤ u and |q̇_f| ≤ v of a follower are
limits of its leader:

    a > 0:  (l − b)/a ≤ q ≤ (u − b)/a        a < 0:  (u − b)/a ≤ q ≤ (l − b)/a        |q̇| ≤ v/|a|
"""

from collections.abc import Sequence
from dataclasses import replace
from graphlib import CycleError, TopologicalSorter

import numpy as np

from robotics1.robot.joints import Joint, root_of

Interval = tuple[float, float]
NOWHERE = 1e-9  # rad or m: a narrower interval leaves no room to move


# --- leaders


def follow_leaders(joints: Sequence[Joint]) -> tuple[Joint, ...]:
    """Let joints follow leaders that follow no other: q = a q₁ + b with q₁ = c q₂ + d is q = a c q₂ + a d + b."""
    found = {joint.name: joint for joint in joints}
    for name, follower in list(found.items()):
        a, b, leader = follower.multiplier, follower.offset, found[follower.leader]
        while leader.follows:
            a, b, leader = a * leader.multiplier, a * leader.offset + b, found[leader.leader]
        found[name] = replace(follower, leader=leader.name, multiplier=a, offset=b)
    return tuple(found.values())


# --- limits


def narrow_leaders(joints: Sequence[Joint]) -> tuple[tuple[Joint, ...], list[str]]:
    """Return the joints with the limits of leaders narrowed, and what contradicts itself, in sentences.

    Limits of followers that would leave their leader no room to move, though it has some of its own, are not kept:
    such numbers cannot be meant.
    """
    followers: dict[str, list[Joint]] = {}
    for joint in joints:
        if joint.follows:
            followers.setdefault(joint.leader, []).append(joint)
    warnings: list[str] = []
    found = [
        _narrowed(joint, followers[joint.name], warnings) if joint.name in followers else joint for joint in joints
    ]
    return tuple(found), warnings


def _narrowed(leader: Joint, followers: list[Joint], warnings: list[str]) -> Joint:
    limits = leader.lower, leader.upper
    kept, narrowed = limits, []
    for joint in followers:
        implied = _implied(joint)
        if _room(limits) and not _room(_both(limits, implied)):
            warnings.append(_contradiction(joint, limits))
        else:
            kept = _both(kept, implied)
            narrowed.append(joint.name)
    if _room(limits) and not _room(kept):
        warnings.append(f"the limits of {', '.join(narrowed)}, which mimic joint {leader.name!r}, exclude each other")
        kept = limits
    lower, upper = kept if kept[0] <= kept[1] else limits
    speeds = [j.max_velocity / abs(j.multiplier) for j in followers if j.multiplier != 0 and j.max_velocity > 0]
    return replace(leader, lower=lower, upper=upper, max_velocity=min([leader.max_velocity, *speeds]))


def _implied(joint: Joint) -> Interval:
    """Return the interval of the leader's coordinate inside which a follower keeps its limits."""
    a, b = joint.multiplier, joint.offset
    if a == 0:
        return (-np.inf, np.inf) if joint.lower <= b <= joint.upper else (np.inf, -np.inf)
    ends = sorted((end - b) / a for end in (joint.lower, joint.upper))
    return ends[0], ends[1]


def _both(one: Interval, other: Interval) -> Interval:
    return max(one[0], other[0]), min(one[1], other[1])


def _room(limits: Interval) -> bool:
    return limits[1] - limits[0] > NOWHERE


def _contradiction(joint: Joint, limits: Interval) -> str:
    return (
        f"joint {joint.name!r} has the limits [{joint.lower:g}, {joint.upper:g}] and is {joint.multiplier:g} times "
        f"joint {joint.leader!r} plus {joint.offset:g}, whose limits are [{limits[0]:g}, {limits[1]:g}]: no motion is "
        f"inside both; the limits of {joint.name!r} are not kept"
    )


# --- order


def leaders_first(links: Sequence[str], joints: Sequence[Joint]) -> list[Joint]:
    """Return the joints depth first: by name below a link, as Pinocchio has it, or so that branches with leaders come
    before those with their followers.
    """
    below: dict[str, list[Joint]] = {}
    for joint in sorted(joints, key=lambda joint: joint.name.encode()):
        below.setdefault(joint.parent, []).append(joint)
    top = root_of(links, joints)
    order = _walk(below, top)
    if not late_leaders(order):
        return order
    for siblings in below.values():
        siblings[:] = _in_turn(below, siblings)
    return _walk(below, top)


def late_leaders(order: Sequence[Joint]) -> list[Joint]:
    """Return the leaders that come after a joint that mimics them."""
    place = {joint.name: i for i, joint in enumerate(order)}
    return [order[i] for i in sorted({place[j.leader] for i, j in enumerate(order) if place[j.leader] > i})]


def _walk(below: dict[str, list[Joint]], link: str) -> list[Joint]:
    order: list[Joint] = []
    ahead = below.get(link, [])[::-1]
    while ahead:  # no recursion: a robot can be a thousand links long
        joint = ahead.pop()
        order.append(joint)
        ahead += below.get(joint.child, [])[::-1]
    return order


def _in_turn(below: dict[str, list[Joint]], siblings: list[Joint]) -> list[Joint]:
    """Return the joints below a link so that each branch comes after those in which its leaders are."""
    branches = [[joint, *_walk(below, joint.child)] for joint in siblings]
    place = {member.name: i for i, branch in enumerate(branches) for member in branch}
    needs = {i: [place[m.leader] for m in branch if place.get(m.leader, i) != i] for i, branch in enumerate(branches)}
    try:
        return [siblings[i] for i in TopologicalSorter(needs).static_order()]
    except CycleError:  # two branches follow each other: one of them comes after its followers
        return siblings
