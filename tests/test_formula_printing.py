"""One formula as Python source, for LaTeX, for the terminal and for pages, with any name in it."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest
import sympy
from hostile_names import NAMES
from hypothesis import given, strategies as st

from robotics1.symbolic.writing.printing import latex_text, mathml_text, unicode_text
from robotics1.symbolic.writing.source_code import python_function


def run(source, name):
    """The function of a source, in a namespace of its own."""
    space = {}
    exec(compile(source, "formulas.py", "exec"), space)
    return space[name]


@given(st.text(st.characters(codec=None, exclude_categories=()), max_size=30))
def test_any_text_is_the_docstring_of_a_function_that_runs(name):
    x = sympy.Symbol("x", real=True)
    function = run(python_function("f", 2 * x, {"q": [x]}, {}, name), "f")
    assert function.__doc__ == name
    assert function([3.0]) == 6.0


def test_lengths_that_would_be_spelled_alike_stay_apart():
    x, a, b, c = sympy.symbols("x a-b a_b ab", real=True)
    lengths = {"a-b": 1.0, "a_b": 2.0, "ab": 3.0}
    function = run(python_function("f", 100 * a + 10 * b + c, {"q": [x]}, lengths, ""), "f")
    assert function([0.0]) == 123.0
    assert function([0.0], a_b=4.0) == 423.0


def test_names_that_python_does_not_take_are_respelled():
    a, b, q1, t0 = sympy.symbols("lambda link-1 q1 t0", real=True)
    parameters = {"lambda": 2.0, "link-1": 3.0, "q": 5.0, "t0": 7.0}
    e = sympy.sin(q1 + a) + (q1 + a) ** 2 + b + sympy.Symbol("q", real=True) + t0
    source = python_function("f", e, {"q": [q1]}, parameters, "a test")
    assert "def f(q, *, lambda_=2.0, link_1=3.0, q_=5.0, t0=7.0):" in source
    assert run(source, "f")([1.0]) == pytest.approx(np.sin(3) + 9 + 3 + 5 + 7)
    assert run(source, "f")([1.0], lambda_=0) == pytest.approx(np.sin(1) + 1 + 15)


def test_latex_terminal_and_page_forms():
    l2, q2 = sympy.symbols("l2 q2", real=True)
    formula = l2 * sympy.cos(q2)
    assert latex_text(formula) == r"l_{2} \cos{\left(q_{2} \right)}"
    assert unicode_text(formula) == "l₂⋅cos(q₂)"
    page = mathml_text(formula)
    assert page.startswith('<math display="block">')
    assert page.endswith("</math>")
    assert re.sub(r"<[^>]*>|&InvisibleTimes;", "", page) == "l2cos(q2)"
    dotted = "<mover><mi>q</mi><mo>˙</mo></mover>"
    assert f"<msub>{dotted}<mi>1</mi></msub>" in mathml_text(sympy.Symbol("qdot1"))
    assert re.sub(r"<[^>]*>", "", mathml_text(-sympy.Symbol("x"))) == "−x"


HOSTILE = [name for name in NAMES.values() if not re.fullmatch(r"\w+", name)]


@pytest.mark.parametrize("name", HOSTILE)
def test_latex_has_no_command_from_a_name(name):
    text = latex_text(sympy.Symbol(name) + 1)
    inside = re.fullmatch(r"\\text\{(.*)\} \+ 1", text)[1]
    ours = r"\\text(backslash|asciicircum|asciitilde|less|greater)\{\}|\\[{}$&#%_]"
    assert not re.search(r"[\\{}$&#%_^~<>]", re.sub(ours, "", inside))
    assert inside.isprintable()


@pytest.mark.parametrize(
    ("name", "latex"), [("l2", "l_{2}"), ("l_2", "l_{2}"), ("alpha", r"\alpha"), ("a_b", "a_{b}"), ("x_1_2", "x_{1 2}")]
)
def test_latex_of_a_word_is_as_before(name, latex):
    assert latex_text(sympy.Symbol(name)) == latex


@pytest.mark.parametrize("name", HOSTILE)
def test_mathml_has_no_element_from_a_name(name):
    text = mathml_text(sympy.Eq(sympy.Symbol(name), 1))
    root = ElementTree.fromstring(text.replace("&InvisibleTimes;", ""))
    assert {element.tag for element in root.iter()} <= {"math", "mrow", "mi", "mo", "mn", "msub", "msup", "msubsup"}
