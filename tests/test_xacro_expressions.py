"""Expressions of xacro files have the value that Python gives them."""

import math

import pytest
from hypothesis import given, strategies as st

from robotics1 import RobotFileError, load_robot

ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">{head}
<link name="base"/><link name="tip"/>
<joint name="[{value}]" type="fixed"><parent link="base"/><child link="tip"/></joint></robot>"""


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return a function that gives what is written for a text of a xacro file."""
    folder = tmp_path_factory.mktemp("expressions")

    def value(text, head="", parameters=None):
        path = folder / "arm.xacro"
        escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
        path.write_text(ARM.format(head=head, value=escaped), encoding="utf-8")
        urdf = load_robot(path, parameters=parameters).urdf
        found = urdf.partition('<joint name="[')[2].partition(']" type="')[0]
        return found.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")

    return value


NAMES = {"pi": math.pi, "l": 0.5, "n": 7, "word": "left", "table": {"a": [1, 2, {"b": "c"}], "k": 3}} | vars(math)
HEAD = "".join(
    f'<xacro:property name="{name}" value="{value}"/>'
    for name, value in (("l", "0.5"), ("n", "7"), ("word", "left"), ("table", "${dict(a=[1, 2, dict(b='c')], k=3)}"))
)


@pytest.mark.parametrize(
    "expression",
    [
        *("1 + 2*3 - 4/5", "7 // 2", "-7 % 3", "2**10", "2**-1", "-l", "+l", "n & 3 | 8 ^ 1", "1e3", "0x1f", "1_000"),
        *("l < n", "l < n < 3", "1 == 1.0 != 2", "n >= 7 and l or 3", "not l", "0 or ''", "n is None", "2 in [1, 2]"),
        *("'a' not in word", "l if n > 3 else -l", "'a' + 'b' * 3", "word[1:3]", "word[-1]", "word[::-1]", "(1, 2)[1]"),
        *("[1, *[2, 3]]", "(1,)", "[[1, 2], [3]][0][1]", "table['a'][2]['b']", "len(table)", "[i*i for i in range(4)]"),
        *("[(i, j) for i in range(3) for j in range(i) if i + j]", "[a for a, b in [(1, 2), (3, 4)]]", "len('abc')"),
        *("max(1, 2.5)", "min([3, 1, 2])", "max([], default=4)", "round(2.567, 1)", "int('12')", "float('1.5')"),
        *("str(1.5) + 'm'", "bool('')", "list('ab')", "dict(a=1)['a']", "sorted([3, 1, 2], reverse=True)", "int(3.9)"),
        *(
            "list(map(float, '1 2'.split()))",
            "sin(l)",
            "cos(pi)",
            "atan2(1, 2)",
            "sqrt(2)",
            "radians(90)",
            "degrees(pi)",
        ),
        *("hypot(3, 4)", "floor(-1.5)", "ceil(1.2)", "fabs(-2)", "exp(1)", "log(10)", "log10(1000)", "pow(2, 3)", "e"),
        *("word.upper()", "' a '.strip()", "'a,b'.split(',')", "'-'.join(['a', 'b'])", "word.replace('l', 'L')"),
        *("word.startswith('le')", "word.endswith('x')", "word.find('f')", "'7'.zfill(3)", "'a-b'.partition('-')"),
        *("'%s_%d' % (word, n)", "'%.3f' % pi", "'%5.1f|%-4s|' % (l, 'a')", "'%(a)s%%' % dict(a=1)", "'link%02d' % n"),
        *("table.get('z', 5)", "[v for k, v in table.items()][1]", "list(table.keys())", "None", "True", "'é'"),
    ],
)
def test_an_expression_has_the_value_that_python_gives_it(written, expression):
    assert written(f"${{{expression}}}", HEAD) == str(eval(expression, dict(NAMES)))


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        *(("math.pi", math.pi), ("math.sin(1)", math.sin(1)), ("python.abs(-3)", 3), ("python.len([1])", 1)),
        *(("python.sum([1, 2.5])", 3.5), ("python.any([0, 1])", True), ("python.all([0, 1])", False)),
        *(("python.list(python.range(3))", [0, 1, 2]), ("python.isinstance('a', str)", True)),
        *(("python.isinstance(1, python.float)", False), ("python.reversed([1, 2])", [2, 1])),
        *(("python.zip([1], [2])", [(1, 2)]), ("python.enumerate('a')", [(0, "a")]), ("python.divmod(7, 2)", (3, 1))),
        *(("table.a[2].b", "c"), ("xacro.tokenize('1 2;3')", ["1", "2", "3"]), ("xacro.message('x') + 'y'", "y")),
        *(("python.filter(None, [0, 1])", [1]), ("python.tuple([1])", (1,)), ("xacro.arg('a')", "0.5")),
    ],
)
def test_xacros_own_names_stand_behind_a_prefix(written, expression, value):
    assert written(f"${{{expression}}}", HEAD + '<xacro:arg name="a" default="0.5"/>') == str(value)


