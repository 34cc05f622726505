"""Robots at rest: forces on any link, weights, wrenches without torque, largest forces."""

from math import cos, inf, pi, sin

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q

import robotics1 as r1
from robotics1.singularities import Load, Payload, largest_force, static_torques, wrenches_without_torque

XY = r1.PositionTask("xy")
TWO_R = r1.textbook_robots.planar_arm("RR", [1.2, 0.8])
ARMS = ["planar_2r", "prr", "six_r", "spatial", "redundant", "cylindrical"]


def test_a_force_at_the_tip_of_a_2r_needs_minus_j_transposed_f():
    q, f = [0.3, 0.9], np.array([4.0, -7.0])
    found = static_torques(TWO_R, q, Load([*f, 0]))
    assert found.torque == pytest.approx(r1.balancing_torque(XY.jacobian(TWO_R, q), f))
    J2 = np.array([[-1.2 * sin(0.3), 1.2 * cos(0.3)], [0, 0]])
    first = static_torques(TWO_R, q, Load([*f, 0], frame="link1", point=[1.2, 0, 0]))
    assert first.torque == pytest.approx(-J2 @ f)


def test_a_mass_off_the_axis_of_the_last_link_hangs_on_both_joints():
    q, m, g = [0.4, -0.7], 3.0, 9.81
    x = 1.2 * cos(0.4) + 0.8 * cos(-0.3)
    off = -0.2 * sin(-0.3)  # of a centre at (0, 0.2) from the tip
    found = static_torques(TWO_R, q, payloads=Payload(m, [0, 0.2, 0]), gravity=[0, -g, 0])
    assert found.torque == pytest.approx([m * g * (x + off), m * g * (0.8 * cos(-0.3) + off)])
    assert found.of_payloads[0] == pytest.approx(found.torque)
    assert static_torques(TWO_R, q, payloads=Payload(m)).torque == pytest.approx([0, 0])  # gravity along the axes


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("reference", ["world", "tool"])
def test_the_torques_do_the_work_of_the_loads(name, reference):
    robot, rng = arm(name), np.random.default_rng(5)
    q, h = random_q(robot, rng), 1e-6
    for frame in (robot.frame_names[1], robot.frame_names[-1]):
        c, f, m = rng.normal(size=(3, 3))
        found = static_torques(robot, q, Load(f, m, frame, c, reference), gravity=[0, 0, 0])
        R = np.eye(3) if reference == "world" else r1.forward_kinematics(robot, q).rotation
        for i in range(robot.nv):
            ahead, behind = (
                r1.forward_kinematics(robot, q + s * h * np.eye(robot.nv)[i], frame=frame) for s in (1, -1)
            )
            dp = (ahead.act(c) - behind.act(c)) / (2 * h)
            dphi = pin.log3(ahead.rotation @ behind.rotation.T) / (2 * h)
            assert -found.torque[i] == pytest.approx((R @ f) @ dp + (R @ m) @ dphi, abs=1e-7)


def heavy_text():
    """A slide, two turns and a joint that follows, with masses off their axes."""
    links, joints, last = '<link name="base"/>', "", "base"
    kinds = [("prismatic", "0 0 1", ""), ("revolute", "0 1 0", ""), ("revolute", "1 0 0", "")]
    for i, (kind, axis, leader) in enumerate([*kinds, ("revolute", "0 1 0", "j1")]):
        links += (
            f'<link name="l{i}"><inertial><origin xyz="0.1 {0.05 * i} 0.2"/><mass value="{i + 1}"/>'
            '<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
        )
        mimic = f'<mimic joint="{leader}" multiplier="-0.5" offset="0.1"/>' if leader else ""
        joints += (
            f'<joint name="j{i}" type="{kind}"><parent link="{last}"/><child link="l{i}"/><axis xyz="{axis}"/>'
            f'<origin xyz="0.2 0 0.3"/><limit lower="-3" upper="3" velocity="1" effort="100"/>{mimic}</joint>'
        )
        last = f"l{i}"
    return f'<robot name="heavy">{links}{joints}</robot>'


def test_the_weight_of_the_links_is_the_derivative_of_the_energy(tmp_path):
    file = tmp_path / "heavy.urdf"
    file.write_text(heavy_text())
    robot = r1.load_robot(file)
    q, g0, h = np.array([0.2, 0.5, -0.4]), np.array([1.0, -2.0, -9.0]), 1e-6

    def energy(x):
        poses = [r1.forward_kinematics(robot, x, frame=f"l{i}") for i in range(4)]
        return -sum((i + 1) * g0 @ T.act(np.array([0.1, 0.05 * i, 0.2])) for i, T in enumerate(poses))

    expected = [(energy(q + h * e) - energy(q - h * e)) / (2 * h) for e in np.eye(3)]
    found = static_torques(robot, q, gravity=g0)
    assert found.torque == pytest.approx(expected, abs=1e-6)
    carried = [Payload(i + 1, [0.1, 0.05 * i, 0.2], f"l{i}") for i in range(4)]
    twice = static_torques(robot, q, payloads=carried, gravity=g0)
    assert twice.of_payloads.sum(axis=0) == pytest.approx(found.of_links, abs=1e-9)
    assert twice.torque == pytest.approx(2 * found.torque, abs=1e-9)


def test_limits_that_are_passed_are_said(tmp_path):
    file = tmp_path / "heavy.urdf"
    file.write_text(heavy_text())
    robot = r1.load_robot(file)
    found = static_torques(robot, [0, 0, 0], payloads=Payload(100, frame="l3"))
    assert not found.within_limits[0]
    assert "j0 needs" in found.explain()
    assert "its limit 100" in found.explain()


# --- wrenches without torque


