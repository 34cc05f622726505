"""The data sheet of an arm: what its sections say, what happens to one that fails, and how it looks in a browser."""

import re
import sys
from html import unescape
from math import pi

import numpy as np
import pytest
import sympy
from arms import arm
from command import answer, run
from hostile_names import NAMES, arm_file
from pages import OpenPage
from sweeps import core_first

import robotics1 as r1
from robotics1.data_sheet.asked import Asked, good_posture
from robotics1.data_sheet.contents import SECTIONS
from robotics1.data_sheet.measures import ellipsoids
from robotics1.data_sheet.worker import NoAnswer, Worker, written
from robotics1.dh.named_lengths import with_named_lengths
from robotics1.ik.closed_form.named_parts import in_named_parts
from robotics1.names import printable
from robotics1.tasks.given import short_form

PLANE = r1.PositionTask("xy")
Q = [0.4, 0.9]


@pytest.fixture(scope="module")
def sheet(tmp_path_factory):
    """The sheet of the 2R arm at Q, and how its progress was told."""
    told = []
    file = tmp_path_factory.mktemp("sheet") / "sheet.html"
    page = r1.report(arm("planar_2r"), file, q=Q, progress=lambda done, count: told.append((done, count)))
    assert page.file == file
    assert file.read_text(encoding="utf-8") == page.html
    return page, told


def section(page, name):
    """What a section says, without the picture's own page."""
    text = re.search(rf'<section id="{name}">(.*?)</section>', page.html, flags=re.DOTALL)[1]
    return re.sub(r'srcdoc="[^"]*"', "", text)


def words(html):
    return re.sub(r"\s+", " ", unescape(re.sub("<[^>]*>", " ", html))).strip()


def written_out(values):
    return " ".join(f"{value:.4f}" for value in values).replace("-", "−")


def test_every_section_has_an_answer_and_progress_goes_from_none_to_all(sheet):
    page, told = sheet
    assert re.findall(r'<section id="(\w+)">', page.html) == [section.name for section in SECTIONS]
    assert "no answer" not in page.html
    assert told == [(k, len(SECTIONS)) for k in range(len(SECTIONS) + 1)]


def test_the_sheet_needs_nothing_from_elsewhere(sheet):
    page, _ = sheet
    outer = re.sub(r'srcdoc="[^"]*"', "", page.html)
    assert set(re.findall(r'(?:src|href)="(\w*[:#])', outer)) == {"data:", "#"}
    assert "default-src 'none'" in outer
    assert "<script" not in outer


def test_the_jacobian_and_its_determinant_are_those_of_the_textbook(sheet):
    page, _ = sheet
    assert "l 2 c 12" in words(section(page, "jacobian")).replace("⁢", "").replace("  ", " ")
    determinant = words(section(page, "determinant")).replace("⁢", "").replace("  ", " ")
    assert determinant.startswith("Determinant det J = l 1 l 2 s 2")


def test_numbers_at_the_posture_are_those_of_forward_kinematics_and_of_the_singular_values(sheet):
    page, _ = sheet
    robot = arm("planar_2r")
    x, y, _ = r1.forward_kinematics(robot, Q).translation
    assert f"p = ({x:.4f}, {y:.4f}, 0) m" in words(section(page, "direct_kinematics"))
    J = PLANE.jacobian(robot, Q)
    for row in J:
        assert written_out(row) in words(section(page, "jacobian"))
    sigma = np.linalg.svd(J / robot.reach, compute_uv=False)
    assert f"σ1 {sigma[0]:.4f} σ2 {sigma[1]:.4f}" in words(section(page, "ellipsoids"))


def test_the_singular_set_and_the_inverse_kinematics_say_how_sure_they_are(sheet):
    page, _ = sheet
    singular = words(section(page, "singular_set"))
    assert "1 q2 = 0 1 1 exact 2 q2 = π 1 1 exact" in singular
    assert "Proven" in singular
    inverse = words(section(page, "inverse_kinematics"))
    assert "Proven" in inverse
    assert "Verified" in words(section(page, "inverse_formulas"))
    found = r1.ik_solutions(arm("planar_2r"), PLANE, PLANE.value(arm("planar_2r"), Q))
    for q in found.q:
        assert written_out(q) in inverse


def test_the_workspace_of_the_2r_arm_is_its_ring(sheet):
    page, _ = sheet
    l1, l2 = (arm("planar_2r").parameters[name] for name in ("l1", "l2"))
    area = pi * ((l1 + l2) ** 2 - (l1 - l2) ** 2)
    assert f"area {area:.4g} m²" in words(page.html[: page.html.index("<section")])


