"""Long formulas in steps: what they share, and what is long inside them, gets a name, u₁, u₂, ..., before its use."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import sympy

from robotics1.ik.closed_form.peeling import JointFormula

LONG = 30  # operations of the formulas of a joint, above which parts of them get names
WORTH_A_NAME = 4  # operations
LONG_LINE = 24  # operations of a named formula, above which the sums in it get names too
DIGITS = 5


class Steps(NamedTuple):
    """The formulas of a joint.

    Attributes:
        named: the new names that they use, each after those it is made of, with their formulas.
        options: the values of the joint, in these names.
    """

    named: list[tuple[sympy.Symbol, Any]]
    options: list[Any]


def shortened(joints: Sequence[JointFormula]) -> list[Steps]:
    """Return the formulas of each joint in steps; what a joint before it has named keeps its name."""
    options = [[_with_decimals(option) for option in joint.options] for joint in joints]
    taken = {symbol.name for listed in options for option in listed for symbol in option.free_symbols}
    if any(name.startswith("u") for name in taken):
        return [Steps([], listed) for listed in options]
    long = [sum(sympy.count_ops(option) for option in listed) >= LONG for listed in options]
    whole = [option for listed, is_long in zip(options, long, strict=True) if is_long for option in listed]
    shared, written = sympy.cse(whole, symbols=sympy.numbered_symbols("t", sympy.Dummy), order="canonical")
    formulas = dict(shared)
    names: dict[sympy.Symbol, sympy.Symbol] = {}
    rest = iter(written)
    steps = []
    for listed, is_long in zip(options, long, strict=True):
        named: list[tuple[sympy.Symbol, Any]] = []
        taking = [next(rest) for _ in listed] if is_long else listed
        steps.append(Steps(named, [_in_names(option, formulas, names, named) for option in taking]))
    return steps


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
