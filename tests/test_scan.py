import math
import tracemalloc
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from functools import cache
from math import pi
from multiprocessing import get_context

import numpy as np
import pytest
from arms import arm, span
from closed_forms import cylindrical_determinant, prr_pose_determinant, two_link_determinant
from dh_arms import ZYZ, dh, five, srs, ur5
from differences import unitless
from joint_kinds import mimic, urdf

import robotics1 as r1
from robotics1 import (
    FunctionTask,
    OrientationTask,
    PlanarPoseTask,
    PointingTask,
    PoseTask,
    PositionTask,
    load_robot,
    scan_singularities,
)
from robotics1.singularities import measurement

CHUNK = 2**14  # configurations that are measured at a time
ALL = ("sigma_min", "condition", "manipulability")
XY, POSE = PositionTask("xy"), PoseTask()
POLAR = FunctionTask(lambda p, R, q: [np.hypot(p[0], p[1]), np.arctan2(p[1], p[0])], 2)

CASES = {  # name → robot, task, ρ, whether the kernels serve it
    "2R xy": (lambda: arm("planar_2r"), XY, 2, True),
    "2R x": (lambda: arm("planar_2r"), PositionTask("x"), 1, True),
    "2R xyz": (lambda: arm("planar_2r"), PositionTask(), 2, True),
    "2R polar": (lambda: arm("planar_2r"), POLAR, 2, False),
    "one joint": (lambda: arm("one_joint"), POSE, 1, True),
    "PRR pose": (lambda: arm("prr"), PlanarPoseTask("xy"), 3, True),
    "PRR twist": (lambda: arm("prr"), POSE, 3, True),
    "cylindrical": (lambda: arm("cylindrical"), PositionTask(), 3, True),
    "spatial": (lambda: arm("spatial"), POSE, 5, True),
    "spatial turn": (lambda: arm("spatial"), OrientationTask(), 3, True),
    "spatial pointing": (lambda: arm("spatial"), PointingTask("z"), 2, False),
    "spatial angles": (lambda: arm("spatial"), PoseTask(angles="ZYZ"), 5, False),
    "spatial in the tool's axes": (lambda: arm("spatial"), PositionTask("xy", reference="tool"), 2, False),
    "spatial in the base's axes": (lambda: arm("spatial"), PositionTask("yx", reference="base"), 2, True),
    "redundant": (lambda: arm("redundant"), POSE, 6, True),
    "another frame": (srs, PositionTask("xyz", frame="link5"), 3, True),
    "UR5": (ur5, POSE, 6, True),
    "5R": (five, POSE, 5, True),
}


def first_frame(robot):
    return robot.frame_names[0]


@cache
def case(name):
    make, task, rank, served = CASES[name]
    robot = make()
    if getattr(task, "reference", None) == "base":
        task = PositionTask(task.axes, reference=first_frame(robot))
    return robot, task, rank, served


def brute_force(robot, task, q, rank, length=1.0):
    """The measures from J at one configuration after another."""
    rows = [1 / length if unit == "m" else 1 for unit in task.row_units]
    columns = np.where(robot.revolute, 1, length)
    J = np.array([np.diag(rows) @ task.jacobian(robot, x) * columns for x in q])
    sigma = np.linalg.svd(J, compute_uv=False)[:, :rank]
    return {
        "sigma_min": sigma[:, -1],
        "condition": sigma[:, 0] / sigma[:, -1],
        "manipulability": sigma.prod(axis=1),
    }


class SumOfJoints:
    """A user's own task, r = q1 + ... + qn, that keeps where it was asked for J."""

    row_names, row_units, rows = ("r",), ("1",), 1

    def __init__(self):
        self.asked = []

    def jacobian(self, robot, q):
        self.asked.append(np.array(q))
        return np.ones((1, robot.nv))

    def check(self, robot):
        pass

    check_integrable = check

    def frame_map(self):
        return None


def configurations(robot, method, samples, seed=0):
    """The configurations of a scan: a task without a kernel is asked for J at one after another, the scan's last."""
    task = SumOfJoints()
    scan = scan_singularities(robot, task, samples=samples, method=method, seed=seed)
    return np.array(task.asked[-scan.count :])


