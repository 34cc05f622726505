"""Every model of example-robot-data that is a robot loads, and an independent parser finds its links where we do."""

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from arms import random_q

from robotics1 import RobotFileError, Robotics1Error, UnknownNameError, check_robot, load_robot

FOLDER = load_robot("ur5").path.parents[2]
REFUSED = {
    "alex_psyonic_hands.urdf": "mimics joint 'index_q1', and there is no such joint",
    "quadrotor_base.urdf.xacro": "has no name",
    "quadrotor_base.xacro": "No such file: .*quadrotor_base.urdf.xacro",
    "ur3.urdf": "has no name",
}
MESHES_MISSING = {"talos_full_v2.urdf", "talos_full_v2_box.urdf", "romeo_laas_small.urdf"}  # not in the package
FILES = sorted([*FOLDER.rglob("*.urdf"), *FOLDER.rglob("*.xacro")])
LOADABLE = [path for path in FILES if path.name not in REFUSED]


def test_there_are_as_many_models_as_the_page_says():
    page = (Path(__file__).parents[1] / "docs" / "example_robots.md").read_text(encoding="utf-8")
    assert (len(FILES), len(LOADABLE)) == (71, 67)
    assert all(f"`{path.relative_to(FOLDER).as_posix()}`" in page for path in FILES)


@pytest.mark.parametrize("path", LOADABLE, ids=lambda path: path.name)
def test_forward_kinematics_of_every_link_is_yourdfpys_to_1e_12(path, capfd):
    report = check_robot(path)
    assert report.fk_difference <= 1e-12
    assert capfd.readouterr().err == ""
    missing = any("was not found" in warning for warning in report.robot.warnings)
    assert missing == (path.name in MESHES_MISSING)


@pytest.mark.parametrize("path", LOADABLE, ids=lambda path: path.name)
def test_the_jacobian_of_the_last_link_is_the_central_difference_of_its_pose(path):
    robot = load_robot(path)
    frame = robot.model.nframes - 1
    q = random_q(robot, 1)

    def pose(x):
        pin.framesForwardKinematics(robot.model, robot.data, x)
        return pin.SE3(robot.data.oMf[frame])

    def rate(step):
        ahead, back = pose(pin.integrate(robot.model, q, step)), pose(pin.integrate(robot.model, q, -step))
        turn = pin.log3(ahead.rotation @ back.rotation.T)
        return np.concatenate([ahead.translation - back.translation, turn]) / 2e-6

    J = pin.computeFrameJacobian(robot.model, robot.data, q, frame, pin.LOCAL_WORLD_ALIGNED).reshape(6, robot.nv)
    differences = np.array([rate(step) for step in 1e-6 * np.eye(robot.nv)]).reshape(robot.nv, 6).T
    assert J == pytest.approx(differences, abs=2e-9)


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_refused_says_why(name):
    for path in (path for path in FILES if path.name == name):
        with pytest.raises(RobotFileError, match=REFUSED[name]):
            load_robot(path)


def path_of(name):
    """The file of a robot's name."""
    try:
        return load_robot(name).path
    except RobotFileError as refused:
        return refused.path


def test_every_name_leads_to_its_robot():
    with pytest.raises(UnknownNameError) as unknown:
        load_robot("a robot that is not there")
    files = sorted(FOLDER.glob("*/*/*.urdf"))
    robots = [path_of(name) for name in unknown.value.candidates]
    assert sorted(path for path in robots if FOLDER in path.parents) == files
    assert load_robot("ur5").tool == "tool0"
    assert load_robot("panda").tool is None
    assert load_robot("panda", tool="panda_hand_tcp").nq == 8


def test_the_tool_of_a_robot_with_several_tips_must_be_named():
    with pytest.raises(Robotics1Error, match="has several tips: name the tool"):
        load_robot("panda").frame_id(None)
