"""What can be seen of an object: its fields, properties and answers without arguments, as plain values to compare."""

import inspect
from collections.abc import Mapping
from dataclasses import is_dataclass
from enum import Enum
from pathlib import Path

import numpy as np
import pinocchio as pin
import sympy

from robotics1 import Robotics1Error

PLAIN = (bool, int, str, bytes, type(None), Enum, Path, slice, np.bool_, np.integer)
QUESTIONS = ("explain", "bit_length")  # methods without arguments that answer
RATES = ("velocity", "acceleration", "first", "second")
DEPTH = 3


def observed(x, depth=DEPTH):  # noqa: PLR0911
    """The value of x, to be compared by ==; what is deeper than `depth` objects is its type alone."""
    if isinstance(x, PLAIN):
        return x
    if isinstance(x, float | complex | np.floating):
        return repr(complex(x))
    if isinstance(x, np.ndarray) and x.dtype != object:
        return x.shape, x.dtype.str, x.tobytes()
    if isinstance(x, sympy.Basic | sympy.MatrixBase):
        return sympy.srepr(x)
    if isinstance(x, pin.SE3):
        return x.homogeneous.tobytes()
    if isinstance(x, pin.Model):
        return list(x.names), x.saveToString()
    if callable(x) and inspect.isfunction(x):
        return x.__qualname__
    if isinstance(x, Mapping):
        return [(observed(key, depth), observed(value, depth)) for key, value in x.items()]
    if isinstance(x, list | tuple | np.ndarray) and not hasattr(x, "_fields"):
        return [observed(entry, depth) for entry in x]
    return (type(x).__qualname__, _answers(x, depth - 1) if depth else None)


def _answers(x, depth):
    """The public attributes, and what the object answers to the questions it knows."""
    names = [name for name in dir(type(x)) if not name.startswith("_")] if _ours(x) else []
    names += [name for name in getattr(x, "__dict__", {}) if not name.startswith("_")]
    found = {}
    for name in dict.fromkeys([*getattr(x, "_fields", ()), *names]):
        try:
            value = getattr(x, name)
            if callable(value) and name in QUESTIONS:
                value = value()
            elif inspect.ismethod(value) or inspect.isbuiltin(value):
                continue
            found[name] = observed(value, depth)
        except (Robotics1Error, AttributeError) as error:
            found[name] = f"{type(error).__name__}: {error}"
    return found | _in_the_middle(x)


def _in_the_middle(x):
    """Where a path or a motion is in its middle, and how fast."""
    end = getattr(x, "duration", getattr(x, "end", None))
    if not _ours(x) or not isinstance(end, float) or not callable(x):
        return {}
    rates = {name: getattr(x, name) for name in RATES if callable(getattr(x, name, None))}
    start = getattr(x, "start", 0.0)  # of a path of rotations the first one
    middle = 0.45 * end + (start if hasattr(x, "breakpoints") and isinstance(start, float) else 0.0)
    return {f"{name} in the middle": observed(f(middle)) for name, f in {"value": x, **rates}.items()}


def _ours(x):
    return type(x).__module__.startswith("robotics1") and (is_dataclass(x) or hasattr(x, "__dict__"))
