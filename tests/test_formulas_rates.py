"""The time derivative of a Jacobian in formulas: J̇, and J̇ q̇ of r̈ = J q̈ + J̇ q̇."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm, random_q
from formula_values import number, real, same
from sympy import Matrix, cos, sin

from robotics1 import (
    FunctionTask,
    OrientationTask,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    PositionTask,
    formulas,
    load_robot,
    robot_from_dh,
)

H = pi / 2
q1, q2, q3 = real("q1:4")
w1, w2, w3 = real("qdot1:4")
l1, l2, l3 = real("l1 l2 l3")


def pinocchios_rate(robot, q, qdot):
    """J̇ (6, n) of the tool, world axes."""
    model, data = robot.model, robot.data
    pin.computeJointJacobiansTimeVariation(model, data, q, qdot)
    pin.updateFramePlacement(model, data, robot.frame_id(None))
    return pin.getFrameJacobianTimeVariation(model, data, robot.frame_id(None), pin.LOCAL_WORLD_ALIGNED)


def test_2r_jacobian_rate_has_sums_of_rates_beside_sums_of_angles():
    f = formulas(load_robot("planar_2r"), PositionTask("xy"))
    c12, s12 = cos(q1 + q2), sin(q1 + q2)
    assert f.jacobian_rate == Matrix(
        [
            [-l1 * w1 * cos(q1) - l2 * (w1 + w2) * c12, -l2 * (w1 + w2) * c12],
            [-l1 * w1 * sin(q1) - l2 * (w1 + w2) * s12, -l2 * (w1 + w2) * s12],
        ]
    )
    assert f.velocity_product == Matrix(
        [
            -l1 * w1**2 * cos(q1) - l2 * (w1 + w2) ** 2 * c12,
            -l1 * w1**2 * sin(q1) - l2 * (w1 + w2) ** 2 * s12,
        ]
    )


def test_prr_planar_pose_rate_has_a_row_of_zeros_for_the_angle():
    f = formulas(load_robot("prr"), PlanarPoseTask())
    assert list(f.jacobian_rate.row(2)) == [0, 0, 0]
    assert f.velocity_product[0] == -l2 * w2**2 * cos(q2) - l3 * (w2 + w3) ** 2 * cos(q2 + q3)


def test_cylindrical_velocity_product_is_coriolis_and_centripetal():
    """x = q3 c2: ẍ = ... − 2 q̇2 q̇3 s2 − q3 q̇2² c2."""
    f = formulas(load_robot("cylindrical"), PositionTask())
    wanted = [-2 * w2 * w3 * sin(q2) - q3 * w2**2 * cos(q2), 2 * w2 * w3 * cos(q2) - q3 * w2**2 * sin(q2), 0]
    assert same(f.velocity_product, Matrix(wanted))


def test_angular_velocity_of_parallel_joints_has_the_rate_of_their_sum():
    """ω = z0 q̇1 + (s1, −c1, 0)(q̇2 + q̇3), so J̇ q̇ = (c1, s1, 0) q̇1 (q̇2 + q̇3)."""
    rows = [("R", 0, H, 0, 0), ("R", "l2", 0, 0, 0), ("R", "l3", 0, 0, 0)]
    f = formulas(robot_from_dh(rows, parameters={"l2": 0.5, "l3": 0.4}), OrientationTask())
    assert f.velocity_product == Matrix([w1 * (w2 + w3) * cos(q1), w1 * (w2 + w3) * sin(q1), 0])


def test_2011_02_03_4_velocity_product_of_an_arm_of_which_the_first_joint_turns():
    """Shoulder offset L1, q = (0, π/4, −π/4), q̇ = (w, 0, 0): J̇ q̇ = −(L1 + L2 √2/2 + L3) w² x."""
    names = {"D": 0.5, "L1": 0.1, "L2": 0.4, "L3": 0.3}
    rows = [("R", "L1", H, "D", 0), ("R", "L2", 0, 0, 0), ("R", "L3", 0, 0, 0)]
    f = formulas(robot_from_dh(rows, parameters=names), PositionTask())
    w, L1, L2, L3 = real("w L1 L2 L3")
    at = {q1: 0, q2: sympy.pi / 4, q3: -sympy.pi / 4, w1: w, w2: 0, w3: 0}
    found = f.velocity_product.subs(at)
    assert [sympy.expand(entry) for entry in found] == [sympy.expand(-(L1 + L2 * sympy.sqrt(2) / 2 + L3) * w**2), 0, 0]
    # q̈ that gives an acceleration A along y of the last frame, z of the world: (0, A, 0) there
    A = real("A")
    J = f.jacobian.subs(at)
    qdd = J.LUsolve(Matrix([0, 0, A]) - found)
    numbers = {A: 2, w: 1.5} | {sympy.Symbol(name, real=True): value for name, value in names.items()}
    assert [float(entry.subs(numbers)) for entry in qdd] == pytest.approx([0, -5.431981, 17.219968], abs=1e-6)


@pytest.mark.parametrize("name", ["spatial", "anthropomorphic", "vertical_2r", "redundant", "cylindrical", "one_joint"])
def test_the_rate_of_the_pose_jacobian_is_pinocchios(name):
    robot = arm(name)
    f = formulas(robot, PoseTask())
    q = random_q(robot, 11)
    qdot = np.random.default_rng(12).uniform(-1, 1, robot.nv)
    wanted = pinocchios_rate(robot, q, qdot).reshape(6, robot.nv)
    assert number(f.jacobian_rate, f, q, qdot) == pytest.approx(wanted, abs=1e-9)
    assert number(f.velocity_product, f, q, qdot).ravel() == pytest.approx(wanted @ qdot, abs=1e-9)


def test_the_rate_of_an_analytic_jacobian_is_that_of_its_numbers_along_the_motion():
    rows = [("R", 0, -H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, 0, "d", 0)]
    robot = robot_from_dh(rows, parameters={"d": 0.3})
    f = formulas(robot, OrientationTask(angles="ZYX"))
    q, qdot, h = np.array([0.4, 0.7, -0.9]), np.array([0.3, -0.5, 0.8]), 1e-4
    wanted = (f.task.jacobian(robot, q + h * qdot) - f.task.jacobian(robot, q - h * qdot)) / (2 * h)
    assert number(f.jacobian_rate, f, q, qdot) == pytest.approx(wanted, abs=1e-6)


@pytest.mark.parametrize("task", [PointingTask("x"), PositionTask(), PositionTask("z", reference="link1")])
def test_the_velocity_product_is_the_acceleration_of_a_motion_without_joint_accelerations(task):
    robot = arm("anthropomorphic") if task.reference == "world" else robot_from_dh([("R", 0.3, H, 0, 0)] * 3)
    f = formulas(robot, task)
    q, qdot, h = np.array([0.4, 0.7, -0.9]), np.array([0.3, -0.5, 0.8]), 1e-3

    def rate(t):
        return task.jacobian(robot, q + t * qdot) @ qdot

    wanted = (8 * (rate(h) - rate(-h)) - (rate(2 * h) - rate(-2 * h))) / (12 * h)
    assert number(f.velocity_product, f, q, qdot).ravel() == pytest.approx(wanted, abs=1e-10)


def test_the_rate_of_a_function_of_the_users_own_is_verified_to_1e_9_too():
    """ρ² = l1² + l2² + 2 l1 l2 c2: d²ρ²/dt² = −2 l1 l2 c2 q̇2²."""
    f = formulas(load_robot("planar_2r"), FunctionTask(lambda p, R, q: [p @ p], 1))
    assert same(f.velocity_product, Matrix([-2 * l1 * l2 * cos(q2) * w2**2]))
    polar = formulas(
        load_robot("planar_2r"), FunctionTask(lambda p, R, q: [np.hypot(*p[:2]), np.arctan2(p[1], p[0])], 2)
    )
    rho = sympy.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * cos(q2))
    wanted = sympy.diff(-l1 * l2 * sin(q2) / rho, q2) * w2
    q, qdot = [0.3, 1.1], [0.5, -0.4]
    assert number(polar.jacobian_rate[0, 1], polar, q, qdot) == pytest.approx(number(wanted, polar, q, qdot))
    assert polar.jacobian_rate[1, 0] == 0


def test_velocities_are_q_with_a_dot_in_latex_and_in_the_terminal():
    f = formulas(load_robot("planar_2r"), PositionTask("x"))
    assert sympy.latex(f.qdot[0]) == r"\dot{q}_{1}"
    assert sympy.pretty(f.qdot[1]) == "q̇₂"
    assert f.qdot == (w1, w2)
