"""The largest and smallest reach of any arm, between a value that is attained and a bound that nothing exceeds."""

from math import cos, hypot, pi, sqrt
from time import process_time

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from mimic_arms import text_of, trees
from spatial_arms import drawn_arm
from sweeps import core_first

import robotics1 as r1
from robotics1.workspaces import extreme_reach

XY, XYZ = r1.PositionTask("xy"), r1.PositionTask()
MIMIC = """<robot name="scissors"><link name="base"/><link name="one"/><link name="two"/><link name="tool"/>
<joint name="q1" type="revolute"><parent link="base"/><child link="one"/><axis xyz="0 0 1"/>
<limit lower="-0.4" upper="1.1" velocity="1" effort="1"/></joint>
<joint name="q2" type="revolute"><parent link="one"/><child link="two"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<mimic joint="q1" multiplier="-2"/><limit lower="-9" upper="9" velocity="9" effort="1"/></joint>
<joint name="end" type="fixed"><parent link="two"/><child link="tool"/><origin xyz="1 0 0"/></joint></robot>"""


def links(*lengths, lower=None, upper=None):
    return r1.robot_from_dh([("R", a, 0, 0, 0) for a in lengths], lower=lower, upper=upper)


def assert_proven(found, value):
    assert found.value == pytest.approx(value, abs=1e-8)
    assert found.proven
    assert abs(found.bound - value) < 2e-6
    assert found.require() is found


@pytest.mark.parametrize("elbow", [(-2.0, -0.5), (0.3, 2.9), (-1.0, 2.0)])
def test_two_links_with_limits_reach_as_far_as_the_elbow_allows(elbow):
    """|p|² = l₁² + l₂² + 2 l₁ l₂ cos q₂."""
    arm = links(0.4, 0.3, lower=[-1, elbow[0]], upper=[1, elbow[1]])
    least, most = (0.0 if elbow[0] <= 0 <= elbow[1] else min(map(abs, elbow))), max(map(abs, elbow))
    for smallest, angle in ((False, least), (True, most)):
        found = extreme_reach(arm, XY, smallest=smallest)
        assert_proven(found, sqrt(0.16 + 0.09 + 0.24 * cos(angle)))
        assert np.linalg.norm(XY.value(arm, found.q)) == pytest.approx(found.value)


def test_two_links_reach_in_a_direction_up_to_a_limit():
    """x = 0.4 cos q₁ + 0.3 cos(q₁ + q₂) with q₁ ≥ 0.5 and q₂ ≥ 0.2: both at their limits."""
    arm = links(0.4, 0.3, lower=[0.5, 0.2], upper=[2, 1])
    assert_proven(extreme_reach(arm, XY, direction=[2, 0, 0]), 0.4 * cos(0.5) + 0.3 * cos(0.7))
    assert_proven(extreme_reach(arm, XY, direction=[2, 0, 0], smallest=True), 0.4 * cos(2) + 0.3 * cos(3))


