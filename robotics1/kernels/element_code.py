"""How an element of an array is written for LLVM: what kernels do most, in few instructions.

Numba's own code for a[i, j] copies the description of the array, tells slices, new axes and lists of indices apart, and
first searches all its libraries for a shorter way. It is optimized away later, and takes a tenth of a compilation.
"""

from typing import Any

from llvmlite.ir import Constant, Value
from numba.core.compiler_machinery import register_pass
from numba.core.ir import Expr, StaticSetItem
from numba.core.lowering import Lower
from numba.core.typed_passes import NativeLowering
from numba.core.types import Array, Integer, float64, int64, intp
from numba.core.types.containers import BaseTuple

DATA, SHAPE = 4, 5  # the places in Numba's description of an array
NUMBERS = {float64, int64}


@register_pass(mutates_CFG=True, analysis_only=False)
class KernelLowering(NativeLowering):  # type: ignore[misc]
    """Numba's pass that writes a function for LLVM, with `ElementCode`."""

    _name = "kernel_lowering"

    @property
    def lowering_class(self) -> type[Lower]:
        """Return what writes it."""
        return ElementCode


class ElementCode(Lower):  # type: ignore[misc]
    """Numba's writer for LLVM, which writes elements of contiguous arrays by itself."""

    def lower_inst(self, inst: Any) -> None:
        """Write a statement: a[0] = x as a[i] = x."""
        if isinstance(inst, StaticSetItem) and isinstance(self.typeof(inst.target.name), Array):
            self.lower_setitem(inst.target, inst.index_var, inst.value, self.fndesc.calltypes[inst])
        else:
            super().lower_inst(inst)

    def lower_expr(self, resty: Any, expr: Expr) -> Value:
        """Write an expression: a[0] as a[i]."""
        if expr.op == "static_getitem" and isinstance(self.typeof(expr.value.name), Array):
            return self.lower_getitem(resty, expr, expr.value, expr.index_var, self.fndesc.calltypes[expr])
        return super().lower_expr(resty, expr)

    def lower_getitem(self, resty: Any, expr: Expr, value: Any, index: Any, signature: Any) -> Value:
        """Write a[i], a[i, j], ..."""
        if not self._is_an_element(value, index):
            return super().lower_getitem(resty, expr, value, index, signature)
        return self.builder.load(self._address(value, index))

    def lower_setitem(self, target: Any, index: Any, value: Any, signature: Any) -> None:
        """Write a[i] = x, a[i, j] = x, ..."""
        if not self._is_an_element(target, index):
            super().lower_setitem(target, index, value, signature)
            return
        kind = self.typeof(target.name).dtype
        number = self.context.cast(self.builder, self.loadvar(value.name), self.typeof(value.name), kind)
        self.builder.store(number, self._address(target, index))

    def _is_an_element(self, array: Any, index: Any) -> bool:
        """Whether a contiguous array of numbers has one integer for each axis."""
        kind, types = self.typeof(array.name), self._types(index)
        plain = isinstance(kind, Array) and kind.layout == "C" and kind.aligned and kind.dtype in NUMBERS
        return plain and len(types) == kind.ndim and all(isinstance(each, Integer) for each in types)

    def _types(self, index: Any) -> tuple[Any, ...]:
        kind = self.typeof(index.name)
        return tuple(kind.types) if isinstance(kind, BaseTuple) else (kind,)

    def _address(self, array: Any, index: Any) -> Value:
        """Write where an element is: (i n₂ + j) n₃ + k behind the first; a negative index counts from the end."""
        builder, description, given = self.builder, self.loadvar(array.name), self.loadvar(index.name)
        behind = Constant(self.context.get_value_type(intp), 0)
        for axis, kind in enumerate(self._types(index)):
            entry = builder.extract_value(given, axis) if isinstance(self.typeof(index.name), BaseTuple) else given
            i = self.context.cast(builder, entry, kind, intp)
            size = builder.extract_value(description, (SHAPE, axis))
            negative = builder.icmp_signed("<", i, Constant(i.type, 0))
            i = builder.select(negative, builder.add(i, size), i)
            behind = builder.add(builder.mul(behind, size), i) if axis else i
        return builder.gep(builder.extract_value(description, DATA), [behind])
