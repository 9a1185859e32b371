"""The screen of a level: the keys of each phase, the screens that follow, and the picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial

import pygame

from ninja_game.errors import LevelError
from ninja_game.formats.links import replay_link
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.text import Replay
from ninja_game.levels.episodes import Entry, Mood
from ninja_game.play.app import App, Screen
from ninja_game.play.clipboard import copy_level_link, copy_link
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import DEATH_PAUSE, LATE_JUMP, STUCK_AFTER, LevelPlay, Phase
from ninja_game.play.level.passed import EpisodePassed
from ninja_game.play.menu_screen import Menu, MenuRow, Panel, nothing
from ninja_game.play.panels.help import HelpScreen
from ninja_game.play.panels.replays import watch_replays
from ninja_game.play.panels.settings import SettingsScreen
from ninja_game.play.replay.screen import ReplayScreen
from ninja_game.player.attempt import Attempt
from ninja_game.player.episode_playthrough import EpisodePlaythrough
from ninja_game.player.player_data import PlayerData, keep_replay
from ninja_game.player.playthrough import LevelPlaythrough, Navigation, Playthrough
from ninja_game.player.progress import opens_author
from ninja_game.sim.inputs import JUMP_HELD
from ninja_game.ui.audio.music import COLUMN_MUSIC, SILENCE
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.view.hud import Hud
from ninja_game.view.overlays import Overlays

_SLOWER = 70  # game speed that is offered to a player who is stuck, %

_HELP, _SKIP = "Get help with this level", "Skip this level"
HELP_ROW = 2  # the row of help in the pause panel


class LevelScreen(Screen):
    """The screen of a playthrough's level. ``play``: its phases and ticks."""

    plays = True

    def __init__(self, app: App, playthrough: Playthrough) -> None:
        super().__init__(app)
        self.playthrough = playthrough
        self.overlays = Overlays()
        self._start_level()

    def _start_level(self) -> None:
        self.app.audio_output.quiet()
        self.app.follow_mood(self.mood)
        self.play = LevelPlay(self.app, self.playthrough)
        self.play.view.overlays = self.overlays

    @property
    def mood(self) -> Mood:
        return self.playthrough.entry.mood

    @property
    def music(self) -> str:
        """The music of the level's column; other levels share one."""
        if self.playthrough.practice_mode and not self.app.settings.music_in_practice:
            return SILENCE
        entry = self.playthrough.entry
        column = entry.mood.column if entry.episode else int(entry.digest[:8], 16)
        return COLUMN_MUSIC[column % len(COLUMN_MUSIC)]

    @property
    def phase(self) -> Phase:
        return self.play.phase

    @property
    def attempt(self) -> Attempt:
        return self.play.attempt

    def enter(self) -> None:
        """Called when the screen is on top again: ends a pause, resets the clock, turns text input off."""
        if self.phase is Phase.PAUSED:
            self.play.resume()
        self.play.clock.reset()
        pygame.key.stop_text_input()

    def leave(self) -> None:
        self.app.audio_output.quiet()

    # --- what keys and the pause panel do ---

    def begin(self) -> None:
        """The key for confirm: on a keyboard it does not jump yet; a pad has only this one."""
        controls = self.app.controls
        controls.stop_running()
        self.play.begin(ignored=0 if controls.pad_used else controls.choosing())

    def pause(self, row: int = 0) -> None:
        self.play.pause()
        panel = PausePanel(self.app, self)
        self.app.push(panel)
        panel.focus = panel.widgets[row]

    def back(self) -> None:
        """Leave a passed level; if that would end the program, the pause panel comes first."""
        if len(self.app.stack) > 1:
            self.quit()
        else:
            self.pause()

    def retry(self, *, ignored: int = 0) -> None:
        """Back to the level's start, at once; a level file that has changed is read again."""
        self.app.audio_output.quiet()
        self.playthrough.gave_up(self.attempt)
        with self.app.errors_as_notices("The changed level cannot be played: "):
            if self.playthrough.restart():
                self._start_level()
                self.app.notify("The level's file has changed: this is the new level")
                return
        self.play.retry(ignored=ignored)

    def retry_by_choice(self) -> None:
        """Retry by the key for confirm, which does not jump."""
        self.retry(ignored=self.app.controls.choosing())

    def retry_by_jump(self) -> None:
        """Retry by the jump key, but not at once; it counts as a jump when it is pressed again."""
        if self.play.after_end > DEATH_PAUSE:
            self.retry(ignored=JUMP_HELD)

    def go_on(self) -> None:
        """Go on to the next level, after a pass or a skip."""
        where = self.playthrough.advance()
        if where is Navigation.SAME_LEVEL:
            self.retry()
        elif where is Navigation.NEXT_LEVEL:
            self.app.wipe_from(self)
            self._start_level()
        elif where is Navigation.BACK and isinstance(self.playthrough, EpisodePlaythrough):
            self._skip_the_last(self.playthrough)
        else:
            self._leave_to(where)

    def _skip_the_last(self, run: EpisodePlaythrough) -> None:
        """Skipping the last level of an episode leads to the next episode."""
        following = run.player.catalogue.following(run.episode)
        if following is None:
            self._leave_to(Navigation.BACK)
            self.app.notify("That was the last episode")
            return
        afresh = EpisodePlaythrough(run.player, following, practice_mode=run.practice_mode)
        self.app.replace(LevelScreen(self.app, afresh))
        self.app.notify(f"Skipped. Now episode {following.code}: {following.name}")

    def skip(self) -> None:
        """Skip the level in practice; else show the menu of help."""
        if self.playthrough.practice_mode:
            self.go_on()
            self.app.notify("    ".join(self.playthrough.notices))
        else:
            self.ask_for_help()

    def ask_for_help(self, *, paused: bool = False) -> None:
        """A menu for a level that is too hard; disabled entries say why.

        ``paused``: opened from the pause panel, to which Esc leads back, as it does from play.
        """
        playthrough, app = self.playthrough, self.app
        run = playthrough.player.catalogue.author_run(playthrough.entry)
        may_watch = self.play.is_stuck or opens_author(
            playthrough.entry, playthrough.player.marks.of(playthrough.entry.digest)
        )
        back = partial(self.pause, HELP_ROW * paused) if paused or self.phase is Phase.PLAY else nothing
        if self.phase is Phase.PLAY:
            self.play.pause()

        hint = "Restarts the level. No records until you turn it off here"
        slow = f"Slow down to {_SLOWER}%", partial(self._play_at, _SLOWER), hint
        full = "Full speed", partial(self._play_at, 100), "Back to normal: records count again"
        watch_it = partial(self._watch, run), "See the author of the level do it"
        why = f"after {STUCK_AFTER} failed tries" if run else "no run recorded"
        skip_it = self.go_on, "The next one opens. This one counts only once you pass it"
        rows: list[MenuRow] = [
            ("Try again", self.retry, ""),
            ("Watch how", *watch_it) if run and may_watch else (f"Watch how ({why})", None, ""),
            full if app.settings.game_speed < 100 else slow,
            (_SKIP, *(skip_it if playthrough.has_next else (None, "No level comes after this one"))),
        ]
        app.push(Menu(app, _HELP, rows, back))

    def _watch(self, run: Replay | None) -> None:
        """Watch a run; then the level waits at its start and shows its messages again."""
        self.retry()
        for queue in self.play.queues:
            queue.say_again()
        watch_replays(self.app, [run])
        self.app.notify(f"{self.app.controls.name('back')}: back to your own try")

    def _play_at(self, speed: int) -> None:
        """Begin again at a speed, %; the setting is saved."""
        self.app.change_settings(game_speed=speed)
        self.retry()

    def quit(self) -> None:
        self.playthrough.gave_up(self.attempt)
        self.playthrough.player.store.flush()
        self._leave_to(self.playthrough.on_leaving)

    def _leave_to(self, where: Navigation) -> None:
        app = self.app
        if where is Navigation.EPISODE_END and isinstance(self.playthrough, EpisodePlaythrough):
            app.replace(EpisodePassed(app, self.playthrough, lambda run: app.replace(LevelScreen(app, run))))
        else:
            app.pop()

    def give_up(self) -> None:
        self.play.give_up()

    def run_on(self) -> None:
        """Continue in practice after single steps."""
        if self.play.tools.stepping:
            self.play.hold()

    def watch_replay(self) -> None:
        if self.play.may_watch:
            playthrough = self.playthrough
            replay = Replay.of_inputs(
                bytes(self.attempt.inputs),
                playthrough.level,
                name=playthrough.title,
                author=self.app.settings.name,
                body=playthrough.body,
                made=self.attempt.made,
            )
            self.app.push(ReplayScreen(self.app, [Recording(playthrough.level, replay)]))

    def _replay(self) -> Replay:
        return self.attempt.replay(self.playthrough.title, self.app.settings.name)

    def keep_replay(self) -> None:
        """Save this run among the player's replays, even if it is not the best."""
        if self._is_spared():
            return
        self.app.notify(keep_replay(self.playthrough.player, self._replay()))

    def _is_spared(self) -> bool:
        """Whether only invincibility saved the run: then its keys alone are no replay, and a notice says so."""
        if self.attempt.death_refused:
            self.app.notify("No replay: only the invincible could survive this run")
        return self.attempt.death_refused

    def copy_link(self) -> None:
        if self._is_spared():
            return
        copy_link(self.app, lambda: replay_link([self._replay()]), title=self.playthrough.title)

    # --- events ---

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.WINDOWFOCUSLOST and self.phase is Phase.PLAY:
            self.pause()
        if self.playthrough.practice_mode and self.phase in {Phase.PLAY, Phase.DEAD, Phase.PASSED}:
            self._dispatch_practice(event)
        pressed = event.pressed
        if event.raw.type == pygame.MOUSEBUTTONDOWN and event.raw.button == pygame.BUTTON_RIGHT:
            pressed = ("back",)
        elif event.raw.type == pygame.MOUSEBUTTONDOWN and event.raw.button == 1 and self.phase is not Phase.PLAY:
            pressed = (*pressed, "confirm")
        self._dispatch_action(pressed)

    def _dispatch_action(self, pressed: tuple[str, ...]) -> None:
        """Do the first of the pressed actions that has an effect in this phase.

        After the end, a key for both jump and retry is first a jump that came too late, and then no jump.
        """
        if {"jump", "confirm"} <= set(pressed) and self.phase in {Phase.DEAD, Phase.PASSED}:
            late = self.play.after_end < LATE_JUMP
            pressed = () if late else tuple(action for action in pressed if action != "jump")
        for action in pressed:
            method = ACTIONS_BY_PHASE[self.phase].get(action)
            if action == "ghost":
                self.app.change_settings(show_ghost=not self.app.settings.show_ghost)
            elif self.overlays.toggle(action):
                self.redraw = True
            elif method is not None:
                method(self)
            else:
                continue
            return

    def _dispatch_practice(self, event: InputEvent) -> None:
        """Keys of the practice tools: some act once, some while they are held."""
        if "quick_save" in event.pressed:
            self.play.tools.quick_save()
            self.app.notify(f"Saved: {self.app.controls.name('quick_load')} comes back to this moment")
        elif "quick_load" in event.pressed:
            if not self.play.quick_load():
                self.app.notify(f"Nothing saved yet: {self.app.controls.name('quick_save')} saves this moment")
        elif "step" in event.pressed:
            self.play.step()
        if "rewind" in (*event.pressed, *event.released):
            self.play.hold(rewinding="rewind" in event.pressed)
        if "slow" in (*event.pressed, *event.released):
            self.play.hold(slow="slow" in event.pressed)

    # --- time and picture ---

    def update(self, real_ms: int) -> None:
        self.play.update(real_ms)
        self.redraw = self.redraw or self.play.changed
        self.play.changed = False

    def draw(self, surface: pygame.Surface) -> list[pygame.Rect] | None:
        view = self.play.view
        changed = view.draw(surface, self.play.fraction, whole=self.redraw)
        written = Hud(self.app.theme).draw(surface, hud_view(self.play))
        for rect in written:
            view.also_covered(rect)
        return None if changed is None else changed + written


