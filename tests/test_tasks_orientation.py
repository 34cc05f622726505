"""Tasks given by Euler angles, and pointing tasks: values by hand, Jacobians by differences, laws, what is refused."""

from math import nan, pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm, random_q
from differences import derivative, turned
from scipy.spatial.transform import Rotation

from robotics1 import (
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    TaskError,
    forward_kinematics,
    frame_jacobian,
    iterate_ik,
    subspaces,
)

SEQUENCES = ["ZYZ", "XYX", "XYZ", "ZYX", "YXZ", "Z-YX", "-ZX-Z", "-X-Y-Z"]


def wrist(angles, sequence="ZYZ"):
    """Moving angles of R by hand: R = Rz(a) Ry(b) Rz(c) and its like."""
    return Rotation.from_euler(sequence, angles).as_matrix()


# --- values by hand


def test_zyz_angles_are_atan2_r23_r13_and_so_on(spatial):
    q = random_q(spatial, 3)
    T = forward_kinematics(spatial, q)
    R = T.rotation
    phi = [np.arctan2(R[1, 2], R[0, 2]), np.arctan2(np.hypot(R[0, 2], R[1, 2]), R[2, 2]), np.arctan2(R[2, 1], -R[2, 0])]
    assert OrientationTask("ZYZ").value(spatial, q) == pytest.approx(phi, abs=1e-13)
    assert PoseTask("ZYZ").value(spatial, q) == pytest.approx([*T.translation, *phi], abs=1e-13)


def test_roll_pitch_yaw_is_fixed_xyz_and_the_reverse_of_moving_zyx(spatial):
    q = random_q(spatial, 4)
    R = forward_kinematics(spatial, q).rotation
    roll, yaw = np.arctan2(R[2, 1], R[2, 2]), np.arctan2(R[1, 0], R[0, 0])
    pitch = np.arctan2(-R[2, 0], np.hypot(R[2, 1], R[2, 2]))
    assert OrientationTask("XYZ", fixed=True).value(spatial, q) == pytest.approx([roll, pitch, yaw], abs=1e-13)
    assert OrientationTask("ZYX").value(spatial, q) == pytest.approx([yaw, pitch, roll], abs=1e-13)


def test_zyx_analytic_jacobian_is_the_printed_inverse_rate_map_times_the_angular_rows(spatial):
    q = random_q(spatial, 5)
    psi, theta, _ = OrientationTask("ZYX").value(spatial, q)
    s, c, t = np.sin(psi), np.cos(psi), np.tan(theta)
    inverse = [[c * t, s * t, 1], [-s, c, 0], [c / np.cos(theta), s / np.cos(theta), 0]]
    J = frame_jacobian(spatial, q)
    assert OrientationTask("ZYX").jacobian(spatial, q) == pytest.approx(np.array(inverse) @ J[3:], abs=1e-12)
    assert PoseTask("ZYX").jacobian(spatial, q)[:3] == pytest.approx(J[:3], abs=1e-15)


@pytest.mark.parametrize(("axis", "column"), [("x", 0), ("y", 1), ("z", 2)])
def test_pointing_is_a_column_of_r_and_its_jacobian_omega_cross_r(spatial, axis, column):
    q = random_q(spatial, 6)
    r = forward_kinematics(spatial, q).rotation[:, column]
    J = np.cross(frame_jacobian(spatial, q)[3:].T, r).T
    assert PointingTask(axis).value(spatial, q) == pytest.approx(r, abs=1e-15)
    assert PointingTask(axis).jacobian(spatial, q) == pytest.approx(J, abs=1e-15)
    assert PointingTask("-" + axis).value(spatial, q) == pytest.approx(-r, abs=1e-15)
    assert PointingTask("-" + axis).jacobian(spatial, q) == pytest.approx(-J, abs=1e-15)


def test_pointing_along_a_direction_of_any_length_is_r_times_its_unit_vector(spatial):
    q = random_q(spatial, 7)
    R = forward_kinematics(spatial, q).rotation
    assert PointingTask([3, 0, -4]).value(spatial, q) == pytest.approx(R @ [0.6, 0, -0.8], abs=1e-15)
    assert PointingTask([3, 0, -4]) == PointingTask((0.6, 0.0, -0.8))
    assert PointingTask([1e-200, 0, 0]).axis == (1, 0, 0)


# --- laws


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("name", ["spatial", "redundant", "six_r", "continuous"])
def test_analytic_jacobian_is_the_derivative_of_the_angles(name, sequence, fixed):
    robot, task = arm(name), PoseTask(sequence, fixed)
    q = 0.9 * random_q(robot, 11)
    J = task.jacobian(robot, q)
    assert J.shape == (6, robot.nv)
    start = task.value(robot, q)
    angles = derivative(lambda x: turned(task.value(robot, x) - start), q)
    assert angles == pytest.approx(J, abs=1e-8 * max(1, np.abs(J).max()))
    assert OrientationTask(sequence, fixed).jacobian(robot, q) == pytest.approx(J[3:], abs=1e-15)


