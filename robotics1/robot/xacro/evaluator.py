"""The value of an expression, computed part by part from its syntax tree: Python itself never runs it.

The methods of `Evaluation` are named after the parts of Python's syntax (see `ast`), and are all there is: a part
without a method, such as a lambda, is refused. A dot leads into dictionaries and namespaces only, never into an
object, and what may be called stands in a table (see functions.py).
"""

import ast
import operator
from collections import ChainMap
from collections.abc import Callable, Iterator, Mapping
from itertools import chain
from typing import Any

from robotics1.robot.xacro.budget import DATA, Budget, Refused, check_elements, shortened, too_large
from robotics1.robot.xacro.functions import METHODS, modulo, power, times
from robotics1.syntax import syntax_tree

LONGEST = 5000  # characters of an expression
OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: times,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: modulo,
    ast.Pow: power,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
    ast.Not: operator.not_,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda a, b: a in b,
    ast.NotIn: lambda a, b: a not in b,
}
BUILDERS = (
    *("Constant", "BinOp", "Call", "List", "Tuple", "Set", "Dict"),
    *("ListComp", "SetComp", "GeneratorExp", "DictComp"),
)
Comprehension = ast.ListComp | ast.SetComp | ast.GeneratorExp | ast.DictComp
REFUSED = {"Lambda": "a lambda", "NamedExpr": "an assignment (:=)", "JoinedStr": "a formatted string (f'...')"}


def evaluate(expression: str, names: Mapping[str, Any], budget: Budget) -> Any:
    """Return the value of an expression: a number, a text, a truth value, None, a list or a dictionary of such.

    Args:
        expression: Python's syntax of an expression.
        names: what a name stands for.
        budget: what the computation may use.

    Raises:
        Refused: the expression wants more than to compute, or too much.
        Exception: what Python raises for such an expression, such as ZeroDivisionError.
    """
    text = expression.strip()
    if len(text) > LONGEST:
        raise too_large(f"an expression of {len(text)} characters")
    return Evaluation(names, budget).value(syntax_tree(text))


