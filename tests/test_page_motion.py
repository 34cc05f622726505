"""A page of a motion: it plays, seeks, plots, and its positions are those of forward kinematics."""

import re

import numpy as np
import pytest
from pages import OpenPage

from robotics1 import (
    InputError,
    LinearMotion,
    PositionTask,
    animate,
    cubic,
    forward_kinematics,
    load_robot,
    rendezvous,
    view,
)
from robotics1.curves import CurveSequence
from robotics1.trajectories import bang_bang


@pytest.fixture(scope="module")
def motion():
    return cubic([0.1, 0.2, -0.3], [-0.5, 1.2, 2.0], 1.5, 0.0, [0.1, -0.2, 0.3])


@pytest.fixture(scope="module")
def file(motion, tmp_path_factory):
    target = LinearMotion([0.5, 0.8], [0.2, -0.1])
    path = tmp_path_factory.mktemp("page") / "prr.html"
    return animate(load_robot("prr"), motion, path, target=target, title="A <b>title</b>", caption="two\nlines").file


@pytest.fixture(scope="module")
def page(browser, file):
    page = OpenPage(browser, file)
    yield page
    page.tab.close()


@pytest.mark.parametrize("time", [0.0, 0.4, 0.9037, 1.5])
def test_the_page_shows_fk_of_the_motion_at_the_time_of_the_slider(page, motion, time):
    page.seek(time)
    tool = forward_kinematics(load_robot("prr"), motion(time)).translation
    assert page.place("tool frame") == pytest.approx(tool, abs=1e-5)
    assert page.place("moving target") == pytest.approx([0.5 + 0.2 * time, 0.8 - 0.1 * time, 0], abs=1e-6)
    assert page.faults == []


def test_a_cubic_is_drawn_exactly_between_the_samples(page, motion):
    for t in np.linspace(0, 1.5, 37):
        assert page.ask("app.actors[0].motion.at(a)", t) == pytest.approx(motion(t), abs=1e-12)


def test_a_motion_that_jumps_in_velocity_keeps_its_corner(browser, tmp_path):
    robot = load_robot("planar_2r")
    motion = CurveSequence((cubic([0, 0], [1, -1], 0.7, 0.0, 2.0), bang_bang([1, -1], [0, 0.5], 1.0)))
    page = OpenPage(browser, animate(robot, motion, tmp_path / "c.html").file)
    for t in np.linspace(0, motion.duration, 101):
        assert page.ask("app.actors[0].motion.at(a)", t) == pytest.approx(motion(t), abs=1e-9)
    page.tab.close()


def test_the_trail_grows_with_the_time(page):
    grown = []
    for time in (0.0, 0.5, 1.0, 1.5):
        page.seek(time)
        grown.append(page.ask("app.actors[0].trail.mesh.count"))
    assert grown == [0, 30, 60, 90]


def test_the_page_plays_by_itself_and_the_keys_pause_step_and_end_it(browser, file):
    page = OpenPage(browser, file)
    page.wait("window.robotics1.app.bar.time > 0.05")
    page.tab.keyboard.press("Space")
    time = page.ask("app.bar.time")
    page.tab.wait_for_timeout(100)
    assert page.ask("app.bar.time") == time
    for key, expected in (("Home", 0.0), ("ArrowRight", 0.015), ("ArrowLeft", 0.0), ("End", 1.5)):
        page.tab.keyboard.press(key)
        assert page.ask("app.bar.time") == pytest.approx(expected, abs=1e-12)
    assert page.tab.inner_text("#clock") == "1.50 / 1.50 s"
    assert page.faults == []
    page.tab.close()


def test_a_click_into_a_plot_seeks_and_the_plots_hold_q_and_its_limits(page, motion):
    page.tab.click("#plotting")
    titles = page.tab.locator("#plots .title").all_text_contents()
    assert titles == ["q [rad]", "q̇ [rad/s]", "q [m]", "q̇ [m/s]", "σ_min", "distance to the target [m]"]
    points = page.ask("app.plots[0].lines[0].points.at(-1)")
    assert points == pytest.approx([1.5, motion(1.5)[1]], abs=1e-12)
    plot = page.tab.locator("#plots svg").first
    box = plot.bounding_box()
    page.tab.mouse.click(box["x"] + box["width"] * (42 + 370 / 3) / 420, box["y"] + box["height"] / 2)
    assert page.ask("app.bar.time") == pytest.approx(0.5, abs=0.01)
    page.tab.click("#plotting")


