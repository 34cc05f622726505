from math import nan, pi

import closed_forms as cf
import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q
from differences import derivative
from hypothesis import given, strategies as st

from robotics1 import InputError, PositionTask, balancing_torque, forward_kinematics, frame_jacobian, subspaces
from robotics1.singularities import exerting_torque

force = st.floats(-100, 100)
length = st.floats(0.05, 3)


@pytest.mark.parametrize(("l2", "l3"), [(0.6, 0.4), (0.4, 0.6), (0.5, 0.5), (1.3, 0.2)])
def test_prr_torque_that_balances_3_1_is_minus_3_and_3_l2_minus_l3_and_minus_3_l3(l2, l3):
    J = PositionTask("xy").jacobian(arm("prr", l2=l2, l3=l3), [0.5, pi / 2, pi])
    assert pytest.approx(cf.prr_Js_transposed(l2, l3), abs=1e-15) == J.T
    assert balancing_torque(J, [3, 1]) == pytest.approx([-3, 3 * (l2 - l3), -3 * l3], abs=1e-14)


@given(fx=force, fy=force, l2=length, l3=length)
def test_prr_torque_at_q_s_is_the_same_for_every_fy(fx, fy, l2, l3):
    J = cf.prr_Js_transposed(l2, l3).T
    assert balancing_torque(J, [fx, fy]) == pytest.approx(cf.prr_balancing_torque(fx, l2, l3), abs=1e-12)


def test_forces_along_the_left_null_space_need_no_torque(prr):
    J = PositionTask("xy").jacobian(prr, [0.5, pi / 2, pi])
    free = subspaces(J).left_null
    assert np.abs(free[:, 0]) == pytest.approx([0, 1], abs=1e-15)
    assert balancing_torque(J, 1e3 * free[:, 0]) == pytest.approx(np.zeros(3), abs=1e-12)


@pytest.mark.parametrize("name", ["spatial", "redundant", "one_joint", "cylindrical", "continuous"])
@pytest.mark.parametrize("seed", range(3))
def test_power_of_the_joints_is_the_power_at_the_tool(name, seed):
    robot, rng = arm(name), np.random.default_rng(seed)
    q, qdot, f = random_q(robot, seed), rng.standard_normal(robot.nv), rng.standard_normal(6)
    J = frame_jacobian(robot, q)
    assert exerting_torque(J, f) @ qdot == pytest.approx(f @ (J @ qdot), rel=1e-12)
    assert balancing_torque(J, f) @ qdot == pytest.approx(-f @ (J @ qdot), rel=1e-12)


def test_exerted_force_that_is_the_gradient_of_a_potential_gives_its_joint_gradient(spatial):
    """U = ½ |p|² at the tool: ∂U/∂q = Jᵀ p."""
    q = random_q(spatial, 4)
    p = forward_kinematics(spatial, q).translation
    J = frame_jacobian(spatial, q)[:3]
    gradient = derivative(lambda x: [forward_kinematics(spatial, x).translation @ p], q)[0]
    assert exerting_torque(J, p) == pytest.approx(gradient, abs=1e-9)


def test_balancing_torque_holds_the_weight_that_pinocchio_computes():
    """A mass m at the tool pulls with f = (0, 0, −m g): τ + Jᵀ f = 0, and τ is Pinocchio's gravity torque."""
    robot, mass = arm("anthropomorphic"), 2.5
    q = np.array([0.4, 0.6, -1.1])
    model = robot.model.copy()
    model.inertias[3] = pin.Inertia(
        mass, model.frames[model.getFrameId("tool")].placement.translation, np.zeros((3, 3))
    )
    gravity = pin.computeGeneralizedGravity(model, model.createData(), q)
    J = PositionTask("xyz").jacobian(robot, q)
    assert balancing_torque(J, [0, 0, -9.81 * mass]) == pytest.approx(gravity, abs=1e-12)
    a2, a3 = 0.5, 0.35
    tip = a3 * np.cos(q[1] + q[2])
    assert gravity == pytest.approx(9.81 * mass * np.array([0, a2 * np.cos(q[1]) + tip, tip]), abs=1e-12)


@pytest.mark.parametrize("call", [balancing_torque, exerting_torque])
@pytest.mark.parametrize(
    ("J", "f"), [(np.eye(2), [1, 2, 3]), (np.eye(2), 1.0), (np.eye(2), [nan, 0]), ([1, 2], [1, 2]), (np.eye(2), "ab")]
)
def test_wrong_shapes_are_input_errors(call, J, f):
    with pytest.raises(InputError):
        call(J, f)