@pytest.mark.parametrize(
    ("command", "value"),
    [
        *(
            ("$(eval 2*a)", "1.0"),
            ("$(eval a == 0.5)", "True"),
            ("$(eval 'x' + word)", "xleft"),
            ("$(eval on)", "True"),
        ),
        *(
            ("$(eval n // 2)", "3"),
            ("$(eval true and not false)", "True"),
            ("$(arg a)m", "0.5m"),
            ("$(eval pi)", str(math.pi)),
        ),
        *(
            ("$5", "$5"),
            ("a$", "a$"),
            ("${'$(arg word)' + 'x'}", "leftx"),
        ),
        *(("${'a'}${'b'}", "ab"), ("$(eval ${'a' + '+ 1'})", "1.5"), ("${1}.${2}", "1.2"), ("x ${None} y", "x None y")),
    ],
)
def test_commands_and_texts(written, command, value):
    head = "".join(
        f'<xacro:arg name="{name}" default="{default}"/>'
        for name, default in (("a", "0.5"), ("n", "7"), ("word", "left"), ("on", "true"))
    )
    assert written(command, head) == value


numbers = st.one_of(st.integers(-99, 99), st.floats(-99, 99, allow_nan=False).map(lambda value: round(value, 3)))
SIGNS = ["+", "-", "*", "/", "//", "%", "**", "<", "<=", "==", "!=", "and", "or"]
expressions = st.recursive(
    st.one_of(numbers.map(lambda number: f"({number!r})"), st.sampled_from(["l", "n", "pi"])),
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(SIGNS), inner).map(lambda parts: f"({' '.join(parts)})"),
        st.tuples(st.sampled_from(["-", "+", "not "]), inner).map(lambda parts: f"({''.join(parts)})"),
        st.tuples(inner, inner, inner).map(lambda parts: "({} if {} else {})".format(*parts)),
        st.tuples(st.sampled_from(["sin", "cos", "fabs", "sqrt", "abs_", "int", "float", "str"]), inner).map(
            lambda parts: f"{parts[0].replace('abs_', 'python.abs')}({parts[1]})"
        ),
        st.lists(inner, min_size=1, max_size=3).map(lambda parts: f"max([{', '.join(parts)}])"),
    ),
    max_leaves=12,
)


class Python:
    abs = staticmethod(abs)


@given(expressions)
def test_a_drawn_expression_has_the_value_that_python_gives_it(written, expression):
    try:
        value = eval(expression, NAMES | {"python": Python})
        too_large = isinstance(value, int) and value.bit_length() > 4000
        expected = None if too_large or isinstance(value, complex) else str(value)
    except (ArithmeticError, ValueError, TypeError):
        expected = None
    if expected is None:
        with pytest.raises(RobotFileError):
            written(f"${{{expression}}}", HEAD)
    else:
        assert written(f"${{{expression}}}", HEAD) == expected
