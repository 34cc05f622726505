import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from math import inf, nan, pi

import numpy as np
import pytest
from arms import arm
from dh_arms import POLAR_ARM, SCARA, dh, srs, ur5
from differences import unitless
from joint_kinds import KINDS

from robotics1 import (
    FunctionTask,
    InputError,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    PositionTask,
    Robotics1Error,
    TaskError,
    UnknownNameError,
    load_robot,
    scan_singularities,
)

XY, POSE = PositionTask("xy"), PoseTask()
SQUARE = FunctionTask(lambda p, R, q: [float(p[0]) ** 2, np.sinh(float(p[1]))], 2)  # no formulas: float of a symbol


def refined(robot, task, **options):
    scan = scan_singularities(robot, task, **({"samples": 20_000, "refine": 30} | options))
    return scan, scan.refined


def check(scan, found):
    """Every configuration is singular: σ_ρ ≤ 1e-10 σ₁ and the rank lower, without units; each start is told once."""
    for group in found.groups:
        for q, gap, rank in zip(group.configurations, group.relative_sigmas, group.ranks, strict=True):
            sigma = np.linalg.svd(unitless(scan.robot, scan.task, q), compute_uv=False)
            assert sigma[scan.rank - 1] <= 1e-10 * sigma[0]
            assert gap <= 1e-10
            assert rank == np.count_nonzero(sigma > 1e-9 * sigma[0]) < scan.rank
            assert scan.robot.within_limits(q) or np.all(scan.robot.revolute)
    starts = sorted([*found.unreached, *(start for group in found.groups for start in group.starts)])
    assert starts == list(range(len(starts)))


def test_planar_2r_is_refined_to_q2_0_and_pi():
    scan, found = refined(arm("planar_2r"), XY)
    check(scan, found)
    values = {tuple(found.branches[group.branch].values.values()) for group in found.groups}
    assert values == {(0,), (pi,)}
    for group in found.groups:
        (q2,) = found.branches[group.branch].values.values()
        assert np.abs(group.configurations[:, 1]) == pytest.approx(np.full(len(group.configurations), q2), abs=1e-9)
    assert (found.missed, found.unreached) == ((), ())


def test_prr_planar_pose_is_refined_to_q2_half_pi():
    scan, found = refined(arm("prr"), PlanarPoseTask("xy"))
    check(scan, found)
    assert all(np.abs(group.configurations[:, 1]) == pytest.approx(pi / 2) for group in found.groups)
    assert {group.branch for group in found.groups} == {0, 1}


def test_ur5_is_refined_to_s3_s5_and_the_shoulder():
    scan, found = refined(ur5(), POSE, samples=200_000, refine=40)
    check(scan, found)
    assert found.unreached == ()
    assert {group.branch for group in found.groups} == set(range(5)) - set(found.missed)
    for group in found.groups:
        q = group.configurations
        where = [str(condition) for condition in found.branches[group.branch].conditions]
        if where[0].startswith("Eq(q3,"):
            assert np.sin(q[:, 2]) == pytest.approx(np.zeros(len(q)), abs=1e-9)
        elif where[0].startswith("Eq(q5,"):
            assert np.sin(q[:, 4]) == pytest.approx(np.zeros(len(q)), abs=1e-9)
        else:
            s234 = np.sin(q[:, 1:4].sum(axis=1))
            shoulder = -0.425 * np.cos(q[:, 1]) - 0.39225 * np.cos(q[:, 1] + q[:, 2]) + 0.09465 * s234
            assert shoulder == pytest.approx(np.zeros(len(q)), abs=1e-8)


def test_a_scara_is_refined_to_its_branches():
    scan, found = refined(dh(*SCARA, a1=0.4, a2=0.3, d1=0.5), POSE, box={"q3": (0.0, 0.3)}, samples=2000)
    check(scan, found)
    assert all(group.branch is not None for group in found.groups)


@pytest.mark.sweep
def test_an_srs_arm_is_refined_to_its_branches():
    scan, found = refined(srs(), POSE)
    check(scan, found)
    assert all(group.branch is not None for group in found.groups)


def test_configurations_that_lead_to_one_place_are_one_with_all_their_starts():
    grid = (1, 41)
    scan, found = refined(arm("planar_2r"), XY, samples=grid, method="grid", box={"q1": (0.3, 0.3)}, refine=8)
    check(scan, found)
    assert len(scan.worst) == 10
    places = sum(len(group.configurations) for group in found.groups)
    starts = sum(len(group.starts) for group in found.groups)
    assert places == 2 < starts == 8


