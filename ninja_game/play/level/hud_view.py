"""The texts, medals and panels over a level now, which ``hud`` places and draws."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import hypot

from ninja_game.files.shown_text import shown_text
from ninja_game.formats.messages import arrow_targets
from ninja_game.formats.run_time import rounded_text, seconds_text
from ninja_game.play.level.level_play import STAMP_TICKS, LevelPlay, Phase
from ninja_game.player.player_data import FIRST_PASS, NEW_ALL_GOLD, OF_A_LEVEL
from ninja_game.player.playthrough import Navigation
from ninja_game.player.progress import NO_MEDAL, Mark, next_par
from ninja_game.runs.advice import FALL_HELP, WHY
from ninja_game.runs.deaths import SELF
from ninja_game.runs.message_queue import FADE_TICKS
from ninja_game.sim.kinds import EXIT, SWITCH
from ninja_game.sim.rules import LIFETIME
from ninja_game.sim.schema.world_fields import World
from ninja_game.view.hud import EndPanel, HudView
from ninja_game.view.places import MUST, Things

_END_FADE_TICKS = 8  # ticks until the panel of an ended run is opaque
SHINE_TICKS = 20  # ticks for which light moves over its medal
_END_ROOM = 36.0  # px around the end of the run that the panel leaves free
_POINTER_UP = 24.0  # px from a thing up to the middle of its pointer
_POINTER_REACH = 50.0  # px from the ninja to a pointer that does not hide it
_MARKED = "silver", "gold"  # medals on the time bar
_TOOLS = {"quick_save": "save", "quick_load": "load", "rewind": "rewind", "slow": "slow", "step": "step"}
_TOOLS_NAMED = 600  # ticks for which a practice run shows the keys of its tools
_THINGS = {"switch": SWITCH, "exit": EXIT}

KeyName = Callable[[str], str]  # gives the key of an action


def hud_view(play: LevelPlay) -> HudView:
    """The texts over a level now."""
    app, attempt, playthrough = play.app, play.attempt, play.playthrough
    key, settings = app.controls.name, app.settings
    gold = f"{attempt.gold} / {play.all_gold}"
    end = None
    if play.phase is Phase.DEAD:
        cause, help_text = cause_of_death(play)
        end = EndPanel(cause, [*filter(None, [help_text]), _after_death(play, key)], *_covering(play))
    if play.phase is Phase.PASSED:
        next_label = "go on" if playthrough.on_leaving is Navigation.EPISODE_END else playthrough.next_label
        keys = f"{key('confirm')}: {next_label}    {key('retry')}: play again    {key('replay')}: replay"
        if not playthrough.has_next:
            keys = f"{key('confirm')}: play again    {key('replay')}: replay    {key('back')}: leave"
        time = f"{seconds_text(attempt.ended_tick)} s"
        title = f"Time {time}" if play.medal else f"Passed    time {time}"
        end = EndPanel(title, [*_reached(play), keys], *_covering(play))
    hint = _hint(play, key)
    name = shown_text(playthrough.title)
    title = f"{name} ({play.next_par})" if play.phase is Phase.READY and play.next_par else name
    if (settings.game_speed < 100 or play.invincible or attempt.assisted) and not playthrough.practice_mode:
        title += f"    {NO_MEDAL}"
    practice = "Practice" + (", slow motion" if play.tools.slow else "")
    return HudView(
        play.shown_lifetime,
        practice if playthrough.practice_mode else "",
        (title, hint or f"gold {gold}"),
        name=shown_text(playthrough.entry.title),
        pars=_pars_ahead(play),
        keys=play.keys if settings.show_keys and not hint else None,
        frame_ms=app.frame_ms if settings.show_frame_time else None,
        message=play.placed(play.messages),
        bubble=play.placed(play.places),
        letters=[key(name) for name in ("left", "jump", "right")],
        end=end,
        named=() if end else named_in(attempt.simulation.world, arrow_targets(queue.text for queue in play.queues)),
        medal=play.medal,
        stamp=play.stamp,
        shine=1.0 if settings.reduced_motion else (play.after_end + play.fraction - STAMP_TICKS) / SHINE_TICKS,
        end_opacity=1.0 if settings.reduced_motion else min(1.0, (play.after_end + play.fraction) / _END_FADE_TICKS),
        ninja=play.ninja_place(),
        softly=not settings.reduced_motion,
        bubble_opacity=1.0 if settings.reduced_motion else min(1.0, max(0, play.places.ticks_left) / FADE_TICKS),
    )


def _pars_ahead(play: LevelPlay) -> list[tuple[str, float]]:
    """The medals that this try can still win, in a passed level, each with the lifetime at its par."""
    pars, attempt = play.playthrough.pars, play.attempt
    if pars is None or not play.next_par or play.phase is Phase.PASSED:
        return []
    tick = attempt.simulation.tick
    ahead = ((medal, attempt.lifetime - (pars.par(medal) - tick)) for medal in _MARKED)
    return [(medal, ticks) for medal, ticks in ahead if 0 < ticks < min(attempt.lifetime, LIFETIME)]


def _covering(play: LevelPlay) -> tuple[tuple[int, ...], Things]:
    """Tiles and things that the panel of an ended run should not cover; it never covers the end or an exit."""
    x, y = play.ended_at
    end = [(x + dx, y + dy, 9 * MUST) for dx in (-_END_ROOM, 0, _END_ROOM) for dy in (-_END_ROOM, 0, _END_ROOM)]
    exits = [(o.x, o.y, 9 * MUST) for o in play.attempt.simulation.world.objects[1:] if o.kind == EXIT]
    return play.playthrough.level.tiles, (*end, *exits, *play.things)


def _reached(play: LevelPlay) -> list[str]:
    """Lines after a pass: the medal, the time for the next medal, the gold, unlocked levels."""
    attempt, pars = play.attempt, play.playthrough.pars
    following = []
    if pars and play.medal:
        following.append(next_par(pars, Mark(attempt.ended_tick, 0)) or "The best medal there is. Well run!")
    gold = f"{attempt.gold} of {play.all_gold} gold" if attempt.gold < play.all_gold else f"All {play.all_gold} gold"
    medal = [f"{play.medal.capitalize()} medal"] if play.medal else []
    clock = f"{rounded_text(attempt.lifetime)} s left on the clock, for the next level"
    # A first pass is a record in everything, and shows the medal and the gold already.
    first = FIRST_PASS in play.notices
    news = [notice for notice in play.notices if notice != NEW_ALL_GOLD and not (first and notice in OF_A_LEVEL)]
    gains = "    ".join([gold, *news] if play.all_gold else news)
    lines = [*medal, *following, gains, clock if play.playthrough.carries_clock else ""]
    return [line for line in lines if line]


def named_in(world: World, names: Sequence[str]) -> list[tuple[str, float, float]]:
    """The names of things and their places, until each is used; never over the ninja."""
    return [
        (name, o.x, o.y)
        for name in names
        for o in world.objects[1:]
        if o.kind == _THINGS[name] and not (o.kind == SWITCH and world.objects[o.partner].is_open)
        if hypot(o.x - world.ninja.x, o.y - _POINTER_UP - world.ninja.y) > _POINTER_REACH
    ]


def _hint(play: LevelPlay, key: KeyName) -> str:
    """The key to press now; "" in play and after it."""
    if play.phase is Phase.READY:
        begin = f"{key('confirm')} or any move to start"
        if play.show_tutorial and not play.messages.text:
            return f"{key('left')} and {key('right')} to run    {key('jump')} to jump, hold it to go higher    {begin}"
        inside = f"    {key('overlay_hitboxes')} to {key('overlay_thinkers')}: look inside"
        return begin + (inside if play.playthrough.practice_mode else "")
    if play.tools.stepping:
        return f"{key('step')}: one tick    {key('confirm')} or any move: go on"
    named = play.phase is not Phase.PASSED and play.attempt.simulation.tick < _TOOLS_NAMED
    if play.playthrough.practice_mode and named:
        return "    ".join(f"{key(action)}: {name}" for action, name in _TOOLS.items())
    return ""


def _after_death(play: LevelPlay, key: KeyName) -> str:
    try_again = f"{key('confirm')} or {key('jump')}: try again"
    get_help = f"    {key('skip')}: get help" if play.is_stuck else ""
    return f"{try_again}    {key('replay')}: watch it{get_help}"


def cause_of_death(play: LevelPlay) -> tuple[str, str]:
    """The cause of the ninja's death, and what helps against it, "" where the level has been passed."""
    if play.attempt.self_inflicted:
        return "You gave up", ""
    if play.killer != SELF:
        return f"Killed by a {play.killer}", WHY[play.killer] if play.helps else ""
    if play.crushed:
        return "You were crushed", ""
    if play.attempt.lifetime <= 0:
        return "Out of time", ""
    return "You hit the ground too hard", FALL_HELP if play.helps else ""
