"""The constants of a chain, its pose and its Jacobian at one configuration, against Pinocchio."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from arms import ARMS, arm, random_q
from closed_forms import SPATIAL_CHAIN, spatial_pose_and_jacobian
from inner_kernels import from_python
from joint_kinds import KINDS

from robotics1 import InputError, Robotics1Error, forward_kinematics, frame_jacobian, load_robot
from robotics1.kernels import pose
from robotics1.kernels.chain import chain_arrays
from robotics1.robot.joints import tips
from robotics1.robot.sources import example_robots

place = from_python(pose.forward_kinematics, contract=True)
geometric_jacobian = from_python(pose.geometric_jacobian, contract=True)
ONE_FREEDOM = tuple(name for name, (_, nq, nv) in KINDS.items() if nq == nv)


def pose_and_jacobian(chain, q, nv):
    """The pose (3, 4) and the Jacobian (6, nv) of a chain at q, linear rows over angular."""
    T, joint_axes, J = np.empty((3, 4)), np.empty((len(chain.coordinate), 6)), np.empty((6, nv))
    place(chain.links(), q, T, joint_axes)
    geometric_jacobian(chain.links(), T, joint_axes, J)
    return T, J


def largest_difference(robot, frame, q):
    """Of pose and Jacobian, by the kernel and by Pinocchio, over max(reach, 1)."""
    T, J = pose_and_jacobian(chain_arrays(robot, frame), q, robot.nv)
    M = forward_kinematics(robot, q, frame=frame)
    differences = (T[:, :3] - M.rotation, T[:, 3] - M.translation, J - frame_jacobian(robot, q, frame=frame))
    return max(np.abs(difference).max(initial=0.0) for difference in differences) / max(robot.reach, 1.0)


@pytest.mark.parametrize("name", ARMS)
def test_pose_and_jacobian_of_the_kernel_are_pinocchios_at_every_tip(name):
    robot = arm(name)
    for frame in tips(robot.frame_names, robot.joints):
        assert max(largest_difference(robot, frame, random_q(robot, seed)) for seed in range(20)) <= 1e-12


@pytest.mark.parametrize("name", ONE_FREEDOM)
def test_pose_and_jacobian_of_every_kind_of_joint_are_pinocchios(name, tmp_path):
    path = tmp_path / "kinds.urdf"
    path.write_text(KINDS[name][0])
    robot = load_robot(path)
    for frame in tips(robot.frame_names, robot.joints):
        assert max(largest_difference(robot, frame, random_q(robot, seed)) for seed in range(20)) <= 1e-12


@pytest.mark.filterwarnings("ignore::robotics1.RobotWarning")
def test_pose_and_jacobian_of_every_serial_chain_of_example_robot_data_are_pinocchios():
    chains = 0
    for name in example_robots():
        try:
            robot = load_robot(name)
        except Robotics1Error:
            continue
        if robot.nq != robot.nv or robot.nq == 0:
            continue
        for frame in tips(robot.frame_names, robot.joints):
            assert largest_difference(robot, frame, random_q(robot, 1)) <= 1e-12, (name, frame)
            chains += 1
    assert chains > 100


def test_the_chain_of_the_spatial_arm_has_the_pose_and_jacobian_of_the_product_of_matrices():
    robot = arm("spatial")
    q = random_q(robot, 3)
    T, J = pose_and_jacobian(chain_arrays(robot), q, robot.nv)
    expected_T, expected_J = spatial_pose_and_jacobian(q)
    assert np.vstack([T, [0, 0, 0, 1]]) == pytest.approx(expected_T, abs=1e-12)
    assert pytest.approx(expected_J, abs=1e-12) == J
    assert len(chain_arrays(robot).coordinate) == len(SPATIAL_CHAIN)


def test_the_columns_of_joints_that_share_a_coordinate_add_up(tmp_path):
    # b follows a with q_b = −0.5 q_a + 0.3, about parallel axes z of the plane: ω = (1 − 0.5) q̇
    path = tmp_path / "follower.urdf"
    path.write_text(
        '<robot name="follower"><link name="base"/><link name="a"/><link name="b"/><link name="tool"/>'
        '<joint name="a" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>'
        '<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>'
        '<joint name="b" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1.2 0 0"/><axis xyz="0 0 1"/>'
        '<limit lower="-3" upper="3" velocity="1" effort="1"/><mimic joint="a" multiplier="-0.5" offset="0.3"/></joint>'
        '<joint name="t" type="fixed"><parent link="b"/><child link="tool"/><origin xyz="0.8 0 0"/></joint></robot>'
    )
    a = 0.7
    T, J = pose_and_jacobian(chain_arrays(load_robot(path)), np.array([a]), 1)
    phi = 0.5 * a + 0.3
    assert T[:2, 3] == pytest.approx([1.2 * np.cos(a) + 0.8 * np.cos(phi), 1.2 * np.sin(a) + 0.8 * np.sin(phi)])
    assert J[:, 0] == pytest.approx(
        [-1.2 * np.sin(a) - 0.4 * np.sin(phi), 1.2 * np.cos(a) + 0.4 * np.cos(phi), 0, 0, 0, 0.5]
    )


@pytest.mark.parametrize("name", ["prr", "spatial", "cylindrical"])
@pytest.mark.parametrize("unit", [0.25, 4.0])
def test_in_another_unit_of_length_lengths_of_q_p_and_v_are_divided_by_it(name, unit):
    robot, q = arm(name), random_q(arm(name), 5)
    T, J = pose_and_jacobian(chain_arrays(robot), q, robot.nv)
    coordinates = np.where(robot.revolute, 1.0, unit)
    scaled_T, scaled_J = pose_and_jacobian(chain_arrays(robot, unit=unit), q / coordinates, robot.nv)
    assert scaled_T[:, :3] == pytest.approx(T[:, :3], abs=1e-15)
    assert scaled_T[:, 3] == pytest.approx(T[:, 3] / unit, abs=1e-14)
    rows = np.repeat([1 / unit, 1.0], 3)[:, None]
    assert scaled_J == pytest.approx(rows * J * coordinates, abs=1e-14)


def test_a_prismatic_follower_of_a_turning_joint_moves_by_its_multiplier_in_any_unit(tmp_path):
    path = tmp_path / "kinds.urdf"
    path.write_text(KINDS["prismatic follower"][0])
    robot, q, unit = load_robot(path), np.array([0.4]), 0.5
    T, J = pose_and_jacobian(chain_arrays(robot, unit=unit), q, 1)
    M = forward_kinematics(robot, q)
    assert T[:, 3] * unit == pytest.approx(M.translation, abs=1e-14)
    assert J[:3] * unit == pytest.approx(frame_jacobian(robot, q)[:3], abs=1e-14)


def test_in_other_axes_pose_and_velocity_are_those_of_the_axes():
    robot, q = arm("spatial"), random_q(arm("spatial"), 6)
    R = pin.exp3(np.array([0.3, -1.0, 0.5]))
    T, J = pose_and_jacobian(chain_arrays(robot, axes=R), q, robot.nv)
    M = forward_kinematics(robot, q)
    assert T[:, :3] == pytest.approx(R.T @ M.rotation, abs=1e-14)
    assert T[:, 3] == pytest.approx(R.T @ M.translation, abs=1e-14)
    world = frame_jacobian(robot, q)
    assert pytest.approx(np.vstack([R.T @ world[:3], R.T @ world[3:]]), abs=1e-14) == J


def test_a_joint_with_several_degrees_of_freedom_is_refused_by_name(tmp_path):
    path = tmp_path / "kinds.urdf"
    path.write_text(KINDS["planar"][0])
    with pytest.raises(InputError, match="only arms of revolute and prismatic joints have kernels"):
        chain_arrays(load_robot(path))


WITHOUT_NUMBA = """
import json, sys
sys.modules["numba"] = None
import numpy as np
from robotics1 import IKSolver, PoseTask, load_robot
from robotics1.kernels import pose
from robotics1.kernels.chain import chain_arrays
from robotics1.kernels.compilation import COMPILED
from test_kernels_chain import pose_and_jacobian
robot, q, q0 = load_robot("ur5", tool="tool0"), np.array(json.loads(sys.argv[1])), np.array(json.loads(sys.argv[2]))
T, J = pose_and_jacobian(chain_arrays(robot), q, robot.nv)
answer = IKSolver(robot, PoseTask())(np.vstack([T, [0, 0, 0, 1]]), q0)
print(json.dumps([COMPILED, T.tolist(), J.tolist(), answer.q.tolist(), answer.status.name]))
"""


def test_without_numba_the_same_functions_answer_as_python():
    robot = load_robot("ur5", tool="tool0")
    q, q0 = [0.3, -1.1, 1.4, 0.2, 0.8, -0.5], [0.1, -0.8, 1.0, 0.4, 1.0, -0.2]
    program = [sys.executable, "-c", WITHOUT_NUMBA, json.dumps(q), json.dumps(q0)]
    here = Path(__file__).parent
    run = subprocess.run(program, check=True, capture_output=True, text=True, timeout=300, cwd=here)
    compiled, T, J, found, status = json.loads(run.stdout)
    assert not compiled
    M = forward_kinematics(robot, q)
    assert np.array(T)[:, 3] == pytest.approx(M.translation, abs=1e-12)
    assert np.array(T)[:, :3] == pytest.approx(M.rotation, abs=1e-12)
    assert np.array(J) == pytest.approx(frame_jacobian(robot, q), abs=1e-12)
    assert status == "CONVERGED"
    reached = forward_kinematics(robot, found)
    assert np.linalg.norm(reached.translation - M.translation) <= 1e-6
    assert np.linalg.norm(pin.log3(M.rotation @ reached.rotation.T)) <= 1e-6
    assert robot.within_limits(found, 0.0)


def test_importing_the_package_does_not_import_numba():
    program = "import sys, robotics1; robotics1.load_robot('prr'); print('numba' in sys.modules)"
    run = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True, timeout=120)
    assert run.stdout.strip() == "False"
