"""The names of postures follow the signs of textbook formulas, for every target; aspects and paths between them."""

import pickle
from math import pi

import numpy as np
import pytest
from arms import arm
from hypothesis import given, settings, strategies as st
from scipy.ndimage import label
from test_all_solutions import (
    ANTHROPOMORPHIC,
    CYLINDRICAL,
    ORTHOGONAL,
    POSE,
    PUMA,
    SKEW,
    STANFORD,
    UR5,
    XYZ,
    P,
    R,
    robot_of,
)

import robotics1 as r1
from robotics1.ik import PostureChangeStatus as Change, group_by_aspect, posture_change
from robotics1.ik.postures.determinant import determinant
from robotics1.ik.postures.path_between import region_of
from robotics1.ik.postures.separation import are_apart, wall_between, walls

H = pi / 2
XY, PLANE = r1.PositionTask("xy"), r1.PlanarPoseTask()
SCARA = [R(0.4, 0, 0.5), R(0.3, pi, 0), P(0), R(0, 0, 0)]


def labels_at(rows, task, q):
    """The names at q, through the solutions of f(q): q is one of them."""
    robot = robot_of(rows)
    found = r1.ik_solutions(robot, task, task.value(robot, q), starts=20)
    apart = np.abs(np.exp(1j * found.q) - np.exp(1j * np.asarray(q))).max(axis=1)
    assert len(set(found.labels)) == len(found)  # each posture once
    return found.labels[int(np.argmin(apart))]


def drawn(seed, n):
    return np.random.default_rng(seed).uniform(-3, 3, n)


def of(part, value, positive, negative):
    return f"{part} {positive if value > 0 else negative}"


@given(st.integers(0, 10_000))
@settings(max_examples=10)
def test_the_elbow_of_a_planar_arm_is_down_where_q2_is_positive(seed):
    q = drawn(seed, 3)
    expected = (of("elbow", q[1], "down", "up"),)
    assert labels_at([R(0.4, 0, 0), R(0.3, 0, 0)], XY, q[:2]) == expected
    assert labels_at([R(0.4, 0, 0), R(0.3, 0, 0), R(0.1, 0, 0)], PLANE, q) == expected


@given(st.integers(0, 10_000))
@settings(max_examples=5)
def test_the_elbow_of_a_scara_arm_is_right_where_q2_is_positive(seed):
    q = drawn(seed, 4)
    expected = (of("elbow", q[1], "right", "left"),)
    assert labels_at(SCARA, POSE, q) == labels_at(SCARA[:3], XYZ, q[:3]) == expected


def test_the_elbow_of_a_vertical_plane_is_up_where_it_lies_above_the_line_to_the_tip():
    robot = arm("vertical_2r")
    task = r1.PositionTask("xz")
    found = r1.ik_solutions(robot, task, task.value(robot, [0.3, 0.8]))
    base_joint, elbow_joint = robot.joint_names
    for q, names in zip(found.q, found.labels, strict=True):
        tip = np.array(task.value(robot, q))
        p = r1.forward_kinematics(robot, q, frame=elbow_joint).translation[[0, 2]]
        base = r1.forward_kinematics(robot, q, frame=base_joint).translation[[0, 2]]
        d, e = tip - base, p - base
        assert names == (of("elbow", d[0] * e[1] - d[1] * e[0], "up", "down"),)


@given(st.integers(0, 10_000))
@settings(max_examples=10)
def test_shoulder_and_elbow_of_an_anthropomorphic_arm_follow_its_determinant(seed):
    """det J = −a2 a3 s3 (a2 c2 + a3 c23); the elbow is above the line where s3 has the other sign than the bracket."""
    q = drawn(seed, 3)
    reach = 0.5 * np.cos(q[1]) + 0.35 * np.cos(q[1] + q[2])
    expected = of("shoulder", reach, "right", "left"), of("elbow", np.sin(q[2]) * reach, "down", "up")
    assert labels_at(ANTHROPOMORPHIC, XYZ, q) == expected


