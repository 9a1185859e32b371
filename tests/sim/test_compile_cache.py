"""The cache of compiled code: one folder for each version of the sources, and only the newest few are kept."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from ninja_game import compile_cache
from ninja_game.compile_cache import (
    KEPT_VERSIONS,
    MemoryUnavailableError,
    choose_memory,
    forget_old_code,
    source_digest,
)


def test_only_the_newest_versions_are_kept(tmp_path: Path) -> None:
    for age in range(KEPT_VERSIONS + 3):
        (tmp_path / f"v{age}").mkdir()
        (tmp_path / f"v{age}" / "code.nbc").touch()
        os.utime(tmp_path / f"v{age}", (1_000_000 - age, 1_000_000 - age))
    forget_old_code(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"v{age}" for age in range(KEPT_VERSIONS)]


def test_a_missing_folder_is_no_error(tmp_path: Path) -> None:
    forget_old_code(tmp_path / "nothing")


def test_the_digest_follows_the_sources(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in ("sim", "batch", "solver"):
        (tmp_path / folder).mkdir()
    monkeypatch.setattr(compile_cache, "__file__", str(tmp_path / "compile_cache.py"))
    before = source_digest()
    (tmp_path / "batch" / "no_rule.py").write_text("x = 1\n", encoding="utf-8")
    assert source_digest() == before
    (tmp_path / "sim" / "rule.py").write_text("x = 1\n", encoding="utf-8")
    assert source_digest() != before


@pytest.mark.skipif(not compile_cache.compiled_available(), reason="Numba is not installed")
@pytest.mark.parametrize("first", ["", "import numba; "])
def test_threads_may_ask_for_kernels_at_once_whoever_imported_numba(first: str) -> None:
    program = (
        f"{first}from concurrent.futures import ThreadPoolExecutor as Pool\n"
        "from ninja_game.compile_cache import kernels\n"
        "with Pool(8) as pool: tables = list(pool.map(lambda _: kernels(), range(8)))\n"
        "import numba, os\n"
        "assert numba.config.CACHE_DIR == os.environ['NUMBA_CACHE_DIR'], numba.config.CACHE_DIR\n"
        "print(len({id(table['run_world']) for table in tables}))\n"
    )
    environment = {name: value for name, value in os.environ.items() if name != "NUMBA_CACHE_DIR"}
    done = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("1\n", "")


def test_without_numba_auto_is_plain_and_compiled_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(compile_cache, "compiled_available", lambda: False)
    assert choose_memory("auto") == "plain"
    with pytest.raises(MemoryUnavailableError, match="fast"):
        choose_memory("compiled")