SKEW = [["R", 0.2, pi / 2, 0, 0], ["R", 0.4, 0.7, 0.1, 0], ["R", 0.3, 0, 0.1, 0]]
PUMA = [
    ["R", 0, pi / 2, 0, 0],
    ["R", 0.4318, 0, 0, 0],
    ["R", 0.0203, -pi / 2, 0.15005, 0],
    ["R", 0, pi / 2, 0.4318, 0],
    ["R", 0, -pi / 2, 0, 0],
    ["R", 0, 0, 0.1, 0],
]


@pytest.mark.parametrize(
    ("robot", "kind", "sentence"),
    [
        (arm("planar_2r"), "arcs", "Proven: the boundary is made of arcs and segments"),
        (
            r1.robot_from_dh(SKEW),
            "traced",
            "Computed: the boundary is where the joints are singular or at limits, traced",
        ),
        (arm("six_r"), "cells", "Searched: the section is sampled in cells of 0.0158 m"),
    ],
)
def test_a_workspace_is_called_exact_traced_or_sampled_as_it_is(robot, kind, sentence):
    found = r1.workspaces.workspace(robot, "position:xy" if kind == "arcs" else "position")
    assert (found.resolution > 0) == (kind == "cells")
    assert any(curve.kind == "curve" for curve in found.boundary) == (kind == "traced")
    answer = written(Asked(robot, None, np.zeros(robot.nq)), "workspace")
    said = words(answer.html)
    assert sentence in said
    assert [word for word in ("Proven", "Computed", "Searched") if word in said] == [sentence.partition(":")[0]]
    assert ("by samples" in answer.fact) == (kind == "cells")


def test_an_arm_without_joints_has_a_sheet_that_says_why_sections_are_missing(tmp_path):
    (tmp_path / "still.urdf").write_text('<robot name="still"><link name="base"/></robot>')
    page = r1.report(r1.load_robot(tmp_path / "still.urdf"))
    assert "This section has no answer: no joint" in words(section(page, "jacobian"))
    assert "No joint moves" in words(section(page, "joints"))


def test_what_has_no_time_left_says_so():
    page = r1.report(arm("planar_2r"), time_limit=0.01)
    assert page.html.count("the sections before took all of the time (0.01 s)") == 2 * len(SECTIONS)


def test_a_section_that_takes_too_long_or_dies_is_ended_and_the_next_has_its_answer():
    robot = arm("planar_2r")
    with Worker(Asked(robot, PLANE, np.array(Q))) as worker:
        with pytest.raises(NoAnswer, match="not ready after 0 s"):
            worker.answer("scan", 0.001)
        assert worker.answer("joints", 60).fact.startswith("2 revolute joints")
        worker._process.kill()
        with pytest.raises(NoAnswer, match="ended without an answer"):
            worker.answer("joints", 60)
        assert worker.answer("dh_tables", 60).html


def test_a_task_that_no_other_process_can_read_is_answered_in_this_one():
    task = r1.FunctionTask(lambda p, R, q: [p[0], p[1]], 2)
    with Worker(Asked(arm("planar_2r"), task, np.array(Q))) as worker:
        assert "det J = " in worker.answer("determinant", 60).fact


def test_a_dh_table_has_the_names_of_lengths_and_the_digits_of_the_file():
    said = words(written(Asked(r1.load_robot("prr"), None, np.zeros(3)), "dh_tables").html)
    assert "2 R l2 0 0 q2 − π/2 3 R l3 0 0 q3" in said
    robot = r1.robot_from_dh([["R", 0.39225, pi / 2, 0, 0], ["R", 0.5, 0, 0, 0]])
    assert "1 R 0.39225 π/2 0 q1 2 R 0.5000 0 0 q2" in words(written(Asked(robot, None, np.zeros(2)), "dh_tables").html)


def test_a_length_with_the_value_of_an_entry_that_does_not_change_with_it_is_not_its_name():
    robot = r1.robot_from_dh([["R", "a1", 0, 0, 0], ["R", 0.5, 0, "b1", 0]], parameters={"a1": 0.5, "b1": 0.2})
    table = with_named_lengths(r1.urdf_to_dh(robot), robot)
    assert [(row.a, row.d) for row in table.rows] == [("a1", 0), (0.5, "b1")]
    assert table.pose([0.3, -0.4]).isApprox(r1.forward_kinematics(robot, [0.3, -0.4]))