def test_in_a_box_without_singular_configurations_none_is_reached():
    scan, found = refined(arm("planar_2r"), XY, box={"q2": (0.5, 1.0)}, samples=100, refine=10)
    assert found.groups == ()
    assert found.unreached == tuple(range(10))
    assert "None of the 10 worst is next to a singular configuration" in scan.explain()


def test_without_formulas_configurations_are_grouped_by_the_joints_that_stand_still():
    scan, found = refined(arm("planar_2r"), SQUARE, samples=2000, refine=20)
    check(scan, found)
    assert (found.singular_set, found.branches) == (None, ())
    assert "There are no formulas:" in scan.explain()
    for group in found.groups:  # J is diag(2 x, cosh y) J_p: singular where q2 is 0 or π, and where x is 0
        q = group.configurations
        if group.values:
            assert set(group.values) == {"q2"}
            assert np.sin(q[:, 1]) == pytest.approx(np.zeros(len(q)), abs=1e-8)
        else:
            x = [XY.value(scan.robot, one)[0] for one in q]
            assert x == pytest.approx(np.zeros(len(q)), abs=1e-8)
    assert len(found.groups) == 3


def test_a_polar_arm_is_refined_to_its_prismatic_zero():
    scan, found = refined(dh(*POLAR_ARM), PositionTask(), box={"q3": (-0.2, 0.2)}, refine=20)
    check(scan, found)
    places = [found.branches[group.branch].values for group in found.groups]
    assert {"q3": 0.0} in places


def test_the_rank_below_the_rows_counts_for_what_is_singular():
    scan, found = refined(arm("anthropomorphic"), PointingTask("x"), samples=300, refine=5)
    assert scan.rank == 2
    check(scan, found)
    assert "σ_2 is between" in scan.explain()
    assert "The rank of J is 2 almost everywhere" in scan.explain()


def test_what_was_not_refined_is_not_told():
    scan = scan_singularities(arm("prr"), PlanarPoseTask("xy"), samples=100)
    assert scan.refined is None


def test_the_answer_in_sentences():
    scan, _ = refined(arm("planar_2r"), XY, samples=1e4, measures=("sigma_min", "condition", "manipulability"))
    text = scan.explain()
    assert text.splitlines()[0] == "planar_2r, task (x, y): 10000 random configurations; J in SI units."
    assert "The nearest to singular is q = (" in text
    assert f"with σ_min = {scan.worst_values[0]:.4g}." in text
    assert "σ_max/σ_min is between" in text
    assert "the product of the σ is between" in text
    assert "Of the 30 worst, 30 lead to singular configurations:" in text
    assert "on branch 1, q2 = 0:" in text
    with_reach = scan_singularities(arm("prr"), XY, samples=9, length=arm("prr").reach)
    assert "J with lengths in units of" in with_reach.explain()
    assert ", the arm's reach" in with_reach.explain()


# --- misuse


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"samples": 0}, "samples must be an integer of at least 1; it is 0"),
        ({"samples": -5}, "samples must be an integer of at least 1"),
        ({"samples": 2.5}, "samples must be an integer of at least 1; it is 2.5"),
        ({"samples": nan}, "samples must be an integer"),
        ({"samples": inf}, "samples must be an integer"),
        ({"samples": "many"}, "samples must be an integer"),
        ({"samples": None}, "samples must be an integer"),
        ({"samples": (3, 3)}, "samples must be an integer"),
        ({"samples": (3, 3, 3), "method": "grid"}, "of each of 2 joints; samples has 3"),
        ({"samples": (3, 0), "method": "grid"}, r"samples\[1\] must be an integer of at least 1"),
        ({"samples": 3, "method": "grid"}, "a grid over 2 joints has at least 4 configurations; samples is 3"),
        ({"samples": 10**30}, "have no end"),
        ({"samples": 1e300, "method": "sobol"}, "have no end"),
        ({"samples": 10**30, "method": "grid"}, "have no end"),
        ({"samples": (2**40, 2**40), "method": "grid"}, "1099511627776 × 1099511627776 configurations have no end"),
        ({"samples": np.array(2.5), "method": "grid"}, "samples must be an integer"),
        ({"samples": [[1], [2]], "method": "grid"}, r"samples\[0\] must be an integer"),
        ({"samples": True}, "samples must be an integer"),
        ({"method": "halton"}, "method must be one of 'random', 'sobol', 'grid'; it is 'halton'"),
        ({"measures": ("sigma_max",)}, "must be one of 'sigma_min', 'condition', 'manipulability'"),
        ({"measures": "sigma_min"}, "measures must be some of"),
        ({"measures": ()}, "measures must be some of"),
        ({"measures": None}, "measures must be some of"),
        ({"measures": ("condition", "condition")}, "different ones"),
        ({"seed": -1}, "seed must be an integer of at least 0"),
        ({"refine": -1}, "refine must be an integer of at least 0"),
        ({"refine": 1.5}, "refine must be an integer"),
        ({"length": 0}, "length must be a positive number"),
        ({"executor": "processes"}, "executor must be an executor of concurrent.futures, a Dask client"),
        ({"progress": 3}, "progress must be a function"),
        ({"box": {"q2": (1, 0)}}, "the interval of 'q2' must lie in its limits"),
        ({"box": 3}, "box must be a mapping"),
    ],
)
def test_bad_options_are_refused_with_what_would_be_right(options, message):
    with pytest.raises(InputError, match=message):
        scan_singularities(arm("planar_2r"), XY, **({"samples": 10} | options))