def is_asked_everywhere(monkeypatch, robot, task, samples=400):
    """Whether a scan asks the task itself for J at every configuration, not a kernel."""
    asked, jacobian = [], type(task).jacobian
    monkeypatch.setattr(type(task), "jacobian", lambda *of: asked.append(of) or jacobian(*of))
    scan_singularities(robot, task, samples=samples)
    assert len(asked) >= samples or len(asked) < samples / 2
    return len(asked) >= samples


@pytest.mark.parametrize("name", CASES)
def test_the_kernels_serve_tasks_whose_rows_are_the_same_everywhere(name, monkeypatch):
    robot, task, _, served = case(name)
    assert is_asked_everywhere(monkeypatch, robot, task) != served


@pytest.mark.parametrize("name", CASES)
def test_a_scan_is_what_singular_values_of_every_jacobian_say(name):
    robot, task, rank, _ = case(name)
    scan = scan_singularities(robot, task, samples=400, measures=ALL)
    q = configurations(robot, "random", 400)
    values = brute_force(robot, task, q, rank)
    assert (scan.count, scan.undefined, scan.rank, scan.measures) == (400, 0, rank, ALL)
    order = np.argsort(values["sigma_min"], kind="stable")[:10]
    assert scan.worst_values == pytest.approx(values["sigma_min"][order], rel=0, abs=1e-10)
    again = brute_force(robot, task, scan.worst, rank)["sigma_min"]
    assert scan.worst_values == pytest.approx(again, rel=0, abs=1e-10)
    for measure in ALL:
        known = scan.distribution(measure)
        assert known.count == 400
        exact = {p: np.quantile(values[measure], p, method="inverted_cdf") for p in (0, 0.05, 0.3, 0.5, 0.9, 1)}
        for p, value in exact.items():
            assert scan.quantile(p, measure) == pytest.approx(value, rel=1 / 256 + 1e-6, abs=1e-9)


def test_the_worst_are_the_extremes_of_the_first_measure():
    robot = arm("spatial")
    q = configurations(robot, "random", 500, seed=3)
    values = brute_force(robot, POSE, q, 5)
    for first, sign in (("sigma_min", 1), ("condition", -1), ("manipulability", 1)):
        scan = scan_singularities(robot, POSE, samples=500, measures=[first], seed=3)
        assert scan.worst == pytest.approx(q[np.argsort(sign * values[first])[:10]], rel=0, abs=0)
        assert scan.worst_values == pytest.approx(np.sort(sign * values[first])[:10] * sign, rel=1e-9)


@pytest.mark.parametrize("length", [0.1, 2.0])
def test_with_a_length_rows_in_metres_are_divided_and_prismatic_columns_multiplied_by_it(length):
    for name in ("PRR pose", "cylindrical", "spatial", "spatial angles"):
        robot, task, rank, _ = case(name)
        q = configurations(robot, "random", 60)
        expected = brute_force(robot, task, q, rank, length)
        scan = scan_singularities(robot, task, samples=60, measures=ALL, length=length)
        assert scan.worst_values == pytest.approx(np.sort(expected["sigma_min"])[:10], rel=0, abs=1e-12)
        assert scan.maximum("manipulability") == pytest.approx(expected["manipulability"].max(), rel=1e-9)


def test_with_the_reach_as_length_it_is_the_jacobian_without_units():
    robot = arm("spatial")
    scan = scan_singularities(robot, POSE, samples=100, length=robot.reach)
    sigma = [np.linalg.svd(unitless(robot, POSE, q), compute_uv=False)[4] for q in scan.worst]
    assert scan.worst_values == pytest.approx(sigma, rel=0, abs=1e-12)


def test_a_revolute_joint_that_follows_a_prismatic_one_has_its_unit_too(tmp_path, monkeypatch):
    joints = (("a", "prismatic", "base"), ("b", "revolute", "a", mimic("a", 2.5)), ("c", "revolute", "b"))
    path = tmp_path / "rack.urdf"
    path.write_text(urdf(*joints, ("tool", "fixed", "c")), encoding="utf-8")
    robot = load_robot(path)
    q = configurations(robot, "random", 50)
    for length in (1.0, 0.2):
        expected = brute_force(robot, PositionTask(), q, 2, length)
        scan = scan_singularities(robot, PositionTask(), samples=50, measures=ALL, length=length)
        assert scan.minimum() == pytest.approx(expected["sigma_min"].min(), rel=1e-10)
        assert scan.maximum("condition") == pytest.approx(expected["condition"].max(), rel=1e-10)
    assert not is_asked_everywhere(monkeypatch, robot, PositionTask())


