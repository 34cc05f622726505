"""What a hand does in a page, through the buttons and the handle that are there, and what the page answers."""

import re
from io import BytesIO

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q
from pages import OpenPage
from PIL import Image

import robotics1 as r1
from robotics1.singularities import subspaces

LIMITED = """<robot name="limited"><link name="base"/><link name="a"/><link name="b"/><link name="tool"/>
<joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
<joint name="q2" type="revolute"><origin xyz="1 0 0"/><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="0.2" upper="1" velocity="1" effort="1"/></joint>
<joint name="tip" type="fixed"><origin xyz="0.5 0 0"/><parent link="b"/><child link="tool"/></joint></robot>"""


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """Return a function that opens a page, and keeps it for the tests of this file."""
    folder, pages = tmp_path_factory.mktemp("pages"), {}

    def open_page(name):
        if name not in pages:
            pages[name] = OpenPage(browser, r1.view(arm(name), None, folder / f"{name}.html").file)
        return pages[name]

    yield open_page
    for page in pages.values():
        page.tab.close()


def test_the_picture_that_is_saved_is_the_scene(opened):
    page = opened("planar_2r")
    with page.tab.expect_download() as download:
        page.tab.click("#png")
    assert download.value.suggested_filename == f"{arm('planar_2r').name}.png"
    picture = Image.open(BytesIO(download.value.path().read_bytes())).convert("RGB")
    assert picture.size == (900, 700)
    pixels = np.asarray(picture, dtype=int)
    blue = pixels[..., 2] > pixels[..., 0] + 60
    assert blue.mean() > 0.005  # a link


def test_copy_q_puts_the_configuration_on_the_clipboard(opened):
    page = opened("cylindrical")
    q = [0.25, -0.5, 0.123456789012]
    page.move(q)
    page.tab.click("#copy")
    assert page.tab.inner_text("#copy") == "copied"
    page.tab.evaluate("document.body.append(Object.assign(document.createElement('textarea'), {id: 'pasted'}))")
    page.tab.focus("#pasted")
    page.tab.keyboard.press("Control+V")
    pasted = page.tab.input_value("#pasted")
    page.tab.evaluate("document.getElementById('pasted').remove()")
    assert [float(number) for number in pasted.strip("[]").split(",")] == q


def test_the_null_space_motion_is_played_by_its_button(opened):
    page = opened("redundant")
    q = np.array([0.3, 0.5, -0.4, 1.0, 0.2, 0.7, 0.1])
    page.move(q)
    tool = page.place("tool frame")
    page.tab.click("#selfmotion")
    page.wait(f"Math.max(...window.robotics1.app.q.map((v, i) => Math.abs(v - {q.tolist()}[i]))) > 0.1")
    assert page.tab.get_attribute("#selfmotion", "aria-pressed") == "true"
    page.tab.click("#selfmotion")
    still = page.ask("app.q")
    page.tab.wait_for_timeout(100)
    assert page.ask("app.q") == still
    assert page.place("tool frame") == pytest.approx(tool, abs=1e-5)
    assert page.faults == []


def test_near_a_singularity_the_lost_direction_is_named_and_drawn(opened):
    page, robot, q = opened("planar_2r"), arm("planar_2r"), [0.4, 0.02]
    page.move(q)
    U = np.linalg.svd(r1.PositionTask("xy").jacobian(robot, q))[0][:, -1]
    said = page.tab.inner_text("#warning").replace("\u00a0", " ")
    assert said.startswith("Near a singularity: a task velocity along ")
    assert said.endswith(" is hardly realised.")
    named = {axis: float(f"{sign}{size}".replace("−", "-").replace(" ", ""))
             for sign, size, axis in re.findall(r"([−+]?) ?(\d\.\d\d) ([xy])", said)}  # fmt: skip
    named = np.array([named["x"], named["y"]])
    assert abs(named @ U) == pytest.approx(1, abs=0.01)
    drawn = np.array(page.ask("new THREE.Vector3(1, 0, 0).applyQuaternion(app.drawing.lost.quaternion).toArray()"))
    assert abs(drawn[:2] @ U) == pytest.approx(1, abs=1e-6)
    assert page.ask("app.drawing.lost.visible")
    page.move([0.4, 1.5])
    assert not page.tab.is_visible("#warning")
    assert not page.ask("app.drawing.lost.visible")


def test_the_lost_direction_of_a_spatial_arm_is_that_of_the_left_null_space(opened):
    page, robot = opened("six_r"), arm("six_r")
    q = random_q(robot, np.random.default_rng(0))
    q[4] = 0.0  # axes 4 and 6 are one
    page.move(q)
    task = r1.PoseTask()
    in_reaches = np.diag([1 / robot.reach] * 3 + [1.0] * 3)
    null = subspaces(in_reaches @ task.jacobian(robot, q)).left_null
    assert null.shape == (6, 1)
    assert page.tab.inner_text("#warning").startswith("Singular: ")
    U = np.array(page.ask("app.arm.measure(app.q).U[5]"))
    assert abs(U @ null[:, 0]) == pytest.approx(1, abs=1e-9)


