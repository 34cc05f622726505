"""One thread for every library that would take more: their pools read the environment before NumPy is imported."""

import os
import sys

VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
    "RAYON_NUM_THREADS",
)


def one_thread() -> None:
    """Start this program again with the pools of all libraries set to one thread, unless they are."""
    if all(os.environ.get(variable) == "1" for variable in VARIABLES):
        return
    environment = os.environ | dict.fromkeys(VARIABLES, "1")
    os.execve(sys.executable, [sys.executable, *sys.orig_argv[1:]], environment)
