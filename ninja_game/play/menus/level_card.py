"""What lists and cards of levels show of par times: the medal, the mark for all gold, the next par."""

from __future__ import annotations

import pygame

from ninja_game.play.ui.medals import MEDALS, draw_all_gold, draw_medal
from ninja_game.play.ui.theme import Theme
from ninja_game.player.catalogue import Entry
from ninja_game.player.progress import Mark, has_all_gold, medal_of, next_par
from ninja_game.player.scoring import seconds_text


def all_gold_and_medal(
    surface: pygame.Surface, theme: Theme, entry: Entry, mark: Mark | None, right: float, middle: float
) -> None:
    """The medal of a level, its middle at ``right``, and left of it the mark for all gold; nothing where none is."""
    medal = medal_of(entry, mark)
    if medal:
        draw_medal(surface, theme, medal, right, middle)
    if has_all_gold(entry, mark):
        draw_all_gold(surface, theme, right - 18, middle)


def time_and_par(entry: Entry, mark: Mark | None) -> str:
    """The player's fastest time in a level and the next medal's, in words; "" where there is neither."""
    time = f"{seconds_text(mark.fastest)} s" if mark else ""
    par = next_par(entry.pars, mark) if entry.pars else ""
    return "    ".join(filter(None, (time, par)))


def draw_pars(surface: pygame.Surface, theme: Theme, entry: Entry, mark: Mark | None, x: float, y: float) -> None:
    """All pars of a level in a row, the reached ones filled; nothing where it has none."""
    if entry.pars is None:
        return
    for medal in MEDALS:
        par = entry.pars.par(medal)
        reached = mark is not None and mark.fastest <= par
        draw_medal(surface, theme, medal, x + 8, y + 8, 16, reached=reached)
        theme.text(surface, seconds_text(par), x + 20, y + 3.5, size=9.5)
        x += 80


def where_from(entry: Entry) -> str:
    """Where a level comes from, and how hard it is."""
    pack = entry.source if entry.source not in {"game", "yours"} else ""
    parts = [pack, f"Episode {entry.episode}" if entry.episode else "Your folder" if entry.source == "yours" else ""]
    if entry.pars and entry.pars.difficulty is not None:
        parts.append(f"difficulty {entry.pars.difficulty:.1f}")
    return "    ".join(filter(None, parts))
