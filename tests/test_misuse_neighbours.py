"""An object of this package in the place of another: a task for a robot, a path for a law, a class for its instance.

The answer is a typed error that says what would be right.
"""

import re

import numpy as np
import pinocchio as pin
import pytest
from arms import arm

import robotics1 as r1

ROBOT, WIDE, XY, Q = arm("planar_2r"), arm("six_r"), r1.PositionTask("xy"), np.array([0.3, 0.9])
JOINTS, LINE = r1.cubic([0, 1], [1, -1], 2.0), r1.line_path([0, 0, 0], [1, 2, 2])
LAW, LIMITS = r1.cubic(0, LINE.end, 1.0).joint(), r1.MotionLimits(1.0, 3.0)
ALONG = r1.curves.PathTrajectory(r1.line_path([1, 1], [0.5, 1]), r1.cubic(0, 0.5, 1.0).joint())
POSES = r1.curves.pose_line(np.eye(4), pin.SE3(np.eye(3), np.ones(3)))
MOVING = r1.LinearMotion([-2, 1], [1.4, 0.4])

OF_A_ROBOT = {
    "forward_kinematics": lambda robot: r1.forward_kinematics(robot, Q),
    "frame_jacobian": lambda robot: r1.frame_jacobian(robot, Q),
    "frame_jacobian_rate": lambda robot: r1.frame_jacobian_rate(robot, Q, Q),
    "value": lambda robot: XY.value(robot, Q),
    "jacobian": lambda robot: XY.jacobian(robot, Q),
    "error": lambda robot: r1.PlanarPoseTask().error(robot, Q, [1, 1, 0]),
    "value of a function": lambda robot: r1.FunctionTask(lambda p, R, q: p, 3).value(robot, Q),
    "jacobian of a function": lambda robot: r1.FunctionTask(lambda p, R, q: p, 3).jacobian(robot, Q),
    "formulas": lambda robot: r1.formulas(robot, XY),
    "find_singularities": lambda robot: r1.find_singularities(robot, XY),
    "singularity_within_rounding": lambda robot: r1.singularities.singularity_within_rounding(robot, XY, Q),
    "scan_singularities": lambda robot: r1.scan_singularities(robot, XY, samples=10),
    "solve_ik": lambda robot: r1.solve_ik(robot, XY, [1, 1]),
    "iterate_ik": lambda robot: r1.iterate_ik(robot, XY, [1, 1], Q),
    "ik_solutions": lambda robot: r1.ik_solutions(robot, XY, [1, 1]),
    "joint_velocity": lambda robot: r1.joint_velocity(robot, XY, [1, 0], Q),
    "joint_acceleration": lambda robot: r1.joint_acceleration(robot, XY, [1, 0], Q, Q),
    "jacobian_rate": lambda robot: r1.trajectories.jacobian_rate(robot, XY, Q, Q),
    "follow_trajectory": lambda robot: r1.follow_trajectory(robot, XY, ALONG, Q),
    "TaskTrajectory": lambda robot: r1.trajectories.TaskTrajectory(robot, XY, JOINTS),
    "limit_violations": lambda robot: r1.trajectories.limit_violations(robot, JOINTS, LIMITS),
    "rendezvous": lambda robot: r1.rendezvous(robot, XY, MOVING, [0, 0], 1.4),
    "urdf_to_dh": r1.dh.urdf_to_dh,
    "plot_trajectory": lambda robot: r1.plot_trajectory(JOINTS, robot=robot),
}
NO_ROBOTS = {
    "a task": (XY, "the robot comes first, then the task"),
    "the class": (r1.Robot, r"not the class Robot; load_robot\(\) returns one"),
    "a motion": (JOINTS, r"the robot must be a Robot, not a PiecewisePolynomial"),
    "a pose": (np.eye(4), "the robot must be a Robot, not a ndarray"),
    "a table": (r1.dh.urdf_to_dh(ROBOT), "the robot must be a Robot, not a DHTable"),
}


@pytest.mark.parametrize("name", OF_A_ROBOT)
@pytest.mark.parametrize("other", NO_ROBOTS)
def test_what_is_no_robot_is_refused(name, other):
    value, message = NO_ROBOTS[other]
    with pytest.raises(r1.InputError, match=message):
        OF_A_ROBOT[name](value)


