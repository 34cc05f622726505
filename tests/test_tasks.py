import copy
import pickle
from dataclasses import fields, replace
from math import nan, pi

import closed_forms as cf
import numpy as np
import pinocchio as pin
import pytest
from arms import arm, configurations, random_q
from differences import derivative
from hypothesis import example, given

from robotics1 import (
    FormulaError,
    FunctionTask,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    PositionTask,
    TaskError,
    UnknownNameError,
    formulas,
    forward_kinematics,
    frame_jacobian,
    ik_solutions,
    scan_singularities,
    solve_ik,
)

PLANAR = {"prr": "xy", "planar_2r": "xy", "planar_3r": "xy", "vertical_2r": "xz"}


def squares(p, R, q):
    return [p @ p, R[2, 0] + q[0] ** 2]


# --- values by hand


@given(configurations(arm("prr")))
@example(np.array([0.0, 0.0, np.nextafter(-pi, 0.0)]))
@example(np.array([0.0, 0.0, -pi]))
def test_prr_planar_pose_is_the_exams_with_phi_wrapped(q):
    x, y, phi = PlanarPoseTask("xy").value(arm("prr"), q)
    wanted = cf.prr_pose(q, 0.6, 0.4)
    assert (x, y) == pytest.approx(tuple(wanted[:2]), abs=1e-14)
    assert np.exp(1j * phi) == pytest.approx(np.exp(1j * wanted[2]), abs=1e-14)
    assert -pi < phi <= pi


@given(configurations(arm("prr")))
def test_prr_planar_pose_determinant_is_l2_cos_q2(q):
    J = PlanarPoseTask("xy").jacobian(arm("prr"), q)
    assert pytest.approx(cf.prr_pose_jacobian(q, 0.6, 0.4), abs=1e-14) == J
    assert np.linalg.det(J) == pytest.approx(cf.prr_pose_determinant(q, 0.6, 0.4), abs=1e-14)


@given(configurations(arm("prr")))
def test_prr_position_minors_are_l2_l3_s3_and_l3_c23_and_l2_c2_plus_l3_c23(q):
    J = PositionTask("xy").jacobian(arm("prr"), q)
    assert pytest.approx(cf.prr_pose_jacobian(q, 0.6, 0.4)[:2], abs=1e-14) == J
    minors = [np.linalg.det(np.delete(J, i, axis=1)) for i in range(3)]
    assert minors == pytest.approx(cf.prr_position_minors(q, 0.6, 0.4), abs=1e-14)


@given(configurations(arm("planar_3r")))
def test_planar_3r_pose_determinant_is_l1_l2_s2(q):
    det = np.linalg.det(PlanarPoseTask("xy").jacobian(arm("planar_3r"), q))
    assert det == pytest.approx(cf.three_link_pose_determinant(q, 0.5, 0.4), abs=1e-14)


@given(configurations(arm("vertical_2r")))
def test_in_the_xz_plane_phi_turns_from_x_to_z_so_it_is_minus_the_angles_about_y(q):
    task, robot = PlanarPoseTask("xz"), arm("vertical_2r")
    x, y = cf.planar_position(q, [0.7, 0.4])
    r = task.value(robot, q)
    assert r[:2] == pytest.approx([x, -y], abs=1e-14)
    assert np.exp(1j * r[2]) == pytest.approx(np.exp(-1j * sum(q)), abs=1e-14)
    assert task.jacobian(robot, q)[2] == pytest.approx([-1, -1], abs=1e-15)


@pytest.mark.parametrize("axes", ["xyz", "xy", "z", "zx", "yxz"])
def test_position_rows_are_the_chosen_axes_in_their_order(spatial, axes):
    task, q = PositionTask(axes), random_q(spatial, 0)
    T, J = cf.spatial_pose_and_jacobian(q)
    rows = ["xyz".index(axis) for axis in axes]
    assert task.rows == len(axes)
    assert task.row_names == tuple(axes)
    assert task.value(spatial, q) == pytest.approx(T[rows, 3], abs=1e-14)
    assert task.jacobian(spatial, q) == pytest.approx(J[rows], abs=1e-14)


def test_pose_and_orientation_values_are_those_of_the_frame(spatial):
    q = random_q(spatial, 1)
    T, J = cf.spatial_pose_and_jacobian(q)
    assert isinstance(PoseTask().value(spatial, q), pin.SE3)
    assert PoseTask().value(spatial, q).homogeneous == pytest.approx(T, abs=1e-14)
    assert OrientationTask().value(spatial, q) == pytest.approx(T[:3, :3], abs=1e-14)
    assert PoseTask().jacobian(spatial, q) == pytest.approx(J, abs=1e-14)
    assert OrientationTask().jacobian(spatial, q) == pytest.approx(J[3:], abs=1e-14)


