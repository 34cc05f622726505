"""Several tasks at once: rows below one another, in every generic question."""

import numpy as np
import pytest
import sympy
from arms import arm, random_q
from differences import derivative

import robotics1 as r1
from robotics1 import StackedTask
from robotics1.ik import IKStatus

THREE_R = arm("planar_3r")
TIP, ELBOW = r1.PositionTask("xy"), r1.PositionTask("y", frame="link2")
BOTH = StackedTask([TIP, ELBOW])
Q = np.array([0.3, 0.5, 0.4])


def test_value_and_jacobian_are_those_of_the_tasks_one_below_the_other():
    assert BOTH.value(THREE_R, Q) == pytest.approx([*TIP.value(THREE_R, Q), *ELBOW.value(THREE_R, Q)])
    J = BOTH.jacobian(THREE_R, Q)
    assert np.array_equal(J, np.vstack([TIP.jacobian(THREE_R, Q), ELBOW.jacobian(THREE_R, Q)]))
    assert derivative(lambda q: BOTH.value(THREE_R, q), Q) == pytest.approx(J, abs=1e-9)
    assert (BOTH.rows, BOTH.row_names, BOTH.row_units) == (3, ("x", "y_1", "y_2"), ("m", "m", "m"))


def test_a_target_is_one_for_each_task_or_all_numbers_in_a_row():
    target = [[1.0, 0.5], [0.2]]
    wanted = np.array([1.0, 0.5, 0.2]) - BOTH.value(THREE_R, Q)
    for given in (target, [1.0, 0.5, 0.2], np.array([1.0, 0.5, 0.2]), (np.array([1.0, 0.5]), [0.2])):
        assert BOTH.error(THREE_R, Q, given) == pytest.approx(wanted)
        assert BOTH.target(given) == pytest.approx([1.0, 0.5, 0.2])


def test_poses_and_angles_keep_their_own_errors():
    robot = arm("six_r")
    q, other = random_q(robot, 1), random_q(robot, 2)
    task = StackedTask([r1.PoseTask(), r1.PositionTask("z", frame=robot.frame_names[3])])
    target = task.value(robot, other)
    assert target[0] == r1.PoseTask().value(robot, other)
    parts = [part.error(robot, q, r) for part, r in zip(task.tasks, target, strict=True)]
    assert task.error(robot, q, target) == pytest.approx(np.concatenate(parts))
    planar = StackedTask([r1.PlanarPoseTask(), r1.PlanarPoseTask(frame="link1")])
    e = planar.error(THREE_R, [3.0, 0, 0], planar.value(THREE_R, [-3.0, 0, 0]))
    assert e[[2, 5]] == pytest.approx([2 * np.pi - 6] * 2)


def test_inverse_kinematics_reaches_both_targets():
    target = BOTH.value(THREE_R, Q)
    found = r1.solve_ik(THREE_R, BOTH, target, [0.1, 0.2, 0.3]).require()
    assert BOTH.value(THREE_R, found.q) == pytest.approx(target, abs=1e-6)
    newton = r1.iterate_ik(THREE_R, BOTH, target, [0.25, 0.55, 0.45], tolerance=1e-10)
    assert newton.status is IKStatus.CONVERGED
    assert newton.q == pytest.approx(Q, abs=1e-8)
    away = r1.solve_ik(THREE_R, BOTH, [0.0, 0.0, 5.0], time_limit=0.2)
    assert away.status is not IKStatus.CONVERGED


def test_all_solutions_hold_both_elbows():
    lengths = [THREE_R.parameters[name] for name in ("l1", "l2", "l3")]
    found = r1.ik_solutions(THREE_R, BOTH, BOTH.value(THREE_R, Q))
    for q in found.q:
        angles = np.cumsum(q)
        assert lengths @ np.cos(angles) == pytest.approx(TIP.value(THREE_R, Q)[0], abs=1e-6)
        assert BOTH.value(THREE_R, q) == pytest.approx(BOTH.value(THREE_R, Q), abs=1e-6)
    assert np.abs(found.q - Q).max(axis=1).min() < 1e-6


def test_singularities_are_found_by_numbers_where_l1_l2_cos_q1_sin_q12_vanishes():
    """x of the tip and y of the elbow: J = [[−l1 s1 − l2 s12, −l2 s12], [l1 c1, 0]]."""
    robot = arm("planar_2r")
    task = StackedTask([r1.PositionTask("x"), r1.PositionTask("y", frame="link2")])
    found = r1.find_singularities(robot, task, method="numeric")
    values = {round(branch.values["q1"], 6) for branch in found.branches if "q1" in branch.values}
    assert values == {round(np.pi / 2, 6), round(-np.pi / 2, 6)}
    others = [branch for branch in found.branches if "q1" not in branch.values]
    assert others
    for branch in others:
        assert np.sin(branch.q.sum()) == pytest.approx(0, abs=1e-8)
    assert r1.scan_singularities(robot, task, samples=50).count == 50


def test_rates_of_both_tasks_are_realised_at_once():
    wanted = np.array([0.1, -0.2, 0.05])
    moved = r1.trajectories.joint_velocity(THREE_R, BOTH, wanted, Q)
    assert BOTH.jacobian(THREE_R, Q) @ moved.qdot == pytest.approx(wanted, abs=1e-12)
    assert r1.singularities.manipulability(THREE_R, BOTH, Q).measure == pytest.approx(
        abs(np.linalg.det(BOTH.jacobian(THREE_R, Q)))
    )


