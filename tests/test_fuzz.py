"""Robot files changed at random: see mutations.py, which `--count 100000` runs at length."""

import subprocess
import sys
from pathlib import Path

import mutations
import pytest

from robotics1 import load_robot

TESTS = Path(__file__).parent


@pytest.mark.parametrize(
    ("first", "count"), [(0, 400), *(pytest.param(first, 1000, marks=pytest.mark.sweep) for first in (400, 1400))]
)
def test_mutants_load_or_are_refused(first, count):
    options = ["--count", str(count), "--first", str(first), "--seed", "1"]
    command = [sys.executable, str(TESTS / "mutations.py"), *options]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    words = done.stdout.replace(",", "").split()
    tried, accepted, refused = (int(words[i]) for i in (0, 3, 5))
    assert tried == accepted + refused == count
    assert accepted > count / 10
    assert refused > count / 10


def test_a_mutant_is_the_same_each_time_and_differs_from_its_neighbours():
    assert mutations.mutant(1, 7) == mutations.mutant(1, 7)
    assert len({mutations.mutant(seed, i) for seed in (1, 2) for i in range(50)}) > 95


def test_every_change_changes_a_text():
    from random import Random

    for change in {*mutations.CHANGES, *mutations.EXPRESSION_CHANGES}:
        texts = {change(Random(seed), mutations.BASE + mutations.RICH) for seed in range(40)}
        assert len(texts) > 3, change.__name__
        assert change(Random(0), "") == "" or change is mutations.flip_bytes


def test_the_sound_sources_are_accepted(tmp_path):
    (tmp_path / "parts.xacro").write_text((TESTS.parent / "urdf" / "parts.xacro").read_text())
    for name, text in mutations.sources().items():
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        assert mutations.verdict(path, 0) == "accepted"


# --- a failure is seen


@pytest.fixture
def now(tmp_path):
    (tmp_path / "now").write_text("12 arm.urdf", encoding="utf-8")
    (tmp_path / "arm.urdf").write_text("<the text>", encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    "code", ["import os; os.abort()", "raise KeyError('q1')", "import sys; sys.stderr.write('C++')"]
)
def test_a_crash_an_exception_and_a_word_on_stderr_fail_with_the_text(now, code):
    said = mutations.run([sys.executable, "-c", code], now)
    assert said.startswith("mutant 12 of arm.urdf: exit code ")
    assert said.endswith("<the text>\n")


def test_a_batch_that_hangs_fails_with_the_text(now, monkeypatch):
    monkeypatch.setattr(mutations, "PATIENCE", 0.2)
    assert "it takes more than 0.2 s" in mutations.run([sys.executable, "-c", "import time; time.sleep(60)"], now)


def test_a_foreign_exception_and_a_pose_that_is_none_are_no_verdict(tmp_path, monkeypatch):
    path = tmp_path / "arm.urdf"
    path.write_text(mutations.BASE, encoding="utf-8")
    robot = load_robot(path)
    robot.model.jointPlacements[1].translation = float("nan") * robot.model.jointPlacements[1].translation
    monkeypatch.setattr("robotics1.load_robot", lambda _: robot, raising=False)
    with pytest.raises(AssertionError, match="has no pose"):
        mutations.verdict(path, 0)
    monkeypatch.undo()
    monkeypatch.setattr("robotics1.load_robot", lambda _: 1 / 0, raising=False)
    with pytest.raises(ZeroDivisionError):
        mutations.verdict(path, 0)
