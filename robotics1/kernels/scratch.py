"""Working space of a kernel: arrays that live on the stack while the function runs, and are never returned.

`np.empty` asks for memory and counts references, atomically: a sixth of the time of a target of six joints.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import COMPILED

Shape = int | tuple[int, ...]  # of numbers that the compiler sees


def scratch(shape: Shape) -> Array:
    """Return an array of numbers that nobody has set, for the time of the call."""
    return np.empty(shape)


def scratch_indices(shape: Shape) -> Indices:
    """Return an array of whole numbers that nobody has set, for the time of the call."""
    return np.empty(shape, dtype=np.int64)


def _on_the_stack(plain: Callable[..., Any], of: str) -> Callable[..., Any]:
    """Return what is called in compiled code instead: it makes room in the frame of the function that calls."""
    from numba import config

    if config.DISABLE_JIT:
        return plain
    from numba.core import cgutils, types
    from numba.extending import intrinsic
    from numba.np.arrayobj import make_array, populate_array

    number = getattr(types, of)

    def room(context: Any, shape: Any) -> Any:
        sizes = [size.literal_value for size in getattr(shape, "types", [shape])]
        kind = types.Array(number, len(sizes), "C")

        def code(target: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            word = target.get_data_type(number)
            data = cgutils.alloca_once(builder, word, size=int(np.prod(sizes)))
            array = make_array(kind)(target, builder)
            strides = [8 * int(np.prod(sizes[i + 1 :])) for i in range(len(sizes))]
            shapes, steps = ([target.get_constant(types.intp, n) for n in some] for some in (sizes, strides))
            populate_array(
                array, data=data, shape=shapes, strides=steps, itemsize=target.get_constant(types.intp, 8), meminfo=None
            )
            return array._getvalue()

        return kind(shape), code

    stack: Callable[..., Any] = intrinsic(prefer_literal=True)(room)
    return stack


if COMPILED:
    globals()["scratch"] = _on_the_stack(scratch, "float64")
    globals()["scratch_indices"] = _on_the_stack(scratch_indices, "int64")
