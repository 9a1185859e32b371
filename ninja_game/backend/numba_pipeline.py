"""How Numba compiles rules: machine code is made of entry points only.

Numba makes machine code of every function that it compiles, and optimizes it together with all functions that it calls.
Of rules only entry points run, and they hold copies of all others; so the others are left as LLVM's code, which is
optimized in the entry point. That saves a third of the time, and the kernels are as fast.
"""

from __future__ import annotations

from functools import cache
from typing import Any


@cache
def make_pipeline() -> type | None:
    """What ``numba.njit`` takes as ``pipeline_class``; None for a Numba without the private parts that this needs."""
    try:
        return _make_pipeline()
    except (ImportError, AttributeError):
        return None


def _make_pipeline() -> type:
    from numba.core import codegen, compiler, compiler_machinery, typed_passes

    base, lowering, library = compiler.CompilerBase, typed_passes.NativeLowering, codegen.JITCodeLibrary
    make_passes: Any = compiler.DefaultPassBuilder.define_nopython_pipeline
    register: Any = compiler_machinery.register_pass
    passes: Any = compiler_machinery.PassManager
    for needed in ("_optimize_final_module", "_finalize_final_module", "_finalize_dynamic_globals"):
        getattr(library, needed)

    class InnerLibrary(library):  # type: ignore[misc, valid-type]
        """The code of a function that is copied into others and never runs by itself."""

        def _optimize_final_module(self) -> None:
            """Nothing: it is optimized where it is copied to."""

        def _finalize_final_module(self) -> None:
            """Make no machine code of it."""
            self._finalize_dynamic_globals()
            self._finalized = True

    @register(mutates_CFG=True, analysis_only=False)
    class RuleLowering(lowering):  # type: ignore[misc, valid-type]
        """Turns a typed function into LLVM's code; an entry point also into machine code."""

        _name = "rule_lowering"

        def run_pass(self, state: Any) -> bool:
            """What has a wrapper for Python is an entry point."""
            if not state.flags.no_cpython_wrapper:
                return bool(super().run_pass(state))
            state.library = InnerLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            state.flags.no_compile = True
            super().run_pass(state)
            state.flags.no_compile = False
            # A function that is built in, and another one each time: callers find the library by it.
            stand_in: Any = [].append
            state.cr = state.cr._replace(cfunc=stand_in)
            state.targetctx.insert_user_function(stand_in, state.cr.fndesc, [state.library])
            return True

    class RulePipeline(base):  # type: ignore[misc, valid-type]
        """Numba's own passes, with another last but one."""

        def define_pipelines(self) -> list[Any]:
            rules = passes("rules")
            for each, why in make_passes(self.state).passes:
                rules.add_pass(RuleLowering if each is lowering else each, why)
            rules.finalize()
            return [rules]

    return RulePipeline
