"""YAML files: numbers, texts, lists and dictionaries, and the units that xacro knows."""

import math
from collections.abc import Callable
from typing import Any

import yaml

from robotics1.robot.xacro.budget import Budget, Refused, too_large

LONGEST = 100_000  # characters of a file: PyYAML reads some 100 000 a second
UNITS = {
    "!radians": 1.0,
    "!degrees": math.pi / 180,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}


def yaml_values(text: str, name: str, evaluate: Callable[[str], Any], budget: Budget) -> Any:
    """Return what a YAML text holds.

    Args:
        text: the YAML.
        name: what an error calls it.
        evaluate: gives the value of an expression, as in `!degrees 180/2`.
        budget: what the expansion may use.

    Raises:
        Refused: it is not well-formed, is too large, or holds anything else.
    """
    if len(text) > LONGEST:
        raise too_large(f"{name!r} has {len(text)} characters")
    budget.spend("steps", len(text) // 2)
    loader = _Loader(text)
    loader.evaluate, loader.budget = evaluate, budget
    try:
        value = loader.get_single_data()
    except yaml.YAMLError as error:
        raise Refused(f"{name!r} is no YAML of plain values: {' '.join(str(error).split())}") from error
    budget.weigh(value)
    return value


class _Loader(yaml.SafeLoader):  # type: ignore[misc]
    """PyYAML's loader of plain values, with units, and with a limit for what aliases (*name) repeat."""

    evaluate: Callable[[str], Any]
    budget: Budget

    def unit(self, suffix: str, node: yaml.ScalarNode) -> float:
        """Return a number with a unit, in metres or radians."""
        return float(self.evaluate(self.construct_scalar(node))) * UNITS[f"!{suffix}"]

    def flatten_mapping(self, node: yaml.MappingNode) -> None:
        """Put merged mappings (<<: *name) in place; repeated ones grow tenfold from line to line."""
        super().flatten_mapping(node)
        self.budget.spend("steps", len(node.value))


for _unit in UNITS:
    _Loader.add_constructor(_unit, lambda loader, node, suffix=_unit[1:]: loader.unit(suffix, node))
_Loader.add_constructor("tag:yaml.org,2002:timestamp", yaml.SafeLoader.construct_yaml_str)  # no date is a length
