"""The benchmarks count a failure as a failure: wrong solvers are planted, and none of the peers is needed."""

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))

from benchmarks.arms import Arm, kinematic_urdf, panda, ur5
from benchmarks.ik_tables import Measured
from benchmarks.interleaved import Run, ratios, run_interleaved, score
from benchmarks.inverse_kinematics import available_arms
from benchmarks.peers import CHAN, NotThisArmError, Solver, make_solver
from benchmarks.peers.forward_sampling import by_loop
from benchmarks.report import at_least, at_most
from benchmarks.singular_targets import FAMILIES, jacobian, singular_configurations
from benchmarks.workloads import NEAR, Workload, far, singular, tracking
from benchmarks.workspaces import by_peer
from robotics1 import PoseTask
from robotics1.workspaces import reachability_map

COUNT = 12


@pytest.fixture(scope="module")
def arm() -> Arm:
    return ur5()


@pytest.fixture(scope="module")
def known(arm) -> tuple[Workload, dict[int, np.ndarray]]:
    """Targets with a q of each, by the target's number."""
    rng = np.random.default_rng(7)
    goals = [arm.random(rng) for _ in range(COUNT)]
    starts = np.array([arm.random(rng) for _ in range(COUNT)])
    return Workload(arm, [arm.pose(q) for q in goals], starts), dict(enumerate(goals))


def run(solve, workload, every=1):
    """The score of a solver that is given the number of the target."""
    numbers = {id(T): i for i, T in enumerate(workload.targets)}
    solver = Solver(solve, lambda T: numbers[id(T)], every)
    return score(run_interleaved({"solver": solver}, workload)["solver"], workload)


def test_a_solver_that_returns_its_start_solves_nothing(known):
    workload, _ = known
    s = run(lambda i, q0: q0, workload)
    assert (s.success, s.solved, s.missed, s.gave_up, s.outside) == (0.0, 0, COUNT, 0, 0)


def test_a_solver_that_knows_the_answer_solves_all(known):
    workload, goals = known
    s = run(lambda i, q0: goals[i], workload)
    assert (s.success, s.solved, s.missed, s.gave_up, s.outside) == (100.0, COUNT, 0, 0, 0)


def test_a_whole_turn_outside_the_limits_is_no_success(known):
    workload, goals = known
    s = run(lambda i, q0: goals[i] + np.array([0, 0, 4 * np.pi, 0, 0, 0]), workload)
    assert (s.success, s.outside, s.missed) == (0.0, COUNT, 0)


def test_an_answer_of_nan_misses(known):
    workload, _ = known
    assert run(lambda i, q0: np.full(6, np.nan), workload).missed == COUNT


@pytest.mark.parametrize(("turn", "solved"), [(0.9e-4, COUNT), (1.1e-4, 0)])
def test_the_tolerance_is_1e_4_rad(known, turn, solved):
    """Turning joint 6 turns the tool about its own axis, through its origin."""
    workload, goals = known
    s = run(lambda i, q0: goals[i] + np.array([0, 0, 0, 0, 0, turn]), workload)
    assert (s.solved, s.missed) == (solved, COUNT - solved)


