"""Inverse formulas in sentences, one line for each joint."""

from typing import TYPE_CHECKING, Any

import sympy

from robotics1.ik.closed_form.named_parts import NamedParts, in_named_parts
from robotics1.notation import count
from robotics1.symbolic.writing.decimals import lengths_in
from robotics1.symbolic.writing.printing import line_text

if TYPE_CHECKING:
    from robotics1.ik.closed_form.family import IKFormulas

SIGNS = {"==": "=", "<=": "≤", ">=": "≥", "!=": "≠"}
TURNED = {"<=": "≥", ">=": "≤", "<": ">", ">": "<"}


def sentences(formulas: "IKFormulas") -> str:
    """Return the formulas with their conditions, the singular targets and the free joints."""
    lines = [f"{count(len(formulas), 'solution')} of {formulas.robot.name}, one joint after the other:"]
    others = [f"{q} is {name}" for name, q in formulas.in_order.items() if name != q.name]
    lines += [f"  {', '.join(others)}"] if others else []
    lengths = lengths_in(formulas.robot, formulas.task)
    for joint, parts in zip(formulas.joints, in_named_parts(formulas.joints, lengths), strict=True):
        lines += _of_a_joint(joint.q, parts, formulas.constants)
    lines += [f"  a target must have {line_text(e)} = 0" for e in formulas.constraints]
    if formulas.free_joints:
        lines.append(f"  joints that do not move the task: {', '.join(formulas.free_joints)}")
    return "\n".join(lines)


def _of_a_joint(q: sympy.Symbol, parts: NamedParts, constants: set[sympy.Symbol]) -> list[str]:
    where = "" if parts.exists_if == sympy.true else f", where {sentence(parts.exists_if)}"
    lines = [f"  {q} = {either(parts)}{where}"]
    lines += [f"    {name} = {line_text(formula)}" for name, formula in parts.named]
    if parts.free_if.free_symbols - constants:
        lines.append(f"    {q} is free where {sentence(parts.free_if)}")
    if parts.double_if != sympy.false:
        lines.append(f"    the two are one where {sentence(parts.double_if)}")
    return lines


def either(parts: NamedParts) -> str:
    """Return one or two formulas: a ± b where that is all they differ in."""
    if parts.halves is None:
        return " or ".join(map(line_text, parts.options))
    middle, half = parts.halves
    return f"{line_text(middle)} ± {line_text(half)}" if middle != 0 else f"±{line_text(half)}"


def sentence(condition: Any) -> str:
    """Return a condition as text, a number on its right."""
    if isinstance(condition, sympy.And):
        return " and ".join(sorted(map(sentence, condition.args)))
    if not isinstance(condition, sympy.core.relational.Relational):
        return str(condition)
    symbol, left, right = condition.rel_op, condition.lhs, condition.rhs
    if left.is_number and not right.is_number:
        symbol, left, right = TURNED.get(symbol, symbol), right, left
    if isinstance(condition, sympy.Eq) and right == 0 and left.could_extract_minus_sign():
        left = -left
    return f"{line_text(left)} {SIGNS.get(symbol, symbol)} {line_text(right)}"
