import closed_forms as cf
import numpy as np
import pytest
import sympy
from arms import arm
from differences import key, outside, sigma

from robotics1 import NotConverged, PlanarPoseTask, PositionTask, find_singularities
from robotics1.singularities import SingularSetStatus

POINT, POSE, SPACE = PositionTask("xy"), PlanarPoseTask("xy"), PositionTask("xyz")


@pytest.fixture(scope="module")
def pose_set(prr):
    return find_singularities(prr, POSE)


@pytest.fixture(scope="module")
def point_set(prr):
    return find_singularities(prr, POINT)


def test_prr_branches_carry_the_exams_null_spaces(pose_set):
    for branch, sign in zip(pose_set.branches, (-1, 1), strict=True):
        assert branch.rank == 2
        assert outside(branch.null, cf.prr_null(sign, 0.6)) == pytest.approx(np.zeros(3), abs=1e-12)
        left = cf.prr_left_null(sign, branch.q[2], 0.4)
        assert outside(branch.left_null, left) == pytest.approx(np.zeros(3), abs=1e-12)
        assert branch.range.shape == (3, 2)
        assert branch.range.T @ left == pytest.approx(np.zeros(2), abs=1e-12)


def test_conditions_are_exact_equations(pose_set, point_set):
    q2, q3 = sympy.symbols("q2 q3", real=True)
    assert pose_set.branches[0].conditions == (sympy.Eq(q2, -sympy.pi / 2),)
    assert point_set.branches[3].conditions == (sympy.Eq(q2, sympy.pi / 2), sympy.Eq(q3, sympy.pi))
    assert point_set.branches[2].conditions == (sympy.Eq(q2, sympy.pi / 2), sympy.Eq(q3, 0))


def test_conditions_of_a_curved_branch_name_the_tied_joints():
    found = find_singularities(arm("anthropomorphic", a2=0.35, a3=0.5), SPACE, method="numeric")
    q2, q3 = sympy.symbols("q2 q3", real=True)
    assert found.branches[0].conditions == (sympy.Eq(sympy.Function("sigma_min")(q2, q3), 0),)


def test_sample_draws_the_free_joints_anew(pose_set):
    rng = np.random.default_rng(1)
    for branch in pose_set.branches:
        drawn = np.array([branch.sample(rng) for _ in range(40)])
        assert (drawn[:, 1] == branch.values["q2"]).all()
        assert np.ptp(drawn[:, 0]) > 2
        assert np.ptp(drawn[:, 2]) > 3
        assert max(sigma(POSE, pose_set.robot, q) for q in drawn) <= 1e-10


@pytest.mark.parametrize(
    ("task", "method", "status", "sentence"),
    [
        (POINT, "symbolic", "COMPLETE", "These are all singular configurations."),
        (POSE, "symbolic", "NOWHERE_SINGULAR", "There is no singular configuration."),
        (POINT, "numeric", "INCOMPLETE", "This was a search: it does not prove that there are no others."),
        (POSE, "numeric", "NOT_FOUND", "No singular configuration was found."),
    ],
)
def test_the_status_says_whether_all_is_found_and_a_search_is_no_proof(planar_2r, task, method, status, sentence):
    found = find_singularities(planar_2r, task, method=method, samples=20)  # the pose of a 2R arm has rank 2 everywhere
    assert found.status is SingularSetStatus[status]
    assert sentence in found.explain().splitlines()
    assert found.complete == (method == "symbolic")
    if found.complete:
        assert found.require() is found
    else:
        with pytest.raises(NotConverged, match=sentence) as raised:
            found.require()
        assert raised.value.result is found


def test_explain_says_where_what_is_lost_and_what_does_not_matter(pose_set, point_set):
    text = pose_set.explain()
    for words in (
        "q1 and q3 never matter.",
        "1–2. q2 = −π/2 or π/2, whatever q1 and q3: the rank is 2 instead of 3",
        "Where q2 = π/2\n",
        "a task velocity (x, y, φ) with a part along (0, 1, l3·sin(q3)) cannot be realised",
        "joint velocities along (l2, 1, −1) do not move the task",
        "These are all singular configurations.",
    ):
        assert words in text
    text = point_set.explain()
    assert "q1 never matters." in text
    assert "4. q2 = π/2, q3 = π, whatever q1: the rank is 1 instead of 2" in text
    assert "a task velocity (x, y) with a part along (0, 1) cannot be realised" in text
    assert "a force along (0, 1) needs no joint torque" in text


def test_a_search_by_numbers_says_so_and_gives_an_example(prr):
    text = find_singularities(prr, POSE, method="numeric").explain()
    for words in (
        "For example at q = (",
        "joint velocities along (0.6000, 1, -1) do not move the task",
        "This was a search: it does not prove that there are no others.",
    ):
        assert words in text


@pytest.mark.parametrize(("name", "task"), [("prr", POINT), ("anthropomorphic", SPACE)])
def test_the_same_seed_gives_the_same_branches(name, task):
    a, b = (find_singularities(arm(name), task, seed=3, samples=60) for _ in range(2))
    assert [branch.values for branch in a.branches] == [branch.values for branch in b.branches]
    assert all(np.array_equal(x.samples, y.samples) for x, y in zip(a.branches, b.branches, strict=True))


@pytest.mark.parametrize("seed", [1, 2])
def test_another_seed_gives_the_same_set(prr, seed):
    found = find_singularities(prr, POINT, seed=seed)
    assert sorted(key(branch.values) for branch in found.branches) == sorted(
        key({"q2": q2, "q3": q3}) for q2, q3 in cf.PRR_POSITION_SINGULAR
    )


def test_global_random_state_is_untouched(prr):
    before = np.random.get_state()[1].copy()  # noqa: NPY002
    find_singularities(prr, POSE, samples=10)
    assert np.array_equal(before, np.random.get_state()[1])  # noqa: NPY002
