"""Closed formulas of the direction of an axis, alone and with a point: against the geometry, and against numbers."""

from math import pi

import numpy as np
import pytest
import sympy
from brute_force import apart
from test_all_solutions import GANTRY, ORTHOGONAL, PUMA, STANFORD, H, P, R, robot_of

from robotics1 import FormulaError, PointingTask, PositionTask, StackedTask, TaskError, ik_solutions
from robotics1.ik import ik_formulas

POINT_AND_AXIS = StackedTask((PositionTask(), PointingTask("z")))
PAN_TILT = [R(0, H, 0.5), R(0.7, 0, 0)]
SKEW = [R(0, 0.7, 0.5), R(0.7, 0.4, 0)]


@pytest.mark.parametrize(("axis", "side"), [("x", 1), ("-x", -1)])
def test_a_camera_on_two_axes_pans_and_tilts(axis, side):
    """r = ±(c₁c₂, s₁c₂, s₂): q2 is the height, q1 the direction on the ground, or both over the top."""
    robot = robot_of(PAN_TILT)
    found = ik_formulas(robot, PointingTask(axis))
    d = np.array([0.48, 0.36, 0.8])
    height, heading = np.arcsin(side * d[2]), np.arctan2(side * d[1], side * d[0])
    expected = {(heading, height), (np.angle(np.exp(1j * (heading + pi))), pi - height)}
    assert {tuple(np.round(q, 12)) for q in found.at(d)} == {tuple(np.round(q, 12)) for q in expected}


def test_the_direction_along_the_first_axis_leaves_its_joint_free():
    found = ik_formulas(robot_of(PAN_TILT), PointingTask("x"))
    [q1] = [joint for joint in found.joints if joint.q.name == "q1"]
    assert str(q1.free_if) in ("Eq(cos(q2), 0)", "Eq(-cos(q2), 0)")


@pytest.mark.parametrize("rows", [PAN_TILT, SKEW], ids=["right angles", "skew"])
@pytest.mark.parametrize("seed", range(3))
def test_every_direction_of_an_arm_has_two_solutions_that_point_there(rows, seed):
    robot, task = robot_of(rows), PointingTask("x" if rows is PAN_TILT else "z")
    q = np.random.default_rng(seed).uniform(-3, 3, 2)
    target = task.value(robot, q)
    found = ik_formulas(robot, task).at(target)
    assert len(found) == 2
    assert min(np.abs(np.angle(np.exp(1j * (p - q)))).max() for p in found) < 1e-9
    for p in found:
        assert task.value(robot, p) == pytest.approx(target, abs=1e-9)


@pytest.mark.parametrize(("rows", "count"), [(PUMA, 8), (STANFORD, 8), (GANTRY, 2)], ids=["Puma", "Stanford", "gantry"])
def test_a_point_and_an_axis_leave_the_last_joint_of_a_wrist_free(rows, count):
    robot = robot_of(rows)
    formulas = ik_formulas(robot, POINT_AND_AXIS)
    assert formulas.free_joints == ("q6",)
    assert len(formulas) == count
    q = np.array([0.3, 0.7, 0.4, 0.5, 0.8, 0])
    target = POINT_AND_AXIS.value(robot, q)
    found = formulas.at(target)
    assert len(found) == count
    assert apart([row[0] for row in rows[:5]], q[:5], found[:, :5]).min() < 1e-8
    for p in found:
        assert POINT_AND_AXIS.value(robot, p) == pytest.approx(target, abs=1e-9)


def test_as_many_directions_as_a_search_finds():
    robot, task = robot_of(SKEW), PointingTask("z")
    target = task.value(robot, [0.4, 1.1])
    assert len(ik_solutions(robot, task, target, starts=30)) == len(ik_formulas(robot, task).at(target)) == 2


@pytest.mark.parametrize("rows", [ORTHOGONAL, [R(0.3, 0.7, 0.2), P(0.4), R(0.4, 0, 0)]], ids=["orthogonal", "slide"])
def test_without_a_closed_formula_a_polynomial_of_degree_four_vanishes_at_every_solution(rows):
    robot = robot_of(rows)
    with pytest.raises(FormulaError, match=r"no closed formula.* What is left: .* of degree 4") as raised:
        ik_formulas(robot, PositionTask())
    error, i = raised.value, int(raised.value.joint[1:]) - 1
    assert error.polynomial.degree() == 4
    x, y, z = sympy.symbols("x y z", real=True)
    target = PositionTask().value(robot, [0.4, -1.2, 2.0])
    roots = np.roots([float(c.subs(dict(zip((x, y, z), target, strict=True)))) for c in error.polynomial.all_coeffs()])
    found = ik_solutions(robot, PositionTask(), target)
    assert found.complete
    for q in [*found.q, *found.outside_limits]:
        assert np.abs(roots - (np.tan(q[i] / 2) if rows[i][0] == "R" else q[i])).min() < 1e-6


def test_three_joints_for_a_direction_are_refused_or_need_another_row():
    with pytest.raises(TaskError, match="the rank of its Jacobian is 2 at most"):
        ik_formulas(robot_of([R(0, H, 0.4), R(0.5, 0, 0), R(0.35, 0, 0)]), PointingTask("x"))