# --- closed forms


def test_prr_planar_pose_manipulability_is_l2_cos_q2_and_so_distributed():
    robot = arm("prr")
    l2, l3 = robot.parameters["l2"], robot.parameters["l3"]
    scan = scan_singularities(robot, PlanarPoseTask("xy"), samples=4e5, measures=["manipulability"])
    exact = [abs(prr_pose_determinant(q, l2, l3)) for q in scan.worst]
    assert scan.worst_values == pytest.approx(exact, rel=1e-9, abs=1e-15)
    for p in (0.1, 0.5, 0.9):  # |cos q2| ≤ x for a part 2/π asin x of the circle
        assert scan.quantile(p) == pytest.approx(l2 * math.sin(pi * p / 2), rel=0.01)


@pytest.mark.parametrize(("method", "samples"), [("sobol", 300_000), ("grid", (3, 100_000))])
def test_planar_2r_manipulability_is_l1_l2_sin_q2_and_so_distributed(method, samples):
    robot = arm("planar_2r")
    l1, l2 = robot.parameters["l1"], robot.parameters["l2"]
    scan = scan_singularities(robot, XY, samples=samples, measures=["manipulability"], method=method)
    assert scan.worst_values == pytest.approx([abs(two_link_determinant(q, l1, l2)) for q in scan.worst], abs=1e-15)
    for p in (0.1, 0.5, 0.9):
        assert scan.quantile(p) == pytest.approx(l1 * l2 * math.sin(pi * p / 2), rel=0.006)


def test_cylindrical_position_sigma_min_is_q3_or_one():
    scan = scan_singularities(arm("cylindrical"), PositionTask(), samples=2e4, measures=ALL)
    assert scan.worst_values == pytest.approx([abs(cylindrical_determinant(q)) for q in scan.worst], rel=1e-9)
    assert scan.maximum() == pytest.approx(1)


def test_a_gantry_has_sigma_min_1_everywhere():
    lifts = [("P", 0, pi / 2, 0, 0), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, pi / 2)]
    box = {"q1": (0, 1), "q2": (0, 1), "q3": (0, 1)}
    scan = scan_singularities(dh(*lifts), PositionTask(), samples=5000, measures=ALL, box=box)
    for measure in ALL:
        assert scan.minimum(measure) == pytest.approx(1, abs=1e-14)
        assert scan.maximum(measure) == pytest.approx(1, abs=1e-14)


# --- which configurations


def test_random_configurations_are_inside_the_box_and_named_by_the_seed():
    robot = arm("elbow_limited")
    lower, upper = span(robot)
    q = configurations(robot, "random", 3000)
    assert np.all((q >= lower) & (q <= upper))
    assert q.mean(axis=0) == pytest.approx((lower + upper) / 2, abs=0.1)
    assert not np.any(q == configurations(robot, "random", 3000, seed=1))
    assert not np.any(q[:100] == configurations(robot, "sobol", 100))


@pytest.mark.parametrize("method", ["random", "sobol"])
def test_more_samples_begin_with_the_same_configurations(method):
    robot = arm("planar_3r")
    few, many = configurations(robot, method, 100), configurations(robot, method, 2 * CHUNK + 100)
    assert many.shape == (2 * CHUNK + 100, 3)
    assert np.array_equal(few, many[:100])
    assert len(np.unique(many, axis=0)) == len(many)


def test_sobols_sequence_has_a_point_in_each_of_many_equal_boxes():
    q = configurations(arm("planar_2r"), "sobol", CHUNK)
    boxes = np.floor((q / (2 * pi) + 0.5) * 128).astype(int)  # 128² boxes, and as many points
    assert len(np.unique(boxes, axis=0)) == CHUNK


