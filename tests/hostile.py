"""Hostile xacro files, each with the reason for which it is refused; hostile_child.py reads them."""

from typing import NamedTuple
from xml.sax.saxutils import quoteattr

HARMLESS = None
CANARY = "canary"  # a file that the code in the cases would write


class Case(NamedTuple):
    name: str
    reason: str | None  # a pattern of the message with which it is refused
    head: str = ""  # of the robot
    value: str = "0"  # of a number of the robot
    link: str = "tool"  # the name of one
    robot: str = "arm"  # its own name


CODE = f'open("{CANARY}", "w")'
SHELL = f"__import__('os').system('touch {CANARY}')"


def prop(name: str, value: str) -> str:
    return f'<xacro:property name="{name}" value="{value}"/>'


def doubled(times: int, start: str = "'x'") -> str:
    """Properties each of which is ten times the one before."""
    first = prop("p0", "${" + start + "}")
    return first + "".join(prop(f"p{i}", "${" + " + ".join([f"p{i - 1}"] * 10) + "}") for i in range(1, times + 1))


def in_text(times: int) -> str:
    first = prop("p0", "x")
    return first + "".join(prop(f"p{i}", f"${{p{i - 1}}}" * 10) for i in range(1, times + 1))


def macros(levels: int, body: str = "<gazebo/>") -> str:
    first = f'<xacro:macro name="m0" params="">{body}</xacro:macro>'
    calls = (f"<xacro:m{i - 1}/>" * 10 for i in range(1, levels + 1))
    return first + "".join(
        f'<xacro:macro name="m{i}" params="">{call}</xacro:macro>' for i, call in enumerate(calls, 1)
    )


UNDEFINED = "is not defined"
NO_DICTIONARY = "which is no dictionary"
LARGE = "it is too large"
OUT = "out of the file's own folder and the packages"
NO_COMMAND = "Unknown substitution command"

