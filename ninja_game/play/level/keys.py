"""What the actions of keys and buttons mean while a level is played: a table for each phase."""

from __future__ import annotations

from ninja_game.play.level.phase import Phase
from ninja_game.play.level.play import LevelPlay

_END = {"export": "keep_replay", "retry": "retry", "back": "quit", "quit": "quit"}
"""What dead and passed have in common."""

DEEDS: dict[Phase, dict[str, str]] = {
    Phase.READY: {"confirm": "begin", "back": "quit", "quit": "quit", "skip": "skip"},
    Phase.PLAY: {"pause": "pause", "back": "pause", "retry": "retry", "suicide": "give_up", "skip": "skip"},
    Phase.PAUSED: {"confirm": "resume", "pause": "resume", "back": "resume", "retry": "retry", "quit": "quit"},
    Phase.DEAD: {"confirm": "retry", "skip": "skip"} | _END,
    Phase.PASSED: {"confirm": "onward"} | _END,
}
"""The method of the screen that each action calls in each phase; the other actions do nothing there."""


def act(screen: LevelPlay, actions: tuple[str, ...]) -> None:
    """Do the first thing that the pressed actions mean. Of a key that retries and replays, replaying comes first."""
    if "replay" in actions and screen.may_watch:
        screen.watch_replay()
        return
    for action in actions:
        if action == "ghost":
            screen.app.change_settings(show_ghost=not screen.app.settings.show_ghost)
        elif screen.overlays.toggle(action):
            screen.redraw = True
        elif action in DEEDS[screen.phase]:
            getattr(screen, DEEDS[screen.phase][action])()
        else:
            continue
        return


def use_tools(screen: LevelPlay, pressed: tuple[str, ...], released: tuple[str, ...]) -> None:
    """What keys mean for the tools: some act at once, some while they are held. Only where the course is practice."""
    tools = screen.practice
    if not screen.course.practice or screen.phase not in {Phase.PLAY, Phase.DEAD, Phase.PASSED}:
        return
    if "quick_save" in pressed:
        tools.quick_save()
        screen.tell(f"Saved: {screen.app.controls.name('quick_load')} comes back to this moment")
    elif "quick_load" in pressed and tools.quick_load():
        screen.put_back()
    elif "step" in pressed:
        tools.stepping = True
        screen.run_ticks(1)
    if "rewind" in pressed or "rewind" in released:
        tools.rewinding = "rewind" in pressed
        tools.stepping = tools.stepping and not tools.rewinding
        screen.clock.reset()
    if "slow" in pressed or "slow" in released:
        tools.slow = "slow" in pressed
        tools.stepping = False
        screen.redraw = True
