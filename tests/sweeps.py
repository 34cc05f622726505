"""What runs each time, what `make sweep` runs besides, and what only `make fuzz` runs."""

from pathlib import Path

import pytest
from hypothesis import settings

# What takes more than 1.5 s of a processor is listed: for a sweep, or for `make fuzz` if shorter cases try the same.
HERE = Path(__file__).parent
LISTS = {HERE / "long_tests.txt": pytest.mark.sweep, HERE / "repeated_tests.txt": pytest.mark.fuzz}


def core_first(cases, core, count=None):
    """The cases as parameters of a test: the core runs each time, the others in a sweep; or `count` of them there, and
    the rest in `make fuzz`.
    """
    cases = list(cases)
    missing = set(core) - set(cases)
    assert not missing, f"the core has {missing}, and no such case is there"
    others = [case for case in cases if case not in core]
    return [*(case for case in cases if case in core), *some_of(others, len(others) if count is None else count)]


def some_of(cases, count):
    """The cases as parameters of a test: `count` of them, evenly spread, run in a sweep, the others in `make fuzz`."""
    cases = list(cases)
    chosen = {i * len(cases) // count for i in range(count)}
    return [
        pytest.param(case, marks=pytest.mark.sweep if i in chosen else pytest.mark.fuzz) for i, case in enumerate(cases)
    ]


def fewer_examples():
    """Settings of a property whose examples take long: a third of those of the profile."""
    return settings(max_examples=settings().max_examples // 3)


def put_off_long_tests(items, *, every_file):
    """Mark the tests of the lists; of one that is there no longer, no list may speak."""
    for path, mark in LISTS.items():
        listed = set(path.read_text(encoding="utf-8").splitlines())
        for item in items:
            if item.nodeid in listed:
                item.add_marker(mark)
                listed.remove(item.nodeid)
        if every_file and listed:
            raise pytest.UsageError(f"{path.name} names tests that are not there: {', '.join(sorted(listed))}")