@given(st.integers(0, 10_000))
@settings(max_examples=5)
def test_the_postures_of_a_puma_are_its_three_indicators(seed):
    """Lee and Ziegler's ARM, ELBOW and WRIST, with the signs of this table: α3 = −90°."""
    q, (a2, a3, d4) = drawn(seed, 6), (0.4318, 0.0203, 0.4318)
    shoulder = a2 * np.cos(q[1]) + a3 * np.cos(q[1] + q[2]) - d4 * np.sin(q[1] + q[2])
    elbow = shoulder * (d4 * np.cos(q[2]) + a3 * np.sin(q[2]))
    expected = [of("shoulder", shoulder, "right", "left"), of("elbow", elbow, "down", "up")]
    assert labels_at(PUMA, POSE, q) == (*expected, of("wrist", np.sin(q[4]), "not flipped", "flipped"))


@given(st.integers(0, 10_000))
@settings(max_examples=5)
def test_the_postures_of_a_ur5_are_the_factors_of_its_determinant(seed):
    q, (a2, a3, d5) = drawn(seed, 6), (-0.425, -0.39225, 0.09465)
    shoulder = a2 * np.cos(q[1]) + a3 * np.cos(q[1] + q[2]) + d5 * np.sin(q[1] + q[2] + q[3])
    elbow = shoulder * np.sin(q[2])
    expected = [of("shoulder", shoulder, "right", "left"), of("elbow", elbow, "down", "up")]
    assert labels_at(UR5, POSE, q) == (*expected, of("wrist", np.sin(q[4]), "not flipped", "flipped"))


@pytest.mark.parametrize("q3", [0.5, -0.5])
def test_a_slide_reaches_forward_where_its_coordinate_is_positive(q3):
    assert labels_at(CYLINDRICAL, XYZ, [0.3, 0.4, q3]) == (of("reach", q3, "forward", "backward"),)
    assert labels_at(STANFORD, POSE, [0.3, 1.1, q3, 0.4, 0.6, 0.2])[1] == of("reach", q3, "forward", "backward")


@pytest.mark.parametrize(("rows", "task"), [(ORTHOGONAL, XYZ), (SKEW, POSE)], ids=["orthogonal 3R", "6R"])
def test_an_arm_without_such_postures_has_the_sign_of_det_j(rows, task):
    robot = robot_of(rows)
    q = drawn(4, len(rows))
    found = r1.ik_solutions(robot, task, task.value(robot, q), starts=10)
    signs = [np.sign(np.linalg.det(task.jacobian(robot, p))) for p in found.q]
    assert found.labels == tuple((f"det J {'>' if sign > 0 else '<'} 0",) for sign in signs)


def test_a_redundant_arm_has_no_names_and_a_stretched_one_is_singular():
    robot = robot_of([R(0.4, 0, 0), R(0.3, 0, 0)])
    (names,) = r1.ik_solutions(robot, XY, [0.7, 0]).labels
    assert names == ("elbow singular",)
    three = robot_of([R(0.4, 0, 0), R(0.3, 0, 0), R(0.2, 0, 0)])
    assert set(r1.ik_solutions(three, XY, [0.5, 0.2], starts=4).labels) == {()}


def test_names_survive_pickling_and_whole_turns():
    robot = r1.robot_from_dh([R(0.4, 0, 0), R(0.3, 0, 0)], lower=[-6, -6], upper=[6, 6])
    found = r1.ik_solutions(robot, XY, [0.3, 0.2], windings=True)
    assert pickle.loads(pickle.dumps(found)).labels == found.labels
    assert found.labels == tuple((of("elbow", np.sin(q[1]), "down", "up"),) for q in found.q)
    assert len(found) > 2


# paths without singularities


def det_of_the_orthogonal_arm(q2, q3, a1=1.0, a2=2.0, a3=1.5, d2=1.0):
    """Wenger: a3 (a2 + a3 c3) (a1 s3 + (a2 s3 − d2 c3) c2), but for its sign."""
    return a3 * (a2 + a3 * np.cos(q3)) * (a1 * np.sin(q3) + (a2 * np.sin(q3) - d2 * np.cos(q3)) * np.cos(q2))


def same_part(a, b, cells=400, **lengths):
    """Whether a flood fill of a grid over (q2, q3) joins two configurations of the orthogonal arm."""
    ticks = -pi + 2 * pi / cells * np.arange(3 * cells)  # three turns, so that no seam is in the way
    q2, q3 = np.meshgrid(ticks, ticks, indexing="ij")
    parts, _ = label(det_of_the_orthogonal_arm(q2, q3, **lengths) * det_of_the_orthogonal_arm(*a[1:], **lengths) > 0)

    def places(q):
        i, j = np.round((q[1:] + pi) / (2 * pi / cells)).astype(int) % cells
        return {int(parts[i + m * cells, j + n * cells]) for m in range(3) for n in range(3)}

    return bool(places(a) & places(b))


