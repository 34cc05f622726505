"""The command `robotics1`, run in this process through its entry point, as the shell runs it."""

import io
import json
import sys
from contextlib import redirect_stderr, redirect_stdout
from importlib.metadata import entry_points
from typing import NamedTuple
from unittest.mock import patch

(ENTRY_POINT,) = entry_points(group="console_scripts", name="robotics1")
main = ENTRY_POINT.load()


class Ended(NamedTuple):
    """A command that has ended: its exit code, and what it wrote."""

    code: int
    stdout: str
    stderr: str

    @property
    def refusal(self):
        """The sentence with which it refuses: one line on stderr, of a typed error, and exit code 2."""
        assert (self.code, self.stdout) == (2, ""), self
        assert self.stderr.startswith("error: "), self
        assert self.stderr.count("\n") == 1, self
        assert "[Errno" not in self.stderr, self
        return self.stderr.removeprefix("error: ").removesuffix("\n")


def run(*words):
    """Run the command with these words."""
    out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", write_through=True) for _ in range(2))
    code = 0
    with patch.object(sys, "argv", ["robotics1", *map(str, words)]), redirect_stdout(out), redirect_stderr(err):
        try:
            main()
        except SystemExit as end:
            code = end.code or 0
    return Ended(code, *(stream.buffer.getvalue().decode() for stream in (out, err)))


def answer(*words, code=0):
    """Run the command with --json and return what it answers; the exit code must be `code`."""
    ended = run(*words, "--json")
    assert ended.code == code, ended
    return json.loads(ended.stdout)