def test_an_anthropomorphic_arm_from_any_point():
    """About the shoulder, 0.4 above the base, it fills a shell from 0.2 to 0.8."""
    arm = r1.robot_from_dh([("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.3, 0, 0, 0)])
    for point in ([0, 0, 0.4], [0, 0, 0], [0.3, -0.5, 1.0], [2, 1, 0]):
        far = np.linalg.norm(np.array(point) - [0, 0, 0.4])
        assert_proven(extreme_reach(arm, XYZ, origin=point), far + 0.8)
        assert_proven(extreme_reach(arm, XYZ, origin=point, smallest=True), max(far - 0.8, 0.2 - far, 0.0))
    assert_proven(extreme_reach(arm, XYZ, direction=[0, 3, 4]), 0.8 + 0.8 * 0.4)
    assert_proven(extreme_reach(arm, XY), 0.8)


def test_a_cylindrical_arm_reaches_to_the_corner_of_its_slides():
    arm = r1.robot_from_dh(
        [("R", 0, 0, 0, 0), ("P", 0, -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], lower=[-3, 0.2, 0.3], upper=[3, 0.7, 0.9]
    )
    assert_proven(extreme_reach(arm, XYZ), hypot(0.7, 0.9))
    assert_proven(extreme_reach(arm, XYZ, smallest=True), hypot(0.2, 0.3))


def test_a_joint_that_mimics_another_one_counts_with_it():
    """The elbow turns by −2 q₁, so that p = (2 cos q₁, 0)."""
    arm = r1.load_robot(MIMIC)
    assert_proven(extreme_reach(arm, XY), 2.0)
    assert_proven(extreme_reach(arm, XY, smallest=True), 2 * cos(1.1))
    assert_proven(extreme_reach(arm, XY, direction=[-1, 0, 0]), -2 * cos(1.1))


def test_the_reach_of_a_ur5_is_proven():
    """Four joints count: the first turns about the origin's axis, the last about the tool."""
    arm = r1.load_robot("ur5")
    found = extreme_reach(arm, XYZ, tolerance=1e-3, time_limit=60)
    assert found.proven
    assert found.boxes > 100
    drawn = np.random.default_rng(0).uniform(-pi, pi, (2000, 6))
    assert max(np.linalg.norm(XYZ.value(arm, q)) for q in drawn) < found.value


def test_the_reach_of_a_panda_is_that_of_its_shoulder_and_of_what_is_after_it():
    """Axes 1 to 3 meet 0.333 above the base: z = 0.333 + D, |p| = 0.333 + D, x = D with D = max |p − shoulder|."""
    arm = r1.load_robot("panda", tool="panda_link8")
    shoulder = {"origin": [0, 0, 0.333], "time_limit": 60}
    D = extreme_reach(arm, XYZ, **shoulder)
    for found, value in (
        (extreme_reach(arm, XYZ, direction=[0, 0, 1], time_limit=60), 0.333 + D.value),
        (extreme_reach(arm, XYZ, time_limit=60), 0.333 + D.value),
        (extreme_reach(arm, XYZ, direction=[1, 0, 0], smallest=True, time_limit=60), -D.value),
    ):
        assert_proven(found, value)
        assert found.bounded_by == "pivots"
        assert "triangle inequality" in found.explain()
    rng = np.random.default_rng(1)
    drawn = [XYZ.value(arm, q) for q in rng.uniform(arm.lower, arm.upper, (3000, arm.nq))]
    assert np.linalg.norm(np.array(drawn) - [0, 0, 0.333], axis=1).max() < D.value < D.bound < D.value + 2e-6


def test_the_reach_of_an_xarm7_is_that_of_its_shoulder_and_of_what_is_after_it():
    """Axes 1 to 3 meet 0.267 above the base, to 1e-6 m as the file's angles are rounded; elbow and wrist are bent."""
    arm = r1.load_robot("xarm7")
    D = extreme_reach(arm, XYZ, origin=[0, 0, 0.267], time_limit=60)
    found = extreme_reach(arm, XYZ, time_limit=60)
    assert found.proven
    assert D.proven
    assert found.value == pytest.approx(0.267 + D.value, abs=1e-6)
    assert found.bounded_by == "pivots"
    drawn = np.random.default_rng(2).uniform(np.maximum(arm.lower, -pi), np.minimum(arm.upper, pi), (3000, arm.nq))
    assert np.linalg.norm(r1.forward_kinematics(arm, drawn)[:, :3, 3], axis=1).max() < found.value


@pytest.mark.parametrize("smallest", [False, True])
@pytest.mark.parametrize("direction", [None, [0, 0, 1]])
def test_almost_no_time_is_enough_for_a_value_and_a_bound(direction, smallest):
    arm = r1.load_robot("ur5")
    found = extreme_reach(arm, XYZ, direction=direction, smallest=smallest, time_limit=1e-9)
    assert found.starts == 1
    assert np.allclose(XYZ.value(arm, found.q), found.point, atol=1e-12)
    drawn = r1.forward_kinematics(arm, np.random.default_rng(3).uniform(-pi, pi, (3000, 6)))[:, :3, 3]
    values = np.linalg.norm(drawn, axis=1) if direction is None else drawn[:, 2]
    assert (values >= found.bound).all() if smallest else (values <= found.bound).all()
    assert (found.bound <= found.value) if smallest else (found.value <= found.bound)


@pytest.mark.parametrize("wrist", [0.0, 0.05])
def test_a_tool_beyond_a_wrist_reaches_by_its_length_farther(wrist):
    """A shoulder 0.4 above the base, 0.5 and 0.3 to the wrist, a tool of 0.2: 0.5 + 0.3 + 0.2 from the shoulder."""
    rows = [("R", 0, pi / 2, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, 0.3, 0)]
    arm = r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0, 0), ("R", 0.2, 0, wrist, 0)])
    tool = hypot(0.2, wrist)
    assert_proven(extreme_reach(arm, XYZ, time_limit=60), 0.4 + 0.8 + tool)
    assert_proven(extreme_reach(arm, XYZ, direction=[0, 3, 4], time_limit=60), 0.8 + tool + 0.8 * 0.4)
    assert_proven(extreme_reach(arm, XYZ, origin=[3, 0, 0.4], smallest=True, time_limit=60), 3 - 0.8 - tool)


def test_a_search_that_is_cut_short_says_so_and_its_bound_holds():
    arm = r1.load_robot("panda", tool="panda_link8")
    found = extreme_reach(arm, XYZ, time_limit=0.05)
    assert not found.proven
    assert found.gap > 1e-6
    assert found.bound > found.value
    assert "not excluded" in found.explain()
    with pytest.raises(r1.NotConverged):
        found.require()


@pytest.mark.parametrize("seed", core_first(range(12), range(3), 2))
@pytest.mark.parametrize("smallest", [False, True])
def test_no_configuration_of_a_drawn_arm_is_beyond_the_bound(seed, smallest):
    arm = drawn_arm(seed)
    rng = np.random.default_rng(seed)
    q = rng.uniform(np.maximum(arm.lower, -pi), np.minimum(arm.upper, pi), (1000, arm.nq))
    point, n = rng.uniform(-1, 1, (2, 3))
    p = np.array([XYZ.value(arm, x) for x in q])
    for options, values in (
        ({"origin": point}, np.linalg.norm(p - point, axis=1)),
        ({"direction": n}, p @ n / np.linalg.norm(n)),
    ):
        found = extreme_reach(arm, XYZ, smallest=smallest, tolerance=1e-4, time_limit=30, **options)
        assert found.proven
        assert arm.within_limits(found.q, tolerance=1e-9)
        assert found.point == pytest.approx(XYZ.value(arm, found.q), abs=1e-9)
        if smallest:
            assert found.bound <= found.value <= values.min() + 1e-9
        else:
            assert found.bound >= found.value >= values.max() - 1e-9


@settings(max_examples=4)
@given(trees(least=2, most=4, chain=True), st.booleans())
def test_followers_of_every_form_are_bounded(tree, smallest):
    arm = r1.load_robot(text_of(tree), tool="tool")
    found = extreme_reach(arm, XYZ, smallest=smallest, time_limit=0.5)
    rng = np.random.default_rng(0)
    q = rng.uniform(np.maximum(arm.lower, -4 * pi), np.minimum(arm.upper, 4 * pi), (500, arm.nq))
    far = np.array([np.linalg.norm(XYZ.value(arm, x)) for x in q])
    assert found.value == pytest.approx(np.linalg.norm(XYZ.value(arm, found.q)), abs=1e-9)
    assert (far >= found.bound).all() if smallest else (far <= found.bound).all()


@pytest.mark.parametrize("wrong", [{"tolerance": 0}, {"tolerance": -1.0}, {"time_limit": 0}, {"time_limit": "long"}])
def test_options_of_another_form_are_refused(wrong):
    with pytest.raises(r1.InputError):
        extreme_reach(links(1, 1), XY, **wrong)


def test_a_slide_without_limits_needs_a_box():
    arm = r1.robot_from_dh([("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)])
    with pytest.raises(r1.InputError, match="box="):
        extreme_reach(arm, XY)
    assert extreme_reach(arm, XYZ, box={"q2": (0.2, 1.5)}).value == pytest.approx(1.5)


def test_a_slide_that_does_not_move_the_point_needs_no_limits():
    arm = r1.robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0), ("P", 0, 0, 0, 0)])
    assert_proven(extreme_reach(arm, r1.PositionTask("xy", frame="link2")), 0.9)


def test_a_joint_without_room_stays_where_it_is():
    arm = links(0.4, 0.3, 0.2, lower=[-1, 0.5, -2], upper=[1, 0.5, -1])
    assert_proven(extreme_reach(arm, XY), np.linalg.norm(XY.value(arm, [0, 0.5, -1])))
    assert extreme_reach(arm, XY).q[1] == 0.5


def test_a_search_whose_time_is_over_does_not_look_for_pivots():
    """Six axes that meet nowhere have many pivots, each with two searches of its own, whatever time was left."""
    h = pi / 2
    rows = [(0.2, h, 0.6), (0.9, 0.3, 0.1), (0.2, -h, 0.2), (0.1, h, 0.9), (0.1, -h, 0.1), (0.1, 0.2, 0.2)]
    arm = r1.robot_from_dh([("R", a, alpha, d, 0) for a, alpha, d in rows], lower=[-3] * 6, upper=[3] * 6)
    begin = process_time()
    found = extreme_reach(arm, XYZ, time_limit=0.01)
    assert process_time() - begin < 5
    q = np.random.default_rng(0).uniform(-3, 3, (2000, 6))
    assert np.linalg.norm(r1.forward_kinematics(arm, q)[:, :3, 3], axis=1).max() <= found.bound
    assert found.value <= found.bound
