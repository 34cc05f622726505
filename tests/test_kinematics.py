import io
import subprocess
import sys
from math import inf, nan, pi

import closed_forms as cf
import numpy as np
import pinocchio as pin
import pytest
from arms import ARMS, ROBOTS, arm, configurations, lengths, random_q
from differences import along, twist
from hypothesis import given, settings, strategies as st

from robotics1 import InputError, UnknownNameError, forward_kinematics, frame_jacobian, frame_jacobian_rate

FRAMES = {"two_tips": "camera"}  # which frame, where there is no tool


def pose(robot, q, frame=None):
    return forward_kinematics(robot, q, frame=frame).homogeneous


# --- hand formulas


@given(configurations(arm("prr")), lengths, lengths)
@settings(max_examples=20)
def test_prr_position_and_jacobian_are_the_exams(q, l2, l3):
    robot = arm("prr", l2=l2, l3=l3)
    assert pose(robot, q)[:2, 3] == pytest.approx(cf.prr_pose(q, l2, l3)[:2], abs=1e-13)
    J = frame_jacobian(robot, q)
    assert J[[0, 1, 5]] == pytest.approx(cf.prr_pose_jacobian(q, l2, l3), abs=1e-13)
    assert J[[2, 3, 4]] == pytest.approx(np.zeros((3, 3)), abs=1e-15)


@given(configurations(arm("cylindrical")))
def test_cylindrical_position_is_q3_c2_q3_s2_q1(q):
    robot = arm("cylindrical")
    assert pose(robot, q)[:3, 3] == pytest.approx(cf.cylindrical_position(q), abs=1e-14)
    J = frame_jacobian(robot, q)
    assert J[:3] == pytest.approx(cf.cylindrical_jacobian(q), abs=1e-14)
    assert J[3:] == pytest.approx(np.outer([0, 0, 1], [0, 1, 0]), abs=1e-15)


@given(configurations(arm("planar_2r")), lengths, lengths)
@settings(max_examples=20)
def test_planar_2r_position_and_jacobian_are_the_textbooks(q, l1, l2):
    robot = arm("planar_2r", l1=l1, l2=l2)
    assert pose(robot, q)[:2, 3] == pytest.approx(cf.planar_position(q, [l1, l2]), abs=1e-13)
    J = frame_jacobian(robot, q)[:2]
    assert pytest.approx(cf.planar_jacobian(q, [l1, l2]), abs=1e-13) == J
    assert np.linalg.det(J) == pytest.approx(cf.two_link_determinant(q, l1, l2), abs=1e-12)


@given(configurations(arm("planar_3r")), st.tuples(lengths, lengths, lengths))
@settings(max_examples=20)
def test_planar_3r_position_and_jacobian_are_the_textbooks(q, l):  # noqa: E741
    robot = arm("planar_3r", l1=l[0], l2=l[1], l3=l[2])
    assert pose(robot, q)[:2, 3] == pytest.approx(cf.planar_position(q, l), abs=1e-13)
    assert frame_jacobian(robot, q)[:2] == pytest.approx(cf.planar_jacobian(q, l), abs=1e-13)


@given(configurations(arm("anthropomorphic")), st.tuples(lengths, lengths, lengths))
@settings(max_examples=20)
def test_anthropomorphic_determinant_is_minus_a2_a3_s3_times_the_shoulder_distance(q, l):  # noqa: E741
    d1, a2, a3 = l
    robot = arm("anthropomorphic", d1=d1, a2=a2, a3=a3)
    assert pose(robot, q)[:3, 3] == pytest.approx(cf.anthropomorphic_position(q, d1, a2, a3), abs=1e-13)
    det = np.linalg.det(frame_jacobian(robot, q)[:3])
    assert det == pytest.approx(cf.anthropomorphic_determinant(q, a2, a3), abs=1e-12)


