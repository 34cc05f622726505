"""A property that is found once, in any number of threads."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from robotics1.results import read_only

if TYPE_CHECKING:  # for type checkers it is that of the standard library
    from functools import cached_property
else:

    class cached_property:  # noqa: N801
        """A property that an object finds when it is first asked for, and keeps.

        `functools.cached_property` of Python 3.11 holds a lock that all objects of a class share. A thread that finds
        one formula would keep the others from finding theirs, two paths that contain one another's kind could wait for
        each other, and a process that is forked meanwhile would wait for ever. Here there is no lock: two threads may
        both find the value, and both get the one that is kept first. An array that is kept can only be read.
        """

        def __init__(self, find: Callable[[Any], Any]) -> None:
            self.find = find
            self.__doc__ = find.__doc__

        def __set_name__(self, owner: type, name: str) -> None:
            self.name = name

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            kept = instance.__dict__
            if self.name not in kept:
                value = self.find(instance)
                read_only([value])
                kept.setdefault(self.name, value)
            return kept[self.name]


__all__ = ["cached_property"]
