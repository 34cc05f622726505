"""Formulas printed: as a Python function that runs, for LaTeX, for the terminal and for pages; and the command."""

from math import pi

import numpy as np
import pytest
from arms import arm, random_q
from command import answer, run as run_command

from robotics1 import (
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    formulas,
    frame_jacobian,
    load_robot,
    robot_from_dh,
)

H = pi / 2


def run(source, name="jacobian"):
    """The function of a source, in a namespace of its own."""
    space = {}
    exec(compile(source, "formulas.py", "exec"), space)
    return space[name]


def test_the_python_function_of_a_prr_is_what_a_person_would_write():
    assert formulas(load_robot("prr"), PlanarPoseTask()).python() == (
        '''import numpy as np


def jacobian(q, *, l2=0.6, l3=0.4):
    """J(q) of prr, joints q1, q2, q3; rows x, y, φ"""
    q1, q2, q3 = q
    t0 = q2 + q3
    t1 = l3*np.sin(t0)
    t2 = l3*np.cos(t0)
    return np.array(
        [
            [1, -l2*np.sin(q2) - t1, -t1],
            [0, l2*np.cos(q2) + t2, t2],
            [0, 1, 1],
        ],
        dtype=float,
    )
'''
    )


@pytest.mark.parametrize("name", ["spatial", "six_r", "redundant", "one_joint", "cylindrical", "anthropomorphic"])
def test_the_python_function_is_pinocchios_jacobian(name):
    robot = arm(name)
    q = random_q(robot, 13)
    J = run(formulas(robot, PoseTask()).python())(q)
    assert J.shape == (6, robot.nv)
    assert pytest.approx(frame_jacobian(robot, q), abs=1e-9) == J


def test_its_parameters_are_keywords_with_the_values_of_the_robot():
    jacobian = run(formulas(load_robot("planar_2r"), PositionTask("xy")).python())
    other = load_robot("planar_2r", parameters={"l1": 0.3, "l2": 0.9})
    q = [0.4, -1.1]
    assert jacobian(q) == pytest.approx(PositionTask("xy").jacobian(load_robot("planar_2r"), q), abs=1e-12)
    assert jacobian(q, l1=0.3, l2=0.9) == pytest.approx(PositionTask("xy").jacobian(other, q), abs=1e-12)
    with pytest.raises(TypeError):
        jacobian(q, 0.3)


def test_a_name_without_a_value_must_be_given():
    source = formulas(load_robot("planar_2r"), PositionTask("xy"), point=(0, "d", 0)).python()
    assert "def jacobian(q, *, d, l1=1.2, l2=0.8):" in source
    with pytest.raises(TypeError, match="'d'"):
        run(source)([0, 0])
    assert run(source)([0, 0], d=0.5)[0] == pytest.approx([-0.5, -0.5])


def test_value_determinant_and_rates_are_functions_too():
    robot = load_robot("planar_2r")
    task = PositionTask("xy")
    f = formulas(robot, task)
    q, qdot = [0.4, -1.1], [0.7, 0.2]
    assert run(f.python("value"), "value")(q) == pytest.approx(task.value(robot, q))
    assert run(f.python("determinant"), "determinant")(q) == pytest.approx(1.2 * 0.8 * np.sin(-1.1))
    rate = run(f.python("jacobian_rate"), "jacobian_rate")(q, qdot)
    product = run(f.python("velocity_product"), "velocity_product")(q, qdot)
    assert rate.shape == (2, 2)
    assert product == pytest.approx(rate @ qdot)
    h = 1e-6
    ahead, back = (task.jacobian(robot, np.array(q) + s * h * np.array(qdot)) for s in (1, -1))
    assert rate == pytest.approx((ahead - back) / (2 * h), abs=1e-8)
    with pytest.raises(InputError, match="name must be one of 'value', 'jacobian'"):
        f.python("torque")


def test_the_function_of_a_pose_gives_its_matrix_and_of_euler_angles_a_vector():
    robot = robot_from_dh([("R", 0, -H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, 0, 0, 0)])
    q = [0.3, 0.8, -0.5]
    pose = PoseTask()
    assert run(formulas(robot, pose).python("value"), "value")(q) == pytest.approx(pose.value(robot, q).homogeneous)
    angles = OrientationTask(angles="ZYX")
    assert run(formulas(robot, angles).python("value"), "value")(q) == pytest.approx(angles.value(robot, q))


def test_the_command_prints_the_python_function():
    printed = run_command("jacobian", "planar_2r", "--task", "position:xy", "--symbolic", "--python")
    assert printed.code == 0
    assert printed.stdout == formulas(load_robot("planar_2r"), PositionTask("xy")).python()
    found = answer("jacobian", "planar_2r", "--task", "planar-pose", "--python", "-p", "l1=0.5")
    q = [0.2, 0.3]
    robot = load_robot("planar_2r", parameters={"l1": 0.5})
    assert run(found["python"])(q) == pytest.approx(PlanarPoseTask().jacobian(robot, q), abs=1e-12)


def test_the_command_chooses_between_latex_and_python():
    refusal = run_command("jacobian", "planar_2r", "--latex", "--python").refusal
    assert "choose one of --latex and --python" in refusal


def test_the_command_says_numbers_as_before():
    text = run_command("jacobian", "prr", "--task", "position:xy", "--q", "0.5,pi/2,pi").stdout
    assert "rank 1" in text
    assert "forces along it need no torque" in text
