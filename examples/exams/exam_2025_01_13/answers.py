"""Robotics 1, exam of 13 January 2025, solved with public calls alone."""

from dataclasses import dataclass
from math import cos, pi, radians, sin, sqrt

import numpy as np
import numpy.typing as npt

from robotics1 import (
    LinearMotion,
    PlanarPoseTask,
    PositionTask,
    Robot,
    balancing_torque,
    find_singularities,
    iterate_ik,
    load_robot,
    rendezvous,
    subspaces,
)
from robotics1.control import GainChoice, smallest_gain
from robotics1.ik import IKIteration
from robotics1.singularities import SingularSet, Subspaces
from robotics1.trajectories import MeetingBranch, Rendezvous

POSE, POINT, SPACE = PlanarPoseTask("xy"), PositionTask("xy"), PositionTask("xyz")
FORCE = (3, 1)
GOAL = (1, -1, 3)
P0, SPEED, ANGLE = (-2, 1), 1.5, radians(15)
TARGET = LinearMotion(P0, SPEED * np.array([cos(ANGLE), sin(ANGLE)]))


@dataclass(frozen=True, eq=False)
class Exercise1:
    """The PRR robot: singularities of (p, φ) and of p, and the statics of p in one of them."""

    robot: Robot
    pose: SingularSet
    point: SingularSet
    q_s: npt.NDArray[np.float64]
    spaces: Subspaces
    torque: npt.NDArray[np.floating]


@dataclass(frozen=True, eq=False)
class Exercise2:
    """The cylindrical robot: the iterations from the two starts."""

    robot: Robot
    a: IKIteration
    b: IKIteration
    b_pseudoinverse: IKIteration


@dataclass(frozen=True, eq=False)
class Exercise3:
    """The 2R robot: the rendez-vous, and the gain for a perturbed start."""

    robot: Robot
    meeting: Rendezvous
    right: MeetingBranch
    left: MeetingBranch
    feedback: GainChoice
    too_far: GainChoice


def exercise_1() -> Exercise1:
    """Solve exercise 1 for the lengths in the robot's file."""
    robot = load_robot("prr")
    pose, point = (find_singularities(robot, task, method="symbolic") for task in (POSE, POINT))
    branch = next(branch for branch in point.branches if all(value > 0 for value in branch.values.values()))
    q_s = np.array([0.5, branch.values["q2"], branch.values["q3"]])
    J_s = POINT.jacobian(robot, q_s)
    return Exercise1(robot, pose, point, q_s, subspaces(J_s), balancing_torque(J_s, FORCE))


def exercise_2() -> Exercise2:
    """Solve exercise 2."""
    robot = load_robot("cylindrical")
    q_a, q_b = [-2, 0.7 * pi, sqrt(2)], [2, pi / 4, sqrt(2)]
    a = iterate_ik(robot, SPACE, GOAL, q_a, method="newton", tolerance=1e-4)
    b = iterate_ik(robot, SPACE, GOAL, q_b, method="newton", tolerance=1e-4)
    pseudoinverse = iterate_ik(robot, SPACE, GOAL, q_b, method="pseudoinverse", tolerance=1e-4)
    return Exercise2(robot, a, b, pseudoinverse)


def exercise_3() -> Exercise3:
    """Solve exercise 3; the perturbed starts are ours."""
    robot = load_robot("planar_2r")
    meeting = rendezvous(robot, POINT, TARGET, [0, 0], meet=lambda t, p: p[0])
    right, left = sorted(meeting.branches, key=lambda branch: -branch.q[1])
    near = smallest_gain(right.trajectory, [0.1, -0.1], 1e-3, rate_limits=robot.max_velocity)
    far = smallest_gain(right.trajectory, [-2.0, 2.0], 1e-3, rate_limits=robot.max_velocity)
    return Exercise3(robot, meeting, right, left, near, far)
