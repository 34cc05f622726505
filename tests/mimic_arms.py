"""Random trees of joints, with followers of every form, as URDF texts; and their poses as products of matrices."""

from math import pi
from typing import NamedTuple

import numpy as np
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

KINDS = ("revolute", "prismatic", "continuous")


class Joint(NamedTuple):
    """One joint of a tree: what it turns about or moves along, and whom it follows."""

    kind: str
    parent: int  # the number of the joint before it, −1 for the base
    axis: tuple[float, float, float]
    xyz: tuple[float, float, float]
    rpy: tuple[float, float, float]
    leader: int | None  # the number of the joint it mimics
    multiplier: float
    offset: float


def triples(least, most):
    return st.tuples(*[st.floats(least, most).map(lambda x: round(x, 3))] * 3)


AXES = st.one_of(
    st.sampled_from([(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (0.6, 0, 0.8)]),
    triples(-1, 1).filter(lambda v: np.linalg.norm(v) > 0.2),
)
TURNS = st.one_of(st.just((0.0, 0.0, 0.0)), st.sampled_from([(pi / 2, 0.0, 0.0), (0.0, -pi / 2, 0.0)]), triples(-3, 3))


@st.composite
def trees(draw, least=1, most=6, followers=True, chain=False):
    """A tuple of joints; followers follow others, in chains too, on the way to the tool or beside it."""
    n = draw(st.integers(least, most))
    joints = []
    for i in range(n):
        parent = i - 1 if chain else draw(st.integers(max(-1, i - 3), i - 1)) if i < n - 1 else i - 1
        leader = draw(st.one_of(st.none(), st.integers(0, i - 1))) if followers and i else None
        joints.append(
            Joint(
                draw(st.sampled_from(KINDS)),
                parent,
                draw(AXES),
                draw(triples(-1, 1)),
                draw(TURNS),
                leader,
                draw(st.sampled_from([-1.0, 1.0, 0.5, -2.0, 3.0, 0.37])),
                draw(st.sampled_from([0.0, 0.2, -0.7])),
            )
        )
    return tuple(joints)


def text_of(joints):
    """The URDF: link i is moved by joint i; the tool stands off from the last."""
    parts = ['<link name="base"/>']
    for i, joint in enumerate(joints):
        parent = "base" if joint.parent < 0 else f"link{joint.parent}"
        follows = ""
        if joint.leader is not None:
            follows = f'<mimic joint="j{joint.leader}" multiplier="{joint.multiplier}" offset="{joint.offset}"/>'
        limit = "" if joint.kind == "continuous" else '<limit lower="-9" upper="9" velocity="9" effort="9"/>'
        parts.append(
            f'<link name="link{i}"/><joint name="j{i}" type="{joint.kind}"><parent link="{parent}"/>'
            f'<child link="link{i}"/><origin xyz="{_words(joint.xyz)}" rpy="{_words(joint.rpy)}"/>'
            f'<axis xyz="{_words(joint.axis)}"/>{follows}{limit}</joint>'
        )
    parts.append('<link name="tool"/><joint name="end" type="fixed">')
    parts.append(
        f'<parent link="link{len(joints) - 1}"/><child link="tool"/><origin xyz="0.3 0.1 -0.2" rpy="0.4 0 0.2"/>'
    )
    return f'<robot name="tree">{"".join(parts)}</joint></robot>'


def values(joints, q_of):
    """What each joint moves by, followers included: `q_of` maps the names of the leaders to their coordinates."""
    found = []
    for i, joint in enumerate(joints):
        own = joint.leader is None
        found.append(q_of[f"j{i}"] if own else joint.multiplier * found[joint.leader] + joint.offset)
    return found


def pose(joints, q_of, link):
    """T_base_link, (4, 4), as a product of matrices; `link` is a number, or "tool"."""
    moved = values(joints, q_of)
    T, end = np.eye(4), len(joints) - 1 if link == "tool" else link
    if link == "tool":
        T = _matrix(Rotation.from_euler("xyz", [0.4, 0, 0.2]).as_matrix(), [0.3, 0.1, -0.2])
    while end >= 0:
        joint = joints[end]
        axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
        slides = joint.kind == "prismatic"
        motion = _matrix(np.eye(3), moved[end] * axis) if slides else _matrix(_turn(moved[end] * axis), [0, 0, 0])
        T = _matrix(Rotation.from_euler("xyz", joint.rpy).as_matrix(), joint.xyz) @ motion @ T
        end = joint.parent
    return T


def _turn(vector):
    return Rotation.from_rotvec(vector).as_matrix()


def _matrix(R, p):
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def _words(numbers):
    return " ".join(repr(float(x)) for x in numbers)
