"""The only import of Numba, with the settings of this project, whatever the environment and the folder say.

Numba takes settings from variables NUMBA_… and from ``.numba_config.yaml`` in the current folder. Some change what
compiled code computes (the processor's features, the optimizer), others make it fail. So it gets neither; this module
reads the variables of HONOURED itself.

Three things use private parts of Numba and can be left out if a new version breaks them. If ``make_pipeline`` gives
None, kernels are as fast, but take half as long again to compile. Without ``_ConfigFinder``, a file of settings in the
current folder counts. Without ``_nrt`` (``code_digest.OPTIONS``), searches are some 5 % slower.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import cache
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any
from warnings import catch_warnings, simplefilter

HONOURED = ("NUMBA_CACHE_DIR", "NUMBA_DISABLE_JIT")
"""Variables of Numba that this program reads: the cache folder, and whether to compile anything."""

FIXED = {"NUMBA_DEBUGINFO": "0", "NUMBA_ENABLE_PROFILING": "0"}
"""Settings that variables of other programs (VS_PROFILER) would change."""

_CONFIG, _CONFIG_FILE = "numba.core.config", ".numba_config.yaml"
_FOREIGN = ("NUMBA_", "NUMPY_", "NPY_", "LLVMLITE_")


class _ConfigLoader:
    """Loads Numba's module of settings without the name of a file in it; ``finds``: the loader that finds its code."""

    def __init__(self, finds: Any) -> None:
        self._finds = finds

    def create_module(self, spec: ModuleSpec) -> None:
        """Give None, so that Python makes the module."""

    def exec_module(self, module: ModuleType) -> None:
        code = self._finds.get_code(_CONFIG)
        exec(  # noqa: S102 - as every loader does
            code.replace(co_consts=tuple("" if value == _CONFIG_FILE else value for value in code.co_consts)),
            vars(module),
        )


class _ConfigFinder:
    """Finds that module only."""

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: Any = None) -> ModuleSpec | None:
        if fullname != _CONFIG:
            return None
        # A frozen program has its own module finder.
        specs = (finder.find_spec(fullname, path, target) for finder in sys.meta_path if finder is not self)
        spec = next(filter(None, specs), None)
        if spec:
            spec.loader = _ConfigLoader(spec.loader)  # type: ignore[assignment]  # importing its class takes 11 ms
        return spec


@cache
def warn_once(message: str) -> None:
    """Write a line to stderr, the first time only."""
    sys.stderr.write(f"ninja-game: {message}\n")


def remove_foreign_settings() -> None:
    """Remove from the environment what NumPy, llvmlite and Numba would read, for worker processes too."""
    for name in [name for name in os.environ if name.startswith(_FOREIGN) and name not in HONOURED]:
        del os.environ[name]


def import_numba() -> Any:
    """Import Numba with its default settings; only one thread at a time may call this.

    Raises ImportError if Numba was imported before and its settings cannot be reset.
    """
    imported_before = "numba" in sys.modules
    remove_foreign_settings()
    finder = _ConfigFinder()
    sys.meta_path.insert(0, finder)
    try:
        with catch_warnings():
            simplefilter("ignore")
            import numba
            from numba.core import config as found
    finally:
        sys.meta_path.remove(finder)
    config: Any = found
    settings = getattr(config, "_env_reloader", None)  # there is no public way
    if settings is None and imported_before:
        raise ImportError(f"the settings of Numba {numba.__version__} cannot be set back")
    if settings is None:
        return numba
    # This also covers an earlier import of Numba. The number of threads cannot change then; we do not use it.
    settings.process_environ(FIXED | {"NUMBA_NUM_THREADS": config.NUMBA_NUM_THREADS})
    # Numba reads the environment again before every function that it compiles.
    settings.update = lambda **_: None
    return numba


@cache
def make_pipeline() -> type | None:
    """Make the value of ``numba.njit``'s ``pipeline_class``; None if Numba lacks the private parts that this needs.

    Numba makes machine code of every function that it compiles, and optimizes it together with all functions that it
    calls. Of the rules only kernels run, with copies of all others inside; so the others are left as LLVM's code, which
    is optimized in the kernel. That saves a third of the time, and the kernels are as fast.
    """
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
        """The code of a function that is only copied into others and never runs by itself."""

        def _optimize_final_module(self) -> None:
            """Do nothing: the code is optimized in the function that it is copied to."""

        def _finalize_final_module(self) -> None:
            """Make no machine code of it."""
            self._finalize_dynamic_globals()
            self._finalized = True

    @register(mutates_CFG=True, analysis_only=False)
    class RuleLowering(lowering):  # type: ignore[misc, valid-type]
        """Turns a typed function into LLVM's code, and a kernel also into machine code."""

        _name = "rule_lowering"

        def run_pass(self, state: Any) -> bool:
            """Lower a function; only kernels get a wrapper for Python."""
            if not state.flags.no_cpython_wrapper:
                return bool(super().run_pass(state))
            state.library = InnerLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            state.flags.no_compile = True
            super().run_pass(state)
            state.flags.no_compile = False
            # A new built-in function each time: callers look the library up by it.
            stand_in: Any = [].append
            state.cr = state.cr._replace(cfunc=stand_in)
            state.targetctx.insert_user_function(stand_in, state.cr.fndesc, [state.library])
            return True

    class RulePipeline(base):  # type: ignore[misc, valid-type]
        """Numba's own passes, with another last but one."""

        def define_pipelines(self) -> list[Any]:
            rules = passes("rules")
            for pass_, why in make_passes(self.state).passes:
                rules.add_pass(RuleLowering if pass_ is lowering else pass_, why)
            rules.finalize()
            return [rules]

    return RulePipeline