def test_tasks_on_one_frame_have_formulas_as_one():
    robot = arm("planar_2r")
    both, plane = StackedTask([r1.PositionTask("x"), r1.PositionTask("y")]), r1.PositionTask("xy")
    assert r1.formulas(robot, both).jacobian == r1.formulas(robot, plane).jacobian
    assert r1.formulas(robot, both).determinant == r1.formulas(robot, plane).determinant
    assert len(r1.ik_formulas(robot, both).branches) == 2
    assert r1.find_singularities(robot, both).method == "symbolic"
    high = StackedTask([r1.PositionTask("xy"), r1.PositionTask("z")])
    assert r1.formulas(arm("spatial"), high).jacobian == r1.formulas(arm("spatial"), r1.PositionTask()).jacobian


def test_a_stack_of_one_is_that_task():
    alone = StackedTask([TIP])
    assert alone.row_names == ("x", "y")
    assert r1.formulas(THREE_R, alone).value == r1.formulas(THREE_R, TIP).value
    assert len(r1.ik_solutions(arm("planar_2r"), alone, [0.5, 0.6])) == 2


def test_a_function_is_stacked_too():
    distance = r1.FunctionTask(lambda p, R, q: [p @ p], 1)
    task = StackedTask([distance, r1.PositionTask("y", frame="link2")])
    assert task.jacobian(THREE_R, Q) == pytest.approx(derivative(lambda q: task.value(THREE_R, q), Q), abs=1e-8)
    assert task.frame_map() is None
    found = r1.solve_ik(THREE_R, task, task.value(THREE_R, Q)).require()
    assert task.value(THREE_R, found.q) == pytest.approx(task.value(THREE_R, Q), abs=1e-6)


def test_tasks_on_several_frames_have_formulas_of_their_own():
    with pytest.raises(r1.FormulaError, match="formulas are written for tasks on a frame"):
        r1.formulas(THREE_R, BOTH)
    q1, l1 = sympy.symbols("q1 l1", real=True)
    assert r1.formulas(THREE_R, ELBOW).value[0] == l1 * sympy.sin(q1)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: StackedTask([]), "tasks must be a list of tasks"),
        (lambda: StackedTask(TIP), "tasks must be a list of tasks"),
        (lambda: StackedTask("xy"), "tasks must be a list of tasks"),
        (lambda: StackedTask([r1.PositionTask]), "write PositionTask"),
        (lambda: StackedTask([TIP, THREE_R]), "a robot stands in the place of the task"),
        (lambda: BOTH.error(THREE_R, Q, [1.0, 2.0]), "the coordinates x, y|one target for each of the 2 tasks"),
        (lambda: BOTH.error(THREE_R, Q, 3), "one target for each of the 2 tasks, or 3 numbers"),
        (lambda: BOTH.error(THREE_R, Q, [[1.0, 2.0], [np.nan]]), "must be finite"),
        (lambda: BOTH.error(THREE_R, Q, np.zeros(4)), r"the target must have shape \(3,"),
    ],
)
def test_what_is_no_stack_or_no_target_is_refused(call, words):
    with pytest.raises(r1.InputError, match=words):
        call()


def test_a_task_that_does_not_fit_is_named():
    with pytest.raises(r1.TaskError, match="plane"):
        StackedTask([r1.PositionTask(), r1.PlanarPoseTask()]).value(arm("six_r"), np.zeros(6))
    with pytest.raises(r1.UnknownNameError, match="elbow"):
        StackedTask([TIP, r1.PositionTask(frame="elbow")]).value(THREE_R, Q)


def test_weights_say_which_of_two_contradictory_tasks_is_missed_by_how_much():
    """A slide asked to stand at 0 and at 1: w₁ q² + w₂ (1 − q)² is least at q = w₂/(w₁ + w₂)."""
    slide = r1.planar_arm("P", lengths=[])
    for w1, w2 in ((1, 1), (1, 3), (10, 0.1)):
        task = r1.StackedTask(["position:x", "position:x"], weights=[w1, w2])
        assert task.error(slide, [0.25], [[0.0], [1.0]]) == pytest.approx([-0.25 * np.sqrt(w1), 0.75 * np.sqrt(w2)])
        assert task.jacobian(slide, [0.25]) == pytest.approx(np.sqrt([[w1], [w2]]))
        q = r1.iterate_ik(slide, task, [[0.0], [1.0]], [0.25], method="pseudoinverse", max_iterations=3).q
        assert q == pytest.approx([w2 / (w1 + w2)], abs=1e-12)


def test_weights_change_no_solution_that_meets_all_tasks():
    arm = r1.planar_arm("RRR", lengths=[1, 1, 1])
    pieces = [r1.PositionTask("xy"), r1.OrientationTask()]
    q = [0.3, 0.7, -0.4]
    target = (r1.PositionTask("xy").value(arm, q), r1.OrientationTask().value(arm, q))
    found = r1.solve_ik(arm, r1.StackedTask(pieces, weights=[4, 1]), target, [0.2, 0.8, -0.3]).require()
    assert r1.forward_kinematics(arm, found.q).homogeneous == pytest.approx(
        r1.forward_kinematics(arm, q).homogeneous, abs=1e-6
    )


@pytest.mark.parametrize("weights", [[1], [1, 0], [1, -2], [1, np.nan], 1, ["a", 1]])
def test_weights_are_one_positive_number_a_task(weights):
    with pytest.raises(r1.InputError, match="weights"):
        r1.StackedTask(["position:x", "position:y"], weights=weights)
