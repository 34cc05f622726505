"""Any robot on another base and with another tool."""

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm, random_q

import robotics1 as r1

place_robot = r1.textbook_robots.place_robot
BASE = pin.SE3(pin.exp3(np.array([0.1, -0.4, 0.8])), np.array([0.5, -0.2, 1.0]))
TOOL = pin.SE3(pin.exp3(np.array([-0.3, 0.2, 1.4])), np.array([0.0, 0.1, 0.3]))
ROBOTS = ["planar_2r", "prr", "six_r", "spatial", "redundant"]


def robots():
    yield from ((name, arm(name)) for name in ROBOTS)
    yield "follower", r1.textbook_robots.robot_from_transforms(["Rz(q1)", "Tx(1)", "Rz(-q1)", "Ty(q2)"])


@pytest.mark.parametrize(("name", "robot"), list(robots()))
def test_the_pose_is_base_times_pose_times_tool(name, robot):
    moved, q = place_robot(robot, base_placement=BASE, tool_placement=TOOL), random_q(robot, np.random.default_rng(1))
    T = BASE * r1.forward_kinematics(robot, q) * TOOL
    assert r1.forward_kinematics(moved, q).homogeneous == pytest.approx(T.homogeneous, abs=1e-12)
    assert (moved.joint_names, moved.nq) == (robot.joint_names, robot.nq)
    assert moved.lower.tolist() == robot.lower.tolist()
    for frame in robot.frame_names:
        expected = BASE * r1.forward_kinematics(robot, q, frame=frame)
        assert r1.forward_kinematics(moved, q, frame=frame).homogeneous == pytest.approx(
            expected.homogeneous, abs=1e-12
        )


@pytest.mark.parametrize("name", ["six_r", "prr", "planar_2r"])
def test_the_text_of_a_placed_robot_is_the_robot(name, tmp_path):
    robot = arm(name)
    moved, q = place_robot(robot, base_placement=BASE, tool_placement=TOOL), random_q(robot, np.random.default_rng(2))
    file = tmp_path / "moved.urdf"
    file.write_text(moved.urdf)
    again = r1.load_robot(file, tool=moved.tool)
    expected = r1.forward_kinematics(moved, q).homogeneous
    assert r1.forward_kinematics(again, q).homogeneous == pytest.approx(expected, abs=1e-12)


def test_formulas_inverse_and_tables_are_those_of_the_placed_robot():
    robot = arm("planar_2r")
    half = np.diag([1.0, -1, -1, 1])
    half[:3, 3] = [0.5, 0, 0]
    moved = place_robot(robot, base_placement=half)
    q1, q2, l1, l2 = sympy.symbols("q1 q2 l1 l2", real=True)
    y = r1.formulas(moved, r1.PositionTask("xy")).value[1]
    assert sympy.simplify(y + l1 * sympy.sin(q1) + l2 * sympy.sin(q1 + q2)) == 0
    longer = moved.with_parameters({"l1": 2.0})
    assert r1.forward_kinematics(longer, [0, 0]).translation == pytest.approx(
        [0.5 + 2.0 + robot.parameters["l2"], 0, 0]
    )
    six = place_robot(arm("six_r"), base_placement=BASE, tool_placement=TOOL)
    q = random_q(six, np.random.default_rng(3))
    target = r1.forward_kinematics(six, q)
    solved = r1.solve_ik(six, r1.PoseTask(), target).require()
    assert r1.forward_kinematics(six, solved.q).homogeneous == pytest.approx(target.homogeneous, abs=1e-4)
    assert r1.dh.urdf_to_dh(six).pose(q).homogeneous == pytest.approx(target.homogeneous, abs=1e-9)


def test_a_robot_can_be_placed_twice_and_its_links_keep_their_names():
    robot = place_robot(place_robot(arm("six_r"), base_placement=BASE), base_placement=BASE, tool_placement=TOOL)
    q = random_q(robot, np.random.default_rng(4))
    T = BASE * BASE * r1.forward_kinematics(arm("six_r"), q) * TOOL
    assert r1.forward_kinematics(robot, q).homogeneous == pytest.approx(T.homogeneous, abs=1e-12)


def test_what_is_no_placement_and_a_robot_without_a_tool_are_refused():
    with pytest.raises(r1.InputError, match="tool_placement"):
        place_robot(arm("six_r"), tool_placement=np.ones((4, 4)))
    with pytest.raises(r1.InputError, match="several tips"):
        place_robot(arm("two_tips"), tool_placement=TOOL)
    formula = r1.textbook_robots.robot_from_formula(["q1"], "P")
    with pytest.raises(r1.InputError, match="known only by its formula"):
        place_robot(formula, tool_placement=TOOL)
