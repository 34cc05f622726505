"""Questions of examinations of 2009 to 2013 on inverse kinematics in closed form, answered with the public API."""

from math import pi, sqrt, tan

import numpy as np
import pytest
import sympy
from formula_values import real, same
from sympy import cos, sin

import robotics1 as r1
from robotics1.ik import IKStatus, ik_formulas

H = pi / 2
XY, XYZ = r1.PositionTask("xy"), r1.PositionTask()


def chain(name, *joints, tip="0 0 0"):
    """A robot of (name, kind, axis, origin); joints without limits turn, and slide between −20 and 20 m."""
    links = [f"link{i}" for i in range(len(joints) + 1)]
    text = "".join(f'<link name="{link}"/>' for link in [*links, "tip"])
    for i, (joint, kind, axis, origin) in enumerate(joints):
        limit = '<limit lower="-20" upper="20" effort="1" velocity="1"/>' if kind == "prismatic" else ""
        text += f'<joint name="{joint}" type="{kind}"><parent link="{links[i]}"/><child link="{links[i + 1]}"/>'
        text += f'<origin xyz="{origin}"/><axis xyz="{axis}"/>{limit}</joint>'
    text += (
        f'<joint name="end" type="fixed"><parent link="{links[-1]}"/><child link="tip"/><origin xyz="{tip}"/></joint>'
    )
    return r1.load_robot(f'<robot name="{name}">{text}</robot>')


TURN = "continuous"
# Ry(α) Rx(β) n = z says that n is the tip of a rod along z behind the turns −β about x and −α about y
POINTER = chain("pointer", ("beta", TURN, "-1 0 0", "0 0 0"), ("alpha", TURN, "0 -1 0", "0 0 0"), tip="0 0 1")


PLATE = chain(
    "plate", ("q1", "prismatic", "0 0 1", "0.75 0 0"), ("a", TURN, "0 1 0", "0 0 0"), ("b", TURN, "1 0 0", "0 0 0")
)
GANTRY = chain(
    "gantry", *((f"q{i + 4}", "prismatic", axis, "0 0 0") for i, axis in enumerate(("1 0 0", "0 1 0", "0 0 1")))
)
OFFSET_RP = r1.robot_from_dh(
    [("R", "l", -H, 0, 0), ("P", 0, 0, 0, 0)], parameters={"l": 0.5}, lower=[None, -9], upper=[None, 9]
)


def are(found, expected, tolerance=1e-3):
    """Whether these are the solutions, in any order and modulo whole turns."""
    assert len(found) == len(expected)
    for q in np.asarray(expected):
        assert np.abs(np.exp(1j * np.asarray(found)) - np.exp(1j * q)).max(axis=1).min() < tolerance


def test_two_angles_turn_a_body_fixed_normal_upward():
    """5 July 2012, 1: α = atan2(−n_x, ±√(1 − n_x²)), β = atan2(±n_y, ±n_z), and β is free where n_y = n_z = 0."""
    found = ik_formulas(POINTER, XYZ)
    n = np.array([0.3, -0.4, sqrt(0.75)])
    signs = (1, -1)
    alpha = [np.arctan2(-n[0], s * np.hypot(n[1], n[2])) for s in signs]
    beta = [np.arctan2(s * n[1], s * n[2]) for s in signs]
    are(found.at(n), np.column_stack([beta, alpha]), 1e-12)
    (free,) = (case for case in found.singular_if if case.is_free)
    assert free.joint == "beta"
    assert [bool(free.condition.subs(found.target[0], x)) for x in (1, -1, 0.5)] == [True, True, False]


def test_the_tool_axes_follow_a_point_of_a_tilted_plate():
    """5 July 2012, 3: the plate's frame Ry(α) Rx(β) at (d, 0, q1) takes p to the three Cartesian axes."""
    f = r1.formulas(PLATE, XYZ, point=["px", "py", "pz"])
    q1, a, b, px, py, pz = (*f.q, *real("px py pz"))
    depth = py * sin(b) + pz * cos(b)
    expected = [0.75 + px * cos(a) + sin(a) * depth, py * cos(b) - pz * sin(b), q1 - px * sin(a) + cos(a) * depth]
    assert all(map(same, f.value, expected))


