"""Inverse formulas as source: Python, C, MATLAB and LaTeX. Each joint with two formulas is a loop over both."""

import re
from collections.abc import Callable
from typing import TYPE_CHECKING

import sympy
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.octave import OctaveCodePrinter

from robotics1.ik.closed_form.named_parts import in_named_parts
from robotics1.names import printable
from robotics1.symbolic.writing.decimals import lengths_in
from robotics1.symbolic.writing.printing import latex_text
from robotics1.symbolic.writing.source_code import INDENT, MATLAB_WORDS, USED, c_printer, identifier, spelled

if TYPE_CHECKING:
    from robotics1.ik.closed_form.family import IKFormulas

C_WORDS = {
    *("auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern"),
    *("float", "for", "goto", "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed"),
    *("sizeof", "static", "struct", "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "main"),
    *("isfinite", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "fabs", "pow", "exp", "log"),
    *("y0", "y1", "yn", "j0", "j1", "jn", "gamma", "found"),
}
CONSISTENT = "1e-05"  # [m or 1]: how far a target may be from one that a task with more rows than joints can have
REAL_ONLY = {"sqrt": "real_sqrt", "acos": "real_acos", "asin": "real_asin"}


def python_source(formulas: "IKFormulas", name: str) -> str:
    """Return the source of a function in Python: target's numbers and lengths → the solutions, (k, n)."""
    target, joints = [s.name for s in formulas.target], [q.name for q in formulas.in_order.values()]
    names = spelled(formulas.robot.parameters, {*target, *joints, *USED, "solutions", "target", name})
    printer = NumPyPrinter()

    def write(e: sympy.Expr) -> str:
        return re.sub(r"\bnumpy\.", "np.", printer.doprint(_renamed(e, names)))

    given = [f"{names[key]}={value!r}" for key, value in formulas.robot.parameters.items()]
    taking = ", ".join(["target", *(["*", *given] if given else [])])
    shown = ", ".join(printable(joint).replace("\\", "/").replace('"', "'") for joint in formulas.in_order)
    lines = [
        "import numpy as np",
        "",
        "",
        f"def {name}({taking}):",
        f'{INDENT}"""Return the solutions, (k, {len(joints)}): {shown}."""',
        f"{INDENT}{', '.join(target)}{',' if len(target) == 1 else ''} = map(np.float64, target)",
        f"{INDENT}solutions = []",
        f'{INDENT}with np.errstate(all="ignore"):',
    ]
    for e in formulas.constraints:
        lines.append(f"{2 * INDENT}if not abs({write(e)}) <= {CONSISTENT}:  # no joints have such a target")
        lines.append(f"{3 * INDENT}return np.empty((0, {len(joints)}))")
    depth, body = _loops(
        formulas, write, 2, lambda q, both: f"for {q} in ({', '.join(both)}):", lambda q, e: f"{q} = {e}"
    )
    lines += body
    indent = INDENT * depth
    lines += [f"{indent}if np.isfinite([{', '.join(joints)}]).all():"]
    lines += [f"{indent}{INDENT}solutions.append([{', '.join(joints)}])"]
    lines += [f"{INDENT}return np.array(solutions).reshape(-1, {len(joints)})"]
    return "\n".join(lines) + "\n"


def c_source(formulas: "IKFormulas", name: str) -> str:
    """Return the source of a function in C."""
    target, joints = [s.name for s in formulas.target], [q.name for q in formulas.in_order.values()]
    names = spelled(formulas.robot.parameters, {*target, *joints, *C_WORDS, "solutions", name})
    names = {key: re.sub(r"[^A-Za-z0-9_]", "_", word) for key, word in names.items()}
    names = dict(zip(names, spelled(names.values(), {*target, *joints}).values(), strict=True))
    printer = c_printer()

    def write(e: sympy.Expr) -> str:
        return str(printer.doprint(_renamed(e, names)))

    number = 1
    for joint in formulas.joints:
        number *= len(joint.options)
    taking = ", ".join(f"double {word}" for word in (*target, *names.values()))
    lines = [
        "#include <math.h>",
        "",
        f"/* Writes the solutions ({', '.join(joints)}) and returns their number. */",
        f"int {name}({taking}, double solutions[{number}][{len(joints)}])",
        "{",
        f"{INDENT}int found = 0;",
    ]
    tests = (f"if (!(fabs({write(e)}) <= {CONSISTENT})) return 0;" for e in formulas.constraints)
    lines += [f"{INDENT}{text} /* no joints have such a target */" for text in tests]
    depth, body = _loops(
        formulas,
        write,
        1,
        lambda q, both: f"for (int {q}_i = 0; {q}_i < 2; {q}_i++) {{ double {q} = {q}_i == 0 ? {both[0]} : {both[1]};",
        lambda q, e: f"double {q} = {e};",
    )
    lines += body
    indent = INDENT * depth
    test = " && ".join(f"isfinite({q})" for q in joints)
    lines += [f"{indent}if ({test}) {{"]
    lines += [f"{indent}{INDENT}solutions[found][{i}] = {q};" for i, q in enumerate(joints)]
    lines += [f"{indent}{INDENT}found++;", f"{indent}}}"]
    lines += [INDENT * level + "}" for level in range(depth - 1, 0, -1)]
    return "\n".join([*lines, f"{INDENT}return found;", "}"]) + "\n"


def matlab_source(formulas: "IKFormulas", name: str) -> str:
    """Return the source of a function in MATLAB, which GNU Octave reads too.

    MATLAB's root of a negative number is complex, and its atan2 refuses that; so roots and arcs have functions of their
    own, which return NaN.
    """
    target, joints = [s.name for s in formulas.target], [q.name for q in formulas.in_order.values()]
    taken = {*target, *joints, *MATLAB_WORDS, *REAL_ONLY.values(), "solutions", name}
    words = spelled(map(identifier, formulas.robot.parameters), taken)
    names = {key: words[identifier(key)] for key in formulas.robot.parameters}
    printer = OctaveCodePrinter()

    def write(e: sympy.Expr) -> str:
        text = str(printer.doprint(_renamed(e, names)))
        return re.sub(r"\b(sqrt|acos|asin)\(", lambda found: f"{REAL_ONLY[found[1]]}(", text)

    lines = [
        f"function solutions = {name}({', '.join([*target, *names.values()])})",
        f"% The solutions, one a row: {', '.join(joints)}",
    ]
    values = zip(names.values(), formulas.robot.parameters.values(), strict=True)
    for i, (word, value) in enumerate(values, len(target) + 1):
        lines.append(f"{INDENT}if nargin < {i}, {word} = {value!r}; end")
    lines.append(f"{INDENT}solutions = zeros(0, {len(joints)});")
    tests = (f"if ~(abs({write(e)}) <= {CONSISTENT}), return; end" for e in formulas.constraints)
    lines += [INDENT + text for text in tests]  # no joints have such a target
    depth, body = _loops(
        formulas, write, 1, lambda q, both: f"for {q} = [{', '.join(both)}]", lambda q, e: f"{q} = {e};"
    )
    row = f"[{', '.join(joints)}]"
    lines += [*body, f"{INDENT * depth}if all(isfinite({row}))"]
    lines += [f"{INDENT * (depth + 1)}solutions(end + 1, :) = {row};"]
    lines += [f"{INDENT * level}end" for level in range(depth, 0, -1)]
    lines += ["end", ""]
    for function, real in REAL_ONLY.items():
        inside = "x >= 0" if function == "sqrt" else "abs(x) <= 1"
        lines += [f"function y = {real}(x)", f"{INDENT}y = NaN;", f"{INDENT}if {inside}, y = {function}(x); end", "end"]
    return "\n".join(lines) + "\n"


def latex_source(formulas: "IKFormulas") -> str:
    """Return the formulas as lines of an environment of LaTeX, with five digits."""
    lines, lengths = [], lengths_in(formulas.robot, formulas.task)
    for joint, parts in zip(formulas.joints, in_named_parts(formulas.joints, lengths), strict=True):
        lines += [f"{latex_text(name)} &= {latex_text(formula)}" for name, formula in parts.named]
        both = r" \quad\text{or}\quad ".join(map(latex_text, parts.options))
        if parts.halves is not None:
            middle, half = parts.halves
            both = rf"{'' if middle == 0 else latex_text(middle)} \pm {latex_text(half)}"
        where = "" if parts.exists_if == sympy.true else rf" && {latex_text(parts.exists_if)}"
        lines.append(f"{latex_text(joint.q)} &= {both}{where}")
    return "\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}"


def _loops(
    formulas: "IKFormulas",
    write: Callable[[sympy.Expr], str],
    depth: int,
    loop: Callable[[str, list[str]], str],
    assignment: Callable[[str, str], str],
) -> tuple[int, list[str]]:
    """Return the depth of the innermost loop, and the lines."""
    lines = []
    for joint in formulas.joints:
        texts = [write(option) for option in joint.options]
        if len(texts) > 1:
            lines.append(INDENT * depth + loop(joint.q.name, texts))
            depth += 1
        else:
            lines.append(INDENT * depth + assignment(joint.q.name, texts[0]))
    return depth, lines


def _renamed(e: sympy.Expr, names: dict[str, str]) -> sympy.Expr:
    return e.xreplace({sympy.Symbol(old, real=True): sympy.Symbol(new, real=True) for old, new in names.items()})