@pytest.mark.parametrize("axis", ["x", "-y", (1.0, 2.0, -2.0)])
@pytest.mark.parametrize("name", ["spatial", "redundant", "one_joint"])
def test_pointing_jacobian_is_the_derivative_of_r_and_has_rank_two_at_most(name, axis):
    robot, task = arm(name), PointingTask(axis)
    q = 0.9 * random_q(robot, 12)
    J, r = task.jacobian(robot, q), task.value(robot, q)
    assert derivative(lambda x: task.value(robot, x), q) == pytest.approx(J, abs=2e-9)
    assert r @ J == pytest.approx(np.zeros(robot.nv), abs=1e-14)
    assert subspaces(J).rank == min(2, robot.nv)


@pytest.mark.parametrize("reference", ["tool", "link2"])
def test_angles_and_directions_in_other_axes_are_those_of_the_turned_rotation(spatial, reference):
    q = random_q(spatial, 13)
    A = forward_kinematics(spatial, q, frame=None if reference == "tool" else reference).rotation
    R = A.T @ forward_kinematics(spatial, q).rotation
    assert PointingTask("x", reference=reference).value(spatial, q) == pytest.approx(R[:, 0], abs=1e-15)
    if reference == "link2":
        phi = OrientationTask("XYZ", reference=reference).value(spatial, q)
        assert wrist(phi, "XYZ") == pytest.approx(R, abs=1e-14)


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("fixed", [False, True])
def test_both_triples_of_an_orientation_are_the_same_target(spatial, sequence, fixed):
    task, q = OrientationTask(sequence, fixed), random_q(spatial, 14)
    first, second, last = value = task.value(spatial, q)
    middle = pi - second if len(set(sequence) - {"-"}) == 3 else -second
    for whole_turns in (0, 2 * pi):
        twin = [first + pi + whole_turns, middle, last + pi]
        assert task.target(twin) == pytest.approx(value, abs=1e-14)
        assert task.error(spatial, q, twin) == pytest.approx(np.zeros(3), abs=1e-14)


def test_angle_errors_take_the_short_way_round():
    task = OrientationTask("XYZ")
    e = task.difference(task.target([3.0, 0.1, -3.0]), task.target([-3.0, 0.2, 3.0]))
    assert e == pytest.approx([6 - 2 * pi, -0.1, 2 * pi - 6], abs=1e-14)
    assert task.difference(np.array([pi, 0, 0]), np.zeros(3))[0] == pi


@pytest.mark.parametrize(
    "task",
    [PoseTask("ZYZ"), PoseTask("Z-YX"), PoseTask("XYZ", fixed=True), OrientationTask("YXY"), PointingTask("z")],
)
def test_iterations_reach_a_target_in_every_representation(task):
    robot = arm("six_r")
    q = 0.6 * random_q(robot, 15)
    target = task.value(robot, q)
    found = iterate_ik(robot, task, target, q + 0.1, method="pseudoinverse", tolerance=1e-12)
    assert found.converged
    assert found.iterations < 10
    assert task.value(robot, found.q) == pytest.approx(target, abs=1e-11)


def test_pointing_away_from_the_target_stalls(spatial):
    q = random_q(spatial, 16)
    r = PointingTask("z").value(spatial, q)
    assert PointingTask("z").error(spatial, q, -2 * r) == pytest.approx(-2 * r, abs=1e-14)
    assert iterate_ik(spatial, PointingTask("z"), -r, q, method="pseudoinverse").status.name == "STALLED"


