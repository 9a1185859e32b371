"""The screen of episodes: the grid, its cells, the levels of the selected one."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial

import pygame

from ninja_game.files.shown_text import shown_text
from ninja_game.formats.pack.index import EPISODES_PER_COLUMN
from ninja_game.formats.run_time import seconds_text
from ninja_game.levels.episodes import Episode, EpisodeSet
from ninja_game.play.app import App
from ninja_game.play.clipboard import copy_link
from ninja_game.play.level.screen import LevelScreen, play_level
from ninja_game.play.menu_screen import CANCEL, Menu, MenuRow
from ninja_game.play.menus.open_pack import open_pack
from ninja_game.play.menus.problems import file_problems, problems_button
from ninja_game.play.panels.settings import PRACTICE_HINT, setting_choice
from ninja_game.play.thumbnails import ThumbnailScreen, all_gold_and_medal, draw_pars, tries_text
from ninja_game.player.episode_playthrough import EpisodePlaythrough, unfinished_run
from ninja_game.player.player_data import PlayerData
from ninja_game.player.progress import CHEATED, LOCKED, WITH_HELP, Mark, count_results, has_all_gold, worst_medal
from ninja_game.runtime import in_page_or_not
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.list_view import BAR_WIDTH, ListView
from ninja_game.ui.medals import MEDALS_FROM_BRONZE, draw_all_gold, draw_medal
from ninja_game.ui.theme import Area, Theme, mixed
from ninja_game.ui.widgets import Button, Choice, Widget

_LEFT, _TOP, _WIDTH, _MAX_HEIGHT = 44, 116, 318, 286
"""Place and greatest height of the grid, px; cells are up to MAX_CELL px large."""

MAX_CELL = 62
NAMED_CELL = 48  # least width of a cell under its column's name, px

LOOKS = (("beaten", "passed"), ("open", "open"), ("cheated", "seen in practice"), ("locked", "locked"))


class Cells(ListView):
    """The grid of a pack's episodes. ``numbers``: each cell's episode, -1 for none.

    ``heads``: the columns with an episode, as numbers.
    """

    numbers: list[int]
    heads: list[int]

    def arrange(self, episodes: Iterable[int]) -> None:
        numbers = set(episodes)
        self.heads = sorted({number // EPISODES_PER_COLUMN for number in numbers})
        lines = max((number % EPISODES_PER_COLUMN for number in numbers), default=0) + 1
        self.columns = max(1, len(self.heads))
        self.cell_height = min(MAX_CELL, _WIDTH / self.columns, _MAX_HEIGHT / lines)
        self.area = _LEFT, _TOP, self.cell_height * self.columns + BAR_WIDTH + 4, self.cell_height * lines
        places = [column * EPISODES_PER_COLUMN + line for line in range(lines) for column in self.heads]
        self.numbers = [number if number in numbers else -1 for number in places]
        self.index = self.first = 0
        if self.numbers[:1] == [-1]:
            self.index = next(place for place, number in enumerate(self.numbers) if number >= 0)
        self.fill(self.numbers)

    def draw_names(self, surface: pygame.Surface, theme: Theme, names: Sequence[str]) -> None:
        """The columns' names above them; above narrow columns only the selected one's."""
        size = self.cell_height
        faint = theme.palette.faint
        for place, column in enumerate(self.heads):
            name = names[column] if column < len(names) else ""
            chosen = place == self.index % self.columns
            if size >= NAMED_CELL:
                colour = theme.palette.text if chosen else faint
                middle = _LEFT + (place + 0.5) * size
                theme.text(surface, name, middle, _TOP - 15, size=9, colour=colour, align="centre", width=size - 2)
            elif chosen:
                theme.text(surface, name, _LEFT, _TOP - 15, size=10, colour=faint, width=_WIDTH)

    def nudge(self, action: str) -> bool:
        """Move the selection; beyond the last episode the focus moves on instead."""
        before, first = self.index, self.first
        used = super().nudge(action)
        if used and self.numbers[self.index] < 0:
            self.select(before)
            self.first = first
            return False
        return used

    def _index_at(self, x: float, y: float) -> int | None:
        index = super()._index_at(x, y)
        return index if index is not None and self.numbers[index] >= 0 else None


def _how_far(passed: int, count: int) -> str:
    """The passed part of an episode without a best; skipped levels do not count."""
    if passed == count:
        return f"All {count} levels passed, but not yet in one go"
    return f"{passed} of {count} levels passed. Skipped ones count once you pass them" if passed else f"{count} levels"


def draw_look(surface: pygame.Surface, theme: Theme, look: str, area: Area) -> None:
    """Draw a cell by its state, which its shape shows as well as its colour."""
    canvas, palette = theme.canvas, theme.palette
    x, y, w, h = area
    fill = {"beaten": palette.tile, "locked": mixed(palette.background, palette.outline, 0.14)}.get(look, palette.panel)
    canvas.fill_rect(surface, fill, x, y, w, h, 3)
    canvas.frame_rect(surface, palette.panel_edge, x, y, w, h, 1, 3)
    if look == "cheated":
        canvas.polygon(surface, palette.bad, [(x + w - 9, y + 1), (x + w - 1, y + 1), (x + w - 1, y + 9)])
    elif look == "locked":
        cx, cy = x + w / 2, y + h / 2
        canvas.fill_rect(surface, palette.faint, cx - 4.5, cy - 1, 9, 7, 1)
        canvas.circle(surface, palette.faint, (cx, cy - 2), 4, 1.5)


PREVIEW = "Preview as player"
_PREVIEWED = "As it is for whoever pastes the link. Nothing that you do here is kept"
_OPENS = (
    "Finish an episode and the one below it opens: 1.2 comes after 1.1.",
    "Each column has a theme of its own. The left one is easiest.",
)

_SIDE = 392
_ROW = 84
SMALL_PICTURE = 96


class EpisodeGrid(ThumbnailScreen):
    """Choose an episode to play, or one of its levels for a time trial. ``pack``: the key of the pack to begin with.

    ``newcomer``: for a preview: a player who has passed nothing; by default the present player.
    """

    title = "Episodes"

    def __init__(self, app: App, pack: str = "", newcomer: PlayerData | None = None) -> None:
        super().__init__(app)
        self.previews = newcomer is not None
        if newcomer:
            self.title, self.player = PREVIEW, newcomer
        self.packs: list[EpisodeSet] = []
        self.pack = self.player.catalogue.ours
        self.marks: dict[str, Mark] = {}
        self.passed: set[str] = set()
        self.grid = Cells((_LEFT, _TOP, _WIDTH, _MAX_HEIGHT), 1, self._draw_cell, self._play, opens=True)
        self.grid.selected = self._selected
        self.play = Button((_SIDE + 274, 64, 90, 30), "Play", lambda: self._play(self.grid.index))
        self.rows = ListView((_SIDE, 132, 364, _ROW * 5), _ROW, self._draw_row, self._trial, opens=True)
        self.rows.hint = "Enter, or click twice: play just this level"
        self._look_for_packs(pack)
        self.grid.arrange(self.pack.episodes)

    def _look_for_packs(self, key: str) -> None:
        catalogue = self.player.catalogue
        catalogue.problems.clear()
        self.packs = [pack for pack in catalogue.packs() if pack.episodes and not (self.previews and pack.key != key)]
        self.problems = file_problems(catalogue.shown_problems)
        self.pack = next((pack for pack in self.packs if pack.key == key), catalogue.ours)

    @property
    def number(self) -> int:
        return self.grid.numbers[self.grid.index] if self.grid.numbers else -1

    @property
    def episode(self) -> Episode | None:
        return self.pack.episodes.get(self.number)

    def _selected(self, _index: int) -> None:
        self.rows.index = 0
        self.rows.fill(self.episode.levels if self.episode and self._state(self.number) != LOCKED else ())
        self.rows.focusable = bool(self.rows.count)
        self.play.hint = self.grid.hint = self._hint()
        self.play.enabled = bool(self.rows.count)

    def _state(self, number: int) -> str:
        return self.player.episode_state(self.pack.episodes[number])

    def _hint(self) -> str:
        if self.episode is None:
            return "There are no episodes"
        if lock := self.player.lock_of_episode(self.episode):
            return lock
        if self._state(self.number) == CHEATED:
            return "Enter: play, without records (so far seen in practice only)"
        return f"Enter: play this episode    {self.app.controls.name('link')}: copy a link to the pack"

    @property
    def _is_lent(self) -> bool:
        """Whether the pack is a zip or link that is none of the player's files."""
        return self.pack.path in self.player.catalogue.more and not (self.pack.is_changeable or self.previews)

    def _keep(self) -> None:
        """Receive the pack like a file that is dropped."""
        if path := self.pack.path:
            self.player.catalogue.more.remove(path)
            pygame.event.post(pygame.Event(pygame.DROPFILE, file=str(path)))

    @property
    def _below(self) -> float:
        return _TOP + self.grid.area[3] + 14

    def build(self) -> Sequence[Widget]:
        before, number = self.pack, self.number
        self._look_for_packs(before.key)
        if self.pack is not before:
            self.grid.arrange(self.pack.episodes)
            self.grid.index = self.grid.numbers.index(number) if number in self.grid.numbers else self.grid.index
        self.marks = self.player.marks.all()
        self.passed = self.marks.keys() | self.player.marks.all(WITH_HELP).keys()
        self._selected(self.grid.index)
        practice, opener = self._areas_below
        self.practice = setting_choice(self.app, practice, "Practice mode", "practice", hint=PRACTICE_HINT)
        self.opener = Button(opener, "Open a pack...", partial(open_pack, self.app, "Open a pack"))
        self.opener.hint = "That somebody sent you: a zip, or a link"
        below = [] if self.previews else [self.practice, *in_page_or_not([], [self.opener])]
        problems = problems_button(self.app, (_LEFT, 546, _WIDTH, 18), lambda: self.problems)
        if self._is_lent:
            keep = Button((_SIDE + 178, 64, 90, 30), "Keep it", self._keep)
            keep.hint = "It goes among your packs, and is offered here whenever you play"
            problems += in_page_or_not([], [keep])
        if len(self.packs) < 2:
            return [self.grid, self.play, *below, self.rows, *problems]
        names = [("This game's levels" if not pack.key else pack.name, pack.key) for pack in self.packs]
        choice = Choice((_LEFT, 62, _WIDTH, 26), "", names, lambda: self.pack.key, self._set_pack)
        choice.hint = "Level pack. Open a pack takes in more, as does the folder in Settings > Play"
        return [self.grid, self.play, choice, *below, self.rows, *problems]

    def look_again(self) -> None:
        self.enter()
        self.redraw = True

    def _set_pack(self, key: object) -> None:
        self._look_for_packs(str(key))
        self.grid.arrange(self.pack.episodes)
        self.practice.area, self.opener.area = self._areas_below

    @property
    def _areas_below(self) -> tuple[Area, Area]:
        """Where the choice of practice and the button to open a pack lie: below the grid of this pack."""
        return (_LEFT, self._below, 208, 30), (_LEFT + 214, self._below, 104, 30)

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.DROPFILE and not self.previews:
            self.app.pop()
            self.app.top.handle(event)
        elif "link" in event.pressed and self.pack.files:
            copy_link(self.app, self.pack.files.link, title=self.pack.name)
        else:
            super().handle(event)

    def _play(self, _index: int) -> None:
        """Play the episode; one that was left half-way continues there, or begins again."""
        if self.episode is None or self._state(self.number) == LOCKED:
            return
        practice_mode = self.player.settings.practice
        afresh = EpisodePlaythrough(self.player, self.episode, practice_mode=practice_mode)
        left = None if practice_mode else unfinished_run(self.player, self.episode)
        if left is None or not left.position:
            self.app.push(LevelScreen(self.app, afresh))
            return
        rows: list[MenuRow] = [
            (f"Go on with level {left.position + 1}", lambda: self.app.push(LevelScreen(self.app, left)), ""),
            ("Start over", lambda: self.app.push(LevelScreen(self.app, afresh)), "From the first level"),
            CANCEL,
        ]
        self.app.push(Menu(self.app, self.episode.name, rows))

    def _trial(self, index: int) -> None:
        if self.episode is not None:
            entry, *following = self.episode.levels[index:]
            if problem := play_level(self.app, entry, following=following, player=self.player):
                self.app.notify(problem)

    def draw_frame(self, surface: pygame.Surface) -> None:
        super().draw_frame(surface)
        theme, palette = self.app.theme, self.app.theme.palette
        if len(self.packs) < 2 and not self.previews:
            for line, text in enumerate(_OPENS):
                theme.text(surface, text, _LEFT, 64 + 14 * line, size=10, colour=palette.faint, width=_WIDTH)
        self.grid.draw_names(surface, theme, self.pack.columns)
        if self.previews:
            self._draw_preview(surface, theme)
        else:
            for place, (look, text) in enumerate(LOOKS):
                x, y = _LEFT + 160 * (place % 2), self._below + 40 + 23 * (place // 2)
                draw_look(surface, theme, look, (x, y, 18, 18))
                theme.text(surface, text, x + 25, y + 4, size=9.5)
            self._draw_total(surface, theme, self._below + 92)
        if self.pack.key and self.pack.pack and not self.previews:
            summary = self.pack.pack.index.summary
            self._draw_picture(surface, self._below + 150, 200.0)
            theme.text(surface, shown_text(summary, 200), _SIDE, 114, size=10, colour=palette.faint, width=364)
        episode = self.episode
        if episode is None:
            theme.text(surface, "No episodes", _SIDE, 66, size=16, colour=palette.faint, bold=True)
            return
        head = f"{episode.code}  {episode.name}"
        width = 174 if self._is_lent else 264
        theme.text(surface, head, _SIDE, 66, size=16, bold=True, width=width)
        best = self.player.records.episode_best(episode.key)
        clock = f"Your best: {seconds_text(best.score)} s left on the clock" if best else ""
        count = len(episode.levels)
        text = clock or _how_far(sum(level.digest in self.passed for level in episode.levels), count)
        text = self._hint() if self._state(episode.number) == LOCKED else text
        theme.text(surface, text, _SIDE, 96, size=11, colour=palette.good if best else palette.faint)

    def _draw_preview(self, surface: pygame.Surface, theme: Theme) -> None:
        """The pack as its maker presents it: name, author, comment, picture."""
        faint = theme.palette.faint
        index = self.pack.pack.index if self.pack.pack else None
        name, by = (index.name, index.byline) if index else (self.pack.name, "")
        theme.text(surface, shown_text(name), _LEFT, 58, size=20, bold=True, width=_WIDTH)
        theme.text(surface, shown_text(by), _LEFT, 84, size=11, width=_WIDTH)
        theme.text(surface, _PREVIEWED, _SIDE, 114, size=10, colour=faint, width=364)
        comment = shown_text(index.comment, 200) if index else ""
        theme.paragraph(surface, [comment], (_LEFT, self._below, _WIDTH, 44), 11, 14)
        top = self._below + (50 if comment else 0)
        self._draw_total(surface, theme, top)
        self._draw_picture(surface, top + 52, float(_WIDTH))

    def _draw_picture(self, surface: pygame.Surface, top: float, widest: float) -> None:
        """The pack's picture, where there is room for it above the foot."""
        width = min(widest, (540 - top) * 33 / 25)
        if width >= 80:
            self.thumbnails.draw_pack(surface, self.pack.levels, _LEFT, top, width)

    def _draw_total(self, surface: pygame.Surface, theme: Theme, y: float) -> None:
        levels = self.pack.levels
        total = count_results(levels, self.marks, self.passed)
        by = f" by {shown_text(self.player.settings.name)}" if self.player.settings.name else ""
        passed = f"{total.passed} of {total.levels} levels passed{by}"
        theme.text(surface, passed, _LEFT, y, size=11, bold=True, width=_WIDTH)
        x = _LEFT + 8.0
        if any(entry.pars for entry in levels):
            for medal in MEDALS_FROM_BRONZE:
                draw_medal(surface, theme, medal, x, y + 27, 16, reached=total.medals[medal] > 0)
                theme.text(surface, str(total.medals[medal]), x + 13, y + 22, size=10)
                x += 58
        draw_all_gold(surface, theme, x, y + 27)
        theme.text(surface, f"{total.all_gold} with all gold", x + 12, y + 22, size=10)

    def _draw_cell(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        number = self.grid.numbers[index]
        if number < 0:
            return
        x, y, w, h = area
        inner = (x + 1.5, y + 1.5, w - 3, h - 3)
        look = self._look_of(number)
        draw_look(surface, theme, look, inner)
        if look != "locked":
            colour = theme.palette.on_tile if look == "beaten" else theme.palette.text
            size = min(16.0, h / 2)
            code, top = self.pack.episodes[number].code, y + (h - size) / 2
            theme.text(surface, code, x + w / 2, top, size=size, colour=colour, align="centre")
            self._draw_reached(surface, theme, number, area)
        if index == self.grid.index:
            width = 2.5 if focused else 1.2
            theme.canvas.frame_rect(surface, theme.palette.accent, x, y, w, h, width, 4)

    def _draw_reached(self, surface: pygame.Surface, theme: Theme, number: int, area: Area) -> None:
        x, y, w, _ = area
        levels = self.pack.episodes[number].levels
        medal = worst_medal(levels, self.marks)
        size = min(14.0, w / 3)
        if medal:
            draw_medal(surface, theme, medal, x + 4 + size / 2, y + 4 + size / 2, size)
        if all(has_all_gold(entry, self.marks.get(entry.digest)) for entry in levels):
            draw_all_gold(surface, theme, x + w - 4 - size / 2, y + 4 + size / 2, size * 0.75)

    def _look_of(self, number: int) -> str:
        state = self._state(number)
        if all(entry.digest in self.passed for entry in self.pack.episodes[number].levels):
            return "beaten"
        return {LOCKED: "locked", CHEATED: "cheated"}.get(state, "open")

    def _draw_row(self, surface: pygame.Surface, theme: Theme, index: int, area: Area, focused: bool) -> None:
        episode = self.episode
        if episode is None or index >= len(episode.levels):
            return
        x, y, w, h = area
        entry = episode.levels[index]
        theme.row(surface, (x, y + 2, w, h - 4), chosen=focused, focused=focused)
        self.thumbnails.draw(surface, entry, x + 6, y + 5, SMALL_PICTURE)
        left = x + SMALL_PICTURE + 18
        width = w - SMALL_PICTURE - 24
        theme.text(surface, f"{index + 1}  {entry.title}", left, y + 12, size=13, bold=True, width=width - 46)
        mark = self.marks.get(entry.digest)
        all_gold_and_medal(surface, theme, entry, mark, x + w - 14, y + 19)
        played = self.player.statistics.played(entry.digest)
        colour = theme.palette.good if mark else theme.palette.faint
        theme.text(surface, self.player.reached(entry, mark), left, y + 32, size=11, colour=colour, width=width)
        draw_pars(surface, theme, entry.pars, mark and mark.fastest, left, y + 45, MEDALS_FROM_BRONZE[1:])
        if played.attempts:
            theme.text(surface, tries_text(played), left, y + 65, size=10, colour=theme.palette.faint)