# --- the error's derivative is −J, at the target itself


@pytest.mark.parametrize(
    ("name", "task"),
    [
        ("spatial", PositionTask("xyz")),
        ("spatial", PositionTask("zy", frame="link4")),
        ("spatial", PositionTask("xyz", reference="base")),
        ("spatial", OrientationTask()),
        ("spatial", OrientationTask(frame="link3")),
        ("spatial", PoseTask()),
        ("redundant", PoseTask()),
        ("continuous", PoseTask()),
        ("one_joint", PoseTask()),
        ("prr", PlanarPoseTask("xy")),
        ("vertical_2r", PlanarPoseTask("xz")),
        ("spatial", FunctionTask(squares, 2)),
    ],
)
@pytest.mark.parametrize("seed", range(2))
def test_error_to_a_nearby_target_falls_as_minus_the_jacobian(name, task, seed):
    robot = arm(name)
    q = 0.9 * random_q(robot, seed)
    target = task.value(robot, q)
    J = task.jacobian(robot, q)
    assert J.shape == (task.rows, robot.nv)
    assert task.error(robot, q, target) == pytest.approx(np.zeros(task.rows), abs=1e-14)
    assert -derivative(lambda x: task.error(robot, x, target), q) == pytest.approx(J, abs=2e-9)


@pytest.mark.parametrize("reference", ["tool", "link2"])
def test_jacobian_in_moving_axes_is_the_world_jacobian_turned(spatial, reference):
    q = random_q(spatial, 5)
    R = forward_kinematics(spatial, q, frame=None if reference == "tool" else reference).rotation
    J = frame_jacobian(spatial, q)
    task = PositionTask("xyz", reference=reference)
    assert task.jacobian(spatial, q) == pytest.approx(R.T @ J[:3], abs=1e-14)
    assert task.value(spatial, q) == pytest.approx(R.T @ forward_kinematics(spatial, q).translation, abs=1e-14)


# --- errors wrap


@pytest.mark.parametrize(
    ("now", "wanted", "error"), [(3.0, -3.0, 2 * pi - 6), (-3.0, 3.0, 6 - 2 * pi), (0.5, 0.2, -0.3)]
)
def test_planar_pose_error_takes_the_short_way_round(prr, now, wanted, error):
    e = PlanarPoseTask("xy").error(prr, [0, now, 0], [0, 0, wanted])
    assert e[2] == pytest.approx(error, abs=1e-14)


def test_planar_pose_error_of_half_a_turn_is_plus_pi(prr):
    assert PlanarPoseTask("xy").error(prr, [0, 0, 0], [0, 0, pi])[2] == pi
    assert PlanarPoseTask("xy").error(prr, [0, 0, 0], [0, 0, -pi])[2] == pi
    assert PlanarPoseTask("xy").error(prr, [0, 0, 0], [0, 0, 2 * pi])[2] == 0


def test_orientation_error_is_angle_times_axis_in_world_axes(spatial):
    q = random_q(spatial, 6)
    R = OrientationTask().value(spatial, q)
    axis, angle = np.array([0.48, 0.6, 0.64]), 2.5
    target = cf.rotation(axis, angle) @ R
    assert OrientationTask().error(spatial, q, target) == pytest.approx(angle * axis, abs=1e-13)
    T = PoseTask().value(spatial, q)
    moved = pin.SE3(target, T.translation + np.array([0.1, -0.2, 0.3]))
    assert PoseTask().error(spatial, q, moved) == pytest.approx([0.1, -0.2, 0.3, *(angle * axis)], abs=1e-13)


def test_pose_targets_may_be_homogeneous_matrices(spatial):
    q, other = random_q(spatial, 7), random_q(spatial, 8)
    T = forward_kinematics(spatial, other)
    assert np.array_equal(PoseTask().error(spatial, q, T), PoseTask().error(spatial, q, T.homogeneous))


# --- what does not fit


@pytest.mark.parametrize("name", ["spatial", "anthropomorphic", "redundant", "vertical_2r", "continuous"])
@pytest.mark.parametrize("call", ["value", "jacobian"])
def test_planar_pose_of_an_arm_that_leaves_the_plane_is_a_task_error(name, call):
    with pytest.raises(TaskError, match="leaves the xy plane"):
        getattr(PlanarPoseTask("xy"), call)(arm(name), random_q(arm(name), 0))


@pytest.mark.parametrize(("name", "plane"), PLANAR.items())
def test_planar_pose_fits_only_the_plane_of_the_arm(name, plane):
    for other in ("xy", "xz", "yz"):
        if other == plane:
            PlanarPoseTask(other).check(arm(name))
        else:
            with pytest.raises(TaskError):
                PlanarPoseTask(other).check(arm(name))


