"""No success of `IKSolver` is false: Pinocchio verifies it, strictly inside the limits; and none is missed."""

from functools import cache

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, configurations
from dh_arms import P, R, dh
from hypothesis import given, strategies as st

from robotics1 import IKSolver, OrientationTask, PlanarPoseTask, PointingTask, PoseTask, PositionTask, load_robot
from robotics1.ik import IKStatus

REACHABLE = 720  # targets of each case
ANYWHERE = 30  # of each case, most of them out of reach
TOLERANCE = 1e-6
ROUNDING = 1e-13  # between the kernels' forward kinematics and Pinocchio's

# q1 is unlimited, the wrist turns by -0.5 q3 + 0.3, and the tool is offset and turned.
MIMIC = """<robot name="mimic"><link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/>
<link name="tool"/>
<joint name="q1" type="continuous"><parent link="base"/><child link="a"/><origin xyz="0 0 0.3"/>
<axis xyz="0 0 1"/></joint>
<joint name="q2" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 -1 0"/>
<limit lower="-1" upper="2" velocity="1" effort="1"/></joint>
<joint name="q3" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0"/><axis xyz="0 -1 0"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
<joint name="q4" type="revolute"><parent link="c"/><child link="d"/><origin xyz="0.4 0 0"/><axis xyz="0 -1 0"/>
<limit lower="-9" upper="9" velocity="1" effort="1"/><mimic joint="q3" multiplier="-0.5" offset="0.3"/></joint>
<joint name="tip" type="fixed"><parent link="d"/><child link="tool"/>
<origin xyz="0.2 0.1 0.05" rpy="0.3 -0.4 0.5"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def mimic_arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("mimic") / "mimic.urdf"
    path.write_text(MIMIC, encoding="utf-8")
    return load_robot(path)


@cache
def robot(name):
    if name in ("ur5", "panda"):
        return load_robot(name, tool={"ur5": "tool0", "panda": "panda_link8"}[name])
    if name == "5R":
        return dh(R(0, 1.57079632679, "d1"), R("a2", 0, 0), R("a3", 0, 0), R(0, 1.2, 0), R("a5", 0, 0.1),
                  tool=0.1, d1=0.4, a2=0.5, a3=0.35, a5=0.08)  # fmt: skip
    if name == "RPR":
        return dh(R("a1", 1.2, 0.1), P(0.7), R("a3", 0, 0), tool=0.2, a1=0.3, a3=0.25)
    return load_robot(name) if name == "z1" else arm(name)


CASES = [
    ("planar_2r", PositionTask("xy")),
    ("planar_2r", PlanarPoseTask("xy")),
    ("elbow_limited", PositionTask("xy")),
    ("vertical_2r", PlanarPoseTask("xz")),
    ("planar_3r", PlanarPoseTask("xy")),
    ("planar_3r", PositionTask("y")),
    ("prr", PlanarPoseTask("xy")),
    ("prr", PositionTask("xy")),
    ("cylindrical", PositionTask()),
    ("RPR", PositionTask()),
    ("anthropomorphic", PositionTask()),
    ("anthropomorphic", PositionTask("zx")),
    ("continuous", PositionTask()),
    ("spatial", PoseTask()),
    ("spatial", PointingTask((1.0, 2.0, -2.0))),
    ("5R", PoseTask()),
    ("six_r", PoseTask()),
    ("six_r", OrientationTask()),
    ("redundant", PoseTask()),
    ("redundant", PositionTask()),
    ("ur5", PoseTask()),
    ("ur5", PoseTask(reference="base")),
    ("ur5", PositionTask("xz", frame="wrist_2_link", reference="base")),
    ("ur5", PointingTask("-x")),
    ("panda", PoseTask()),
    ("panda", OrientationTask()),
    ("z1", PoseTask()),
]
TOLD_BY_ANGLES = [
    ("six_r", PoseTask(angles="ZYZ")),
    ("ur5", PoseTask(angles="XYZ", fixed=True, reference="base")),
    ("panda", OrientationTask(angles="Z-YX")),
]


def named(case):
    name, task = case
    return f"{name}-{type(task).__name__}-{''.join(task.row_names)}-{task.reference}"


def inside(robot, rng, count):
    """Configurations uniform within the limits, and within one turn."""
    return rng.uniform(np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi), (count, robot.nq))


def verified(robot, task, batch, targets, tolerance=TOLERANCE):
    """Assert of every answer that its |e| is Pinocchio's, of a success that it is one; return how many are."""
    assert np.all(batch.q >= robot.lower)
    assert np.all(batch.q <= robot.upper)
    for i, target in enumerate(targets):
        e = np.linalg.norm(task.error(robot, batch.q[i], target))
        if batch.status[i] is IKStatus.CONVERGED:
            assert batch.error_norm[i] <= tolerance
            assert e <= tolerance + ROUNDING
        else:
            assert batch.error_norm[i] > tolerance
            assert e == pytest.approx(batch.error_norm[i], rel=1e-6)
    return int(np.count_nonzero(batch.converged))