EXPRESSIONS = [
    # --- code: names and what stands behind them
    ("eval by name", "eval('1')", UNDEFINED),
    ("exec by name", f"exec({CODE!r})", UNDEFINED),
    ("open by name", "open('/etc/passwd').read()", UNDEFINED),
    ("import by name", SHELL, UNDEFINED),
    ("compile by name", "compile('1', 'a', 'eval')", UNDEFINED),
    ("getattr by name", "getattr(1, 'real')", UNDEFINED),
    ("globals by name", "globals()", UNDEFINED),
    ("builtins by name", "__builtins__", UNDEFINED),
    ("type by name", "python.type(1)", UNDEFINED),
    ("vars by name", "python.vars(xacro)", UNDEFINED),
    ("the chain through vars and type", "python.vars(python.type(xacro.message))", UNDEFINED),
    ("fullwidth letters for eval", "ｅｖａｌ('1')", UNDEFINED),
    ("mathematical letters for open", "𝐨𝐩𝐞𝐧('/etc/passwd')", UNDEFINED),
    ("a ligature in an attribute", "().__class__.__deﬁne__", NO_DICTIONARY),
    ("fullwidth letters in an attribute", "().ｃlass", NO_DICTIONARY),
    ("the class of a tuple", "().__class__", NO_DICTIONARY),
    ("the subclasses of object", "().__class__.__base__.__subclasses__()", NO_DICTIONARY),
    ("the class of a text", "''.__class__.__mro__[1]", NO_DICTIONARY),
    ("the class of a number", "(1).__class__", NO_DICTIONARY),
    ("the globals of a function", "math.sin.__globals__", NO_DICTIONARY),
    ("the globals of a function of xacro", "xacro.load_yaml.__globals__", NO_DICTIONARY),
    ("the self of a method", "math.sin.__self__", NO_DICTIONARY),
    ("a method's function", "'a'.join.__func__", NO_DICTIONARY),
    ("the class of a namespace", "xacro.__class__", UNDEFINED),
    ("the dictionary of a namespace", "xacro.__dict__", UNDEFINED),
    ("the parent of a namespace", "math.parent", UNDEFINED),
    ("methods of a namespace", "xacro.update(dict(a=1))", UNDEFINED),
    ("a namespace as a value", "xacro", "is a function or a namespace, and no value"),
    ("a namespace as an argument", "str(xacro)", "uses a namespace as a value"),
    ("a namespace in a list", "[math]", "is no type of value"),
    ("a function as a value", "math.sin", "is a function or a namespace, and no value"),
    ("a function in a text", "'%s' % len", "is a function or a namespace, and no value"),
    ("a type by a trick", "[c for c in [str]][0].mro()", "function is no type of value"),
    ("mutation of a list", "[1].append(2)", NO_DICTIONARY),
    ("mutation of a dictionary", "dict(a=1).update(b=2)", UNDEFINED),
    ("a method of a dictionary that is none", "dict(a=1).__class__", UNDEFINED),
    # --- code: syntax
    ("a lambda", "(lambda: 1)()", "it has a lambda"),
    ("a lambda as an argument", "list(map(lambda x: x.__class__, [1]))", "it has a lambda"),
    ("an assignment", "(a := 1)", "it has an assignment"),
    ("a statement", "import os", "invalid syntax"),
    ("two statements", "1; import os", "invalid syntax"),
    ("two lines", "1\n__import__('os')", "invalid syntax"),
    ("an await", "(await x)", "it has Await"),
    ("a yield", "(yield 1)", "it has Yield"),
    ("bytes", "b'a'", "bytes is no type of value"),
    ("an ellipsis", "...", "ellipsis is no type of value"),
    ("a complex number", "1j", "complex is no type of value"),
    ("a complex power", "(-8)**0.5", "complex is no type of value"),
    ("a matrix product", "[1] @ [2]", "it has the operator MatMult"),
    ("a shift", "1 << 10", "it has the operator LShift"),
    ("a comprehension's variable that is an attribute", "[1 for xacro.arg in [1]]", "something else than names"),
    ("classes in a comprehension", "[a.__class__ for a in [1]]", NO_DICTIONARY),
    ("a generator's frame", "(a for a in [1]).gi_frame", NO_DICTIONARY),
    ("an asynchronous comprehension", "[x async for x in [1]]", "asynchronous"),
    ("the format method", "'%s'.format(1)", NO_DICTIONARY),
    ("the format_map method", "'a'.format_map(dict())", NO_DICTIONARY),
    ("the encode method", "'a'.encode('rot13')", NO_DICTIONARY),
    ("a name that a sum builds", "xacro['load' + '_yaml']", "is a function or a namespace, and no value"),
    ("a key that a sum builds", "dict(a=1)['__cl' + 'ass__']", "there is no entry"),
    ("a call of a text", "'eval'('1')", "is no function"),
    ("sorting by a foreign function", "sorted([1], key='a'.__class__)", NO_DICTIONARY),
    # --- sizes
    ("a tower of powers", "9**9**9**9", LARGE),
    ("a large power", "10**100000", LARGE),
    ("a power of a power", "((2**4000)**4000)", LARGE),
    ("a large product", "2**4000 * 2**4000", LARGE),
    ("a sum of texts", "'a' * 1000000000", LARGE),
    ("a text times a text's length", "1000000000 * 'a'", LARGE),
    ("a list many times", "[0] * 1000000000", LARGE),
    ("lists in lists", "[[[[[[[0]*99]*99]*99]*99]*99]*99]", LARGE),
    ("a wide number", "'%1000000000d' % 1", "at most 99 wide"),
    ("a wide number by a star", "'%*d' % (1000000000, 1)", "at most 99 wide"),
    ("many decimals", "'%.1000000000f' % 1", "at most 99 wide"),
    ("a wide entry", "'%(a)1000000000s' % dict(a=1)", "at most 99 wide"),
    ("a wide entry of an odd name", "'%(a(b)c)1000000000s' % dict(a=1)", "at most 99 wide"),
    ("many places", "('%(a)s' * 10000) % dict(a='a' * 90000)", LARGE),
    ("a long range", "list(range(1000000000))", LARGE),
    ("an endless range", "len(range(10**30))", "too large"),
    ("nested loops", "[0 for a in range(9999) for b in range(9999) for c in range(9999) if 0]", LARGE),
    ("a sum of a long loop", "python.sum([1 for a in range(9999) for b in range(9999)])", LARGE),
    ("a joined text", "('a' * 90000).join(['b'] * 9000)", LARGE),
    ("a replaced text", "('a' * 90000).replace('a', 'b' * 90000)", LARGE),
    ("a replaced emptiness", "('a' * 90000).replace('', 'b' * 90000)", LARGE),
    ("a filled text", "'1'.zfill(1000000000)", LARGE),
    ("a padded text", "'1'.ljust(1000000000)", NO_DICTIONARY),
    ("tabs", "'\t'.expandtabs(1000000000)", NO_DICTIONARY),
    ("a number rounded to many digits", "round(5, -1000000000)", LARGE),
    ("a factorial", "math.factorial(1000000)", UNDEFINED),
    ("combinations", "math.comb(1000000, 500000)", UNDEFINED),
    ("a product of a list", "math.prod([2**4000] * 9000)", UNDEFINED),
    ("all pairs", "list(python.zip(*[range(9000)] * 9000))", LARGE),
    ("a number of many digits", "9" * 4000, LARGE),
    ("a number of very many digits", "9" * 4900, "Exceeds the limit"),
    ("a long expression", "1 + " * 2000 + "1", LARGE),
    ("nested brackets", "(" * 2000 + "1" + ")" * 2000, "too many nested|too large|recursion|nested"),
    ("nested lists", "[" * 190 + "]" * 190, HARMLESS),
    ("nested minuses", "-" * 4900 + "1", "recursion|nested|memory|stack|too"),
    ("nested nots", "not " * 1200 + "1", "recursion|nested|memory|stack|too"),
    ("a chain of dots", "xacro" + ".a" * 2400, "recursion|nested|" + UNDEFINED),
    ("a chain of calls", "str" + "()" * 2400, "recursion|nested|is no function|too"),
    ("a long sum", "1" + "+1" * 2400, "recursion|nested|too"),
    ("a table of equal hashes", "len(dict([(i * (2**61 - 1), 0) for i in range(9000)]))", LARGE),
    ("characters of a pattern", "xacro.tokenize('a' * 30 + '!', sep=']+(a+)+$[')", HARMLESS),
    ("a message", "xacro.error('\x9b31m', '[bold]')", HARMLESS),
]