@pytest.mark.parametrize("name", ARMS)
def test_wrenches_without_torque_are_those_that_j_transposed_kills(name):
    robot, rng = arm(name), np.random.default_rng(2)
    q, c = random_q(robot, rng), rng.normal(size=3)
    found = wrenches_without_torque(robot, q, point=c, reference="tool")
    J = r1.frame_jacobian(robot, q)
    assert found.wrenches.shape[1] == 6 - np.linalg.matrix_rank(J, tol=1e-9)
    for w in found.wrenches.T:
        held = static_torques(robot, q, Load(w[:3], w[3:], point=c, reference="tool"), gravity=[0, 0, 0])
        assert held.torque == pytest.approx(np.zeros(robot.nv), abs=1e-12)


def test_a_stretched_2r_holds_a_push_along_itself_without_torque():
    found = wrenches_without_torque(TWO_R, [0, 0])  # all but f_y and m_z, which need τ = (2, 0.8) f_y + (1, 1) m_z
    assert found.wrenches[[1, 5]] == pytest.approx(np.zeros((2, 4)), abs=1e-12)
    assert found.status is r1.singularities.RankStatus.FULL_RANK
    bent = wrenches_without_torque(TWO_R, [0, pi / 2])  # a force through both axes
    w = np.array([1, 0, 0, 0, 0, 0.8])
    assert bent.wrenches @ (bent.wrenches.T @ w) == pytest.approx(w)
    assert "no torque is needed" in bent.explain()


def test_a_6r_at_printed_digits_of_a_singularity_has_a_wrench_more_there():
    rows = [("R", 0, pi / 2, 0.0892, 0), ("R", -0.425, 0, 0, 0), ("R", -0.392, 0, 0, 0)]
    ur5 = r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0.109, 0), ("R", 0, -pi / 2, 0.095, 0), ("R", 0, 0, 0.082, 0)])
    found = wrenches_without_torque(ur5, [0.3, -1.2, 0.8, 0.4, 3.1416, 0.2])
    assert found.status is r1.singularities.RankStatus.NEARLY_SINGULAR
    assert (found.wrenches.shape, found.at_singularity.shape) == ((6, 0), (6, 1))
    assert "q5 = 3.1416" in found.explain()
    J = r1.frame_jacobian(ur5, [0.3, -1.2, 0.8, 0.4, pi, 0.2])
    assert J.T @ found.at_singularity == pytest.approx(np.zeros((6, 1)), abs=1e-8)


# --- largest force


def test_the_largest_force_of_a_2r_along_y_is_that_of_the_joint_that_gives_up_first():
    q = [0, pi / 2]  # J = [[−0.8, −0.8], [1.2, 0]]
    found = largest_force(TWO_R, XY, q, [0, -2], torque=[6, 1])
    assert (found.magnitude, found.joints) == (pytest.approx(5), ("q1",))
    assert found.torque == pytest.approx([-6, 0])
    assert found.force == pytest.approx([0, -5])
    assert largest_force(TWO_R, XY, q, [1, 0], torque=[6, 1]).magnitude == pytest.approx(1 / 0.8)
    both = largest_force(TWO_R, XY, q, [1, 0], torque=2)
    assert both.joints == ("q1", "q2")
    held = largest_force(TWO_R, XY, q, [0, 1], torque=[6, 1], held=[-3, 0.5])
    assert held.magnitude == pytest.approx(9 / 1.2)
    assert "bounded by q1" in held.explain()


def test_a_force_along_a_stretched_arm_has_no_bound():
    found = largest_force(TWO_R, XY, [0.3, 0], [cos(0.3), sin(0.3)], torque=1)
    assert (found.magnitude, found.joints) == (inf, ())
    assert "no bound" in found.explain()
    near = largest_force(TWO_R, XY, [0.3, 3.1416], [cos(0.3), sin(0.3)], torque=1)
    assert near.status is r1.singularities.RankStatus.NEARLY_SINGULAR
    assert "q2 = 3.1416" in near.explain()


@pytest.mark.parametrize("seed", range(4))
def test_the_largest_force_is_the_radius_of_the_force_polytope(seed):
    rng = np.random.default_rng(seed)
    robot, task = arm("spatial"), r1.PositionTask()
    q, u, T = random_q(robot, rng), rng.normal(size=3), rng.uniform(1, 3, robot.nv)
    polytope = r1.singularities.force_polytope(robot, task, q, torque=T)
    assert largest_force(robot, task, q, u, torque=T).magnitude == pytest.approx(polytope.radius(u), rel=1e-8)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: Load([1, 2]), "force must have shape"),
        (lambda: Payload(-1), "mass must be a non-negative"),
        (lambda: static_torques(TWO_R, [0, 0], [1, 2, 3]), "loads must be Load"),
        (lambda: static_torques(TWO_R, [0, 0], payloads=Load()), "payloads must be Payload"),
        (lambda: static_torques(TWO_R, [0, 0], gravity=9.81), "gravity must have shape"),
        (lambda: largest_force(TWO_R, XY, [0, 0], [1, 0]), "no joint has a bound"),
        (lambda: largest_force(TWO_R, XY, [0, 0], [0, 0], torque=1), "direction"),
        (lambda: largest_force(TWO_R, XY, [0, 0], [1, 0], torque=1, held=[2, 0]), "beyond the bound of q1"),
    ],
)
def test_what_is_no_load_is_refused(call, words):
    with pytest.raises(r1.InputError, match=words):
        call()


def test_an_unknown_link_is_refused():
    with pytest.raises(r1.UnknownNameError, match="did you mean 'link1'"):
        static_torques(TWO_R, [0, 0], Load([1, 0, 0], frame="lnk1"))
