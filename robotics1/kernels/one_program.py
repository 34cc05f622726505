"""How a kernel is compiled: as one program with all functions it calls, optimized and translated once.

Numba optimizes each function by itself, with all it calls, and makes machine code of it: a function that is called
through five others is translated six times. Here the inner functions are typed and lowered only; the function that
Python calls is optimized and translated together with them, once. It runs as fast, within a few percent.
"""

from functools import cache
from typing import Any

from llvmlite.binding import Linkage
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder, Flags
from numba.core.compiler_machinery import PassManager
from numba.core.targetconfig import ConfigStack
from numba.core.types import Function
from numba.core.typing import Context

# Passes for what no kernel has: closures, `with` blocks, branches on types, literals, array expressions.
NOT_NEEDED = {
    "with_lifting",
    "inline_closure_likes",
    "rewrite_semantic_constants",
    "dead_branch_prune",
    "rewrite_dynamic_raises",
    "make_function_op_code_to_jit_function",
    "inline_inlinables",
    "find_literally",
    "literal_unroll",
    "literal_propagation",
    "inline_overloads",
    "nopython_rewrites",
    "annotate_types",
    "dump_parfor_diagnostics",
}
END_OF_LIVES = "ir_legalization"  # where each variable is let go, which matters to those that count references


class KernelCompiler(CompilerBase):  # type: ignore[misc]
    """Numba's compiler without the passes that kernels do not need, and without machine code of inner functions."""

    def _compile_bytecode(self) -> Any:
        self.state.flags = SharedFlags(self.state.flags)
        self.state.typingctx = remembering(self.state.typingctx)
        return super()._compile_bytecode()

    def define_pipelines(self) -> list[PassManager]:
        """Return the one pipeline, as Numba asks for it."""
        state = self.state
        if state.library is None:
            code = InnerCode if state.flags.no_cpython_wrapper else WholeProgram
            state.library = code(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
        usual = DefaultPassBuilder.define_nopython_pipeline(state)
        pipeline = Passes(usual.pipeline_name)
        unneeded = NOT_NEEDED if state.flags.nrt else NOT_NEEDED | {END_OF_LIVES}
        pipeline.passes = [each for each in usual.passes if each[0]._name not in unneeded]
        pipeline.finalize()
        return [pipeline]


def refuse_python(dispatcher: Any) -> None:
    """Have an inner kernel, which has no way in from Python, raise TypeError there; else the call ends the process."""

    def refuse(*_: object, **__: object) -> None:
        raise TypeError(f"{dispatcher.py_func.__name__} is called by other kernels only; Python can call its py_func")

    def keep(compiled: Any) -> None:
        dispatcher.overloads[tuple(compiled.signature.args)] = compiled

    dispatcher.add_overload, dispatcher._compile_for_args = keep, refuse


class Passes(PassManager):  # type: ignore[misc]
    """Numba's passes one after the other, neither timed nor announced nor checked after each of them."""

    def _runPass(self, index: int, each: Any, state: Any) -> None:
        each.analysis = self._analysis
        each.run_initialization(state)
        each.run_pass(state)
        each.run_finalizer(state)


class TypesOfCalls(Context):  # type: ignore[misc]
    """Numba's context of types, which remembers what an operation returns for the types of its arguments.

    Numba asks every overload of every + and * anew, those of strings and dates too: a fifth of the compilation.
    """

    remembered: dict[Any, Any]

    def _resolve_user_function_type(self, func: Any, args: Any, kws: Any, literals: Any = None) -> Any:
        own = self._lookup_global(func) or func
        if not isinstance(own, Function):
            return super()._resolve_user_function_type(func, args, kws, literals)
        key = own, tuple(args), tuple(kws.items()), ConfigStack.top_or_none()
        if key not in self.remembered:
            self.remembered[key] = super()._resolve_user_function_type(func, args, kws, literals)
        return self.remembered[key]


@cache
def remembering(context: Context) -> TypesOfCalls:
    """Return a view of a context of types that remembers."""
    view = object.__new__(TypesOfCalls)
    view.__dict__ = context.__dict__
    view.remembered = {}
    return view


class SharedFlags(Flags):  # type: ignore[misc]
    """Numba's flags of a compilation, equal if they mean the same to what a kernel calls of NumPy.

    Numba asks tens of thousands of times, and compiles np.empty anew for flags that are not equal.
    """

    def __init__(self, flags: Flags) -> None:
        super().__init__(flags)
        own = ("forceinline", "no_cpython_wrapper")  # of the function itself
        self.handed_on = repr(sorted((name, value) for name, value in self._values.items() if name not in own))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SharedFlags) and self.handed_on == other.handed_on

    def __hash__(self) -> int:
        return hash(self.handed_on)


class WholeProgram(JITCodeLibrary):  # type: ignore[misc]
    """What Python calls, with copies of all it calls that are its own.

    Otherwise the loader takes for each function the copy of the kernel that was loaded first; as this one was optimized
    with other callers, it rounds otherwise, and the last digits of an answer depend on what was asked before.
    """

    def _optimize_final_module(self) -> None:
        for function in self._final_module.functions:
            if not function.is_declaration and function.linkage == Linkage.linkonce_odr:
                function.linkage = Linkage.internal
        super()._optimize_final_module()


class InnerCode(JITCodeLibrary):  # type: ignore[misc]
    """What those that call it are linked with: neither optimized nor translated, since Python does not call it."""

    @property
    def codegen(self) -> "InnerCode":
        """Return what Numba hands the environment to; code that runs without the interpreter reads none."""
        return self

    def set_env(self, name: str, environment: object) -> None:
        """Do nothing: there is no machine code that would have a place for it."""

    def get_pointer_to_function(self, name: str) -> int:
        """Return that there is no way in from Python."""
        self._ensure_finalized()
        return 0

    def serialize_using_object_code(self) -> Any:
        """Return what is kept on disk: there is no object code."""
        return self.serialize_using_bitcode()

    def _optimize_final_module(self) -> None:
        pass

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True