class Evaluation:
    """One reading of a syntax tree."""

    def __init__(self, names: Mapping[str, Any], budget: Budget):
        self._names = names
        self._budget = budget

    def value(self, part: ast.AST) -> Any:
        """Return the value of a part of an expression."""
        value = self._thing(part)
        if type(value) not in DATA:
            raise Refused(f"{_source(part)!r} is a function or a namespace, and no value")
        return value

    def _thing(self, part: ast.AST) -> Any:
        """Return what a part stands for, which may also be a function or a namespace."""
        kind = type(part).__name__
        method = getattr(self, kind, None)
        if method is None:
            raise Refused(f"it has {REFUSED.get(kind, kind)}, which no robot needs")
        self._budget.spend("steps")
        thing = method(part)
        if kind in BUILDERS:
            self._budget.weigh(thing)
        return thing

    def Constant(self, part: ast.Constant) -> Any:
        return part.value

    def Name(self, part: ast.Name) -> Any:
        try:
            return self._names[part.id]
        except KeyError:
            raise NameError(f"name {part.id!r} is not defined") from None

    def UnaryOp(self, part: ast.UnaryOp) -> Any:
        return self._operator(part.op)(self.value(part.operand))

    def BinOp(self, part: ast.BinOp) -> Any:
        return self._operator(part.op)(self.value(part.left), self.value(part.right))

    def BoolOp(self, part: ast.BoolOp) -> Any:
        decides = bool if isinstance(part.op, ast.Or) else operator.not_
        for operand in part.values[:-1]:
            if decides(value := self.value(operand)):
                return value
        return self.value(part.values[-1])

    def Compare(self, part: ast.Compare) -> bool:
        left = self.value(part.left)
        for sign, operand in zip(part.ops, part.comparators, strict=True):
            right = self.value(operand)
            if not self._operator(sign)(left, right):
                return False
            left = right
        return True

    def IfExp(self, part: ast.IfExp) -> Any:
        return self.value(part.body if self.value(part.test) else part.orelse)

    def Attribute(self, part: ast.Attribute) -> Any:
        owner = self._thing(part.value)
        if not isinstance(owner, dict):
            raise Refused(f"it reads .{part.attr} of {_source(part.value)!r}, which is no dictionary")
        try:
            return owner[part.attr]
        except KeyError:
            raise NameError(f"name {part.attr!r} is not defined in {_source(part.value)}") from None

    def Subscript(self, part: ast.Subscript) -> Any:
        owner = self.value(part.value)
        if isinstance(part.slice, ast.Slice):
            ends = (part.slice.lower, part.slice.upper, part.slice.step)
            return owner[slice(*(None if end is None else self.value(end) for end in ends))]
        return owner[self.value(part.slice)]

    def Call(self, part: ast.Call) -> Any:
        function = self._function(part.func)
        arguments = list(chain.from_iterable(self._items(argument) for argument in part.args))
        named: dict[str, Any] = {}
        for keyword in part.keywords:
            named |= self.value(keyword.value) if keyword.arg is None else {keyword.arg: self._thing(keyword.value)}
        if any(isinstance(thing, dict) and type(thing) is not dict for thing in (*arguments, *named.values())):
            raise Refused(f"{_source(part)!r} uses a namespace as a value")
        return function(*arguments, **named)

    def List(self, part: ast.List | ast.Tuple | ast.Set) -> list[Any]:
        return [value for element in part.elts for value in self._items(element)]

    def Tuple(self, part: ast.Tuple) -> tuple[Any, ...]:
        return tuple(self.List(part))

    def Set(self, part: ast.Set) -> set[Any]:
        return set(self.List(part))

    def Dict(self, part: ast.Dict) -> dict[Any, Any]:
        pairs = zip(part.keys, part.values, strict=True)
        parts = [self.value(v) if k is None else {self.value(k): self.value(v)} for k, v in pairs]
        return {key: value for mapping in parts for key, value in mapping.items()}

    def ListComp(self, part: ast.ListComp | ast.GeneratorExp) -> list[Any]:
        return [inner.value(part.elt) for inner in self._rounds(part)]

    GeneratorExp = ListComp

    def SetComp(self, part: ast.SetComp) -> set[Any]:
        return {inner.value(part.elt) for inner in self._rounds(part)}

    def DictComp(self, part: ast.DictComp) -> dict[Any, Any]:
        return {inner.value(part.key): inner.value(part.value) for inner in self._rounds(part)}

    def _rounds(self, part: Comprehension) -> Iterator["Evaluation"]:
        """Return an evaluation for each element of a comprehension."""
        for number, inner in enumerate(self._rows(part.generators), 1):
            check_elements(number)
            yield inner

    def _rows(self, generators: list[ast.comprehension]) -> Iterator["Evaluation"]:
        """Return an evaluation for each round of the nested loops of a comprehension."""
        if not generators:
            yield self
            return
        first, *rest = generators
        if first.is_async:
            raise Refused("it has an asynchronous loop, which no robot needs")
        for value in self.value(first.iter):
            inner = Evaluation(ChainMap(_bound(first.target, value), self._names), self._budget)  # type: ignore[arg-type]
            if all(inner.value(condition) for condition in first.ifs):
                yield from inner._rows(rest)

    def _operator(self, sign: ast.AST) -> Callable[..., Any]:
        if type(sign) not in OPERATORS:
            raise Refused(f"it has the operator {type(sign).__name__}, which no robot needs")
        return OPERATORS[type(sign)]

    def _items(self, part: ast.AST) -> list[Any]:
        return list(self.value(part.value)) if isinstance(part, ast.Starred) else [self._thing(part)]

    def _function(self, part: ast.AST) -> Callable[..., Any]:
        """Return what is called: a method of a text, list or dictionary, or a function that has a name."""
        if isinstance(part, ast.Attribute):
            owner = self._thing(part.value)
            method = METHODS.get(type(owner), {}).get(part.attr)
            if method is not None:
                return lambda *arguments, **named: method(owner, *arguments, **named)
        function = self._thing(part)
        if not callable(function):
            raise TypeError(f"{_source(part)!r} is no function")
        return function  # type: ignore[no-any-return]


def _bound(target: ast.AST, value: Any) -> dict[str, Any]:
    """Return the names of a comprehension's variables and what they stand for."""
    if isinstance(target, ast.Name):
        return {target.id: value}
    if not isinstance(target, ast.Tuple | ast.List):
        raise Refused("it has a comprehension over something else than names")
    bound = [_bound(inner, part) for inner, part in zip(target.elts, value, strict=True)]
    return {name: part for names in bound for name, part in names.items()}


def _source(part: ast.AST) -> str:
    return shortened(ast.unparse(part))
