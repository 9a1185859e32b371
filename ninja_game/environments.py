"""The ids under which Gymnasium knows the worlds: registered as soon as both it and ninja_game are imported.

``gymnasium.make("ninja_game:Ninja-v0")`` imports ``ninja_game`` and looks the id up. Importing Gymnasium for that would
slow every start of the game, and Gymnasium 1.0 has no entry points for plugins any more; so where Gymnasium is not
imported yet, its import is watched.
"""

from __future__ import annotations

import sys

TYPE_CHECKING = False  # as in the package's first file
if TYPE_CHECKING:
    from typing import Any

ENVIRONMENTS: dict[str, dict[str, Any]] = {
    "Ninja-v0": {},
    "NinjaPixels-v0": {"observation": "pixels"},
    "NinjaSet-v0": {"level": "set"},
    "NinjaTrain-v0": {"level": "train"},
    "NinjaTest-v0": {"level": "test"},
    "NinjaCurriculum-v0": {"level": "curriculum"},
}
"""The registered ids and what they set besides the defaults; docs/learning.md tells what their version fixes."""


def register() -> None:
    """Make the ids known to Gymnasium, which is imported; those that it knows already stay as they are."""
    from gymnasium.envs import registration

    for name, settings in ENVIRONMENTS.items():
        if name not in registration.registry:
            registration.register(
                name,
                entry_point="ninja_game.learn.single:NinjaEnv",
                vector_entry_point="ninja_game.learn.vector:NinjaVectorEnv",
                kwargs=settings,
            )


def register_with_gymnasium() -> None:
    """Register now, or when Gymnasium is imported."""
    if sys.modules.get("gymnasium"):
        register()
    else:
        sys.meta_path.insert(0, _WatchedImport())


class _WatchedImport:
    """A finder of modules that waits for Gymnasium, and lets the other finders find it."""

    def __init__(self) -> None:
        self._asking = False

    def find_spec(self, name: str, path: object = None, target: object = None) -> Any:  # noqa: ARG002
        """None for any other module; of Gymnasium what the others find, with the registration after its import."""
        if name != "gymnasium" or self._asking:
            return None
        from importlib.util import find_spec

        self._asking = True
        try:
            spec = find_spec(name)
        finally:
            self._asking = False
        if spec is not None and spec.loader is not None:
            execute = spec.loader.exec_module

            def execute_and_register(module: Any) -> None:
                execute(module)
                register()

            spec.loader.exec_module = execute_and_register  # type: ignore[method-assign]
        return spec
