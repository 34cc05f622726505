"""The project as a whole: the wheel, the README, the pinned versions, the house."""

import ast
import os
import re
import subprocess
import sys
import venv
from graphlib import TopologicalSorter
from pathlib import Path
from zipfile import ZipFile

import pytest
from command import run

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "robotics1").rglob("*.py"))


def wheel_in(folder):
    from hatchling.builders.wheel import WheelBuilder

    return next(iter(WheelBuilder(str(ROOT)).build(directory=str(folder), versions=["standard"])))


def test_the_wheel_brings_its_robots_and_its_exams(tmp_path):
    with ZipFile(wheel_in(tmp_path)) as wheel:
        wheel.extractall(tmp_path / "unpacked")
    program = """
import sys
import robotics1
from robotics1.cli import main
robot = robotics1.load_robot("prr")
print(robot.parameters["l2"], robot.path, robotics1.__file__, sep="\\n")
sys.argv = ["robotics1", "exam", "own.toml", "--out", "answers.html"]
main()
"""
    question = '[[exercise]]\nrobot = "planar_2r"\n[[exercise.question]]\nask = "jacobian"\ntask = "position:xy"\n'
    (tmp_path / "unpacked" / "own.toml").write_text(question)
    run = subprocess.run(
        [sys.executable, "-c", program], check=True, cwd=tmp_path / "unpacked", capture_output=True, text=True,
        timeout=120, env=os.environ | {"PYTHONPATH": str(tmp_path / "unpacked")},
    )  # fmt: skip
    length, robot, package = run.stdout.splitlines()[:3]
    assert length == "0.6"
    assert all(Path(path).is_relative_to(tmp_path / "unpacked" / "robotics1") for path in (robot, package))
    assert (tmp_path / "unpacked" / "robotics1" / "examples" / "exams" / "exam_2025_01_13.toml").is_file()
    assert (tmp_path / "unpacked" / "answers.html").is_file()


@pytest.mark.sweep
def test_the_wheel_brings_its_robots_to_an_empty_environment(tmp_path):
    wheel = wheel_in(tmp_path)
    venv.create(tmp_path / "env", with_pip=True)
    python = tmp_path / "env" / "bin" / "python"
    install = [str(python), "-m", "pip", "install", "--quiet", "--constraint", str(ROOT / "constraints.txt"), wheel]
    subprocess.run(install, check=True, cwd=tmp_path, timeout=600)
    program = "import robotics1; r = robotics1.load_robot('prr'); print(r.parameters['l2'], r.path)"
    run = subprocess.run(
        [str(python), "-I", "-c", program], check=True, cwd=tmp_path, capture_output=True, text=True, timeout=120
    )
    length, path = run.stdout.split(maxsplit=1)
    assert length == "0.6"
    assert Path(path.strip()).is_relative_to(tmp_path / "env")
    command = python.with_name("robotics1")  # without extras: a sheet says which of them its pictures need
    for words in (
        ["fk", "prr"],
        ["singularities", "planar_2r", "--task", "position:xy"],
        ["report", "prr", "-o", "a.html"],
    ):
        subprocess.run([str(command), *words], check=True, cwd=tmp_path, capture_output=True, timeout=120)
    sheet = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "pip install &#x27;robotics1[viewer]&#x27;" in sheet
    assert "det J" in sheet


def test_the_source_distribution_has_docs_examples_and_tests_and_nothing_that_was_made(tmp_path):
    import tarfile

    from hatchling.builders.sdist import SdistBuilder

    (archive,) = SdistBuilder(str(ROOT)).build(directory=str(tmp_path), versions=["standard"])
    with tarfile.open(archive) as packed:
        names = {name.partition("/")[2] for name in packed.getnames()}
    wanted = {"docs/index.md", "docs/conf.py", "examples/exams/exam_2025_01_13.toml", "notebooks/arm_ur5.ipynb"}
    assert wanted | {"Makefile", "LICENSE", "tests/test_project.py", "urdf/prr.urdf.xacro"} <= names
    assert not [name for name in names if name.startswith(("docs/_made", "docs/reference", "build", "node_modules"))]


