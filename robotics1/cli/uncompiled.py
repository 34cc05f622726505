"""One answer of a kernel costs less in Python than compiling it: a command that wants one runs without the compiler."""

import sys
from pathlib import Path

COMMANDS = ("robotics1", "robotics1.exe", "robotics1-script.py", "__main__.py")


def run_without_compiler() -> None:
    """Keep Numba out of this process, where it is one of the command alone and no kernel has been imported.

    The kernels are plain Python functions, which run uncompiled where Numba is missing: some 100 times slower, with the
    same answers. To import Numba and compile takes four seconds or more, and to load its machine code half of one.
    """
    main = getattr(sys.modules.get("__main__"), "__file__", None)
    own = main is not None and Path(main).name in COMMANDS
    if own and "numba" not in sys.modules and "robotics1.kernels.compilation" not in sys.modules:
        sys.modules["numba"] = None  # type: ignore[assignment]  # importing it then raises ImportError
