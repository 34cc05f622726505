"""Descriptions in the manner of the makers' (descriptions/src): words, included arguments, packages, YAML."""

from math import pi, radians
from pathlib import Path

import pytest

from robotics1 import InputError, RobotFileError, UnknownNameError, forward_kinematics, load_robot

SRC = Path(__file__).parent / "descriptions" / "src"
UR = SRC / "Universal_Robots_ROS2_Description" / "urdf" / "ur.urdf.xacro"
FR3 = SRC / "franka_description" / "robots" / "fr3" / "fr3.urdf.xacro"
GEN3 = SRC / "ros2_kortex" / "kortex_description" / "robots" / "gen3.xacro"
XARM = SRC / "xarm_ros2" / "xarm_description" / "urdf" / "xarm_device.urdf.xacro"
M1013 = SRC / "doosan-robot2" / "dsr_description2" / "xacro" / "m1013.urdf.xacro"
XSARMS = SRC / "interbotix_ros_manipulators" / "interbotix_ros_xsarms"
VX300S = XSARMS / "interbotix_xsarm_descriptions" / "urdf" / "vx300s.urdf.xacro"
SUPPORT = {
    "fanuc": "fanuc/fanuc_m10ia_support/urdf/m10ia.xacro",
    "abb": "abb/abb_irb2400_support/urdf/irb2400.xacro",
    "kuka": "kuka_experimental/kuka_kr10_support/urdf/kr10r1100sixx.xacro",
}


@pytest.mark.parametrize(("word", "d", "a"), [("ur5e", 0.16, 0.42), ("ur10e", 0.18, 0.61)])
def test_the_type_of_a_universal_robot_chooses_its_lengths(word, d, a):
    robot = load_robot(UR, parameters={"ur_type": word})
    assert robot.joint_names == ("shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint")
    p = forward_kinematics(robot, [0, 0, 0]).translation
    assert p == pytest.approx([-a + (a - 0.03), 0, d], abs=1e-9)
    assert robot.upper == pytest.approx([2 * pi, 2 * pi, pi])
    assert robot.lower == pytest.approx([-2 * pi, -2 * pi, -pi])
    assert robot.max_velocity == pytest.approx([pi] * 3)
    assert dict(robot.parameters) == {"safety_pos_margin": 0.15}


def test_the_name_of_a_universal_robot_is_an_argument():
    assert load_robot(UR, parameters={"ur_type": "ur5e"}).name == "ur"
    assert load_robot(UR, parameters={"ur_type": "ur5e", "name": "left_arm"}).name == "left_arm"


def test_a_prefix_is_in_every_name_of_a_universal_robot():
    robot = load_robot(UR, parameters={"ur_type": "ur5e", "tf_prefix": "left_"}, tool="left_tool0")
    assert all(name.startswith("left_") for name in (*robot.joint_names, *robot.frame_names[1:]))


@pytest.mark.parametrize("on", [True, "true", "True"])
def test_a_truth_value_is_a_word(on):
    free, safe = (load_robot(UR, parameters={"ur_type": "ur5e", "safety_limits": limits}) for limits in (False, on))
    assert free.upper - safe.upper == pytest.approx([0.15] * 3)


def test_a_universal_robot_of_no_type_is_refused_by_the_file_that_is_missing():
    with pytest.raises(RobotFileError, match=r"No such file: .*config/none/kinematics\.yaml"):
        load_robot(UR)


def test_words_stay_when_lengths_change():
    robot = load_robot(UR, parameters={"ur_type": "ur10e", "tf_prefix": "left_", "safety_limits": True})
    other = robot.with_parameters({"safety_pos_margin": 0.25})
    assert other.joint_names == robot.joint_names
    assert robot.upper - other.upper == pytest.approx([0.1] * 3)
    assert dict(other.parameters) == {"safety_pos_margin": 0.25}


def test_franka_with_and_without_its_hand():
    with_hand = load_robot(FR3, tool="fr3_hand_tcp")
    assert dict(with_hand.parameters) == {"safety_distance": 0.03}
    bare = load_robot(FR3, parameters={"hand": False})
    assert (bare.tool, dict(bare.parameters)) == ("fr3_link2", {})
    assert (bare.lower.tolist(), bare.upper.tolist()) == ([-2.7, -1.7], [2.7, 1.7])


