"""The mistakes of a user's first hour with the package: a student's, an engineer's, a teacher's. Each gets one sentence
that says what would be right."""

import warnings
from math import pi

import numpy as np
import pytest
import sympy

import robotics1 as r1

Q, J = [0.1, 0.2], np.eye(2)
MOTION = r1.cubic([0], [1], 2)
TARGET = r1.LinearMotion([-2, 1], [1.449, 0.388])


def two():
    return r1.load_robot("planar_2r")


def fk(*arguments, **options):
    return r1.forward_kinematics("planar_2r", *arguments, **options)


def dh(*rows, **options):
    return r1.robot_from_dh(list(rows), **options)


def spatial_pose(target):
    return r1.solve_ik("cylindrical", "pose", target)


INPUT, UNKNOWN, FILE, TASK = r1.InputError, r1.UnknownNameError, r1.RobotFileError, r1.TaskError
MISTAKES = {
    # loading
    "a name in capitals": (lambda: r1.load_robot("PRR"), UNKNOWN, r"did you mean 'prr'\?$"),
    "a name with a slip": (lambda: r1.load_robot("prrr"), UNKNOWN, "did you mean 'prr'"),
    "a file that is not there": (lambda: r1.load_robot("arm.urdf"), FILE, "there is no such file"),
    "a file at home": (lambda: r1.load_robot("~/arm.urdf"), FILE, r"write Path\('~/...'\).expanduser\(\)"),
    "loaded twice": (lambda: r1.load_robot(two()), INPUT, "it is a Robot already"),
    "nothing": (lambda: r1.load_robot(None), INPUT, "a name or a path"),
    "a length in capitals": (lambda: r1.load_robot("prr", parameters={"L2": 1}), UNKNOWN, "did you mean 'l2'"),
    "a length with its unit": (lambda: r1.load_robot("prr", parameters={"l2": "1 m"}), INPUT, "a finite number"),
    "lengths in a list": (lambda: r1.load_robot("prr", parameters=[0.5, 0.3]), INPUT, r"such as \{'l2': 0.5\}"),
    "a tool with a slip": (lambda: r1.load_robot("planar_2r", tool="tol"), UNKNOWN, "did you mean 'tool'"),
    "half a text": (lambda: r1.load_robot("<robot><link></robot>"), FILE, "not well-formed XML"),
    "a length of another robot": (lambda: two().with_parameters({"l3": 1}), UNKNOWN, "there is 'l1', 'l2'"),
    "no name at all": (lambda: r1.load_robot("nothing"), UNKNOWN, "there is 'cylindrical', 'planar_2r', 'prr'"),
    # configurations
    "q before the robot": (lambda: r1.forward_kinematics(Q, "planar_2r"), INPUT, "must be a Robot, not a list"),
    "one joint of two": (lambda: fk(0.1), INPUT, r"shape \(2,\), one number for each of q1, q2"),
    "three joints of two": (lambda: fk([0.1, 0.2, 0.3]), INPUT, r"shape \(2,\), one number for each of q1, q2"),
    "degrees": (lambda: fk([0, 90]), r1.RobotWarning, r"write radians\(90\)"),
    "degrees of any kind": (
        lambda: r1.forward_kinematics("ur5", [0, -57.3, 0, 0, 0, 0]),
        r1.RobotWarning,
        r"write radians\(-57.3\)",
    ),
    "degrees with a half": (lambda: fk([-22.5, 0]), r1.RobotWarning, r"write radians\(-22.5\)"),
    "degrees of a computation": (lambda: fk(np.degrees([0.1, 0.9])), r1.RobotWarning, r"write radians\(51.5662\)"),
    "degrees of a start": (
        lambda: r1.solve_ik("planar_2r", "position:xy", [1, 1], [30, 45]),
        r1.RobotWarning,
        "q0 has the angle 30",
    ),
    "numbers in a text": (lambda: fk("0.1, 0.2"), UNKNOWN, "numbers stand in a list"),
    "texts for numbers": (lambda: fk(["0.1", "0.2"]), INPUT, "an array of real numbers"),
    "a column": (lambda: fk([[0.1], [0.2]]), INPUT, "one row for each configuration of q1, q2"),
    "symbols": (lambda: fk(sympy.symbols("q1 q2")), INPUT, "an array of real numbers"),
    "a joint left out": (lambda: fk({"q1": 0.1}), INPUT, "q has no value for q2"),
    "a joint with a slip": (lambda: fk({"q1": 0.1, "q_2": 0.2}), UNKNOWN, "did you mean 'q2'"),
    "no number": (lambda: fk([0.1, float("nan")]), INPUT, "must be finite"),
    "a frame of another robot": (lambda: fk(Q, frame="ee"), UNKNOWN, "there is 'base', 'link1', 'link2', 'tool'"),
    "a locked joint in degrees": (
        lambda: r1.load_robot("ur5", locked={"elbow_joint": 90}),
        r1.RobotWarning,
        r"the value of locked joint 'elbow_joint' has the angle 90.*write radians\(90\)",
    ),
    "a box in degrees": (
        lambda: r1.workspaces.workspace("planar_2r", "position:xy", box={"q1": (-90, 90)}),
        INPUT,
        r"it is \[-90, 90\]; angles are in radians",
    ),
    # tasks
    "a class for a task": (
        lambda: r1.find_singularities("planar_2r", r1.PositionTask),
        INPUT,
        r"write PositionTask\(...\) with brackets",
    ),
    "a class for a robot": (lambda: r1.find_singularities(r1.Robot, "pose"), INPUT, "not the class Robot"),
    "the task first": (lambda: r1.find_singularities(r1.PositionTask("xy"), two()), INPUT, "the robot comes first"),
    "the short form first for formulas": (lambda: r1.formulas("pose", "planar_2r"), INPUT, "the robot comes first"),
    "the short form first": (lambda: r1.find_singularities("position:xy", "planar_2r"), INPUT, "the robot comes first"),
    "a short form with a slip": (
        lambda: r1.find_singularities("planar_2r", "positon:xy"),
        INPUT,
        r"there is position\[:xyz\]",
    ),
    "coordinates for a task": (
        lambda: r1.ik_solutions("planar_2r", ["x", "y"], [1, 1]),
        INPUT,
        "a short form such as 'position:xy'",
    ),
    "the target before the task": (
        lambda: r1.ik_solutions("planar_2r", [1, 2], "position:xy"),
        INPUT,
        "a short form such as 'position:xy'",
    ),
    "coordinates in capitals": (lambda: r1.PositionTask("XY"), INPUT, "distinct letters of 'xyz'"),
    "the robot in the task": (lambda: r1.PoseTask(two()), INPUT, "sequence must be a text, not Robot"),
    "a plane for a spatial arm": (lambda: r1.find_singularities("cylindrical", "planar"), TASK, "leaves the xy plane"),
    # targets
    "three coordinates of two": (
        lambda: r1.ik_solutions("planar_2r", "position:xy", [1, 2, 3]),
        INPUT,
        "the coordinates x, y",
    ),
    "a direction in degrees": (
        lambda: r1.PlanarPoseTask().target([0.3, 0.2, 90]),
        r1.RobotWarning,
        r"write radians\(90\)",
    ),
    "six numbers for a pose": (lambda: spatial_pose([1, 0, 0, 0, 0, 0]), INPUT, r"\(xyz, rpy\) or \(xyz, quaternion\)"),
    "a rotation for a pose": (lambda: spatial_pose(np.eye(3)), INPUT, "a homogeneous matrix"),
    "a quaternion of length 2": (
        lambda: spatial_pose(([1, 0, 0], [0, 0, 0, 2])),
        INPUT,
        "of length 1; its length is 2",
    ),
    "roll, pitch and yaw in degrees": (
        lambda: spatial_pose(([1, 0, 0], [180, 0, 90])),
        r1.RobotWarning,
        r"write radians\(180\)",
    ),
    "a matrix that is no rotation": (
        lambda: r1.OrientationTask().target(np.ones((3, 3))),
        INPUT,
        "columns must be orthonormal",
    ),
    "out of reach": (
        lambda: r1.ik_solutions("planar_2r", "position:xy", [5, 5]).require(),
        r1.NotConverged,
        "no q inside the limits reaches the target",
    ),
    # methods
    "a method in capitals": (
        lambda: r1.iterate_ik("planar_2r", "position:xy", [1, 1], Q, method="Newton"),
        INPUT,
        "one of 'newton'",
    ),
    "Newton with too many joints": (
        lambda: r1.iterate_ik("prr", "position:xy", [1, 1], [0, 0, 0], method="newton"),
        TASK,
        "use method='pseudoinverse'",
    ),
    "a robot for a Jacobian": (lambda: r1.subspaces(two()), INPUT, "a matrix, not Robot"),
    "a row for a Jacobian": (lambda: r1.subspaces([1, 2, 3]), INPUT, "a matrix; it has shape"),
    "a force too long": (lambda: r1.balancing_torque(J, [1, 2, 3]), INPUT, "one number for each row of J"),
    "a row that is not asked for": (
        lambda: r1.formulas("planar_2r", "position:xy", rows=["z"]),
        UNKNOWN,
        "there is 'x', 'y'",
    ),
    # DH tables
    "a twist in degrees": (lambda: dh(("R", 0, 90, 0.4, 0)), INPUT, r"write radians\(90\)"),
    "an offset in degrees": (lambda: dh(("R", 0, 0, 0.4, -90)), INPUT, r"write radians\(-90\)"),
    "limits of a table in degrees": (
        lambda: dh(("R", 1, 0, 0, 0), lower=[-180], upper=[180]),
        r1.RobotWarning,
        r"write radians\(-180\)",
    ),
    "a named twist in degrees": (
        lambda: dh(("R", 1, "al", 0, 0), parameters={"al": 90}),
        r1.RobotWarning,
        r"write radians\(90\)",
    ),
    "limits of a planar arm in degrees": (
        lambda: r1.textbook_robots.planar_arm("RR", [1, 1], upper=[90, None]),
        r1.RobotWarning,
        r"write radians\(90\)",
    ),
    # rotations
    "Euler angles in degrees": (
        lambda: r1.orientation.euler_to_rotation("ZYX", (90, 0, 45)),
        r1.RobotWarning,
        r"write radians\(90\)",
    ),
    "an angle about an axis in degrees": (
        lambda: r1.orientation.axis_angle_to_rotation((0, 0, 1), 45),
        r1.RobotWarning,
        r"write radians\(45\)",
    ),
    "Euler angles of a rate in degrees": (
        lambda: r1.orientation.euler_rate_map("ZYX", (0, 30, 0)),
        r1.RobotWarning,
        r"write radians\(30\)",
    ),
    "Euler angles of a target in degrees": (
        lambda: r1.OrientationTask(angles="ZYX").target([90, 0, 0]),
        r1.RobotWarning,
        r"write radians\(90\)",
    ),
    "a polar angle in degrees": (
        lambda: r1.tasks.PolarTask().target([1, 60]),
        r1.RobotWarning,
        r"write radians\(60\)",
    ),
    "a row without its type": (lambda: dh((0, pi / 2, 0.4, 0)), INPUT, r"must be \(type, a, alpha, d, theta\)"),
    "a row with keys": (
        lambda: dh({"type": "R", "a": 1, "alpha": 0, "d": 0, "theta": 0}),
        INPUT,
        r"must be \(type, a, alpha, d, theta\), such as \('R', 0.3, 0, 0, 0\)",
    ),
    "rows of an array": (lambda: r1.robot_from_dh(np.zeros((2, 4))), INPUT, r"it is \(0.0, 0.0, 0.0, 0.0\)"),
    "a type in words": (lambda: dh(("revolute", 0, 0, 1, 0)), INPUT, r"'R' \(revolute\) or 'P' \(prismatic\)"),
    "a name without its value": (lambda: dh(("R", "a1", 0, 0, 0)), INPUT, r"parameters=\{'a1': 0.5\}"),
    "one row without its list": (lambda: r1.robot_from_dh(("R", 1, 0, 0, 0)), INPUT, "rows must be a list"),
    "an angle in a text": (lambda: dh(("R", 0.5, "pi/2", 0, 0)), INPUT, "numbers are not written as text"),
    "a convention's author": (lambda: dh(("R", 1, 0, 0, 0), convention="craig"), INPUT, "'standard', 'modified'"),
    # motions and pages
    "a duration that is negative": (lambda: r1.cubic(0, 1, -2), INPUT, "duration must be a positive number"),
    "ends of two robots": (lambda: r1.cubic([0, 0], [1], 2), INPUT, "one number for each joint"),
    "limits as a number": (lambda: r1.minimum_time([0, 0], [1, 1], 2), INPUT, r"MotionLimits\(velocity"),
    "points before times": (lambda: r1.cubic_spline([[0, 1], [1, 2]], [0, 1]), INPUT, "one for each point, in seconds"),
    "times that stand still": (lambda: r1.cubic_spline([0, 1, 1], [0, 1, 2]), INPUT, "times must ascend"),
    "a motion of another robot": (lambda: r1.animate("planar_2r", MOTION), INPUT, "the robot has 2"),
    "points for a motion": (lambda: r1.animate("planar_2r", [Q, Q]), INPUT, r"such as cubic\(q0, q1, T\)"),
    "a picture for a page": (lambda: r1.view("planar_2r", Q, "arm.png"), INPUT, "a page is written as .html"),
    "a file for a configuration": (lambda: r1.view("planar_2r", "arm.html"), UNKNOWN, "no posture named 'arm.html'"),
    "a point for a moving target": (
        lambda: r1.rendezvous("planar_2r", "position:xy", [1, 1], q0=Q, meet=1.0),
        INPUT,
        "use LinearMotion",
    ),
    # names of other packages
    "fk": (lambda: r1.fk, AttributeError, "did you mean forward_kinematics"),
    "the Jacobian": (lambda: r1.jacobian, AttributeError, "did you mean frame_jacobian"),
    "half a name": (lambda: r1.load, AttributeError, "did you mean load_robot"),
    "a robot of its class": (lambda: r1.Robot("ur5"), INPUT, r"load_robot\('ur5'\) returns one"),
    "formulas of their class": (lambda: r1.Formulas("prr", "pose"), INPUT, r"formulas\('prr', 'planar-pose'\) returns"),
    "fk as a method": (lambda: two().fk(Q), AttributeError, r"write robotics1.forward_kinematics\(robot, q\)$"),
    "the Jacobian as a method": (
        lambda: two().jacobian(Q),
        AttributeError,
        r"write robotics1.frame_jacobian\(robot, q",
    ),
    "a function as a method": (lambda: two().ik_solutions, AttributeError, r"ik_solutions\(robot, task, target\)$"),
    "degrees of freedom": (lambda: two().dof, AttributeError, r"did you mean nv\?"),
    "limits as others have them": (lambda: two().qlim, AttributeError, r"did you mean lower or upper\?"),
    "solve of a solver": (
        lambda: r1.IKSolver("planar_2r", "position:xy").solve([1, 1]),
        AttributeError,
        "call the object itself",
    ),
    "success of an answer": (
        lambda: r1.solve_ik("planar_2r", "position:xy", [1, 1]).success,
        AttributeError,
        r"did you mean status\?",
    ),
    "solutions of the solutions": (
        lambda: r1.ik_solutions("planar_2r", "position:xy", [1, 1]).solutions,
        AttributeError,
        r"did you mean q\?",
    ),
    "a plot of a motion": (lambda: MOTION.plot, AttributeError, r"plot_trajectory\(trajectory\)"),
    "a position at an instant": (lambda: MOTION.position(1), AttributeError, "call the object itself"),
    "det J of formulas": (
        lambda: r1.formulas("planar_2r", "position:xy").det,
        AttributeError,
        r"did you mean determinant\?",
    ),
    "a task that is asked": (lambda: r1.PositionTask("xy").J, AttributeError, r"did you mean jacobian\?"),
    # classes, namespaces and collections
    "a class method of another package": (
        lambda: r1.Robot.from_urdf("arm.urdf"),
        AttributeError,
        r"Robot has no 'from_urdf'; write robotics1.load_robot\(source\)$",
    ),
    "a class of another package": (lambda: r1.DHRobot, AttributeError, r"did you mean robot_from_dh\?"),
    "a word with a slip": (lambda: r1.jacobain, AttributeError, "did you mean frame_jacobian"),
    "a namespace called": (
        lambda: r1.ik("planar_2r", [1, 1]),
        INPUT,
        "is a namespace; call a function, such as solv",
    ),
    "a slip in a namespace": (lambda: r1.trajectories.trapezodal, AttributeError, r"did you mean trapezoidal\?"),
    "a joint of the solutions": (
        lambda: r1.ik_solutions("planar_2r", "position:xy", [1, 1])["q1"],
        INPUT,
        "no entry 'q1': they have numbers, and the last of IKSolutions is 1",
    ),
    "one branch too many": (
        lambda: r1.find_singularities("planar_2r", "position:xy")[9],
        IndexError,
        "no entry 9: the last of SingularSet is 1",
    ),
    "q of a singular set": (
        lambda: r1.find_singularities("planar_2r", "position:xy").q,
        AttributeError,
        r"did you mean branches\?",
    ),
    "a column of a table": (lambda: r1.dh.urdf_to_dh("planar_2r")["alpha"], INPUT, "they have numbers"),
    "a motion in degrees": (
        lambda: r1.animate("planar_2r", r1.cubic([0, 0], [90, 45], 2)),
        r1.RobotWarning,
        r"the motion has the angle 90.*write radians\(90\)",
    ),
    "formulas at degrees": (
        lambda: r1.formulas("planar_2r", "position:xy").at(q2=90),
        r1.RobotWarning,
        r"q2 has the angle 90.*write radians\(90\)",
    ),
    # rendez-vous and control
    "a condition for an event": (
        lambda: r1.rendezvous("planar_2r", "position:xy", TARGET, q0=[0, 0], meet=lambda t, p: p[0] > 0),
        INPUT,
        r"a number that is zero at the meeting, as in meet=lambda t, p: p\[0\]",
    ),
    "an event of p alone": (
        lambda: r1.rendezvous("planar_2r", "position:xy", TARGET, q0=[0, 0], meet=lambda p: p[0]),
        INPUT,
        "the event failed at",
    ),
    "a target in space": (
        lambda: r1.rendezvous("planar_2r", "position:xy", r1.LinearMotion([1, 0, 0], [0, 1, 0]), q0=[0, 0], meet=1.0),
        INPUT,
        "the coordinates x, y",
    ),
    "a negative gain": (lambda: r1.control.joint_law("planar_2r", [0, 0], -2.0), INPUT, "K must be positive definite"),
    "a decay in percent": (lambda: r1.control.gains_for_decay(5, 2.0), INPUT, "ratio must be below 1"),
    "a method of a law": (
        lambda: r1.control.joint_law("planar_2r", [0, 0], 2.0).simulate,
        AttributeError,
        "ControlLaw has no 'simulate'",
    ),
    # files that are written
    "a spreadsheet of a motion": (lambda: MOTION.sample(10).csv("a.xlsx"), INPUT, "written as .csv, .txt; the file is"),
    "a motion as a file": (lambda: MOTION.to_csv("a.csv"), AttributeError, r"did you mean sample\?"),
    "a table as a text file": (lambda: r1.dh.dh_to_urdf([("R", 1, 0, 0, 0)], "a.txt"), INPUT, "written as .urdf, .xml"),
    "a file in the place of axes": (lambda: r1.plots.plot_trajectory(MOTION, "a.svg"), INPUT, "a file is file='a.svg'"),
    "a data sheet as PDF": (lambda: r1.report("planar_2r", "a.pdf"), INPUT, "a page is written as .html"),
    "a page that is opened": (lambda: r1.view("planar_2r").open(), AttributeError, r"did you mean save\?"),
    "a motion to look at": (lambda: r1.view("planar_2r", MOTION), INPUT, r"shown by animate\(robot, motion\)"),
    "solutions in the place of q": (
        lambda: r1.view("planar_2r", r1.ik_solutions("planar_2r", "position:xy", [1, 1])),
        INPUT,
        r"view\(robot, solutions=...\)",
    ),
    # workspaces, maps and scans
    "a volume of a pose": (lambda: r1.workspaces.workspace("ur5", "pose"), TASK, "coordinates of a point"),
    "half a grid": (
        lambda: r1.workspaces.reachability_map("planar_2r", "position:xy", {"x": [0, 1]}),
        INPUT,
        "a grid names the coordinates x, y; positions names x",
    ),
    "samples in a text": (
        lambda: r1.scan_singularities("planar_2r", "position:xy", samples="1e6"),
        INPUT,
        "samples must be an integer",
    ),
    "a posture that the file has not": (
        lambda: r1.singularities.sigma_min("planar_2r", "position:xy", "middle"),
        UNKNOWN,
        "no posture named 'middle'",
    ),
    # files that are read
    "a folder for a file": (lambda: r1.load_robot("/tmp"), FILE, "it is a folder, and no file"),
    "packages that are not there": (
        lambda: r1.load_robot("planar_2r", packages=["nowhere"]),
        INPUT,
        "there is no folder",
    ),
    "a joint in a table": (lambda: dh(("R", 0, 0, 0.4, "q1")), INPUT, "the joint is added to it; write its constant"),
    "a slip in a name": (lambda: r1.forward_kinematic, AttributeError, "did you mean forward_kinematics"),
}