def test_a_grid_has_both_limits_and_of_a_circle_both_ends_once():
    robot = arm("spatial")
    lower, upper = span(robot)
    circular = robot.revolute & (robot.upper - robot.lower > 2 * pi - 1e-9)
    q = configurations(robot, "grid", (4, 3, 1, 2, 2))
    assert q.shape == (48, 5)
    assert len(np.unique(q, axis=0)) == 48
    for i, size in enumerate((4, 3, 1, 2, 2)):
        values = np.unique(q[:, i])
        assert len(values) == size
        if circular[i] and size > 1:
            assert values == pytest.approx(-pi + 2 * pi * np.arange(1, size + 1) / size)
        elif size > 1:
            assert values == pytest.approx(np.linspace(lower[i], upper[i], size))
        else:
            assert values == pytest.approx((lower[i] + upper[i]) / 2)


def test_a_grid_has_at_most_as_many_points_as_samples_and_one_value_of_joints_that_do_not_matter():
    robot = srs()
    scan = scan_singularities(robot, PositionTask(frame="link5"), samples=1000, method="grid")
    assert scan.count == 5**4  # the wrist centre is moved by four joints
    assert np.all(scan.worst[:, 4:] == scan.worst[0, 4:])
    assert scan_singularities(robot, POSE, samples=3**7 - 1, method="grid").count == 2**7


def test_a_grid_over_chunks_has_every_combination_once():
    q = configurations(arm("planar_2r"), "grid", (190, 200))
    assert len(q) == 190 * 200 > 2 * CHUNK
    assert len(np.unique(q, axis=0)) == len(q)


def test_a_box_narrows_the_joints_it_names():
    scan = scan_singularities(arm("planar_2r"), XY, samples=5000, box={"q2": (0.5, 1.0)})
    l1, l2 = (arm("planar_2r").parameters[name] for name in ("l1", "l2"))
    assert np.all((scan.worst[:, 1] >= 0.5) & (scan.worst[:, 1] <= 1.0))
    J = XY.jacobian(arm("planar_2r"), [0, 0.5])
    assert scan.minimum() == pytest.approx(np.linalg.svd(J, compute_uv=False)[1], rel=1e-3)
    assert scan.minimum() > l1 * l2 * math.sin(0.5) / np.linalg.norm(J)


# --- chunks and workers


def same(a, b):
    assert (a.count, a.undefined, a.rank) == (b.count, b.undefined, b.rank)
    assert np.array_equal(a.worst, b.worst)
    assert np.array_equal(a.worst_values, b.worst_values)
    for measure in a.measures:
        known, other = a.distribution(measure), b.distribution(measure)
        assert (known.count, known.minimum, known.maximum) == (other.count, other.minimum, other.maximum)
        assert np.array_equal(known.bins, other.bins)


@pytest.mark.parametrize("method", ["random", "sobol", "grid"])
def test_the_answer_does_not_depend_on_the_workers(method):
    robot = arm("redundant")
    options = {"samples": 4 * CHUNK + 77, "measures": ALL, "method": method, "seed": 5}
    alone = scan_singularities(robot, POSE, **options)
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        same(alone, scan_singularities(robot, POSE, executor=pool, **options))
    with ThreadPoolExecutor(3) as pool:
        same(alone, scan_singularities(robot, POSE, executor=pool, **options))


def test_a_task_that_is_not_served_by_kernels_is_measured_here_whatever_the_executor():
    options = {"samples": 50, "measures": ALL}
    with ThreadPoolExecutor(2) as pool:
        same(
            scan_singularities(arm("planar_2r"), POLAR, executor=pool, **options),
            scan_singularities(arm("planar_2r"), POLAR, **options),
        )