OTHERS = [
    # --- code: the ways into an expression
    Case(
        "code as a property that an eval reads",
        UNDEFINED,
        prop("c", "${'exec(&quot;1&quot;, dict())'}"),
        link="a$(eval ${c})",
    ),
    Case("code of two properties", UNDEFINED, prop("a", "op") + prop("b", "en"), "$(eval ${a + b})"),
    Case("code in an eval", UNDEFINED, value="$(eval open)"),
    Case("double underscores in an eval", NO_DICTIONARY, value="$(eval sin.__self__)"),
    Case("code in an argument's default", UNDEFINED, '<xacro:arg name="a" default="${open(1)}"/>'),
    Case(
        "code in an argument that an eval reads",
        "no value",
        '<xacro:arg name="a" default="sin"/>' + prop("a", "$(arg a)"),
        "$(eval ${a})",
    ),
    Case("code in a condition", UNDEFINED, '<xacro:if value="${open(1)}"/>'),
    Case("code in the condition of an eval", UNDEFINED, '<xacro:unless value="$(eval open == 1)"/>'),
    Case("code in a macro's default", UNDEFINED, '<xacro:macro name="m" params="a:=${open(1)}"/><xacro:m/>'),
    Case("code in a macro's parameter", UNDEFINED, '<xacro:macro name="m" params="a"/><xacro:m a="${open(1)}"/>'),
    Case("code in the name of a called macro", UNDEFINED, '<xacro:call macro="${open(1)}"/>'),
    Case("code in the name of a block", "Undefined block", '<xacro:insert_block name="${open(1)}"/>'),
    Case("code in the name of a property", UNDEFINED, '<xacro:property name="${open(1)}" value="1"/>'),
    Case("code in a lazy property", UNDEFINED, prop("a", "${open(1)}"), "${a}"),
    Case(
        "code in a property that is not lazy",
        UNDEFINED,
        '<xacro:property name="a" value="${open(1)}" lazy_eval="false"/>',
    ),
    Case("code in lazy_eval", UNDEFINED, '<xacro:property name="a" value="1" lazy_eval="${open(1)}"/>'),
    Case("code in remove", UNDEFINED, '<xacro:property name="a" remove="${open(1)}"/>'),
    Case("code in an element's name", UNDEFINED, '<xacro:element xacro:name="${open(1)}"/>'),
    Case("code in an attribute's name", UNDEFINED, '<gazebo><xacro:attribute name="${open(1)}" value="1"/></gazebo>'),
    Case("code in a text", UNDEFINED, "<gazebo>${open(1)}</gazebo>"),
    Case("code in a comment", UNDEFINED, "<!-- xacro:eval-comments:on --><!-- ${open(1)} -->"),
    Case("code in a namespace's name", UNDEFINED, '<xacro:include filename="part.xacro" ns="${open(1)}"/>'),
    Case("code in the name of an included file", UNDEFINED, '<xacro:include filename="${open(1)}"/>'),
    Case("code in the robot's name", UNDEFINED, robot="${open(1)}"),
    Case("code in a package's name", UNDEFINED, value="$(find ${open})"),
    Case("code in an included file", UNDEFINED, '<xacro:include filename="code.xacro"/>'),
    Case("code in a unit of YAML", UNDEFINED, value="${load_yaml('unit.yaml').a}"),
    Case("a Python object in YAML", "could not determine a constructor", value="${load_yaml('object.yaml').a}"),
    Case("a property named as a builtin", HARMLESS, prop("eval", "1") + prop("open", "2"), "${eval + open}"),
    Case("a property with two underscores", "must not start with double underscore", prop("__builtins__", "1")),
    Case("a property that is no name", "must be valid python identifiers", prop("a.b", "1")),
    Case("a property that hides xacro", NO_DICTIONARY, prop("xacro", "1"), "${xacro.load_yaml('x')}"),
    Case("a macro named call", "Invalid use of macro name", '<xacro:macro name="call" params=""/>'),
    Case("a macro with two underscores", HARMLESS, '<xacro:macro name="__class__" params=""/><xacro:__class__/>'),
    Case("a macro of a namespace that is none", "cannot expand it", prop("a", "1") + "<xacro:a.b.c/>"),
    Case("a parameter with two underscores", HARMLESS, '<xacro:macro name="m" params="__builtins__:=1"/><xacro:m/>'),
    # --- files and the environment
    Case("an environment variable", "reads this computer", value="$(env HOME)"),
    Case("an environment variable or a default", "reads this computer", value="$(optenv HOME 1)"),
    Case("the environment in an eval", UNDEFINED, value="$(eval environ)"),
    Case("the working folder", "reads this computer", link="$(cwd)"),
    Case("an unknown command", NO_COMMAND, value="$(anon a)"),
    Case("an include of an absolute path", f"is an absolute path {OUT}", '<xacro:include filename="/etc/passwd"/>'),
    Case("an include by ..", f"leads by '..' {OUT}", '<xacro:include filename="../secret.xacro"/>'),
    Case("an include far by ..", f"leads by '..' {OUT}", f'<xacro:include filename="{"../" * 30}etc/passwd"/>'),
    Case("an include down and up", f"leads by '..' {OUT}", '<xacro:include filename="sub/../../secret.xacro"/>'),
    Case("an include of a link", f"is a symbolic link that leads {OUT}", '<xacro:include filename="link.xacro"/>'),
    Case("an include through a link", f"link that leads {OUT}", '<xacro:include filename="linked/secret.xacro"/>'),
    Case("an include by a link and ..", OUT, '<xacro:include filename="linked/../secret.xacro"/>'),
    Case("an include by file://", "begins with file:/", '<xacro:include filename="file:///etc/passwd"/>'),
    Case("an include by http://", "begins with http:/", '<xacro:include filename="http://127.0.0.1/a.xacro"/>'),
    Case("an include by https://", "begins with https:/", '<xacro:include filename="https://127.0.0.1/a.xacro"/>'),
    Case(
        "an include of a package above",
        "in none of the folders",
        '<xacro:include filename="package://../secret.xacro"/>',
    ),
    Case(
        "an include by package and ..",
        f"leads by '..' {OUT}",
        '<xacro:include filename="package://robot/../secret.xacro"/>',
    ),
    Case("an optional include outside", OUT, '<xacro:include filename="/etc/passwd" optional="true"/>'),
    Case("an include of a pattern outside", OUT, '<xacro:include filename="/etc/*"/>'),
    Case("an include of a pattern by ..", f"leads by '..' {OUT}", '<xacro:include filename="../*.xacro"/>'),
    Case("an include of a pattern that meets a link", OUT, '<xacro:include filename="l*.xacro"/>'),
    Case("an include of a pattern of folders", "in the name of a folder", '<xacro:include filename="/*/*/*/*"/>'),
    Case("an include of a pipe", "no file, but a folder or a device", '<xacro:include filename="pipe"/>'),
    Case("an include of a folder", "no file, but a folder or a device", '<xacro:include filename="sub"/>'),
    Case("an include of a device", OUT, '<xacro:include filename="/dev/zero"/>'),
    Case("an include of a name with a null", "cannot expand it", "<xacro:include filename=\"${'%c' % 0}\"/>"),
    Case("an include of a very long name", "cannot expand it|too long", f'<xacro:include filename="{"a" * 9000}"/>'),
    Case("an include of a loop of links", "cannot expand it", '<xacro:include filename="round.xacro"/>'),
    Case("a package of the system", "in none of the folders", value="$(find etc)"),
    Case("a package by ..", "in none of the folders", value="$(find ..)"),
    Case("a package by a path", "in none of the folders", value="$(find /etc)"),
    Case("a package by a path in parts", "in none of the folders", value="$(find robot/..)"),
    Case(
        "a far folder that is no package",
        "in none of the folders",
        '<xacro:include filename="$(find outside)/secret.xacro"/>',
    ),
    Case("YAML by an absolute path", f"is an absolute path {OUT}", value="${load_yaml('/etc/passwd')}"),
    Case("YAML by ..", f"leads by '..' {OUT}", value="${xacro.load_yaml('../secret.yaml').secret}"),
    Case("YAML of a link", f"link that leads {OUT}", value="${xacro.load_yaml('link.yaml').secret}"),
    Case("YAML by file://", "begins with file:/", value="${xacro.load_yaml('file:///etc/passwd')}"),
    Case("a YAML that is missing", "No such file", value="${xacro.load_yaml('nothing.yaml')}"),
    Case("an external entity", "DOCTYPE", '<xacro:include filename="entity.xacro"/>'),
    Case("an external stylesheet", HARMLESS, '<?xml-stylesheet href="http://127.0.0.1/a"?>'),
    # --- sizes
    Case("texts ten times as long, nine times", LARGE, doubled(9), "${p9}"),
    Case("texts ten times as long in a name", LARGE, in_text(9), link="${p9}"),
    Case(
        "numbers squared again and again",
        LARGE,
        prop("p0", "10") + "".join(prop(f"p{i}", f"${{p{i - 1}**2}}") for i in range(1, 40)),
        "${p39}",
    ),
    Case(
        "lists in lists by properties",
        LARGE,
        prop("p0", "${[0]}") + "".join(prop(f"p{i}", f"${{[{', '.join([f'p{i - 1}'] * 10)}]}}") for i in range(1, 10)),
        "${len(p9)}",
    ),
    Case("macros that call ten each, nine deep", LARGE, macros(9) + "<xacro:m9/>"),
    Case("macros with nothing in them", LARGE, macros(9, "") + "<xacro:m9/>"),
    Case(
        "a macro that calls itself",
        "is it a recursion|recursion",
        '<xacro:macro name="m" params=""><xacro:m/></xacro:macro><xacro:m/>',
    ),
    Case(
        "two macros that call each other",
        "recursion",
        "".join(f'<xacro:macro name="{a}" params=""><xacro:{b}/></xacro:macro>' for a, b in ("ab", "ba"))
        + "<xacro:a/>",
    ),
    Case(
        "a macro that defines itself anew",
        HARMLESS,
        '<xacro:macro name="m" params=""><xacro:macro name="m" params=""/></xacro:macro><xacro:m/><xacro:m/>',
    ),
    Case(
        "a block in itself",
        "recursion|Undefined|Not enough|circular",
        '<xacro:property name="b"><xacro:insert_block name="b"/></xacro:property><xacro:insert_block name="b"/>',
    ),
    Case("a property of itself", "circular", prop("a", "${a}"), "${a}"),
    Case("an argument of itself", "is not declared|recursion", '<xacro:arg name="a" default="$(arg a)"/>', "$(arg a)"),
    Case(
        "properties in a long chain",
        HARMLESS,
        prop("p0", "1") + "".join(prop(f"p{i}", f"${{p{i - 1}}}") for i in range(1, 60)),
        "${p59}",
    ),
    Case(
        "properties in a very long chain",
        "recursion",
        prop("p0", "1") + "".join(prop(f"p{i}", f"${{p{i - 1}}}") for i in range(1, 900)),
        "${p899}",
    ),
    Case(
        "an error below many properties",
        "cannot expand it",
        "".join(prop(f"p{i}", f"${{p{i - 1}}}") for i in range(1, 900)),
        "${p899}",
    ),
    Case("a file that includes itself", "include each other", '<xacro:include filename="self.xacro"/>'),
    Case("a file that includes itself twice", "include each other|" + LARGE, '<xacro:include filename="twice.xacro"/>'),
    Case("many includes", LARGE, '<xacro:include filename="part.xacro"/>' * 600),
    Case("YAML aliases ten times, nine deep", LARGE, value="${len(load_yaml('bomb.yaml').i)}"),
    Case("a YAML nested deeply", "recursion|" + LARGE, value="${load_yaml('deep.yaml')}"),
    Case("a large YAML", LARGE, value="${load_yaml('large.yaml')}"),
    Case("many YAML files", LARGE, value="${[load_yaml('list.yaml') for a in range(5000)]}"),
    Case("a large text in many places", LARGE, prop("p", "${'a' * 99999}") + "<gazebo>${p}</gazebo>" * 900),
    Case(
        "a macro's pattern without end",
        "cannot expand it|Undefined",
        f"<xacro:macro name='m' params='a:={'x' * 60}&quot;'/><xacro:m/>",
    ),
    Case(
        "a macro of many parameters",
        HARMLESS,
        f'<xacro:macro name="m" params="{" ".join(f"a{i}:=1" for i in range(900))}"/><xacro:m/>',
    ),
    Case("many properties", LARGE + "|" + "elements", prop("a", "1") * 40_000),
    Case("many comments", LARGE, "<!---->" * 300_000),
    Case(
        "copies of elements with many attributes",
        LARGE,
        '<xacro:macro name="m" params=""><xacro:macro name="n" params="">'
        + f"<a {' '.join(f'a{i}=_1_' for i in range(90))}/>".replace("_", '"') * 100
        + "</xacro:macro></xacro:macro>"
        + "<xacro:m/>" * 900,
    ),
    Case("many pieces of a text", LARGE, f"<gazebo>{'$a' * 300_000}</gazebo>"),
    # --- names
    Case("a name with markup", HARMLESS, link="[bold red][/x]"),
    Case("a name with ANSI", HARMLESS, link="\x9b31m"),
    Case("a name with an escape", "cannot expand it|not well-formed", link="${'%c' % 27}[31m"),
    Case("a name with a null", "cannot expand it|not well-formed", link="${'%c' % 0}"),
    Case("a name that turns the direction", HARMLESS, link="\u202ecba"),
    Case("a name with a surrogate", HARMLESS, link="${'%c' % 55296}"),
    Case("a name with HTML", HARMLESS, link="&lt;script&gt;alert(1)&lt;/script&gt;"),
    Case("a name that closes a docstring", HARMLESS, robot="&quot;&quot;&quot;; import os"),
    Case("a name with attributes", HARMLESS, link="${'a' + chr}".replace(" + chr", "") + "&quot; b=&quot;c"),
    Case(
        "an attribute with an angle bracket",
        "not well-formed|cannot expand it",
        '<gazebo><xacro:attribute name="a=&quot;1&quot;&gt;&lt;link name=&quot;b" value="1"/></gazebo>',
    ),
]


def cases() -> list[Case]:
    """Each expression stands in ${...}, and also in a text that $(eval ...) evaluates."""
    found = []
    for name, expression, reason in EXPRESSIONS:
        value = quoteattr(f"${{{expression}}}")[1:-1].replace('"', "&quot;")
        found.append(Case(name, reason, value=value))
        if "\n" not in expression and len(expression) < 1000:
            code = quoteattr(f"${{{expression!r}}}")[1:-1].replace('"', "&quot;")
            anywhere = reason and f"{reason}|{UNDEFINED}|cannot expand it"  # an eval has fewer names
            anywhere = f"{reason}|{UNDEFINED}" if "xacro." in expression else anywhere
            found.append(Case(f"{name}, in an eval", anywhere, prop("c", code), "$(eval ${c})"))
    return found + OTHERS


def text(case: Case) -> str:
    return f"""<robot name="{case.robot}" xmlns:xacro="http://www.ros.org/wiki/xacro">{case.head}
<link name="base"/><link name="{case.link}"/>
<joint name="q1" type="revolute"><parent link="base"/><child link="{case.link}"/><origin xyz="0 0 0"/>
<axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="1" effort="1"/></joint>
<gazebo value="{case.value}"/></robot>"""
