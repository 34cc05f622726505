"""Who works: the options --workers and --scheduler of the commands that go through millions of places."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from typing import Annotated, Any

import typer

from robotics1.errors import InputError

Workers = Annotated[int | None, typer.Option(help="In how many threads; by default on all cores.")]
Scheduler = Annotated[
    str | None, typer.Option(help="The address of a Dask scheduler that works, as tcp://10.0.0.1:8786.")
]


@contextmanager
def opened_executor(workers: int | None, scheduler: str | None) -> Iterator[Any]:
    """Open the executor that the options name; None for all cores of this machine.

    Raises:
        InputError: both are given, or the number is none.
    """
    if scheduler is not None and workers is not None:
        raise InputError("--workers are threads of this machine, --scheduler has its own workers: give one of them")
    if workers is None:
        yield scheduler
        return
    from robotics1.inputs import counting_number

    with ThreadPoolExecutor(counting_number("--workers", workers, least=1)) as executor:
        yield executor
