import ast
import contextlib
import inspect
import json
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
from public_names import NAMESPACES, PUBLIC

import robotics1

MODULES = [module.name for module in pkgutil.walk_packages(robotics1.__path__, "robotics1.")]
NAMES = sorted(set(NAMESPACES) - {"robotics1"})
SPACES = ["robotics1", *(f"robotics1.{name}" for name in NAMES)]
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
spaces = [importlib.import_module(name) for name in {SPACES!r}]
def found():
    return {{(space.__name__, name): getattr(space, name) for space in spaces for name in space.__all__}}
first = found()
for module in {MODULES!r}:
    importlib.import_module(module)
second, third = found(), found()
modules = {{name for name in first if type(first[name]).__name__ == "module"}} - {{("robotics1", n) for n in {NAMES!r}}}
bad = sorted(map(str, modules | {{n for n in first if not (first[n] is second[n] is third[n])}}))
print(json.dumps([len(first), bad]))
"""
    assert fresh(code) == [sum(len(space.__all__) for space in NAMESPACES.values()), []]


def test_every_public_name_resolves_after_importing_every_submodule_first():
    code = f"""
import importlib, json, robotics1
for module in {MODULES!r}:
    importlib.import_module(module)
spaces = [importlib.import_module(name) for name in {SPACES!r}]
found = [(n, getattr(space, n)) for space in spaces for n in space.__all__ for _ in range(2)]
bad = [n for n, value in found if type(value).__name__ == "module" and n not in {NAMES!r}]
print(json.dumps(bad))
"""
    assert fresh(code) == []


def test_no_public_name_is_a_module_name():
    assert not set(PUBLIC) & {part for module in MODULES for part in module.split(".")}


@pytest.mark.parametrize("space", [name for name, module in NAMESPACES.items() if hasattr(module, "__path__")])
def test_all_equals_the_names_of_the_stub(space):
    module = NAMESPACES[space]
    tree = ast.parse(Path(module.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    imported = [a.name for node in tree.body if isinstance(node, ast.ImportFrom) for a in node.names]
    listed = next(ast.literal_eval(node.value) for node in tree.body if isinstance(node, ast.Assign))
    assert sorted(imported) == sorted(listed) == sorted(module.__all__)
    assert len(set(listed)) == len(listed)


def test_the_top_has_at_most_sixty_names():
    assert len(robotics1.__all__) <= 60


def test_dir_lists_the_public_names():
    assert set(robotics1.__all__) <= set(dir(robotics1))


def test_an_unknown_attribute_is_an_attribute_error():
    with pytest.raises(AttributeError, match="find_singularity"):
        robotics1.find_singularity  # noqa: B018


@pytest.mark.parametrize("name", sorted(PUBLIC))
def test_every_public_name_has_a_docstring(name):
    value = PUBLIC[name]
    assert name == "RANK_TOLERANCE" or value.__doc__


def test_a_name_of_a_namespace_is_found_at_the_top_and_means_one_thing():
    for space, module in NAMESPACES.items():
        for name in module.__all__:
            assert getattr(robotics1, name) is getattr(module, name), (space, name)
    with pytest.raises(AttributeError, match="solv_ik"):
        _ = robotics1.solv_ik


def test_help_names_the_types_and_does_not_spell_them_out():
    """What an alias such as ArrayLike stands for takes 700 characters in a signature."""
    for name, value in PUBLIC.items():
        if callable(value):
            with contextlib.suppress(ValueError):  # an enum or an error has none
                written = str(inspect.signature(value))
                assert len(written) < 520, name
                assert not re.search(r"numpy\._typing|numpy\.ndarray\[|pywrap", written), name
