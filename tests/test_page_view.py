"""A page to play with: sliders, handle, warnings, solutions, and what is drawn where there are no shapes."""

import json

import numpy as np
import pytest
from arms import arm
from hostile_names import NAMES, arm_file
from pages import OpenPage

import robotics1 as r1

WINDOWS = ((1280, 800), (900, 700), (390, 800), (1600, 500))


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """Return a function that opens a page, and keeps it for the tests of this file."""
    folder, pages = tmp_path_factory.mktemp("pages"), {}

    def open_page(name, **options):
        if name not in pages:
            robot = arm(name)
            pages[name] = OpenPage(browser, r1.view(robot, None, folder / f"{name}.html", **options).file)
        return pages[name]

    yield open_page
    for page in pages.values():
        page.tab.close()


def test_a_slider_moves_its_joint_to_its_value_and_not_beyond_its_limit(opened):
    page, robot = opened("cylindrical"), arm("cylindrical")
    slider = page.tab.locator("#joints input[type=range]").nth(0)
    slider.evaluate("(s) => { s.value = 0.7; s.dispatchEvent(new Event('input')); }")
    q = page.ask("app.q")
    assert q[0] == pytest.approx(0.7, abs=1e-12)
    assert page.place("tool frame") == pytest.approx(r1.forward_kinematics(robot, q).translation, abs=1e-6)
    box = page.tab.locator("#joints input[type=number]").nth(1)
    box.fill("1000")
    box.press("Enter")
    assert page.ask("app.q")[1] == robot.upper[1]
    assert page.faults == []


def test_angles_are_typed_in_degrees_or_in_radians(opened):
    page = opened("planar_2r")
    box = page.tab.locator("#joints input[type=number]").nth(0)
    for unit, text in (("degrees", "90"), ("radians", f"{np.pi / 2:.12f}")):
        assert page.tab.inner_text("#unit") == unit
        box.fill(text)
        box.press("Enter")
        assert page.ask("app.q")[0] == pytest.approx(np.pi / 2, abs=1e-11)
        page.tab.click("#zero")
        assert page.ask("app.q") == [0, 0]
        page.tab.click("#unit")


def test_det_j_of_the_2r_is_l1_l2_sin_q2_and_its_singularity_is_named(opened):
    page = opened("planar_2r")
    robot = arm("planar_2r")
    l1, l2 = robot.parameters["l1"], robot.parameters["l2"]
    page.move([0.3, 1.2])
    assert page.ask("app.arm.measure(app.q).determinant") == pytest.approx(l1 * l2 * np.sin(1.2), abs=1e-12)
    assert not page.tab.is_visible("#warning")
    page.move([0.0, 0.0])
    assert page.tab.inner_text("#warning") == "Singular: a task velocity along x cannot be realised."
    assert "rank 1 of 2" in page.tab.inner_text("#jacobian")
    assert page.ask("app.drawing.lost.visible")


def test_a_dragged_tool_is_followed(opened):
    page = opened("planar_2r")
    page.move([0.4, 1.0])
    goal = np.array([0.3, 0.6, 0.0])
    assert page.drag(goal) == "reached"
    assert page.place("tool frame") == pytest.approx(goal, abs=2e-2)  # a pixel is some millimetres
    assert page.place("tool frame") == pytest.approx(page.held, abs=1e-4)
    assert page.faults == []


def test_the_null_space_motion_keeps_the_tool_and_moves_the_joints(opened):
    page = opened("redundant")
    page.move([0.3, 0.5, -0.4, 1.0, 0.2, 0.7, 0.1])
    start, q = page.place("tool frame"), np.array(page.ask("app.q"))
    page.ask("app.abilities.play(true)")
    for _ in range(20):
        page.ask("app.abilities.step(0.02)")
    page.ask("app.abilities.play(false)")
    assert page.place("tool frame") == pytest.approx(start, abs=1e-5)
    assert np.abs(np.array(page.ask("app.q")) - q).max() > 0.1
    regular = opened("planar_2r")
    regular.move([0.3, 0.9])
    assert regular.tab.is_disabled("#selfmotion")


def test_solutions_are_leafed_through_and_drawn_all_at_once(browser, tmp_path):
    robot = arm("planar_2r")
    q_up, q_down = [0.2, 1.1], [1.0, -1.1]
    page = OpenPage(browser, r1.view(robot, None, tmp_path / "s.html", solutions={"up": q_up, "down": q_down}).file)
    assert page.ask("app.q") == q_up
    assert page.tab.inner_text("#which") == "1/2 up"
    page.tab.click("#next")
    assert page.ask("app.q") == q_down
    page.tab.click("#next")
    assert page.ask("app.q") == q_up
    page.tab.click("#overlay")
    assert page.ask("app.solutions.ghosts.map(g => g.group.visible)") == [False, True]
    page.tab.close()


