"""What `IKSolver` refuses: each error is typed, and says what would be right; of a batch it says which target."""

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from joint_kinds import KINDS

from robotics1 import (
    FunctionTask,
    IKSolver,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    PositionTask,
    TaskError,
    UnknownNameError,
    forward_kinematics,
    load_robot,
    solve_ik,
)

XY, POSE = PositionTask("xy"), PoseTask()
USERS = FunctionTask(lambda p, R, q: p[:2], 2)
ORTHONORMAL = "columns must be orthonormal and right-handed"
TWO = r"must have shape \(2,\)"


def pose_with(row, column, value):
    T = forward_kinematics(arm("six_r"), np.ones(6)).homogeneous
    T[row, column] = value
    return T


def stretched(factor):
    T = forward_kinematics(arm("six_r"), np.ones(6)).homogeneous
    T[:3, :3] *= factor
    return T


def mirrored():
    T = stretched(1)
    T[:3, 0] *= -1
    return T


BAD_POSES = {
    "NaN position": (pose_with(0, 3, np.nan), "must be finite"),
    "infinite position": (pose_with(1, 3, -np.inf), "must be finite"),
    "NaN rotation": (pose_with(1, 1, np.nan), "must be finite"),
    "sheared": (pose_with(0, 0, 0.9), ORTHONORMAL),
    "stretched by 1e-6": (stretched(1 + 1e-6), ORTHONORMAL),
    "mirrored": (mirrored(), ORTHONORMAL),
    "zero rotation": (stretched(0), ORTHONORMAL),
}
BAD_SHAPES = {
    "last row": (pose_with(3, 0, 0.1), r"last row \(0, 0, 0, 1\)"),
    "rotation alone": (np.eye(3), r"shape \(4, 4\).*pin\.SE3 or a homogeneous matrix"),
    "six numbers": (np.zeros(6), r"shape \(4, 4\)"),
    "text": ("here", "real numbers"),
    "None": (None, r"pin\.SE3 or a homogeneous matrix"),
    "complex": (1j * np.eye(4), "real numbers"),
}


@pytest.mark.parametrize(("target", "said"), [*BAD_POSES.values(), *BAD_SHAPES.values()], ids=[*BAD_POSES, *BAD_SHAPES])
def test_a_target_that_is_no_pose_is_refused_and_in_a_batch_by_its_number(target, said):
    solver, right = IKSolver(arm("six_r"), POSE), forward_kinematics(arm("six_r"), np.ones(6))
    with pytest.raises(InputError, match=said):
        solver(target)
    with pytest.raises(InputError, match=f"target 1 of the batch: .*{said}"):
        solver.solve_batch([right, target, right])


@pytest.mark.parametrize(("target", "said"), BAD_POSES.values(), ids=BAD_POSES)
def test_so_it_is_of_an_se3_which_pinocchio_takes_unchecked(target, said):
    solver, right = IKSolver(arm("six_r"), POSE), forward_kinematics(arm("six_r"), np.ones(6))
    wrong = pin.SE3(target[:3, :3], target[:3, 3])
    with pytest.raises(InputError, match=said):
        solver(wrong)
    with pytest.raises(InputError, match=f"target 2 of the batch: .*{said}"):
        solver.solve_batch([right, right, wrong])
    with pytest.raises(InputError, match=f"target 0 of the batch: .*{said}"):
        solver.solve_batch([wrong])


@pytest.mark.parametrize("defect", [1e-9, 4e-7, -4e-7])
def test_a_rotation_is_taken_with_a_defect_below_1e_6(defect):
    """RᵀR − 1 = 2 defect."""
    target = stretched(1 + defect)
    found = solve_ik(arm("six_r"), POSE, target)
    assert found.converged
    assert np.linalg.norm(POSE.error(arm("six_r"), found.q, target)) <= 1e-6 + 1e-12


def test_the_limit_of_the_defect_is_1e_6_to_rounding():
    """The kernel sums RᵀR in its own way: a defect of 1e-6 to rounding is taken, one of 1e-6 (1 + 1e-5) is not."""
    six_r, rng = arm("six_r"), np.random.default_rng(20)
    solver = IKSolver(six_r, POSE)
    for q in rng.uniform(-3, 3, (200, 6)):
        exact = forward_kinematics(six_r, q)
        at_limit, beyond = exact.homogeneous, exact.homogeneous
        at_limit[:3, :3] *= np.sqrt(1 + 1e-6 * (1 + rng.uniform(-4e-10, 4e-10)))
        beyond[:3, :3] *= np.sqrt(1 + 1e-6 * (1 + 1e-5))
        batch = solver.solve_batch([at_limit, at_limit])
        assert batch.converged.all()
        reached = forward_kinematics(six_r, batch.q[0])
        assert np.linalg.norm(reached.translation - exact.translation) <= 1e-6
        assert np.linalg.norm(pin.log3(reached.rotation.T @ exact.rotation)) <= 1e-6
        with pytest.raises(InputError, match="target 1 of the batch: the target's rotation is no rotation"):
            solver.solve_batch([at_limit, beyond])


