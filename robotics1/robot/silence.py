"""What a C++ library writes on stderr, kept."""

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def stderr_kept() -> Iterator[list[str]]:
    """Collect what is written on the process's stderr, file descriptor 2, into a list of one text.

    Python's own messages of other threads are caught too while it lasts.
    """
    said: list[str] = []
    sys.stderr.flush()
    with tempfile.TemporaryFile() as file:
        saved = os.dup(2)
        os.dup2(file.fileno(), 2)
        try:
            yield said
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            file.seek(0)
            said.append(file.read().decode(errors="replace"))
