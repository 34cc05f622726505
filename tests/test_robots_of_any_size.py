"""Robots with lengths and angles of any size: each question ends in an answer or in one of our errors."""

import contextlib
from math import pi

import numpy as np
import pytest
from hypothesis import given, strategies as st

import robotics1 as r1

SIZES = [5e-324, 1e-300, 1e-200, 1e-100, 1e-12, 1e-6, 0.5, 1.0, 12345.678, 1e8, 1e12, 2e15, 1e18]
size = st.sampled_from(SIZES).flatmap(lambda x: st.sampled_from([x, -x]))
number = st.one_of(st.just(0.0), size)
angle = st.one_of(st.sampled_from([0.0, pi / 2, -pi / 2, pi, 0.3]), size)
row = st.tuples(st.sampled_from("RRP"), number, angle, number, angle)
QUESTIONS = {
    "forward_kinematics": lambda robot, task, q, r: r1.forward_kinematics(robot, q),
    "frame_jacobian_rate": lambda robot, task, q, r: r1.frame_jacobian_rate(robot, q, q),
    "subspaces": lambda robot, task, q, r: r1.subspaces(task.jacobian(robot, q)),
    "formulas": lambda robot, task, q, r: r1.formulas(robot, task).determinant,
    "urdf_to_dh": lambda robot, task, q, r: r1.dh.urdf_to_dh(robot),
    "find_singularities": lambda robot, task, q, r: r1.find_singularities(robot, task, time_limit=1).explain(),
    "scan_singularities": lambda robot, task, q, r: r1.scan_singularities(robot, task, samples=20),
    "iterate_ik": lambda robot, task, q, r: r1.iterate_ik(robot, task, r, q),
    "solve_ik": lambda robot, task, q, r: r1.solve_ik(robot, task, r, time_limit=0.1),
    "ik_solutions": lambda robot, task, q, r: r1.ik_solutions(robot, task, r),
}


@pytest.mark.parametrize("question", list(QUESTIONS))
@given(rows=st.lists(row, min_size=1, max_size=2), data=st.data())
def test_numbers_of_any_size_end_in_an_answer_or_in_a_typed_error(question, rows, data):
    task = r1.PositionTask("xy"[: len(rows)])
    q = np.array([data.draw(number) for _ in rows])
    r = np.array([data.draw(number) for _ in rows])
    with np.errstate(all="ignore"), contextlib.suppress(r1.Robotics1Error):
        QUESTIONS[question](r1.robot_from_dh(rows), task, q, r)
