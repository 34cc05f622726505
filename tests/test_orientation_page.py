"""The page on orientation: its code runs and gives what it says."""

import re
from math import pi
from pathlib import Path

import numpy as np
import pytest
import sympy

PAGE = Path(__file__).parents[1] / "docs" / "orientation.md"


def test_the_code_of_the_page_on_orientation_runs_and_says_what_it_says():
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert len(blocks) == 9
    scope, after = {}, []
    for block in blocks:
        exec(compile(block, PAGE.name, "exec"), scope)
        after.append(dict(scope))
    assert after[1]["found"].solutions == pytest.approx(
        np.array([[0.4, 0.7, -0.9], [-2.7416, 2.4416, 2.2416]]), abs=1e-4
    )
    assert f"{after[1]['rpy'].correction:.1e}" == "2.2e-05"
    assert after[2]["found"].combination == (1, 0, -1)
    assert after[2]["found"].combined == pytest.approx(0.3)
    assert scope["f"].determinant == sympy.cos(sympy.Symbol("b", real=True))
    assert [case.value for case in scope["f"].singular] == [sympy.pi / 2, -sympy.pi / 2]
    assert scope["rates"].rates == pytest.approx([0.5, 0, 0.5])
    assert scope["rates"].unproduced == pytest.approx(scope["rates"].lost)
    assert scope["turn"].angle == pytest.approx(2.5936, abs=1e-4)
    assert scope["turn"].axis == pytest.approx([-0.6786, -0.6786, 0.2811], abs=1e-4)
    assert scope["omega"] == sympy.Matrix([0, 0, 1])
    assert scope["aim"].at(0.5) @ [0, 0, 1] == pytest.approx([1 / 3, 2 / 3, 2 / 3])
    assert scope["frame"].exact
    assert scope["pi"] == pi


def test_the_angle_of_the_page_is_atan2_of_the_skew_part_and_the_trace():
    from robotics1 import axis_angle_to_rotation, rotation_to_axis_angle

    for angle in (0.3, 1.9, 3.1):
        R = axis_angle_to_rotation([1, -2, 2], angle)
        formula = np.arctan2(np.linalg.norm(R - R.T) / np.sqrt(8), (np.trace(R) - 1) / 2)
        assert rotation_to_axis_angle(R).angle == pytest.approx(formula, abs=1e-14)
