"""Machine code of the kernels on disk: damage is noticed, and costs a compilation, never a crash.

Numba keeps an index and a data file for each kernel. It raises what it runs into when one of them is damaged or the
disk is full, and it runs whatever machine code it finds.
"""

import hashlib
import logging
import pickle
import subprocess
from collections.abc import Callable
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from numba.core.caching import FunctionCache, IndexDataCacheFile

PATIENCE = 60.0  # [s] for another process that compiles
log = logging.getLogger(__name__)


class DamagedFile(Exception):  # noqa: N818 (it never leaves this module)
    """A file does not hold what was written to it."""


class MachineCode(FunctionCache):  # type: ignore[misc]
    """Numba's cache of one function, which works without a file where there is no good one.

    Args:
        function: the kernel.
        inner: whether only other kernels call it: such code has no way in from Python, which would crash in it.

    Raises:
        RuntimeError: there is no directory to write to.
    """

    def __init__(self, function: Callable[..., Any], *, inner: bool) -> None:
        super().__init__(function)
        self._inner = inner
        self.awaited: subprocess.Popen[bytes] | None = None  # the process that compiles it
        self._cache_file = CheckedFile(self._cache_path, self._impl.filename_base, _sources())

    def holds_code(self) -> bool:
        """Whether there is machine code on disk that was made from the sources as they are."""
        try:
            return bool(self._cache_file._load_index())
        except Exception:  # a damaged file raises anything
            return False

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Return the compiled function for a signature, or None: then it is compiled anew, and saved."""
        self._wait()
        try:
            return super().load_overload(signature, target_context)
        except Exception as error:  # a damaged pickle raises anything
            log.debug("the machine code of %s on disk is not used: %r", self._name, error)
            with suppress(Exception):
                self.flush()  # else the damaged index would stop the saving too
            return None

    def _index_key(self, signature: Any, codegen: Any) -> tuple[Any, ...]:
        return (*super()._index_key(signature, codegen), self._inner)

    def _wait(self) -> None:
        """Wait for another process to leave the machine code on disk; where it does not, it is compiled here."""
        process, self.awaited = self.awaited, None
        if process is None:
            return
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def save_overload(self, signature: Any, compiled: Any) -> None:
        """Save the compiled function, where the disk takes it."""
        try:
            super().save_overload(signature, compiled)
        except Exception as error:
            log.debug("the machine code of %s is not kept: %r", self._name, error)


class CheckedFile(IndexDataCacheFile):  # type: ignore[misc]
    """The files of one function, with a check sum over the machine code and the sources it was made from."""

    def _save_data(self, name: str, data: Any) -> None:
        pickled = self._dump(data)
        with self._open_for_write(self._data_path(name)) as file:
            file.write(self._check_sum(pickled) + pickled)

    def _load_data(self, name: str) -> Any:
        content = Path(self._data_path(name)).read_bytes()
        size = hashlib.sha256().digest_size
        if content[:size] != self._check_sum(content[size:]):
            raise DamagedFile(self._data_path(name))
        return pickle.loads(content[size:])

    def _check_sum(self, pickled: bytes) -> bytes:
        return hashlib.sha256(repr(self._source_stamp).encode() + pickled).digest()


@cache
def _sources() -> tuple[tuple[str, float, int], ...]:
    """Return the sum by which a kernel on disk is known to be that of these files.

    Numba looks at the file of the function alone; but the machine code holds that of all functions it calls.
    """
    files = sorted(Path(__file__).parent.glob("*.py"))
    return tuple((file.name, file.stat().st_mtime, file.stat().st_size) for file in files)
