import json
import math
import os
import subprocess
import sys

import mpmath
import numpy as np
import pinocchio as pin
import pytest
from arms import ARMS, arm, span
from closed_forms import SPATIAL_CHAIN, cylindrical_determinant, prr_pose_determinant, spatial_pose_and_jacobian
from inner_kernels import from_python
from sweeps import core_first

from robotics1 import Robotics1Error, load_robot
from robotics1.kernels import block_jacobian, extreme_singular_values, singularity_measures as measures
from robotics1.kernels.block_jacobian import BLOCK, LARGEST
from robotics1.kernels.chain import chain_arrays
from robotics1.kernels.extreme_singular_values import SWEEPS
from robotics1.kernels.singularity_measures import singularity_measures, task_jacobians
from robotics1.robot.joints import tips
from robotics1.robot.sources import example_robots

FRAME, PLANE = np.eye(6), np.eye(6)[[0, 1, 5]]
SHAPES = [(1, 1), (1, 7), (2, 2), (2, 3), (3, 3), (3, 6), (4, 5), (5, 5), (5, 6), (6, 6), (6, 7), (6, 12)]


cosines_and_sines = from_python(block_jacobian.cosines_and_sines)
bidiagonal_squares = from_python(measures.bidiagonal_squares, contract=True)
largest_eigenvalues = from_python(extreme_singular_values.largest_eigenvalues, contract=True)
smallest_eigenvalues = from_python(extreme_singular_values.smallest_eigenvalues, contract=True)


def singular_values(matrices):
    """σ_min, σ_max, Π σ by the kernels, and the sweeps they took, of a block of matrices (BLOCK, k, n), k ≤ n."""
    A = np.moveaxis(matrices, 0, 2).copy()
    k = len(A)
    Q, E, work, answer = np.empty((k, BLOCK)), np.empty((k, BLOCK)), np.empty((8, BLOCK)), np.empty((2, BLOCK))
    bidiagonal_squares(A, Q, E, work[0], work[1])
    product = np.sqrt(Q).prod(axis=0)
    down = largest_eigenvalues(Q, E, k, answer[1], work)
    up = smallest_eigenvalues(Q, E, k, answer[0], work)
    return (*np.sqrt(answer), product, max(up, down))


def block(matrix):
    return np.repeat(np.asarray(matrix, dtype=float)[None], BLOCK, axis=0)


def uniform(robot, count, seed=0):
    lower, upper = span(robot)
    return np.random.default_rng(seed).uniform(lower[:, None], upper[:, None], (robot.nq, count))


def pinocchios(robot, q, frame=None):
    """J_frame by Pinocchio at each column of q, (N, 6, n)."""
    number = robot.frame_id(frame)
    kind = pin.LOCAL_WORLD_ALIGNED
    each = [pin.computeFrameJacobian(robot.model, robot.data, x, number, kind).reshape(6, robot.nv) for x in q.T.copy()]
    return np.array(each)


# --- cosine and sine


def exact(angles):
    with mpmath.workdps(60):
        return np.array([[float(mpmath.cos(mpmath.mpf(x))), float(mpmath.sin(mpmath.mpf(x)))] for x in angles]).T


@pytest.mark.parametrize("size", [1e-8, 1.0, 10.0, 1e3, LARGEST, 1e9, 1e300])
def test_cosine_and_sine_are_right_to_2_3e_16_at_angles_of_any_size(size):
    angles, cosine, sine = np.random.default_rng(0).uniform(-size, size, BLOCK), np.empty(BLOCK), np.empty(BLOCK)
    cosines_and_sines(angles, cosine, sine)
    assert np.array([cosine, sine]) == pytest.approx(exact(angles), rel=0, abs=2.3e-16)