@pytest.mark.parametrize(("rows", "task"), [(PUMA, "pose"), (PUMA[:2], PLANE), (SKEW[:1] + PUMA[1:3], "position")])
def test_formulas_in_steps_are_the_formulas(rows, task):
    joints = r1.ik_formulas(r1.robot_from_dh(rows), task).joints
    symbols = sorted(
        {symbol for joint in joints for option in joint.options for symbol in option.free_symbols}, key=str
    )
    drawn = np.random.default_rng(3).uniform(0.2, 0.5, len(symbols))
    values = {symbol: float(x) for symbol, x in zip(symbols, drawn, strict=True)}
    known = dict(values)
    for joint, steps in zip(joints, in_named_parts(joints, {}), strict=True):
        for name, formula in steps.named:
            assert sympy.count_ops(formula) < 60
            known[name] = sympy.N(formula.subs(known))
        for option, short in zip(joint.options, steps.options, strict=True):
            assert complex(short.subs(known)) == pytest.approx(complex(option.subs(values)), abs=1e-3)


def test_the_posture_is_far_from_singular_and_inside_the_limits():
    robot = arm("elbow_limited")
    q = good_posture(robot, PLANE)
    assert robot.within_limits(q)
    assert np.linalg.cond(PLANE.jacobian(robot, q)) < 10


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"q": [1]}, r"q must have shape \(2,\)"),
        ({"task": r1.PositionTask("xy", frame="nowhere")}, "nowhere"),
        ({"time_limit": 0}, "time_limit must be"),
        ({"file": "nowhere/sheet.html"}, "there is no folder nowhere"),
        ({"title": 3}, "title must be"),
        ({"progress": 3}, "progress must be a function"),
    ],
)
def test_misuse_is_refused_before_the_work_begins(options, sentence):
    with pytest.raises(r1.Robotics1Error, match=sentence):
        r1.report(arm("planar_2r"), **options)


@pytest.mark.parametrize("name", core_first(("script", "image", "template", "bidi"), ["script"], 1))
def test_names_from_a_file_are_only_shown(browser, name, tmp_path):
    robot = r1.load_robot(arm_file(tmp_path, NAMES[name]))
    page = r1.report(robot, tmp_path / "sheet.html")
    seen = OpenPage(browser, page.file, sheet=True)
    assert seen.tab.inner_text("h1") == seen.tab.title() == printable(robot.name)
    assert printable(robot.joint_names[0]) in seen.tab.inner_text("#joints")
    assert seen.tab.locator("main script, main img[src=x]").count() == 0
    assert seen.faults == []


@pytest.mark.parametrize("width", [1280, 390])
def test_a_browser_shows_the_sheet_and_the_arm_and_nothing_sticks_out(browser, sheet, width):
    page = OpenPage(browser, sheet[0].file, width, 844, sheet=True)
    assert page.tab.evaluate("document.documentElement.scrollWidth") <= width
    page.tab.locator("iframe").scroll_into_view_if_needed()
    frame = page.tab.frames[1]
    frame.wait_for_function("() => window.robotics1 && window.robotics1.ready", timeout=60_000)
    assert frame.evaluate("window.robotics1.app.actors[0].q") == pytest.approx(Q)
    tall = page.tab.evaluate("[...document.querySelectorAll('math')].map(m => m.getBoundingClientRect().height)")
    assert max(tall) > 20
    assert page.faults == []
    page.keep(f"sheet-{width}")


def test_the_command_writes_the_sheet(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["report", "planar_2r", "--q", "0.5,60", "--degrees", "--task", "position:xy", "-p", "l1=0.7"]
    assert answer(*words)["files"] == ["planar_2r-sheet.html"]
    assert "posture q = (0.0087, 1.0472)" in (tmp_path / "planar_2r-sheet.html").read_text(encoding="utf-8")
    assert "there is no folder" in run("report", "planar_2r", "-o", "nowhere/a.html").refusal


@pytest.mark.parametrize("name", ["workspace", "ellipsoids", "scan"])
def test_without_matplotlib_a_section_has_its_numbers_and_says_what_its_figure_needs(name, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    answer = written(Asked(arm("planar_2r"), PLANE, np.array(Q)), name)
    assert "There is no figure: matplotlib is needed for this" in words(answer.html)
    assert answer.fact


def test_a_sheet_takes_the_short_form_of_a_task():
    assert "Task r = (x)" in r1.report("planar_2r", task="position:x", time_limit=0.5).html


@pytest.mark.parametrize(("task", "rank"), [("orientation", "rank 1 of 2"), ("position:z", "rank 0 of 1")])
def test_the_ellipsoids_of_a_task_that_never_has_full_rank_are_drawn(task, rank):
    asked = Asked(r1.load_robot("planar_2r"), short_form(task), np.array([0.3, 0.9]), "planar_2r")
    assert ellipsoids(asked).fact == f"σ_max/σ_min = ∞, since J has {rank} at the posture"
