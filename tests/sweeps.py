"""What runs each time, and what `make sweep` runs besides."""

import pytest


def core_first(names, core):
    """The names as parameters of a test: those of the core run each time, the others in a sweep."""
    missing = set(core) - set(names)
    assert not missing, f"the core has {missing}, and no such case is there"
    return [name if name in core else pytest.param(name, marks=pytest.mark.sweep) for name in names]