def test_planar_pose_fits_a_frame_of_a_spatial_arm_that_stays_in_the_plane(spatial):
    r = PlanarPoseTask("xy", frame="link1").value(spatial, [0.7, 0.1, 0.2, 0.3, 0.4])
    assert r == pytest.approx([0, 0, 0.7], abs=1e-15)


MATRIX = np.eye(4)
SHEARED = np.array([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]])
MIRROR = np.diag([1.0, 1.0, -1.0])


@pytest.mark.parametrize(
    ("name", "task", "target"),
    [
        ("spatial", PositionTask("xyz"), [1, 2]),
        ("spatial", PositionTask("xy"), [1, 2, 3]),
        ("spatial", PositionTask("z"), 1.0),
        ("spatial", PositionTask("xyz"), [1, 2, nan]),
        ("spatial", PositionTask("xyz"), "here"),
        ("spatial", PositionTask("xyz"), None),
        ("prr", PlanarPoseTask("xy"), [1, 2]),
        ("prr", PlanarPoseTask("xy"), pin.SE3.Identity()),
        ("spatial", OrientationTask(), [0, 0, 0, 2]),
        ("spatial", OrientationTask(), SHEARED),
        ("spatial", OrientationTask(), MIRROR),
        ("spatial", OrientationTask(), 2 * np.eye(3)),
        ("spatial", OrientationTask(), np.full((3, 3), nan)),
        ("spatial", PoseTask(), [1, 2, 3]),
        ("spatial", PoseTask(), MATRIX[:3]),
        ("spatial", PoseTask(), MATRIX + np.eye(4)[[3]].T),
        ("spatial", PoseTask(), np.diag([1, 1, -1, 1])),
        ("spatial", PoseTask(), np.diag([1, 1, 1, 2])),
        ("spatial", FunctionTask(squares, 2), [1, 2, 3]),
    ],
)
def test_a_target_of_the_wrong_form_is_an_input_error(name, task, target):
    with pytest.raises(InputError):
        task.error(arm(name), np.zeros(arm(name).nv), target)


@pytest.mark.parametrize("axes", ["", "xx", "xw", "XY", "xyzx", None, 2])
def test_axes_are_distinct_letters_of_xyz(axes):
    with pytest.raises(InputError, match="distinct letters"):
        PositionTask(axes)


@pytest.mark.parametrize("plane", ["yx", "xyz", "", None])
def test_planes_are_xy_xz_or_yz(plane):
    with pytest.raises(InputError, match="plane must be one of"):
        PlanarPoseTask(plane)


@pytest.mark.parametrize("task", [PositionTask("xy", frame="tol"), PoseTask(reference="tol")])
def test_mistyped_frames_of_a_task_are_unknown_names(prr, task):
    with pytest.raises(UnknownNameError, match="did you mean 'tool'"):
        task.value(prr, [0, 0, 0])
    with pytest.raises(UnknownNameError):
        task.jacobian(prr, [0, 0, 0])


@pytest.mark.parametrize("task", [PositionTask("xy"), PlanarPoseTask("xy"), PoseTask(), FunctionTask(squares, 2)])
@pytest.mark.parametrize("q", [[0, 0], [0, nan, 0], b"abc"])
def test_a_wrong_q_is_an_input_error_in_every_task(prr, task, q):
    for call in (task.value, task.jacobian):
        with pytest.raises(InputError):
            call(prr, q)


# --- the user's own function


def test_function_task_jacobian_by_differences_is_the_hand_derivative(spatial):
    q = random_q(spatial, 9)
    T, J = cf.spatial_pose_and_jacobian(q)
    hand = [2 * T[:3, 3] @ J[:3], np.cross(J[3:].T, T[:3, 0])[:, 2] + 2 * q[0] * np.eye(5)[0]]
    assert FunctionTask(squares, 2).jacobian(spatial, q) == pytest.approx(np.array(hand), abs=1e-8)


def test_function_task_uses_the_jacobian_it_is_given(prr):
    task = FunctionTask(lambda p, R, q: p[:2], 2, jacobian=lambda p, R, q: cf.prr_pose_jacobian(q, 0.6, 0.4)[:2])
    q = random_q(prr, 2)
    assert task.value(prr, q) == pytest.approx(cf.prr_pose(q, 0.6, 0.4)[:2], abs=1e-14)
    assert np.array_equal(task.jacobian(prr, q), cf.prr_pose_jacobian(q, 0.6, 0.4)[:2])