def test_an_argument_of_an_included_file_is_set_like_any_other():
    z = [
        forward_kinematics(
            load_robot(FR3, parameters=given, tool="fr3_hand_tcp"), [0, 0], frame="fr3_hand_tcp"
        ).translation
        for given in ({}, {"tcp_xyz": "0 0 0.4"})
    ]
    assert z[1] - z[0] == pytest.approx([0, 0.3, 0], abs=1e-9)  # link 2 is turned: its z axis is the world's y


def test_an_unknown_argument_lists_those_of_included_files_too():
    with pytest.raises(UnknownNameError, match="'tcp_xyz'") as caught:
        load_robot(FR3, parameters={"tcp_xzy": "0 0 0"})
    assert set(caught.value.candidates) >= {"hand", "ee_id", "arm_prefix", "robot_ip", "tcp_xyz", "safety_distance"}


@pytest.mark.parametrize("dof", [6, 7, "6", 7.0])
def test_the_number_of_kinovas_joints_chooses_its_file(dof):
    assert load_robot(GEN3, parameters={"dof": dof}).nq == float(dof)


def test_kinova_with_camera_and_gripper():
    robot = load_robot(GEN3, parameters={"dof": 6, "vision": True, "gripper": "robotiq_2f_85", "prefix": "l_"})
    assert {"l_camera_link", "l_robotiq_2f_85_tip"} <= set(robot.frame_names)


def test_the_number_of_xarms_joints_is_in_its_name():
    assert [load_robot(XARM, parameters={"dof": n}, packages=[SRC]).name for n in (5, 7)] == ["xarm5", "xarm7"]
    robot = load_robot(XARM, parameters={"limited": True, "prefix": "L_", "dof": 6})
    assert (robot.joint_names[0], robot.upper[0]) == ("L_joint1", pi)


def test_a_number_is_not_given_as_a_word():
    with pytest.raises(InputError, match="parameter 'dof' must be a finite number, not 'seven'"):
        load_robot(XARM, parameters={"dof": "seven"})


@pytest.mark.parametrize("colour", ["white", "blue"])
def test_the_colour_of_a_doosan_chooses_its_file(colour):
    robot = load_robot(M1013, parameters={"color": colour})
    assert f"dsr_{colour}" in robot.urdf
    assert robot.upper[1] == pytest.approx(radians(95))


def test_interbotix_names_its_links_after_the_robot():
    robot = load_robot(VX300S, parameters={"robot_name": "left", "use_world_frame": True})
    assert robot.frame_names[:2] == ("world", "left/base_link")
    assert load_robot(VX300S, parameters={"show_gripper_fingers": False}).nq == 1


@pytest.mark.parametrize("maker", SUPPORT)
def test_industrial_robots_take_packages_beside_their_own(maker, monkeypatch):
    monkeypatch.chdir(SRC.parent)
    for packages in (["src"], ["src/"], [SRC], [], (SRC / SUPPORT[maker]).parents[2]):
        robot = load_robot(SRC / SUPPORT[maker], packages=packages)
        assert forward_kinematics(robot, [0, 0]).translation == pytest.approx([0.15, 0, 1.05])
        assert robot.lower == pytest.approx([radians(-170), radians(-90)])


def test_relative_packages_stay_where_they_were(monkeypatch, tmp_path):
    monkeypatch.chdir(SRC.parent)
    robot = load_robot(Path("src") / UR.relative_to(SRC), parameters={"ur_type": "ur5e"}, packages=["src"])
    monkeypatch.chdir(tmp_path)
    assert robot.with_parameters({"safety_pos_margin": 0.1}).nq == 3


def test_a_count_that_is_given_as_a_word_is_no_length():
    assert dict(load_robot(XARM, parameters={"dof": 6}).parameters) == {"dof": 6}
    robot = load_robot(XARM, parameters={"dof": "6"})
    assert (robot.nq, dict(robot.parameters)) == (6, {})
