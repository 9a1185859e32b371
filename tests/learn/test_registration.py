"""The ids of the environments: known to Gymnasium in whatever order things are imported."""

from __future__ import annotations

import subprocess
import sys

import pytest

from ninja_game.environments import ENVIRONMENTS


def printed(code: str) -> str:
    """What a fresh Python prints."""
    result = subprocess.run([sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return result.stdout.strip()


@pytest.mark.parametrize(
    "imports", ["import gymnasium, ninja_game", "import ninja_game, gymnasium", "import ninja_game.learn, gymnasium"]
)
def test_ids_are_known_in_either_order_of_the_imports(imports: str) -> None:
    code = f"{imports}; import sys; print(*(k for k in gymnasium.registry if k.startswith('Ninja')))"
    assert printed(code).split() == list(ENVIRONMENTS)


def test_an_id_with_the_module_imports_the_module() -> None:
    assert (
        printed("import gymnasium; print(gymnasium.envs.registration._find_spec('ninja_game:Ninja-v0').id)")
        == "Ninja-v0"
    )


def test_registering_twice_changes_nothing_and_warns_of_nothing() -> None:
    code = "import gymnasium, ninja_game.environments as e; e.register(); e.register(); print('done')"
    assert printed(code) == "done"


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


def test_a_program_may_look_for_gymnasium_and_import_it_later() -> None:
    code = """
import ninja_game, importlib.util
print(importlib.util.find_spec("gymnasium").name, importlib.util.find_spec("nothing"))
import gymnasium
print("Ninja-v0" in gymnasium.registry)
"""
    assert printed(code) == "gymnasium None\nTrue"