@pytest.mark.parametrize("name", [name for name in OF_A_ROBOT if name not in ("formulas", "urdf_to_dh")])
def test_a_robot_of_another_width_is_refused_or_its_task_is_another(name):
    wide = {"find_singularities", "scan_singularities", "solve_ik", "ik_solutions"}  # they take no configuration
    if name in wide:
        assert OF_A_ROBOT[name](WIDE) is not None
    else:
        with pytest.raises(r1.Robotics1Error, match=r"6|leaves the xy plane"):
            OF_A_ROBOT[name](WIDE)


MISUSE = {  # a call, and what its error says
    "joint motion as a law": (
        lambda: r1.curves.PathTrajectory(LINE, JOINTS),
        "timing law s(t), such as cubic",
    ),
    "path as a law": (lambda: r1.curves.PathTrajectory(LINE, LINE), "timing law s(t), such as cubic"),
    "law drawn as a law": (lambda: r1.plot_timing_law(JOINTS), "timing law s(t), such as cubic"),
    "law as a path": (lambda: r1.trajectories.time_optimal(LAW, LIMITS), "must be a path of points"),
    "poses as a path of points": (lambda: r1.trajectories.timing_bounds(POSES, 1, 1), "must be a path of points"),
    "points as a path": (lambda: r1.curves.by_arc_length(np.eye(4)), "must be a path of points"),
    "path as a joint motion": (lambda: r1.trajectories.TaskTrajectory(ROBOT, XY, LINE), "joints"),
    "poses as a joint motion": (lambda: r1.simulate_tracking(POSES, Q, 2.0), "must be of joints"),
    "limits as a motion": (lambda: r1.trajectories.scale_to_limits(LIMITS, LIMITS), "must be a motion, such as cubic"),
    "motion as limits": (lambda: r1.trajectories.scale_to_limits(JOINTS, JOINTS), "limits must be MotionLimits(...)"),
    "class as limits": (
        lambda: r1.trajectories.scale_to_limits(JOINTS, r1.MotionLimits),
        "limits must be MotionLimits(...)",
    ),
    "result as limits": (
        lambda: r1.trajectories.scale_to_limits(JOINTS, r1.trajectories.scale_to_limits(JOINTS, LIMITS)),
        "limits must be MotionLimits(...)",
    ),
    "class as a motion": (lambda: r1.curves.stretched(r1.curves.Curve, 2.0), "must be a motion, such as cubic"),
    "pose as a position": (lambda: r1.solve_ik(ROBOT, r1.PositionTask(), np.eye(4)), "must have shape (3,)"),
    "position as a pose": (lambda: r1.solve_ik(WIDE, r1.PoseTask(), [1, 0, 0]), "pin.SE3 or a homogeneous matrix"),
    "pose as a point": (lambda: r1.line_path(np.eye(4), np.eye(4)), "must have shape (any,)"),
    "rotation as a pose": (lambda: r1.curves.pose_line(np.eye(3), np.eye(4)), "shape (4, 4)"),
    "pose as a rotation": (lambda: r1.curves.slerp_path(np.eye(4), np.eye(3)), "shape (3, 3)"),
    "another robot's q": (lambda: r1.frame_jacobian(ROBOT, np.zeros(6)), "one number for each of q1, q2"),
    "robot as q": (lambda: r1.frame_jacobian(ROBOT, ROBOT), "must be an array of real numbers of shape (2,)"),
    "class as a task": (lambda: r1.formulas(ROBOT, r1.PositionTask), "write PositionTask(...) with brackets"),
    "class as a task to solve": (lambda: r1.IKSolver(ROBOT, r1.PoseTask), "write PoseTask(...) with brackets"),
    "robot as a task": (
        lambda: r1.singularities.singularity_within_rounding(ROBOT, ROBOT, Q),
        "the robot comes first, then the task",
    ),
    "class as a target's motion": (
        lambda: r1.rendezvous(ROBOT, XY, r1.LinearMotion, [0, 0], 1.4),
        "use LinearMotion or FunctionMotion",
    ),
    "motion as a time": (
        lambda: r1.rendezvous(ROBOT, XY, MOVING, [0, 0], MOVING),
        "meet must be a time, or",
    ),
    "classes as functions of time": (
        lambda: r1.trajectories.FunctionMotion(r1.LinearMotion, r1.LinearMotion),
        "takes two functions of t",
    ),
    "class as a wish": (
        lambda: r1.joint_velocity(ROBOT, XY, [1, 0], Q, null_velocity=r1.LinearMotion),
        "one number for each joint",
    ),
    "robot as a singular set": (
        lambda: r1.singularities.parameter_conditions(ROBOT),
        "parameter_conditions wants the answer of find_singularities",
    ),
    "pose on a branch": (
        lambda: r1.find_singularities(ROBOT, XY).branches[0].contains(np.eye(4)),
        "one number for each of q1, q2",
    ),
}


