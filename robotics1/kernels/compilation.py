"""The compiler of the kernels: Numba where it can be imported, else Python itself runs the same functions."""

import logging
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from typing import Any, TypeVar, cast

Function = TypeVar("Function", bound=Callable[..., Any])

try:
    import numba
except ImportError:  # the kernels are plain Python on NumPy arrays, so they serve uncompiled: some 100 times slower
    numba = None

COMPILED = numba is not None and not numba.config.DISABLE_JIT
log = logging.getLogger(__name__)
KEPT = ", once; the machine code is kept for the next time"
NOT_KEPT = ", in each process: no directory can be written to that would keep the machine code"
SLICES = 8  # a core gets, since some take longer than others


def compiled(*, contract: bool = False, inline: bool = False, inner: bool = False) -> Callable[[Function], Function]:
    """Return a decorator that compiles a function with Numba on its first call, and keep the machine code on disk.

    The code is kept beside the source, else in the user's cache directory (NUMBA_CACHE_DIR names another); where
    none of them can be written, and where what is there is damaged, it compiles anew.

    Args:
        inline: write the machine code into that of each caller: for the parts of a step, whose calls would take a
            fifth of its time.
        inner: only other kernels call it: it has no way in from Python, and no machine code but theirs. Unless it makes
            or returns arrays, it counts no references to its arrays, which would take a sixth of the time.
        contract: allow a·b + c in one rounding (fused), which is faster, and sums in another order; NaN stays NaN.
    """
    if COMPILED:
        _announce_the_first()
    options: dict[str, Any] = {"nogil": True, "forceinline": inline}
    options |= {"no_cpython_wrapper": inner}
    options |= {"error_model": "numpy", "no_cfunc_wrapper": True}  # NaN for 0/0; a wrapper that nobody calls
    # False is written, since a function without the option takes that of the caller that compiles it first
    options["fastmath"] = {"contract", "reassoc", "nsz", "arcp"} if contract else False

    def compile_later(function: Function) -> Function:
        if not COMPILED:
            return function
        from robotics1.kernels.machine_code import MachineCode
        from robotics1.kernels.one_program import KernelCompiler, refuse_python

        makes_arrays = not {"empty", "zeros"}.isdisjoint(function.__code__.co_names)
        hands_back = "ndarray" in repr(function.__annotations__.get("return"))  # which the caller then lets go
        counted = {"_nrt": makes_arrays or hands_back or not inner}
        dispatcher = numba.njit(pipeline_class=KernelCompiler, **options, **counted)(function)
        with suppress(RuntimeError):  # "no locator available": there is no directory to write to
            dispatcher._cache = MachineCode(function, inner=inner)
        if inner:
            refuse_python(dispatcher)
        return cast(Function, dispatcher)

    return compile_later


def is_ready(kernel: Callable[..., Any]) -> bool:
    """Whether a kernel runs without being compiled first: it was, in this process or for the code on disk."""
    if not COMPILED:
        return True
    dispatcher = cast(Any, kernel)
    return bool(dispatcher.signatures) or bool(getattr(dispatcher._cache, "holds_code", bool)())


def threads() -> int:
    """Return on how many cores kernels run: all that this process may use, or NUMBA_NUM_THREADS."""
    return int(numba.config.NUMBA_NUM_THREADS) if COMPILED else 1


def on_all_cores(work: Callable[[slice], None], count: int) -> None:
    """Do work on slices that make up 0, ..., count − 1, at once on all cores: a kernel leaves the interpreter free.

    Numba's own parallel loops end the process when it was forked after one of them, or when two threads begin one;
    threads of Python do not.
    """
    workers = min(threads(), count)
    size = -(-count // (SLICES * workers)) if workers > 1 else count
    slices = [slice(i, min(i + size, count)) for i in range(0, count, size)]
    if len(slices) == 1:
        work(slices[0])
        return
    with ThreadPoolExecutor(workers) as pool:
        list(pool.map(work, slices))  # raises what a thread has raised


@cache
def _announce_the_first() -> None:
    """Have the first function that is compiled, and not found on disk, say why the call takes seconds."""
    from numba.core.event import Listener, register

    class Announcement(Listener):  # type: ignore[misc]
        announced = False

        def on_start(self, event: Any) -> None:
            dispatcher = event.data["dispatcher"]
            if not self.announced and dispatcher.py_func.__module__.startswith("robotics1."):
                kept = hasattr(dispatcher._cache, "holds_code")
                log.warning("compiling the kernels: some seconds%s", KEPT if kept else NOT_KEPT)
                self.announced = True

        def on_end(self, event: Any) -> None:
            pass

    register("numba:compile", Announcement())
