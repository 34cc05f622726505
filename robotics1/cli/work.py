"""The options of commands that work in chunks, on the cores of this machine or on a cluster."""

from __future__ import annotations

from collections.abc import Callable, Iterator
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
def opened_work(
    doing: str, workers: int | None, scheduler: str | None, at_the_end: str = ""
) -> Iterator[tuple[Callable[[int, int], None], Any]]:
    """Show a progress bar, see `progress_bar`, and open the executor: the two arguments `progress` and `executor`."""
    from robotics1.cli.output import progress_bar

    with progress_bar(doing, at_the_end) as progress, opened_executor(workers, scheduler) as executor:
        yield progress, executor


@contextmanager
def opened_executor(workers: int | None, scheduler: str | None) -> Iterator[Any]:
    """Open the executor that --workers or --scheduler names; None for all cores of this machine.

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