def test_a_riveting_task_has_one_feasible_solution():
    """5 July 2012, 4: with H = 5, D = 10, d = 0.75 the plate points up in two ways, one with a tilt below 90°."""
    n = np.array([0.5, 0.8138, -0.2962]) / np.linalg.norm([0.5, 0.8138, -0.2962])
    are(r1.ik_solutions(POINTER, XYZ, n).q, [[1.9199, -0.5236], [-1.2217, -2.618]])
    ((beta, alpha),) = r1.ik_solutions(POINTER, XYZ, n, box={"alpha": (-H, H)}).q
    lift = (10 - 2 * 0.75) / 2 * tan(alpha)
    point = r1.forward_kinematics(PLATE, [2.5 + lift, alpha, beta]).act(np.array([5.5, -0.3, -0.2]))
    (tool,) = r1.ik_solutions(GANTRY, XYZ, point).q
    found = [2.5 + lift, 2.5 - lift, beta, *tool]
    assert found == pytest.approx([0.0463, 4.9537, 1.9199, 5.6199, 0.2905, 2.6114], abs=1e-3)


def test_a_3r_arm_has_four_solutions_with_their_elbows():
    """25 February 2011: d1 = 0.5, a2 = 1.5, a3 = 1; the official solutions are those in front, rounded."""
    arm = r1.robot_from_dh([("R", 0, H, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1, 0, 0, 0)])
    first, second = (r1.ik_solutions(arm, XYZ, p) for p in ([0, 1.0607, 2.5607], [1.5309, 1.5309, 0.25]))
    are(first.q, [[H, 0.78544, 0.78528], [H, 1.40544, -0.78528], [-H, 1.73616, 0.78528], [-H, 2.35616, -0.78528]])
    front = {names[1]: q for q, names in zip(second.q, second.labels, strict=True) if names[0] == "shoulder right"}
    assert front["elbow down"] == pytest.approx([pi / 4, -pi / 6, pi / 3], abs=1e-3)
    assert front["elbow up"] == pytest.approx([pi / 4, 0.2937, -pi / 3], abs=1e-3)
    assert (len(first), len(second), second.complete) == (4, 4, True)


@pytest.mark.parametrize(
    ("p", "expected"),
    [([-0.3, 0], [[-2.1598, -2.6193], [2.1598, 2.6193]]), ([0, 1], [[1.9606, -0.8632], [1.181, 0.8632]])],
)
def test_a_2r_arm_has_two_solutions(p, expected):
    """11 February 2010, a: l1 = 0.6, l2 = 0.5, which reach from 0.1 to 1.1."""
    arm = r1.load_robot("planar_2r", parameters={"l1": 0.6, "l2": 0.5})
    are(r1.ik_solutions(arm, XY, p).q, expected)
    assert [r1.ik_solutions(arm, XY, [r, 0]).status.name for r in (0.09, 0.1, 1.1, 1.11)] == [
        *("UNREACHABLE", "BOUNDARY", "BOUNDARY", "UNREACHABLE")
    ]


def test_a_camera_orientation_is_reached_by_infinitely_many_pairs():
    """10 November 2009, 2c: at q2 = 0 only q1 + q3 counts, which must be π for the given orientation."""
    wrist = r1.robot_from_dh([("R", 0, -H, 0, 0), ("R", 0, H, 0.25, 0), ("R", 0, H, 0, 0)])
    base = np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    found = r1.ik_solutions(wrist, r1.OrientationTask(), base.T @ [[0, 1, 0], [-1, 0, 0], [0, 0, 1.0]])
    assert (found.status, found.dimension) == (IKStatus.INFINITE, 1)
    assert found.q[:, 1] == pytest.approx(np.zeros(len(found)), abs=1e-9)
    assert np.cos(found.q[:, 0] + found.q[:, 2]) == pytest.approx(-np.ones(len(found)))
    assert np.ptp(found.q[:, 0]) > 5  # all around


def test_an_rp_arm_with_an_offset_has_two_solutions_one_or_none():
    """10 July 2009, 1a: q2 = ±√(x² + y² − l²), q1 = atan2(l y − q2 x, l x + q2 y)."""
    found = ik_formulas(OFFSET_RP, XY)
    x, y, offset = (*found.target, sympy.Symbol("l", real=True))
    root = sympy.sqrt(x**2 + y**2 - offset**2)
    at = {x: 0.6, y: 0.7, offset: 0.5}
    values = sorted(float((branch.q["q2"] / root).subs(at)) for branch in found.branches)
    assert values == pytest.approx([-1, 1])
    are(found.at([0.6, 0.7]), [[-0.135423, 0.774597], [1.859763, -0.774597]], 1e-6)
    assert [len(r1.ik_solutions(OFFSET_RP, XY, [r, 0])) for r in (0.6, 0.5, 0.4)] == [2, 1, 0]
    assert [bool(found.branches[0].exists_if.subs({**at, x: r, y: 0})) for r in (0.6, 0.5, 0.4)] == [True, True, False]
