"""A robot without joints: every public function that takes a robot has its answer, or an error that nothing moves."""

import inspect
from math import sqrt

import numpy as np
import pytest
import sympy
from command import run
from public_names import PUBLIC

import robotics1 as r1

TEXT = """<robot name="still"><link name="base"/><link name="tool"/><joint name="end" type="fixed">
<parent link="base"/><child link="tool"/><origin xyz="0.1 0.2 0.3" rpy="0 0 0.5"/></joint></robot>"""
P = np.array([0.1, 0.2, 0.3])
TASKS = {
    "position": r1.PositionTask(),
    "planar pose": r1.PlanarPoseTask(),
    "orientation": r1.OrientationTask(),
    "pose": r1.PoseTask(),
    "angles": r1.PoseTask(angles="XYZ"),
    "pointing": r1.PointingTask("x"),
    "polar": r1.tasks.PolarTask(),
    "cylindrical": r1.tasks.CylindricalTask("yz"),
    "point": r1.PlanarPoseTask(point=(0.1, 0.2, 0.3)),
    "tool axes": r1.PositionTask("xy", reference="tool"),
    "stacked": r1.StackedTask([r1.PositionTask("xz"), r1.PlanarPoseTask()]),
    "function": r1.FunctionTask(lambda p, R, q: [p @ p], 1),
    "function with a Jacobian": r1.FunctionTask(lambda p, R, q: [p @ p], 1, lambda p, R, q: np.zeros((1, 0))),
}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("still") / "still.urdf"
    path.write_text(TEXT)
    return path


@pytest.fixture(scope="module")
def still(file):
    return r1.load_robot(file)


def test_the_robot_itself_has_empty_joints_and_a_frame(still):
    assert (still.nq, still.nv, still.joint_names) == (0, 0, ())
    assert still.within_limits([])
    assert still.lower.shape == still.max_velocity.shape == still.revolute.shape == (0,)
    assert still.reach == pytest.approx(sqrt(0.14))
    assert r1.forward_kinematics(still, []).translation == pytest.approx(P)
    with pytest.raises(r1.InputError, match=r"q must have shape \(0,\)"):
        r1.forward_kinematics(still, [0.0])


@pytest.mark.parametrize("reference", ["world", "tool", "base"])
def test_jacobian_and_its_rate_are_6_by_0(still, reference):
    assert r1.frame_jacobian(still, [], reference=reference).shape == (6, 0)
    assert r1.frame_jacobian_rate(still, [], [], reference=reference).shape == (6, 0)


@pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
def test_a_task_has_no_columns_no_range_and_no_torque(still, task):
    m, J = task.rows, task.jacobian(still, [])
    assert J.shape == r1.trajectories.jacobian_rate(still, task, [], []).shape == (m, 0)
    assert task.error(still, [], task.value(still, [])) == pytest.approx(np.zeros(m))
    s = r1.subspaces(J)
    assert s.rank == 0
    shapes = [basis.shape for basis in (s.range, s.left_null, s.row, s.null)]
    assert shapes == [(m, 0), (m, m), (0, 0), (0, 0)]
    assert s.contains(np.zeros(m))
    assert not s.contains(np.ones(m))
    assert s.unrealisable(np.ones(m)) == pytest.approx(np.ones(m))
    assert (s.nearly_singular, s.at_singularity) == (False, s)
    assert r1.balancing_torque(J, np.ones(m)).shape == r1.singularities.exerting_torque(J, np.ones(m)).shape == (0,)
    assert r1.singularities.singularity_within_rounding(still, task, []).singular_q is None


@pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
@pytest.mark.parametrize(
    "resolution", [None, r1.trajectories.Resolution(damping=0.1, region=0.2), r1.trajectories.Resolution(weights=[])]
)
def test_no_velocity_but_zero_is_realised(still, task, resolution):
    m = task.rows
    moved = r1.joint_velocity(still, task, np.ones(m), [], resolution=resolution)
    assert moved.qdot.shape == (0,)
    assert moved.status is r1.trajectories.RateStatus.OUT_OF_RANGE
    assert moved.residual == pytest.approx(np.ones(m))
    assert "rank 0 of 0" in moved.explain()
    assert (
        r1.joint_velocity(still, task, np.zeros(m), [], resolution=resolution).status
        is r1.trajectories.RateStatus.REALISED
    )
    second = r1.joint_acceleration(still, task, np.ones(m), [], [], resolution=resolution)
    assert second.qddot.shape == (0,)
    assert second.drift == pytest.approx(np.zeros(m))
    assert second.status is r1.trajectories.RateStatus.OUT_OF_RANGE


@pytest.mark.parametrize("task", [task for name, task in TASKS.items() if name != "tool axes"])
@pytest.mark.parametrize("method", ["pseudoinverse", "gradient", "damped"])
def test_an_iteration_has_converged_or_stands_still(still, task, method):
    value = task.value(still, [])
    assert r1.iterate_ik(still, task, value, [], method=method).status is r1.ik.IKStatus.CONVERGED
    if task.row_names[0] == "x":
        away = value * value if hasattr(value, "rotation") else value + 0.1
        assert r1.iterate_ik(still, task, away, [], method=method).status is r1.ik.IKStatus.STALLED


@pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)
def test_formulas_are_constants_and_empty_matrices(still, task):
    found, m = r1.formulas(still, task), task.rows
    value = task.value(still, [])
    value = value.homogeneous if hasattr(value, "rotation") else np.asarray(value)
    assert np.array(found.value.evalf(), dtype=float).reshape(value.shape) == pytest.approx(value, abs=1e-12)
    assert found.jacobian.shape == found.jacobian_rate.shape == (m, 0)
    assert found.velocity_product == sympy.zeros(m, 1)
    assert found.minors == {tuple(range(m)): 1}
    assert found.gram_determinant == 1
    for name, shape in (("jacobian", (m, 0)), ("velocity_product", (m,))):
        namespace = {}
        exec(found.python(name), namespace)
        arguments = ([], []) if name == "velocity_product" else ([],)
        assert namespace[name](*arguments).shape == shape


