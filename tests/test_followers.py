"""Joints that mimic others anywhere in the tree, against a product of matrices, and the limits that they keep."""

from math import inf, pi

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st
from joint_kinds import MOVING, mimic, own_pose, urdf, values_of

import robotics1 as r1

FACTORS = st.sampled_from([1.0, -1.0, 0.5, -2.0, 0.25])
OFFSETS = st.sampled_from([0.0, 0.3, -0.1])


@st.composite
def trees(draw):
    """A tree of joints, some of which mimic any other, above, below or beside it, but none itself through others."""
    count = draw(st.integers(2, 8))
    names = draw(st.permutations([f"j{i}" for i in range(count)]))
    parents = ["base"] + [draw(st.sampled_from(["base", *names[:i]])) for i in range(1, count)]
    kinds = [draw(st.sampled_from(MOVING)) for _ in names]
    rank = draw(st.permutations(range(count)))  # a joint mimics one of a lower rank, so that nothing goes round
    joints = []
    for i, name in enumerate(names):
        lower = [names[k] for k in range(count) if rank[k] < rank[i]]
        follows = lower and draw(st.booleans())
        inside = [mimic(draw(st.sampled_from(lower)), draw(FACTORS), draw(OFFSETS))] if follows else []
        joints.append((name, kinds[i], parents[i], *inside))
    return urdf(*joints)


def load(text, **options):
    return r1.load_robot(text, **options)


def somewhere(robot, seed=0):
    return np.random.default_rng(seed).uniform(-1.4, 1.4, robot.nq)


@given(trees())
def test_a_pose_is_the_product_of_origins_and_motions_wherever_the_leaders_are(text):
    robot = load(text)
    free = [name for name in robot.joint_names if f'name="{name}"' in text]
    assert len(free) == len(set(robot.joint_names)) == robot.nq == text.count("<joint") - text.count("<mimic")
    q = somewhere(robot)
    values = dict(zip(robot.joint_names, q, strict=True))
    for link in robot.frame_names:
        T = r1.forward_kinematics(robot, q, frame=link).homogeneous
        assert T == pytest.approx(own_pose(text, link, values), abs=1e-12)


@given(trees())
def test_a_jacobian_is_the_difference_quotient_wherever_the_leaders_are(text):
    robot = load(text)
    q, h = somewhere(robot, 1), 1e-6
    for link in robot.frame_names[1:]:
        J = r1.frame_jacobian(robot, q, frame=link)
        R = r1.forward_kinematics(robot, q, frame=link).rotation
        for column, d in zip(J.T, np.eye(robot.nv), strict=True):
            ahead, back = (r1.forward_kinematics(robot, q + s * h * d, frame=link) for s in (1, -1))
            assert column[:3] == pytest.approx((ahead.translation - back.translation) / (2 * h), abs=1e-8)
            turn = pin.log3(ahead.rotation @ R.T) - pin.log3(back.rotation @ R.T)
            assert column[3:] == pytest.approx(turn / (2 * h), abs=1e-8)


ABOVE = urdf(
    ("lift", "prismatic", "base", mimic("elbow", 0.5, 0.1)),
    ("shoulder", "revolute", "lift"),
    ("elbow", "revolute", "shoulder"),
    ("tool", "fixed", "elbow"),
)


def test_a_follower_nearer_the_root_than_its_leader_loads_and_q_begins_with_that_leader():
    robot = load(ABOVE)
    assert robot.joint_names == ("elbow", "shoulder")
    assert robot.frame_names == ("base", "lift", "shoulder", "elbow", "tool")
    T = r1.forward_kinematics(robot, [0.7, -0.4]).homogeneous
    assert T == pytest.approx(own_pose(ABOVE, "tool", {"elbow": 0.7, "shoulder": -0.4}), abs=1e-14)


def test_an_independent_parser_agrees_on_a_follower_above_its_leader(tmp_path):
    import yourdfpy

    (tmp_path / "arm.urdf").write_text(ABOVE, encoding="utf-8")
    other = yourdfpy.URDF.load(str(tmp_path / "arm.urdf"), load_meshes=False, load_collision_meshes=False)
    robot = load(ABOVE)
    q = somewhere(robot)
    other.update_cfg(dict(zip(robot.joint_names, q, strict=True)))
    for link in robot.frame_names:
        T = r1.forward_kinematics(robot, q, frame=link).homogeneous
        assert T == pytest.approx(other.get_transform(link, "base"), abs=1e-13)