def test_the_title_is_text_and_no_markup(page):
    assert page.tab.inner_text("#caption h1") == "A <b>title</b>"


def test_the_page_names_no_other_place_to_load_from(file):
    text = file.read_text(encoding="utf-8")
    assert "default-src 'none'" in text
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=", text)
    assert len(text) < 1_300_000


def test_recorded_values_are_played_as_they_are(browser, tmp_path):
    times, q = [2.0, 2.5, 4.0], [[0, 0], [1, -1], [0.5, 0.25]]
    page = OpenPage(browser, animate(load_robot("planar_2r"), None, tmp_path / "r.html", times=times, q=q).file)
    assert page.ask("app.bar.duration") == 2.0
    assert page.ask("app.actors[0].motion.at(a)", 1.25) == pytest.approx([0.75, -0.375], abs=1e-12)
    page.tab.close()


def test_two_robots_stand_side_by_side_and_two_motions_in_one_place(browser, tmp_path):
    planar, prr = load_robot("planar_2r"), load_robot("prr")
    first, second = cubic([0, 0], [1, 1], 1.0), cubic([0, 0, 0], [0.2, 1, 1], 2.0)
    page = OpenPage(browser, animate([planar, prr], [first, second], tmp_path / "two.html").file)
    assert page.ask("app.bar.duration") == 2.0
    low, high = page.inside()
    assert low > -1
    assert high < 1
    places = page.ask("app.actors.map(a => a.drawing.group.position.x)")
    assert places[1] - places[0] > planar.reach + prr.reach
    page.tab.close()
    page = OpenPage(browser, animate(planar, [first, cubic([0, 0], [-1, 1], 1.0)], tmp_path / "one.html").file)
    assert page.ask("app.actors.map(a => a.drawing.group.position.x)") == [0, 0]
    page.tab.close()


def test_both_arms_of_a_rendezvous_are_at_the_target_when_they_meet_it(browser, tmp_path):
    robot, target = load_robot("planar_2r"), LinearMotion([-2, 1], [1.449, 0.388])
    meeting = rendezvous(robot, PositionTask("xy"), target, q0=[0, 0], meet=lambda t, p: p[0])
    motions = [branch.trajectory for branch in meeting.branches]
    options = {"target": target, "names": ["right arm", "left arm"], "title": "Rendez-vous of a 2R robot"}
    page = OpenPage(browser, animate(robot, motions, tmp_path / "r.html", **options).file, 1280, 800)
    page.seek(meeting.time)
    tools = page.ask("app.actors.map(a => positionOf(a.arm.frame(a.arm.tool, a.arm.forward(a.q))))")
    assert np.array(tools)[:, :2] == pytest.approx(np.array([meeting.position] * 2), abs=1e-9)
    page.seek(0.7 * meeting.time)
    page.tab.click("#plotting")
    page.picture("rendezvous")
    assert page.tab.locator("#choice option").all_text_contents() == ["right arm", "left arm"]
    page.tab.select_option("#choice", "1")
    assert page.ask("app.q") == page.ask("app.actors[1].q")
    assert page.faults == []
    page.tab.close()


def test_no_value_that_is_not_finite_reaches_the_scene(page):
    page.seek(0.3)
    q = page.ask("app.q")
    page.ask("app.change([NaN, 0, 0])")
    page.ask("app.change([Infinity, 0, 0])")
    assert page.ask("app.q") == q


def test_a_browser_without_webgl_says_so(browser, file):
    tab = browser.new_page()
    tab.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    tab.goto(file.as_uri())
    assert tab.inner_text("#loading") == "This browser shows no 3D graphics: WebGL is switched off or missing."
    tab.close()


def test_a_long_motion_is_resampled_so_that_its_page_stays_small(tmp_path):
    page = animate(load_robot("planar_2r"), cubic([0, 0], [1, 1], 600.0), tmp_path / "long.html")
    assert page.file.stat().st_size < 1_300_000


def test_twenty_seconds_of_a_panda_at_60_frames_a_second_add_half_a_megabyte_at_most():
    robot = load_robot("panda")
    q = np.clip(np.full(robot.nq, 0.1), robot.lower, robot.upper)
    times = np.arange(0, 20, 1 / 60)
    recorded = q + 1e-3 * np.sin(times)[:, None]
    still = len(view(robot, q).html)
    assert len(animate(robot, times=times, q=recorded).html) - still < 500_000
    assert len(animate(robot, cubic(q, q + 0.01, 20.0)).html) - still < 500_000


