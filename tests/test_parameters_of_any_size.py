"""Named lengths keep their names in formulas, whatever the unit of length, and short ones beside long ones."""

import numpy as np
import pytest
import sympy

from robotics1 import PositionTask, formulas, forward_kinematics, load_robot

ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="l1" default="{l1!r}"/><xacro:arg name="l2" default="{l2!r}"/>
  <link name="base"/><link name="a"/><link name="b"/><link name="tool"/>
  <joint name="q1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
    <origin xyz="0 0 {c!r}"/></joint>
  <joint name="q2" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
    <origin xyz="$(arg l1) 0 ${{$(arg l1)/2}}"/></joint>
  <joint name="t" type="fixed"><parent link="b"/><child link="tool"/>
    <origin xyz="$(arg l2) ${{2*$(arg l1)*$(arg l2)/{l2!r}}} ${{$(arg l2) - $(arg l1)*cos(pi/2)}}"/></joint>
</robot>"""


def arm(folder, l1, l2, c):
    path = folder / "arm.urdf.xacro"
    path.write_text(ARM.format(l1=l1, l2=l2, c=c))
    return load_robot(path)


@pytest.mark.parametrize(
    ("l1", "l2", "c"),
    [
        *((k, 0.7 * k, 0.3 * k) for k in (1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9)),
        (1.0, 1e-5, 1e3),
        (2e3, 1e-2, 0.0),
        (0.25, 0.25, 0.25),
    ],
)
def test_the_position_is_the_hand_formula_in_the_named_lengths(tmp_path, l1, l2, c):
    robot = arm(tmp_path, l1, l2, c)
    q1, q2 = sympy.symbols("q1 q2", real=True)
    a, b = sympy.symbols("l1 l2", real=True)
    found = formulas(robot, PositionTask())
    side = 2 * a * b / sympy.Float(l2)
    hand = [
        a * sympy.cos(q1) + b * sympy.cos(q1 + q2) - side * sympy.sin(q1 + q2),
        a * sympy.sin(q1) + b * sympy.sin(q1 + q2) + side * sympy.cos(q1 + q2),
        sympy.Float(c) + a / 2 + b,
    ]
    at = {q1: 0.3, q2: 0.4, a: 1.3 * l1, b: 0.8 * l2}  # other lengths than those of the file
    size = max(l1, l2, c)
    for ours, theirs in zip(found.value, hand, strict=True):
        assert {s.name for s in ours.free_symbols} <= {"q1", "q2", "l1", "l2"}
        assert abs(float(ours.subs(at)) - float(theirs.subs(at))) <= 1e-9 * size
    moved = robot.with_parameters({"l1": 1.3 * l1, "l2": 0.8 * l2})
    numbers = [float(value.subs(at)) for value in hand]
    assert forward_kinematics(moved, [0.3, 0.4]).translation == pytest.approx(np.array(numbers), abs=1e-12 * size)
    b_only = found.value[2].diff(b)
    assert float(b_only) == pytest.approx(1.0, abs=1e-9)  # a short length beside a long one is not lost
