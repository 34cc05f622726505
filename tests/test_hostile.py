"""Hostile xacro files (hostile.py): each is refused with its reason or harmless, in a child process that is watched."""

import json
import re
import subprocess
import sys

import hostile
import hostile_child
import pytest

CASES = hostile.cases()


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """What the child reports of all files."""
    folder = tmp_path_factory.mktemp("hostile")
    command = [sys.executable, hostile_child.__file__, str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(done.stdout)


def test_there_are_more_than_60_different_hostile_files():
    assert len({(case.head, case.value, case.link, case.robot) for case in CASES}) == len(CASES) > 200


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_a_hostile_file_is_refused_with_its_reason_or_harmless(seen, case):
    said, done, _ = seen["results"][case.name]
    assert done == []
    if case.reason is hostile.HARMLESS:
        assert said is None
    else:
        assert said is not None
        assert "STRAY" not in said
        assert re.search(case.reason, said)


def test_no_code_of_a_hostile_file_has_run(seen):
    assert seen["canaries"] == []


def test_no_hostile_file_takes_much_memory_or_time(seen):
    assert seen["peak"] < 800_000  # kB, with Pinocchio and all
    assert max(seconds for _, _, seconds in seen["results"].values()) < hostile_child.PATIENCE


def test_the_watch_sees_a_file_a_process_a_socket_and_code(seen):
    assert {event.split()[0] for event in seen["control"]} >= {"open", "subprocess.Popen", "socket.__new__", "exec"}
