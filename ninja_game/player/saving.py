"""Saving what was played, and the notices about it.

A disk that is full or locked never ends the game: then the notice says so, and saving is tried again.
"""

from __future__ import annotations

from ninja_game.formats.replay.text import Replay
from ninja_game.player.attempt import Attempt
from ninja_game.player.catalogue import Entry
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import WITH_HELP, has_all_gold, medal_of
from ninja_game.player.store import Work

SAVED = ": saved"
OF_A_LEVEL = NEW_BEST, FIRST_PASS, NEW_MEDAL, NEW_ALL_GOLD = "Your best time", "First pass", "New medal", "All gold"
EPISODE_BEST = "Your best for this episode"
REPLAY_KEPT = "Replay" + SAVED
NOT_SAVED = "Not saved yet: {}"


def keep_replay(data: PlayerData, replay: Replay) -> str:
    """Put a replay among the player's, even one that is not the best; a notice about it."""

    def work() -> list[str]:
        data.records.keep_replay(replay)
        return [REPLAY_KEPT]

    return told(data, work)[-1]


def forget_replay(data: PlayerData, number: int) -> str:
    """Remove a replay of the records; why it is still there, or ''."""

    def work() -> list[str]:
        return [] if data.records.forget_replay(number) else ["This is one of your bests, so it stays"]

    return "".join(told(data, work)[-1:])


def told(data: PlayerData, work: Work) -> list[str]:
    """Save ``work``; its notices, none of which says "saved" about what is not on the disk."""
    notices, problem = data.store.save(work)
    if not problem:
        return list(notices)
    return [*(notice.removesuffix(SAVED) for notice in notices), NOT_SAVED.format(problem)]


def replay_of(data: PlayerData, entry: Entry, attempt: Attempt) -> Replay:
    return attempt.replay(entry.title, data.settings.name)


def save_best(data: PlayerData, entry: Entry, replay: Replay) -> list[str]:
    """Save a level's best and its mark; notices of a better time or medal, and the first pass with all gold."""
    level, body = replay.level_digest, replay.body
    data.records.level_passed(replay)
    before = data.marks.of(level, body)
    now = data.marks.passed(level, replay.final_tick, replay.gold, body)
    notices = [FIRST_PASS] if before is None else [NEW_BEST] * (now.fastest < before.fastest)
    if body != "circle":
        return notices
    medal = medal_of(entry, now)
    notices += [NEW_MEDAL] * bool(medal and medal != medal_of(entry, before))
    return notices + [NEW_ALL_GOLD] * (has_all_gold(entry, now) and not has_all_gold(entry, before))


def count_of(
    data: PlayerData, entry: Entry, attempt: Attempt, *, killer: str | None = None, passed: bool = False
) -> Work:
    """What counts an attempt as it is now: passed, killed, or given up; a pass with help gets its mark."""
    level, gold = entry.digest, attempt.gold
    helped = passed and attempt.assisted and not attempt.practice_mode
    ticks = attempt.simulation.tick if attempt.outcome == "running" else max(attempt.ended_tick, 0)

    def work() -> list[str]:
        data.statistics.attempt_ended(level, killer=killer, passed=passed, ticks=ticks, gold=gold)
        if helped:
            data.marks.passed(level, ticks, gold, WITH_HELP)
        return []

    return work