def nothing_moves(still, task, folder):
    """Each call that takes a robot: what it answers, or the error that nothing moves."""
    value = task.value(still, [])
    line = r1.line_path(P, P + 0.1)
    motion = r1.curves.PathTrajectory(line, r1.cubic(0, line.end, 1.0).joint())
    joints = r1.cubic([], [], 1.0)
    return {
        "forward_kinematics": lambda: r1.forward_kinematics(still, []),
        "frame_jacobian": lambda: r1.frame_jacobian(still, []),
        "frame_jacobian_rate": lambda: r1.frame_jacobian_rate(still, [], []),
        "jacobian_rate": lambda: r1.trajectories.jacobian_rate(still, task, [], []),
        "joint_velocity": lambda: r1.joint_velocity(still, task, np.zeros(3), []),
        "joint_acceleration": lambda: r1.joint_acceleration(still, task, np.zeros(3), [], []),
        "singularity_within_rounding": lambda: r1.singularities.singularity_within_rounding(still, task, []),
        "wrist_jacobian": lambda: r1.singularities.wrist_jacobian(still),
        "velocity_polytope": lambda: r1.singularities.velocity_polytope(still, task, []),
        "force_polytope": lambda: r1.singularities.force_polytope(still, task, []),
        "place_robot": lambda: r1.textbook_robots.place_robot(still, base_placement=np.eye(4)),
        "static_torques": lambda: r1.singularities.static_torques(still, [], r1.singularities.Load([1, 0, 0])),
        "wrenches_without_torque": lambda: r1.singularities.wrenches_without_torque(still, []),
        "largest_force": lambda: r1.singularities.largest_force(still, task, [], [1, 0, 0]),
        "speed_along_path": lambda: r1.trajectories.speed_along_path(still, task, line, [], velocity=1.0),
        "screws": lambda: r1.rigid_motions.screws(still),
        "manipulability": lambda: r1.singularities.manipulability(still, task, []),
        "sigma_min": lambda: r1.singularities.sigma_min(still, task, []),
        "formulas": lambda: r1.formulas(still, task),
        "find_singularities": lambda: r1.find_singularities(still, task),
        "scan_singularities": lambda: r1.scan_singularities(still, task, samples=10),
        "iterate_ik": lambda: r1.iterate_ik(still, task, value, [], method="damped"),
        "solve_ik": lambda: r1.solve_ik(still, task, value),
        "IKSolver": lambda: r1.IKSolver(still, task)(value),
        "SolutionSolver": lambda: r1.ik.SolutionSolver(still, task)(value),
        "ik_formulas": lambda: r1.ik.ik_formulas(still, task),
        "is_cuspidal": lambda: r1.ik.is_cuspidal(still, task),
        "posture_change": lambda: r1.ik.posture_change(still, task, [], []),
        "self_motion": lambda: r1.ik.self_motion(still, task, value),
        "arm_angle": lambda: r1.ik.arm_angle(still, task, []),
        "solutions_at_arm_angle": lambda: r1.ik.solutions_at_arm_angle(still, task, value, 0.3),
        "ik_solutions": lambda: r1.ik_solutions(still, task, value),
        "rendezvous": lambda: r1.rendezvous(still, task, r1.LinearMotion(P, [0, 0, 0]), [], meet=1.0),
        "follow_trajectory": lambda: r1.follow_trajectory(still, task, motion, []),
        "follow_trajectory_by_acceleration": lambda: r1.trajectories.follow_trajectory_by_acceleration(
            still, task, motion, ([], [])
        ),
        "TaskTrajectory": lambda: r1.trajectories.TaskTrajectory(still, task, joints).velocity(0.5),
        "limit_violations": lambda: r1.trajectories.limit_violations(still, joints),
        "projected_gradient": lambda: r1.redundancy.projected_gradient(
            still, task, np.zeros(3), [], r1.redundancy.ManipulabilityObjective(still, task)
        ),
        "priority_velocity": lambda: r1.redundancy.priority_velocity(still, [(task, np.zeros(3))], []),
        "priority_acceleration": lambda: r1.redundancy.priority_acceleration(still, [(task, np.zeros(3))], [], []),
        "saturated_velocity": lambda: r1.redundancy.saturated_velocity(still, task, np.zeros(3), []),
        "saturated_acceleration": lambda: r1.redundancy.saturated_acceleration(
            still, task, np.ones(3), [], [], limits=1.0
        ),
        "saturated_priority_velocity": lambda: r1.redundancy.saturated_priority_velocity(
            still, [(task, np.ones(3))], []
        ),
        "ik_by_priority": lambda: r1.redundancy.ik_by_priority(still, [(task, np.zeros(3))], []),
        "saturated_priority_acceleration": lambda: r1.redundancy.saturated_priority_acceleration(
            still, [(task, np.ones(3))], [], [], limits=1.0
        ),
        "follow_by_priority": lambda: r1.redundancy.follow_by_priority(still, [(task, motion)], []),
        "reduced_gradient": lambda: r1.redundancy.reduced_gradient(
            still, task, np.zeros(3), [], r1.redundancy.ManipulabilityObjective(still, task)
        ),
        "extended_task": lambda: r1.redundancy.extended_task(
            still, task, r1.redundancy.ManipulabilityObjective(still, task)
        ),
        "redundancy_formulas": lambda: r1.redundancy.redundancy_formulas(still, task),
        "ManipulabilityObjective": lambda: r1.redundancy.ManipulabilityObjective(still, task).gradient([]),
        "JointRangeObjective": lambda: r1.redundancy.JointRangeObjective(still).gradient([]),
        "ObstacleObjective": lambda: r1.redundancy.ObstacleObjective(still, P + 0.1).gradient([]),
        "FunctionObjective": lambda: r1.redundancy.FunctionObjective(still, lambda q: 1.0).gradient([]),
        "joint_law": lambda: r1.control.joint_law(still, [], 1.0),
        "cartesian_law": lambda: r1.control.cartesian_law(still, task, P, 1.0),
        "largest_gains": lambda: r1.control.largest_gains(still, task, P, [], limits=1.0),
        "lyapunov_rate": lambda: r1.control.lyapunov_rate(still, task, P, []),
        "urdf_to_dh": lambda: r1.dh.urdf_to_dh(still),
        "workspace": lambda: r1.workspaces.workspace(still, task),
        "reachability_map": lambda: r1.reachability_map(still, task, [value]),
        "best_placements": lambda: r1.workspaces.best_placements(still, task, [value], {"x": 0.0}),
        "workspace_formulas": lambda: r1.workspaces.workspace_formulas(still, task),
        "dexterous_workspace": lambda: r1.workspaces.dexterous_workspace(still, task),
        "extreme_reach": lambda: r1.workspaces.extreme_reach(still, task),
        "joint_ranges": lambda: r1.workspaces.joint_ranges(still, task, [value]),
        "view": lambda: r1.view(still, [], folder / "still.html"),
        "report": lambda: r1.report(still, folder / "sheet.html"),
        "animate": lambda: r1.animate(still, joints, folder / "moving.html"),
        "plot_trajectory": lambda: r1.plot_trajectory(joints, file=folder / "a.svg", robot=still),
        "plot_run": lambda: r1.plots.plot_run(
            r1.control.simulate_law(r1.control.joint_law(still, [], 1.0), [], duration=1.0)
        ),
        "plot_ellipses": lambda: r1.plots.plot_ellipses(still, task, [], file=folder / "e.svg"),
        "plot_path": lambda: r1.plot_path(
            r1.trajectories.TaskTrajectory(still, r1.PositionTask("xy"), joints), file=folder / "c.svg"
        ),
    }


