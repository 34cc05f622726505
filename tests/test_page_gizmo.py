"""The gizmo at the target: each arrow moves it along its axis only, each ring turns it about its axis only."""

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from pages import OpenPage

import robotics1 as r1

AXES = {"x": [1.0, 0, 0], "y": [0, 1.0, 0], "z": [0, 0, 1.0]}
POSTURES = {
    "planar_2r": [0.4, 1.0],
    "prr": [0.2, 0.5, 0.9],
    "cylindrical": [0.4, 0.6, 0.5],
    "six_r": [0.3, -0.8, 0.9, 0.2, 0.5, 0.1],
}
PARTS = {
    "planar_2r": ["ball", "arrow x", "arrow y"],
    "prr": ["ball", "arrow x", "arrow y", "ring z"],
    "cylindrical": ["ball", "arrow x", "arrow y", "arrow z"],
    "six_r": ["ball", *(f"{kind} {axis}" for kind in ("arrow", "ring") for axis in "xyz")],
}


@pytest.fixture(scope="module")
def opened(browser, tmp_path_factory):
    """Return a function that opens a page, and keeps it for the tests of this file."""
    folder, pages = tmp_path_factory.mktemp("pages"), {}

    def open_page(name):
        if name not in pages:
            pages[name] = OpenPage(browser, r1.view(arm(name), None, folder / f"{name}.html").file)
        page = pages[name]
        page.move(POSTURES[name])
        page.tab.click("#fit")
        page.ask("app.handle.face()")  # as in each frame
        return page

    yield open_page
    for page in pages.values():
        page.tab.close()


def parts(page):
    """Return the names of the parts of the gizmo."""
    return page.ask(
        "app.handle.gizmo.parts.map(p => p.kind + (p.axis ? ' ' + 'xyz'[p.axis.toArray().indexOf(1)] : ''))"
    )


def pixel_of(page, name, share=0.6):
    """Return a pixel on a part of the gizmo: so far along its line, or the next that is free."""
    return page.ask(
        "(() => { const g = app.handle.gizmo, part = g.parts[a];"
        " const world = p => new THREE.Vector3(...p).applyMatrix4(g.group.matrixWorld);"
        " const at = part.points.map(p => app.stage.pixelOf(world(p)));"
        " for (let i = 0; i < 40; i++) { const s = (b + i / 40) % 1 * (at.length - 1), k = Math.floor(s), t = s - k;"
        "  const p = [0, 1].map(c => at[k][c] * (1 - t) + at[k + 1][c] * t);"
        "  if (g.pick(app.stage, p, 8)?.part === part) return p; } })()",
        parts(page).index(name), share,
    )  # fmt: skip


def drag(page, start, by):
    """Drag from a pixel, and return what was wanted, (3, 4), and what the page says."""
    page.tab.mouse.move(*start)
    page.tab.mouse.down()
    page.tab.mouse.move(start[0] + by[0], start[1] + by[1], steps=5)
    wanted, said = np.reshape(page.ask("app.handle.held.wanted"), (3, 4)), page.tab.inner_text("#verdict")
    page.tab.mouse.up()
    return wanted, said


def step_on_screen(page, axis, length=40):
    """Return the pixels of a step along an axis of the world at the target."""
    p = page.place("handle")
    step = np.subtract(page.pixels(p + 0.01 * np.array(AXES[axis])), page.pixels(p))
    return step * length / np.linalg.norm(step)


@pytest.mark.parametrize("name", PARTS)
def test_there_is_an_arrow_for_each_axis_of_the_position_and_a_ring_for_each_of_the_orientation(opened, name):
    assert parts(opened(name)) == PARTS[name]


@pytest.mark.parametrize(("name", "axis"), [(n, p[-1]) for n in PARTS for p in PARTS[n] if p.startswith("arrow")])
def test_an_arrow_moves_the_target_along_its_axis_only(opened, name, axis):
    page, robot = opened(name), arm(name)
    before = r1.forward_kinematics(robot, POSTURES[name])
    step = step_on_screen(page, axis, -30)  # towards the arm
    seen = np.array(page.pixels(before.translation))
    wanted, said = drag(page, pixel_of(page, f"arrow {axis}"), step + 7 * np.array([step[1], -step[0]]) / 30)
    assert said == "reached"
    moved = wanted[:, 3] - before.translation
    along = moved @ AXES[axis]
    assert abs(along) > 0.01
    assert moved == pytest.approx(along * np.array(AXES[axis]), abs=1e-12)
    assert wanted[:, :3] == pytest.approx(before.rotation, abs=1e-12)
    assert page.pixels(wanted[:, 3]) - seen == pytest.approx(step, abs=5)  # as far as the hand goes, without a jump
    after = r1.forward_kinematics(robot, page.ask("app.q"))
    assert after.translation == pytest.approx(wanted[:, 3], abs=1e-5)
    assert page.place("tool frame") == pytest.approx(after.translation, abs=1e-5)
    assert page.faults == []


