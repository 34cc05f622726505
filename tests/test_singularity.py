from functools import partial
from math import inf, pi

import closed_forms as cf
import numpy as np
import pytest
from arms import arm
from differences import key, sigma
from sweeps import some_of

from robotics1 import (
    FunctionTask,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    UnknownNameError,
    find_singularities,
)

numeric = partial(find_singularities, method="numeric", time_limit=600)  # so that a slow machine answers the same
PRR = ({"q2": -pi / 2}, {"q2": pi / 2})
PRR_POINT = tuple({"q2": q2, "q3": q3} for q2, q3 in cf.PRR_POSITION_SINGULAR)
STRETCHED = ({"q2": 0.0}, {"q2": pi})
IN_LINE = tuple({"q2": a, "q3": b} for a in (0.0, pi) for b in (0.0, pi))
SRS = (
    {"q4": 0.0},
    *({"q2": 0.0, "q3": sign * pi / 2} for sign in (-1, 1)),
    {"q2": 0.0, "q6": 0.0},
    *({"q5": sign * pi / 2, "q6": 0.0} for sign in (-1, 1)),
)
POINT, POSE, SPACE = PositionTask("xy"), PlanarPoseTask("xy"), PositionTask("xyz")

# Sets whose branches are constant joint values: robot, task, lengths, generic rank, (values), free joints in all.
CONSTANT = [
    ("prr", POSE, {}, 3, PRR, {"q1", "q3"}),
    ("prr", POSE, {"l2": 0.5, "l3": 0.5}, 3, PRR, {"q1", "q3"}),
    ("prr", POINT, {}, 2, PRR_POINT, {"q1"}),
    ("prr", POINT, {"l2": 0.5, "l3": 0.5}, 2, PRR_POINT, {"q1"}),
    ("prr", POINT, {"l2": 0.5, "l3": 0.5005}, 2, PRR_POINT, {"q1"}),
    ("prr", POINT, {"l2": 0.2, "l3": 1.1}, 2, PRR_POINT, {"q1"}),
    ("cylindrical", SPACE, {}, 3, ({"q3": 0.0},), {"q1", "q2"}),
    ("planar_2r", POINT, {}, 2, STRETCHED, {"q1"}),
    ("planar_2r", POINT, {"l1": 0.7, "l2": 0.7}, 2, STRETCHED, {"q1"}),
    ("planar_3r", POINT, {}, 2, IN_LINE, {"q1"}),
    ("planar_3r", POINT, {"l1": 0.7, "l2": 0.4, "l3": 0.3}, 2, IN_LINE, {"q1"}),
    ("planar_3r", POSE, {}, 3, STRETCHED, {"q1", "q3"}),
    ("vertical_2r", PositionTask("zx"), {}, 2, STRETCHED, {"q1"}),
    ("redundant", PoseTask(), {}, 6, SRS, {"q1", "q7"}),
]
WORDS = [f"{name}-{'-'.join(task.row_names)}-{lengths}" for name, task, lengths, *_ in CONSTANT]
EACH_TIME = {("numeric", 0), ("numeric", 2), ("numeric", 6), ("numeric", 9), *(("symbolic", i) for i in range(13))}
NOW_AND_THEN = {5, 12, 13}  # unequal lengths, a vertical plane, a redundant arm


def when(method, i):
    return () if (method, i) in EACH_TIME else pytest.mark.sweep if i in NOW_AND_THEN else pytest.mark.fuzz


BOTH = [
    pytest.param(*case, method, id=f"{words}-{method}", marks=when(method, i))
    for i, (case, words) in enumerate(zip(CONSTANT, WORDS, strict=True))
    for method in ("numeric", "symbolic")
]


def assert_samples_are_singular(found, least=50):
    robot = found.robot
    for branch in found.branches:
        assert branch.samples.shape == (max(len(branch.samples), least if branch.dimension else 1), robot.nq)
        for q in branch.samples:
            assert sigma(found.task, robot, q) <= 1e-10
            assert robot.within_limits(q)
            for name, value in branch.values.items():
                assert q[robot.joint_names.index(name)] == pytest.approx(value, abs=1e-12)
        values = np.linalg.svd(found.task.jacobian(robot, branch.q), compute_uv=False)
        assert (values > 1e-9 * values[0]).sum() == branch.rank < found.generic_rank
        assert branch.dimension == robot.nv - len(branch.values) - (1 if branch.tied_joints else 0)


