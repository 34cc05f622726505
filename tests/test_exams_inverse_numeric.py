"""Questions of other courses on inverse kinematics in numbers, answered with the public API."""

from math import pi

import numpy as np
from test_exams_inverse import TURN, are, chain

import robotics1 as r1
from robotics1.orientation import nearest_rotation

H, ONE = pi / 2, pi / 180


MANSEUR_DOTY = [("R", 0.3, H, 0, 0), ("R", 1, ONE, 0, 0), ("R", 0, H, 0.2, 0), ("R", 1.5, ONE, 0, 0)]
MANSEUR_DOTY += [("R", 0, H, 0, 0), ("R", 0, ONE, 0, 0)]
ROUNDED = [
    [-0.760117095, -0.641688791, 0.102261901],
    [0.133333038, 1.74e-07, 0.99107129],
    [-0.635959356, 0.76696512, 0.085558183],
]
IRB120 = [("0 0 1", "0 0 0"), ("0 1 0", "0 0 0.29"), ("0 1 0", "0 0 0.27"), ("1 0 0", "0 0 0.07")]
IRB120 += [("0 1 0", "0.302 0 0"), ("1 0 0", "0 0 0")]


def test_a_general_6r_arm_has_sixteen_solutions():
    """Manseur and Doty, 1989: twists of 90° and 1°. The printed rotation is first projected to the nearest one."""
    arm, T = r1.robot_from_dh(MANSEUR_DOTY), np.eye(4)
    T[:3, :3], T[0, 3] = nearest_rotation(ROUNDED).rotation, -1.140175
    found = r1.ik_solutions(arm, r1.PoseTask(), T)
    first = [-178.126, -178.126, -120.788, -120.788, -96.285, -96.285, -12.943, -12.943]
    first += [2.517, 2.517, 88.678, 88.678, 113.844, 113.844, 168.322, 168.322]
    assert np.degrees(found.q[:, 0]).round(3).tolist() == first
    assert np.abs(np.radians([2.517239548, 108.075885621, 112.043147177]) - found.q[9, :3]).max() < 1e-5


def test_a_6r_arm_near_a_wrist_singularity_has_its_eight_solutions():
    """An ABB IRB 120 whose frames are parallel at zero: in two solutions axes 4 and 6 are 0.01° from one line."""
    arm = chain("irb120", *((f"q{i + 1}", TURN, *joint) for i, joint in enumerate(IRB120)), tip="0.072 0 0")
    T = np.eye(4)
    T[:3, 3] = 0.5649, 0, 0.5509
    found = r1.ik_solutions(arm, r1.PoseTask(), T)
    behind = [[-180, -79.22306, -44.98164, 0, -55.7953, -180], [-180, -44.99094, -108.9183, 0, -26.09076, -180]]
    front = [[0, 44.99094, -44.98164, 0, -0.0093, 0], [0, 79.22306, -108.9183, 0, 29.69524, 0]]
    flipped = np.array([0, 0, 0, 180, 0, 180]), np.array([1, 1, 1, 1, -1, 1])
    official = [q for one in (*behind, *front) for q in (one, flipped[0] + flipped[1] * one)]
    are(found.q, np.radians(official), 1e-5)
    assert len(set(found.labels)) == 8