def test_a_joint_that_is_none_is_refused():
    with pytest.raises(UnknownNameError, match="'q3'"):
        scan_singularities(arm("planar_2r"), XY, samples=10, box={"q3": (0, 1)})


def test_a_prismatic_joint_without_limits_needs_a_box():
    with pytest.raises(InputError, match="joint 'q3' has no limits: say where to search"):
        scan_singularities(dh(*POLAR_ARM), PositionTask(), samples=10)


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_joints_of_several_degrees_of_freedom_are_refused(kind, tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(KINDS[kind][0], encoding="utf-8")
    with pytest.raises(InputError, match="several degrees of freedom"):
        scan_singularities(load_robot(path), POSE, samples=10)


def test_a_robot_without_joints_has_one_configuration_and_full_rank_there(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text(KINDS["fixed"][0], encoding="utf-8")
    scan = scan_singularities(load_robot(path), POSE, samples=10)
    assert (scan.count, scan.rank, scan.worst.shape) == (1, 0, (1, 0))


def test_a_task_that_nothing_moves_is_refused():
    with pytest.raises(TaskError, match="no joint moves the task at all"):
        scan_singularities(arm("planar_2r"), PositionTask("z"), samples=10)


def test_a_task_that_does_not_fit_and_a_frame_that_is_none_are_refused():
    with pytest.raises(TaskError, match="leaves the xy plane"):
        scan_singularities(arm("spatial"), PlanarPoseTask("xy"), samples=10)
    with pytest.raises(UnknownNameError, match="'tol'"):
        scan_singularities(arm("planar_2r"), PositionTask("xy", frame="tol"), samples=10)
    with pytest.raises(Robotics1Error, match="has several tips"):
        scan_singularities(arm("two_tips"), XY, samples=10)


def test_a_fault_in_a_task_comes_out_with_an_executor_too():
    def broken(p, R, q):
        raise RuntimeError("broken")

    with ThreadPoolExecutor(1) as pool, pytest.raises(TaskError, match="broken"):
        scan_singularities(arm("planar_2r"), FunctionTask(broken, 2), samples=10, executor=pool)


def test_without_numba_a_scan_says_the_same():
    program = """
import sys
sys.modules["numba"] = None
import json
from robotics1 import PoseTask, load_robot, scan_singularities
scan = scan_singularities(load_robot({path!r}), PoseTask(), samples=3000, measures=["sigma_min", "condition"])
print(json.dumps([scan.worst.tolist(), scan.worst_values.tolist(), scan.quantile(0.5, "condition")]))
"""
    robot = arm("redundant")
    run = subprocess.run(
        [sys.executable, "-c", program.format(path=str(robot.path))],
        check=True, capture_output=True, text=True, timeout=300,
    )  # fmt: skip
    worst, values, median = json.loads(run.stdout)
    scan = scan_singularities(robot, POSE, samples=3000, measures=["sigma_min", "condition"])
    assert np.array_equal(scan.worst, worst)
    assert scan.worst_values == pytest.approx(values, rel=0, abs=1e-12)
    assert scan.quantile(0.5, "condition") == pytest.approx(median, rel=1e-12)
