"""Closed formulas of redundancy resolution, weighted norms and semi-norms, reduced gradient, extended task."""

import numpy as np
import pytest
import sympy
from arms import arm
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.redundancy import (
    ManipulabilityObjective,
    NearObjective,
    extended_task,
    projected_gradient,
    reduced_gradient,
    redundancy_formulas,
    weighted_pseudoinverse,
)

XY = r1.PositionTask("xy")
PPR = r1.textbook_robots.planar_arm("PPR", ["l"], parameters={"l": 0.5})
THREE = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
FOUR = r1.textbook_robots.planar_arm("RRRR", [1.0, 1.0, 1.0, 1.0])
L, q3, w = sympy.Symbol("l", real=True), sympy.Symbol("q3", real=True), sympy.Symbol("w", positive=True)
seeds = st.integers(0, 10**6)


def test_ppr_pseudoinverse_null_vector_and_projector_by_hand():
    """J = [[1, 0, −L s3], [0, 1, L c3]]: det J Jᵀ = 1 + L², and (L s3, −L c3, 1) is not seen."""
    found = redundancy_formulas(PPR, XY)
    s, c = sympy.sin(q3), sympy.cos(q3)
    J = sympy.Matrix([[1, 0, -L * s], [0, 1, L * c]])
    assert found.jacobian == J
    wanted = sympy.Matrix([[1 + L**2 * c**2, L**2 * s * c], [L**2 * s * c, 1 + L**2 * s**2], [-L * s, L * c]])
    assert sympy.simplify(found.pseudoinverse - wanted / (1 + L**2)) == sympy.zeros(3, 2)
    assert found.manipulability == sympy.sqrt(1 + L**2)
    n = sympy.Matrix([L * s, -L * c, 1])
    assert found.null_basis == n
    assert sympy.simplify(found.projector - n * n.T / (1 + L**2)) == sympy.zeros(3, 3)


def test_ppr_with_weights_and_with_sliders_alone():
    """A weight of zero on the turn: all motion is made by it as far as it can be; a weight w on it spares it."""
    s, c = sympy.sin(q3), sympy.cos(q3)
    J = sympy.Matrix([[1, 0, -L * s], [0, 1, L * c]])
    W = sympy.diag(1, 1, w)
    wanted = W.inv() * J.T * (J * W.inv() * J.T).inv()
    found = redundancy_formulas(PPR, XY, weights=[1, 1, w]).pseudoinverse
    assert sympy.simplify(found - wanted) == sympy.zeros(3, 2)
    free = redundancy_formulas(PPR, XY, weights=[1, 1, 0]).pseudoinverse
    wanted = sympy.Matrix([[c**2, s * c], [s * c, s**2], [-s / L, c / L]])
    assert sympy.simplify(free - wanted) == sympy.zeros(3, 2)
    full = redundancy_formulas(PPR, XY, weights=[[2, 1, 0], [1, 2, 0], [0, 0, 1]]).pseudoinverse
    assert sympy.simplify(J * full) == sympy.eye(2)


def test_planar_3r_null_vector_is_that_of_the_minors():
    """(l2 l3 s3, −l3 (l1 s23 + l2 s3), l1 (l2 s2 + l3 s23)) for any lengths."""
    robot = r1.textbook_robots.planar_arm("RRR", ["l1", "l2", "l3"], parameters={"l1": 1, "l2": 0.8, "l3": 0.5})
    l1, l2, l3, q2 = sympy.symbols("l1 l2 l3 q2", real=True)
    s2, s3, s23 = sympy.sin(q2), sympy.sin(q3), sympy.sin(q2 + q3)
    found = redundancy_formulas(robot, XY)
    v = sympy.Matrix([l2 * l3 * s3, -l3 * (l1 * s23 + l2 * s3), l1 * (l2 * s2 + l3 * s23)])
    assert (found.null_basis - v).applyfunc(sympy.expand) == sympy.zeros(3, 1)
    assert sympy.expand(found.manipulability**2 - v.dot(v)) == 0
    q = {"q1": 0.4, "q2": 0.7, "q3": -0.9}
    values = {sympy.Symbol(name, real=True): x for name, x in {**q, **robot.parameters}.items()}
    J = XY.jacobian(robot, list(q.values()))
    assert np.array(found.pseudoinverse.xreplace(values), dtype=float) == pytest.approx(np.linalg.pinv(J))
    P = np.eye(3) - np.linalg.pinv(J) @ J
    assert np.array(found.projector.xreplace(values), dtype=float) == pytest.approx(P, abs=1e-12)


def test_one_row_of_an_rp_arm_is_that_of_the_exam():
    """p_y = q2 sin q1 of an RP arm: J⁺ = (q2 c1, s1)/(q2² c1² + s1²)."""
    robot = r1.textbook_robots.robot_from_formula(["q2*sin(q1)"], joints="RP")
    q1, q2 = sympy.symbols("q1 q2", real=True)
    found = redundancy_formulas(robot, robot.task)
    s, c = sympy.sin(q1), sympy.cos(q1)
    wanted = sympy.Matrix([q2 * c, s]) / (q2**2 * c**2 + s**2)
    assert sympy.simplify(found.pseudoinverse - wanted) == sympy.zeros(2, 1)


