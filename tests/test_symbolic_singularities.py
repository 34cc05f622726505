"""The singular sets in exact form of some fifty arms and tasks: nothing in them is wrong, and nothing is missing.

Every branch is compared with Pinocchio at random configurations, and with the answers of textbooks; a search that knows
the numeric J alone finds no other singular configuration.
"""

import numpy as np
import pytest
from singular_arms import CASES, CORE, POLAR
from singular_checks import (
    Equations,
    case,
    corners,
    numbers,
    rank,
    read,
    singular_near,
    spans_range,
    starts,
    unit_columns,
    written,
)
from sweeps import core_first

from robotics1 import FormulaError
from robotics1.singularities import find_intersections

BASES_TAKE_LONG = {"Puma 560", "UR5", "7R twist", "7R limited"}  # a second or two for each branch
INTERSECTIONS_TAKE_LONG = {"Puma 560", "UR5", "7R twist", "7R limited", "cable arm with names xyz"}
BY_HAND = [name for name, (*_, wanted) in CASES.items() if wanted is not None]
MEETING = [name for name in CASES if name not in INTERSECTIONS_TAKE_LONG]
every_case = pytest.mark.parametrize("name", core_first(CASES, CORE, 8))


@pytest.mark.parametrize("name", core_first(BY_HAND, CORE & set(BY_HAND)))
def test_the_singular_set_is_the_textbooks(name):
    robot, _, _, found, *_ = case(name)
    ranks = {equations: rank for text, rank in CASES[name][3].items() for equations in read(text, robot)}
    assert {written(branch.conditions): branch.rank for branch in found.branches} == ranks
    assert len(found.branches) == len(ranks)


@every_case
def test_at_random_on_each_branch_the_equations_hold_and_j_has_the_rank_that_is_said(name):
    robot, task, generic, found, usual, equations = case(name)
    rng = np.random.default_rng(1)
    assert (found.generic_rank, found.method, found.complete, found.note) == (generic, "symbolic", True, "")
    for branch, equation in zip(found.branches, equations, strict=True):
        assert branch.rank < generic
        assert set(branch.free_joints) == set(robot.joint_names) - joints_in(branch.conditions, robot)
        for _ in range(10):
            q = branch.sample(rng)
            assert robot.within_limits(q)
            assert equation(q) <= 1e-9
            assert branch.contains(q)
            assert rank(robot, task, q, usual) == branch.rank


def joints_in(conditions, robot):
    """The joints of the equations."""
    symbols = {symbol.name for condition in conditions for symbol in condition.free_symbols}
    return {name for i, name in enumerate(robot.joint_names) if f"q{i + 1}" in symbols}


@every_case
def test_bases_in_symbols_are_those_of_j_wherever_one_is_on_the_branch(name):
    robot, task, _, found, _, _ = case(name)
    rng = np.random.default_rng(2)
    for branch in found.branches[: 1 if name in BASES_TAKE_LONG else 6]:
        check_null_space(branch, robot, task, rng)
        if task is POLAR:
            with pytest.raises(FormulaError, match="quotients"):
                _ = branch.formulas.range
            continue
        m, r = task.rows, branch.rank
        bases = branch.formulas.range, branch.formulas.left_null
        assert [basis.shape for basis in bases] == [(m, r), (m, m - r)]
        realised, lost = (numbers(robot, basis) for basis in bases)
        for q in (branch.sample(rng) for _ in range(4)):
            J = task.jacobian(robot, q)
            assert np.abs(J.T @ unit_columns(lost(q).reshape(m, m - r))).max(initial=0) <= 1e-9
            assert np.linalg.matrix_rank(unit_columns(lost(q).reshape(m, m - r)), tol=1e-6) == m - r
            assert spans_range(realised(q).reshape(m, r), J)


def check_null_space(branch, robot, task, rng):
    null = branch.formulas.null
    n, r = robot.nv, branch.rank
    assert null.shape == (n, n - r)
    columns = numbers(robot, null)
    for q in (branch.sample(rng) for _ in range(4)):
        N = unit_columns(columns(q))
        assert np.abs(task.jacobian(robot, q) @ N).max() <= 1e-9
        assert np.linalg.matrix_rank(N, tol=1e-6) == n - r


@every_case
def test_a_numeric_search_finds_no_singular_configuration_off_the_branches(name):
    """Where two branches cross, J is nearly singular a little beside both: 1e-13 in σ leaves 1e-6 there."""
    robot, task, generic, found, usual, equations = case(name)
    rng = np.random.default_rng(3)
    count = 30 if found.branches else 8
    singular = [singular_near(robot, task, q, generic, usual) for q in starts(robot, count, rng)]
    singular = [q for q in singular if q is not None]
    assert bool(singular) == bool(found.branches)
    for q in singular:
        assert min(equation(q) for equation in equations) <= 1e-5, q


@every_case
def test_with_joints_at_multiples_of_half_pi_j_loses_rank_on_the_branches_and_nowhere_else(name):
    robot, task, generic, found, usual, equations = case(name)
    for q in corners(robot, 100, np.random.default_rng(4)):
        on = [branch for branch, equation in zip(found.branches, equations, strict=True) if equation(q) <= 1e-9]
        assert (rank(robot, task, q, usual) < generic) == bool(on), q
        assert rank(robot, task, q, usual) <= min((branch.rank for branch in on), default=generic), q


@pytest.mark.parametrize("name", core_first(MEETING, CORE & set(MEETING), 8))
def test_where_branches_meet_j_has_the_rank_that_is_said(name):
    robot, task, _, found, usual, equations = case(name)
    rng = np.random.default_rng(5)
    for piece in find_intersections(found).branches:
        meeting = Equations(robot, piece)
        for q in (piece.sample(rng) for _ in range(5)):
            assert meeting(q) <= 1e-9
            assert rank(robot, task, q, usual) == piece.rank
            on = [branch for branch, equation in zip(found.branches, equations, strict=True) if equation(q) <= 1e-6]
            assert len(on) > 1 or piece.rank < on[0].rank
