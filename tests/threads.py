"""Many calls from many threads at once, and what of the process must be as before."""

import os
import sys
import warnings
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from threading import Barrier

import numpy as np

THREADS = 4
LONGEST = 300  # seconds: what takes longer hangs


def in_threads(calls, threads=THREADS):
    """The answers of each thread to all the calls, which the threads begin at once and in turned orders.

    The interpreter changes between the threads as often as it can.
    """
    begin = Barrier(threads, timeout=LONGEST)

    def answers(number):
        begin.wait()
        first = number * len(calls) // threads  # another one for each, so that they meet in different calls
        found = [call() for call in calls[first:] + calls[:first]]
        rest = len(calls) - first
        return found[rest:] + found[:rest]

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    pool = ThreadPoolExecutor(threads)
    try:
        waiting = [pool.submit(answers, number) for number in range(threads)]
        return [future.result(timeout=LONGEST) for future in waiting]
    finally:
        sys.setswitchinterval(interval)
        pool.shutdown(wait=False, cancel_futures=True)


def open_files():
    """File descriptor → what it is open on."""
    found = {}
    for number in os.listdir("/proc/self/fd"):
        try:
            found[int(number)] = os.readlink(f"/proc/self/fd/{number}")
        except FileNotFoundError:  # the descriptor of the listing itself
            continue
    return found


def state_of_the_process():
    """What a call must leave alone: functions of the libraries, streams, files, filters, random numbers, precision."""
    import flint
    import mpmath
    import sympy
    import xacro
    from xacro import substitution_args

    tables = {"xacro": vars(xacro), "substitutions": vars(substitution_args), "sympy": vars(sympy)}
    functions = {
        (name, key): value for name, table in tables.items() for key, value in table.items() if callable(value)
    }
    symbols = {key: value for key, value in xacro._global_symbols.items() if callable(value)}
    kind, keys, *rest = np.random.get_state()  # noqa: NPY002 (what is not ours is to stay as it is)
    return {
        "functions": functions,
        "symbols": symbols,
        "streams": (sys.stdin, sys.stdout, sys.stderr, sys.excepthook, sys.displayhook, sys.getrecursionlimit()),
        "files": open_files(),
        "filters": list(warnings.filters),
        "showwarning": warnings.showwarning,
        "numpy": np.geterr(),
        "random": (kind, keys.tobytes(), *rest),
        "precision": (mpmath.mp.prec, flint.ctx.prec, flint.ctx.threads),
        "place": (os.getcwd(), dict(os.environ), os.umask(os.umask(0o22))),
    }


@contextmanager
def unchanged():
    """The state of the process is the same afterwards."""
    before = state_of_the_process()
    yield
    after = state_of_the_process()
    for name, value in before.items():
        assert after[name] == value, name