def test_many_chunks_are_reduced_as_one():
    """Of J = (a, 0, 0), a with few digits, so that a² and its root are exact; and by the kernel, to rounding."""
    samples = 3 * CHUNK + 5
    q = configurations(arm("planar_3r"), "random", samples)

    def few_digits(x):
        return np.round(np.abs(x) * 2**20) / 2**20

    class Few(SumOfJoints):
        def jacobian(self, robot, q):
            return np.array([[few_digits(q[0]), 0, 0]])

    scan = scan_singularities(arm("planar_3r"), Few(), samples=samples, measures=ALL)
    a = few_digits(q[:, 0])
    values = {"sigma_min": a, "condition": np.where(a > 0, 1.0, np.inf), "manipulability": a}
    assert scan.count == samples
    assert scan.worst_values == pytest.approx(np.sort(a)[:10], rel=0, abs=0)
    for measure in ALL:
        edges, counts = scan.histogram(measure, per_octave=128)
        assert np.array_equal(counts, np.histogram(values[measure], edges)[0])
    links = np.exp(1j * np.cumsum(q, axis=1)) * list(arm("planar_3r").parameters.values())
    J = 1j * np.cumsum(links[:, ::-1], axis=1)[:, ::-1]  # ẋ + j ẏ
    sigma = np.linalg.svd(np.stack([J.real, J.imag], axis=1), compute_uv=False)[:, 1]
    scan = scan_singularities(arm("planar_3r"), XY, samples=samples)
    assert scan.worst_values == pytest.approx(np.sort(sigma)[:10], rel=0, abs=1e-10)


def test_the_memory_does_not_grow_with_the_samples(monkeypatch):
    monkeypatch.setattr("robotics1.chunks.workers.threads", lambda: 1)  # more have a few chunks each on their way

    def peak(chunks):
        tracemalloc.start()
        scan_singularities(arm("planar_3r"), XY, samples=chunks * CHUNK, measures=ALL)
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return most

    peak(1)  # what is imported and kept the first time
    assert peak(40) < 1.1 * peak(4)


def test_progress_is_told_after_each_chunk():
    told = []
    scan_singularities(arm("prr"), PlanarPoseTask("xy"), samples=2 * CHUNK + 1, progress=lambda *n: told.append(n))
    assert told == [(CHUNK, 2 * CHUNK + 1), (2 * CHUNK, 2 * CHUNK + 1), (2 * CHUNK + 1, 2 * CHUNK + 1)]


def test_configurations_at_which_the_task_has_no_jacobian_are_counted_and_left_out():
    wrist, task = dh(*ZYZ, d6=0.1), OrientationTask(angles="ZYZ")
    scan = scan_singularities(wrist, task, samples=4**3, method="grid", measures=ALL)
    assert (scan.count, scan.undefined) == (64, 32)  # q2 of −π/2, 0, π/2 and π: sin q2 = 0 at half of them
    assert scan.distribution().count == 32
    assert scan.minimum("manipulability") == pytest.approx(1)  # φ = q here: J is the identity, or changes signs


def test_where_j_is_zero_sigma_min_is_zero_and_the_condition_infinite():
    robot = arm("planar_2r")
    scan = scan_singularities(robot, PositionTask("x"), samples=(1, 4), method="grid", measures=ALL, box={"q1": (0, 0)})
    assert scan.minimum() == pytest.approx(0, abs=1e-15)
    flat = scan_singularities(robot, XY, samples=(3, 2), method="grid", measures=["condition"])
    assert flat.worst_values[0] > 1e15


def test_a_small_scan_is_not_worth_compiling_and_gives_the_same(monkeypatch):
    with_the_kernel = r1.scan_singularities(
        "prr", "planar-pose", samples=2000, measures=("condition", "manipulability")
    )
    monkeypatch.setattr(measurement, "is_ready", lambda kernel: False)
    monkeypatch.setattr(measurement, "singularity_measures", None)  # nothing compiled is called
    by_numpy = r1.scan_singularities("prr", "planar-pose", samples=2000, measures=("condition", "manipulability"))
    assert by_numpy.worst == pytest.approx(with_the_kernel.worst)
    for measure in ("condition", "manipulability"):
        assert by_numpy.minimum(measure) == pytest.approx(with_the_kernel.minimum(measure), rel=1e-9)
        assert by_numpy.maximum(measure) == pytest.approx(with_the_kernel.maximum(measure), rel=1e-9)
    monkeypatch.setattr(measurement, "MOST_UNCOMPILED", 17_999)  # entries of 2000 Jacobians, 3 × 3
    with pytest.raises(TypeError):
        r1.scan_singularities("prr", "planar-pose", samples=2000)