def play_level(
    app: App, entry: Entry, *, practice: bool = False, following: Sequence[Entry] = (), player: PlayerData | None = None
) -> str:
    """Play a level, then those that follow it in a list; the reason if it cannot be played, or ''."""
    run = LevelPlaythrough(
        player or app.player, entry, practice_mode=practice or app.settings.practice, following=following
    )
    try:
        app.push(LevelScreen(app, run))
    except LevelError as error:
        return error.what
    return ""


PhaseActions = dict[str, Callable[[LevelScreen], None]]

_UNPASSED: PhaseActions = {
    "pause": LevelScreen.pause, "back": LevelScreen.pause, "retry": LevelScreen.retry, "quit": LevelScreen.quit,
    "skip": LevelScreen.skip,
}  # fmt: skip
"""Actions while the level is not passed."""

_END: PhaseActions = {
    "replay": LevelScreen.watch_replay,
    "export": LevelScreen.keep_replay,
    "link": LevelScreen.copy_link,
}
"""Actions after a death and after a pass."""

ACTIONS_BY_PHASE: dict[Phase, PhaseActions] = {
    Phase.READY: {"confirm": LevelScreen.begin, **_UNPASSED},
    Phase.PLAY: {
        **_UNPASSED, "suicide": LevelScreen.give_up,
        **dict.fromkeys(("confirm", "left", "right", "jump"), LevelScreen.run_on),
    },
    Phase.PAUSED: {},
    Phase.DEAD: {"confirm": LevelScreen.retry_by_choice, "jump": LevelScreen.retry_by_jump, **_UNPASSED, **_END},
    Phase.PASSED: {
        "confirm": LevelScreen.go_on, "skip": LevelScreen.go_on, "retry": LevelScreen.retry,
        "back": LevelScreen.back, "quit": LevelScreen.quit, **_END,
    },
}  # fmt: skip
"""The effect of each action by phase; other actions have none."""


