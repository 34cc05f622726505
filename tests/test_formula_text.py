"""A formula typed as text is arithmetic and nothing else, and is refused at once where it would not end."""

import numpy as np
import pytest
from arms import ROBOTS
from command import answer, run

import robotics1 as r1

ENDLESS = [
    "9**9**9", "9**9**9*s", "1e308*1e308", "factorial(10**9)", "(9*s)**(9**9)", "((9**999)**999)**999", "2**(s*10**9)",
    "(2*s)**(s+10**9)", "9**-999999999", "1/10**400", "s**1e308", "pi**1000**2", "(2**500*s)**500", "exp(exp(exp(99)))",
    "9" * 5000, "1e400", "(" * 3000 + "s" + ")" * 3000, "-" * 3000 + "s", "+".join(["s"] * 3000), "s" * 20_000,
    "sin(" * 100 + "s" + ")" * 100, "sinh(10**8)", "1e308*s*1e308", "10**308*10**308*s",
]  # fmt: skip
CODE = [
    "__import__('os').system('true')", "s.__class__", "s.evalf()", "s[0]", "lambda: 1", "s if s else 1", "s:=1", "[s]",
    "(s, s)", "{s}", "f'{s}'", "'s'", "open('x')", "exec('1')", "eval('1')", "sin(*[s])", "sin(x=s)", "s.real", "s@s",
    "s//2", "s%2", "~1", "1or 2", "s and s", "not s", "s is s", "s < 1", "True", "None", "...", "1j", "b'1'", "'\\d'",
    "yield s", "await s", "s;s", "#", "", " ", "\x00", "`s`", "$s", "print(s)", "Symbol('x')", "S(1)", "sympify('1')",
]  # fmt: skip


@pytest.mark.parametrize("text", ENDLESS, ids=lambda text: text[:20])
def test_a_formula_too_large_to_be_computed_is_refused(text):
    with pytest.raises(r1.InputError) as error:
        r1.curves.formula_path(["s", text], "s", 1.0)
    assert len(str(error.value)) < 1000


@pytest.mark.parametrize("text", CODE, ids=ascii)
def test_what_is_no_arithmetic_is_refused_and_not_run(text):
    with pytest.raises(r1.InputError):
        r1.curves.formula_path(["s", text], "s", 1.0)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("R*cos(s)", 0.3 * np.cos(0.5)),
        ("  -s**2 + 2*s/3 ", -0.25 + 1 / 3),
        ("exp(-s)*sqrt(1 + s)", np.exp(-0.5) * np.sqrt(1.5)),
        ("atan2(s, R) - pi/4", np.arctan2(0.5, 0.3) - np.pi / 4),
        ("2**s + s**7 + (1 + s)**(1/3)", 2**0.5 + 0.5**7 + 1.5 ** (1 / 3)),
        ("1.5e-3*s + 1e300*1e-300", 1.00075),
        ("+".join(["s"] * 100), 50.0),
    ],
)
def test_arithmetic_is_read(text, value):
    path = r1.curves.formula_path(["s", text], "s", 1.0, values={"R": 0.3})
    assert path(0.5) == pytest.approx([0.5, value], rel=1e-14)


@pytest.mark.parametrize(
    "text", ["9" * 100_000 + "x", "1e999", "9" * 5000, "1" + " " * 50_000 + "x", "1/0", "e5", "pipi"]
)
def test_a_typed_number_that_is_none_is_refused(text):
    assert len(run("scan", "planar_2r", "--samples", text).refusal) < 300


@pytest.mark.parametrize(
    ("text", "value"),
    [("0.7pi", 0.7 * np.pi), ("-3pi/4", -0.75 * np.pi), ("2 * pi", 2 * np.pi), (".5", 0.5), ("5.", 5), ("1/2", 0.5)],
)
def test_a_typed_number_is_read(text, value):
    assert answer("fk", ROBOTS / "one_joint.urdf", "--q", text.replace(" ", ""))["q"] == [value]
    assert answer("scan", "planar_2r", "--samples", "1", "--length", text.strip("-"))["length"] == abs(value)


@pytest.mark.parametrize("function", [lambda p, R, q: [p[0], "__import__('os')"], lambda p, R, q: [p[0], p[1] * "1+1"]])
def test_a_text_that_a_tasks_function_returns_is_no_formula(function):
    with pytest.raises(r1.Robotics1Error):
        r1.formulas(r1.load_robot("planar_2r"), r1.FunctionTask(function, 2))
