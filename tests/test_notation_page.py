"""The page that translates notation: each call of its tables runs, and gives what the book means."""

import re
from pathlib import Path

import numpy as np
import pytest

TEXT = (Path(__file__).parents[1] / "docs" / "notation.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (.+?) \| `([^|]+)` \| (.*)\|$", TEXT, flags=re.MULTILINE)
CALLS = list(dict.fromkeys(call for _, call, _ in ROWS))


@pytest.fixture(scope="module")
def scope():
    names = {}
    exec(re.findall(r"```python\n(.*?)```", TEXT, flags=re.DOTALL)[0], names)
    return names


def test_every_line_of_the_tables_has_one_call():
    lines = [line for line in TEXT.splitlines() if line.startswith("|") and not re.match(r"\|(---| there)", line)]
    assert len(lines) == len(ROWS) > 60


@pytest.mark.parametrize("call", CALLS)
def test_a_call_of_the_page_gives_an_answer(scope, call):
    assert eval(call, dict(scope)) is not None


def the(scope, *there):
    """What the calls of these lines give."""
    found = {name: call for name, call, _ in ROWS}
    return [eval(found[name], dict(scope)) for name in there]


def test_lynch_and_parks_lines_agree_with_their_definitions(scope):
    space, body, pose = the(scope, "J_s(θ)", "J_b(θ)", "T_sb(θ)")
    assert space == pytest.approx(scope["rigid_motions"].adjoint(pose, angular_first=True) @ body)
    again = the(scope, "e^([S₁]θ₁) ⋯ e^([Sₙ]θₙ) M")[0]
    assert scope["r1"].forward_kinematics(again, scope["q"]).homogeneous == pytest.approx(pose.homogeneous)
    moved = the(scope, "F_a = [Ad_T_ba]ᵀ F_b")[0]
    inverse = scope["T_ab"].inverse()
    assert moved == pytest.approx(scope["rigid_motions"].adjoint(inverse, angular_first=True).T @ scope["F"])


def test_craigs_fixed_and_euler_angles_are_one_rotation(scope):
    fixed, euler = the(scope, "R_XYZ(γ, β, α), fixed angles", "R_Z'Y'X'(α, β, γ), Euler angles")
    assert fixed == pytest.approx(euler)


def test_corkes_jacobians_are_the_same_velocity_in_two_frames(scope):
    base, tool = the(scope, "`jacob0(q)`", "`jacobe(q)`")
    R = scope["R"]
    assert base == pytest.approx(np.kron(np.eye(2), R) @ tool)
