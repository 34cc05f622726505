"""Inverse formulas of drawn arms: twists, offsets, bases and tools at angles; as many solutions as there are."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from hypothesis import assume, given, strategies as st

from robotics1 import FormulaError, IKStatus, PlanarPoseTask, PositionTask, TaskError, ik_solutions, robot_from_dh
from robotics1.ik import ik_formulas

KINDS = ["RR", "RP", "PR", "PP", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR", "PPP"]
PLANES = ["position:xy", "position:xz", "position:yz"]


def drawn_placement(rng, angles):
    return pin.SE3(pin.rpy.rpyToMatrix(rng.choice(angles, 3)), rng.choice([0, 0.1, 0.25], 3)).homogeneous


def drawn_arm(rng, kind):
    """An arm whose twists are multiples of a right angle, with offsets at every joint."""
    choices = ([0, 0.3, 0.5, -0.4], [0, pi / 2, -pi / 2, pi], [0, 0.2, -0.35], [0, pi / 2, 0.3])
    rows = [(joint, *(float(rng.choice(values)) for values in choices)) for joint in kind]
    base = drawn_placement(rng, [0, pi / 2, -pi / 2, pi]) if rng.random() < 0.4 else None
    tool = drawn_placement(rng, [0, pi / 2, 0.4]) if rng.random() < 0.4 else None
    ends = np.array([pi if joint == "R" else 40.0 for joint in kind])
    return robot_from_dh(rows, base_placement=base, tool_placement=tool, lower=-ends, upper=ends)


def apart(robot, p, q):
    d = p - q
    return np.abs(np.where(robot.revolute, (d + pi) % (2 * pi) - pi, d)).max()


def distinct(robot, found):
    kept = []
    for q in found:
        if all(apart(robot, q, p) > 1e-6 for p in kept):
            kept.append(q)
    return kept


@given(kind=st.sampled_from(KINDS), seed=st.integers(0, 2**20), plane=st.sampled_from(PLANES))
def test_formulas_have_every_solution_of_a_target_and_none_of_one_that_is_not_reached(kind, seed, plane):
    rng = np.random.default_rng(seed)
    robot, task = drawn_arm(rng, kind), PositionTask("xyz" if len(kind) == 3 else plane.partition(":")[2])
    J = task.jacobian(robot, rng.uniform(-1, 1, robot.nq))
    moving = np.abs(J).max(axis=0) > 1e-9
    if np.linalg.matrix_rank(J[:, moving], tol=1e-9) < max(moving.sum(), 1):
        with pytest.raises(TaskError, match="move"):
            ik_formulas(robot, task)
        return
    try:
        formulas = ik_formulas(robot, task)
    except FormulaError:  # a polynomial of a higher degree than two
        assume(condition=False)
    for scale in (1.0, 1.0, 0.5, 1.7):
        q = np.where(robot.revolute, rng.uniform(-pi, pi, robot.nq), rng.uniform(-1.5, 1.5, robot.nq))
        target = scale * task.value(robot, q)
        known = ik_solutions(robot, task, target)
        if known.status is IKStatus.INFINITE:
            continue
        found = distinct(robot, formulas.at(target))
        assert all(np.abs(task.error(robot, p, target)).max() < 1e-7 for p in found)
        assert len(found) == len(distinct(robot, known.q))
        assert all(min(apart(robot, p, other) for other in found) < 1e-5 for p in known.q)


def test_a_frame_whose_x_axis_leaves_the_plane_turns_by_the_angle_of_its_projection():
    tool = pin.SE3(pin.rpy.rpyToMatrix(0.4, 0.7, 0.2), np.array([0.1, 0.0, 0.0])).homogeneous
    rows = [("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0), ("R", 0.1, 0, 0, 0)]
    robot, task = robot_from_dh(rows, tool_placement=tool), PlanarPoseTask()
    q = np.array([0.4, -0.8, 1.1])
    found = ik_formulas(robot, task).at(task.value(robot, q))
    assert len(found) == 2
    assert min(apart(robot, p, q) for p in found) < 1e-9


@pytest.mark.parametrize("language", ["python", "c", "matlab"])
def test_written_functions_refuse_a_target_that_no_joints_have(language):
    formulas = ik_formulas(robot_from_dh([("R", 0.5, pi / 2, 0, 0)]), "position:xy")
    assert len(formulas.constraints) == 1  # a circle
    assert len(formulas.at([0.3, 0.4])) == 1
    assert len(formulas.at([0.3, 0.5])) == 0
    assert "1e-05" in getattr(formulas, language)()


ARMS = {
    "shoulder offset": [("R", 0.1, pi / 2, 0.4, 0), ("R", 0.8, 0, 0.15, 0), ("R", 0.7, 0, 0.05, 0)],
    "orthogonal": [("R", 0, pi / 2, 0, 0), ("R", 0.4, pi / 2, 0, 0), ("R", 0.3, 0, 0.1, 0)],
    "polar": [("R", 0.1, pi / 2, 0.4, 0), ("R", 0.2, pi / 2, 0, 0), ("P", 0, 0, 0, 0)],
    "RPR": [("R", 0.3, -pi / 2, 0.3, 0), ("P", 0, 0, 0, 0), ("R", 0.2, 0, 0.1, 0)],
    "PRR": [("P", 0, pi / 2, 0, pi / 2), ("R", 0.2, -pi / 2, 0.1, 0), ("R", 0.3, 0, 0, 0)],
}


@pytest.mark.parametrize("name", ARMS)
def test_a_branch_exists_where_its_condition_on_the_target_alone_holds(name):
    formulas, rng = ik_formulas(robot_from_dh(ARMS[name]), "position"), np.random.default_rng(2)
    conditions = [branch.exists_if for branch in formulas]
    assert all(condition.free_symbols <= set(formulas.target) for condition in conditions)
    met = []
    for scale in np.linspace(0.2, 2.5, 6):
        target = scale * formulas.task.value(formulas.robot, rng.uniform(-1, 1, 3))
        at = dict(zip(formulas.target, map(float, target), strict=True))
        for branch, condition in zip(formulas, conditions, strict=True):
            values = [complex(q.subs(at)) for q in branch.q.values()]
            met.append(max(abs(value.imag) for value in values) < 1e-9)
            assert bool(condition.subs(at)) is met[-1]
    assert met.count(True) > 3


def test_conditions_on_the_target_have_the_root_of_a_shoulder_with_an_offset():
    lengths = {"a1": 0.1, "d2": 0.2, "a2": 0.8, "a3": 0.7}
    rows = [("R", "a1", pi / 2, 0, 0), ("R", "a2", 0, "d2", 0), ("R", "a3", 0, 0, 0)]
    formulas = ik_formulas(robot_from_dh(rows, parameters=lengths), "position")
    a1, d2, x, y, z = sympy.symbols("a1 d2 x y z", real=True)
    radius = sympy.sqrt(x**2 + y**2 - d2**2)
    where = {case.condition.lhs for case in formulas.singular_if if case.is_free and case.joint == "q2"}
    assert {sympy.expand(e) for e in where} == {sympy.expand((sign * radius - a1) ** 2 + z**2) for sign in (1, -1)}


def test_a_boundary_is_where_two_solutions_are_one_and_they_exist_on_one_side_of_it():
    formulas = ik_formulas(robot_from_dh(ARMS["shoulder offset"]), "position")
    for radius, count in ((0.2 - 1e-6, 0), (0.2 + 1e-6, 4)):  # of the cylinder about the first axis
        assert len(formulas.at([radius, 0.0, 1.5])) == count
