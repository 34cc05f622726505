"""Singular sets and formulas of unusual arms: in their time, with numbers of any size, with names of any kind."""

import threading
import time
from math import pi

import numpy as np
import pytest
import sympy
from dh_arms import TWISTED, H, dh
from hypothesis import given, settings, strategies as st
from singular_checks import rank, usual_sigma

from robotics1 import (
    FormulaError,
    PointingTask,
    PoseTask,
    PositionTask,
    find_singularities,
    formulas,
    load_robot,
    robot_from_dh,
)

# --- time

FIVE = [
    ("R", -19.5752, H, -35.0564, H),
    ("R", -19.5057, -H, 0, H),
    ("R", -23.7971, -H, 0, 0),
    ("R", -0.1835, H, 10.4142, 0),
    ("R", 12.0933, -H, 0, 0),
]
OBLIQUE = [("R", 0.3, 0.7, 0.2, 0.1), ("R", 0.4, 1.1, 0.3, 0), ("R", 0.2, 0.4, 0.1, 0)]
SIX = [("R", *np.random.default_rng(1).uniform(-1, 1, (6, 4))[i]) for i in range(6)]
FORTY = [("R", 0.3, 0.7 * (-1) ** i, 0.2, 0.1) for i in range(40)]


@pytest.mark.parametrize(
    ("rows", "task", "method"),
    [
        (FIVE, PositionTask(), "auto"),
        (OBLIQUE, PointingTask("z"), "auto"),
        (SIX, PoseTask(), "auto"),
        (FORTY, PositionTask(), "auto"),
        (FORTY, PositionTask(), "numeric"),
    ],
    ids=["5R", "pointing", "6R", "40R", "40R by numbers"],
)
def test_the_time_limit_is_kept_in_any_thread_and_the_answer_says_that_it_is_not_complete(rows, task, method):
    robot = robot_from_dh(rows)
    answers = []
    limit = 1.5

    def work():
        start = time.monotonic()
        found = find_singularities(robot, task, method=method, time_limit=limit)
        answers.append((time.monotonic() - start, found))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join(30)
    ((seconds, found),) = answers
    assert seconds <= 1.2 * limit + 1  # a busy machine
    assert found.complete or "not complete" in found.note or "no formulas" in found.note or method == "numeric"
    usual = usual_sigma(robot, task)
    for branch in found.branches:
        assert rank(robot, task, branch.q, usual) < found.generic_rank


# --- numbers of any size

SKEW = """<robot name="skew"><link name="b"/><link name="l1"/><link name="l2"/><link name="l3"/><link name="tool"/>
<joint name="j1" type="continuous"><parent link="b"/><child link="l1"/><axis xyz="{}"/></joint>
<joint name="j2" type="continuous"><parent link="l1"/><child link="l2"/><origin xyz="-.6 0 0" rpy="{}"/>
<axis xyz="0 0 -1"/></joint>
<joint name="j3" type="continuous"><parent link="l2"/><child link="l3"/><origin xyz="-.5 0 0" rpy="{}"/>
<axis xyz="{}"/></joint>
<joint name="t" type="fixed"><parent link="l3"/><child link="tool"/><origin xyz=".3 0 0"/></joint></robot>"""
numbers = st.integers(-13, 13).map(lambda k: k / 10)
triples = st.tuples(numbers, numbers, numbers)
axes = triples.filter(lambda v: np.linalg.norm(v) > 0.1)


@settings(max_examples=8)
@given(axes, triples, triples, axes)
def test_an_arm_of_skew_axes_has_a_singular_set(tmp_path_factory, first, rpy2, rpy3, third):
    path = tmp_path_factory.mktemp("skew") / "skew.urdf"
    path.write_text(SKEW.format(*(" ".join(map(str, v)) for v in (first, rpy2, rpy3, third))), encoding="utf-8")
    robot, task = load_robot(path), PositionTask("xy")
    found = find_singularities(robot, task, time_limit=1, samples=10)
    usual = usual_sigma(robot, task)
    for branch in found.branches:
        assert rank(robot, task, branch.q, usual) == branch.rank < found.generic_rank


