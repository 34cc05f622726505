"""Singular configurations at joint limits, or outside of them by less than 1e-6; and robots without joints."""

from math import acos, cos, pi

import numpy as np
import pytest
import sympy
from arms import arm
from dh_arms import POLAR_ARM
from singular_arms import XY, XYZ
from singular_checks import numbers

from robotics1 import (
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    find_singularities,
    formulas,
    load_robot,
    robot_from_dh,
    scan_singularities,
)
from robotics1.singularities import find_intersections, parameter_conditions

METHODS = ("symbolic", "numeric")


def two_links(lower, upper):
    return robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.1, 0, 0, 0)], lower=[-3, lower], upper=[3, upper])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("lower", "upper", "word", "value"),
    [
        (0.1, 3.14159265, "outside the upper limit", pi),
        (0.1, pi - 9e-7, "outside the upper limit", pi),
        (0.1, pi, "at the upper limit", pi),
        (1e-7, 3, "outside the lower limit", 0),
        (0, 3, "at the lower limit", 0),
        (-3, -1e-8, "outside the upper limit", 0),
    ],
)
def test_a_limit_that_is_rounded_by_less_than_1e_6_leaves_the_branch_and_it_is_said(method, lower, upper, word, value):
    found = find_singularities(two_links(lower, upper), XY, method=method, samples=30)
    (branch,) = found.branches
    assert branch.values["q2"] == pytest.approx(value, abs=1e-9)
    assert word in branch.note
    assert branch.note in found.explain()
    assert "There is no singular configuration" not in found.explain()
    assert branch.rank == 1
    assert all(abs(branch.sample(np.random.default_rng(i))[1] - value) < 1e-9 for i in range(5))


@pytest.mark.parametrize("upper", [3.1415, pi - 2e-6])
def test_a_branch_that_is_further_outside_is_outside(upper):
    found = find_singularities(two_links(0.1, upper), XY)
    assert found.branches == ()
    assert len(found.outside) == 2


def test_inside_the_limits_nothing_is_said_of_them():
    assert [branch.note for branch in find_singularities(two_links(-1, 3.2), XY).branches] == ["", ""]


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("low", [1e-7, 0, -1e-7])
def test_a_slide_whose_limit_is_rounded_is_measured_in_reaches(method, low):
    robot = robot_from_dh(POLAR_ARM, lower=[None, None, low], upper=[None, None, 1.0])
    found = find_singularities(robot, XYZ, method=method, samples=40)
    at = [branch for branch in found.branches if "q3" in branch.values]
    assert len(at) == 1
    assert "the lower limit of q3" in at[0].note
    assert ("outside" in at[0].note) == (low > 0)


def test_a_curved_branch_that_passes_a_corner_outside_by_less_than_1e_6_is_there():
    """0.5 cos q2 + 0.35 cos(q2 + q3) = 0 falls in the (q2, q3) plane: it passes above the corner of the box."""
    q2 = 1.2
    q3 = acos(-0.5 * cos(q2) / 0.35) - q2
    box = {"q2": (q2 - 0.8, q2 - 2e-7), "q3": (q3 - 0.8, q3 - 2e-7)}
    found = find_singularities(arm("anthropomorphic"), XYZ, box=box)
    (shoulder,) = found.branches
    assert "It lies outside the upper limit of q" in shoulder.note
    assert not shoulder.values
    assert found.complete


def test_a_branch_of_two_joints_at_two_limits_names_both():
    robot = robot_from_dh([("R", 1, 0, 0, 0)] * 3, lower=[-3, 1e-8, -3.14159265], upper=[3, 2, 1e-8 - 1])
    found = find_singularities(robot, XY)
    (branch,) = found.branches
    assert branch.values == pytest.approx({"q2": 0, "q3": -pi})
    assert "lower limit of q2" in branch.note
    assert "lower limit of q3" in branch.note


# --- robots without joints


@pytest.fixture
def fixed(tmp_path):
    path = tmp_path / "fixed.urdf"
    path.write_text(
        '<robot name="fixed"><link name="a"/><link name="b"/><joint name="j" type="fixed"><parent link="a"/>'
        '<child link="b"/><origin xyz="1 2 0"/></joint></robot>',
        encoding="utf-8",
    )
    return load_robot(path)


@pytest.mark.parametrize("method", ["auto", *METHODS])
@pytest.mark.parametrize("task", [XY, PoseTask(), PlanarPoseTask("xy")], ids=str)
def test_without_joints_nothing_is_singular(fixed, task, method):
    found = find_singularities(fixed, task, method=method)
    assert (found.generic_rank, found.branches, found.complete) == (0, (), True)
    assert (find_intersections(found).branches, parameter_conditions(found), found.outside) == ((), (), ())
    assert "no joints" in found.explain()
    assert "There is no singular configuration." in found.explain()
    assert isinstance(find_intersections(found).explain(), str)


@pytest.mark.parametrize("method", ["random", "sobol", "grid"])
def test_a_scan_without_joints_has_one_configuration_and_no_singular_value(fixed, method):
    scan = scan_singularities(
        fixed, XY, samples=50, method=method, refine=1, measures=("sigma_min", "condition", "manipulability")
    )
    assert (scan.count, scan.rank, scan.worst.shape) == (1, 0, (1, 0))
    assert [scan.minimum(measure) for measure in scan.measures] == [np.inf, 1, 1]
    assert "no joints" in scan.explain()


def test_formulas_without_joints_are_constants(fixed):
    f = formulas(fixed, XY)
    assert list(f.value) == [1, 2]
    assert (f.jacobian.shape, f.jacobian_rate.shape) == ((2, 0), (2, 0))
    assert list(f.velocity_product) == [0, 0]
    assert f.minors == {(0, 1): 1}
    assert f.gram_determinant == 1
    with pytest.raises(TaskError, match="2 × 0"):
        _ = f.determinant
    space = {}
    exec(f.python(), space)
    assert space["jacobian"]([]).shape == (2, 0)


def test_a_task_that_no_joint_moves_is_still_refused():
    robot = robot_from_dh([("P", 0, 0, 0.1, 0)], lower=[-1], upper=[1])
    with pytest.raises(TaskError, match="no joint moves"):
        find_singularities(robot, PositionTask("xy"))


def test_symbols_of_an_equation_at_a_limit_are_the_joints():
    found = find_singularities(two_links(0.1, 3.14159265), XY)
    assert found.branches[0].conditions == (sympy.Eq(sympy.Symbol("q2", real=True), sympy.pi),)
    assert numbers(found.robot, found.branches[0].formulas.null)([0.1, pi]).shape == (2, 1)
