"""A robot with the angles of its file made exact."""

import xml.etree.ElementTree as ET

import numpy as np

from robotics1.robot.loading import robot_from_text
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.exact import exact_turn


def cleaned(robot: Robot) -> tuple[Robot, float]:
    """Return the robot with the angles that are nearly multiples of π/12 made so, and the largest correction [rad].

    The robot itself is returned when there is nothing to correct.
    """
    root = ET.fromstring(robot.urdf.encode())
    largest = 0.0
    for joint in root.findall("joint"):
        for origin in joint.findall("origin"):
            angles = [float(value) for value in origin.get("rpy", "0 0 0").split()]
            turns = [exact_turn(angle) for angle in angles]
            exact = [angle if k is None else k * np.pi / 12 for angle, k in zip(angles, turns, strict=True)]
            largest = max(largest, float(np.abs(np.subtract(exact, angles)).max()))
            origin.set("rpy", " ".join(repr(float(value)) for value in exact))
    if largest < 1e-12:
        return robot, 0.0
    text = ET.tostring(root, encoding="unicode")
    return robot_from_text(text, path=robot.path.with_suffix(".urdf"), tool=robot.tool), largest
