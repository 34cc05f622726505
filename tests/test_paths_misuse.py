"""What is no path is refused, with what would be right."""

import numpy as np
import pytest
import sympy
from hypothesis import given, settings, strategies as st

import robotics1 as r1
from robotics1 import InputError

s = sympy.Symbol("s")
LINE = r1.line_path([1, 2, 3], [4, 6, 3])
MISUSE = [
    (lambda: r1.line_path([1, 2], [1, 2]), "p0 and p1 must be different points"),
    (lambda: r1.line_path([0, 0], [0, 0]), "different points"),
    (lambda: r1.line_path([0, 0], [1, 2, 3]), r"p1 must have shape \(2,\)"),
    (lambda: r1.line_path([0, np.nan], [1, 2]), "p0 must be finite"),
    (lambda: r1.curves.arc_through([0, 0], [1, 1], [2, 2]), "must not be on a line"),
    (lambda: r1.curves.arc_through([0, 0, 0], [1, 1, 1], [1, 1, 1]), "p1 and p2 must be different points"),
    (lambda: r1.curves.arc_through([0, 0], [1, 1], [0, 0]), "p0 and p2 must be different points"),
    (lambda: r1.curves.arc_path([0, 0], [1, 0], 0), "angle must not be zero"),
    (lambda: r1.curves.arc_path([0, 0], [0, 0], 1), "centre and start must be different points"),
    (lambda: r1.curves.arc_path([0, 0, 0], [1, 0, 1], 1), "start must be in the plane of the centre; it is 1 m off"),
    (lambda: r1.curves.arc_path([0, 0, 0], [1, 0, 0], 1, normal=[0, 0, 0]), "normal must have a direction"),
    (lambda: r1.curves.circle_path([0, 0], -1), "radius must be a positive number"),
    (lambda: r1.curves.circle_path([0, 0, 0, 0], 1), r"centre must have shape \(3,\)"),
    (lambda: r1.curves.ellipse_path([0, 0], [1, 0], [1, 1]), "semi-axes, normal to each other"),
    (lambda: r1.curves.ellipse_path([0, 0], [1, 0], [0, 0]), "not zero"),
    (lambda: r1.curves.helix_path([0, 0, 0], [1, 0, 0], 1, 0), "turns must be a positive number"),
    (lambda: r1.curves.helix_path([0, 0, 0], [0, 0, 1], 1, 1), "in the plane of the centre"),
    (lambda: r1.curves.polyline_path([[0, 0]]), "two at least"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 0]]), r"points 1 and 2 are both \[1.0, 0.0\]"),
    (
        lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1], [2, 1]], blend=0.6),
        "from point 1 to point 2 there is 1, and they need 1.2",
    ),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], radius=2.0), "from point 0 to point 1 there is 1"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=-0.1), "blend must not be negative"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [0, 0]], blend=0.1), "turns back"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], radius=0.1, kind="parabolic"), "only circular blends"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], kind="round"), "kind must be one of"),
    (lambda: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=[0.1, 0.2]), r"blend must have shape \(1,\)"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [1, 1]]), "points 1 and 2 are both"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], knots=[0, 2, 1]), "knots must ascend from 0"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], knots=[1, 2, 3]), "knots must ascend from 0"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], knots="chords"), "knots must be 'chord'"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], bc_type="free"), "bc_type must be one of"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], bc_type="periodic"), "ends where it begins"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [0, 0]], bc_type="periodic", v0=[1, 0]), "has no ends"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1], [0, 0]], bc_type="periodic", a1=[1, 0]), "has no ends"),
    (
        lambda: r1.trajectories.spline_path([[0, 0], [1, 1]], v0=[1, 0], a0=[0, 0]),
        "v0 and a0 are one condition too many",
    ),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1]], a1=[1]), r"a1 must have shape \(2,\)"),
    (lambda: r1.trajectories.spline_path([[0, 0], [1, 1]], v0=[1]), r"v0 must have shape \(2,\)"),
    (lambda: LINE(5.1), r"the parameter must be in \[0, 5\]; it is \[5.1\]"),
    (lambda: LINE(-0.1), r"the parameter must be in \[0, 5\]"),
    (lambda: LINE(np.nan), "the parameter must be finite"),
    (lambda: LINE([[1.0]]), r"the parameter must have shape"),
    (lambda: LINE(1.0, side="up"), "side must be one of"),
    (lambda: LINE.derivative(1.0, -1), "order must be an integer"),
    (
        lambda: r1.curves.by_arc_length(r1.curves.ellipse_path([0, 1], [2, 0], [0, 1])).derivative(1.0, 4),
        "up to the third",
    ),
    (lambda: r1.curves.by_arc_length("line"), "path must be a path"),
    (lambda: r1.curves.CurveSequence(()), "pieces must be one curve or several"),
    (lambda: r1.curves.CurveSequence((LINE, r1.line_path([0, 0], [1, 1]))), "the same coordinates"),
    (lambda: r1.curves.stacked_path((1,)), "each of paths must be a path of points"),
    (lambda: r1.curves.stacked_path(()), "paths must be one path or several"),
    (lambda: r1.curves.stacked_path((LINE,), 0.0), "end must be a positive number"),
    (
        lambda: r1.curves.frenet_frame(r1.line_path(np.zeros(5), np.ones(5)), 0.0),
        "path of 2 or 3 coordinates; it has 5",
    ),
    (
        lambda: r1.curves.frenet_frame(r1.trajectories.spline_path([[0, 0], [1, 1], [2, 1]], bc_type="clamped"), 0.0),
        "no tangent at s = 0",
    ),
    (lambda: r1.curves.formula_path([s, "s^2"], s, 1.0), "a formula is made of numbers, names, pi"),
    (lambda: r1.curves.formula_path(["__import__('os')"], s, 1.0), "is none"),
    (lambda: r1.curves.formula_path(["s.evalf()"], s, 1.0), "is none"),
    (lambda: r1.curves.formula_path(["sin(s"], s, 1.0), "is none"),
    (lambda: r1.curves.formula_path(["sin(s, s, s)"], s, 1.0), "is none"),
    (lambda: r1.curves.formula_path(["1/0"], s, 1.0), "real and finite"),
    (lambda: r1.curves.formula_path([sympy.Function("f")(s)], s, 1.0), "has no numbers"),
    (lambda: r1.curves.formula_path(["True"], s, 1.0), "is none"),
    (lambda: r1.curves.formula_path("R*cos(s)", s, 1.0), "one for each coordinate"),
    (lambda: r1.curves.formula_path([s, None], s, 1.0), "a formula that is no SymPy expression must be"),
    (lambda: r1.curves.formula_path([], s, 1.0), "one for each coordinate; there is none"),
    (lambda: r1.curves.formula_path(3, s, 1.0), "one for each coordinate"),
    (lambda: r1.curves.formula_path([s * sympy.Symbol("R")], s, 1.0), "give the values of R, as values={'R': 1.0}"),
    (lambda: r1.curves.formula_path([s], s, -1.0), "end must be a positive number"),
    (lambda: r1.curves.formula_path([1 / s], s, 1.0), "no finite real number at s = 0"),
    (lambda: r1.curves.formula_path([sympy.sqrt(s - 1)], s, 1.0), "no finite real number"),
    (lambda: r1.curves.frenet_formulas(r1.curves.formula_path([s, 2 * s], s, 1.0)), "the path is a line"),
    (lambda: r1.curves.frenet_formulas(LINE), "takes a path of two or three formulas"),
]


@pytest.mark.parametrize(("call", "message"), MISUSE, ids=range(len(MISUSE)))
def test_misuse_of_paths_is_an_input_error(call, message):
    with pytest.raises(InputError, match=message):
        call()


@given(st.floats(-1e6, 1e6), st.floats(1e-3, 1e6))
@settings(max_examples=30)
def test_a_parameter_rounded_beyond_the_end_is_the_end(x, length):
    path = r1.line_path([x, 0], [x, length])
    assert path(path.end * (1 + 1e-12)) == pytest.approx([x, length])
    assert path(-1e-12 * path.end) == pytest.approx([x, 0], abs=1e-9 * length)
