"""Polar and cylindrical coordinates of a frame's position."""

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
import sympy
from arms import arm, configurations, random_q
from differences import derivative
from hypothesis import given

import robotics1 as r1
from robotics1.tasks import CylindricalTask, PolarTask

TWO_R, SIX_R, CYLINDRICAL = arm("planar_2r"), arm("six_r"), arm("cylindrical")
POLAR = PolarTask()


@given(configurations(TWO_R))
def test_polar_coordinates_of_a_2r_arm(q):
    l1, l2 = TWO_R.parameters["l1"], TWO_R.parameters["l2"]
    x, y = l1 * cos(q[0]) + l2 * cos(q[0] + q[1]), l1 * sin(q[0]) + l2 * sin(q[0] + q[1])
    assert POLAR.value(TWO_R, q) == pytest.approx([hypot(x, y), atan2(y, x)], abs=1e-12)
    rho = hypot(x, y)
    J = [[0, -l1 * l2 * sin(q[1]) / rho], [1, (l2**2 + l1 * l2 * cos(q[1])) / rho**2]]  # the law of cosines
    assert POLAR.jacobian(TWO_R, q) == pytest.approx(np.array(J), abs=1e-9)


@pytest.mark.parametrize("plane", ["xy", "yz", "zx", "yx", "zy", "xz"])
def test_cylindrical_jacobian_is_the_derivative_of_the_value(plane):
    task = CylindricalTask(plane, point=(0.1, -0.05, 0.2))
    for seed in range(3):
        q = random_q(SIX_R, seed)
        r = task.value(SIX_R, q)

        def value(x, r=r):
            return -task.error(SIX_R, x, r)  # so that the angle does not jump

        assert task.jacobian(SIX_R, q) == pytest.approx(derivative(value, q), abs=1e-7)
        p = r1.forward_kinematics(SIX_R, q, point=(0.1, -0.05, 0.2)).translation
        a, b = ("xyz".index(letter) for letter in plane)
        assert r == pytest.approx([hypot(p[a], p[b]), atan2(p[b], p[a]), p[3 - a - b]])
    assert task.row_names == ("ρ", "θ", next(iter(set("xyz") - set(plane))))
    assert task.row_units == ("m", "rad", "m")


def test_angles_of_the_error_are_wrapped():
    e = POLAR.error(TWO_R, [3.0, 0.0], [1.0, -3.0])
    assert e == pytest.approx([1.0 - sum(TWO_R.parameters.values()), 2 * pi - 6])


def test_a_cylindrical_arm_has_the_identity_as_jacobian_up_to_its_order():
    """An arm that turns, lifts and stretches has its own coordinates: (q1, q2, q3) = (θ, z, ρ) up to constants."""
    J = CylindricalTask().jacobian(CYLINDRICAL, [0.4, 0.3, 0.5])
    assert np.abs(J).sum(axis=0) == pytest.approx([1, 1, 1], abs=1e-12)
    assert np.abs(J).sum(axis=1) == pytest.approx([1, 1, 1], abs=1e-12)


def test_formulas_have_the_determinant_of_the_change_of_coordinates():
    """det J_polar = det J_xy / ρ."""
    q2, l1, l2 = sympy.symbols("q2 l1 l2", real=True)
    found = r1.formulas(TWO_R, POLAR)
    rho = sympy.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * sympy.cos(q2))
    assert sympy.simplify(found.determinant - l1 * l2 * sympy.sin(q2) / rho) == 0
    assert sympy.simplify(found.value[0] ** 2 - rho**2) == 0


def test_inverse_kinematics_finds_both_elbows_and_turns_of_the_target():
    lengths = TWO_R.parameters
    for turns in (0, 2 * pi):
        found = r1.ik_solutions(TWO_R, POLAR, [0.9, 0.5 + turns])
        assert len(found) == 2
        for q in found.q:
            assert POLAR.value(TWO_R, q) == pytest.approx([0.9, 0.5], abs=1e-9)
    c2 = (0.81 - lengths["l1"] ** 2 - lengths["l2"] ** 2) / (2 * lengths["l1"] * lengths["l2"])
    assert np.cos(found.q[:, 1]) == pytest.approx([c2, c2], abs=1e-9)
    assert r1.solve_ik(SIX_R, CylindricalTask(), CylindricalTask().value(SIX_R, random_q(SIX_R, 3))).converged


def test_on_the_axis_the_angle_has_no_rate():
    robot = r1.robot_from_dh([("P", 0, 0, 0, 0), ("R", 1.0, 0, 0, 0), ("R", 1.0, 0, 0, 0)])
    folded = [0.1, 0.3, pi]
    assert POLAR.value(robot, folded)[0] == pytest.approx(0, abs=1e-12)
    with pytest.raises(r1.TaskError, match="on the axis"):
        POLAR.jacobian(robot, folded)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: PolarTask("xx"), "plane must be one of"),
        (lambda: POLAR.error(TWO_R, [0, 0], [-1, 0]), "must not be negative"),
        (lambda: POLAR.error(TWO_R, [0, 0], [1, 0, 0]), r"\(ρ, θ\)"),
        (lambda: CylindricalTask(point=(1, 2)), r"point must have shape \(3,"),
    ],
)
def test_what_are_no_polar_coordinates_is_refused(call, words):
    with pytest.raises(r1.InputError, match=words):
        call()