def test_a_planar_angle_of_minus_zero_and_minus_one_is_plus_pi():
    R = np.array([[-1.0, 0.0, 0.0], [-0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
    assert PlanarPoseTask("xy").g(np.zeros(3), R)[2] == pi


# --- formulas: g and S of expressions


@pytest.mark.parametrize(
    "task",
    [PoseTask("ZYZ"), PoseTask("YZX", fixed=True), OrientationTask("-X-YX"), OrientationTask("ZXY"), PointingTask()],
)
def test_g_and_s_of_expressions_are_those_of_numbers(task):
    a, b, c = sympy.symbols("a b c", real=True)
    R = sympy.rot_ccw_axis3(a) * sympy.rot_ccw_axis1(b) * sympy.rot_ccw_axis2(c)
    p = np.array(sympy.symbols("x y z", real=True), dtype=object)
    at = {a: 0.3, b: -0.8, c: 2.1, p[0]: 1.0, p[1]: 2.0, p[2]: 3.0}
    numbers = np.array(R.subs(at), dtype=float)
    expressions = np.array(R, dtype=object)
    for function in (task.g, task.S):
        formula = np.array(sympy.Matrix(function(p, expressions)).subs(at), dtype=float)
        wanted = np.array(function(np.array([1.0, 2.0, 3.0]), numbers), dtype=float)
        assert formula.reshape(wanted.shape) == pytest.approx(wanted, abs=1e-14)


def test_pointing_s_is_linear_in_r():
    R = np.array(sympy.Matrix(3, 3, sympy.symbols("r1:10", real=True)), dtype=object)
    S = PointingTask("x").S(np.zeros(3), R)
    r1, r4, r7 = R[:, 0]
    assert S[:, 3:].tolist() == [[0, r7, -r4], [-r7, 0, r1], [r4, -r1, 0]]
    assert not S[:, :3].any()


def test_zyz_formula_is_the_textbooks():
    R = np.array(sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"r{i + 1}{j + 1}", real=True)), dtype=object)
    phi, theta, psi = OrientationTask("ZYZ").g(np.zeros(3), R)
    assert phi == sympy.atan2(R[1, 2], R[0, 2])
    assert theta == sympy.atan2(sympy.sqrt(1 - R[2, 2] ** 2), R[2, 2])
    assert psi == sympy.atan2(R[2, 1], -R[2, 0])


def test_a_frame_that_is_always_singular_has_no_formula():
    a = sympy.Symbol("a", real=True)
    R = np.array(sympy.rot_ccw_axis3(a), dtype=object)
    for function in (OrientationTask("ZYZ").g, OrientationTask("ZXZ").S):
        with pytest.raises(TaskError, match="sin φ2 = 0"):
            function(np.zeros(3), R)
    assert list(OrientationTask("ZYX").g(np.zeros(3), R)) == [a, 0, 0]


# --- what is refused


@pytest.mark.parametrize("sequence", ["ZYZ", "XZX"])
@pytest.mark.parametrize("kind", [PoseTask, OrientationTask])
def test_the_representation_singularity_is_a_task_error(prr, sequence, kind):
    task, q = kind(sequence, frame=prr.frame_names[0]), [0.1, 0.2, 0.3]
    for call in (task.value, task.jacobian):
        with pytest.raises(TaskError, match=f"{sequence} angles are singular here, sin φ2 = 0"):
            call(prr, q)


def test_the_singular_pitch_of_roll_pitch_yaw_is_a_task_error():
    R = wrist([0.4, pi / 2, 0.2], "ZYX")
    with pytest.raises(TaskError, match="fixed XYZ angles are singular here, cos φ2 = 0"):
        OrientationTask("XYZ", fixed=True).g(np.zeros(3), R)
    near = wrist([0.4, pi / 2 - 1e-8, 0.2], "ZYX")
    assert wrist(OrientationTask("ZYX").g(np.zeros(3), near), "ZYX") == pytest.approx(near, abs=1e-15)


@pytest.mark.parametrize(("sequence", "target"), [("ZYZ", [0.3, pi, 1]), ("XYZ", [0, -pi / 2, 0]), ("ZYZ", [0, 0, 0])])
def test_a_target_at_the_singularity_is_a_task_error(spatial, sequence, target):
    with pytest.raises(TaskError, match="the target's"):
        OrientationTask(sequence).error(spatial, np.zeros(5), target)


@pytest.mark.parametrize("sequence", ["", "xyZ", "XY", "XXY", "XYY", "XYZX", "X-XY", "+XYZ", "X Y Z", "RPY", 3, ["X"]])
@pytest.mark.parametrize("kind", [PoseTask, OrientationTask])
def test_a_sequence_is_three_axes_of_which_neighbours_differ(kind, sequence):
    with pytest.raises(InputError, match="sequence"):
        kind(sequence)


@pytest.mark.parametrize("fixed", [True, 1, "yes", None])
def test_fixed_axes_need_a_sequence(fixed):
    with pytest.raises(InputError, match="sequence"):
        OrientationTask(fixed=fixed)


@pytest.mark.parametrize("axis", ["w", "", "xy", "--x", None, [0, 0, 0], [1, 2], [1, nan, 0], 3])
def test_an_axis_is_a_letter_or_a_direction(axis):
    with pytest.raises(InputError, match="axis"):
        PointingTask(axis)


@pytest.mark.parametrize(
    ("task", "target"),
    [
        (PoseTask("ZYZ"), pin.SE3.Identity()),
        (PoseTask("ZYZ"), [1, 2, 3, 4, 5]),
        (PoseTask("ZYZ"), [1, 2, 3, 4, 5, nan]),
        (OrientationTask("ZYZ"), np.eye(3)),
        (OrientationTask("ZYZ"), None),
        (PointingTask(), [0, 0, 0]),
        (PointingTask(), np.eye(3)),
    ],
)
def test_a_target_of_the_wrong_form_is_an_input_error(spatial, task, target):
    with pytest.raises(InputError, match="the target"):
        task.error(spatial, np.zeros(5), target)