def test_the_sine_of_the_double_next_to_k_pi_is_what_is_missing_to_k_pi():
    k = np.concatenate([np.arange(1, BLOCK // 2 + 1), np.arange(1, BLOCK // 2 + 1) * 900])
    angles, cosine, sine = k * math.pi, np.empty(BLOCK), np.empty(BLOCK)
    cosines_and_sines(angles, cosine, sine)
    assert sine == pytest.approx(exact(angles)[1], rel=1e-6, abs=1e-20)
    assert cosine == pytest.approx((-1.0) ** k, rel=0, abs=2.3e-16)


def test_the_cosine_of_nan_and_of_infinity_is_nan():
    angles, cosine, sine = np.full(BLOCK, 0.5), np.empty(BLOCK), np.empty(BLOCK)
    angles[3], angles[5] = math.nan, math.inf
    cosines_and_sines(angles, cosine, sine)
    assert list(np.flatnonzero(np.isnan(cosine))) == list(np.flatnonzero(np.isnan(sine))) == [3, 5]


# --- singular values of matrices


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("scale", [1e-40, 1.0, 1e40])
def test_singular_values_of_random_matrices_are_lapacks(shape, scale):
    A = scale * np.random.default_rng(1).standard_normal((BLOCK, *shape))
    smallest, largest, product, sweeps = singular_values(A)
    sigma = np.linalg.svd(A, compute_uv=False)
    assert smallest / scale == pytest.approx(sigma[:, -1] / scale, rel=0, abs=1e-14)
    assert largest == pytest.approx(sigma[:, 0], rel=1e-13)
    assert product == pytest.approx(sigma.prod(axis=1), rel=1e-10)
    assert sweeps < SWEEPS


@pytest.mark.parametrize("small", [1e-3, 1e-8, 1e-12, 1e-16, 0.0])
@pytest.mark.parametrize("shape", SHAPES[2:])
def test_sigma_min_is_right_to_1e_14_next_to_a_singularity(shape, small):
    k, n = shape
    rng = np.random.default_rng(2)
    U, V = (np.linalg.qr(rng.standard_normal((BLOCK, size, size)))[0] for size in (k, n))
    sigma = np.sort(rng.uniform(0.5, 2.0, (BLOCK, k)))[:, ::-1].copy()
    sigma[:, -1] = small
    smallest, largest, _, sweeps = singular_values((U * sigma[:, None]) @ V[:, :k])
    assert smallest == pytest.approx(np.full(BLOCK, small), rel=0, abs=1e-14)
    assert largest == pytest.approx(sigma[:, 0] if k > 1 else sigma[:, -1], rel=1e-13)
    assert sweeps < SWEEPS


@pytest.mark.parametrize("fold", [1, 2, 3, 4, 5, 6])
@pytest.mark.parametrize("others", [1 + 1e-9, 2.0, 1e6])
def test_a_sigma_min_that_is_k_fold_is_found_within_the_sweeps(fold, others):
    rng = np.random.default_rng(3)
    U, V = (np.linalg.qr(rng.standard_normal((BLOCK, size, size)))[0] for size in (6, 7))
    sigma = np.array([others] * (6 - fold) + [1.0] * fold)
    smallest, largest, _, sweeps = singular_values((U * sigma) @ V[:, :6])
    assert smallest == pytest.approx(np.ones(BLOCK), rel=0, abs=3e-14 * sigma[0])
    assert largest == pytest.approx(np.full(BLOCK, sigma[0]), rel=3e-14)
    assert sweeps <= 40


@pytest.mark.parametrize("alpha", [1.0, 1e-5, 1e-10, 1e-40, 1e-70])
def test_of_a_triangular_2_by_2_matrix_sigma_min_times_sigma_max_is_the_determinant_to_the_last_digits(alpha):
    smallest, largest, product, _ = singular_values(block([[1.0, 0.0], [0.75, alpha]]))
    trace = 1.0 + 0.75**2 + alpha**2
    assert product == pytest.approx(np.full(BLOCK, alpha), rel=1e-15)
    assert largest**2 == pytest.approx((trace + math.sqrt(trace**2 - 4 * alpha**2)) / 2, rel=1e-13)
    assert smallest * largest == pytest.approx(np.full(BLOCK, alpha), rel=1e-13)


SINGULAR = {
    "zero": np.zeros((6, 7)),
    "one": np.eye(6, 7) * [1, 0, 0, 0, 0, 0, 0],
    "shift": np.eye(6, k=-1),
    "other shift": np.eye(6, k=1),
    "planar": np.diag([1, 1, 0, 0, 0, 1.0]),
    "equal rows": np.ones((6, 7)),
    "equal columns": np.arange(1.0, 7)[:, None] * np.ones((6, 7)),
    "nothing": np.zeros((1, 1)),
}


@pytest.mark.parametrize("name", SINGULAR)
def test_sigma_min_of_a_matrix_that_lacks_rank_is_zero_and_sigma_max_is_lapacks(name):
    smallest, largest, product, sweeps = singular_values(block(SINGULAR[name]))
    assert smallest == pytest.approx(np.zeros(BLOCK), abs=1e-15)
    assert product == pytest.approx(np.zeros(BLOCK), abs=1e-15)
    assert largest == pytest.approx(np.full(BLOCK, np.linalg.norm(SINGULAR[name], 2)), rel=1e-13)
    assert sweeps < SWEEPS


def test_every_matrix_of_a_block_has_its_own_answer():
    A = np.random.default_rng(4).standard_normal((BLOCK, 6, 7))
    A[::3] = 0
    A[1::3] = np.eye(6, 7)
    smallest, largest, _, _ = singular_values(A)
    sigma = np.linalg.svd(A, compute_uv=False)
    assert smallest == pytest.approx(sigma[:, -1], abs=1e-14)
    assert largest == pytest.approx(sigma[:, 0], abs=1e-13)


# --- Jacobians of arms


def test_the_spatial_arms_jacobians_are_those_of_the_hand_written_chain():
    robot = arm("spatial")
    q = uniform(robot, 150)
    J = np.empty((6, len(SPATIAL_CHAIN), 150))
    singularity_measures(chain_arrays(robot), FRAME, q, J=J)
    hand = np.array([spatial_pose_and_jacobian(x)[1] for x in q.T])
    assert np.moveaxis(J, 2, 0) == pytest.approx(hand, rel=0, abs=1e-14)
    assert task_jacobians(chain_arrays(robot), FRAME, q) == pytest.approx(J, rel=0, abs=1e-14)


def test_the_product_of_prr_planar_pose_singular_values_is_l2_cos_q2():
    robot = arm("prr")
    q = uniform(robot, 200)
    l2, l3 = robot.parameters["l2"], robot.parameters["l3"]
    found = singularity_measures(chain_arrays(robot), PLANE, q)
    assert found.product == pytest.approx([abs(prr_pose_determinant(x, l2, l3)) for x in q.T], rel=0, abs=1e-14)


def test_the_product_of_cylindrical_position_singular_values_is_q3():
    robot = arm("cylindrical")
    q = uniform(robot, 100)
    found = singularity_measures(chain_arrays(robot), FRAME[:3], q)
    assert found.product == pytest.approx([abs(cylindrical_determinant(x)) for x in q.T], rel=0, abs=1e-14)
    assert found.smallest == pytest.approx(np.minimum(1, np.abs(q[2])), rel=0, abs=1e-14)  # J = R diag(1, q3, 1)


@pytest.mark.parametrize("count", [1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 7])
def test_any_number_of_configurations_is_answered_one_by_one(count):
    robot = arm("redundant")
    q = uniform(robot, count)
    J = np.empty((6, robot.nv, count))
    found = singularity_measures(chain_arrays(robot), FRAME, q, largest=True, J=J)
    assert np.moveaxis(J, 2, 0) == pytest.approx(pinocchios(robot, q), rel=0, abs=1e-14)
    sigma = np.linalg.svd(pinocchios(robot, q), compute_uv=False)
    assert found.smallest == pytest.approx(sigma[:, -1], rel=0, abs=1e-14)
    assert found.largest == pytest.approx(sigma[:, 0], rel=1e-13)
    assert found.product == pytest.approx(sigma.prod(axis=1), rel=1e-9)


def agree(robot, frame, count=20):
    """J, σ_min, σ_max and Π σ are those of Pinocchio's Jacobian, relative to the reach."""
    q = uniform(robot, count)
    chain = chain_arrays(robot, frame)
    theirs = pinocchios(robot, q, frame)
    J = np.empty((6, robot.nv, count))
    found = singularity_measures(chain, FRAME, q, largest=True, J=J)
    size = max(robot.reach, 1.0)
    assert np.moveaxis(J, 2, 0) == pytest.approx(theirs, rel=0, abs=1e-12 * size)
    assert task_jacobians(chain, FRAME, q) == pytest.approx(J, rel=0, abs=1e-12 * size)
    sigma = np.linalg.svd(theirs, compute_uv=False)
    assert found.smallest == pytest.approx(sigma[:, -1], rel=0, abs=1e-12 * size)
    assert found.largest == pytest.approx(sigma[:, 0], rel=0, abs=1e-12 * size)
    assert found.product == pytest.approx(sigma.prod(axis=1), rel=0, abs=1e-12 * size**6)


@pytest.mark.parametrize("name", ARMS)
def test_jacobians_and_singular_values_are_pinocchios_and_lapacks(name):
    robot = arm(name)
    for frame in robot.frame_names[1:]:
        if chain_arrays(robot, frame).coordinate.size:
            agree(robot, frame)


@pytest.mark.parametrize("name", core_first(sorted(example_robots()), sorted(example_robots())[::8], 8))
def test_jacobians_and_singular_values_of_the_chains_of_example_robot_data_are_pinocchios_and_lapacks(name):
    try:
        robot = load_robot(name)
    except Robotics1Error:
        pytest.skip("the file is refused")
    if robot.nq != robot.nv:
        with pytest.raises(Robotics1Error, match="several degrees of freedom"):
            chain_arrays(robot, robot.frame_names[0])
        return
    chains = [tip for tip in tips(robot.frame_names, robot.joints) if chain_arrays(robot, tip).coordinate.size]
    for tip in chains[:12]:
        agree(robot, tip, count=5)


# --- without Numba, and without a place for the compiled code

PROGRAM = """
import sys
{before}
import json
import numpy as np
from robotics1 import load_robot
from robotics1.kernels.chain import chain_arrays
from robotics1.kernels.compilation import COMPILED
from robotics1.kernels.singularity_measures import singularity_measures

robot = load_robot({path!r})
q = np.random.default_rng(0).uniform(-2, 2, (robot.nq, 30))
J = np.empty((6, robot.nv, 30))
found = singularity_measures(chain_arrays(robot), np.eye(6), q, largest=True, J=J)
print(json.dumps([COMPILED, J.tolist(), *(part.tolist() for part in found)]))
"""


def in_a_new_process(before="", **environment):
    program = PROGRAM.format(before=before, path=str(arm("redundant").path))
    run = subprocess.run(
        [sys.executable, "-c", program],
        check=True, capture_output=True, text=True, timeout=300, env=os.environ | environment,
    )  # fmt: skip
    return json.loads(run.stdout)


def test_without_numba_the_answers_are_the_same_to_1e_12():
    compiled, J, *found = in_a_new_process("sys.modules['numba'] = None")
    assert compiled is False
    robot = arm("redundant")
    q = np.random.default_rng(0).uniform(-2, 2, (robot.nq, 30))
    ours = np.empty((6, robot.nv, 30))
    expected = singularity_measures(chain_arrays(robot), FRAME, q, largest=True, J=ours)
    assert np.array(J) == pytest.approx(ours, rel=0, abs=1e-12)
    assert np.array(found) == pytest.approx(np.array(expected), rel=0, abs=1e-12)


@pytest.mark.sweep
def test_where_no_directory_can_hold_the_compiled_code_each_process_compiles_anew():
    no_place = """
from numba.core import caching
for locator in caching.CacheImpl._locator_classes:
    locator.from_function = classmethod(lambda cls, function, path: None)
"""
    assert in_a_new_process(no_place)[0] is True


@pytest.mark.sweep
def test_the_compiled_code_is_kept_in_the_directory_that_is_named(tmp_path):
    assert in_a_new_process(NUMBA_CACHE_DIR=str(tmp_path))[0] is True
    assert any(path.name.startswith("singularity_measures.measure_blocks") for path in tmp_path.rglob("*.nbi"))
