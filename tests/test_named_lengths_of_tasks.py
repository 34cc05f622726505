"""A function of the user's own with named lengths and with rows that are angles."""

import numpy as np
import pytest
import sympy
from arms import arm
from public_objects import to_the_right

import robotics1 as r1

TWO_R = arm("planar_2r")
Q = np.array([0.4, 0.9])
d, l1, l2, q1, q2 = sympy.symbols("d l1 l2 q1 q2", real=True)


def from_a_post(p, R, q, d):
    """Distance from (d, 0), squared, and the direction in which it is seen from there."""
    return [(p[0] - d) ** 2 + p[1] ** 2, np.arctan2(p[1], p[0] - d)]


def task(value=0.3):
    return r1.FunctionTask(from_a_post, 2, units=("1", "rad"), parameters={"d": value})


def test_numbers_have_the_value_of_the_name():
    x, y = r1.forward_kinematics(TWO_R, Q).translation[:2]
    assert task().value(TWO_R, Q) == pytest.approx([(x - 0.3) ** 2 + y**2, np.arctan2(y, x - 0.3)])
    assert task(0.7).value(TWO_R, Q) == pytest.approx([(x - 0.7) ** 2 + y**2, np.arctan2(y, x - 0.7)])
    assert task().with_parameters({"d": 0.7, "other": 3}) == task(0.7)


def test_formulas_keep_the_name():
    found = r1.formulas(TWO_R, task())
    x = l1 * sympy.cos(q1) + l2 * sympy.cos(q1 + q2) - d
    y = l1 * sympy.sin(q1) + l2 * sympy.sin(q1 + q2)
    assert sympy.simplify(found.value[0] - (x**2 + y**2)) == 0
    assert found.value[1] == sympy.atan2(sympy.expand(y), x)
    assert sympy.simplify(found.jacobian - sympy.Matrix([x**2 + y**2, sympy.atan2(y, x)]).jacobian([q1, q2])) == (
        sympy.zeros(2, 2)
    )
    assert found.unvalued == ()
    namespace = {}
    exec(found.python("value"), namespace)
    assert namespace["value"](Q) == pytest.approx(task().value(TWO_R, Q))
    assert namespace["value"](Q, d=0.7) == pytest.approx(task(0.7).value(TWO_R, Q))


def test_a_name_of_the_robot_is_the_same_length():
    ratio = r1.FunctionTask(lambda p, R, q, l2: [p[0] / l2], 1, parameters={"l2": TWO_R.parameters["l2"]})
    wanted = (l1 * sympy.cos(q1) + l2 * sympy.cos(q1 + q2)) / l2
    assert sympy.simplify(r1.formulas(TWO_R, ratio).value[0] - wanted) == 0
    other = ratio.with_parameters({"l2": 5.0})
    for call in (lambda: other.value(TWO_R, Q), lambda: r1.formulas(TWO_R, other)):
        with pytest.raises(r1.TaskError, match="'l2' of the task is 5, and that of robot"):
            call()


def test_a_stack_of_one_keeps_its_names():
    alone = r1.StackedTask([task()])
    assert r1.formulas(TWO_R, alone).value == r1.formulas(TWO_R, task()).value
    assert alone.with_parameters({"d": 0.7}).tasks == (task(0.7),)


def test_an_angle_is_taken_modulo_whole_turns_in_errors_and_in_inverse_kinematics():
    r = task().value(TWO_R, Q)
    for turns in (-1, 0, 3):
        target = [r[0], r[1] + 2 * np.pi * turns]
        assert task().error(TWO_R, Q, target) == pytest.approx([0, 0], abs=1e-9)
        found = r1.ik_solutions(TWO_R, task(), target)
        assert len(found) == 2
        assert np.abs(np.angle(np.exp(1j * (found.q - Q)))).max(axis=1).min() < 1e-7
        assert r1.solve_ik(TWO_R, task(), target, [0.1, 0.2]).converged
        assert r1.iterate_ik(TWO_R, task(), target, Q + 0.05, tolerance=1e-10).converged


def test_the_derivative_takes_the_names_too():
    at = {"d": 0.2}
    known = r1.FunctionTask(to_the_right, 1, lambda p, R, q, d: [[-p[1], d]], parameters=at)
    y = r1.forward_kinematics(TWO_R, Q).translation[1]
    assert known.jacobian(TWO_R, Q) == pytest.approx(np.array([[-y, 0.2]]))


@pytest.mark.parametrize(
    "parameters",
    [{"q1": 1.0}, {"p": 1.0}, {"two words": 1.0}, {"lambda": 1.0}, {"d": "x"}, {"d": np.inf}, ["d"], {1: 2}],
)
def test_what_are_no_named_lengths_is_refused(parameters):
    with pytest.raises(r1.InputError, match=r"named length|parameter|a name"):
        r1.FunctionTask(from_a_post, 2, parameters=parameters)


def test_a_function_that_does_not_take_the_name_is_said():
    without = r1.FunctionTask(lambda p, R, q: [p[0]], 1, parameters={"d": 0.1})
    with pytest.raises(r1.TaskError, match="unexpected keyword argument 'd'"):
        without.value(TWO_R, Q)
    with pytest.raises(r1.FormulaError, match="unexpected keyword argument 'd'"):
        r1.formulas(TWO_R, without)