def test_a_target_beyond_the_arm_is_out_of_reach_by_its_distance(opened):
    page = opened("planar_2r")
    reach = sum(arm("planar_2r").parameters.values())
    page.move([0.4, 1.0])
    goal = np.array([0.9, 0.6, 0.0]) / np.hypot(0.9, 0.6) * (reach + 0.12)
    said = page.drag(goal)
    away = np.linalg.norm(page.held) - reach
    found = re.fullmatch(r"out of reach by (\S+) m", said)
    assert found, said
    assert float(found[1]) == pytest.approx(away, rel=0.01)
    assert np.linalg.norm(page.place("tool frame")) == pytest.approx(reach, abs=1e-4)


def test_a_joint_at_its_limit_is_named(browser, tmp_path):
    (tmp_path / "limited.urdf").write_text(LIMITED)
    page = OpenPage(browser, r1.view(r1.load_robot(tmp_path / "limited.urdf"), [0.1, 0.6], tmp_path / "l.html").file)
    near = np.hypot(1 + 0.5 * np.cos(1.0), 0.5 * np.sin(1.0))  # the least distance, at q2 = 1
    said = page.drag([near - 0.3, 0.3, 0.0])
    assert said.startswith("at a limit of q2, "), said
    assert page.ask("app.q[1]") == 1.0
    page.tab.close()


def test_a_direction_that_a_singular_arm_cannot_move_in_is_said_so(opened):
    page, robot = opened("prr"), arm("prr")
    l2, l3 = robot.parameters["l2"], robot.parameters["l3"]
    page.move([0.0, np.pi / 2 - 0.2, 0.4])
    said = page.drag([0.0, l2 + l3 + 0.2, 0.0])  # the rail is long, but y is at most l2 + l3
    assert said.startswith("singular: this direction cannot be realised"), said
    assert page.place("tool frame")[1] <= l2 + l3 + 1e-9
    assert page.faults == []


def test_the_ellipsoids_have_the_ratios_of_the_singular_values(opened):
    page, robot = opened("six_r"), arm("six_r")
    q = [0.3, -0.8, 0.9, 0.2, 0.5, 0.1]
    page.move(q)
    sigma = np.linalg.svd(r1.frame_jacobian(robot, q)[:3], compute_uv=False)
    for name, axes in (("velocity", sigma), ("force", 1 / sigma)):
        page.tab.click(f"#{name}")
        size = np.array(page.ask(f"app.abilities.shapes.{name}.scale.toArray()"))
        assert page.ask(f"app.abilities.shapes.{name}.visible")
        assert size / size.max() == pytest.approx(axes / axes.max(), abs=1e-6)
        page.tab.click(f"#{name}")
        assert not page.ask(f"app.abilities.shapes.{name}.visible")


def test_a_link_under_the_pointer_is_named_with_its_joint_and_its_axis_is_drawn(opened):
    page, robot = opened("planar_2r"), arm("planar_2r")
    q = [0.3, 0.8]
    page.move(q)
    page.tab.click("#fit")
    elbow, tool = (r1.forward_kinematics(robot, q, frame=name).translation for name in ("link2", "tool"))
    page.tab.mouse.move(*page.pixels(0.5 * (elbow + tool)))
    assert page.tab.inner_text("#hint").startswith("link2")
    assert "moved by q2 (revolute)" in page.tab.inner_text("#hint")
    page.tab.mouse.move(5, 690)
    assert not page.tab.is_visible("#hint")


def test_fit_brings_a_robot_back_that_has_left_the_window(opened):
    page, robot = opened("six_r"), arm("six_r")
    for seed in range(4):
        page.move(random_q(robot, np.random.default_rng(seed)))
        for button in ("fit", "top", "front", "iso"):
            page.tab.click(f"#{button}")
            seen = page.ask(
                "corners(app.drawing.box()).map(p => p.project(app.stage.viewer.camera)).map(p => [p.x, p.y])"
            )
            assert np.abs(seen).max() < 1.001


