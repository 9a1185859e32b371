"""The worlds as Gymnasium environments, single and vector, with what learning needs around them (docs/learning.md)."""

from __future__ import annotations

from ninja_game.errors import MissingExtraError
from ninja_game.files.resources import how_to_install

try:
    import gymnasium  # noqa: F401 - its import registers the ids of the environments
except ModuleNotFoundError as error:
    raise MissingExtraError(f"ninja_game.learn needs Gymnasium; {how_to_install('learn')}") from error
