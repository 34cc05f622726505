"""The compiler of the kernels: Numba where it can be imported, else Python itself runs the same functions."""

import logging
from collections.abc import Callable
from functools import cache
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])

try:
    import numba
except ImportError:  # the kernels are plain Python on NumPy arrays, so they serve uncompiled: some 100 times slower
    numba = None

COMPILED = numba is not None
prange = numba.prange if COMPILED else range
log = logging.getLogger(__name__)


def compiled(*, parallel: bool = False, contract: bool = False, inline: bool = False) -> Callable[[Function], Function]:
    """Return a decorator that compiles a function with Numba on its first call, and keep the machine code on disk.

    The code is kept beside the source, else in the user's cache directory (NUMBA_CACHE_DIR names another); where
    none of them can be written, each process compiles anew.

    Args:
        parallel: `prange` runs on all cores.
        inline: write the machine code into that of each caller: for the parts of a step, whose calls would take a
            fifth of its time.
        contract: allow a·b + c in one rounding (fused), which is faster, and sums in another order; NaN stays NaN.
    """
    if COMPILED:
        _announce_the_first()
    options: dict[str, Any] = {"nogil": True, "parallel": parallel, "forceinline": inline}
    options |= {"error_model": "numpy", "no_cfunc_wrapper": True}  # NaN for 0/0; a wrapper that nobody calls
    if contract:
        options["fastmath"] = {"contract", "reassoc", "nsz", "arcp"}

    def compile_later(function: Function) -> Function:
        if not COMPILED:
            return function
        try:
            return cast(Function, numba.njit(cache=True, **options)(function))
        except RuntimeError:  # "no locator available": there is no directory to write the cache to
            return cast(Function, numba.njit(**options)(function))

    return compile_later


def threads() -> int:
    """Return on how many cores `prange` runs."""
    return int(numba.get_num_threads()) if COMPILED else 1


@cache
def _announce_the_first() -> None:
    """Have the first function that is compiled, and not found on disk, say why the call takes seconds."""
    from numba.core.event import Listener, register, unregister

    class Announcement(Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            if event.data["dispatcher"].py_func.__module__.startswith("robotics1."):
                log.warning("compiling the kernels: some seconds, once; the machine code is kept for the next time")
                unregister("numba:compile", self)

        def on_end(self, event: Any) -> None:
            pass

    register("numba:compile", Announcement())
