"""Generated source, LaTeX, pages and plots hold names from a file as text; a length may have any name."""

import ast
import re
from xml.etree import ElementTree
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
from arms import one_joint_file
from hostile_names import NAMES, arm_file

import robotics1 as r1

XY = r1.PositionTask("xy")
Q = np.array([0.3, 1.1])


def run(source, name="jacobian"):
    """The function of a source, in a namespace of its own."""
    space = {}
    exec(compile(source, "formulas.py", "exec"), space)
    return space[name]


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A working directory, in which the names would make the folder `ran`."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_source_runs_and_its_docstring_holds_the_names_as_they_are(name, here):
    robot = r1.load_robot(arm_file(here, name))
    source = r1.formulas(robot, XY).python()
    jacobian = run(source)
    assert source.count("\n") == len(source.splitlines()) == 16
    assert [type(node) for node in ast.parse(source).body] == [ast.Import, ast.FunctionDef]
    assert jacobian.__doc__ == f"J(q) of {name}, joints q1 {name}, q2 {name}; rows x, y"
    assert jacobian(Q) == pytest.approx(XY.jacobian(robot, Q), abs=1e-12)
    assert not (here / "ran").exists()


LENGTHS = ("sin", "cos", "array", "np", "float", "numpy", "abs", "max", "print", "dtype", "q", "qdot", "t0", "t1")
LENGTHS += (
    "E",
    "I",
    "S",
    "N",
    "O",
    "Q",
    "x",
    "x0",
    "x1",
    "c1",
    "s1",
    "self",
    "a_",
    "beta",
    "lambda_",
    "ä",
    "α",
    "长度",
)


@pytest.mark.parametrize("name", LENGTHS)
def test_a_length_may_be_named_like_a_function(name):
    """Planar 2R, J = [[−a s1 − b s12, −b s12], [a c1 + b c12, b c12]]; a named so, b = 0.5."""
    a = 0.7
    robot = r1.robot_from_dh([("R", name, 0, 0, 0), ("R", 0.5, 0, 0, 0)], parameters={name: a})
    found = r1.formulas(robot, XY)
    q1, q2 = Q
    s1, c1, s12, c12 = np.sin(q1), np.cos(q1), np.sin(q1 + q2), np.cos(q1 + q2)
    J = np.array([[-a * s1 - 0.5 * s12, -0.5 * s12], [a * c1 + 0.5 * c12, 0.5 * c12]])
    assert {symbol.name for symbol in found.jacobian.free_symbols} == {"q1", "q2", name}
    assert run(found.python())(Q) == pytest.approx(J, abs=1e-12)
    assert run(found.python("determinant"), "determinant")(Q) == pytest.approx(a * 0.5 * np.sin(q2), abs=1e-12)
    spelled = re.search(r"\*, (\w+)=0.7", found.python())[1]
    assert run(found.python("value"), "value")(Q, **{spelled: 2.0})[0] == pytest.approx(2 * c1 + 0.5 * c12)


def test_singular_sets_take_a_length_named_sin():
    robot = r1.robot_from_dh([("R", "sin", 0, 0, 0), ("R", "cos", 0, 0, 0)], parameters={"sin": 1.0, "cos": 0.5})
    found = r1.find_singularities(robot, XY)
    assert sorted(float(branch.values["q2"]) for branch in found.branches) == pytest.approx([0, np.pi])


@pytest.mark.parametrize(
    "name", ["lambda", "class", "True", "1a", "a-b", "a.b", '"""', "</script>", "a\\b", "ﬁ", "\x9b31m"]
)
def test_a_length_that_is_no_identifier_is_spelled_as_one(name, tmp_path):
    path = tmp_path / "arm.urdf.xacro"
    text = one_joint_file(tmp_path, "L", "L").read_text().replace('"L" default', f"{quoteattr(name)} default")
    text = re.sub(r"<xacro:property[^>]*/>", "", text)
    path.write_text(text.replace('"${L} 0 0"', quoteattr(f"$(arg {name}) 0 0")), encoding="utf-8")
    robot = r1.load_robot(path)
    found = r1.formulas(robot, XY)
    assert run(found.python())([0.3]) == pytest.approx(XY.jacobian(robot, [0.3]), abs=1e-12)


def test_a_length_named_like_a_joint_is_refused_by_name(tmp_path):
    robot = r1.load_robot(one_joint_file(tmp_path, "q1", "q1"))
    with pytest.raises(r1.FormulaError, match="parameter 'q1', which in formulas is a joint"):
        r1.formulas(robot, XY)


def test_a_path_may_have_a_parameter_named_like_a_function():
    path = r1.curves.formula_path(["2*sin", "sin**2"], "sin", 1.0)
    assert path(0.5) == pytest.approx([1.0, 0.25])


@pytest.mark.parametrize(
    "name", ["</script><script>x()</script>", "<img src=x onerror=x()>", "\u202ea\x9b", "$commands"]
)
def test_a_page_of_a_robot_holds_its_name_as_text(name, tmp_path):
    robot = r1.load_robot(arm_file(tmp_path, name))
    plain = r1.view(r1.load_robot(arm_file(tmp_path, "r")), Q, tmp_path / "plain.html").file.read_text(encoding="utf-8")
    text = r1.view(robot, Q, tmp_path / "page.html", caption=f"of\n{name}").file.read_text(encoding="utf-8")
    for mark in ("<script", "<img", "</"):
        assert text.count(mark) == plain.count(mark)
    assert not re.search("[\u202e\x9b]", text)


@pytest.mark.parametrize("name", ["$x", "$\\frac{$", "_hidden", "<b>", "\u202ea"])
def test_a_plot_holds_the_names_of_joints_as_text(name, tmp_path):
    motion = r1.cubic([0, 0], [1, 1], 1.0)
    named = r1.load_robot(arm_file(tmp_path, name))
    r1.plot_trajectory(motion, file=tmp_path / "a.svg", robot=named)
    assert ElementTree.parse(tmp_path / "a.svg").getroot().tag.endswith("svg")