@pytest.mark.parametrize(("name", "task", "lengths", "rank", "values", "free", "method"), BOTH)
def test_singular_set_is_the_closed_form_and_its_samples_are_singular(name, task, lengths, rank, values, free, method):
    robot = arm(name, **lengths)
    found = find_singularities(robot, task, method=method, time_limit=600)
    assert found.generic_rank == rank
    assert sorted(key(branch.values) for branch in found.branches) == sorted(map(key, values))
    assert set(found.free_joints) == free
    for branch in found.branches:
        assert set(branch.free_joints) == set(robot.joint_names) - set(branch.values)
        assert branch.tied_joints == ()
    assert_samples_are_singular(found)
    assert found.complete == (method == "symbolic")


# --- curved branches


@pytest.mark.parametrize(
    ("a2", "a3"),
    [(0.35, 0.5), pytest.param(0.5, 0.35, marks=pytest.mark.sweep), pytest.param(0.5, 0.2, marks=pytest.mark.fuzz)],
)
def test_anthropomorphic_singularities_are_the_elbow_and_the_two_shoulder_loops(a2, a3):
    found = numeric(arm("anthropomorphic", a2=a2, a3=a3), SPACE)
    elbow = [branch for branch in found.branches if branch.values]
    loops = [branch for branch in found.branches if not branch.values]
    assert [key(branch.values) for branch in elbow] == [(("q3", 0.0),), (("q3", round(pi, 9)),)]
    assert len(loops) == 2
    for branch in loops:
        assert branch.dimension == 2
        assert branch.free_joints == ("q1",)
        assert branch.tied_joints == ("q2", "q3")
        for q in branch.samples:
            assert cf.shoulder(q, a2, a3) == pytest.approx(0, abs=1e-9)
    assert found.free_joints == ("q1",)
    assert_samples_are_singular(found)


@pytest.mark.sweep
@pytest.mark.parametrize(("a2", "a3"), [(0.35, 0.5), (0.5, 0.35)])
def test_the_two_shoulder_loops_are_apart_from_each_other(a2, a3):
    """For a2 < a3 the upper arm angle q2 goes round and q2 + q3 stays near ±π/2, for a2 > a3 the other way round."""
    found = numeric(arm("anthropomorphic", a2=a2, a3=a3), SPACE)
    loops = [branch.samples for branch in found.branches if branch.tied_joints == ("q2", "q3")]
    sides = [np.sign(np.sin(q[:, 1] + (q[:, 2] if a2 < a3 else 0))) for q in loops]
    assert sorted(side[0] for side in sides) == [-1, 1]
    assert all((side == side[0]).all() for side in sides)


@pytest.mark.parametrize("seed", some_of(range(3), 1))
def test_six_r_singularities_are_shoulder_elbow_and_wrist(seed):
    found = numeric(arm("six_r"), PoseTask(), seed=seed)
    constant = sorted(key(branch.values) for branch in found.branches if branch.values)
    assert constant == sorted(key({name: value}) for name in ("q3", "q5") for value in (0.0, pi))
    loops = [branch for branch in found.branches if not branch.values]
    assert [branch.tied_joints for branch in loops] == [("q2", "q3")] * 2
    assert max(abs(cf.shoulder(q, 0.5, 0.35)) for branch in loops for q in branch.samples) < 1e-9
    assert set(found.free_joints) == {"q1", "q4", "q6"}
    assert_samples_are_singular(found)


# --- limits and boxes


def test_an_arm_whose_limits_exclude_every_singularity_has_none():
    found = numeric(arm("elbow_limited"), POINT, samples=30)
    assert found.generic_rank == 2
    assert found.branches == ()
    assert "No singular configuration was found." in found.explain()


