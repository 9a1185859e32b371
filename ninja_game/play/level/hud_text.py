"""The words over a level being played: what to press in each phase, how it ended."""

from __future__ import annotations

from collections.abc import Callable

from ninja_game.play.level.hud import HudView
from ninja_game.play.level.play import DEATH_PAUSE, LevelPlay, Phase
from ninja_game.play.ui.canvas import HEIGHT
from ninja_game.player.scoring import seconds_text
from ninja_game.player.statistics import SELF

ABOVE, BELOW = 34.0, 494.0
"""Where the panel of a passed level begins: near the upper or the lower border."""

KeyName = Callable[[str], str]
"""Gives what to press for an action."""


def hud_view(play: LevelPlay) -> HudView:
    """What is written over a level now."""
    app, attempt, context = play.app, play.attempt, play.context
    key, settings = app.controls.name, app.settings
    gold = f"{attempt.gold} / {play.all_gold}"
    message, medal = None, ""
    if play.phase is Phase.PASSED:
        keys = f"{key('confirm')}: go on    {key('retry')}: retry    {key('replay')}: replay"
        if not context.leads_on:
            keys = f"{key('confirm')}: play it again    {key('replay')}: replay    {key('back')}: leave"
        # At the far side from the ninja, so that neither its dance nor the way that it came is hidden.
        y = ABOVE if attempt.simulation.world.ninja.y > HEIGHT / 2 else BELOW
        message = f"Passed with {seconds_text(attempt.score)}", [*_reached(play, gold), keys], y
        medal = context.pars.medal(attempt.ended_tick) if context.pars else ""
    hint = _hint(play, key)
    title = f"{context.title}    {play.aim}" if play.phase is Phase.READY and play.aim else context.title
    practice = "Practice" + (", slow motion" if play.tools.slow else "")
    return HudView(
        play.shown_lifetime,
        practice if context.practice_mode else "",
        (title, hint or f"gold {gold}"),
        keys=play.keys if settings.show_keys and not hint else None,
        frame_ms=app.frame_ms if settings.show_frame_time else None,
        message=message,
        medal=medal,
    )


def _reached(play: LevelPlay, gold: str) -> list[str]:
    """The time of a passed run with its medal and the next one, and its gold."""
    tick, pars = play.attempt.ended_tick, play.context.pars
    lines = [f"{gold} gold" + (", all of it" if play.attempt.gold == play.all_gold > 0 else "")]
    if pars:
        medal, following = pars.medal(tick), pars.next_medal(tick)
        text = f"{seconds_text(tick)} s" + (f": {medal} medal" if medal else "")
        lines.insert(0, f"{text}    {following}: {seconds_text(pars.par(following))} s" if following else text)
    return lines


def _hint(play: LevelPlay, key: KeyName) -> str:
    """What to press now, or what a pass has brought; "" in play."""
    if play.phase is Phase.READY:
        return _ready_hint(key, practice_mode=play.context.practice_mode, show_tutorial=play.show_tutorial)
    if play.phase is Phase.PASSED:
        return "    ".join(play.notices)
    if play.phase is Phase.DEAD and play.after_end > DEATH_PAUSE:
        again = f"{_cause_of_death(play)}    {key('confirm')} or {key('jump')}: try again"
        return f"{again}    {key('replay')}: watch it" if play.may_watch else again
    if play.tools.stepping:
        return f"{key('step')}: one tick    {key('confirm')} or any move: go on"
    return ""


def _ready_hint(key: KeyName, *, practice_mode: bool, show_tutorial: bool) -> str:
    begin = f"{key('confirm')} or any move to begin"
    if show_tutorial:
        return f"{key('left')} and {key('right')}: run    {key('jump')}: jump, hold it to jump higher    {begin}"
    if practice_mode:
        tools = ("quick_save", "save"), ("quick_load", "load"), ("rewind", "rewind"), ("slow", "slow"), ("step", "step")
        named = [f"{key(action)}: {name}" for action, name in tools]
        return "    ".join([begin, *named, f"{key('overlay_hitboxes')} to {key('overlay_cells')}: look inside"])
    return begin


def _cause_of_death(play: LevelPlay) -> str:
    """What happened, in a few words."""
    if play.attempt.own_hand:
        return "You gave up."
    if play.killer != SELF:
        return f"Killed by a {play.killer}."
    return "Out of time." if play.attempt.lifetime <= 0 else "That was too hard a landing."