def test_the_frame_of_a_leader_below_its_follower_stands_where_that_joint_is():
    robot = load(ABOVE)
    q = [0.7, -0.4]
    joint, link = (r1.forward_kinematics(robot, q, frame=frame) for frame in ("elbow", "tool"))
    origin = own_pose(ABOVE, "elbow", {"elbow": 0.7, "shoulder": -0.4})
    assert joint.homogeneous == pytest.approx(origin, abs=1e-14)
    assert link != joint


def test_branches_that_follow_each_other_load():
    text = urdf(
        ("a", "revolute", "base", mimic("d", -1, 0.2)),
        ("b", "revolute", "a"),
        ("c", "revolute", "base", mimic("b", 2)),
        ("d", "prismatic", "c"),
    )
    robot = load(text)
    q = somewhere(robot)
    for link in "abcd":
        T = r1.forward_kinematics(robot, q, frame=link).homogeneous
        assert T == pytest.approx(own_pose(text, link, values_of(robot, q)), abs=1e-13)


def test_inverse_kinematics_of_a_follower_above_its_leader_reaches_what_forward_kinematics_gives():
    robot = load(ABOVE)
    task = r1.PositionTask("xy")
    target = task.value(robot, [0.3, 0.4])
    result = r1.solve_ik(robot, task, target)
    assert result.converged
    assert task.value(robot, result.q) == pytest.approx(target, abs=1e-7)


def test_a_chain_of_followers_beyond_what_can_be_computed_is_refused():
    joints = [
        ("j0", "revolute", "base"),
        *((f"j{i}", "revolute", f"j{i - 1}", mimic(f"j{i - 1}", 1e17)) for i in (1, 2)),
    ]
    with pytest.raises(
        r1.RobotFileError, match=r"joint 'j2' follows through others by a factor or offset beyond 1e\+18"
    ):
        load(urdf(*joints))


# --- the limits that followers have


def limit(lower, upper, velocity=3.0):
    return f'<limit lower="{lower}" upper="{upper}" velocity="{velocity}" effort="4"/>'


def pair(own, follower, factor=1.0, offset=0.0, kind="revolute"):
    """Two joints in a row, of which the second mimics the first."""
    return urdf(
        ("a", kind, "base", own), ("b", kind, "a", follower, mimic("a", factor, offset)), ("tool", "fixed", "b")
    )


@pytest.mark.parametrize(
    ("factor", "offset", "limits"),
    [(1, 0, (-0.5, 0.5)), (2, 0, (-0.25, 0.25)), (-2, 0.1, (-0.2, 0.3)), (0.1, 0, (-2, 2)), (-1, 2, (1.5, 2))],
)
def test_a_leader_keeps_inside_the_limits_of_its_follower(factor, offset, limits):
    robot = load(pair(limit(-2, 2), limit(-0.5, 0.5), factor, offset))
    assert (robot.lower[0], robot.upper[0]) == pytest.approx(limits, abs=1e-15)
    assert not [warning for warning in robot.warnings if "limits" in warning]


def test_inverse_kinematics_keeps_the_limits_of_a_follower():
    robot = load(pair(limit(-2, 2), limit(-0.5, 0.5)))
    task = r1.PositionTask("xy")
    inside, outside = (r1.solve_ik(robot, task, task.value(robot, [q])) for q in (0.4, pi / 2))
    assert inside.converged
    assert inside.q == pytest.approx([0.4], abs=1e-6)
    assert not outside.converged


@given(st.lists(st.tuples(FACTORS, OFFSETS, st.floats(-3, 3), st.floats(0.01, 4)), min_size=1, max_size=4))
def test_inside_the_limits_every_follower_is_inside_its_own_or_a_warning_says_whose_are_not_kept(followers):
    joints = [("a", "revolute", "base", limit(-2, 1.5))]
    for i, (factor, offset, lower, width) in enumerate(followers):
        joints.append((f"f{i}", "revolute", "a", limit(lower, lower + width), mimic("a", factor, offset)))
    robot = load(urdf(*joints))
    ends = robot.lower[0], robot.upper[0]
    assert -2 <= ends[0] < ends[1] <= 1.5
    for i, (factor, offset, lower, width) in enumerate(followers):
        kept = all(lower - 1e-12 <= factor * q + offset <= lower + width + 1e-12 for q in ends)
        assert kept or any(f"f{i}" in warning and "limits" in warning for warning in robot.warnings)