@given(configurations(arm("spatial")))
def test_spatial_pose_and_jacobian_are_the_chain_of_rodrigues_rotations(q):
    T, J = cf.spatial_pose_and_jacobian(q)
    assert pose(arm("spatial"), q) == pytest.approx(T, abs=1e-14)
    assert frame_jacobian(arm("spatial"), q) == pytest.approx(J, abs=1e-14)


# --- an independent implementation


@pytest.mark.parametrize("name", ARMS)
def test_forward_kinematics_of_every_frame_is_yourdfpys(name):
    from yourdfpy import URDF

    robot = arm(name)
    other = URDF.load(io.StringIO(robot.urdf), load_meshes=False, load_collision_meshes=False)
    for seed in range(5):
        q = random_q(robot, seed)
        other.update_cfg(dict(zip(robot.joint_names, q, strict=True)))
        for frame in robot.frame_names:
            assert pose(robot, q, frame) == pytest.approx(other.get_transform(frame), abs=1e-14)


# --- central differences


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("seed", range(3))
def test_jacobian_is_the_derivative_of_forward_kinematics(name, seed):
    robot, q = arm(name), random_q(arm(name), seed)
    frame = FRAMES.get(name)
    J = frame_jacobian(robot, q, frame=frame)
    assert J.shape == (6, robot.nv)
    assert pytest.approx(twist(lambda x: pose(robot, x, frame), q), abs=1e-9) == J


def test_jacobian_of_another_frame_is_its_derivative(spatial):
    q = random_q(spatial, 7)
    J = frame_jacobian(spatial, q, frame="link3")
    assert pytest.approx(twist(lambda x: pose(spatial, x, "link3"), q), abs=1e-9) == J
    assert not J[:, 3:].any()


# --- laws


@given(configurations(arm("spatial")))
@pytest.mark.parametrize("reference", ["tool", "gripper", "link2", "base"])
def test_reference_turns_both_halves_by_the_transpose_of_its_rotation(reference, q):
    robot = arm("spatial")
    J = frame_jacobian(robot, q)
    R = pose(robot, q, None if reference == "tool" else reference)[:3, :3]
    other = frame_jacobian(robot, q, reference=reference)
    assert other == pytest.approx(np.vstack([R.T @ J[:3], R.T @ J[3:]]), abs=1e-14)


def test_reference_tool_is_pinocchios_local_jacobian(spatial):
    q = random_q(spatial, 3)
    frame = spatial.model.getFrameId("gripper")
    local = pin.computeFrameJacobian(spatial.model, spatial.model.createData(), q, frame, pin.LOCAL)
    assert frame_jacobian(spatial, q, reference="tool") == pytest.approx(local, abs=1e-14)


def test_reference_of_a_frame_jacobian_may_be_another_frame_than_its_own(spatial):
    q = random_q(spatial, 4)
    R = pose(spatial, q, "link4")[:3, :3]
    J = frame_jacobian(spatial, q, frame="link5")
    other = frame_jacobian(spatial, q, frame="link5", reference="link4")
    assert other[:3] == pytest.approx(R.T @ J[:3], abs=1e-14)


def test_one_joint_jacobian_is_one_column_a_cross_p_over_a(one_joint):
    a, q = np.array([0.6, 0, 0.8]), 0.7
    p = cf.rotation(a, q) @ [0.5, 0.1, 0]
    J = frame_jacobian(one_joint, [q])
    assert J.shape == (6, 1)
    assert J[:, 0] == pytest.approx([*np.cross(a, p), *a], abs=1e-15)
    assert frame_jacobian(one_joint, [q], reference="tool").shape == (6, 1)


def test_results_are_copies_and_arguments_are_kept(spatial):
    q = random_q(spatial, 1)
    before = q.copy()
    T, J = forward_kinematics(spatial, q), frame_jacobian(spatial, q)
    T0, J0 = T.homogeneous.copy(), J.copy()
    forward_kinematics(spatial, -0.1 * q)
    frame_jacobian(spatial, -0.1 * q)
    assert np.array_equal(T.homogeneous, T0)
    assert np.array_equal(J, J0)
    assert np.array_equal(q, before)
    J[:] = 0
    assert np.array_equal(frame_jacobian(spatial, q), J0)