@pytest.mark.parametrize(("a2", "a3", "d2", "joined"), [(2.0, 1.5, 1.0, {True}), (0.5, 0.7, 0.2, {True, False})])
def test_a_path_of_an_orthogonal_arm_exists_where_a_flood_fill_finds_one(a2, a3, d2, joined):
    """With a3 > a2 there is a further factor, a2 + a3 cos q3, so that det J has one sign on several parts."""
    robot = robot_of([R(1, -H, 0), R(a2, H, d2), R(a3, 0, 0)])
    pairs = [drawn(seed, 6).reshape(2, 3) for seed in range(60)]
    seen = set()
    for a, b in pairs:
        ends = [det_of_the_orthogonal_arm(*q[1:], a2=a2, a3=a3, d2=d2) for q in (a, b)]
        if min(map(abs, ends)) < 0.1 * a3 or ends[0] * ends[1] < 0:
            continue
        change = posture_change(robot, XYZ, a, b)
        assert change.proven
        seen.add(change.status is Change.FOUND)
        assert (change.status is Change.FOUND) == same_part(a, b, a2=a2, a3=a3, d2=d2)
    assert seen == joined


def test_a_grid_separates_nothing_that_a_flood_fill_joins():
    """All configurations of the classical orthogonal arm at which det J has one sign are joined, also narrowly."""
    det = determinant(robot_of(ORTHOGONAL), XYZ)
    q = np.random.default_rng(3).uniform(-pi, pi, (12, 3))
    for sign in (1, -1):
        first, *others = q[sign * det(q) > 0.01]
        assert all(same_part(first, other) for other in others)
        assert not are_apart(region_of(det, first[None], within_limits=False), first, others[0])


@given(st.integers(0, 10_000), st.sampled_from([ORTHOGONAL, STANFORD, UR5, [R(0.2, 1, 0.3), P(0.8), R(0.3, 0.5, 0.1)]]))
@settings(max_examples=15)
def test_the_slope_of_det_j_is_not_above_its_bound(seed, rows):
    """What the proof of a path rests on: differences along a random segment, against the bound of |d det J/dt|."""
    det = determinant(robot_of(rows), POSE if len(rows) == 6 else XYZ)
    q, step = drawn(seed, 2 * len(rows)).reshape(2, 1, -1) * [[[1.0]], [[0.1]]]
    values = det(q + np.linspace(0, 1, 101)[:, None] * step)
    assert np.abs(np.diff(values)).max() * 100 <= det.change(q, step)[0]


def assert_free_of_singularities(robot, task, change, q_a, q_b):
    assert change.path[0] == pytest.approx(q_a)
    assert np.exp(1j * change.path[-1]) == pytest.approx(np.exp(1j * q_b))
    between = np.concatenate([np.linspace(a, b, 20) for a, b in zip(change.path[:-1], change.path[1:], strict=True)])
    values = np.array([np.linalg.det(task.jacobian(robot, q)) for q in between])
    some = np.random.default_rng(7).uniform(-pi, pi, (2000, robot.nq))
    largest = max(abs(np.linalg.det(task.jacobian(robot, q))) for q in some)
    assert (np.sign(values) == np.sign(values[0])).all()
    assert np.abs(values).min() >= 0.7 * change.least * largest  # the largest of 200 others may be less
    assert change.least > 0


def test_a_path_keeps_the_sign_of_det_j_and_its_distance_from_zero():
    robot = robot_of(ORTHOGONAL)
    found = r1.ik_solutions(robot, XYZ, [2.5, 0, 0.5])
    assert len(found) == 4
    assert group_by_aspect(found).groups == ((0, 2), (1, 3))
    for i, j in ((0, 2), (1, 3)):
        change = posture_change(robot, XYZ, found.q[i], found.q[j]).require()
        assert change.proven
        assert_free_of_singularities(robot, XYZ, change, found.q[i], found.q[j])


def test_configurations_of_one_posture_of_a_ur5_are_joined():
    robot, rng = robot_of(UR5), np.random.default_rng(2)
    a = np.array([0.3, -1.4, 0.9, 0.2, 0.9, 0.3])
    b = a + rng.uniform(-0.5, 0.5, 6)
    change = posture_change(robot, POSE, a, b).require()
    assert_free_of_singularities(robot, POSE, change, a, b)