def test_the_skew_arm_whose_coefficients_have_hundreds_of_digits_has_an_answer(tmp_path):
    path = tmp_path / "skew.urdf"
    path.write_text(SKEW.format(".7 .6 .3", ".3 0 0", "1.2 .99 .02", ".3 -1.2 .6"), encoding="utf-8")
    found = find_singularities(load_robot(path), PositionTask("xy"), time_limit=4, samples=10)
    assert found.generic_rank == 2
    assert all(np.isfinite(branch.samples).all() for branch in found.branches)


class SlowOnceSingular:
    """The position of a planar 2R. Once J has been singular, and asked for 100 times more, each J takes 50 ms."""

    def __init__(self):
        self.task, self.left = PositionTask("xy"), None

    def __getattr__(self, name):
        return getattr(self.__dict__["task"], name)

    def frame_map(self):
        return None

    def jacobian(self, robot, q):
        J = self.task.jacobian(robot, q)
        if self.left is None and abs(np.linalg.det(J)) < 1e-13:
            self.left = 100
        elif self.left is not None:
            self.left -= 1
            time.sleep(0.05 if self.left < 0 else 0)
        return J


def test_a_singular_configuration_is_told_even_if_there_is_no_time_to_measure_what_it_lies_on():
    found = find_singularities("planar_2r", SlowOnceSingular(), method="numeric", time_limit=1.5)
    (branch,) = found.branches
    assert abs(np.sin(branch.q[1])) < 1e-9
    assert (branch.rank, branch.dimension, found.complete) == (1, 0, False)
    assert "it may lie on a larger piece" in branch.note
    assert "it may lie on a larger piece" in found.explain()


# --- names and mimicking joints


@pytest.mark.parametrize(
    "name", ["sin", "cos", "array", "sqrt", "numpy", "E", "I", "S", "x", "x0", "qdot1", "t0", "exp"]
)
def test_a_length_of_any_name_gives_the_determinant_of_the_shoulder(name):
    """det J = −a b sin q3 (L + a cos q2 + b cos(q2 + q3))."""
    rows = [("R", name, pi / 2, 0, 0), ("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0)]
    robot = robot_from_dh(rows, parameters={name: 0.7})
    f = formulas(robot, PositionTask())
    q = dict(zip(f.q, (0.3, 0.8, -0.5), strict=True))
    length = sympy.Symbol(name, real=True)
    wanted = 0.4 * 0.3 * np.sin(-0.5) * (0.7 + 0.4 * np.cos(0.8) + 0.3 * np.cos(0.3))
    assert abs(float(f.determinant.xreplace({**q, length: 0.7}))) == pytest.approx(abs(wanted), abs=1e-12)
    assert f.velocity_product.free_symbols <= {*f.q, *f.qdot, length}
    assert length not in f.qdot


MIMIC = """<robot name="m"><link name="b"/><link name="l1"/><link name="l2"/><link name="tool"/>
<joint name="j1" type="{}"><parent link="b"/><child link="l1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<joint name="j2" type="{}"><parent link="l1"/><child link="l2"/><origin xyz=".6 0 0"/><axis xyz="0 1 0"/>
<mimic joint="j1" multiplier="{}" offset="0.2"/><limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
<joint name="t" type="fixed"><parent link="l2"/><child link="tool"/><origin xyz=".3 .2 0"/></joint></robot>"""


@pytest.mark.parametrize(
    ("leader", "follower", "multiplier"),
    [("prismatic", "revolute", 2), ("revolute", "prismatic", 0.5), ("revolute", "revolute", 0.3333)],
)
def test_a_follower_that_has_no_formula_is_a_formula_error_and_its_set_is_found_by_numbers(
    tmp_path, leader, follower, multiplier
):
    path = tmp_path / "mimic.urdf"
    path.write_text(MIMIC.format(leader, follower, multiplier), encoding="utf-8")
    robot = load_robot(path)
    with pytest.raises(FormulaError, match="joint 'j2'"):
        _ = formulas(robot, PositionTask()).jacobian
    assert find_singularities(robot, PositionTask("x"), samples=10, time_limit=3).method == "numeric"


def test_a_wrist_still_has_its_formulas():
    assert formulas(dh(*TWISTED, alpha=1.0), PointingTask("z")).jacobian.shape == (3, 3)
