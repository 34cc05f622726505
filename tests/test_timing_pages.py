"""The pages on timing and on splines: their code runs and gives what it says."""

import re
from math import sqrt
from pathlib import Path

import numpy as np
import pytest

DOCS = Path(__file__).parents[1] / "docs"


def run(name):
    """The names that a page's code defines, all blocks after one another."""
    blocks = re.findall(r"```python\n(.*?)```", (DOCS / name).read_text(encoding="utf-8"), flags=re.DOTALL)
    scope = {}
    for block in blocks:
        exec(compile(block, name, "exec"), scope)
    return scope


def test_the_code_of_the_page_on_timing_runs_and_says_what_it_says():
    page = run("timing.md")
    assert (page["law"].peak_velocity.value, page["law"].peak_velocity.time) == pytest.approx((2.25, 1.0))
    assert (page["law"].peak_acceleration.value, page["law"].peak_acceleration.time) == (4.5, 0.0)
    trapezoid = page["trapezoid"]
    assert trapezoid.switching_times == pytest.approx([1, 3])
    assert (trapezoid.acceleration(1.0), trapezoid.acceleration(1.0, side="left")) == (0, 1)
    coefficients = [piece.coefficients_t[:, 0] for piece in trapezoid.pieces]
    assert np.array(coefficients) == pytest.approx(np.array([[0, 0, 0.5], [0.5, 1, 0], [2.5, 1, -0.5]]))
    answer = page["answer"]
    assert answer.duration == pytest.approx(1.5)
    assert answer.joint_durations == pytest.approx([1.5, 1.0])
    assert answer.slack == pytest.approx([0, 0.5])
    assert not answer.unique
    said = "; ".join(str(demand) for demand in answer.active)
    assert (
        said == "joint 0's velocity is 1 at t = 0.5 s, its bound 1; joint 0's acceleration is 2 at t = 0 s, its bound 2"
    )
    assert page["back"].duration == pytest.approx(1 + 2 * sqrt(1.5))
    phases = [phase.duration for phase in page["smooth"].laws[0].phases]
    assert phases == pytest.approx([0.4, 0.1, 0.4, 0.6, 0.4, 0.1, 0.4])
    assert page["T"] == pytest.approx(1.490, abs=5e-4)
    assert page["scaling"].factor == pytest.approx(1.5)
    assert [demand.quantity for demand in page["scaling"].active] == ["velocity"]
    assert page["slower"].factor == pytest.approx(2)


def test_the_code_of_the_page_on_splines_runs_and_says_what_it_says():
    page = run("splines.md")
    times, spline = page["times"], page["spline"]
    assert spline.velocity(times)[[0, -1]] == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    assert spline.switching_times == pytest.approx(times[1:-1])
    assert page["moving"].velocity(0) == pytest.approx([0.3, 0])
    first, second = (piece.coefficients_t[:, 0] for piece in page["via"].pieces)
    assert first == pytest.approx([0, 0, 1], abs=1e-12)
    assert second[:2] == pytest.approx([1, 2])
    assert np.abs(page["fastest"].trajectory.extremes(1)[1]).max() <= 1 + 1e-9
    assert page["T"] > 0