@pytest.mark.parametrize(
    ("follower", "factor", "offset"),
    [(limit(0, 0), 1, 0), (limit(3, 4), 1, 0), (limit(0, 2), -1, -2), (limit(-1, 1), 0, 5), (limit(2, 5), 1, 0)],
    ids=["no motion", "beyond", "the wrong sign", "a factor of zero", "one point"],
)
def test_limits_of_a_follower_that_contradict_its_leaders_are_warned_of_and_not_kept(follower, factor, offset):
    robot = load(pair(limit(-2, 2), follower, factor, offset))
    assert (robot.lower[0], robot.upper[0]) == (-2, 2)
    (warning,) = [warning for warning in robot.warnings if "limits" in warning]
    assert "the limits of 'b' are not kept" in warning


def test_followers_whose_limits_exclude_each_other_are_warned_of():
    follow = mimic("a")
    robot = load(
        urdf(
            ("a", "revolute", "base", limit(-2, 2)),
            ("b", "revolute", "a", limit(-1, 0), follow),
            ("c", "revolute", "a", limit(0.5, 1), follow),
        )
    )
    assert (robot.lower[0], robot.upper[0]) == (-2, 2)
    assert "the limits of b, c, which mimic joint 'a', exclude each other" in robot.warnings[-1]


def test_a_continuous_follower_leaves_its_leaders_limits_alone_and_a_continuous_leader_takes_its_followers():
    free = urdf(("a", "revolute", "base", limit(-2, 2)), ("b", "continuous", "a", mimic("a", 3)))
    assert (load(free).lower[0], load(free).upper[0]) == (-2, 2)
    bound = urdf(("a", "continuous", "base"), ("b", "revolute", "a", limit(-1, 2), mimic("a", -2)))
    assert (load(bound).lower[0], load(bound).upper[0]) == (-1, 0.5)


def test_a_leader_that_cannot_move_stays_so_without_a_warning():
    robot = load(pair(limit(0, 0), limit(-1, 1)))
    assert (robot.lower[0], robot.upper[0]) == (0, 0)
    assert not [warning for warning in robot.warnings if "not kept" in warning]


def test_limits_of_a_chain_of_followers_are_those_of_all_of_them():
    text = urdf(
        ("a", "revolute", "base", limit(-2, 2)),
        ("b", "revolute", "a", limit(-1, 1), mimic("a", 2, 0.1)),
        ("c", "prismatic", "b", limit(-1, 1), mimic("b", -3)),
    )
    robot = load(text)  # b = 2 a + 0.1 in [−1, 1], c = −6 a − 0.3 in [−1, 1]
    assert (robot.lower[0], robot.upper[0]) == pytest.approx((-1.3 / 6, 0.7 / 6), abs=1e-15)


def test_a_leader_is_no_faster_than_its_follower_can_be():
    robot = load(pair(limit(-2, 2, velocity=3), limit(-9, 9, velocity=3), factor=-2))
    assert robot.max_velocity.tolist() == [1.5]
    robot = load(pair(limit(-2, 2, velocity=3), limit(-9, 9, velocity=0), factor=-2))
    assert robot.max_velocity.tolist() == [3]


def test_limits_of_a_leader_below_its_follower_are_kept_too():
    robot = load(ABOVE)  # lift = 0.5 elbow + 0.1 in [−1.5, 2], elbow in [−1.5, 2]
    assert (robot.lower.tolist(), robot.upper.tolist()) == ([-1.5, -1.5], [2, 2])
    robot = load(ABOVE.replace('multiplier="0.5"', 'multiplier="-4"'))
    assert (robot.lower[0], robot.upper[0]) == pytest.approx((-1.9 / 4, 1.6 / 4), abs=1e-15)
    assert robot.upper[1] == 2
    assert inf not in robot.max_velocity
