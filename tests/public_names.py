"""The public names: those at the top of robotics1, and those of its namespaces."""

import inspect

import robotics1

NAMESPACES = {name: module for name in robotics1.__all__ if inspect.ismodule(module := getattr(robotics1, name))} | {
    "robotics1": robotics1,
}
PUBLIC = {
    name: value
    for module in NAMESPACES.values()
    for name in module.__all__
    if not inspect.ismodule(value := getattr(module, name))
}