def test_a_solver_that_gives_up_is_counted_with_its_time(known):
    workload, _ = known
    s = run(lambda i, q0: None, workload, every=2)
    assert (s.targets, s.gave_up, s.success) == (COUNT // 2, COUNT // 2, 0.0)
    assert s.median > 0


def order_of_calls(names, workload, in_a_row):
    """Who is called one after the other while the clock runs."""
    calls = []
    solvers = {name: Solver(lambda T, q0, name=name: calls.append(name), lambda T: T) for name in names}
    runs = run_interleaved(solvers, workload, in_a_row)
    assert all(run.indices == list(range(COUNT)) for run in runs.values())
    return calls[-COUNT * len(names) :]


def test_each_solver_follows_each_other(known):
    """In a fixed order a solver would always find the same other's code in the caches."""
    pairs = set(pairwise(order_of_calls("abc", known[0], 1)))
    assert {(a, b) for a in "abc" for b in "abc" if a != b} <= pairs


def test_calls_in_a_row_are_of_one_solver(known):
    half = COUNT // 2
    calls = order_of_calls("ab", known[0], half)
    assert {"".join(calls[i : i + half]) for i in range(0, len(calls), half)} == {"a" * half, "b" * half}


def test_failures_are_written_in_bold_and_absent_solvers_have_a_row(known):
    workload, _ = known
    runs = run_interleaved({CHAN: Solver(lambda T, q0: q0, lambda T: T)}, workload)
    text = Measured("UR5", "far start", workload, runs, {"optik": "absent: no module"}).table
    rows = {line.split(" | ")[0].lstrip("| "): line for line in text(solvers=(CHAN, "optik")).splitlines()}
    assert f"| {COUNT} | **0.00** | 0 | **{COUNT}** | 0 |" in rows[CHAN]
    assert "absent: no module" in rows["optik"]


def test_a_peer_that_cannot_be_imported_is_told(arm, monkeypatch):
    monkeypatch.setitem(sys.modules, "optik", None)
    assert "absent" in make_solver("optik", arm)


def test_a_peer_without_the_arm_is_told(arm, monkeypatch):
    def refuse(arm):
        raise NotThisArmError("another arm")

    monkeypatch.setattr("benchmarks.peers.optik.make", refuse)
    assert make_solver("optik", arm) == "another arm"


def test_an_arm_that_cannot_be_had_is_a_target_not_measured(arm, monkeypatch):
    def absent():
        raise ImportError("the package rtb-data is not installed")

    monkeypatch.setattr("benchmarks.inverse_kinematics.ARMS", {"UR5": lambda: arm, "iiwa": absent})
    arms, targets = available_arms()
    assert arms == {"UR5": arm}
    assert [t.row()[-1] for t in targets] == ["**not measured**"]


def test_ratios_compare_the_same_targets():
    ours = Run([0, 1, 2, 3], np.array([1.0, 100, 2, 100]), np.array([1.0, 100, 3, 100]), [None] * 4)
    theirs = Run([0, 2], np.array([4.0, 8]), np.array([4.0, 12]), [None] * 2)
    assert ratios(theirs, ours) == (4.0, 4.0)


def test_targets_say_met_missed_or_not_measured():
    assert at_least("work", 3, 3.0).row()[-1] == "met"
    assert at_least("work", 3, 2.999).row()[-1] == "**missed**"
    assert at_most("work", 15, 15.1, " µs").row()[-1] == "**missed**"
    assert at_most("work", 15, None, " µs").row()[2:] == ["–", "**not measured**"]


def test_targets_at_singularities_are_singular_and_inside_the_limits(arm):
    for some in (arm, panda()):
        found = singular_configurations(some, 2 * len(FAMILIES[some.name]), np.random.default_rng(0))
        for q in found:
            sigma = np.linalg.svd(jacobian(some, q), compute_uv=False)
            assert sigma[-1] < 1e-12
            assert some.inside(q)


def test_workloads_start_inside_the_limits_and_tracking_near(arm):
    for make in (far, tracking, singular):
        workload = make(arm, COUNT)
        assert all(arm.inside(q) for q in workload.starts)
        assert len(workload.targets) == COUNT
    near = tracking(arm, COUNT)
    for q, T in zip(near.starts, near.targets, strict=True):
        assert 0 < np.linalg.norm(pin.log3(arm.pose(q).rotation.T @ T.rotation)) < 6 * NEAR


def test_the_urdf_of_the_peers_keeps_joints_only():
    text = (
        "<robot name='r'><link name='a'><visual/></link><material name='m'/>"
        "<joint name='j'><axis xyz='0 0 1'/><safety_controller/></joint></robot>"
    )
    joint = '<joint name="j"><axis xyz="0 0 1" /></joint>'
    assert kinematic_urdf(text) == f'<robot name="r"><link name="a" />{joint}</robot>'


def test_sampling_puts_the_tool_where_pinocchio_has_it(arm):
    q = np.array([arm.random(np.random.default_rng(i)) for i in range(5)])
    assert by_loop(arm)(q) == pytest.approx(np.array([arm.pose(x).translation for x in q]), abs=1e-12)


def test_the_shares_of_a_peer_that_reaches_nothing_are_zero(arm):
    known = reachability_map(arm.robot, PoseTask(), [[0.4, 0.1, 0.3]], 4)
    nothing, asked = by_peer(arm, Solver(lambda target, q0: None, lambda T: T), known, 60.0)
    own, _ = by_peer(arm, Solver(lambda target, q0: known.q[0], lambda T: T), known, 60.0)
    assert asked.all()
    assert not nothing.any()
    assert np.flatnonzero(own[0]).tolist() == [known.orientation[0]]  # q reaches the orientation that it belongs to
