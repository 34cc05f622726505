"""Arms and tasks with the singular sets they have, worked out by hand or from textbooks; imports nothing private.

An entry is: robot, task, ρ, and equations → the rank there, "q2 = 0 | pi; q3 = 0" for (0, 0) and (π, 0). None where the
equations are too long to be written by hand.
"""

from math import pi

import numpy as np
from arms import arm
from dh_arms import (
    CABLE,
    EIGHTH,
    EQUAL_3R,
    EQUAL_RRP,
    GANTRY,
    NAMED_CABLE,
    NUMBERED,
    POLAR_ARM,
    SCARA,
    SPATIAL_4R,
    TILTED,
    TWISTED,
    ZYZ,
    P,
    R,
    dh,
    five,
    four_links,
    orthogonal,
    planar_rpr,
    puma,
    shoulder_arm,
    skewed,
    srs,
    stanford,
    ur5,
)

from robotics1 import FunctionTask, OrientationTask, PlanarPoseTask, PointingTask, PoseTask, PositionTask

H = pi / 2
X, Y, Z, XY, XYZ = (PositionTask(axes) for axes in ("x", "y", "z", "xy", "xyz"))
PLANE, TURN, POSE, POINT = PlanarPoseTask("xy"), OrientationTask(), PoseTask(), PointingTask("z")
POLAR = FunctionTask(lambda p, R, q: [np.hypot(p[0], p[1]), np.arctan2(p[1], p[0])], 2)  # distance and azimuth

scara = {"a1": 0.4, "a2": 0.3, "d1": 0.5}
STRETCHED = {"q2 = 0 | pi": 1}
FOLDED = {"q2 = 0 | pi; q3 = 0 | pi; q4 = 0 | pi": 1}
UPRIGHT = "q2 = -pi/2 | pi/2; q3 = 0 | pi"
ELBOW, SHOULDER = "q3 = 0 | pi", "a2*cos(q2) + a3*cos(q2 + q3) = 0"
WRIST = "q5 = 0 | pi"
SRS_ELBOW, SRS_SHOULDER = "q4 = 0 | pi", "q2 = 0 | pi; q3 = -pi/2 | pi/2"
SRS_SET = {SRS_ELBOW: 5, SRS_SHOULDER: 5, "q2 = 0 | pi; q6 = 0 | pi": 5, "q5 = -pi/2 | pi/2; q6 = 0 | pi": 5}

