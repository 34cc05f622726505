"""Who does the chunks: this process, its threads, an executor of concurrent.futures, a Dask cluster."""

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import BrokenExecutor, Executor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from math import ceil
from typing import Any, TypeVar

from robotics1.errors import InputError, MissingExtraError
from robotics1.kernels.compilation import threads

Chunk = TypeVar("Chunk")
Answer = TypeVar("Answer")

AHEAD = 2  # chunks for each worker that are handed out before their answers are needed
JOINED = 8  # answers that a worker of a cluster joins, before one goes to the client
UNKNOWN = 256  # chunks for an executor that does not tell how many workers it has
EXECUTORS = "an executor of concurrent.futures, a Dask client, or the address of a Dask scheduler"


@dataclass(frozen=True)
class Workers:
    """What takes chunks.

    Attributes:
        executor: where they go; None for this thread.
        ahead: how many may wait for their turn, or be done and wait for an earlier one: it bounds the memory.
        client: of Dask, if the executor is its.
    """

    executor: Executor | None
    ahead: int
    client: Any = None

    def in_order(
        self, work: Callable[[Chunk], Answer], chunks: Iterator[Chunk], most: int = UNKNOWN
    ) -> Iterator[Answer]:
        """Yield the answers in the order of the chunks, with at most so many of them on their way.

        Raises:
            InputError: a process of the executor has died, and its chunk with it.
        """
        if self.executor is None:
            return map(work, chunks)
        submit = self.executor.submit
        return _results((submit(work, chunk) for chunk in chunks), min(self.ahead, most))

    def joined_in_order(
        self,
        work: Callable[[Chunk], Answer],
        join: Callable[[list[Answer]], Answer],
        chunks: Iterator[Chunk],
        most: int,
    ) -> Iterator[Answer]:
        """Yield answers that make up those of all chunks, in their order: on a cluster some are joined by its workers.

        Raises:
            InputError: as `in_order` does.
        """
        if self.client is None:
            return self.in_order(work, chunks, most)
        submit = partial(self.client.submit, pure=False)
        joined = (
            submit(join, [submit(work, chunk) for chunk in some])
            for some in iter(lambda: list(islice(chunks, JOINED)), [])
        )
        return _results(joined, ceil(min(self.ahead, most) / JOINED))


def _results(futures: Iterator[Any], most: int) -> Iterator[Any]:
    """Yield the results of futures in their order; so many are made ahead of the result that is needed next."""
    waiting: deque[Any] = deque()
    try:
        for future in futures:
            waiting.append(future)
            if len(waiting) >= most:
                yield waiting.popleft().result()
        while waiting:
            yield waiting.popleft().result()
    except BrokenExecutor as error:
        raise InputError(
            f"a worker of the executor has died ({error}); with checkpoint= what was done is kept, and another "
            f"call goes on from there"
        ) from error
    finally:
        for future in waiting:
            future.cancel()


def check_executor(executor: Any) -> None:
    """Refuse what does no work.

    Raises:
        InputError: it is none of those that are possible.
    """
    address = isinstance(executor, str) and ":" in executor
    if not (executor is None or address or isinstance(executor, Executor) or _is_dask_client(executor)):
        raise InputError(f"executor must be {EXECUTORS}; it is {executor!r}")


def check_progress(progress: Any) -> None:
    """Refuse what cannot be called with the number done and the number of all.

    Raises:
        InputError: it is neither None nor a function.
    """
    if progress is not None and not callable(progress):
        raise InputError(f"progress must be a function of the number done and the number of all, not {progress!r}")


@contextmanager
def workers_of(executor: Any, *, sendable: bool = True) -> Iterator[Workers]:
    """Open the workers that an argument names.

    Args:
        executor: None for threads on all cores of this machine, since the kernels leave the interpreter free; an
            executor; a Dask client; or the address of a Dask scheduler, such as "tcp://10.0.0.1:8786".
        sendable: whether the work can be done by others; if not, this thread does it.

    Raises:
        InputError: it is none of these, or no scheduler answers at the address.
        MissingExtraError: it is an address, and Dask is not installed.
    """
    check_executor(executor)
    if not sendable:
        yield Workers(None, 1)
    elif executor is None:
        with _threads() as here:
            yield here
    elif isinstance(executor, str):
        with _client(executor) as client:
            yield _dask_workers(client)
    elif isinstance(executor, Executor):
        yield Workers(executor, UNKNOWN)
    else:
        yield _dask_workers(executor)


@contextmanager
def _threads() -> Iterator[Workers]:
    if threads() == 1:
        yield Workers(None, 1)
        return
    pool = ThreadPoolExecutor(threads())
    try:
        yield Workers(pool, AHEAD * threads())
    finally:
        pool.shutdown(cancel_futures=True)


def _client(address: str) -> Any:
    """Return a client of the scheduler at an address."""
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingExtraError("distributed", "dask") from error
    try:
        return Client(address, timeout="5s", set_as_default=False)
    except (OSError, ValueError) as error:
        raise InputError(f"no Dask scheduler answers at {address!r}: {error}") from error


def _is_dask_client(value: Any) -> bool:
    return hasattr(value, "get_executor") and hasattr(value, "scheduler_info")


def _dask_workers(client: Any) -> Workers:
    """Return the workers of a cluster; Dask itself gives the chunks of a lost worker to another."""
    count = sum(client.nthreads().values())
    return Workers(client.get_executor(pure=False), max(UNKNOWN, AHEAD * count), client)