class PausePanel(Panel):
    """The game is paused. Space, the pause key or Esc continue."""

    def __init__(self, app: App, playing: LevelScreen) -> None:
        super().__init__(app, "Paused")
        self.playing = playing

    def rows(self) -> list[MenuRow]:
        playing = self.playing
        practice = playing.playthrough.practice_mode
        skip, helped = (_SKIP, playing.skip) if practice else (_HELP, partial(playing.ask_for_help, paused=True))
        return [
            ("Resume", self.back, ""),
            ("Retry", lambda: self._leave(self.playing.retry), ""),
            (skip, lambda: self._leave(helped), f"{self.app.controls.name('skip')}, also in play"),
            ("Settings", lambda: self.app.push(SettingsScreen(self.app)), ""),
            ("Help", lambda: self.app.push(HelpScreen(self.app)), ""),
            ("Copy a link", self._copy_link, "Anyone who opens it can play this level"),
            ("Leave the level", lambda: self._leave(self.playing.quit), ""),
        ]

    def _copy_link(self) -> None:
        entry = self.playing.playthrough.entry
        copy_level_link(self.app, entry.named, entry.title)

    def handle(self, event: InputEvent) -> None:
        """The pause key also continues, the quit key leaves."""
        if "pause" in event.pressed:
            self.back()
        elif "quit" in event.pressed:
            self._leave(self.playing.quit)
        else:
            super().handle(event)

    def _leave(self, then: Callable[[], object]) -> None:
        self.app.pop()
        then()