@pytest.mark.parametrize(("rows", "task"), [(ANTHROPOMORPHIC, XYZ), (UR5, POSE), (STANFORD, POSE)])
def test_no_path_joins_postures_that_differ_by_a_factor_of_det_j(rows, task):
    robot, q = robot_of(rows), drawn(3, len(rows)) * 0.4 + 0.3
    found = r1.ik_solutions(robot, task, task.value(robot, q))
    assert len(found) in (4, 8)
    apart = group_by_aspect(found)
    assert (apart.groups, apart.proven) == (tuple((i,) for i in range(len(found))), True)
    change = posture_change(robot, task, found.q[0], found.q[1])
    assert (change.status, change.proven, len(change.path)) == (Change.IMPOSSIBLE, True, 0)
    assert "changes its sign" in change.explain()


def test_the_joint_values_at_which_det_j_always_vanishes_are_its_factors_in_one_joint():
    """Of a polar arm det J = ∓q3² sin q2: one sign on both sides of q3 = 0, which no path crosses all the same."""
    det = determinant(robot_of([R(0, H, 0.3), R(0, H, 0), P(0)], slide=1.0), XYZ)
    a, b, c = np.array([[0.2, 1, 0.5], [0.4, 0.8, -0.5], [0.4, 0.8, 0.9]])
    region = region_of(det, a[None], within_limits=False)
    found = walls(region)
    assert sorted(np.abs(found[1])) == pytest.approx([0, pi, pi], abs=1e-9)
    assert found[2] == pytest.approx([0], abs=1e-6)
    assert sorted(found) == [1, 2]
    assert "q3 = 0," in wall_between(region, a, b)
    assert wall_between(region, a, c) == ""


def test_a_path_may_have_to_keep_the_limits():
    """From q1 = 3 to −3 the way is short through π, and long where the limits are ±3.1."""
    robot = r1.robot_from_dh([R(0.4, 0, 0), R(0.3, 0, 0)], lower=[-3.1, -3.1], upper=[3.1, 3.1])
    ends = [3.0, 1.0], [-3.0, 1.0]
    free, kept = (posture_change(robot, XY, *ends, within_limits=limits).require().path for limits in (False, True))
    assert np.ptp(free[:, 0]) == pytest.approx(2 * pi - 6)
    assert np.ptp(kept[:, 0]) == pytest.approx(6)
    assert all(map(robot.within_limits, kept))


def test_a_path_of_an_arm_with_a_follower_is_by_measured_slopes():
    robot = r1.load_robot(MIMIC)
    assert robot.nq == 2
    change = posture_change(robot, XY, [0.1, 0.5], [0.9, 0.7])
    assert (change.status, change.proven) == (Change.FOUND, False)
    assert posture_change(robot, XY, [0.1, 0.5], [0.9, -0.7]).status is Change.IMPOSSIBLE


LINK = '<link name="{}"/>'
MIMIC = f"""<robot name="follower">{"".join(map(LINK.format, "abcd"))}<link name="tool"/>
<joint name="q1" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
<joint name="q2" type="revolute"><parent link="b"/><child link="c"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1.5" upper="1.5" effort="1" velocity="1"/></joint>
<joint name="q3" type="revolute"><parent link="c"/><child link="d"/><origin xyz="0.4 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1.5" upper="1.5" effort="1" velocity="1"/><mimic joint="q2" multiplier="0.5"/></joint>
<joint name="end" type="fixed"><parent link="d"/><child link="tool"/><origin xyz="0.3 0 0"/></joint></robot>"""


def test_what_is_singular_outside_the_limits_or_redundant_is_refused_by_a_sentence():
    robot = r1.robot_from_dh([R(0.4, 0, 0), R(0.3, 0, 0)], lower=[-2, -2], upper=[2, 2])
    with pytest.raises(r1.InputError, match="q_b is singular"):
        posture_change(robot, XY, [0, 1], [0, 0])
    with pytest.raises(r1.InputError, match="q_a is outside the joint limits"):
        posture_change(robot, XY, [3, 1], [0, 1], within_limits=True)
    with pytest.raises(r1.TaskError, match="2 joints and 1 row of the task"):
        posture_change(robot, r1.PositionTask("x"), [0, 1], [0, 1])
    with pytest.raises(r1.InputError, match="what ik_solutions returns"):
        group_by_aspect([[0, 1]])
