"""The screen of the player's packs: its buttons, its keys, its picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import pygame

from ninja_game.editor import packs
from ninja_game.files.shown_text import counted, shown_text
from ninja_game.files.user_folder import short_path
from ninja_game.formats.pack.pack import Pack
from ninja_game.play.menus import pack_menus, pack_sharing
from ninja_game.play.menus.episodes import PREVIEW
from ninja_game.play.menus.open_pack import ZipsScreen, open_pack
from ninja_game.play.menus.pack_desk import PackDesk
from ninja_game.play.menus.pack_list import PackList, pack_size
from ninja_game.play.menus.pack_shelves import CELL_HEIGHT, PackCell, Rack
from ninja_game.ui.canvas import WIDTH
from ninja_game.ui.input.bindings import InputEvent
from ninja_game.ui.input.keys import chord
from ninja_game.ui.widgets import Button, Choice, Widget

_NO_PACK = (
    "A pack is a folder with your levels in episodes.",
    "Levels that you have made can be dragged into it.",
    "Whoever has sent you one gave you a link to paste, or a zip to open or drop here.",
)
_NO_LEVELS = (
    "Or choose at the right where your levels are, and drag them into the places.",
    "Make ready then certifies all, and gives you a zip and a link to share.",
)

_DRAG = "Drag a level or an episode; a second click edits. Enter, or the right button: more. Ctrl or Shift: several"

_MOVES = "Let go to move it there; with Ctrl it is copied. The colours of a level go by its place in the pack"

_CARD = 106  # the upper edge of the card of a received pack, px


class _ShownState(NamedTuple):
    """The parts of the screen that change without an action of the player."""

    is_busy: bool = False
    obstacles: int = 0
    zipped: Path | None = None
    text: str = ""
    notice: str = ""


class PackScreen(PackDesk):
    """The screen of the player's packs (*Levels > Packs*): the desk, with its buttons, keys and menus."""

    foot_height = 552.0
    _shown = _ShownState()

    def build(self) -> Sequence[Widget]:
        app = self.app
        names = [(pack.name, pack.key) for pack in self.own_packs]
        pack = self.pack and self.pack.pack
        key = self.pack.key if self.pack else ""
        choice = self.pack_choice = Choice((36, 60, 140, 28), "", names, lambda: key, self._choose_pack)
        choice.more = lambda: app.push(PackList(app, self.own_packs, lambda pack: self._choose_pack(pack.key)))
        mark = ", received" if self.is_received else ""
        place = f"{pack.index.title}{mark}, in the folder {self.path.name}" if pack else ""
        choice.hint = f"{place}. Enter, or a click on the name: all your packs"
        undo = Button((180, 60, 42, 28), "Undo", self.undo, size=10)
        undo.enabled = bool(steps := self.packer.steps)
        undo.hint = f"Ctrl+Z: {steps[-1].name}" if steps else ""
        new = Button((226, 60, 70, 28), "New pack...", partial(pack_sharing.ask_for_new_pack, self), size=10)
        link = Button((662, 525, 94, 24), "Copy the link", partial(pack_sharing.copy_the_link, self), size=10)
        link.hint = "Whoever opens it, or pastes it in Levels > Packs, gets the pack"
        if pack and self.is_received:
            return self._player_widgets(pack, [choice, undo, new, link])
        tray = [("In no episode", "none"), ("Your folder", "yours")]
        tray += [(pack.name if pack.key else "The game's own", pack.key) for pack in self.sets if pack is not self.pack]
        tray_choice = Choice((622, 96, 134, 26), "", tray, lambda: self.tray_key, self.choose_tray)
        busy = self.packer.is_busy

        def button(x: float, width: float, text: str, act: Callable[[PackDesk], object], hint: str = "") -> Button:
            return Button((x, 60, width, 28), text, partial(act, self), hint=hint, size=10)

        hint = "Ctrl+V: the pack whose link is in the clipboard becomes one of yours"
        paste = button(300, 64, "Paste link", pack_sharing.paste, hint)
        hint = "A zip that somebody sent you; it can be dropped here too"
        zips = partial(ZipsScreen, app, partial(pack_sharing.install_received, self))
        unzip = button(368, 74, "Open a zip...", lambda desk: desk.app.push(zips()), hint)
        if not pack:
            for row, large in enumerate((new, paste, unzip)):
                large.area, large.size = (276, 220 + 56 * row, 240, 44), 14
            return [new, paste, unzip, undo] if steps else [new, paste, unzip]
        more = button(446, 48, "More...", pack_menus.pack_menu, "Preview, name, copy or delete the pack")
        hint = f"{PREVIEW}: what whoever pastes the link sees; nothing is kept"
        opener = self.play_button = button(498, 54, "Preview", pack_menus.view, hint)
        opener.enabled = bool(self.pack and self.pack.episodes)
        problems = button(556, 62, "Problems", pack_sharing.show_problems)
        action = ("Stop", self.packer.end) if busy else ("Make ready", partial(pack_sharing.prepare_shown, self))
        hint = "Certify all, measure par times, look for problems; zip and link. Only what changed is done again"
        ready = Button((632, 60, 124, 28), *action, hint=hint)
        folder = Button((562, 525, 94, 24), "Open the folder", partial(pack_sharing.open_folder, self), size=10)
        folder.hint = "Where the zip is"
        share = [] if busy else [folder, link] if self.zipped else [link]
        at_the_top: list[Widget] = [choice, undo, new, paste, unzip, more, opener, problems, ready]
        first = [self.shelves, *at_the_top, tray_choice, self.tray, *share]
        episode = self.shelves.cells[0].episode
        if episode and self._is_new:
            make_one = partial(pack_menus.ask_for_new_level, self, episode.number)
            first.append(Button((196, self._top, 240, 44), "New level...", make_one, hint=pack_menus.MADE, size=14))
        return first

    def _player_widgets(self, pack: Pack, others: Sequence[Widget]) -> Sequence[Widget]:
        """What a player does with a received pack, below its card."""
        rows = [
            Button((276, _CARD + 250 + 42 * k, 240, 34), *row[:2], hint=row[2])
            for k, row in enumerate(pack_menus.pack_rows(self, pack))
        ]
        self.play_button = rows[0]
        opener = Button((632, 60, 124, 28), "Open a pack...", partial(open_pack, self.app, "Open a pack"))
        return [*rows, *others, opener]

    @property
    def _is_new(self) -> bool:
        """Whether the pack has no level, and room for a large button."""
        return self.shelves.lines < 3 and self.pack is not None and not (self.pack.levels or self.is_received)

    @property
    def _top(self) -> float:
        """The upper edge of the texts below the shelves, px."""
        return 96 + CELL_HEIGHT * self.shelves.lines + 24 if self.pack else 396

    @property
    def notice_room(self) -> tuple[float, float]:
        """Between the title and *Back*: below is the line of hints."""
        return 110.0, 684.0

    def _choose_pack(self, key: str) -> None:
        self.show(next(pack for pack in self.own_packs if pack.key == key))
        super().enter()

    def handle(self, event: InputEvent) -> None:
        if event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+v":
            pack_sharing.paste(self)
        elif event.raw.type == pygame.DROPFILE:
            pack_sharing.install_received(self, Path(event.raw.file))
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+z":
            self.undo()
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "ctrl+a":
            self.marked |= {level.named.file for level in self.levels(self.focus)}
            self.redraw = True
        elif event.raw.type == pygame.KEYDOWN and chord(event.raw) == "delete":
            rack = self.focus
            if removal := pack_menus.removal_of(self, rack.chosen) if isinstance(rack, Rack) else None:
                removal()
        else:
            super().handle(event)

    def choose(self, cell: PackCell | None) -> None:
        if cell is None:
            pack_menus.pack_menu(self)
        elif self.moving:
            self.drop(cell if self.focus is self.shelves else None)
        elif cell.level:
            pack_menus.level_menu(self, cell)
        elif cell.episode is None:
            self.ask_text_for(
                "New episode: name", self.next_name, partial(packs.new_episode, self.path, column=self.column)
            )
        elif cell.head:
            pack_menus.episode_menu(self, cell.episode)
        else:
            pack_menus.ask_for_new_level(self, cell.episode.number)

    def update(self, real_ms: int) -> None:
        super().update(real_ms)
        packer, before = self.packer, self._shown
        self._shown = state = _ShownState(
            packer.is_busy, len(packer.obstacles), self.zipped, packer.text, self.app.notice
        )
        if state[:3] != before[:3]:
            self.enter()
        elif state != before:
            # A new notice may be about a certificate that a search of the editor has found.
            self.read_packs(news=state.notice in ("", before.notice))
        if ready := packer.take_problems():
            pack_sharing.ask_about(self, ready)
        self.redraw = self.status.update() or state != before or self.redraw

    def draw_frame(self, surface: pygame.Surface) -> None:
        self.shelves.hint = self.tray.hint = _MOVES if self.moving else _DRAG
        super().draw_frame(surface)
        theme, faint = self.theme, self.theme.palette.faint
        packer, step = self.packer, self._next_step()
        saved = f"Saved: {short_path(self.zipped)}" if self.zipped else ""
        texts = [packer.text or (saved if self.is_fresh else self._change)]
        if packer.text and packer.path != self.path:
            texts = [f"{shown_text(packer.path.name)}: {packer.text}"]
        elif not packer.is_busy:
            texts.append(self.status.counts())
        texts = [*filter(None, texts)]
        if self.is_received:
            self._draw_card(surface)
        elif self.shelves.lines < 4:
            place = (36, self._top + 60 * self._is_new, 560 if self.pack else 720, 90)
            theme.paragraph(surface, step, place, 13, 20, align="centre")
        elif not packer.is_busy:
            texts += step[:1]
        foot = (36, 524, 720 if packer.is_busy else 516, 41)
        theme.paragraph(surface, texts, foot, 10, 13.5, colour=faint)
        if packer.is_busy and packer.share is not None:
            theme.panel(surface, 36, 546, 720, 7)
            theme.canvas.fill_rect(surface, theme.palette.accent, 36, 546, max(1.0, 720 * packer.share), 7, 3)

    def _draw_card(self, surface: pygame.Surface) -> None:
        """Name, author, version, picture, size and comment of a received pack."""
        theme, middle, pack = self.theme, WIDTH / 2, self.pack
        if not (pack and pack.pack):
            return
        index, faint = pack.pack.index, theme.palette.faint
        theme.text(surface, shown_text(index.name), middle, _CARD, size=17, bold=True, align="centre", width=600)
        theme.text(surface, shown_text(index.byline), middle, _CARD + 24, size=11, align="centre", width=600)
        self.thumbnails.draw_pack(surface, pack.levels, middle - 110, _CARD + 44, 220)
        theme.text(surface, pack_size(pack), middle, _CARD + 216, size=10, align="centre", colour=faint)
        comment = (middle - 300, _CARD + 232, 600, 14)
        theme.paragraph(surface, [shown_text(index.comment, 200)], comment, 10, 13, align="centre")

    def _next_step(self) -> Sequence[str]:
        """The next step for the shown pack, in words."""
        pack, status, packer = self.pack, self.status, self.packer
        if pack is None or not pack.levels:
            return _NO_LEVELS if pack else _NO_PACK
        if packer.is_busy and packer.path == self.path:
            return ["It goes on when you leave this screen.", "Stop keeps what was found."]
        if self.is_fresh:
            return ["Send the zip or the link: Open a pack, in Episodes, takes both."]
        if not status.present:
            return []
        if status.present.problems:
            return [f"{counted(len(status.present.problems), 'problem')} to mend: Problems, above, shows the place."]
        if status.to_do():
            return ["Next: Make ready, at the top right."]
        return [f"{self._change or 'Nothing is wrong'}: Make ready writes the zip and the link."]

    @property
    def _change(self) -> str:
        """That the pack has changed since its newest zip, in words; "" without a zip, or a change."""
        return f"Changed since {self.zipped.name}" if self.zipped and not self.is_fresh else ""
