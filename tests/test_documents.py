"""The code of every page in docs/ runs, what it asserts holds, and its results are those that the page says."""

import re
import shutil
from math import pi, sqrt
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import sympy

from robotics1 import Formulas
from robotics1.trajectories import FollowingStatus, RateStatus

DOCS = Path(__file__).parents[1] / "docs"
DESCRIPTIONS = Path(__file__).parent / "descriptions"  # in the manner of the makers' own


def text(name):
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


def blocks(name, language="python"):
    return re.findall(rf"```{language}\n(.*?)```", text(name), flags=re.DOTALL)


PAGES = [page.stem for page in sorted(DOCS.glob("*.md")) if blocks(page.stem)]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Return a function that runs a page, once, in an empty folder: the names after each block, and the folder."""
    done = {}

    def run_page(name):
        if name not in done:
            folder = tmp_path_factory.mktemp(name)
            if name == "official_descriptions":
                shutil.copytree(DESCRIPTIONS, folder, dirs_exist_ok=True)
            scope, after = {"__name__": "__main__"}, []
            with pytest.MonkeyPatch.context() as patch:
                patch.chdir(folder)
                for block in blocks(name):
                    exec(compile(block, f"{name}.md", "exec"), scope)
                    after.append(SimpleNamespace(**scope))
            done[name] = (after, folder)
        return done[name]

    return run_page


@pytest.mark.parametrize("name", PAGES)
def test_the_code_of_a_page_runs_and_what_it_asserts_holds(run, name):
    after, _ = run(name)
    assert len(after) == len(blocks(name))


def test_the_page_on_robots_says_what_a_loaded_robot_has(run):
    page = run("robots")[0][-1]
    assert page.robot.parameters == {"l2": 0.5, "l3": 0.4}


def test_the_page_on_official_descriptions_loads_an_arm_of_each_maker(run):
    page = run("official_descriptions")[0][-1]
    joints = {
        **{"ur5e": 3, "left": 3, "fr3": 2, "with_hand": 2, "gen3": 7, "gen3_6": 6, "xarm7": 7, "xarm6": 6, "m1013": 2},
        **{"vx300s": 1, "m10ia": 2, "irb2400": 2, "kr10": 2},
    }
    assert {name: getattr(page, name).nq for name in joints} == joints


def test_the_page_on_dh_tables_says_what_it_prints(run):
    after, folder = run("dh_tables")
    page = after[-1]
    assert page.T.translation == pytest.approx([0.616243, 0.190626, 0.632169], abs=1e-6)
    assert (folder / "camera_arm.urdf").is_file()
    assert [printed.strip() for printed in blocks("dh_tables", "text")] == [str(page.table)]
    assert page.again.nv == 3


def test_the_page_on_formulas_names_attributes_that_exist():
    named = set(re.findall(r"`f\.(\w+)", text("formulas")))
    assert {"value", "jacobian", "determinant", "minors", "jacobian_rate", "velocity_product", "python"} <= named
    assert named <= {*Formulas.__dataclass_fields__, *dir(Formulas)}


def test_the_page_on_orientation_says_what_it_finds(run):
    after, _ = run("orientation")
    page = after[-1]
    assert len(after) == 11
    assert after[1].found.solutions == pytest.approx(np.array([[0.4, 0.7, -0.9], [-2.7416, 2.4416, 2.2416]]), abs=1e-4)
    assert f"{after[1].rpy.correction:.1e}" == "2.2e-05"
    assert after[2].found.combination == (1, 0, -1)
    assert after[2].found.combined == pytest.approx(0.3)
    assert page.f.determinant == sympy.cos(sympy.Symbol("b", real=True))
    assert [case.value for case in page.f.singular] == [sympy.pi / 2, -sympy.pi / 2]
    assert page.rates.rates == pytest.approx([0.5, 0, 0.5])
    assert page.rates.unproduced == pytest.approx(page.rates.lost)
    assert page.turn.angle == pytest.approx(2.5936, abs=1e-4)
    assert page.turn.axis == pytest.approx([-0.6786, -0.6786, 0.2811], abs=1e-4)
    assert page.omega == sympy.Matrix([0, 0, 1])
    assert page.aim.at(0.5) @ [0, 0, 1] == pytest.approx([1 / 3, 2 / 3, 2 / 3])
    assert page.frame.exact
    assert page.pi == pi


def test_the_page_on_paths_says_what_it_finds(run):
    after, folder = run("paths")
    page = after[-1]
    assert page.frame.curvature == pytest.approx(0.3 / 0.1)
    assert page.bounds.velocity == pytest.approx(1 / sqrt(0.1))
    assert sorted(file.name for file in folder.iterdir()) == ["law.svg", "motion.svg", "path.svg"]


def test_the_page_on_differential_kinematics_says_what_it_finds(run):
    after, folder = run("differential_kinematics")
    page = after[-1]
    assert page.lost.status is RateStatus.OUT_OF_RANGE
    assert page.run.status is FollowingStatus.FOLLOWS
    assert (folder / "joints.svg").is_file()


def test_the_page_on_timing_says_which_peaks_switching_times_and_durations_it_finds(run):
    page = run("timing")[0][-1]
    assert (page.law.peak(1).value, page.law.peak(1).time) == pytest.approx((2.25, 1.0))
    assert (page.law.peak(2).value, page.law.peak(2).time) == (4.5, 0.0)
    trapezoid = page.trapezoid
    assert trapezoid.breakpoints == pytest.approx([1, 3])
    assert (trapezoid.acceleration(1.0), trapezoid.acceleration(1.0, side="left")) == (0, 1)
    coefficients = [piece.coefficients_t for piece in trapezoid.pieces]
    assert np.array(coefficients) == pytest.approx(np.array([[0, 0, 0.5], [0.5, 1, 0], [2.5, 1, -0.5]]))
    phases = [phase.duration for phase in page.smooth.laws[0].phases]
    assert phases == pytest.approx([0.4, 0.1, 0.4, 0.6, 0.4, 0.1, 0.4])
    assert page.back.duration == pytest.approx(1 + 2 * sqrt(1.5))
    assert pytest.approx(1.490, abs=5e-4) == page.T


def test_the_page_on_timing_says_which_bounds_are_active(run):
    page = run("timing")[0][-1]
    answer = page.answer
    assert answer.duration == pytest.approx(1.5)
    assert answer.joint_durations == pytest.approx([1.5, 1.0])
    assert answer.slack == pytest.approx([0, 0.5])
    assert not answer.unique
    assert [str(demand) for demand in answer.active] == [
        "joint 0's velocity is 1 at t = 0.5 s, its limit 1",
        "joint 0's acceleration is 2 at t = 0 s, its limit 2",
    ]
    assert page.scaling.factor == pytest.approx(1.5)
    assert [demand.quantity for demand in page.scaling.active] == ["velocity"]
    assert page.slower.factor == pytest.approx(2)


def test_the_page_on_splines_says_what_it_finds(run):
    page = run("splines")[0][-1]
    times, spline = page.times, page.spline
    assert spline.velocity(times)[[0, -1]] == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    assert spline.breakpoints == pytest.approx(times[1:-1])
    assert page.moving.velocity(0) == pytest.approx([0.3, 0])
    first, second = (piece.coefficients_t[:, 0] for piece in page.via.pieces)
    assert first == pytest.approx([0, 0, 1], abs=1e-12)
    assert second[:2] == pytest.approx([1, 2])
    assert np.abs(page.fastest.trajectory.extremes(1)[1]).max() <= 1 + 1e-9
    assert page.T > 0


def test_the_page_on_redundancy_says_what_it_finds(run):
    page = run("redundancy")[0][-1]
    assert page.moved.qdot == pytest.approx([-0.0977, -0.2771, 0.4279], abs=5e-5)
    assert page.moved.objective == pytest.approx(0.6645, abs=5e-5)
    assert page.moved.gradient == pytest.approx([0, 0.3856, -0.2692], abs=5e-5)
    assert [level.status.name for level in page.found.levels] == ["REALISED", "REALISED"]
    assert page.conflict.levels[1].status.name == "IN_CONFLICT"
    assert page.conflict.levels[1].residual == pytest.approx([0.7])
    assert (page.held.status.name, page.held.scale) == ("SATURATED", 1)
    assert page.held.saturated.tolist() == [False, True, False]
    assert page.fast.status.name == "SCALED"
    assert page.fast.scale < 1
    assert page.sns.steps[0].critical == 1
    assert page.slow.scales.min() < 1
    formula = page.sympy.cos(page.q3) * page.l / (page.l**2 + 1)
    assert page.sympy.simplify(page.f.pseudoinverse[2, 1] - formula) == 0


def test_the_page_on_control_says_what_it_finds(run):
    page = run("control")[0][-1]
    assert page.law.formula() == "q̇ = J⁻¹(q) (ṙ_d + K (r_d − f(q))), K = [[4, 1], [1, 3]]"
    assert page.law.explain().endswith("; ė = −K e")
    assert page.control.gains_for_decay(0.05, 2.0).K == pytest.approx(np.log(20) / 2)
    assert page.held.saturated.tolist() == [True, False]
    assert page.gradient.explain().startswith("q̇ = Jᵀ K e: V = ½ eᵀ K e, V̇ = −|Jᵀ K e|²; ")
    assert page.stuck.status.name == "STUCK"
