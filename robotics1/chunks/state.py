"""What is known so far, in one file that always holds a whole state: an archive of NumPy arrays (.npz)."""

import json
from collections.abc import Mapping
from io import BytesIO
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.chunks.identity import Identity, refuse_another
from robotics1.errors import InputError
from robotics1.files import write_file

EVERY = 5.0  # [s] between two times that a state is written
QUESTION = "question"  # the name of what was asked, among the arrays
State = Mapping[str, npt.NDArray[Any]]


class StateFile:
    """The file of a state. Its bytes depend on the state and the question only.

    Args:
        path: the file; it need not exist.
        identity: what was asked.
    """

    def __init__(self, path: str | Path, identity: Identity) -> None:
        self.path, self.identity = path, identity
        self._written = monotonic()

    def read(self) -> dict[str, npt.NDArray[Any]] | None:
        """Return the state that was written last; None if there is no file yet.

        Raises:
            InputError: it is of another question, or damaged.
        """
        try:
            if not Path(self.path).exists():
                return None
            with np.load(
                BytesIO(Path(self.path).read_bytes()), allow_pickle=False
            ) as kept:  # the archive has checksums
                state = {name: kept[name] for name in kept.files}
            question = json.loads(str(state.pop(QUESTION)))
        except Exception as error:
            raise InputError(
                f"{str(self.path)!r} holds no checkpoint, or a damaged one ({type(error).__name__}: {error}); name "
                f"another file, or delete it and begin anew"
            ) from error
        refuse_another(self.path, question, self.identity)
        return state

    def write_now_and_then(self, state: State) -> None:
        """Write a state, if the last one was written some seconds ago."""
        if monotonic() - self._written > EVERY:
            self.write(state)

    def write(self, state: State) -> None:
        """Write a state in the place of the last one.

        Raises:
            InputError: it cannot be written, as on a full disk; the last one stays.
        """
        content = BytesIO()
        arrays: dict[str, Any] = {QUESTION: np.array(json.dumps(self.identity)), **state}
        np.savez(content, **arrays)
        write_file(self.path, content.getvalue())
        self._written = monotonic()
