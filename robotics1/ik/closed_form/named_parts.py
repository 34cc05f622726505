"""Inverse formulas as they are read: five digits, lengths in metres, names for what is long or written twice.

An argument of acos or asin is named as textbooks do, c3 for cos q3 and s2 for sin q2, and other parts u1, u2, ...
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import sympy

from robotics1.ik.closed_form.one_unknown import JointFormula
from robotics1.symbolic.writing.decimals import Lengths
from robotics1.symbolic.writing.readable import readable

LONG = 30  # operations of the formulas of a joint, above which parts of them get names
LONG_ARGUMENT = 8  # operations of an argument of acos or asin, from which it gets a name
WORTH_A_NAME = 4  # operations
LONG_LINE = 24  # operations of a named formula, above which the sums in it get names too
DIGITS = 5


class NamedParts(NamedTuple):
    """The formulas of a joint.

    Attributes:
        named: the new names that they use, each after those it is made of, with their formulas.
        options: the values of the joint, in these names.
        halves: m and h of two options m + h and m − h, h an arc or a root; None of others.
        exists_if, double_if, free_if: the conditions, in these names.
    """

    named: list[tuple[sympy.Symbol, Any]]
    options: list[Any]
    halves: tuple[Any, Any] | None
    exists_if: Any
    double_if: Any
    free_if: Any


def in_named_parts(joints: Sequence[JointFormula], lengths: Lengths) -> list[NamedParts]:
    """Return the formulas of each joint with names in them; what a joint before it has named keeps its name."""
    split = [_halves(joint.options) for joint in joints]
    read = [
        [_with_decimals(readable(formula, lengths)) for formula in (*(pair or joint.options), *joint[2:])]
        for joint, pair in zip(joints, split, strict=True)
    ]
    taken = {symbol.name for formulas in read for formula in formulas for symbol in formula.free_symbols}
    first = [_with_its_argument(joint.q, formulas, taken) for joint, formulas in zip(joints, read, strict=True)]
    long = [sum(sympy.count_ops(formula) for formula in formulas) >= LONG for _, formulas in first]
    long = [is_long and not any(name.startswith("u") for name in taken) for is_long in long]
    whole = [formula for (_, formulas), is_long in zip(first, long, strict=True) if is_long for formula in formulas]
    shared, written = sympy.cse(whole, symbols=sympy.numbered_symbols("t", sympy.Dummy), order="canonical")
    definitions, names, rest = dict(shared), dict[Any, Any](), iter(written)
    parts = []
    for (argument, formulas), is_long, pair in zip(first, long, split, strict=True):
        named: list[tuple[sympy.Symbol, Any]] = []
        if is_long:
            formulas = [_in_names(next(rest), definitions, names, named) for _ in formulas]  # noqa: PLW2901
        if argument is not None:
            named.append((argument, formulas[0]))
        *values, exists_if, double_if, free_if = formulas[argument is not None :]
        options = values if pair is None else [values[0] + values[1], values[0] - values[1]]
        halves = None if pair is None else (values[0], values[1])
        parts.append(NamedParts(named, options, halves, exists_if, double_if, free_if))
    return parts


def _with_its_argument(q: sympy.Symbol, formulas: list[Any], taken: set[str]) -> tuple[sympy.Symbol | None, list[Any]]:
    """Return a name for the long argument of an arc, and the formulas in it after the argument; else None and these."""
    arcs = {arc for option in formulas[:-3] for arc in option.atoms(sympy.acos, sympy.asin)}
    if len({arc.args[0] for arc in arcs}) != 1:
        return None, formulas
    arc = arcs.pop()
    [argument] = arc.args
    alone = {sympy.S.Zero, arc} if arc.func is sympy.acos else {arc, sympy.pi - arc}
    if {*formulas[:-3]} != alone:  # with another angle it is no cosine of q
        return None, formulas
    name = sympy.Symbol(q.name.replace("q", "c" if arc.func is sympy.acos else "s"), real=True)
    if sympy.count_ops(argument) < LONG_ARGUMENT or name.name in taken:
        return None, formulas
    bounded = formulas[-3].has(sympy.Abs) and formulas[-3].rhs == 1  # |argument| ≤ 1
    conditions = [sympy.Abs(name) <= 1, sympy.Eq(sympy.Abs(name), 1), formulas[-1]] if bounded else formulas[-3:]
    return name, [argument, *(option.xreplace({argument: name}) for option in formulas[:-3]), *conditions]


def _halves(options: Sequence[sympy.Expr]) -> tuple[sympy.Expr, sympy.Expr] | None:
    """Return m and h of two formulas m + h and m − h, h an arc or a root; else None."""
    if len(options) < 2:
        return None
    terms, others = (set(sympy.Add.make_args(option)) for option in options)
    own = terms - others
    if len(own) != 1 or others - terms != {-next(iter(own))}:
        return None
    [half] = own
    if half.could_extract_minus_sign():
        half = -half
    is_root = half.as_coeff_Mul()[1].is_Pow
    return (sympy.Add(*(terms & others)), half) if is_root or half.func is sympy.acos else None


def _in_names(formula: Any, formulas: dict[Any, Any], names: dict[Any, Any], named: list[Any]) -> Any:
    """Return a formula in names u; those that are new are added to `named`, what they are made of first."""
    for t in sorted(formula.atoms(sympy.Dummy) & formulas.keys(), key=lambda t: t.dummy_index):
        if t not in names:
            inner = _in_names(formulas[t], formulas, names, named)
            names[t] = inner if sympy.count_ops(inner) < WORTH_A_NAME else _named(inner, named, names)
        formula = formula.xreplace({t: names[t]})
    return _split(formula, named, names)


def _named(formula: Any, named: list[Any], names: dict[Any, Any]) -> sympy.Symbol:
    given = {name for name in names.values() if name.is_Symbol and name.name.startswith("u")}
    u = sympy.Symbol(f"u{len(given) + 1}", real=True)
    named.append((u, formula))
    return u


def _split(formula: Any, named: list[Any], names: dict[Any, Any]) -> Any:
    """Return a formula whose longest sums inside have names, if it is too long for a line."""
    while sympy.count_ops(formula) > LONG_LINE:
        inside = [part for part in sympy.preorder_traversal(formula) if part != formula and part.is_Add]
        worth = [part for part in inside if WORTH_A_NAME <= sympy.count_ops(part) <= LONG_LINE]
        if not worth:
            return formula
        part = max(worth, key=sympy.count_ops)
        names[part] = _named(part, named, names)
        formula = formula.xreplace({part: names[part]})
    return formula


def _with_decimals(formula: Any) -> Any:
    """Return a formula in which a number such as 0.1·√18686333 is a decimal; fractions, π and π/2 stay."""
    parts = {
        part
        for part in sympy.preorder_traversal(formula)
        if part.is_number and not part.is_Rational and part.has(sympy.Pow, sympy.atan, sympy.acos, sympy.asin)
    }
    return _added(formula.xreplace({part: sympy.Float(part.evalf(), DIGITS) for part in parts}))


def _added(formula: Any) -> Any:
    """Return a formula in which 1.5238 + π is one decimal."""

    def is_mixed(part: Any) -> bool:
        return bool(part.is_Add and any(x.is_Float for x in part.args) and sum(x.is_number for x in part.args) > 1)

    def added(*terms: Any) -> Any:
        decimal = sympy.Float(sum(x.evalf() for x in terms if x.is_number), DIGITS)
        return sympy.Add(decimal, *(x for x in terms if not x.is_number))

    return formula.replace(is_mixed, lambda part: added(*part.args))
