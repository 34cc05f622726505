"""What a caller may hand in for a robot, a task, a pose, a rotation and a configuration: all forms give one answer."""

import warnings
from math import pi

import numpy as np
import pinocchio as pin
import pytest
from scipy.spatial.transform import RigidTransform, Rotation

import robotics1 as r1

Q = np.array([0.3, -0.7])
SPATIAL_Q = np.array([0.4, 0.3, -0.5, 0.6, 0.7])


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("robot") / "arm.urdf"
    path.write_text(r1.load_robot("planar_2r").urdf)
    return path


def test_a_name_a_path_a_text_and_a_robot_are_the_same_robot(file, planar_2r):
    p = r1.forward_kinematics(planar_2r, Q).translation
    for given in ("planar_2r", file, str(file), file.read_text(), planar_2r):
        assert r1.forward_kinematics(given, Q).translation == pytest.approx(p, abs=1e-15)


def test_a_file_is_read_again_when_it_changes(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(r1.load_robot("planar_2r", parameters={"l1": 1, "l2": 1}).urdf)
    assert r1.forward_kinematics(path, [0, 0]).translation == pytest.approx([2, 0, 0])
    path.write_text(r1.load_robot("planar_2r", parameters={"l1": 1, "l2": 2.5}).urdf)
    assert r1.forward_kinematics(path, [0, 0]).translation == pytest.approx([3.5, 0, 0])


def test_a_short_form_is_its_task():
    forms = {
        "position": r1.PositionTask(),
        "position:xy": r1.PositionTask("xy"),
        "planar": r1.PlanarPoseTask(),
        "planar-pose:xy": r1.PlanarPoseTask("xy"),
        "orientation": r1.OrientationTask(),
        "pose": r1.PoseTask(),
        "pointing": r1.PointingTask("z"),
        "pointing:-x": r1.PointingTask("-x"),
    }
    for form, task in forms.items():
        assert r1.singularities.manipulability("planar_2r", form, Q).J == pytest.approx(task.jacobian("planar_2r", Q))


def test_all_forms_of_a_pose_are_one_pose():
    rpy = np.array([0.2, -0.4, 1.1])
    turn = Rotation.from_euler("xyz", rpy)
    T = pin.SE3(turn.as_matrix(), np.array([0.3, 0.2, 0.4]))
    p = T.translation
    for form in (
        T,
        T.homogeneous,
        RigidTransform.from_components(p, turn),
        (p, rpy),
        (p.tolist(), rpy.tolist()),
        (p, turn.as_quat()),
        (p, turn),
        (p, T.rotation),
    ):
        assert r1.PoseTask().target(form).homogeneous == pytest.approx(T.homogeneous, abs=1e-15)


def test_all_forms_of_a_rotation_are_one_rotation():
    turn = Rotation.from_rotvec([0.3, -1.2, 0.5])
    for form in (turn, turn.as_matrix(), turn.as_quat(), turn.as_euler("xyz")):
        assert r1.OrientationTask().target(form) == pytest.approx(turn.as_matrix(), abs=1e-15)


def test_a_configuration_is_a_sequence_a_mapping_or_a_posture(planar_2r):
    J = r1.frame_jacobian(planar_2r, Q)
    for form in (Q, list(Q), tuple(Q), {"q2": Q[1], "q1": Q[0]}):
        assert r1.frame_jacobian(planar_2r, form) == pytest.approx(J)
    assert r1.forward_kinematics(planar_2r, "zero").translation == pytest.approx([2, 0, 0])  # l1 + l2 = 1.2 + 0.8


def test_zero_is_moved_inside_the_limits():
    robot = r1.robot_from_dh([("R", 1, 0, 0, 0)], lower=[0.5], upper=[1.0])
    assert robot.configuration("zero") == pytest.approx([0.5])


def test_the_postures_of_an_srdf_beside_the_file_have_names(tmp_path):
    (tmp_path / "urdf").mkdir()
    (tmp_path / "srdf").mkdir()
    path = tmp_path / "urdf/arm_robot.urdf"
    path.write_text(r1.load_robot("planar_2r").urdf)
    (tmp_path / "srdf/arm.srdf").write_text(
        '<robot name="arm"><group_state name="elbow up" group="arm"><joint name="q2" value="-1.5"/></group_state>'
        '<group_state name="broken" group="arm"><joint name="q1" value="left"/></group_state></robot>'
    )
    robot = r1.load_robot(path)
    assert set(robot.postures) == {"zero", "elbow up"}
    assert robot.configuration("elbow up") == pytest.approx([0, -1.5])
    (tmp_path / "srdf/arm.srdf").write_text("no XML")
    assert set(r1.load_robot(path).postures) == {"zero"}


def test_several_configurations_give_several_poses_and_jacobians(spatial):
    several = np.array([SPATIAL_Q, -SPATIAL_Q, 0.1 * SPATIAL_Q])
    T, J = r1.forward_kinematics(spatial, several), r1.frame_jacobian(spatial, several, reference="tool")
    sigma = r1.singularities.sigma_min(spatial, "position", several)
    rows = r1.PositionTask("xz").jacobian(spatial, several)
    assert T.shape == (3, 4, 4)
    assert J.shape == (3, 6, 5)
    assert rows.shape == (3, 2, 5)
    for i, q in enumerate(several):
        assert T[i] == pytest.approx(r1.forward_kinematics(spatial, q).homogeneous)
        assert J[i] == pytest.approx(r1.frame_jacobian(spatial, q, reference="tool"))
        assert rows[i] == pytest.approx(r1.PositionTask("xz").jacobian(spatial, q))
        J_p = r1.PositionTask().jacobian(spatial, q)
        assert sigma[i] == pytest.approx(np.sqrt(np.linalg.eigvalsh(J_p @ J_p.T)[0]), rel=1e-9)
    assert r1.forward_kinematics(spatial, np.zeros((0, 5))).shape == (0, 4, 4)


def test_every_task_takes_several_configurations(spatial):
    several = np.array([SPATIAL_Q, -SPATIAL_Q])
    function = r1.FunctionTask(lambda p, R, q: [p @ p, q[0]], 2)
    for task in (
        r1.PoseTask(),
        function,
        r1.StackedTask(["position:xy", function]),
        r1.PositionTask("z", frame="link3"),
    ):
        every = task.jacobian(spatial, several)
        assert every == pytest.approx(np.array([task.jacobian(spatial, q) for q in several]), abs=1e-12)
    values = r1.PoseTask().value(spatial, several)
    assert values == pytest.approx(np.array([r1.PoseTask().value(spatial, q).homogeneous for q in several]))
    assert r1.PositionTask().value(spatial, several).shape == (2, 3)


@pytest.mark.parametrize(
    "call",
    [
        lambda robot, q: r1.PositionTask().error(robot, q, [1, 1, 1]),
        lambda robot, q: r1.StackedTask(["position:xy", "position:z"]).value(robot, q),
        lambda robot, q: r1.singularities.manipulability(robot, "position", q),
        lambda robot, q: r1.frame_jacobian_rate(robot, q, SPATIAL_Q),
        lambda robot, q: r1.solve_ik(robot, "position", [1, 1, 1], q),
    ],
)
def test_what_is_asked_at_one_configuration_refuses_several(spatial, call):
    with pytest.raises(r1.InputError, match=r"must have shape \(5,\)"):
        call(spatial, np.zeros((2, 5)))


def test_sigma_min_of_a_planar_2r_vanishes_where_it_is_stretched(planar_2r):
    assert r1.singularities.sigma_min(planar_2r, "position:xy", [0.4, 0]) == pytest.approx(0, abs=1e-15)
    least = r1.singularities.sigma_min(planar_2r, "position:xy", [[0.4, 0], [0.4, 1], [0.4, pi]])
    # σ1 σ2 = |det J| = l1 l2 |sin q2|, and σ1² + σ2² = |J|² = |p|² + l2²
    det, norm = 1.2 * 0.8 * np.sin(1), 1.2**2 + 0.8**2 + 2 * 1.2 * 0.8 * np.cos(1) + 0.8**2
    assert least == pytest.approx([0, np.sqrt((norm - np.sqrt(norm**2 - 4 * det**2)) / 2), 0], abs=1e-15)


# --- models of Pinocchio


def test_a_model_of_pinocchio_is_a_robot_with_the_same_poses_and_jacobians():
    model = pin.buildSampleModelManipulator()
    q = np.linspace(0.1, 0.6, 6)
    robot = r1.load_robot((model, pin.buildSampleGeometryModelManipulator(model)), tool="effector_body")
    data = model.createData()
    pin.framesForwardKinematics(model, data, q)
    for name in ("effector_body", "upperarm_body", "elbow_body"):
        wanted = data.oMf[model.getFrameId(name)].homogeneous
        assert r1.forward_kinematics(robot, q, frame=name).homogeneous == pytest.approx(wanted, abs=1e-14)
    J = pin.computeFrameJacobian(model, data, q, model.getFrameId("effector_body"), pin.LOCAL_WORLD_ALIGNED)
    assert r1.frame_jacobian(robot, q) == pytest.approx(J, abs=1e-14)
    assert r1.frame_jacobian(model, q, frame="effector_body") == pytest.approx(J, abs=1e-14)
    assert robot.joint_names == tuple(model.names)[1:]
    assert robot.urdf.count("<visual>") == 3  # the balls; a URDF has no capsules


def test_the_model_of_a_robot_is_that_robot_again(spatial):
    again = r1.load_robot(spatial.model, tool=spatial.tool)
    assert again.joint_names == spatial.joint_names
    assert r1.forward_kinematics(again, SPATIAL_Q).homogeneous == pytest.approx(
        r1.forward_kinematics(spatial, SPATIAL_Q).homogeneous, abs=1e-14
    )
    assert again.lower == pytest.approx(spatial.lower)
    assert again.max_velocity == pytest.approx(spatial.max_velocity)


def test_a_joint_by_cosine_and_sine_has_one_angle_here():
    model = pin.Model()
    model.addJoint(0, pin.JointModelRUBZ(), pin.SE3.Identity(), "turn")
    model.addFrame(pin.Frame("tip", 1, 0, pin.SE3(np.eye(3), np.array([1.0, 0, 0])), pin.FrameType.OP_FRAME))
    robot = r1.load_robot(model)
    assert (robot.tool, robot.nq, robot.upper[0]) == ("tip", 1, np.inf)
    assert r1.forward_kinematics(robot, [pi / 2]).translation == pytest.approx([0, 1, 0])


@pytest.mark.parametrize(
    ("joint", "reason"), [(pin.JointModelSpherical(), "is a JointModelSpherical"), (None, "has no joints")]
)
def test_a_model_with_other_joints_is_refused(joint, reason):
    model = pin.Model()
    if joint is not None:
        model.addJoint(0, joint, pin.SE3.Identity(), "ball")
    with pytest.raises(r1.InputError, match=reason):
        r1.load_robot(model)


MJCF = """<mujoco model="arm"><compiler angle="radian"/><worldbody><body name="link1" pos="0 0 0.3">
<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint name="q1" type="hinge" axis="0 0 1" range="-1 2"
 limited="true"/>
<body name="link2" pos="0.5 0 0"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
<joint name="q2" type="slide" axis="0 1 0"/><site name="tool" pos="0.4 0 0"/></body></body></worldbody></mujoco>"""


def test_mjcf_is_read_where_it_is_trusted(tmp_path):
    path = tmp_path / "arm.xml"
    path.write_text(MJCF)
    robot = r1.load_robot(path, trusted=True)
    assert (robot.name, robot.tool, robot.joint_names) == ("arm", "tool", ("q1", "q2"))
    assert (robot.lower[0], robot.upper[0], robot.upper[1]) == (-1, 2, np.inf)
    p = r1.forward_kinematics(robot, [pi / 2, 0.2]).translation
    assert p == pytest.approx([-0.2, 0.9, 0.3])
    with pytest.raises(r1.InputError, match="trusted=True"):
        r1.load_robot(path)
    in_memory = r1.load_robot(MJCF, trusted=True)
    assert r1.forward_kinematics(in_memory, [pi / 2, 0.2]).translation == pytest.approx(p)


def test_other_formats_are_named():
    with pytest.raises(r1.InputError, match=r"the text is MJCF.*trusted=True"):
        r1.load_robot(MJCF)
    with pytest.raises(r1.RobotFileError, match=r"is SDF.*export the robot as URDF"):
        r1.load_robot("<sdf version='1.9'><model name='arm'/></sdf>")


@pytest.mark.parametrize(
    "text", ["<mujoco/>", "<mujoco><worldbody><body/></worldbody></mujoco>", "<mujoco><worldbody>"]
)
def test_mjcf_that_cannot_be_read_is_an_error_of_the_file(tmp_path, text):
    path = tmp_path / "arm.xml"
    path.write_text(text)
    with pytest.raises(r1.RobotFileError):
        r1.load_robot(path, trusted=True)


# --- warnings


def test_what_is_odd_about_a_joint_is_a_warning_of_python():
    odd = (
        '<robot name="odd"><link name="a"/><link name="b"/><joint name="q" type="revolute"><parent link="a"/>'
        '<child link="b"/><axis xyz="0 0 2"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>'
    )
    with pytest.warns(r1.RobotWarning, match=r"robot 'odd': .*joint 'q' has an axis of length 2"):
        r1.load_robot(odd)


@pytest.mark.parametrize("q", [[0, -np.degrees(1)], np.degrees([0.7, 0.3]), [-np.degrees(2), 0.1]])
def test_computed_degrees_far_outside_the_limits_are_a_warning(q):
    with pytest.warns(r1.RobotWarning, match="angles are in radians; if degrees are meant, write radians"):
        r1.forward_kinematics("planar_2r", q)


@pytest.mark.parametrize(
    "ask",
    [
        lambda: r1.forward_kinematics("planar_2r", [0, 90]),
        lambda: r1.ik_solutions("prr", "planar-pose", [0.5, 0.5, 90]),
        lambda: r1.view("planar_2r", [0, 90]),
    ],
)
def test_a_warning_is_one_and_of_the_line_of_the_user(ask):
    with warnings.catch_warnings(record=True) as given:
        warnings.simplefilter("default")
        ask()
    assert [warning.filename for warning in given] == [__file__]


def test_radians_and_lengths_give_no_warning(cylindrical, recwarn):
    r1.forward_kinematics("planar_2r", [3 * pi, -2.5 * pi])
    r1.forward_kinematics("planar_2r", np.radians([90, 180]))
    r1.forward_kinematics(cylindrical, [12.0, 0.1, 30.0])  # its first and third joints slide
    r1.iterate_ik("planar_2r", "position:xy", [5, 5], [0.3, 0.2], method="newton")  # passes through q2 = -46.8
    r1.forward_kinematics(r1.robot_from_dh([("R", 1, 0, 0, 0)], lower=[-30], upper=[30]), [25])  # inside its limits
    assert not [warning for warning in recwarn if issubclass(warning.category, r1.RobotWarning)]
