from math import inf, nan, pi

import closed_forms as cf
import numpy as np
import pytest
import sympy
from arms import arm, random_q
from differences import outside
from hypothesis import given, strategies as st

from robotics1 import RANK_TOLERANCE, InputError, PlanarPoseTask, PoseTask, PositionTask, subspaces

SHAPES = [(1, 1), (2, 2), (2, 3), (3, 2), (6, 7), (6, 1), (1, 6), (5, 5)]


def random_matrix(m, n, r, seed):
    rng = np.random.default_rng(seed)
    return rng.standard_normal((m, r)) @ rng.standard_normal((r, n))


# --- laws, for every shape and every rank


@given(st.sampled_from(SHAPES).flatmap(lambda s: st.tuples(st.just(s), st.integers(0, min(s)), st.integers(0, 99))))
def test_subspaces_are_orthonormal_complements_and_rank_counts_the_singular_values(case):
    (m, n), r, seed = case
    J = random_matrix(m, n, r, seed)
    s = subspaces(J)
    assert s.rank == r
    assert s.singular_values.shape == (min(m, n),)
    assert [b.shape for b in (s.range, s.left_null, s.row, s.null)] == [(m, r), (m, m - r), (n, r), (n, n - r)]
    left, right = np.hstack([s.range, s.left_null]), np.hstack([s.row, s.null])
    assert left.T @ left == pytest.approx(np.eye(m), abs=1e-13)
    assert right.T @ right == pytest.approx(np.eye(n), abs=1e-13)
    assert J @ s.null == pytest.approx(np.zeros((m, n - r)), abs=1e-12)
    assert J.T @ s.left_null == pytest.approx(np.zeros((n, m - r)), abs=1e-12)
    assert outside(s.range, J) == pytest.approx(np.zeros((m, n)), abs=1e-12)
    assert outside(s.row, J.T) == pytest.approx(np.zeros((n, m)), abs=1e-12)


@pytest.mark.parametrize("seed", range(5))
def test_rank_and_null_space_are_sympys_for_integer_matrices(seed):
    rng = np.random.default_rng(seed)
    J = rng.integers(-2, 3, (3, 2)) @ rng.integers(-2, 3, (2, 4))
    exact = sympy.Matrix(J)
    s = subspaces(J)
    assert s.rank == exact.rank()
    for vector in exact.nullspace():
        v = np.array(vector, dtype=float).ravel()
        assert outside(s.null, v) == pytest.approx(np.zeros(4), abs=1e-13 * np.linalg.norm(v))


# --- hand formulas


@pytest.mark.parametrize("sign", [1, -1])
@given(l2=st.floats(0.05, 3), l3=st.floats(0.05, 3), q3=st.floats(-pi, pi))
def test_prr_null_spaces_at_q2_half_pi_are_the_exams(sign, l2, l3, q3):
    s = subspaces(cf.prr_pose_jacobian([0.3, sign * pi / 2, q3], l2, l3))
    assert s.rank == 2
    assert outside(s.null, cf.prr_null(sign, l2)) == pytest.approx(np.zeros(3), abs=1e-13)
    assert outside(s.left_null, cf.prr_left_null(sign, q3, l3)) == pytest.approx(np.zeros(3), abs=1e-13)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("q3", [-2.0, 0.0, 0.7, pi])
def test_prr_planar_pose_null_spaces_of_the_robot_are_the_exams(prr, sign, q3):
    s = subspaces(PlanarPoseTask("xy").jacobian(prr, [0.3, sign * pi / 2, q3]))
    assert (s.null.shape, s.left_null.shape) == ((3, 1), (3, 1))
    assert outside(s.null, cf.prr_null(sign, 0.6)) == pytest.approx(np.zeros(3), abs=1e-14)
    assert outside(s.left_null, cf.prr_left_null(sign, q3, 0.4)) == pytest.approx(np.zeros(3), abs=1e-14)


def test_velocities_that_cannot_be_realised_have_l3_s3_rdot3_plus_rdot2_nonzero():
    q3, l3 = 0.8, 0.4
    s = subspaces(cf.prr_pose_jacobian([0.0, pi / 2, q3], 0.6, l3))
    for rate in np.random.default_rng(0).standard_normal((20, 3)):
        part = rate[2] * l3 * np.sin(q3) + rate[1]
        assert np.linalg.norm(s.unrealisable(rate)) == pytest.approx(
            abs(part) / np.hypot(1, l3 * np.sin(q3)), rel=1e-12
        )
        assert not s.contains(rate)
        within = rate - [0, part, 0]
        assert s.contains(within)
        assert s.unrealisable(within) == pytest.approx(np.zeros(3), abs=1e-15)


def test_a_wheel_of_a_one_joint_arm_spans_one_direction(one_joint):
    s = subspaces(PoseTask().jacobian(one_joint, [0.4]))
    assert (s.rank, s.range.shape, s.left_null.shape, s.null.shape) == (1, (6, 1), (6, 5), (1, 0))


def test_redundant_arm_has_one_self_motion_of_the_pose():
    robot = arm("redundant")
    q = random_q(robot, 0)
    J = PoseTask().jacobian(robot, q)
    s = subspaces(J)
    assert (s.rank, s.null.shape) == (6, (7, 1))
    assert J @ s.null == pytest.approx(np.zeros((6, 1)), abs=1e-14)
    assert abs(s.null[3, 0]) < 1e-14  # the elbow angle fixes the distance from shoulder to wrist


# --- the threshold


@pytest.mark.parametrize(("smallest", "rank"), [(2e-9, 2), (1.1e-9, 2), (0.9e-9, 1), (1e-12, 1), (0.0, 1)])
@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e12])
def test_rank_counts_singular_values_above_1e_9_of_the_largest(smallest, rank, scale):
    assert RANK_TOLERANCE == 1e-9
    assert subspaces(scale * np.diag([1.0, smallest])).rank == rank


@pytest.mark.parametrize("shape", SHAPES)
def test_the_zero_matrix_has_rank_0_and_every_velocity_is_lost(shape):
    s = subspaces(np.zeros(shape))
    assert s.rank == 0
    assert s.range.shape == (shape[0], 0)
    assert s.null.shape == (shape[1], shape[1])
    assert not s.contains(np.ones(shape[0]))
    assert s.contains(np.zeros(shape[0]))


def test_contains_scales_with_the_vector(prr):
    s = subspaces(PositionTask("xy").jacobian(prr, [0, pi / 2, pi]))
    assert s.contains([1, 0])
    assert s.contains([1e12, 0])
    assert s.contains([1, 1e-10])
    assert not s.contains([1, 1e-8])
    assert not s.contains([0, 1e-12])


# --- misuse


@pytest.mark.parametrize(
    "J", [[1, 2, 3], 1.0, [[1, nan]], [[inf]], [[1, 2], [3]], "J", None, np.zeros((2, 2, 2)), [[1j]]]
)
def test_a_jacobian_that_is_no_finite_matrix_is_an_input_error(J):
    with pytest.raises(InputError, match="J must"):
        subspaces(J)


@pytest.mark.parametrize("v", [[1, 2, 3], 1.0, [nan, 0], "ab", [[1, 2]]])
def test_a_velocity_of_the_wrong_size_is_an_input_error(v):
    s = subspaces(np.eye(2))
    for call in (s.contains, s.unrealisable):
        with pytest.raises(InputError, match="v must"):
            call(v)


def test_the_argument_is_not_kept():
    J = np.eye(2)
    s = subspaces(J)
    J[0, 0] = 7
    assert s.J[0, 0] == 1
