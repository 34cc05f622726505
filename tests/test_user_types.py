"""Types for a user: a script made of the README's blocks passes mypy as strictly as it can check."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
USER = """
import numpy as np
import robotics1 as r1

robot = r1.load_robot("prr")
reveal_type(robot)
reveal_type(r1.forward_kinematics)
several = r1.frame_jacobian("prr", np.zeros((4, 3)))
reveal_type(several)
r1.frame_jacobian("prr", {"q1": 0.1, "q2": 0.2, "q3": 0.3}, kind="space")
r1.ik_solutions("planar_2r", "position:xy", (1, 1)).require()
"""


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """Return a function of a script: what mypy prints, and whether it passes; of this package it follows types only."""
    folder = tmp_path_factory.mktemp("types")
    flags = ["--strict", "--allow-redefinition", "--follow-imports=silent", "--cache-dir=cache"]

    def checked(script):
        (folder / "script.py").write_text(script, encoding="utf-8")
        command = [sys.executable, "-m", "mypy", *flags, "script.py"]
        ended = subprocess.run(
            command, capture_output=True, text=True, cwd=folder, env={"MYPYPATH": str(ROOT)}, check=False
        )
        return ended.stdout, ended.returncode == 0

    return checked


def test_a_script_of_the_readme_is_typed(mypy):
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), flags=re.DOTALL)
    script = "\n".join(blocks).replace("].formulas.", "].require_formulas().")  # a branch found by numbers has none
    said, passes = mypy(script)
    assert passes, said


def test_types_are_known_and_misspelled_options_are_errors(mypy):
    said, passes = mypy(USER)
    assert passes, said
    assert 'Revealed type is "robotics1.robot.model.Robot"' in said
    assert "numpy.ndarray" in said
    said, passes = mypy(USER.replace('kind="space"', 'kind="spatial"'))
    assert not passes
    assert "Literal['mixed', 'space', 'body']" in said


def test_options_of_every_namespace_are_known_words(mypy):
    script = """
import numpy as np
import robotics1 as r1

r1.orientation.euler_rate_map("ZYZ", [0, 1, 0], reference="inertial")
r1.plots.plot_ellipses("planar_2r", "position:xy", [0.1, 0.2], kinds="speed")
r1.scan_singularities("planar_2r", "position:xy", samples=10, measures=("sigma",))
r1.curves.cubic_spline([0, 1, 2], [[0], [1], [0]], bc_type="free")
r1.minimum_time([0], [1], r1.MotionLimits(velocity=1, acceleration=1), law="bang")
r1.redundancy.saturated_velocity("prr", "position:xy", [0, 0, 0], [0.1, 0], method="best")
"""
    said, _ = mypy(script)
    for line in range(5, 11):
        assert f"script.py:{line}: error" in said, (line, said)


@pytest.mark.parametrize("name", ["robotics1/py.typed", "robotics1/__init__.pyi", "robotics1/ik/__init__.pyi"])
def test_the_package_says_that_it_is_typed(name):
    assert (ROOT / name).is_file()
