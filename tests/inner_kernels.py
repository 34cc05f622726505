"""Kernels that only other kernels call, with a way in from Python."""

from robotics1.kernels.compilation import compiled


def from_python(kernel, **options):
    """The kernel compiled for Python too, with the options of its own decorator."""
    return compiled(**options)(getattr(kernel, "py_func", kernel))
