"""What is written over a level being played, by its phase."""

from __future__ import annotations

import pygame

from ninja_game.play.level.hud import Hud
from ninja_game.play.level.phase import DEATH_PAUSE, Phase
from ninja_game.play.level.play import LevelPlay
from ninja_game.player.scoring import seconds_text
from ninja_game.player.statistics import SELF


def write_over(screen: LevelPlay, surface: pygame.Surface) -> list[pygame.Rect]:
    """Time bar, name, notices, message; the px that they cover."""
    hud = Hud(screen.app.theme)
    attempt = screen.attempt
    practice = "Practice" + (", slow motion" if screen.practice.slow else "")
    bar = hud.label(surface, practice) if attempt.practice else hud.time_bar(surface, screen.shown_lifetime)
    written = [bar, hud.level_name(surface, screen.course.title, f"gold {attempt.gold} / {screen.all_gold}")]
    if screen.app.settings.show_frame_time:
        written.append(hud.frame_time(surface, screen.app.frame_ms))
    if screen.app.settings.show_keys:
        written.append(hud.keys(surface, screen.last_keys))
    if screen.notices:
        written.append(hud.notices(surface, screen.notices))
    message = _message(screen)
    if message is not None:
        written.append(hud.message(surface, *message))
    hint = _hint(screen)
    if hint:
        written.append(hud.hint(surface, hint))
    return written


def _message(screen: LevelPlay) -> tuple[str, list[str]] | None:
    """Title and lines of the message of this phase; None if it has none."""
    key = screen.app.controls.name
    if screen.phase is Phase.PAUSED and screen.app.top is screen:
        return "Paused", [f"{key('confirm')}: go on", f"{key('retry')}: retry", f"{key('quit')}: leave"]
    if screen.phase is Phase.PASSED:
        attempt = screen.attempt
        gold = f"{attempt.gold} of {screen.all_gold} gold"
        return f"Passed with {seconds_text(attempt.score)}", [
            gold,
            f"{key('confirm')}: go on    {key('replay')}: replay",
        ]
    return None


def _tools(screen: LevelPlay) -> str:
    """The practice tools and their keys."""
    key = screen.app.controls.name
    tools = (("quick_save", "save"), ("quick_load", "load"), ("rewind", "rewind"), ("slow", "slow"), ("step", "step"))
    named = [f"{key(action)}: {name}" for action, name in tools]
    return "    ".join([*named, f"{key('overlay_hitboxes')} to {key('overlay_cells')}: look inside"])


def _epitaph(screen: LevelPlay) -> str:
    """What happened, in a few words."""
    if screen.attempt.own_hand:
        return "As you wish."
    if screen.killer != SELF:
        return f"Killed by a {screen.killer}."
    return "Out of time." if screen.attempt.lifetime <= 0 else "That was too hard a landing."


def _hint(screen: LevelPlay) -> str:
    """The line of this phase; '' if it has none."""
    key = screen.app.controls.name
    if screen.phase is Phase.READY:
        begin = f"{key('confirm')} or any move to begin"
        if screen.course.practice:
            return f"{begin}    {_tools(screen)}"
        if not screen.course.lesson:
            return begin
        return f"{key('left')} and {key('right')}: run    {key('jump')}: jump, hold it to jump higher    {begin}"
    if screen.phase is Phase.DEAD and screen.after_end > DEATH_PAUSE:
        again = f"{_epitaph(screen)}    {key('confirm')}: try again"
        return f"{again}    {key('replay')}: watch it" if screen.may_watch else again
    return ""