@pytest.mark.parametrize(
    ("interval", "values"), [((-0.5, 2.0), [0.0]), ((0.5, pi), [pi]), ((-pi, -0.5), [-pi]), ((-4, 4), None)]
)
def test_a_box_keeps_the_branches_inside_it(planar_2r, interval, values):
    if values is None:
        with pytest.raises(InputError, match="must lie in its limits"):
            numeric(planar_2r, POINT, box={"q2": interval})
        return
    found = numeric(planar_2r, POINT, box={"q2": interval}, samples=60)
    assert [branch.values["q2"] for branch in found.branches] == pytest.approx(values, abs=1e-9)
    lower, upper = interval
    assert all(lower - 1e-9 <= q[1] <= upper + 1e-9 for branch in found.branches for q in branch.samples)


def test_limits_exclude_two_of_the_four_prr_points(prr):
    found = numeric(prr, POINT, box={"q3": (-1, 1)})
    wanted = [key({"q2": sign * pi / 2, "q3": 0.0}) for sign in (-1, 1)]
    assert sorted(key(branch.values) for branch in found.branches) == wanted


# --- degenerate tasks


def test_a_task_with_more_rows_than_its_rank_says_so(planar_2r):
    """z of a planar arm never moves: the rank of the position is 2 everywhere."""
    found = numeric(planar_2r, SPACE)
    assert found.generic_rank == 2
    assert [key(branch.values) for branch in found.branches] == [key(values) for values in STRETCHED]
    assert "The task has 3 rows, but the rank of its Jacobian is 2 everywhere" not in found.explain()


def test_a_task_that_cannot_use_all_its_rows_and_joints_says_so():
    """Three parallel axes: the orientation has rank 1 everywhere, and never loses it."""
    found = numeric(arm("planar_3r"), OrientationTask(), samples=20)
    assert (found.generic_rank, found.branches) == (1, ())
    assert "The task has 3 rows, but the rank of its Jacobian is 1 everywhere" in found.explain()


def test_an_arm_with_one_joint_is_nowhere_singular(one_joint):
    found = numeric(one_joint, PoseTask(), samples=10)
    assert (found.generic_rank, found.branches) == (1, ())


def test_a_task_that_no_joint_moves_is_a_task_error(planar_2r):
    with pytest.raises(TaskError, match="zero everywhere"):
        numeric(planar_2r, PositionTask("z"))


def test_function_tasks_have_the_singularities_of_what_they_compute(planar_2r):
    """(x + y, x − y) is the position turned and stretched; its Jacobian comes from differences."""
    found = numeric(planar_2r, FunctionTask(lambda p, R, q: [p[0] + p[1], p[0] - p[1]], 2), samples=30)
    assert sorted(round(abs(branch.values["q2"]), 6) for branch in found.branches) == [0.0, round(pi, 6)]


def test_a_task_of_one_row_is_singular_where_its_gradient_vanishes():
    """z = −l1 s1 − l2 s12: l2 c12 = 0 and l1 c1 = 0, four points, where J = 0 has rank 0."""
    found = numeric(arm("vertical_2r"), PositionTask("z"), samples=30)
    wanted = [{"q1": q1, "q2": q2} for q1 in (-pi / 2, pi / 2) for q2 in (0.0, pi)]
    assert sorted(key(branch.values) for branch in found.branches) == sorted(map(key, wanted))
    assert {branch.rank for branch in found.branches} == {0}


# --- misuse


@pytest.mark.parametrize(
    "options",
    [
        {"method": "guess"},
        {"samples": 0},
        {"samples": 1.5},
        {"seed": -1},
        {"box": {"q2": (1, 0)}},
        {"box": {"q2": 3}},
        {"box": {"q1": (-inf, inf)}},
    ],
)
def test_bad_options_are_input_errors(prr, options):
    with pytest.raises(InputError):
        numeric(prr, POSE, **options)


def test_a_box_of_an_unknown_joint_lists_the_joints(prr):
    with pytest.raises(UnknownNameError) as caught:
        numeric(prr, POSE, box={"q9": (0, 1)})
    assert caught.value.candidates == ("q1", "q2", "q3")


def test_a_planar_pose_of_a_spatial_arm_is_a_task_error(spatial):
    with pytest.raises(TaskError):
        numeric(spatial, POSE)
