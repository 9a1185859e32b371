"""Problems of a level and of a run of it. Nothing here needs NumPy, so that the editor starts without it."""

from __future__ import annotations

from functools import lru_cache

from ninja_game.levels.findings import Finding
from ninja_game.levels.lint import level_findings
from ninja_game.runs.messages import late_messages
from ninja_game.sim.level import Level


@lru_cache(maxsize=1024)
def level_problems(level: Level, says: str = "", inputs: bytes = b"") -> list[Finding]:
    """What is odd about a level: the same in the editor and in its pack.

    ``inputs``: of a known run, in which messages may come late. Raises LevelError for messages that cannot be read.
    """
    odd = [*level_findings(level, says), *late_messages(level, says, inputs)]
    # One finding is enough for an enclosed exit: its switch gets one once the exit can be reached.
    shut = {number for finding in odd if finding.code == "unreachable" for number in finding.records}
    return [finding for finding in odd if finding.code != "unreachable-switch" or not shut.issuperset(finding.records)]
