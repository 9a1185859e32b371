"""What the actions of keys and buttons mean while a level is played: a table for each phase."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ninja_game.play.phase import Phase

if TYPE_CHECKING:
    from ninja_game.play.level_screen import LevelScreen

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


def act(screen: LevelScreen, actions: tuple[str, ...]) -> None:
    """Do the first thing that the pressed actions mean. Of a key that retries and replays, replaying comes first."""
    if "replay" in actions and screen.may_watch:
        screen.watch_replay()
        return
    for action in actions:
        if action == "ghost":
            screen.app.options.show_ghost = not screen.app.options.show_ghost
        elif screen.overlays.toggle(action):
            screen.redraw = True
        elif action in DEEDS[screen.phase]:
            getattr(screen, DEEDS[screen.phase][action])()
        else:
            continue
        return
