"""The robots of the tests, each loaded once, and configurations of them."""

from functools import cache
from pathlib import Path

import numpy as np
from hypothesis import strategies as st

from robotics1 import load_robot

ROBOTS = Path(__file__).parent / "robots"
NAMED = ("prr", "cylindrical", "planar_2r")
ARMS = (*NAMED, *sorted(path.name.split(".")[0] for path in ROBOTS.glob("*.urdf*")))


@cache
def arm(name, **parameters):
    """A named robot, or the one of tests/robots, with named lengths."""
    source = name if name in NAMED else next(ROBOTS.glob(f"{name}.urdf*"))
    return load_robot(source, parameters=parameters or None)


def one_joint_file(folder, parameter, reach):
    """The xacro file of one joint q1 with a tool at (reach, 0, 0), a term in one named length."""
    path = folder / "one_joint.urdf.xacro"
    path.write_text(
        f"""<robot name="one_joint" xmlns:xacro="http://www.ros.org/wiki/xacro">
        <xacro:arg name="{parameter}" default="0.5"/><xacro:property name="{parameter}" value="$(arg {parameter})"/>
        <link name="base"/><link name="a"/><link name="tool"/>
        <joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
        <limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="tip" type="fixed"><origin xyz="${{{reach}}} 0 0"/><parent link="a"/><child link="tool"/></joint>
        </robot>""",
        encoding="utf-8",
    )
    return path


def span(robot):
    """Lower and upper ends of the values to try: the limits, at most ±π."""
    return np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)


def random_q(robot, seed):
    return np.random.default_rng(seed).uniform(*span(robot))


def configurations(robot):
    """A strategy of configurations inside the limits; it shrinks to zeros."""
    return st.tuples(*[st.floats(float(a), float(b)) for a, b in zip(*span(robot), strict=True)]).map(np.array)


lengths = st.floats(0.05, 3.0)
