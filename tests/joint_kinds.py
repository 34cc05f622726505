"""Robots with every kind of joint as texts, and their forward kinematics as a product of matrices, not ours."""

import xml.etree.ElementTree as ET
from itertools import cycle

import numpy as np
from scipy.spatial.transform import Rotation

PLACES = ('xyz="0.3 -0.1 0.2" rpy="0.3 -0.5 0.7"', 'xyz="0.1 0.4 -0.2" rpy="-0.6 0.2 1.1"', 'xyz="-0.2 0.1 0.5"')
AXES = ("0.6 0 0.8", "0 0.6 -0.8", "0.48 0.6 0.64")
MOVING = ("revolute", "prismatic", "continuous")


def urdf(*joints):
    """The text of a robot: (name, type, parent, what else stands in the joint); the child of joint a is link a."""
    parts = ['<link name="base"/>']
    for (name, kind, parent, *inside), place, axis in zip(joints, cycle(PLACES), cycle(AXES), strict=False):
        text = "".join(inside)
        if kind in ("revolute", "prismatic") and "<limit" not in text:
            text += '<limit lower="-1.5" upper="2" velocity="3" effort="4"/>'
        if kind in MOVING and "<axis" not in text:
            text += f'<axis xyz="{axis}"/>'
        ends = f'<parent link="{parent}"/><child link="{name}"/><origin {place}/>'
        parts.append(f'<link name="{name}"/><joint name="{name}" type="{kind}">{ends}{text}</joint>')
    return f'<robot name="kinds">{"".join(parts)}</robot>'


def mimic(leader, multiplier=1.0, offset=0.0):
    return f'<mimic joint="{leader}" multiplier="{multiplier}" offset="{offset}"/>'


KINDS = {  # name → text, nq, nv
    "revolute": (urdf(("a", "revolute", "base"), ("b", "revolute", "a"), ("tool", "fixed", "b")), 2, 2),
    "prismatic": (urdf(("a", "prismatic", "base"), ("b", "prismatic", "a"), ("tool", "fixed", "b")), 2, 2),
    "continuous": (urdf(("a", "continuous", "base"), ("b", "continuous", "a"), ("tool", "fixed", "b")), 2, 2),
    "fixed": (urdf(("a", "fixed", "base"), ("b", "fixed", "a"), ("tool", "fixed", "b")), 0, 0),
    "floating": (urdf(("a", "revolute", "base"), ("b", "floating", "a"), ("tool", "revolute", "b")), 9, 8),
    "planar": (
        urdf(("a", "prismatic", "base"), ("b", "planar", "a", '<axis xyz="0 0 1"/>'), ("tool", "fixed", "b")),
        5,
        4,
    ),
    "mixed": (
        urdf(("a", "continuous", "base"), ("b", "prismatic", "a"), ("c", "revolute", "b"), ("tool", "fixed", "c")),
        3,
        3,
    ),
    "no axis": (urdf(("a", "revolute", "base", "<axis xyz='1 0 0'/>"), ("tool", "fixed", "a")), 1, 1),
    "long axes": (
        urdf(("a", "revolute", "base", "<axis xyz='0 3 4'/>"), ("tool", "prismatic", "a", "<axis xyz='0 -2 0'/>")),
        2,
        2,
    ),
    "mimic": (
        urdf(("a", "revolute", "base"), ("b", "revolute", "a", mimic("a", -0.5, 0.3)), ("tool", "fixed", "b")),
        1,
        1,
    ),
    "prismatic follower": (
        urdf(("a", "revolute", "base"), ("b", "prismatic", "a", mimic("a", 0.2, -0.1)), ("tool", "fixed", "b")),
        1,
        1,
    ),
    "revolute follower of a slide": (
        urdf(("a", "prismatic", "base"), ("tool", "revolute", "a", mimic("a", 3, 0.1))),
        1,
        1,
    ),
    "continuous leader and follower": (
        urdf(("a", "continuous", "base"), ("tool", "continuous", "a", mimic("a", -2, 0.5))),
        1,
        1,
    ),
    "mimic of mimic": (
        urdf(
            ("a", "revolute", "base"),
            ("b", "revolute", "a", mimic("a", 2, 0.1)),
            ("c", "prismatic", "b", mimic("b", -0.5, 0.2)),
            ("tool", "revolute", "c", mimic("c", 3, -0.4)),
        ),
        1,
        1,
    ),
    "leader after its follower": (
        urdf(("z", "revolute", "base"), ("y", "revolute", "z"), ("tool", "revolute", "y", mimic("z"))),
        2,
        2,
    ),
}


def own_pose(text, link, values):
    """T_base_link as a product of matrices, of joint values by name: a number, or the motion (4, 4) itself."""
    joints = {joint.get("name"): joint for joint in ET.fromstring(text).findall("joint")}
    T = np.eye(4)
    while link in joints:  # a link has the name of the joint above it
        joint = joints[link]
        T = _origin(joint) @ _motion(joint, _coordinate(joints, link, values)) @ T
        link = joint.find("parent").get("link")
    return T


def _vector(element, attribute):
    return np.array([float(x) for x in element.get(attribute, "0 0 0").split()])


def _origin(joint):
    T = np.eye(4)
    T[:3, :3] = Rotation.from_euler("xyz", _vector(joint.find("origin"), "rpy")).as_matrix()
    T[:3, 3] = _vector(joint.find("origin"), "xyz")
    return T


def _coordinate(joints, name, values):
    follows = joints[name].find("mimic")
    if follows is None:
        return values.get(name, 0.0)
    leader = _coordinate(joints, follows.get("joint"), values)
    return float(follows.get("multiplier", 1)) * leader + float(follows.get("offset", 0))


def _motion(joint, value):
    if np.ndim(value) == 2:
        return value
    T = np.eye(4)
    if joint.get("type") in MOVING:
        axis = _vector(joint.find("axis"), "xyz")
        axis = axis / np.linalg.norm(axis)
        if joint.get("type") == "prismatic":
            T[:3, 3] = value * axis
        else:
            T[:3, :3] = Rotation.from_rotvec(value * axis).as_matrix()
    return T


def values_of(robot, q):
    """Joint name → its number, or the motion (4, 4) of a joint with several."""
    values = {}
    for i in range(1, robot.model.njoints):
        joint = robot.model.joints[i]
        part = q[joint.idx_q : joint.idx_q + joint.nq]
        if len(part) > 0:
            values[robot.model.names[i]] = part[0] if len(part) == 1 else _placed(part)
    return values


def _placed(q):
    """The motion of a planar joint (x, y, cos, sin), or of a floating one (x, y, z, quaternion)."""
    T = np.eye(4)
    if len(q) == 4:
        T[:2, 3] = q[:2]
        T[:3, :3] = Rotation.from_rotvec([0, 0, np.arctan2(q[3], q[2])]).as_matrix()
    else:
        T[:3, 3] = q[:3]
        T[:3, :3] = Rotation.from_quat(q[3:]).as_matrix()
    return T