RESULTS = {
    "RobotReport",
    "ControlLaw",
    "Formulas",
    "IKFormulas",
    "SingularBranch",
    "SingularSet",
    "SingularityScan",
    "IKSolutions",
    "IKSolutionsBatch",
    "ReachabilityMap",
    "Placements",
}
CALLS = sorted(
    name
    for name, value in PUBLIC.items()
    if name not in RESULTS
    and callable(value)
    and not (inspect.isclass(value) and issubclass(value, BaseException))
    and "robot" in inspect.signature(value).parameters
)


@pytest.mark.parametrize("name", CALLS)
def test_every_function_of_a_robot_answers_or_says_that_nothing_moves(still, tmp_path, name):
    call = nothing_moves(still, r1.PositionTask(), tmp_path)[name]
    try:
        answer = call()
    except r1.Robotics1Error as error:
        answer = str(error) if any(words in str(error) for words in ("no joint", "nothing moves")) else None
    assert answer is not None


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["fk"], "p = (0.1000, 0.2000, 0.3000)"),
        (["jacobian"], "rank 0"),
        (["jacobian", "--python"], "def jacobian(q)"),
        (["manipulability"], "w = 0"),
        (["statics", "--force", "1,0,0"], "need no torque"),
        (["check"], "0 degrees of freedom"),
        (["singularities", "--task", "position"], ""),
        (["ik", "--task", "position", "--target", "0.1,0.2,0.3"], ""),
        (["scan", "--task", "position"], ""),
    ],
)
def test_commands_answer_or_end_with_misuse_without_a_traceback(file, arguments, word):
    command, *options = arguments
    ended = run(command, file, *options)
    assert ended.code in (0, 1) or ended.refusal
    assert word in ended.stdout
