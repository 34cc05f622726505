"""The page computes as Pinocchio does: forward kinematics, Jacobian, singular values, inverse kinematics."""

import numpy as np
import pytest
from arms import arm, random_q
from pages import OpenPage, data_behind
from sweeps import core_first

from robotics1 import (
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    forward_kinematics,
    frame_jacobian,
    load_robot,
    view,
)
from robotics1.robot.sources import named_robots

FOLLOWERS = """<robot name="followers"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
<link name="tool"/>
<joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0.6 0.8"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
<joint name="slide" type="prismatic"><parent link="a"/><child link="b"/><origin xyz="0.3 0.1 -0.2" rpy="0.3 -0.7 1.1"/>
<axis xyz="1 0 0"/><mimic joint="q1" multiplier="-0.5" offset="0.1"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
<joint name="turn" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0 0.4 0"/><axis xyz="0 1 0"/>
<mimic joint="q1" multiplier="2" offset="-0.3"/><limit lower="-9" upper="9" velocity="9" effort="1"/></joint>
<joint name="tip" type="fixed"><parent link="c"/><child link="tool"/><origin xyz="0.2 0 0.1"/></joint></robot>"""
REFUSED = {"ur", "alex_psyonic_hands"}  # no robots: no name, and a joint that is not there
NAMED = set(named_robots())
ARMS = ("prr", "cylindrical", "planar_2r", "planar_3r", "redundant", "six_r")
TASKS = {
    "prr": PlanarPoseTask("xy"),
    "cylindrical": PositionTask("xyz"),
    "planar_2r": PositionTask("xy"),
    "planar_3r": PlanarPoseTask("xy"),
    "redundant": PoseTask(),
    "six_r": PoseTask(),
}


def unitless_singular_values(robot, task, q):
    """σ of S J(q) D: rows in metres are divided by the reach, columns of slides multiplied by it."""
    rows = [1 / robot.reach if unit == "m" else 1.0 for unit in task.row_units]
    return np.linalg.svd(np.diag(rows) @ task.jacobian(robot, q) @ np.diag(robot.units), compute_uv=False)


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """Return a function that opens the page of a robot once."""
    folder, pages = tmp_path_factory.mktemp("pages"), {}

    def open_page(name):
        if name not in pages:
            robot = arm(name)
            page = OpenPage(browser, view(robot, None, folder / f"{name}.html", task=TASKS.get(name)).file)
            pages[name] = (robot, page)
        return pages[name]

    yield open_page
    for _, page in pages.values():
        page.tab.close()


@pytest.mark.parametrize("name", ARMS)
def test_the_tool_of_the_page_is_where_fk_puts_it(opened, name):
    robot, page = opened(name)
    for seed in range(3):
        q = random_q(robot, seed)
        T = forward_kinematics(robot, q)
        found = np.array(page.ask("app.arm.frame(app.arm.tool, app.arm.forward(a))", list(q))).reshape(3, 4)
        assert found == pytest.approx(T.homogeneous[:3], abs=1e-12)
        page.move(q)
        assert page.place("tool frame") == pytest.approx(T.translation, abs=1e-5)


@pytest.mark.parametrize("name", ARMS)
def test_jacobian_and_singular_values_of_the_page_are_those_of_the_task(opened, name):
    robot, page = opened(name)
    for seed in range(3):
        q = random_q(robot, seed)
        found = page.ask("app.arm.measure(a)", list(q))
        assert np.array(found["J"]) == pytest.approx(TASKS[name].jacobian(robot, q), abs=1e-9)
        assert found["values"] == pytest.approx(unitless_singular_values(robot, TASKS[name], q), abs=1e-12)
        if TASKS[name].rows == robot.nv:
            assert found["determinant"] == pytest.approx(np.linalg.det(TASKS[name].jacobian(robot, q)), abs=1e-12)


@pytest.mark.parametrize("name", ["planar_2r", "redundant", "six_r"])
def test_a_followed_target_is_reached_where_fk_says(opened, name):
    robot, page = opened(name)
    start, goal = random_q(robot, 0), random_q(robot, 0) + 0.2
    wanted = forward_kinematics(robot, goal)
    found = page.ask("follow(app.arm, a, b)", list(start), [float(v) for v in wanted.homogeneous[:3].ravel()])
    assert found["verdict"]["kind"] == "reached"
    e = TASKS[name].error(robot, found["q"], TASKS[name].value(robot, goal))
    assert np.abs(e).max() < 1e-4
    assert robot.within_limits(found["q"])


def test_followers_move_in_the_page_as_pinocchio_moves_them(browser, tmp_path):
    robot = load_robot(FOLLOWERS)
    page = OpenPage(browser, view(robot, None, tmp_path / "followers.html").file)
    for value in (-1.1, 0.4, 0.9):
        T = forward_kinematics(robot, [value])
        found = page.ask("app.arm.frame(app.arm.tool, app.arm.forward(a))", [value])
        assert np.array(found).reshape(3, 4) == pytest.approx(T.homogeneous[:3], abs=1e-12)
        J = page.ask("app.arm.jacobian(app.arm.tool, app.arm.forward(a))", [value])
        assert np.array(J) == pytest.approx(frame_jacobian(robot, [value]), abs=1e-12)
    page.tab.close()


@pytest.mark.filterwarnings("ignore:mesh:robotics1.RobotWarning")  # of some robots they are in no package
@pytest.mark.parametrize("name", core_first(sorted(NAMED - REFUSED), {"ur5", "panda", "prr", "kinova"}, 4))
def test_a_named_robot_moves_in_the_page_as_in_pinocchio(opened, name):
    """Its numbers only: the page of another robot computes with them."""
    robot, page = load_robot(name), opened("planar_2r")[1]
    if robot.nq != robot.nv:
        pytest.skip("a robot with a planar or floating joint stands still in a page")
    data = data_behind(view(robot).html)["arms"][0]
    frame, task = data["tool"]["name"], data["task"]
    for seed in range(3):
        q = random_q(robot, seed)
        found = page.ask(
            "(arm => { const placed = arm.forward(b), m = arm.task ? arm.measure(b) : null;"
            " return [arm.frame(arm.tool, placed), arm.jacobian(arm.tool, placed), m && m.values]; })(new Arm(a))",
            data,
            q.tolist(),
        )
        T = forward_kinematics(robot, q, frame=frame)
        assert np.array(found[0]).reshape(3, 4) == pytest.approx(T.homogeneous[:3], abs=1e-9)
        assert np.array(found[1]) == pytest.approx(frame_jacobian(robot, q, frame=frame), abs=1e-9)
        if data["chain"]["length"] is not None:  # beyond it, a page says that a target is out of reach
            assert np.linalg.norm(T.translation - data["chain"]["start"]) <= data["chain"]["length"] + 1e-9
        if task is not None:
            plane = "xy" if task["rows"][:2] == ["x", "y"] and "z" not in task["rows"] else "xyz"
            shown = {
                "PositionTask": PositionTask(plane, frame=frame),
                "PlanarPoseTask": PlanarPoseTask("xy", frame=frame),
                "PoseTask": PoseTask(frame=frame),
            }[task["name"]]
            assert found[2] == pytest.approx(unitless_singular_values(robot, shown, q), abs=1e-9)
