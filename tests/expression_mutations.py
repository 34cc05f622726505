"""Changes at random of the expressions in a xacro text: operators, names, nested calls, whole expressions."""

import re

EXPRESSION = re.compile(r"\$\{([^}]*)\}|\$\((?:eval|arg|find) ([^)]*)\)")
OPERATOR = re.compile(r"(?<=[\w)\]' ])(\*\*|//|==|!=|&lt;=?|[-+*/%])(?=[\w(\[' ])| (and|or|in|if|else|not) ")
NAME = re.compile(r"\b[A-Za-z_]\w*\b")
OPERATORS = (
    "+",
    "-",
    "*",
    "/",
    "//",
    "%",
    "**",
    "==",
    "!=",
    "&lt;",
    "&gt;=",
    " and ",
    " or ",
    " in ",
    " if ",
    "@",
    ".",
    ",",
    ":=",
    "&lt;&lt;",
)
NAMES = (
    *("l1", "l2", "pi", "math", "xacro", "python", "None", "True", "x", "__class__", "eval", "open", "inf", "nan"),
    *("math.sin", "xacro.arg", "xacro.load_yaml", "python.type", "python.vars", "parent", "ｅval", "lambda", "for"),
)
CALLS = (
    *("sin({})", "str({})", "int({})", "float({})", "len({})", "list({})", "dict(a={})", "range({})", "round({}, 2)"),
    *("max({}, 1)", "math.sqrt({})", "math.factorial({})", "xacro.load_yaml({})", "xacro.fatal({})", "sorted([{}])"),
    *("({})", "-{}", "not {}", "[{}]", "[{}][0]", "({}).__class__", "'%s' % ({})", "'%999d' % ({})", "({}) * 1000000"),
    *(
        "({})**9**9",
        "[a for a in range({})]",
        "[{} for a in 'abc' if a]",
        "(lambda: {})()",
        "({} if {} else {})",
        "f'{}'",
    ),
    *(
        "'{}'",
        "{}.join(['a'])",
        "'a'.join({})",
        "map(str, {})",
        "{}[1:2]",
        "str({}).split('.')[0]",
        "{}{}",
        "(a := {})",
    ),
)
WHOLE = (
    *("${9**9**9}", "${'a' * 10**9}", "$(eval 1 +", "$(arg nothing)", "$(find nothing)", "$(env HOME)", "$$" + "{l1}"),
    *(
        "${[0] * 4000 * 4000}",
        "${",
        "${}",
        "${ }",
        "$(eval )",
        "${1}${2}",
        "${xacro}",
        "${().__class__}",
        "$(eval ${'1'})",
    ),
)


def _one(random, pattern, text, new):
    found = list(pattern.finditer(text))
    if not found:
        return text
    match = random.choice(found)
    return text[: match.start()] + new(match) + text[match.end() :]


def _inside(random, text, change):
    """Change what stands in one expression."""
    return _one(
        random,
        EXPRESSION,
        text,
        lambda match: match[0].replace(match[1] or match[2] or "$", change(match[1] or match[2] or "")),
    )


def change_operator(random, text):
    return _inside(random, text, lambda inner: _one(random, OPERATOR, inner, lambda _: random.choice(OPERATORS)))


def change_name(random, text):
    return _inside(random, text, lambda inner: _one(random, NAME, inner, lambda _: random.choice(NAMES)))


def nest_call(random, text):
    def nested(inner):
        for _ in range(random.choice((1, 1, 2, 5, 60))):
            inner = random.choice(CALLS).replace("{}", inner)[:3000]
        return inner

    return _inside(random, text, nested)


def join_expressions(random, text):
    parts = [match[1] or match[2] or "" for match in EXPRESSION.finditer(text)] or [""]
    return _inside(random, text, lambda inner: f"{inner}{random.choice(OPERATORS)}{random.choice(parts)}")


def repeat_expression(random, text):
    return _inside(random, text, lambda inner: random.choice(OPERATORS).join([inner] * random.choice((2, 3, 50, 2000))))


def replace_expression(random, text):
    return _one(random, EXPRESSION, text, lambda _: random.choice(WHOLE))


def change_form(random, text):
    """Turn ${...} into $(eval ...), and back."""
    return _one(random, EXPRESSION, text, lambda m: f"$(eval {m[1]})" if m[1] else f"${{{m[2]}}}")


EXPRESSION_CHANGES = (
    *(change_operator, change_name, nest_call, nest_call, join_expressions, repeat_expression, replace_expression),
    change_form,
)
RICH = """\
<robot name="$(arg name)" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="name" default="rich"/><xacro:arg name="n" default="3"/><xacro:arg name="l" default="0.5"/>
<xacro:property name="l" value="$(arg l)"/><xacro:property name="n" value="$(arg n)"/>
<xacro:property name="table" value="${dict(a=[l, 2*l, l**2], word='right' if l &gt; 0 else 'left')}"/>
<xacro:property name="half"><origin xyz="${l/2} 0 ${sin(pi/6) * l}" rpy="0 ${radians(30)} 0"/></xacro:property>
<xacro:macro name="part" params="i parent:=base size:=^|0.1 *place">
  <link name="link${i}"><visual><geometry><box size="${size} ${size*2} ${max(size, 0.01)}"/></geometry></visual></link>
  <joint name="q${i}" type="${'revolute' if i % 2 else 'prismatic'}">
    <parent link="${parent}"/><child link="link${i}"/><xacro:insert_block name="place"/>
    <axis xyz="${[0, 0, 1][0]} ${table.a[0] * 0} ${int(i == i)}"/>
    <limit lower="${-table['a'][1]}" upper="${round(pi/2, 3)}" velocity="${len('abc')}" effort="$(eval 2*n + 1)"/>
  </joint>
  <xacro:if value="${i &lt; n and not i == 0}">
    <xacro:part i="${i + 1}" parent="link${i}" size="${size/2}"><xacro:insert_block name="half"/></xacro:part>
  </xacro:if>
</xacro:macro>
<link name="base"/>
<xacro:part i="${1}" size="${'%.2f' % l}"><origin xyz="${' '.join([str(x) for x in table.a])}"/></xacro:part>
<xacro:unless value="$(eval n == 0)"><gazebo text="${table.word.upper()}"/></xacro:unless>
</robot>
"""