def anywhere(task, value, rng):
    """A target made of a reachable one: lengths times up to 2.5, turned at random where it holds a rotation."""
    factor = rng.uniform(0, 2.5)
    turn = pin.Quaternion(rng.standard_normal(4)).normalized().toRotationMatrix()
    if isinstance(value, pin.SE3):
        return pin.SE3(turn @ value.rotation, factor * value.translation)
    if np.shape(value) == (3, 3) or isinstance(task, PointingTask):
        return turn @ value
    lengths = np.array([factor if unit == "m" else 1.0 for unit in task.row_units])
    return lengths * value


def check(robot, task, seed, **options):
    rng = np.random.default_rng(seed)
    targets = [task.value(robot, q) for q in inside(robot, rng, REACHABLE)]
    assert verified(robot, task, IKSolver(robot, task, **options).solve_batch(targets), targets) == REACHABLE
    targets = [anywhere(task, targets[i], rng) for i in range(ANYWHERE)]
    verified(robot, task, IKSolver(robot, task, time_limit=1e-4, **options).solve_batch(targets), targets)


@pytest.mark.parametrize("case", CASES, ids=named)
def test_every_target_f_of_q_is_reached_and_every_success_has_the_error_that_pinocchio_computes(case):
    name, task = case
    check(robot(name), task, seed=100 + CASES.index(case))


@pytest.mark.parametrize("task", [PositionTask("xy"), PositionTask(), PointingTask()], ids=["xy", "xyz", "z axis"])
def test_so_it_is_of_an_arm_with_a_joint_that_follows_another(mimic_arm, task):
    check(mimic_arm, task, seed=3)


@pytest.mark.parametrize("case", TOLD_BY_ANGLES, ids=named)
def test_and_of_orientations_told_by_angles_where_those_are_determined(case):
    """The kernel brings the rotation vector to 1e-9; the angles are off by its 1/sin φ₂."""
    name, task = case
    arm_, rng = robot(name), np.random.default_rng(11)
    targets = [task.value(arm_, q) for q in inside(arm_, rng, REACHABLE)]
    batch = IKSolver(arm_, task).solve_batch(targets)
    assert np.all(batch.converged)
    assert np.all(batch.error_norm <= 1e-9)
    assert np.all(batch.q >= arm_.lower)
    assert np.all(batch.q <= arm_.upper)
    for q, target in zip(batch.q, targets, strict=True):
        middle = target[-2]
        steep = abs(np.sin(middle) if "ZYZ" in task.angles else np.cos(middle))
        assert np.linalg.norm(task.error(arm_, q, target)) <= 3e-9 / steep


@pytest.mark.parametrize("prefer", ["near", "middle"])
@pytest.mark.parametrize("name", ["redundant", "panda"])
def test_what_is_moved_along_the_null_space_stays_a_solution(name, prefer):
    """Where limits stop the way along the null space it ends beside the solutions: there the first one must stay."""
    moved, rng = robot(name), np.random.default_rng(31)
    targets = [PoseTask().value(moved, q) for q in inside(moved, rng, 1500)]
    batch = IKSolver(moved, PoseTask(), prefer=prefer).solve_batch(targets, inside(moved, rng, 1500))
    assert verified(moved, PoseTask(), batch, targets) == 1500


@pytest.mark.parametrize("tolerance", [1e-3, 1e-9, 1e-12])
def test_a_success_is_within_the_tolerance_that_was_asked(tolerance):
    ur5, task = robot("ur5"), PoseTask()
    targets = [task.value(ur5, q) for q in inside(ur5, np.random.default_rng(2), 300)]
    batch = IKSolver(ur5, task, tolerance=tolerance).solve_batch(targets)
    assert verified(ur5, task, batch, targets, tolerance) == 300


@given(st.sampled_from(["spatial", "six_r", "redundant", "continuous", "elbow_limited"]).flatmap(
    lambda name: st.tuples(st.just(name), configurations(arm(name)), configurations(arm(name)))
))  # fmt: skip
def test_from_any_start_any_f_of_q_is_reached_inside_the_limits(drawn):
    name, q, q0 = drawn
    arm_, task = arm(name), PositionTask("xy")
    target = task.value(arm_, q)
    found = IKSolver(arm_, task)(target, q0)
    assert found.converged
    assert arm_.within_limits(found.q, tolerance=0.0)
    assert np.linalg.norm(task.value(arm_, found.q) - target) <= TOLERANCE


@given(st.tuples(*[st.floats(-3, 3)] * 3), st.tuples(*[st.floats(-3, 3)] * 3))
def test_of_any_pose_the_answer_tells_the_error_that_pinocchio_computes(p, w):
    six_r, target = arm("six_r"), pin.SE3(pin.exp3(np.array(w)), np.array(p))
    found = IKSolver(six_r, PoseTask(), time_limit=1e-4)(target)
    assert found.error_norm == pytest.approx(
        np.linalg.norm(PoseTask().error(six_r, found.q, target)), rel=1e-6, abs=1e-12
    )
    assert found.converged == (found.error_norm <= TOLERANCE)
    assert six_r.within_limits(found.q, tolerance=0.0)