def test_the_error_of_a_printed_rotation_names_what_makes_it_exact():
    with pytest.raises(InputError, match=r"\|RᵀR − 1\|.*nearest_rotation\(R\)\.rotation is exact"):
        solve_ik(arm("six_r"), POSE, np.round(stretched(1), 3))


@pytest.mark.parametrize(
    ("target", "said"),
    [
        ([np.nan, 0], "must be finite"),
        ([np.inf, 0], "must be finite"),
        ([1], TWO + ", (the coordinates x, y|one number for each row)"),
        ([1, 2, 3], TWO),
        ([[1, 2]], TWO),
        (None, TWO),
        (b"ab", "real numbers"),
        ([1, 1j], "real numbers"),
    ],
)
@pytest.mark.parametrize("task", [XY, USERS], ids=["position", "function"])
def test_a_target_of_another_form_is_refused(planar_2r, task, target, said):
    solver = IKSolver(planar_2r, task)
    with pytest.raises(InputError, match=said):
        solver(target)
    with pytest.raises(InputError, match=f"target 1 of the batch: .*{said}"):
        solver.solve_batch([[1, 1], target])


@pytest.mark.parametrize(
    ("task", "target", "said"),
    [
        (OrientationTask(), 1.1 * np.eye(3), ORTHONORMAL),
        (OrientationTask(), np.eye(4), r"shape \(3, 3\)"),
        (OrientationTask(angles="ZYZ"), [1, 2], r"shape \(3,\), ZYZ angles \[rad\]"),
        (PoseTask(angles="ZYZ"), np.eye(4), r"shape \(6,\), a position \[m\] and three angles"),
        (PointingTask(), [0, 0, 0], "must have a direction"),
        (PointingTask(), [0, np.nan, 1], "must be finite"),
    ],
)
def test_so_are_directions_and_orientations(task, target, said):
    with pytest.raises(InputError, match=said):
        solve_ik(arm("six_r"), task, target)


def test_angles_that_are_singular_at_the_target_are_refused_and_in_a_batch_by_their_number():
    solver = IKSolver(arm("six_r"), OrientationTask(angles="ZYZ"))
    with pytest.raises(TaskError, match=r"the target's ZYZ angles are singular.*use angles= with another sequence"):
        solver([0.1, 0, 0.3])
    with pytest.raises(TaskError, match=r"target 1 of the batch: the target's ZYZ angles are singular"):
        solver.solve_batch([[0.1, 0.2, 0.3], [0.1, 0, 0.3]])


@pytest.mark.parametrize(
    ("targets", "said"),
    [
        ([], "there is no target in targets"),
        (np.zeros((0, 2)), "there is no target in targets"),
        (None, "must be a sequence of targets, not NoneType"),
        (5, "must be a sequence of targets, not int"),
        (pin.SE3.Identity(), "must be a sequence of targets, not SE3"),
        ([1.0, 1.0], "target 0 of the batch"),  # one target, not a batch of one
    ],
)
@pytest.mark.parametrize("task", [XY, USERS], ids=["position", "function"])
def test_a_batch_without_targets_is_refused(planar_2r, task, targets, said):
    with pytest.raises(InputError, match=said):
        IKSolver(planar_2r, task).solve_batch(targets)


@pytest.mark.parametrize(
    ("q0", "said"),
    [
        ([np.nan, 0], "must be finite"),
        (np.array([0, np.inf]), "must be finite"),
        ([1], TWO + ", one number for each of q1, q2"),
        ([1, 2, 3], TWO),
        ([[1, 2]], TWO),
        (5, TWO),
        (b"ab", "real numbers"),
        ([1, 1j], "real numbers"),
    ],
)
@pytest.mark.parametrize("task", [XY, USERS], ids=["position", "function"])
def test_a_start_that_is_no_configuration_is_refused(planar_2r, task, q0, said):
    with pytest.raises(InputError, match=f"q.*{said}"):
        IKSolver(planar_2r, task)([1, 1], q0)


