"""The ids of the environments, which an import registers where Gymnasium is; without it nothing changes."""

import subprocess
import sys

import pytest

from ninja_game.learn import ENVIRONMENTS


def printed(code: str) -> str:
    """What a fresh Python prints."""
    result = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stdout.strip()


@pytest.mark.parametrize(
    "imports", ["import gymnasium", "import ninja_game, gymnasium", "import ninja_game.learn, gymnasium"]
)
def test_an_id_with_its_module_needs_no_order_of_imports(imports: str) -> None:
    code = f"""
{imports}
print(gymnasium.make("ninja_game.learn:Ninja-v0", memory="plain").spec.id)
print(*(name for name in gymnasium.registry if name.startswith("Ninja")))
"""
    assert printed(code).split() == ["Ninja-v0", *ENVIRONMENTS]


def test_an_id_with_another_module_is_refused_in_any_order_of_imports() -> None:
    code = """
import gymnasium, ninja_game
try:
    gymnasium.make("ninja_game:Ninja-v0")
except gymnasium.error.NameNotFound as error:
    print(error)
"""
    assert printed(code) == "Environment `Ninja` doesn't exist."
    assert printed(code.replace("gymnasium, ninja_game", "ninja_game, gymnasium")) == printed(code)


def test_the_package_is_imported_without_gymnasium() -> None:
    assert printed("import sys, ninja_game; print('gymnasium' in sys.modules, 'numpy' in sys.modules)") == "False False"


def test_without_gymnasium_the_package_works_and_learning_says_how_to_install_it() -> None:
    code = """
import sys
sys.modules["gymnasium"] = None
import ninja_game
print(ninja_game.Simulation(ninja_game.parse_level("0" * 713 + "|5^100,566")).tick)
try:
    import ninja_game.learn
except ImportError as error:
    print(isinstance(error, ninja_game.NinjaGameError), error)
"""
    lines = printed(code).splitlines()
    assert lines[0] == "0"
    assert lines[1].startswith("True ninja_game.learn needs Gymnasium; ")
    assert "install" in lines[1]


def test_importing_the_package_changes_nothing_outside_of_it() -> None:
    code = """
import os, sys
def state():
    return sys.meta_path[:], sys.path[:], dict(os.environ)
before = state()
import ninja_game
print(state() == before)
"""
    assert printed(code) == "True"