@pytest.mark.parametrize("q", [[1, 2, 3], (1, 2, 3), np.array([1, 2, 3]), np.float32([1, 2, 3])])
def test_lists_tuples_and_integers_serve_as_q(prr, q):
    assert pose(prr, q)[:2, 3] == pytest.approx(cf.prr_pose([1, 2, 3], 0.6, 0.4)[:2], abs=1e-14)


# --- misuse


@pytest.mark.parametrize("call", [forward_kinematics, frame_jacobian])
@pytest.mark.parametrize(
    ("q", "message"),
    [
        ([1, 2], r"q must have shape \(3,\).*it has shape \(2,\)"),
        ([1, 2, 3, 4], r"it has shape \(4,\)"),
        ([[1], [2], [3]], r"it has shape \(3, 1\)"),
        (1.0, r"it has shape \(\)"),
        ([], r"it has shape \(0,\)"),
        ([1, nan, 3], "q must be finite"),
        ([1, 2, inf], "q must be finite"),
        (["1", "2", "3"], "array of real numbers"),
        ([1, 2, 3j], "array of real numbers"),
        ([1, None, "x"], "array of real numbers"),
        ([[1], [2, 3], []], "array of real numbers"),
        (None, "q must"),
        ({"q1": 1}, "no value for q2, q3"),
    ],
)
def test_a_q_that_is_no_configuration_is_an_input_error(prr, call, q, message):
    with pytest.raises(InputError, match=message):
        call(prr, q)


@pytest.mark.parametrize("call", [forward_kinematics, frame_jacobian])
@pytest.mark.parametrize("frame", ["tol", "", "Tool", 3, b"tool", ["tool"]])
def test_an_unknown_frame_lists_the_frames(prr, call, frame):
    with pytest.raises(UnknownNameError) as caught:
        call(prr, [1, 2, 3], frame=frame)
    assert caught.value.candidates == ("base", "link1", "link2", "link3", "tool")


@pytest.mark.parametrize("reference", ["tol", "World", 0, None])
def test_an_unknown_reference_is_refused(prr, reference):
    with pytest.raises(UnknownNameError):
        frame_jacobian(prr, [1, 2, 3], reference=reference)


