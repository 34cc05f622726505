"""The arms of textbooks and examinations by their DH tables, lengths by name; imports nothing private."""

from math import pi

import numpy as np

from robotics1 import robot_from_dh

H = pi / 2


def R(a, alpha, d, theta=0):
    return ("R", a, alpha, d, theta)


def P(alpha, theta=0):
    return ("P", 0, alpha, 0, theta)


def dh(*rows, tool=0, **lengths):
    """The robot of a DH table, its tool on the last z axis."""
    tool_placement = np.eye(4)
    tool_placement[2, 3] = tool
    return robot_from_dh(rows, parameters=lengths, tool_placement=tool_placement)


def four_links(**lengths):
    return dh(*(R(name, 0, 0) for name in "abcd"), **lengths)


def shoulder_arm(a1):
    return dh(R("a1", H, "d1"), R("a2", 0, "d2"), R("a3", 0, 0), a1=a1, d1=0.3, a2=0.4, d2=0.15, a3=0.3)


def skewed(alpha):
    return dh(R("a", alpha, 0), R("b", alpha, 0), R("c", 0, 0), a=0.2, b=0.4, c=0.3)


def orthogonal(a2, a3):
    """Each axis turned by a quarter from the one before; the first two meet."""
    return dh(R(0, H, 0), R("a2", H, 0), R("a3", 0, 0), a2=a2, a3=a3)


def five(**lengths):
    rows = (R(0, H, "d1"), R("a2", 0, 0), R("a3", 0, 0), R(0, H, 0), R(0, 0, "d5"))
    return dh(*rows, **{"d1": 0.3, "a2": 0.4, "a3": 0.33, "d5": 0.1} | lengths)


def srs():
    rows = (R(0, -H, 0), R(0, H, 0), R(0, H, "ds"), R(0, -H, 0), R(0, -H, "de"), R(0, H, 0), R(0, 0, "dw"))
    return dh(*rows, ds=0.4, de=0.39, dw=0.08)


def stanford():
    rows = (R(0, -H, "d1"), R(0, H, "d2"), P(0), R(0, -H, 0), R(0, H, 0), R(0, 0, "d6"))
    return dh(*rows, d1=0.4, d2=0.15, d6=0.26)


def puma():
    rows = (R(0, H, 0), R("a2", 0, 0), R("a3", -H, "d3"), R(0, H, "d4"), R(0, -H, 0), R(0, 0, 0))
    return dh(*rows, a2=0.4318, a3=0.0203, d3=0.15, d4=0.4318)


def ur5():
    rows = (R(0, H, "d1"), R("a2", 0, 0), R("a3", 0, 0), R(0, H, "d4"), R(0, -H, "d5"), R(0, 0, "d6"))
    return dh(*rows, d1=0.0892, a2=-0.425, a3=-0.39225, d4=0.10915, d5=0.09465, d6=0.0823)


ZYZ = (R(0, -H, 0), R(0, H, 0), R(0, 0, "d6"))
POLAR_ARM = (R(0, H, 1), R(0, H, 0), P(0))
SCARA = (R("a1", 0, "d1"), R("a2", pi, 0), P(0), R(0, 0, 0))
SPATIAL_4R = (R(0, H, 0), R(0, H, 0), R(0, H, "L"), R("L", 0, 0))
CABLE = (R(0, -H, 0), R(0, H, 0), R(0.045, -H, 0.55), R(-0.045, H, 0))
NAMED_CABLE = (R(0, -H, 0), R(0, H, 0), R("a3", -H, "d3"), R("-a3", H, 0))
TILTED = (R("a1", -H, "d1"), R("a2", pi / 3, "d2", H), R(0, 0, "d3"))
EQUAL_RRP = (R("a1", -H, "d1", H), R("a2", -H, 0, H), P(H))
EQUAL_3R = (R("a1", H, 0, H), R("a2", pi / 3, "d2", H), R("a3", H, 0, H))
EIGHTH = (R("a1", 0, 0), R(0, pi / 4, 0), R("a3", -H, "d3"))
TWISTED = (R(0, "alpha", 0.3), R(0, "-alpha", 0.2), R(0, 0, 0))
NUMBERED = (R(0, H, 0.4), R(0.5, 0, 0), R(0.5, 0, 0))
GANTRY = (P(H), P(H, H), P(H, H), *ZYZ)


def offset_arm():
    return dh(R("L1", H, "D"), R("L2", 0, 0), R("L3", 0, 0), D=0.5, L1=0.1, L2=0.4, L3=0.3)


def planar_rpr():
    return dh(R(0, H, 0, H), P(-H), R("L", 0, 0, -H), L=0.5)
