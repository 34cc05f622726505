import ast
import json
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import robotics1

MODULES = [module.name for module in pkgutil.walk_packages(robotics1.__path__, "robotics1.")]
HEAVY = ("pinocchio", "scipy", "sympy", "matplotlib", "meshcat", "xacro", "typer", "rich", "numpy")


def fresh(code):
    """The JSON that a fresh process prints."""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=120)
    return json.loads(run.stdout.splitlines()[-1])


def test_import_loads_no_heavy_library():
    code = f"import sys, json, robotics1; print(json.dumps([n for n in {HEAVY!r} if n in sys.modules]))"
    assert fresh(code) == []


def test_every_public_name_is_the_same_object_before_and_after_importing_every_submodule():
    code = f"""
import importlib, json, robotics1
first = {{name: getattr(robotics1, name) for name in robotics1.__all__}}
for module in {MODULES!r}:
    importlib.import_module(module)
second = {{name: getattr(robotics1, name) for name in robotics1.__all__}}
third = {{name: getattr(robotics1, name) for name in robotics1.__all__}}
bad = [n for n in first if not (first[n] is second[n] is third[n]) or type(first[n]).__name__ == "module"]
print(json.dumps([len(first), bad]))
"""
    assert fresh(code) == [len(robotics1.__all__), []]


def test_every_public_name_resolves_after_importing_every_submodule_first():
    code = f"""
import importlib, json, robotics1
for module in {MODULES!r}:
    importlib.import_module(module)
bad = [n for n in robotics1.__all__ for _ in range(2) if type(getattr(robotics1, n)).__name__ == "module"]
print(json.dumps(bad))
"""
    assert fresh(code) == []


def test_no_public_name_is_a_module_name():
    assert not set(robotics1.__all__) & {part for module in MODULES for part in module.split(".")}


def test_all_equals_the_names_of_the_stub():
    tree = ast.parse(Path(robotics1.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imported = [a.name for node in tree.body if isinstance(node, ast.ImportFrom) for a in node.names]
    listed = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert sorted(imported) == sorted(listed) == sorted(robotics1.__all__)
    assert len(set(listed)) == len(listed)


def test_dir_lists_the_public_names():
    assert set(robotics1.__all__) <= set(dir(robotics1))


def test_an_unknown_attribute_is_an_attribute_error():
    with pytest.raises(AttributeError, match="find_singularity"):
        robotics1.find_singularity  # noqa: B018


@pytest.mark.parametrize("name", sorted(robotics1.__all__))
def test_every_public_name_has_a_docstring(name):
    value = getattr(robotics1, name)
    assert name == "RANK_TOLERANCE" or value.__doc__
