"""What runs each time, and what `make sweep` runs besides."""

from pathlib import Path

import pytest

LONG = Path(__file__).parent / "long_tests.txt"  # more than 1.5 s of a processor; shorter ones of its file try the same


def core_first(names, core):
    """The names as parameters of a test: those of the core run each time, the others in a sweep."""
    missing = set(core) - set(names)
    assert not missing, f"the core has {missing}, and no such case is there"
    return [name if name in core else pytest.param(name, marks=pytest.mark.sweep) for name in names]


def put_off_long_tests(items, *, every_file):
    """Mark the tests of the list; of one that is there no longer, the list must say so."""
    long = set(LONG.read_text(encoding="utf-8").splitlines())
    for item in items:
        if item.nodeid in long:
            item.add_marker(pytest.mark.sweep)
            long.remove(item.nodeid)
    if every_file and long:
        raise pytest.UsageError(f"{LONG.name} names tests that are not there: {', '.join(sorted(long))}")