def test_mistakes_that_crash_pinocchio_end_a_child_process_with_a_typed_error():
    """A mistyped frame kills the interpreter inside Pinocchio: a child that lives to print shows it did not."""
    code = f"""
from robotics1 import Robotics1Error, forward_kinematics, frame_jacobian, load_robot
robot = load_robot({str(ROBOTS / "spatial.urdf")!r})
for call in (forward_kinematics, frame_jacobian):
    for q, options in (
        ([0] * 5, dict(frame="grip")), ([0] * 4, {{}}), ([0] * 6, {{}}), ([float("nan")] * 5, {{}}), ([], {{}}),
        ([0] * 5, dict(frame="universe2")), ([0] * 5, dict(frame=10**9)), ([0] * 5, dict(frame=-1)),
    ):
        try:
            call(robot, q, **options)
        except Robotics1Error as error:
            print(type(error).__name__)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert run.returncode == 0, run.stderr
    once = ["UnknownNameError"] + ["InputError"] * 4 + ["UnknownNameError"] * 3
    assert run.stdout.split() == once * 2


@pytest.mark.parametrize("turns", [1, -3])
def test_whole_turns_of_revolute_joints_change_nothing(spatial, turns):
    q = random_q(spatial, 2)
    moved = q + 2 * pi * turns * spatial.revolute
    assert pose(spatial, moved) == pytest.approx(pose(spatial, q), abs=1e-13)


# --- J̇


def rates(robot, seed):
    return np.random.default_rng(seed).normal(size=robot.nv)


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("reference", ["world", "tool", "other"])
def test_jacobian_rate_is_the_derivative_of_the_jacobian_in_any_axes(name, reference):
    robot, frame = arm(name), FRAMES.get(name)
    q, qdot = random_q(robot, 5), rates(robot, 6)
    if reference == "tool" and frame:
        reference = frame
    reference = robot.frame_names[1] if reference == "other" else reference
    rate = frame_jacobian_rate(robot, q, qdot, frame=frame, reference=reference)
    assert rate.shape == (6, robot.nv)
    expected = along(lambda x: frame_jacobian(robot, x, frame=frame, reference=reference), q, qdot)
    assert rate == pytest.approx(expected, abs=1e-9)


@given(configurations(arm("prr")), st.tuples(*[st.floats(-3, 3)] * 3), lengths, lengths)
@settings(max_examples=20)
def test_prr_acceleration_without_joint_accelerations_is_centripetal(q, qdot, l2, l3):
    robot = arm("prr", l2=l2, l3=l3)
    a, b = q[1], q[1] + q[2]
    w2, w3 = qdot[1], qdot[1] + qdot[2]
    drift = frame_jacobian_rate(robot, q, qdot) @ qdot
    expected = [-l2 * np.cos(a) * w2**2 - l3 * np.cos(b) * w3**2, -l2 * np.sin(a) * w2**2 - l3 * np.sin(b) * w3**2]
    assert drift[[0, 1, 5]] == pytest.approx([*expected, 0], abs=1e-10)


@given(configurations(arm("cylindrical")), st.tuples(*[st.floats(-3, 3)] * 3))
def test_cylindrical_drift_has_coriolis_and_centripetal_parts(q, qdot):
    drift = frame_jacobian_rate(arm("cylindrical"), q, qdot) @ qdot
    radial, across = np.array([np.cos(q[1]), np.sin(q[1]), 0]), np.array([-np.sin(q[1]), np.cos(q[1]), 0])
    expected = -q[2] * qdot[1] ** 2 * radial + 2 * qdot[2] * qdot[1] * across
    assert drift[:3] == pytest.approx(expected, abs=1e-10)
    assert drift[3:] == pytest.approx(np.zeros(3), abs=1e-12)


def test_jacobian_rate_is_linear_in_the_joint_velocity(spatial):
    q, a, b = random_q(spatial, 1), rates(spatial, 2), rates(spatial, 3)
    whole = frame_jacobian_rate(spatial, q, 2 * a - b)
    parts = 2 * frame_jacobian_rate(spatial, q, a) - frame_jacobian_rate(spatial, q, b)
    assert whole == pytest.approx(parts, abs=1e-12)


def test_acceleration_of_a_frame_is_pinocchios_classical_acceleration(spatial):
    q, v, a = random_q(spatial, 1), rates(spatial, 2), rates(spatial, 3)
    data = spatial.model.createData()
    pin.forwardKinematics(spatial.model, data, q, v, a)
    number = spatial.frame_id(None)
    pin.updateFramePlacement(spatial.model, data, number)
    other = pin.getFrameClassicalAcceleration(spatial.model, data, number, pin.LOCAL_WORLD_ALIGNED)
    found = frame_jacobian(spatial, q) @ a + frame_jacobian_rate(spatial, q, v) @ v
    assert found == pytest.approx([*other.linear, *other.angular], abs=1e-12)


@pytest.mark.parametrize("qdot", [[1, 2], [1, nan, 3], "abc", 1.0, [[1, 2, 3]]])
def test_joint_velocities_of_the_wrong_shape_are_an_input_error(prr, qdot):
    with pytest.raises(InputError, match="qdot must"):
        frame_jacobian_rate(prr, [1, 2, 3], qdot)


@pytest.mark.parametrize("options", [{"frame": "tol"}, {"reference": "tol"}, {"reference": None}])
def test_jacobian_rate_of_an_unknown_frame_is_refused(prr, options):
    with pytest.raises(UnknownNameError):
        frame_jacobian_rate(prr, [1, 2, 3], [1, 1, 1], **options)
