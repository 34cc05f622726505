"""Inverse formulas of drawn arms: twists, offsets, bases and tools at angles; as many solutions as there are."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st

from robotics1 import FormulaError, IKStatus, TaskError, ik_solutions, robot_from_dh
from robotics1.ik import ik_formulas
from robotics1.tasks.given import robot_and_task

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
    robot, task = robot_and_task(drawn_arm(rng, kind), "position" if len(kind) == 3 else plane)
    try:
        formulas = ik_formulas(robot, task)
    except (FormulaError, TaskError) as error:
        J = task.jacobian(robot, rng.uniform(-1, 1, robot.nq))
        moving = np.abs(J).max(axis=0) > 1e-9
        if isinstance(error, TaskError):
            assert np.linalg.matrix_rank(J[:, moving], tol=1e-9) < max(moving.sum(), 1)
        else:
            assert "polynomial" in str(error)
        return
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
    robot, task = robot_and_task(robot_from_dh(rows, tool_placement=tool), "planar-pose")
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
