"""The compiler of the kernels: Numba where it can be imported, else Python itself runs the same functions."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])

try:
    import numba
except ImportError:  # the kernels are plain Python on NumPy arrays, so they serve uncompiled: some 100 times slower
    numba = None

COMPILED = numba is not None
prange = numba.prange if COMPILED else range


def compiled(*, parallel: bool = False, contract: bool = False) -> Callable[[Function], Function]:
    """Return a decorator that compiles a function with Numba on its first call, and keep the machine code on disk.

    The code is kept beside the source, else in the user's cache directory (NUMBA_CACHE_DIR names another); where
    none of them can be written, each process compiles anew.

    Args:
        parallel: `prange` runs on all cores.
        contract: allow a·b + c in one rounding (fused), which is faster, and sums in another order; NaN stays NaN.
    """
    options: dict[str, Any] = {"nogil": True, "parallel": parallel, "error_model": "numpy"}
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