def test_the_code_of_the_readme_runs_and_says_what_it_says(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), flags=re.DOTALL)
    assert len(blocks) >= 5
    scope = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), scope)
    assert scope["spaces"].rank == 2
    assert scope["spaces"].contains([1, 0, 0])
    assert str(scope["f"].determinant) == "l2*cos(q2)"
    assert scope["run"].status.name == "CONVERGED"
    assert scope["run"].iterations == 3
    assert len(scope["every"].q) == 2
    assert scope["meeting"].time == pytest.approx(1.380, abs=5e-4)
    assert scope["choice"].status.name == "FEEDBACK"
    assert (tmp_path / "meeting.html").is_file()


def test_the_commands_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("webbrowser.open", lambda url: True)
    blocks = re.findall(r"```sh\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), flags=re.DOTALL)
    commands = [line.split() for block in blocks for line in block.splitlines() if line.startswith("robotics1 ")]
    assert len(commands) >= 10
    for command in commands:
        words = [str(ROOT / word) if word.startswith("urdf/") else word for word in command[1:]]
        result = run(*words)
        assert result.code == 0, (command, result)


def test_constraints_are_plain_pins():
    lines = (ROOT / "constraints.txt").read_text().splitlines()
    assert all(re.fullmatch(r"[A-Za-z0-9_.-]+==[A-Za-z0-9.+!-]+", line) for line in lines)
    assert any(line.startswith("pin==") for line in lines)


def test_no_file_is_longer_than_300_lines_and_no_function_than_40_lines_of_code():
    for path in SOURCES:
        text = path.read_text(encoding="utf-8")
        assert len(text.splitlines()) <= 300, path
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.FunctionDef):
                body = node.body[1:] if ast.get_docstring(node) else node.body
                lines = body[-1].end_lineno - body[0].lineno + 1 if body else 0
                assert lines <= 40, (path.name, node.name, lines)


def test_the_package_neither_prints_nor_asserts_on_arguments():
    for path in SOURCES:
        tree = ast.parse(path.read_text(encoding="utf-8"))
        assert not any(isinstance(node, ast.Assert) for node in ast.walk(tree)), path


def test_the_version_is_the_same_everywhere():
    from importlib.metadata import version

    assert f"version: {version('robotics1')}" in (ROOT / "CITATION.cff").read_text()
    assert f"## {version('robotics1')}" in (ROOT / "CHANGELOG.md").read_text()


def test_import_is_light():
    program = "import sys, robotics1; print([m for m in ('pinocchio', 'scipy', 'sympy', 'numpy') if m in sys.modules])"
    run = subprocess.run([sys.executable, "-c", program], check=True, capture_output=True, text=True)
    assert run.stdout.strip() == "[]"


def test_no_cached_property_holds_a_lock():
    """That of the standard library does in Python 3.11: see robotics1/caching.py."""
    locked = [path.name for path in SOURCES if re.search("from functools import .*cached_property", path.read_text())]
    assert locked == ["caching.py"]


def imported_modules(path, modules):
    """The modules of the package that a file imports when it runs, in functions too."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    for_types = {
        node for branch in ast.walk(tree) if isinstance(branch, ast.If) and ast.unparse(branch.test) == "TYPE_CHECKING"
        for statement in branch.body for node in ast.walk(statement)
    }  # fmt: skip
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and node not in for_types:
            inner = [f"{node.module}.{name.name}" for name in node.names]
            yield from (name if name in modules else node.module for name in inner)
        elif isinstance(node, ast.Import) and node not in for_types:
            yield from (name.name for name in node.names)


def test_no_modules_import_each_other_in_a_circle():
    names = {path: ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__") for path in SOURCES}
    modules = set(names.values()) - {"robotics1"}
    graph = {name: modules & set(imported_modules(path, modules)) for path, name in names.items() if name in modules}
    TopologicalSorter(graph).prepare()  # a CycleError holds the circle