@pytest.mark.parametrize("name", MISUSE)
def test_an_object_of_another_kind_is_refused_and_the_right_one_is_named(name):
    call, message = MISUSE[name]
    with pytest.raises(r1.Robotics1Error, match=re.escape(message)):
        call()


class Broken:
    """A motion of the user's own class, in which a method fails."""

    duration = 1.0

    def __init__(self, method):
        self.method = method

    def _answer(self, method):
        return 1 / 0 if method == self.method else np.zeros(2)

    def __call__(self, t):
        return self._answer("motion")

    def velocity(self, t, side="right"):
        return self._answer("velocity")

    def acceleration(self, t, side="right"):
        return self._answer("acceleration")

    def jerk(self, t, side="right"):
        return self._answer("jerk")


def fails(*arguments):
    raise IndexError(arguments)


OWN_FUNCTIONS = {
    "null_velocity": lambda: r1.follow_trajectory(ROBOT, XY, ALONG, [0.1, 1.2], null_velocity=fails),
    "input_matrix": lambda: r1.joint_velocity(
        ROBOT, XY, [1, 0], Q, resolution=r1.trajectories.Resolution(input_matrix=fails)
    ),
    "the event": lambda: r1.rendezvous(ROBOT, XY, MOVING, Q, meet=fails),
    "the target's position": lambda: r1.rendezvous(
        ROBOT, XY, r1.trajectories.FunctionMotion(fails, lambda t: [0, 0]), Q, meet=1.0
    ),
    "the target's rate": lambda: r1.rendezvous(
        ROBOT, XY, r1.trajectories.FunctionMotion(lambda t: [1, 1], fails), Q, meet=1.0
    ),
    "motion": lambda: r1.trajectories.minimum_duration(fails, LIMITS),
    "the motion": lambda: r1.simulate_tracking(Broken("motion"), Q, 1.0),
    "the motion's velocity": lambda: r1.simulate_tracking(Broken("velocity"), Q, 1.0),
}


@pytest.mark.parametrize("name", list(OWN_FUNCTIONS))
def test_a_function_of_the_users_own_that_fails_is_named_with_its_error(name):
    with pytest.raises(r1.InputError, match=rf"^{name} failed at .*(IndexError|ZeroDivisionError)"):
        OWN_FUNCTIONS[name]()


OPTIONS = {
    "windings": lambda value: r1.ik_solutions(ROBOT, XY, [1, 0.5], windings=value),
    "within_limits": lambda value: r1.ik.posture_change(ROBOT, XY, Q, -Q, within_limits=value),
    "absolute": lambda value: r1.textbook_robots.planar_arm("R", [1.0], absolute=value),
    "angular_first of J": lambda value: r1.frame_jacobian(ROBOT, Q, angular_first=value),
    "angular_first of Ad": lambda value: r1.rigid_motions.adjoint(pin.SE3.Identity(), angular_first=value),
    "angular_first of log": lambda value: r1.rigid_motions.pose_log(pin.SE3.Identity(), angular_first=value),
    "angular_first of exp": lambda value: r1.rigid_motions.pose_exp(np.ones(6), angular_first=value),
}


@pytest.mark.parametrize("name", list(OPTIONS))
@pytest.mark.parametrize("value", [np.zeros((0, 4)), np.ones(2), "yes", None, 1])
def test_an_option_that_is_true_or_false_is_nothing_else(name, value):
    with pytest.raises(r1.InputError, match=f"{name.split()[0]} must be True or False"):
        OPTIONS[name](value)


@pytest.mark.parametrize("option", ["box", "locked"])
def test_a_solver_of_all_solutions_takes_joints_by_their_names(option):
    for value in ([0.1], np.zeros((2, 2)), "q1", {1: 2}):
        with pytest.raises(r1.InputError, match=option):
            r1.ik.SolutionSolver(ROBOT, XY, **{option: value})