@pytest.mark.parametrize(
    "f",
    [
        lambda p, R, q: p,
        lambda p, R, q: 1.0,
        lambda p, R, q: [nan, 0],
        lambda p, R, q: [1 / 0, 0],
        lambda p: p[:2],
        lambda p, R, q: "ab",
        lambda p, R, q: None,
    ],
)
def test_a_function_that_fails_is_a_task_error(prr, f):
    with pytest.raises(TaskError, match="the task's function"):
        FunctionTask(f, 2).value(prr, [0, 0, 0])


def test_a_given_jacobian_of_the_wrong_shape_is_a_task_error(prr):
    with pytest.raises(TaskError, match=r"shape \(2, 3\)"):
        FunctionTask(squares, 2, jacobian=lambda p, R, q: np.eye(2)).jacobian(prr, [0, 0, 0])


@pytest.mark.parametrize("rows", [0, -1, 1.5, True, "2", None])
def test_the_number_of_rows_is_a_positive_integer(rows):
    with pytest.raises(InputError, match="rows must be an integer"):
        FunctionTask(squares, rows)


# --- a task is a value


def half_turn_jacobian(p, R, q):
    return np.zeros((2, len(q)))


EVERY_TASK = [
    PositionTask("xz", frame="tool"),
    PlanarPoseTask("xz"),
    OrientationTask("ZYZ", fixed=True),
    PoseTask(),
    PointingTask((1, 1, 0)),
    FunctionTask(squares, 2),
    FunctionTask(squares, 2, half_turn_jacobian, units=["m", "rad"]),
]


@pytest.mark.parametrize("task", EVERY_TASK, ids=lambda task: type(task).__name__)
def test_a_task_is_made_again_from_its_fields_copied_pickled_and_hashed(task):
    same = [type(task)(**{f.name: getattr(task, f.name) for f in fields(task)}), replace(task), copy.deepcopy(task)]
    for other in [*same, pickle.loads(pickle.dumps(task))]:
        assert other == task
        assert hash(other) == hash(task)
    elsewhere = replace(task, frame="elbow")
    assert elsewhere.frame == "elbow"
    assert elsewhere != task
    assert replace(elsewhere, frame=task.frame) == task


def test_a_function_task_takes_its_jacobian_by_place_by_name_and_by_the_name_of_its_field():
    by_place = FunctionTask(squares, 2, half_turn_jacobian)
    assert by_place == FunctionTask(squares, 2, jacobian=half_turn_jacobian)
    assert by_place == FunctionTask(squares, 2, derivative=half_turn_jacobian)
    assert replace(FunctionTask(squares, 2), jacobian=half_turn_jacobian) == by_place


# --- a task that is no function of one frame


class TwoHeights:
    """The heights of two frames of one arm: the protocol by hand, without a map of one frame."""

    row_names, row_units, rows = ("y1", "y2"), ("m", "m"), 2

    def value(self, robot, q):
        return np.array([forward_kinematics(robot, q, frame=frame).translation[1] for frame in ("link2", "tool")])

    def target(self, target):
        return np.array(target, dtype=float)

    def error(self, robot, q, target):
        return self.target(target) - self.value(robot, q)

    def jacobian(self, robot, q):
        return np.array([frame_jacobian(robot, q, frame=frame)[1] for frame in ("link2", "tool")])

    def check(self, robot):
        pass

    def check_integrable(self, robot):
        pass

    def frame_map(self):
        return None


def test_the_heights_of_elbow_and_tool_of_the_planar_2r_are_solved_though_they_are_of_two_frames():
    """y1 = l1 sin q1 and y2 = y1 + l2 sin(q1 + q2), with l1 = 1.2 and l2 = 0.8: four solutions."""
    robot, target = arm("planar_2r"), [0.6, 1.0]
    found = ik_solutions(robot, TwoHeights(), target)
    assert len(found) == 4
    assert 1.2 * np.sin(found.q[:, 0]) == pytest.approx(np.full(4, 0.6), abs=1e-8)
    assert 0.8 * np.sin(found.q.sum(axis=1)) == pytest.approx(np.full(4, 0.4), abs=1e-8)
    one = solve_ik(robot, TwoHeights(), target).require()
    assert TwoHeights().value(robot, one.q) == pytest.approx(target, abs=1e-6)
    scan = scan_singularities(robot, TwoHeights(), samples=100)
    J = TwoHeights().jacobian(robot, scan.worst[0])
    assert scan.worst_values[0] == pytest.approx(np.linalg.svd(J, compute_uv=False)[-1], rel=1e-9)
    with pytest.raises(FormulaError, match="for tasks on a frame and for FunctionTask"):
        formulas(robot, TwoHeights())
