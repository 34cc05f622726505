"""Inverse formulas where the target is given in polar or cylindrical coordinates."""

from math import pi

import numpy as np
import pytest
import sympy
from formula_values import real

import robotics1 as r1
from robotics1.ik import ik_formulas
from robotics1.tasks import CylindricalTask, PolarTask
from robotics1.textbook_robots import planar_arm

H = pi / 2
ARMS = {
    "RPP": [("R", 0, 0, 0, 0), ("P", 0, H, 0, H), ("P", 0, 0, 0, 0)],
    "RPP, its slide beside the axis": [("R", 0.1, 0, 0.2, 0), ("P", 0, H, 0, H), ("P", 0.05, 0, 0, 0)],
    "RRP": [("R", 0, H, 1, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)],
    "RRR, its elbow beside the axis": [("R", 0.1, H, 0.4, 0), ("R", 0.5, 0, 0.1, 0), ("R", 0.4, 0, 0, 0)],
}


@pytest.mark.parametrize("rows", ARMS.values(), ids=ARMS)
def test_cylindrical_formulas_are_those_of_the_point_and_none_is_missing(rows):
    slides = np.array([kind == "P" for kind, *_ in rows])
    robot = r1.robot_from_dh(rows, lower=np.where(slides, -3, -pi), upper=np.where(slides, 3, pi))
    found, rng = ik_formulas(robot, CylindricalTask()), np.random.default_rng(2)
    cartesian = ik_formulas(robot, r1.PositionTask())
    assert list(map(str, found.target)) == ["rho", "theta", "z"]
    for q in rng.uniform(-1, 1, (5, robot.nq)):
        x, y, z = r1.forward_kinematics(robot, q).translation
        solutions = found.at([np.hypot(x, y), np.arctan2(y, x), z])
        assert np.sort(solutions, axis=0) == pytest.approx(np.sort(cartesian.at([x, y, z]), axis=0), abs=1e-9)


def test_polar_formulas_of_a_planar_2r_hold_the_law_of_cosines_and_no_angle_in_it():
    """cos q2 = (ρ² − l1² − l2²)/(2 l1 l2)."""
    found = ik_formulas(planar_arm("RR", ["l1", "l2"]), PolarTask())
    l1, l2, rho = real("l1 l2 rho")
    wanted = (rho**2 - l1**2 - l2**2) / (2 * l1 * l2)
    assert [sympy.simplify(sympy.cos(branch.q["q2"]) - wanted) for branch in found.branches] == [0, 0]
    assert [case.condition for case in found.singular_if if case.is_free] == [sympy.Eq(rho, 0)]
    scope = {}
    exec(found.python(), scope)
    angles = scope["inverse_kinematics"]([0.9, 0.3], l1=0.6, l2=0.5)[:, 1]
    assert np.cos(angles) == pytest.approx([(0.81 - 0.61) / 0.6] * 2)


@pytest.mark.parametrize("plane", ["xy", "yx"])
def test_polar_formulas_count_the_angle_from_the_first_axis_of_their_plane(plane):
    robot, task = planar_arm("RR", [0.6, 0.5]), PolarTask(plane)
    target = task.value(robot, [0.4, 0.9])
    found = ik_formulas(robot, task).at(target)
    assert sorted(found[:, 1]) == pytest.approx([-0.9, 0.9])
    assert all(task.error(robot, q, target) == pytest.approx([0, 0], abs=1e-12) for q in found)


def test_a_row_that_is_no_coordinate_is_named_as_the_user_wrote_it():
    task = r1.FunctionTask(lambda p, R, q: np.array([p[0] ** 2, p[1]]), 2)
    with pytest.raises(r1.FormulaError, match=r"a row is px\*\*2"):
        ik_formulas(planar_arm("RR", [0.6, 0.5]), task)