def test_a_narrow_window_has_robot_panel_and_bar_one_below_the_other(browser, tmp_path):
    robot = arm("six_r")
    motion = r1.cubic(np.zeros(6), [0.5, -0.4, 0.6, 0.1, 0.8, 0.2], 2.0)
    page = OpenPage(browser, r1.animate(robot, motion, tmp_path / "n.html").file, 390, 844)
    assert not page.tab.is_visible("#panel")
    page.tab.click("#fold")
    assert page.tab.evaluate("document.documentElement.scrollWidth") <= 390
    page.tab.click("#plotting")
    boxes = {name: page.tab.locator(f"#{name}").bounding_box() for name in ("panel", "bottom", "views", "caption")}
    for box in boxes.values():
        assert box["x"] >= 0
        assert box["x"] + box["width"] <= 390
    assert boxes["panel"]["y"] + boxes["panel"]["height"] <= boxes["bottom"]["y"]
    corners = page.ask("corners(app.stage.box).map(p => p.project(app.stage.viewer.camera)).map(p => p.y)")
    lowest = (1 - min(corners)) / 2 * 844
    assert lowest <= boxes["panel"]["y"] + 1
    assert (1 - max(corners)) / 2 * 844 >= boxes["views"]["y"]
    page.tab.close()


def test_arrows_step_after_a_button_was_pressed_and_space_presses_it_once(browser, tmp_path):
    motion = r1.cubic([0, 0], [1, 1], 2.0)
    page = OpenPage(browser, r1.animate(arm("planar_2r"), motion, tmp_path / "k.html").file)
    page.tab.keyboard.press("Home")  # pauses
    page.tab.click("#forth")  # which has the focus now
    page.tab.keyboard.press("ArrowRight")
    assert page.ask("app.bar.time") == pytest.approx(0.04)
    page.tab.click("#play")
    assert page.ask("app.bar.playing")
    page.tab.keyboard.press("Space")
    assert not page.ask("app.bar.playing")
    page.tab.keyboard.press("End")
    assert page.ask("app.bar.time") == 2.0
    page.tab.close()


def test_where_some_meshes_are_missing_the_skeleton_is_drawn_beside_what_was_found(tmp_path):
    text = LIMITED
    for link, shape in (("a", '<box size="1 1 1"/>'), ("b", '<mesh filename="package://p/a.stl"/>')):
        visual = f"<visual><geometry>{shape}</geometry></visual>"
        text = text.replace(f'<link name="{link}"/>', f'<link name="{link}">{visual}</link>')
    (tmp_path / "some.urdf").write_text(text)
    with pytest.warns(r1.RobotWarning, match="skeleton is drawn instead"):
        page = r1.view(r1.load_robot(tmp_path / "some.urdf"))
    assert '"kind":"box","placement"' in page.html
    assert page.html.count('"kind":"cylinder"') >= 3


def test_a_page_works_in_the_frame_that_a_notebook_shows(browser, tmp_path):
    (tmp_path / "notebook.html").write_text(r1.view(arm("planar_2r"), [0.3, 0.9])._repr_html_(), encoding="utf-8")
    tab = browser.new_page()
    tab.goto((tmp_path / "notebook.html").as_uri())
    frame = tab.frames[1]
    frame.wait_for_selector("#loading", state="hidden", timeout=60_000)
    assert frame.evaluate("window.robotics1.app.q") == [0.3, 0.9]
    assert frame.is_visible("#panel")
    tab.close()


def test_names_of_lines_in_a_plot_lose_the_words_that_all_have(opened):
    shortened = "shortened(a)"
    page = opened("planar_2r")
    assert page.ask(shortened, ["panda_joint1", "panda_joint2"]) == ["joint1", "joint2"]
    assert page.ask(shortened, ["wrist_1_joint", "elbow_joint"]) == ["wrist_1", "elbow"]
    assert page.ask(shortened, ["q1", "q1"]) == ["q1", "q1"]
    assert page.ask(shortened, ["a_b", "a_b"]) == ["b", "b"]
    assert page.ask("ticks(-3.5, 4.2)") == [-2, 0, 2, 4]


@pytest.mark.parametrize(("name", "q"), [("six_r", [0.3, -0.8, 0.9, 0.2, 0.5, 0.1]), ("prr", [0.2, 0.5, 0.9])])
def test_with_shift_a_hand_turns_the_tool_where_it_is(opened, name, q):
    page, robot = opened(name), arm(name)
    page.move(q)
    page.tab.click("#fit")
    before = r1.forward_kinematics(robot, q)
    x, y = page.pixels(page.place("handle"))
    page.tab.mouse.move(x, y)
    page.tab.mouse.down()
    page.tab.keyboard.down("Shift")
    page.tab.mouse.move(x + 40, y, steps=4)
    assert page.tab.inner_text("#verdict") == "reached"
    page.tab.mouse.up()
    page.tab.keyboard.up("Shift")
    after = r1.forward_kinematics(robot, page.ask("app.q"))
    assert after.translation == pytest.approx(before.translation, abs=1e-4)
    turned = pin.log3(after.rotation @ before.rotation.T)
    assert np.linalg.norm(turned) == pytest.approx(np.radians(20), abs=1e-3)
    assert page.faults == []