def test_what_ik_solutions_has_found_is_leafed_through():
    robot = arm("planar_2r")
    found = r1.ik_solutions(robot, r1.PositionTask("xy"), [0.5, 1.1])
    html = r1.view(robot, solutions=found).html
    assert f'"solutions":[{{"label":"elbow down","q":{json.dumps(found.q[0].tolist(), separators=(",", ":"))}}}' in html
    assert html.count('"label":"elbow ') == len(found) == 2


@pytest.mark.parametrize("solutions", [3, "q", [[0, 0], [0]], {"a": [0, np.nan]}, {1: [0, 0]}, [None]])
def test_what_is_no_solution_is_an_input_error(solutions):
    with pytest.raises(r1.InputError):
        r1.view(arm("planar_2r"), solutions=solutions)


@pytest.mark.parametrize("name", ["planar_2r", "cylindrical", "prr", "spatial", "redundant"])
def test_the_robot_is_inside_the_window_whatever_its_size(opened, name):
    page = opened(name)
    for width, height in WINDOWS:
        page.tab.set_viewport_size({"width": width, "height": height})
        for view in ("iso", "top", "front"):
            page.ask("app.stage.look(a)", view)
            low, high = page.inside()
            assert low > -1.001
            assert high < 1.001
    page.tab.set_viewport_size({"width": 900, "height": 700})


def test_a_robot_without_shapes_is_drawn_as_a_skeleton_and_the_page_says_so(browser, tmp_path):
    robot = arm("six_r")
    page = OpenPage(browser, r1.view(robot, None, tmp_path / "s.html").file)
    assert page.tab.inner_text("#caption .notes") == "The robot's file has no shapes: a skeleton is drawn."
    drawn = page.ask("app.drawing.links.map(group => group.children.length)")
    assert all(drawn)
    page.tab.close()


def test_a_page_says_that_it_shows_another_task_where_rows_are_not_constant():
    radius = r1.FunctionTask(lambda p, R, q: [np.hypot(p[0], p[1])], 1)
    page = r1.view("planar_2r", [0.1, 0.2], task=radius).html
    assert "FunctionTask (r1) is none: σ_min and the arrows are those of PositionTask (x, y)." in page
    assert '<p class="notes"></p>' in r1.view("planar_2r", [0.1, 0.2], task="position:x").html


@pytest.mark.parametrize("kind", ["script", "image", "entity", "template", "line separator"])
def test_names_of_a_file_are_text_in_the_page(browser, kind, tmp_path):
    name = NAMES[kind]
    robot = r1.load_robot(arm_file(tmp_path, name))
    page = OpenPage(browser, r1.view(robot, None, tmp_path / "s.html", title=name, caption=name).file)
    assert page.tab.title() != "ran"
    assert page.tab.evaluate("document.querySelectorAll('#caption *').length") == 3
    assert page.tab.evaluate("document.querySelectorAll('#panel img, #panel script').length") == 0
    assert page.faults == []
    page.tab.close()


def test_a_page_is_one_file_of_its_own_and_small(tmp_path):
    page = r1.view(arm("cylindrical"), None, tmp_path / "s.html")
    text = page.file.read_text(encoding="utf-8")
    assert text == page.html
    assert len(text) < 1_300_000
    assert "default-src 'none'" in text
    assert len(repr(page)) < 200
    assert page._repr_html_().startswith("<iframe srcdoc=")


def test_a_mesh_that_was_not_found_is_named_with_the_way_to_find_it(tmp_path):
    (tmp_path / "arm.urdf").write_text(
        '<robot name="r"><link name="base"/><link name="a"><visual><geometry><mesh filename="package://p/a.stl"/>'
        '</geometry></visual></link><joint name="q1" type="revolute"><parent link="base"/><child link="a"/>'
        '<axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint></robot>'
    )
    robot = r1.load_robot(tmp_path / "arm.urdf")
    with pytest.warns(
        r1.RobotWarning, match=r"mesh 'package://p/a.stl' was not found.*packages=\[...\], or --packages"
    ):
        page = r1.view(robot)
    assert "Mesh &#x27;package://p/a.stl&#x27; was not found" in page.html
    assert page.html.count('"kind":"cylinder"') > 1  # the skeleton


@pytest.mark.parametrize(
    ("name", "planar", "frame"),
    [("prr", True, "tool"), ("vertical_2r", False, "tool"), ("two_tips", True, "link2"), ("spatial", False, None)],
)
def test_a_planar_arm_is_seen_from_the_top_and_a_robot_of_several_tips_has_the_last_link_of_all(name, planar, frame):
    html = r1.view(arm(name)).html
    assert f'"planar":{str(planar).lower()}' in html
    assert frame is None or f'"tool":{{"name":"{frame}"' in html
