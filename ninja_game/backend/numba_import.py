"""The one place that imports Numba: with the settings of this project, whatever the environment and the folder say.

Numba takes settings from variables NUMBA_… and from ``.numba_config.yaml`` in the current folder. Some of them change
what compiled code computes (the processor's features, the optimizer), others make it fail; so neither reaches it. What
is honoured is HONOURED, and it is read by us.

Three things lean on private parts of Numba, and can be left out should a new one break them: let ``make_pipeline`` give
None, and kernels are as fast, but take half as long again to compile; leave out ``_ConfigFinder``, and a file of
settings in the current folder counts; leave out ``_nrt`` (``code_digest.OPTIONS``), and searches are some 5 % slower.
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
"""Variables of Numba that this program reads: the cache folder, and whether anything is compiled."""

FIXED = {"NUMBA_DEBUGINFO": "0", "NUMBA_ENABLE_PROFILING": "0"}
"""Settings that would follow from variables of other programs (VS_PROFILER)."""

_CONFIG, _CONFIG_FILE = "numba.core.config", ".numba_config.yaml"
_FOREIGN = ("NUMBA_", "NUMPY_", "NPY_", "LLVMLITE_")


class _ConfigLoader:
    """Loads Numba's module of settings with no name of a file in it; ``finds``: the loader that finds its code."""

    def __init__(self, finds: Any) -> None:
        self._finds = finds

    def create_module(self, spec: ModuleSpec) -> None:
        """Give None: Python makes the module itself."""

    def exec_module(self, module: ModuleType) -> None:
        code = self._finds.get_code(_CONFIG)
        exec(  # noqa: S102 - as every loader does
            code.replace(co_consts=tuple("" if value == _CONFIG_FILE else value for value in code.co_consts)),
            vars(module),
        )


class _ConfigFinder:
    """Finds that module, and no other."""

    def find_spec(self, fullname: str, path: Sequence[str] | None, target: Any = None) -> ModuleSpec | None:
        if fullname != _CONFIG:
            return None
        # A frozen program has a module finder of its own.
        specs = (finder.find_spec(fullname, path, target) for finder in sys.meta_path if finder is not self)
        spec = next(filter(None, specs), None)
        if spec:
            spec.loader = _ConfigLoader(spec.loader)  # type: ignore[assignment]  # importing its class takes 11 ms
        return spec


@cache
def warn_once(message: str) -> None:
    """Write a line on stderr, the first time only."""
    sys.stderr.write(f"ninja-game: {message}\n")


def remove_foreign_settings() -> None:
    """Take what NumPy, llvmlite and Numba would read out of the environment, for worker processes too."""
    for name in [name for name in os.environ if name.startswith(_FOREIGN) and name not in HONOURED]:
        del os.environ[name]


def import_numba() -> Any:
    """Numba, with its settings as they are by default; one thread at a time may call this.

    Raises ImportError where Numba was imported before and its settings cannot be set back.
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
    # Also if Numba was imported before. The number of threads cannot change then; we do not use it.
    settings.process_environ(FIXED | {"NUMBA_NUM_THREADS": config.NUMBA_NUM_THREADS})
    # Numba asks again before each function that it compiles.
    settings.update = lambda **_: None
    return numba


@cache
def make_pipeline() -> type | None:
    """What ``numba.njit`` takes as ``pipeline_class``; None for a Numba without the private parts that this needs.

    Numba makes machine code of every function that it compiles, and optimizes it together with all functions that it
    calls. Of rules only kernels run, and they hold copies of all others; so the others are left as LLVM's code,
    which is optimized in the kernel. That saves a third of the time, and the kernels are as fast.
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
        """The code of a function that is copied into others and never runs by itself."""

        def _optimize_final_module(self) -> None:
            """Nothing: it is optimized where it is copied to."""

        def _finalize_final_module(self) -> None:
            """Make no machine code of it."""
            self._finalize_dynamic_globals()
            self._finalized = True

    @register(mutates_CFG=True, analysis_only=False)
    class RuleLowering(lowering):  # type: ignore[misc, valid-type]
        """Turns a typed function into LLVM's code; a kernel also into machine code."""

        _name = "rule_lowering"

        def run_pass(self, state: Any) -> bool:
            """Only kernels have a wrapper for Python."""
            if not state.flags.no_cpython_wrapper:
                return bool(super().run_pass(state))
            state.library = InnerLibrary(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            state.flags.no_compile = True
            super().run_pass(state)
            state.flags.no_compile = False
            # Each time another built-in function: callers find the library by it.
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