def test_a_million_recorded_values_are_thinned_to_a_small_page():
    times = np.linspace(0, 100, 10**6)
    page = animate(load_robot("planar_2r"), times=times, q=np.sin(times)[:, None] * [1, 2])
    assert len(page.html) < 2_000_000


def test_nothing_is_written_where_there_is_no_folder(tmp_path, motion):
    with pytest.raises(InputError, match="there is no folder"):
        animate(load_robot("prr"), motion, tmp_path / "nowhere" / "page.html")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("times", "q"),
    [([0, 0], [[0, 0]] * 2), ([0], [[0, 0]]), ([0, 1], [[0, 0]]), ([0, np.nan], [[0, 0]] * 2), (None, [[0, 0]] * 2),
     ([1, 0], [[0, 0]] * 2), ([0, 1], [[0, np.inf], [0, 0]]), ([0, 1], [[0], [0]])],
)  # fmt: skip
def test_recorded_values_that_are_no_motion_are_input_errors(times, q, tmp_path):
    with pytest.raises(InputError):
        animate(load_robot("planar_2r"), None, tmp_path / "r.html", times=times, q=q)
    assert list(tmp_path.iterdir()) == []


class Foreign:
    """A motion of the user's own class."""

    def __init__(self, q, duration=1.0):
        self.q, self.duration = q, duration

    def __call__(self, t):
        return np.moveaxis(np.array([self.q(np.asarray(t, float))] * 2), 0, -1)

    def velocity(self, t, *, side="right"):
        return np.zeros((*np.shape(t), 2))


MOVE = cubic([0, 0], [1, 1], 1.0)
MISUSE = [
    (lambda r: animate(r, Foreign(lambda t: np.where(t > 0.5, np.nan, 0.0))), r"it is \[nan, nan\] at t = 0\.5"),
    (lambda r: animate(r, Foreign(lambda t: 1e12 + t)), "must be finite and below 1e"),
    (lambda r: animate(r, Foreign(np.sin, np.inf)), "a motion that does not end"),
    (lambda r: animate(r, Foreign(np.sin, np.nan)), "a motion that does not end"),
    (lambda r: animate(r, Foreign(np.sin, 1e200)), "must last from"),
    (lambda r: animate(r, cubic([0], [1], 1.0)), "motion is of 1 joints; the robot has 2"),
    (lambda r: animate(r, times=[0], q=[[0, 0]]), "two or more instants that grow .*; there are 1"),
    (lambda r: animate(r, times=[0, 2, 1], q=[[0, 0]] * 3), "after 2 comes 1"),
    (lambda r: animate(r, times=[0, 5e-324], q=[[0.0, 0]] * 2), "must last from"),
    (lambda r: animate(r, times=[0, 3], q=[[0.0, 0], [0, np.nan]]), r"it is \[0\.0, nan\] at t = 3 s"),
    (lambda r: animate(r, times=[0, 3], q=[[0.0, 0], [0, 1e300]]), "must be finite and below"),
    (lambda r: animate(r, MOVE, target=3), "the target must be a motion"),
    (lambda r: animate([r, 3], [MOVE, MOVE]), "the robot must be a Robot, not a int"),
    (lambda r: animate(3, MOVE), "load_robot\\(\\) returns one"),
    (lambda r: animate(r, MOVE, task=3), "the task must be a task"),
    (lambda r: animate(r, MOVE, title=3), "title must be a text"),
    (lambda r: animate(r, MOVE, caption=3), "caption must be a text"),
]


@pytest.mark.parametrize(("call", "message"), MISUSE, ids=range(len(MISUSE)))
def test_what_cannot_be_drawn_is_refused_by_a_sentence(call, message):
    with pytest.raises(InputError, match=message):
        call(load_robot("planar_2r"))


def test_a_curve_of_a_hundred_thousand_pieces_is_drawn_by_some_of_them():
    t = np.linspace(0, 100, 100_001)
    motion = Foreign(np.sin, 100.0)
    motion.breakpoints = t[1:-1]
    assert len(animate(load_robot("planar_2r"), motion).html) < 1_500_000