@pytest.mark.parametrize(
    ("q0", "said"),
    [
        ([[1, 2]], r"q0 must have shape \(2, 2\), one start for each target"),
        (np.zeros((2, 3)), r"q0 must have shape \(2, 2\), one start for each target"),
        (np.zeros((2, 2, 2)), r"q0 must have shape \(2, 2\)"),
        ([[0, 0], [np.nan, 0]], "q0 must be finite"),
        ([[1, 2], [3]], "q0 must be an array of numbers"),
        ([np.nan, 0], "must be finite"),
        ([1], TWO),
    ],
)
@pytest.mark.parametrize("task", [XY, USERS], ids=["position", "function"])
def test_the_starts_of_a_batch_are_one_for_all_or_one_for_each(planar_2r, task, q0, said):
    with pytest.raises(InputError, match=said):
        IKSolver(planar_2r, task).solve_batch([[1, 1], [0, 1]], q0)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"seed": -1}, "seed must be an integer of at least 0"),
        ({"seed": 1.5}, "seed must be an integer of at least 0"),
        ({"seed": None}, "seed must be an integer"),
        ({"seed": True}, "seed must be an integer"),
        ({"time_limit": 0}, "time_limit must be a positive number"),
        ({"time_limit": np.nan}, "time_limit must be a positive number"),
        ({"time_limit": np.inf}, "time_limit must be a positive number"),
        ({"time_limit": "long"}, "time_limit must be a positive number"),
        ({"tolerance": 0}, "tolerance must be a positive number"),
        ({"tolerance": -1e-6}, "tolerance must be a positive number"),
        ({"tolerance": np.nan}, "tolerance must be a positive number"),
        ({"prefer": "best"}, "prefer must be one of 'any', 'near', 'middle'"),
        ({"prefer": None}, "prefer must be one of"),
    ],
)
def test_options_of_a_wrong_value_are_refused(planar_2r, options, said):
    for task in (XY, USERS):
        with pytest.raises(InputError, match=said):
            IKSolver(planar_2r, task, **options)
    with pytest.raises(InputError, match=said):
        solve_ik(planar_2r, XY, [1, 1], **options)


def test_a_preference_needs_a_task_on_one_frame(planar_2r):
    with pytest.raises(InputError, match="needs a task on one frame, such as PoseTask; this one takes 'any'"):
        IKSolver(planar_2r, USERS, prefer="near")


@pytest.mark.parametrize("reference", ["tool", "link2"])
def test_axes_that_move_with_the_robot_are_refused(reference):
    with pytest.raises(TaskError, match=f"the axes of '{reference}' move with the robot.*use reference='world'"):
        IKSolver(arm("six_r"), PoseTask(reference=reference))


def test_frames_that_do_not_exist_are_refused_with_those_that_do():
    for task in (PoseTask(frame="tol"), PoseTask(reference="tol")):
        with pytest.raises(UnknownNameError, match="'tol'; did you mean 'tool'"):
            IKSolver(arm("six_r"), task)
    with pytest.raises(InputError, match=r"name the tool.*'gripper', 'camera'"):
        IKSolver(arm("two_tips"), XY)


def test_a_frame_that_no_joint_moves_is_refused():
    with pytest.raises(TaskError, match="nothing moves this task: there is no joint between the base and its frame"):
        IKSolver(arm("six_r"), PoseTask(frame="base"))


def test_a_task_that_does_not_fit_the_robot_is_refused():
    with pytest.raises(TaskError, match=r"leaves the xy plane.*use another plane, PositionTask or PoseTask"):
        IKSolver(arm("six_r"), PlanarPoseTask("xy"))


def of_kind(folder, kind):
    path = folder / "robot.urdf"
    path.write_text(KINDS[kind][0], encoding="utf-8")
    return load_robot(path)


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_joints_with_several_degrees_of_freedom_are_refused(tmp_path, kind):
    for task in (POSE, USERS):
        with pytest.raises(InputError, match="only arms of revolute and prismatic joints"):
            IKSolver(of_kind(tmp_path, kind), task)


def test_a_robot_without_joints_is_refused(tmp_path):
    with pytest.raises(TaskError, match="nothing moves this task"):
        IKSolver(of_kind(tmp_path, "fixed"), POSE)


def test_a_users_function_that_fails_or_tells_nonsense_is_named(planar_2r):
    with pytest.raises(TaskError, match=r"the task's function failed at q = .*ZeroDivisionError"):
        solve_ik(planar_2r, FunctionTask(lambda p, R, q: 1 / 0, 1), [1])
    with pytest.raises(TaskError, match=r"must return finite numbers of shape \(2,\)"):
        solve_ik(planar_2r, FunctionTask(lambda p, R, q: [np.nan, 0], 2), [1, 1])