@pytest.mark.parametrize("mistake", MISTAKES.values(), ids=MISTAKES)
def test_a_mistake_gets_one_sentence_that_mends_it(mistake):
    call, kind, sentence = mistake
    with warnings.catch_warnings():
        warnings.simplefilter("error", r1.RobotWarning)
        with pytest.raises(kind, match=sentence) as raised:
            call()
    text = str(raised.value)
    assert "\n" not in text
    assert len(text) < 320


def test_there_are_more_than_forty():
    assert len(MISTAKES) > 40


LONG = {
    "a matrix in the place of a sequence": lambda: r1.orientation.rotation_to_euler(np.eye(3), "ZYX"),
    "a matrix in the place of transforms": lambda: r1.textbook_robots.robot_from_transforms([np.eye(4)]),
    "ten thousand texts": lambda: fk(["0.1"] * 10_000),
    "ten thousand numbers that are none": lambda: fk([float("nan")] * 10_000),
    "columns for rows": lambda: r1.forward_kinematics("ur5", np.full((6, 1000), np.nan)),
    "a long word": lambda: r1.cubic(0, 1, "2" * 10_000 + " s"),
    "a joint with a long name": lambda: fk({"q1" * 5000: 1}),
    "a length with a long name": lambda: dh(("R", "a" * 9000, 0, 0, 0)),
    "a long sequence": lambda: r1.orientation.euler_to_rotation("Z" * 9000, (0, 0, 0)),
    "a frame with a long name": lambda: fk(Q, frame="f" * 9000),
    "a table of a thousand rows": lambda: dh(*[["R"] * 3] * 1000),
}


@pytest.mark.parametrize("mistake", LONG.values(), ids=LONG)
def test_a_message_about_a_long_value_has_one_line(mistake):
    with pytest.raises((INPUT, UNKNOWN)) as raised:
        mistake()
    assert "\n" not in str(raised.value)
    assert len(str(raised.value)) < 700