@pytest.mark.parametrize(("name", "axis"), [(n, p[-1]) for n in PARTS for p in PARTS[n] if p.startswith("ring")])
def test_a_ring_turns_the_target_about_its_axis_only(opened, name, axis):
    page, robot = opened(name), arm(name)
    before = r1.forward_kinematics(robot, POSTURES[name])
    start = np.array(pixel_of(page, f"ring {axis}", 0.1))
    spoke = start - page.pixels(page.place("handle"))
    wanted, said = drag(page, start, 0.3 * np.array([spoke[1], -spoke[0]]))
    assert said == "reached"
    turned = pin.log3(wanted[:, :3] @ before.rotation.T)
    angle = turned @ AXES[axis]
    assert abs(angle) > 0.1
    assert turned == pytest.approx(angle * np.array(AXES[axis]), abs=1e-9)
    assert wanted[:, 3] == pytest.approx(before.translation, abs=1e-12)
    after = r1.forward_kinematics(robot, page.ask("app.q"))
    assert after.translation == pytest.approx(before.translation, abs=1e-5)
    assert after.rotation == pytest.approx(wanted[:, :3], abs=1e-5)
    assert page.faults == []


def test_a_ring_in_the_plane_turns_as_far_as_the_hand_goes_round(opened):
    page, robot = opened("prr"), arm("prr")
    start = np.array(pixel_of(page, "ring z", 0.1))
    x, y = start - page.pixels(page.place("handle"))
    angle = np.radians(25)  # anticlockwise; pixels count downwards
    end = np.array([x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)])
    drag(page, start, end - [x, y])
    after, before = (r1.forward_kinematics(robot, q).rotation for q in (page.ask("app.q"), POSTURES["prr"]))
    assert pin.log3(after @ before.T) == pytest.approx([0, 0, angle], abs=1e-5)


@pytest.mark.parametrize(("name", "part"), [("prr", "arrow y"), ("prr", "ring z"), ("six_r", "arrow z")])
def test_a_finger_on_a_narrow_screen_moves_the_target_and_not_the_camera(browser, tmp_path, name, part):
    robot, q = arm(name), POSTURES[name]
    page = OpenPage(browser, r1.view(robot, q, tmp_path / "t.html").file, 390, 844, has_touch=True)
    page.ask("app.handle.face()")
    camera = page.ask("app.stage.viewer.camera.position.toArray()")
    before = r1.forward_kinematics(robot, q)
    start = np.add(pixel_of(page, part, 0.95), 5)  # a finger is not exact
    page.touch(start, start + (step_on_screen(page, "z", -25) if name == "six_r" else np.array([-8, 25])))
    after = r1.forward_kinematics(robot, page.ask("app.q"))
    assert not page.tab.is_visible("#panel")
    assert page.tab.is_visible("#verdict")
    assert page.tab.inner_text("#verdict") == "reached"
    assert page.ask("app.stage.viewer.camera.position.toArray()") == pytest.approx(camera, abs=1e-9)
    moved, turned = after.translation - before.translation, pin.log3(after.rotation @ before.rotation.T)
    kind, axis = part.split()
    wanted, kept = (turned, moved) if kind == "ring" else (moved, turned)
    size = wanted @ AXES[axis]
    assert abs(size) > 0.02
    assert wanted == pytest.approx(size * np.array(AXES[axis]), abs=2e-5)
    assert kept == pytest.approx([0, 0, 0], abs=2e-5)
    assert page.faults == []
    page.tab.close()


def test_what_is_under_the_pointer_says_what_it_does(opened):
    page = opened("six_r")
    for part, words in (("arrow z", "drag along z"), ("ring y", "turn about y")):
        page.tab.mouse.move(*pixel_of(page, part))
        assert page.tab.inner_text("#hint") == words
        page.tab.mouse.down()
        assert not page.tab.is_visible("#hint")
        page.tab.mouse.up()
    page.tab.mouse.move(5, 690)
    assert not page.tab.is_visible("#hint")


def test_an_arrow_that_points_at_the_eye_and_a_ring_seen_from_its_edge_are_not_there(opened):
    page = opened("six_r")
    page.tab.click("#top")
    page.ask("app.handle.face()")
    seen = dict(zip(parts(page), page.ask("app.handle.gizmo.parts.map(p => p.node.visible)"), strict=True))
    assert [name for name, visible in seen.items() if visible] == ["ball", "arrow x", "arrow y", "ring z"]
    page.tab.click("#iso")


def test_while_a_motion_plays_only_the_ball_is_there(browser, tmp_path):
    motion = r1.cubic([0.2, 0.5], [0.9, 1.3], 30.0)
    page = OpenPage(browser, r1.animate(arm("planar_2r"), motion, tmp_path / "p.html").file)
    visible = "app.handle.gizmo.parts.map(p => p.node.visible)"
    page.wait(f"String((app => {visible})(window.robotics1.app)) === 'true,false,false'")
    page.tab.click("#play")
    page.wait(f"String((app => {visible})(window.robotics1.app)) === 'true,true,true'")
    page.tab.close()
