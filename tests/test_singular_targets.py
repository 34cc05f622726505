"""The count of solutions is right at singular targets: beside counts by the textbook's geometry, which imports nothing
of ours.
"""

from math import hypot, pi

import numpy as np
import pytest
from sweeps import core_first
from test_all_solutions import ANTHROPOMORPHIC, POSE, PUMA, UR5, XYZ, robot_of

from robotics1.ik import IKStatus, SolutionSolver

ROUNDED = 1e-9


def count_of_angles(cosine):
    """How many angles of a turn have a cosine: none, one (0 or π), or two."""
    excess = abs(cosine) - 1
    return 0 if excess > ROUNDED else 1 if excess > -ROUNDED else 2


def count_of_elbows(a, b, distance):
    """How many ways two links span a distance."""
    return count_of_angles((distance**2 - a**2 - b**2) / (2 * a * b))


def ur_counts(T):
    """Of a UR5 (Hawkins, 2013): how many solutions stand alone, and whether there are families."""
    d1, d4, d5, d6 = UR5[0][3], UR5[3][3], UR5[4][3], UR5[5][3]
    a2, a3 = abs(UR5[1][1]), abs(UR5[2][1])
    R, p = T[:3, :3], T[:3, 3]
    w = p - d6 * R[:, 2]  # the origin of frame 5
    r, alone, families = hypot(w[0], w[1]), 0, False
    shoulders = {1: [0.0], 2: [1.0, -1.0]}.get(count_of_angles(d4 / r), [])
    for side in shoulders:
        q1 = np.arctan2(w[1], w[0]) + pi / 2 + side * np.arccos(min(d4 / r, 1.0))
        y1 = np.array([np.sin(q1), -np.cos(q1), 0.0])  # the axes of joints 2, 3 and 4
        c5 = R[:, 2] @ y1
        if count_of_angles(c5) == 1:
            families = True
            continue
        z5 = np.cross(y1, R[:, 2]) / np.sqrt(1 - c5**2)  # along joint 5, up to its sign: the wrist flips
        for flip in (1.0, -1.0):
            c4 = w - d4 * y1 + flip * d5 * z5 - [0, 0, d1]  # where joint 4 is
            alone += count_of_elbows(a2, a3, float(np.linalg.norm(c4)))
    return alone, families


def puma_arms(T):
    """How many ways the first three joints of a Puma bring the centre of the wrist to its place."""
    w = T[:3, 3] - PUMA[5][3] * T[:3, 2]
    d, a, b = PUMA[2][3], PUMA[1][1], hypot(PUMA[2][1], PUMA[3][3])
    r = hypot(w[0], w[1])
    return count_of_angles(d / r) * count_of_elbows(a, b, hypot(np.sqrt(max(r**2 - d**2, 0.0)), w[2]))


@pytest.mark.parametrize("seed", core_first(range(5), [0], 1))
@pytest.mark.parametrize("kind", ["elbow", "shoulder", "wrist"])
def test_a_ur5_has_as_many_solutions_as_the_geometry_says_at_singular_targets(kind, seed):
    robot, rng = robot_of(UR5), np.random.default_rng(seed)
    solver = SolutionSolver(robot, POSE)
    for _ in range(8):
        q = rng.uniform(-pi, pi, 6)
        if kind == "shoulder":  # the origin of frame 5 lies above or below the first axis, at the distance d4 from it
            a2, a3, d5 = UR5[1][1], UR5[2][1], UR5[4][3]
            height = rng.uniform(-0.4, 0.4)
            q[2] = 2 * np.arctan(height)  # any elbow; q2 then turns the chain until its reach along x vanishes
            tip = a3 * np.exp(1j * q[2]) + d5 * np.exp(1j * (q[2] + q[3] - pi / 2)) + a2
            q[1] = pi / 2 - np.angle(tip)
        else:
            q[4 if kind == "wrist" else 2] = rng.choice([0.0, pi])
        target = POSE.value(robot, q)
        alone, families = ur_counts(target.homogeneous)
        found = solver(target)
        assert families == (kind == "wrist")
        assert found.status is (IKStatus.INFINITE if families else IKStatus.BOUNDARY)
        assert len(found) - found.singular.sum() * families == alone


@pytest.mark.parametrize("seed", core_first(range(5), [0], 1))
@pytest.mark.parametrize("kind", ["elbow", "shoulder", "wrist"])
def test_a_puma_has_as_many_solutions_as_the_geometry_says_at_singular_targets(kind, seed):
    robot, rng = robot_of(PUMA), np.random.default_rng(seed)
    solver = SolutionSolver(robot, POSE)
    bend = np.arctan2(PUMA[2][1], PUMA[3][3])  # of the forearm, by its offset
    for _ in range(8):
        q = rng.uniform(-pi, pi, 6)
        if kind == "elbow":
            q[2] = rng.choice([pi / 2, -pi / 2]) + bend
        elif kind == "shoulder":  # the centre of the wrist is above or below the shoulder
            forearm = PUMA[2][1] * np.exp(1j * q[2]) + PUMA[3][3] * np.exp(1j * (q[2] + pi / 2))
            q[1] = pi / 2 - np.angle(PUMA[1][1] + forearm)
        else:
            q[4] = rng.choice([0.0, pi])
        target = POSE.value(robot, q)
        found = solver(target)
        arms = puma_arms(target.homogeneous)
        if kind == "wrist":
            assert found.status is IKStatus.INFINITE
            assert len(found) - found.singular.sum() == 2 * (arms - 1)
        else:
            assert found.status is IKStatus.BOUNDARY
            assert len(found) == 2 * arms


@pytest.mark.parametrize("kind", ["stretched", "folded", "on the first axis"])
def test_an_anthropomorphic_arm_has_as_many_solutions_as_the_geometry_says_at_singular_targets(kind):
    robot, rng = robot_of(ANTHROPOMORPHIC), np.random.default_rng(3)
    solver, a, b = SolutionSolver(robot, XYZ), ANTHROPOMORPHIC[1][1], ANTHROPOMORPHIC[2][1]
    for _ in range(20):
        q = rng.uniform(-pi, pi, 3)
        if kind == "on the first axis":
            q[1] = pi / 2 - np.angle(a + b * np.exp(1j * q[2]))
        else:
            q[2] = 0.0 if kind == "stretched" else pi
        target = XYZ.value(robot, q)
        found = solver(target)
        if kind == "on the first axis":
            assert found.status is IKStatus.INFINITE
            assert found.singular.all()
        else:
            elbows = count_of_elbows(a, b, float(np.linalg.norm(target - [0, 0, 0.4])))
            assert found.status is IKStatus.BOUNDARY
            assert len(found) == 2 * elbows == 2