@given(seeds)
def test_weighted_pseudoinverse_is_the_formula_of_full_rank_and_the_least_semi_norm(seed):
    rng = np.random.default_rng(seed)
    J, A = rng.normal(size=(2, 4)), rng.normal(size=(4, 4))
    W = A.T @ A + 0.1 * np.eye(4)
    V = np.linalg.inv(W)
    assert weighted_pseudoinverse(J, W) == pytest.approx(V @ J.T @ np.linalg.inv(J @ V @ J.T), abs=1e-7)
    assert weighted_pseudoinverse(J) == pytest.approx(np.linalg.pinv(J), abs=1e-12)
    weights = np.array([0.0, 1.0, 2.0, 0.0])
    x = weighted_pseudoinverse(J, weights) @ (b := rng.normal(size=2))
    assert J @ x == pytest.approx(b, abs=1e-8)
    N = np.linalg.svd(J)[2][2:].T
    assert N.T @ (weights * x) == pytest.approx([0, 0], abs=1e-7)  # no motion of the null space makes it less


def test_numbers_and_symbols_agree_for_three_rows_and_five_columns():
    rng = np.random.default_rng(1)
    J = np.round(rng.normal(size=(3, 5)), 2)
    formula = weighted_pseudoinverse(sympy.Matrix(J.tolist()), [1, 2, 3, 4, 5])
    assert np.array(formula, dtype=float) == pytest.approx(weighted_pseudoinverse(J, [1, 2, 3, 4, 5]))


def test_reduced_gradient_realises_the_task_and_gains_more_than_the_projected_one():
    objective = NearObjective(np.zeros(4))
    for seed in range(5):
        q = np.random.default_rng(seed).uniform(-2, 2, 4)
        qdot = reduced_gradient(FOUR, XY, [0.3, -0.2], q, objective)
        assert XY.jacobian(FOUR, q) @ qdot == pytest.approx([0.3, -0.2], abs=1e-10)
        still = reduced_gradient(FOUR, XY, [0, 0], q, objective)
        projected = projected_gradient(FOUR, XY, [0, 0], q, objective)
        assert objective.gradient(q) @ still >= projected.null_rate - 1e-12


def test_reduced_gradient_of_a_ppr_arm_by_hand():
    """q̇3 = k (∂H/∂q3 + L s3 ∂H/∂q1 − L c3 ∂H/∂q2): the minor of the sliders, 1, is the largest for L < 1."""
    q, objective = [0.2, -0.1, 0.6], NearObjective([0, 0, 0])
    s, c = np.sin(0.6), np.cos(0.6)
    turn = 2 * (-0.6 + 0.5 * s * -0.2 - 0.5 * c * 0.1)
    wanted = [0.5 * s * turn, -0.5 * c * turn, turn]
    assert reduced_gradient(PPR, XY, [0, 0], q, objective, gain=2.0) == pytest.approx(wanted)


def test_extended_task_is_solved_where_the_objective_is_the_largest():
    objective = ManipulabilityObjective(THREE, XY)
    task = extended_task(THREE, XY, objective)
    assert task.rows == 3
    q = r1.iterate_ik(THREE, task, [1.2, 0.4, 0.0], [-0.7, 1.6, 0.7], tolerance=1e-8).require().q
    J, slope = XY.jacobian(THREE, q), objective.gradient(q)
    assert XY.value(THREE, q) == pytest.approx([1.2, 0.4], abs=1e-8)
    assert (np.eye(3) - np.linalg.pinv(J) @ J) @ slope == pytest.approx(np.zeros(3), abs=1e-6)
    n = np.linalg.svd(J)[2][2]
    for step in (-0.05, 0.05):  # to both sides on the self-motion, back on the task
        other = r1.iterate_ik(THREE, XY, [1.2, 0.4], q + step * n, method="pseudoinverse", tolerance=1e-10).require().q
        assert objective.value(other) < objective.value(q)
    more = extended_task(FOUR, XY, NearObjective(np.zeros(4)))
    assert more.rows == 4


@pytest.mark.parametrize(
    ("call", "words", "kind"),
    [
        (lambda: weighted_pseudoinverse(np.eye(2), [1, -1]), "must not be negative", r1.InputError),
        (lambda: weighted_pseudoinverse(np.eye(2), [[1, 2], [2, 1]]), "positive semidefinite", r1.InputError),
        (lambda: weighted_pseudoinverse(sympy.ones(2, 3)), "not full row rank", r1.FormulaError),
        (lambda: weighted_pseudoinverse(sympy.ones(1, 3), [1, 1]), "weights must be 3", r1.InputError),
        (lambda: redundancy_formulas(arm("planar_2r"), r1.PoseTask()), "nothing is redundant", r1.TaskError),
        (lambda: extended_task(THREE, r1.PlanarPoseTask(), NearObjective([0, 0, 0])), "nothing is", r1.TaskError),
        (lambda: reduced_gradient(THREE, XY, [0, 0], [0.1, 0, 0], NearObjective([0, 0, 0])), "full row", r1.InputError),
    ],
)
def test_misuse_says_what_would_be_right(call, words, kind):
    with pytest.raises(kind, match=words):
        call()
