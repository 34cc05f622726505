import re

import numpy as np
import pytest

from robotics1 import InputError, LinearMotion, animate, cubic, forward_kinematics, load_robot, view

SEEK = "t => { const s = document.getElementById('time'); s.value = t; s.oninput(); }"
POSITION = """path => {
    let node = window.robotics1.viewer.scene_tree.find(path).object;
    node.updateWorldMatrix(true, false);
    return node.matrixWorld.toArray();
}"""


@pytest.fixture
def opened(browser):
    """Return a function that opens a page and gives it with what went wrong in it."""
    pages = []

    def open_page(path):
        page = browser.new_page(viewport={"width": 800, "height": 600})
        wrong = []
        page.on("pageerror", lambda error: wrong.append(str(error)))
        page.on("console", lambda message: wrong.append(message.text) if message.type == "error" else None)
        page.on("request", lambda request: wrong.append(request.url) if request.url.startswith("http") else None)
        page.goto(path.as_uri())
        page.wait_for_function("window.robotics1 && window.robotics1.ready")
        pages.append(page)
        return page, wrong

    yield open_page
    for page in pages:
        page.close()


@pytest.fixture(scope="module")
def motion():
    return cubic([0.1, 0.2, -0.3], [-0.5, 1.2, 2.0], 1.5, 0.0, [0.1, -0.2, 0.3])


@pytest.fixture(scope="module")
def animation(motion, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "prr.html"
    target = LinearMotion([0.5, 0.8], [0.2, -0.1])
    return animate(load_robot("prr"), motion, path, target=target, title="A <b>title</b>", caption="two\nlines")


def placed(page, *path):
    """Return the position of a node of the scene in the robot's world axes; the browser's y is up."""
    x, y, z = np.array(page.evaluate(POSITION, list(path))).reshape(4, 4)[3, :3]
    return np.array([x, -z, y])


@pytest.mark.parametrize("time", [0.0, 0.4, 0.9, 1.5])
def test_the_page_shows_fk_of_the_trajectory_at_the_time_of_the_slider(opened, animation, motion, time):
    page, wrong = opened(animation)
    page.evaluate(SEEK, time)
    robot = load_robot("prr")
    tool = forward_kinematics(robot, motion(time)).translation
    assert placed(page, "meshcat", "robot", "visuals", "tool_0") == pytest.approx(tool, abs=2e-4)
    assert placed(page, "meshcat", "target", "ball") == pytest.approx([0.5 + 0.2 * time, 0.8 - 0.1 * time, 0], abs=2e-4)
    assert wrong == []


def test_the_trail_grows_with_the_time(opened, animation):
    page, _ = opened(animation)
    trail = "window.robotics1.viewer.scene_tree.find(['meshcat', 'trail']).object"
    grown = []
    for time in (0.0, 0.5, 1.0, 1.5):
        page.evaluate(SEEK, time)
        grown.append(page.evaluate(f"{trail}.children.filter(c => c.visible).length"))
    assert grown == [0, 30, 60, 90]


def test_the_page_plays_by_itself_and_can_be_paused(opened, animation):
    page, wrong = opened(animation)
    page.wait_for_function("window.robotics1.viewer.animator.actions[0].time > 0.1")
    page.click("#play")
    time = page.evaluate("window.robotics1.viewer.animator.actions[0].time")
    page.wait_for_timeout(200)
    assert page.evaluate("window.robotics1.viewer.animator.actions[0].time") == time
    assert page.inner_text("#play") == "Play"
    assert wrong == []


def test_the_title_is_text_and_no_markup(opened, animation):
    page, _ = opened(animation)
    assert page.inner_text("#caption h1") == "A <b>title</b>"


def test_a_still_page_has_the_robot_at_q_and_no_controls(opened, tmp_path):
    robot = load_robot("cylindrical")
    q = [1.0, 0.6, 1.4]
    page, wrong = opened(view(robot, q, tmp_path / "still.html"))
    tool = forward_kinematics(robot, q).translation
    assert placed(page, "meshcat", "robot", "visuals", "tool_0") == pytest.approx(tool, abs=1e-6)
    assert not page.is_visible("#controls")
    assert wrong == []


def test_the_page_names_no_other_place_to_load_from(animation):
    text = animation.read_text(encoding="utf-8")
    assert "default-src 'none'" in text
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=", text)
    assert len(text) < 2_000_000


def test_a_long_motion_is_resampled_so_that_its_page_stays_small(tmp_path):
    robot = load_robot("planar_2r")
    page = animate(robot, cubic([0, 0], [1, 1], 600.0), tmp_path / "long.html")
    assert page.stat().st_size < 6_000_000


def test_nothing_is_written_where_there_is_no_folder(tmp_path, motion):
    with pytest.raises(InputError, match="there is no folder"):
        animate(load_robot("prr"), motion, tmp_path / "nowhere" / "page.html")
    assert list(tmp_path.iterdir()) == []