CASES = {
    "2R xy": (lambda: arm("planar_2r"), XY, 2, STRETCHED),
    "2R x": (lambda: arm("planar_2r"), X, 1, {"q1 = 0 | pi; q2 = 0 | pi": 0}),
    "2R xyz": (lambda: arm("planar_2r"), XYZ, 2, STRETCHED),
    "2R pose": (lambda: arm("planar_2r"), PLANE, 2, {}),
    "2R polar": (lambda: arm("planar_2r"), POLAR, 2, STRETCHED),
    "2R vertical z": (lambda: arm("vertical_2r"), Z, 1, {"q1 = -pi/2 | pi/2; q2 = 0 | pi": 0}),
    "2R, l2 = 0, xy": (lambda: arm("planar_2r", l2=0), XY, 1, {}),
    "3R xy": (lambda: arm("planar_3r"), XY, 2, {"q2 = 0 | pi; q3 = 0 | pi": 1}),
    "3R, l2 = l3, xy": (lambda: arm("planar_3r", l2=0.3), XY, 2, {"q2 = 0 | pi; q3 = 0 | pi": 1}),
    "3R pose": (lambda: arm("planar_3r"), PLANE, 3, {"q2 = 0 | pi": 2}),
    "4R xy": (lambda: four_links(a=0.5, b=0.43, c=0.3, d=0.2), XY, 2, FOLDED),
    "4R, a + d = b + c, xy": (lambda: four_links(a=0.5, b=0.4, c=0.3, d=0.2), XY, 2, FOLDED),
    "4R pose": (lambda: four_links(a=0.5, b=0.4, c=0.3, d=0.2), PLANE, 3, {"q2 = 0 | pi; q3 = 0 | pi": 2}),
    "PRR pose": (lambda: arm("prr"), PLANE, 3, {"q2 = -pi/2 | pi/2": 2}),
    "PRR xy": (lambda: arm("prr"), XY, 2, {UPRIGHT: 1}),
    "PRR, l2 = l3, xy": (lambda: arm("prr", l2=0.5, l3=0.5), XY, 2, {UPRIGHT: 1}),
    "PRR y": (lambda: arm("prr"), Y, 1, {UPRIGHT: 0}),
    "RPR xy": (planar_rpr, XY, 2, {"q2 = 0; q3 = -pi/2 | pi/2": 1}),
    "RPR pose": (planar_rpr, PLANE, 3, {"q2 = 0": 2}),
    "RRP xyz": (lambda: dh(*POLAR_ARM), XYZ, 3, {"q2 = 0 | pi": 2, "q3 = 0": 1}),
    "RRP twist": (lambda: dh(*POLAR_ARM), POSE, 3, {}),
    "RRP pointing": (lambda: dh(*POLAR_ARM), POINT, 2, {"q2 = 0 | pi": 1}),
    "PPR xyz": (lambda: dh(P(H), P(H, H), R("l", 0, 0), l=0.3), XYZ, 2, {}),
    "RP y": (lambda: dh(R(0, H, 0, H), P(0)), Y, 1, {"q1 = 0 | pi; q2 = 0": 0}),
    "cylindrical xyz": (lambda: arm("cylindrical"), XYZ, 3, {"q3 = 0": 2}),
    "SCARA xyz": (lambda: dh(*SCARA, **scara), XYZ, 3, {"q2 = 0 | pi": 2}),
    "SCARA twist": (lambda: dh(*SCARA, **scara), POSE, 4, {"q2 = 0 | pi": 3}),
    "3R arm xyz": (lambda: arm("anthropomorphic"), XYZ, 3, {ELBOW: 2, SHOULDER: 2}),
    "3R arm, a2 < a3, xyz": (lambda: arm("anthropomorphic", a2=0.35, a3=0.5), XYZ, 3, {ELBOW: 2, SHOULDER: 2}),
    "3R arm, a2 = a3, xyz": (lambda: arm("anthropomorphic", a2=0.4, a3=0.4), XYZ, 3, None),
    "3R arm of numbers xyz": (lambda: dh(*NUMBERED), XYZ, 3, {"q3 = 0": 2, "q3 = pi": 1, "2*q2 + q3 = pi": 2}),
    "3R arm xy": (lambda: arm("anthropomorphic"), XY, 2, {SHOULDER: 1, "q2 = 0 | pi; q3 = 0 | pi": 1}),
    "3R arm pointing": (lambda: arm("anthropomorphic"), POINT, 2, {"q2 + q3 = 0 | pi": 1}),
    "3R arm twist": (lambda: arm("anthropomorphic"), POSE, 3, {}),
    "shoulder offset xyz": (lambda: shoulder_arm(0.1), XYZ, 3, {ELBOW: 2, "a1 + " + SHOULDER: 2}),
    "shoulder offset 0 xyz": (lambda: shoulder_arm(0), XYZ, 3, {ELBOW: 2, "a1 + " + SHOULDER: 2}),
    "shoulder offset beyond reach xyz": (lambda: shoulder_arm(1.0), XYZ, 3, {ELBOW: 2}),
    "3R skewed by 60° xyz": (lambda: skewed(pi / 3), XYZ, 3, None),
    "3R skewed by 0.4 xyz": (lambda: skewed(0.4), XYZ, 3, None),
    "orthogonal 3R, a2 > a3, xyz": (lambda: orthogonal(0.4, 0.3), XYZ, 3, {"q2 = -pi/2 | pi/2": 2, ELBOW: 2}),
    "orthogonal 3R, a2 < a3, xyz": (
        lambda: orthogonal(0.3, 0.4),
        XYZ,
        3,
        {"q2 = -pi/2 | pi/2": 2, ELBOW: 2, "q3 = acos(-a2/a3) | -acos(-a2/a3)": 2},
    ),
    "orthogonal 3R, a2 = a3, xyz": (
        lambda: orthogonal(0.4, 0.4),
        XYZ,
        3,
        {"q2 = -pi/2 | pi/2": 2, "q3 = 0": 2, "q3 = pi": 1},
    ),
    "twisted wrist": (lambda: dh(*TWISTED, alpha=1.0), TURN, 3, {"q2 = 0 | pi": 2}),
    "ZYZ wrist": (lambda: dh(*ZYZ, d6=0.1), TURN, 3, {"q2 = 0 | pi": 2}),
    "spatial 4R xyz": (lambda: dh(*SPATIAL_4R, L=1.0), XYZ, 3, {"q4 = -pi/2": 1, "q4 = pi/2": 2, SRS_SHOULDER: 2}),
    "spatial 4R twist": (lambda: dh(*SPATIAL_4R, L=1.0), POSE, 4, {"q2 = 0 | pi": 3}),
    "cable arm xyz": (lambda: dh(*CABLE, tool=0.35), XYZ, 3, None),
    "cable arm with names xyz": (lambda: dh(*NAMED_CABLE, tool=0.35, a3=0.045, d3=0.55), XYZ, 3, None),
    "3R with 60° and 90° xy": (lambda: dh(*TILTED, a1=0.3, d1=0.2, a2=0.5, d2=0.2, d3=0.3), XY, 2, None),
    "3R with 45° and equal lengths xy": (lambda: dh(*EIGHTH, a1=0.3, a3=0.3, d3=0.3), XY, 2, {
        "q2 = -pi/2 | pi/2; q3 = -pi/2 | pi/2": 1}),
    "RRP, a1 = a2 = −d1, xy": (lambda: dh(*EQUAL_RRP, a1=0.4, a2=0.4, d1=-0.4), XY, 2, None),
    "3R, d2 = −a1 and a2 = a3, z": (lambda: dh(*EQUAL_3R, a1=-0.3, a2=0.2, a3=0.2, d2=0.3), Z, 1, None),
    "RRPR pointing": (lambda: dh(R(0.2, pi / 4, 0), R(0, pi / 4, 0.5, H), P(-H), R(0, -H, 0)), POINT, 2, None),
    "5R twist": (five, POSE, 5, {ELBOW: 4, "q2 + q3 + q4 = 0 | pi; " + SHOULDER: 4}),
    "5R, a2 = a3 + d5, xyz": (lambda: five(a3=0.3), XYZ, 3, None),
    "Stanford": (stanford, POSE, 6, {"q2 = 0 | pi": 5, "q3 = 0": 5, WRIST: 5}),
    "Puma 560": (puma, POSE, 6, {"q3 = atan2(-d4, a3) | atan2(d4, -a3)": 5, WRIST: 5,
                                 "a2*cos(q2) + a3*cos(q2 + q3) - d4*sin(q2 + q3) = 0": 5}),
    "UR5": (ur5, POSE, 6, {ELBOW: 5, WRIST: 5, "a2*cos(q2) + a3*cos(q2 + q3) + d5*sin(q2 + q3 + q4) = 0": 5}),
    "6R xyz": (lambda: arm("six_r"), XYZ, 3, None),
    "gantry and wrist": (lambda: dh(*GANTRY, d6=0.1), POSE, 6, {WRIST: 5}),
    "7R twist": (srs, POSE, 6, SRS_SET),
    "7R wrist centre": (srs, PositionTask("xyz", frame="link5"), 3, {SRS_ELBOW: 2, SRS_SHOULDER: 2}),
    "7R limited": (lambda: arm("redundant"), POSE, 6, None),
}  # fmt: skip

# One of each kind: planar, spatial, prismatic, wide, tall, regular everywhere, curved, skew, a wrist, redundant.
CORE = {
    *("2R xy", "2R pose", "2R polar", "3R xy", "PRR pose", "RPR xy", "RRP xyz", "RRP pointing", "RP y"),
    *("cylindrical xyz", "SCARA twist", "3R arm xyz", "3R arm xy", "shoulder offset beyond reach xyz"),
    *("orthogonal 3R, a2 < a3, xyz", "ZYZ wrist", "3R with 45° and equal lengths xy", "UR5"),
}
